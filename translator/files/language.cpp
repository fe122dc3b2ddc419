#include "translator/files/language.h"

#include <algorithm>

#include "translator/files/loader.h"
#include "translator/files/readable.h"

namespace cnctrans::translator {

namespace {

/// What one reader makes of the head of a text.
struct Look {
  const Dialect* dialect = nullptr;
  std::uint64_t blocks = 0, unread = 0;
  std::uint64_t complaints = 0;  ///< errors and warnings: a header that is missing, say
  bool extension = false;        ///< the file is called as its files are

  /// Unread blocks, of a hundred.
  [[nodiscard]] std::uint64_t unread_share() const { return blocks == 0 ? 100 : unread * 100 / blocks; }
  /// The less, the likelier: a block that can't be read says more than a complaint, a name as much as a few complaints.
  [[nodiscard]] std::int64_t against() const {
    constexpr std::int64_t of_a_block = 10, of_a_name = 5;
    return static_cast<std::int64_t>(unread) * of_a_block + static_cast<std::int64_t>(complaints) -
           (extension ? of_a_name : 0);
  }
};

constexpr std::size_t head_bytes = 32 * 1024;

/// The first lines, whole ones.
std::string_view head_of(std::string_view text) {
  if (text.size() <= head_bytes) return text;
  const auto end = text.find_last_of("\r\n", head_bytes);
  return text.substr(0, end == std::string_view::npos ? head_bytes : end + 1);
}

bool has_extension(const Dialect& d, const SourceText& source) {
  const std::string extension = source.extension();
  const auto in = [&extension](const std::vector<std::string_view>& list) {
    return std::find(list.begin(), list.end(), extension) != list.end();
  };
  return in(d.mill_extensions) || in(d.lathe_extensions) || in(d.other_extensions) || in(d.definition_extensions);
}

Look look(const Dialect& d, const SourceText& source) {
  Look result{&d};
  const auto head = SourceText::from_string(source.name(), std::string(head_of(source.text())));
  std::string ignored;
  const auto profile = choose_profile(d, {}, head.get(), &ignored);
  if (!profile) return result;
  Diagnostics said;
  frontends::ReadStats stats;
  FileTable files;
  d.frontend->read(head, files.add(head), {frontends::Reader::scanner, &*profile}, said, &stats);
  result.blocks = stats.blocks;
  result.unread = stats.blocks - stats.blocks_read;
  result.complaints = said.error_count() + said.warning_count();
  result.extension = has_extension(d, source);
  return result;
}

/// By likelihood, the likeliest first.
std::vector<Look> look_by_all(const SourceText& source) {
  std::vector<Look> looks;
  for (const auto& d : dialects()) {
    if (readable(d)) looks.push_back(look(d, source));
  }
  std::stable_sort(looks.begin(), looks.end(), [](const Look& a, const Look& b) { return a.against() < b.against(); });
  return looks;
}

/// Bytes that neither a text nor a punched tape has: more than a few mean machine code or a picture.
bool is_binary(std::string_view text) {
  constexpr std::string_view of_tapes("\0\t\n\r\f\x04\x13\x1a\x7f", 9);
  const std::string_view head = text.substr(0, 4096);
  const auto strange = std::count_if(head.begin(), head.end(), [of_tapes](char c) {
    return (static_cast<unsigned char>(c) < ' ' || c == '\x7f') && of_tapes.find(c) == std::string_view::npos;
  });
  return strange > 0 && static_cast<std::size_t>(strange) * 20 > head.size();
}

std::string names_to_choose() {
  std::string text;
  for (const auto& d : dialects()) {
    if (readable(d)) text += (text.empty() ? "" : ", ") + std::string(d.name);
  }
  return text;
}

constexpr std::uint64_t half = 50;

}  // namespace

Language find_language(const SourceText& source) {
  if (is_binary(source.text())) return {nullptr, "it is no text"};
  const auto looks = look_by_all(source);
  if (looks.front().blocks == 0) return {nullptr, "it has no blocks"};
  if (looks.front().unread_share() >= half) return {nullptr, "no reader understands it"};
  if (looks.size() > 1 && looks[0].against() == looks[1].against()) return {nullptr, "several languages would fit"};
  return {looks.front().dialect, looks.front().extension ? "extension and content" : "content"};
}

std::optional<WrongLanguage> wrong_language(const Dialect& dialect, const SourceText& source, FileId file,
                                            const frontends::ReadStats& read) {
  const Span place{file, 1, 1, 1, 1};
  const auto error = [&](std::string text, std::string hint) {
    return WrongLanguage{{"CNC-LANGUAGE", Severity::error, place, std::move(text), std::move(hint)}};
  };
  const std::uint64_t unread = read.blocks - read.blocks_read;
  if (unread == 0) return std::nullopt;
  if (is_binary(source.text())) return error("this is no text: a picture, a program of a computer or the like", {});
  const std::uint64_t share = unread * 100 / read.blocks;
  constexpr std::uint64_t few = 3, tenth = 10, foreign_blocks = 10, foreign_share = 95;
  if (unread < few || share < tenth) return std::nullopt;
  const auto looks = look_by_all(source);
  const Look& best = looks.front();
  const std::string counts = std::to_string(unread) + " of " + std::to_string(read.blocks) +
                             " blocks can't be read as " + std::string(dialect.title);
  if (best.dialect != &dialect && best.unread_share() * 4 < share) {
    WrongLanguage wrong = error(counts + "; this looks like a program of " + std::string(best.dialect->title),
                                "name its language: " + std::string(best.dialect->name));
    wrong.beside = share < half || has_extension(dialect, source);
    if (wrong.beside) wrong.said.severity = Severity::note;
    return wrong;
  }
  if (read.blocks < foreign_blocks || share < foreign_share) return std::nullopt;
  return error(counts + ", and no other reader understands it",
               "give a part program of one of these languages: " + names_to_choose());
}

}  // namespace cnctrans::translator
