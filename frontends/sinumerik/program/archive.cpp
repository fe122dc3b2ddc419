#include "frontends/sinumerik/program/archive.h"

#include <algorithm>

#include "base/source.h"
#include "base/text.h"

namespace cnctrans::frontends::sinumerik {

namespace {

constexpr std::string_view header_mark = "%_N_", folder_mark = "$PATH=";

/// In capitals; what would not stand in a plain name of a file becomes _.
std::string plain(std::string_view name) {
  std::string out = to_upper_ascii(name);
  for (char& c : out) {
    const bool fits = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (!fits) c = '_';
  }
  return out;
}

/// "SHAFT_MPF" as "SHAFT.MPF".
std::string file_name(std::string_view internal) {
  std::string out = plain(internal.substr(0, internal.find_first_of(" \t\r")));
  const std::size_t end = out.rfind('_');
  if (end != std::string::npos && end != 0) out[end] = '.';
  return out;
}

/// "SHAFT.MPF" as "_N_SHAFT_MPF"; without an ending the one that is given.
std::string internal_name(std::string_view file, std::string_view ending) {
  const std::size_t dot = file.rfind('.');
  const bool has = dot != std::string_view::npos;
  return "_N_" + plain(file.substr(0, dot)) + '_' + (has ? plain(file.substr(dot + 1)) : std::string(ending));
}

/// "; $PATH=/_N_WKS_DIR/_N_SHAFT_WPD" as "SHAFT.WPD/"; a common folder has no folder of its own.
std::string folder_of_line(std::string_view line) {
  const std::size_t mark = line.find(folder_mark);
  if (line.substr(0, 1) != ";" || mark == std::string_view::npos) return {};
  const std::string_view path = trim(line.substr(mark + folder_mark.size()));
  const std::size_t last = path.rfind("/_N_");
  if (last == std::string_view::npos) return {};
  const std::string folder = file_name(path.substr(last + 4));
  return folder.ends_with(".DIR") ? std::string() : folder + '/';
}

}  // namespace

std::vector<ArchivedProgram> take_apart(std::string_view archive) {
  std::vector<ArchivedProgram> out;
  bool behind_header = false;
  SourceLine line;
  std::string_view rest = archive;
  while (true) {
    const std::string_view before = rest;
    if (!take_line(rest, line)) break;
    const std::string_view whole = before.substr(0, before.size() - rest.size());
    if (line.text.starts_with(header_mark)) {
      out.emplace_back(file_name(line.text.substr(header_mark.size())), std::string());
      behind_header = true;
    } else if (behind_header) {
      out.back().first.insert(0, folder_of_line(line.text));
      behind_header = false;
    }
    if (!out.empty()) out.back().second += whole;
  }
  if (out.size() < 2) out.clear();
  return out;
}

std::string put_together(const std::vector<ArchivedProgram>& programs) {
  std::string out;
  for (const auto& [path, text] : programs) {
    if (!text.starts_with('%')) {
      const std::size_t slash = path.rfind('/');
      const std::string name = internal_name(path.substr(slash == std::string::npos ? 0 : slash + 1), "MPF");
      std::string folder = name.ends_with("_SPF") ? "/_N_SPF_DIR" : "/_N_MPF_DIR";
      if (slash != std::string::npos) {
        const std::string above = path.substr(0, slash);
        folder = "/_N_WKS_DIR/" + internal_name(above.substr(above.rfind('/') + 1), "WPD");
      }
      out += '%' + name + "\n;" + std::string(folder_mark) + folder + '\n';
    }
    out += text;
    if (!out.ends_with('\n')) out += '\n';
  }
  return out;
}

}  // namespace cnctrans::frontends::sinumerik
