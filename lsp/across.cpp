#include "lsp/across.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/text.h"

namespace cnctrans::lsp {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_file = 4 << 20;

bool has_extension(const translator::Dialect& dialect, const fs::path& path) {
  const std::string extension = path.extension().string();
  if (extension.empty()) return false;
  const auto is = [&](std::string_view e) { return iequals_ascii(e, std::string_view(extension).substr(1)); };
  return std::any_of(dialect.mill_extensions.begin(), dialect.mill_extensions.end(), is) ||
         std::any_of(dialect.lathe_extensions.begin(), dialect.lathe_extensions.end(), is) ||
         std::any_of(dialect.other_extensions.begin(), dialect.other_extensions.end(), is);
}

bool stands_in(const Occurrence& name, Analysis& analysis) {
  const auto& all = analysis.names();
  return std::any_of(all.begin(), all.end(), [&](const Occurrence& o) { return same_name(o, name); });
}

bool share_a_subprogram(Analysis& a, Analysis& b) {
  for (const auto& name : a.names()) {
    if (name.kind == NameKind::routine && stands_in(name, b)) return true;
  }
  return false;
}

/// What every spelling of the name has in it, in capitals: its number, or its letters.
std::string core_of(const Occurrence& name) {
  const std::string shown = to_upper_ascii(name.shown);
  if (!name.numbered) return shown;
  const std::size_t first = shown.find_first_of("123456789");
  return first == std::string::npos ? "0" : shown.substr(first, shown.find_last_of("0123456789") + 1 - first);
}

std::vector<std::string> files_near(const Analysis& analysis) {
  std::vector<std::string> out;
  for (const auto& folder : analysis.folders()) {
    std::error_code failed;
    for (auto at = fs::directory_iterator(folder, failed); !failed && at != fs::directory_iterator();
         at.increment(failed)) {
      std::error_code ignored;
      if (at->is_regular_file(ignored) && at->file_size(ignored) <= largest_file &&
          has_extension(analysis.dialect(), at->path()))
        out.push_back(at->path().string());
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

std::vector<Other> others_with(Workspace& workspace, const std::string& uri, Analysis& analysis,
                               const Occurrence& name) {
  std::vector<Other> out;
  if (name.routine >= 0) return out;
  const auto belongs = [&](Analysis& other) {
    return &other.dialect() == &analysis.dialect() && stands_in(name, other) &&
           (name.kind != NameKind::variable || share_a_subprogram(analysis, other));
  };
  std::set<std::string> seen{uri};
  for (const auto& [other, document] : workspace.documents()) {
    if (!seen.insert(other).second) continue;
    Analysis* found = workspace.analysis(other);
    if (found != nullptr && belongs(*found)) out.push_back({other, &document, found, nullptr, nullptr});
  }
  const std::string core = core_of(name);
  for (const auto& path : files_near(analysis)) {
    std::string other = uri_of_file(path), error;
    if (!seen.insert(other).second) continue;
    const SourcePtr text = SourceText::open(path, &error);
    if (!text || to_upper_ascii(text->text()).find(core) == std::string::npos) continue;
    auto document = std::make_unique<Document>(other, std::string(analysis.dialect().name), std::string(text->text()));
    auto found = std::make_unique<Analysis>(*document, workspace.settings);
    if (!found->read() || !belongs(*found)) continue;
    const Document* const shown = document.get();
    Analysis* const read = found.get();
    out.push_back({std::move(other), shown, read, std::move(document), std::move(found)});
  }
  return out;
}

}  // namespace cnctrans::lsp
