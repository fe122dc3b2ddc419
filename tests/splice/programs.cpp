#include "tests/splice/programs.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <sstream>

#include "base/text.h"
#include "tests/language/markdown.h"
#include "translator/files/loader.h"

namespace cnctrans::splice {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> out;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!trim(line).empty()) out.push_back(line);
  }
  return out;
}

/// The blocks of a language whose blocks may be several lines: `CYCL DEF 7.1 X+10` goes on with 7.0, and a line behind
/// `~`. Without their numbers.
std::vector<std::string> blocks_of(const std::string& text) {
  std::vector<std::string> out;
  for (const auto& line : lines_of(text)) {
    const auto begin = line.find_first_not_of("0123456789 ");
    const std::string block = line.substr(std::min(begin, line.size()));
    const bool open = !out.empty() && trim(out.back()).ends_with('~');
    const auto point = block.rfind("CYCL DEF ", 0) == 0 ? block.find_first_of(". ", 9) : std::string::npos;
    const bool part = point != std::string::npos && block[point] == '.' && block.compare(point, 2, ".0") != 0;
    if (open || (part && !out.empty()))
      out.back() += '\n' + (open ? line : block);
    else
      out.push_back(block);
  }
  return out;
}
std::vector<std::string> program_lines(const std::string& dialect, const std::string& text) {
  return dialect == "heidenhain" ? blocks_of(text) : lines_of(text);
}

bool is_lathe(const Program& p) {
  std::string ignored;
  const auto source = SourceText::from_string("program", p.text());
  const auto profile = translator::choose_profile(*translator::find_dialect(p.dialect), "", source.get(), &ignored);
  return profile && profile->kind == machine::Kind::lathe;
}

/// Every bit of the result depends on every bit of `x` (the finish of splitmix64).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

void add_pairs(const std::string& root, const std::string& dialect, std::vector<Program>& out) {
  for (const auto& path : testing::files_below(root + "/tests/pairs", {".md"})) {
    bool lathe = false;
    for (const auto& s : testing::read_markdown(path)) {
      const auto has = [&s](const char* text) {
        return std::find(s.lines.begin(), s.lines.end(), text) != s.lines.end();
      };
      if (s.level == 1) lathe = has("machine: lathe");
      if (s.heading != dialect || s.fence.empty()) continue;
      out.push_back(framed(dialect, lathe, s.fence));
      out.back().name = path.substr(root.size() + 1);
    }
  }
}

void add_catalogue(const std::string& root, const std::string& dialect, std::vector<Program>& out) {
  for (const auto& path : testing::files_below(root + "/tests/catalogue/" + dialect, {".md"})) {
    for (const auto& s : testing::read_markdown(path)) {
      if (s.level != 2 || s.fence.empty()) continue;
      const auto starts = [&s](const std::string& text) {
        return std::any_of(s.lines.begin(), s.lines.end(), [&](const auto& l) { return l.rfind(text, 0) == 0; });
      };
      if (starts("refuses:") || starts("option:") || starts("data:")) continue;
      out.push_back({dialect, starts("machine: " + dialect + "-lathe"),
                     path.substr(root.size() + 1) + ":" + std::to_string(s.line), program_lines(dialect, s.fence)});
    }
  }
}

/// Whole programs. Those of a Sinumerik that call files beside them get these as parts of an archive.
void add_files(const std::string& root, const std::string& folder, const std::string& dialect,
               std::vector<Program>& out) {
  std::vector<std::string> called;
  for (const auto& path : testing::files_below(root + folder + dialect, {".spf", ".SPF"})) {
    called.push_back("%_N_" + to_upper_ascii(fs::path(path).stem().string()) + "_SPF");
    for (auto& line : lines_of(testing::read_file(path))) called.push_back(std::move(line));
  }
  for (const auto& path : testing::files_below(root + folder + dialect, {""})) {
    const std::string name = fs::path(path).filename().string();
    if (name.find("README") != std::string::npos || to_upper_ascii(path).ends_with(".SPF")) continue;
    Program p{dialect, false, path.substr(root.size() + 1), program_lines(dialect, testing::read_file(path))};
    if (!called.empty() && !p.lines.empty() && p.lines.front().rfind("%_N_", 0) != 0) {
      p.lines.insert(p.lines.begin(), "%_N_MAIN_MPF");
      p.lines.insert(p.lines.end(), called.begin(), called.end());
    }
    p.lathe = is_lathe(p) || to_upper_ascii(path).ends_with(".PIT") || path.find("lathe") != std::string::npos;
    out.push_back(std::move(p));
  }
}

}  // namespace

Program framed(const std::string& dialect, bool lathe, const std::string& snippet) {
  Program p{dialect, lathe, {}, {}};
  const auto split = snippet.find("---\n");
  auto main = program_lines(dialect, snippet.substr(0, split));
  const auto rest =
      split == std::string::npos ? std::vector<std::string>{} : program_lines(dialect, snippet.substr(split + 4));
  const auto defined =
      std::find_if_not(main.begin(), main.end(), [](const auto& l) { return l.rfind("DEF ", 0) == 0; });
  const bool archive = dialect == "sinumerik" && !rest.empty();
  if (dialect == "fagor") p.lines = {"%PAIR ,MX,"};
  if (dialect == "num") p.lines = {"%100 (PAIR)"};
  if (archive) p.lines = {"%_N_MAIN_MPF"};
  if (dialect == "heidenhain") p.lines = {"BEGIN PGM PAIR MM"};
  p.lines.insert(p.lines.end(), main.begin(), defined);
  if (dialect == "fagor")
    p.lines.emplace_back(lathe ? "G18 G40 G05 G71 G90 G95 G151 G97 M41" : "G17 G40 G05 G71 G90 G94 M41");
  if (dialect == "num") p.lines.emplace_back(lathe ? "G18 G40 G71 G90 G95 G97 M41" : "G17 G40 G71 G80 G90 G94 M41");
  if (dialect == "sinumerik")
    p.lines.emplace_back(lathe ? "G18 G40 G64 G710 G90 G95 DIAMON M41" : "G17 G40 G64 G710 G90 G94 M41");
  p.lines.insert(p.lines.end(), defined, main.end());
  p.lines.emplace_back(dialect == "num" ? "M02" : "M30");
  p.lines.insert(p.lines.end(), rest.begin(), rest.end());
  if (dialect == "heidenhain") p.lines.emplace_back("END PGM PAIR MM");
  return p;
}

std::string Program::text() const {
  std::string out;
  for (const auto& line : lines) out += line + '\n';
  return out;
}

std::string Program::file_name() const {
  if (dialect == "fagor") return lathe ? "000100.pit" : "000100.pim";
  return dialect == "num" ? "100.xpi" : dialect == "heidenhain" ? "main.h" : "main.mpf";
}

std::vector<Program> programs_of(const std::string& root, const std::string& dialect) {
  std::vector<Program> out;
  add_pairs(root, dialect, out);
  add_catalogue(root, dialect, out);
  for (const char* folder : {"/tests/identity/", "/tests/golden/", "/examples/"}) add_files(root, folder, dialect, out);
  std::erase_if(out, [](const Program& p) { return p.lines.size() < 3; });
  for (auto& p : out) {
    for (const char c : p.text()) p.mark = mixed(p.mark + static_cast<unsigned char>(c));
  }
  return out;
}

const Program& pick(const std::vector<Program>& programs, std::uint64_t draw) {
  const auto rank = [draw](const Program& p) { return mixed(p.mark ^ draw); };
  return *std::min_element(programs.begin(), programs.end(),
                           [&](const Program& a, const Program& b) { return rank(a) < rank(b); });
}

LineParts parts_of(std::string_view line) {
  LineParts parts;
  std::size_t at = line.find_first_not_of(" \t");
  if (at == std::string_view::npos) return parts;
  const auto digits = [&](std::size_t from) {
    while (from < line.size() && std::isdigit(static_cast<unsigned char>(line[from])) != 0) ++from;
    return from;
  };
  if (line[at] == '/') {
    const std::size_t end = digits(at + 1);
    parts.skip = line.substr(at, end - at);
    at = std::min(line.find_first_not_of(" \t", end), line.size());
  }
  if (at < line.size() && line[at] == 'N' && digits(at + 1) > at + 1) {
    const std::size_t end = digits(at + 1);
    parts.number = line.substr(at, end - at);
    at = std::min(line.find_first_not_of(" \t", end), line.size());
  }
  parts.rest = line.substr(at);
  return parts;
}

std::string joined(const LineParts& parts) {
  std::string out = parts.skip;
  for (const auto& part : {parts.number, parts.rest}) {
    if (!out.empty() && !part.empty()) out += ' ';
    out += part;
  }
  return out;
}

bool frames(std::string_view line) {
  static constexpr std::array<std::string_view, 17> heads = {"%",   "(SUB",      "(RET",    "M30",  "M02",     "M2",
                                                             "M17", "M99",       "RET",     "PROC", "DEF",     "EXTERN",
                                                             ":",   "BEGIN PGM", "END PGM", "LBL",  "BLK FORM"};
  const std::string rest = parts_of(line).rest;
  const auto begins = [&rest](std::string_view head) {
    if (rest.rfind(head, 0) != 0) return false;
    return head.front() != 'M' || rest.size() == head.size() ||
           std::isdigit(static_cast<unsigned char>(rest[head.size()])) == 0;
  };
  return rest.empty() || std::any_of(heads.begin(), heads.end(), begins);
}

}  // namespace cnctrans::splice
