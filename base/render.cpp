// Diagnostics as text for people and as JSON for tools.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/diagnostics.h"
#include "base/source.h"

namespace cnctrans {
namespace {

constexpr std::size_t widest_line = 160;  // columns
constexpr std::string_view indent = "  ";
constexpr std::string_view cut_mark = "...";

/// One character as it is shown: its bytes in the line, its text, its width in columns.
struct Cell {
  std::size_t begin = 0;  ///< byte offset in the line
  std::string text;
  std::size_t width = 1;
};

/// Characters that a terminal would obey instead of showing: controls, and marks that change the writing direction.
bool is_hidden(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || (c >= 0x200B && c <= 0x200F) || (c >= 0x202A && c <= 0x202E) ||
         (c >= 0x2066 && c <= 0x2069) || c == 0xFEFF;
}

std::size_t width_of(char32_t c) {
  if (c >= 0x300 && c <= 0x36F) return 0;  // combining marks
  const bool wide = (c >= 0x1100 && c <= 0x115F) || (c >= 0x2E80 && c <= 0xA4CF) || (c >= 0xAC00 && c <= 0xD7A3) ||
                    (c >= 0xF900 && c <= 0xFAFF) || (c >= 0xFE30 && c <= 0xFE6F) || (c >= 0xFF00 && c <= 0xFF60) ||
                    (c >= 0xFFE0 && c <= 0xFFE6) || (c >= 0x1F300 && c <= 0x1FAFF) || (c >= 0x20000 && c <= 0x3FFFD);
  return wide ? 2 : 1;
}

Cell cell_at(std::string_view line, std::size_t at, Encoding encoding, std::size_t* length) {
  char32_t c = 0;
  *length = 1;
  if (encoding == Encoding::utf8) {
    const std::size_t n = utf8_length(line.substr(at), &c);
    if (n == 0) return {at, ".", 1};
    *length = n;
    if (c == '\t') return {at, "\t", 1};
    if (is_hidden(c)) return {at, ".", 1};
    return {at, std::string(line.substr(at, n)), width_of(c)};
  }
  std::string text = windows1252_to_utf8(line.substr(at, 1));
  utf8_length(text, &c);
  if (is_hidden(c) && c != '\t') text = ".";
  return {at, std::move(text), 1};
}

/// The cells of line[from, to), which both lie between characters.
std::vector<Cell> cells_of(std::string_view line, std::size_t from, std::size_t to, Encoding encoding) {
  std::vector<Cell> cells;
  for (std::size_t at = from; at < to;) {
    std::size_t length = 1;
    cells.push_back(cell_at(line, at, encoding, &length));
    at += length;
  }
  return cells;
}

/// A part of the line to look at: never more than a few thousand bytes around the place, whatever the line's length.
struct Part {
  std::size_t from = 0;
  std::size_t to = 0;
};

Part part_around(std::string_view line, std::size_t place, Encoding encoding) {
  constexpr std::size_t reach = 4 * widest_line;
  Part p{place > reach ? place - reach : 0, std::min(line.size(), place + reach)};
  const auto inside_character = [&](std::size_t at) {
    return encoding == Encoding::utf8 && at < line.size() && (static_cast<unsigned char>(line[at]) & 0xC0U) == 0x80;
  };
  for (int n = 0; n < 3 && p.from > 0 && inside_character(p.from); ++n) --p.from;
  for (int n = 0; n < 3 && inside_character(p.to); ++n) ++p.to;
  return p;
}

std::size_t width_of(const std::vector<Cell>& cells, std::size_t first, std::size_t last) {
  std::size_t w = 0;
  for (std::size_t i = first; i < last; ++i) w += cells[i].width;
  return w;
}

/// The cells [first, last) to show so that they fit the widest line with `place` among them.
std::pair<std::size_t, std::size_t> cells_to_show(const std::vector<Cell>& cells, std::size_t place) {
  if (width_of(cells, 0, cells.size()) <= widest_line) return {0, cells.size()};
  constexpr std::size_t room = widest_line - 2 * cut_mark.size();
  std::size_t first = std::min(place, cells.size());
  std::size_t used = 0;
  while (first > 0 && used + cells[first - 1].width <= room / 2) used += cells[--first].width;
  std::size_t last = first;
  used = 0;
  while (last < cells.size() && used + cells[last].width <= room) used += cells[last++].width;
  while (first > 0 && used + cells[first - 1].width <= room) used += cells[--first].width;
  return {first, last};
}

void append_source_line(std::string& out, const Span& span, std::string_view line, Encoding encoding, bool colour) {
  // Byte offsets of the marked range in the line; without a column nothing is marked.
  const std::size_t begin = std::min<std::size_t>(line.size(), span.column > 0 ? span.column - 1 : 0);
  std::size_t end = span.end_line > span.line ? line.size() : span.end_column > 0 ? span.end_column - 1 : begin;
  end = std::clamp(end, begin, line.size());
  const Part part = part_around(line, begin, encoding);
  const std::vector<Cell> cells = cells_of(line, part.from, part.to, encoding);
  const auto at = [&](std::size_t byte) {  // the cell that holds a byte
    const auto after =
        std::upper_bound(cells.begin(), cells.end(), byte, [](std::size_t b, const Cell& c) { return b < c.begin; });
    return static_cast<std::size_t>(after - cells.begin());
  };
  const std::size_t place = begin < part.to ? at(begin) - 1 : cells.size();
  const auto [first, last] = cells_to_show(cells, place);
  const bool cut_left = first > 0 || part.from > 0;
  const bool cut_right = last < cells.size() || part.to < line.size();

  std::string shown(indent);
  std::string carets(indent);
  if (cut_left) {
    shown += cut_mark;
    carets.append(cut_mark.size(), ' ');
  }
  bool marked = false;
  for (std::size_t i = first; i < last; ++i) {
    const Cell& c = cells[i];
    shown += c.text;
    if (i < place) {
      carets += c.text == "\t" ? std::string("\t") : std::string(c.width, ' ');
    } else if (i == place || c.begin < end) {
      for (std::size_t n = 0; n < c.width; ++n) carets += std::exchange(marked, true) ? '~' : '^';
    }
  }
  if (!marked) carets += '^';  // past the end of the line
  if (cut_right) shown += cut_mark;
  out += shown + '\n';
  if (span.column == 0) return;
  out += colour ? "\x1b[1;32m" + carets + "\x1b[0m\n" : carets + '\n';
}

/// Text of a message or a name for a terminal: UTF-8, controls as '.'.
std::string printable(std::string_view text) {
  const Encoding encoding = valid_utf8(text) ? Encoding::utf8 : Encoding::windows1252;
  std::string out;
  for (const Cell& c : cells_of(text, 0, text.size(), encoding)) out += c.text;
  return out;
}

std::string_view colour_of(Severity s) {
  switch (s) {
    case Severity::error: return "\x1b[1;31m";
    case Severity::warning: return "\x1b[1;35m";
    case Severity::note: break;
  }
  return "\x1b[1;36m";
}

void append_text(std::string& out, const Diagnostic& d, const FileTable& files, bool colour) {
  const std::string_view bold = colour ? "\x1b[1m" : "";
  const std::string_view plain = colour ? "\x1b[0m" : "";
  out += bold;
  if (d.span.file != 0) {
    out += printable(files.name(d.span.file)) + ':';
    if (d.span.known()) out += fmt::format("{}:", d.span.line);
    if (d.span.known() && d.span.column != 0) out += fmt::format("{}:", d.span.column);
    out += ' ';
  }
  fmt::format_to(std::back_inserter(out), "{}{}{} {}: {}{}\n", colour ? colour_of(d.severity) : "",
                 severity_text(d.severity), plain, d.code, printable(d.message), plain);
  const SourceText* const source = files.source(d.span.file);
  if (source != nullptr && d.span.known() && d.span.line <= source->last_line())
    append_source_line(out, d.span, source->line_text(d.span.line), source->encoding(), colour);
  if (!d.hint.empty()) out += "  hint: " + printable(d.hint) + '\n';
}

/// "a.pim: lines 12-15, 20; b.pim: line 3"
std::string place_list(const MoreDiagnostics& more, const FileTable& files) {
  std::string out;
  const MoreDiagnostics::Lines* before = nullptr;
  for (const auto& r : more.lines) {
    if (before == nullptr || before->file != r.file) {
      out += before != nullptr ? "; " : "";
      out += r.file != 0 ? printable(files.name(r.file)) + ": lines " : std::string("lines ");
    } else {
      out += ", ";
    }
    out += r.first == r.last ? fmt::format("{}", r.first) : fmt::format("{}-{}", r.first, r.last);
    before = &r;
  }
  if (!more.lines_complete) out += " and further lines";
  return out;
}

std::string more_text(const std::string& code, const MoreDiagnostics& more, const FileTable& files) {
  const std::string places = place_list(more, files);
  return fmt::format("... and {} more {}{}", more.count, code, places.empty() ? "" : " (" + places + ")");
}

std::string utf8_name(const FileTable& files, FileId id) {
  return to_utf8(files.name(id));
}

}  // namespace

std::string_view severity_text(Severity s) {
  switch (s) {
    case Severity::error: return "error";
    case Severity::warning: return "warning";
    case Severity::note: break;
  }
  return "note";
}

std::string render_text(const Diagnostic& d, const FileTable& files, bool colour) {
  std::string out;
  append_text(out, d, files, colour);
  return out;
}

std::string render_text(const Diagnostics& ds, const FileTable& files, bool colour) {
  std::string out;
  for (const Diagnostic& d : ds.all()) append_text(out, d, files, colour);
  for (const auto& [code, more] : ds.more()) out += more_text(code, more, files) + '\n';
  return out;
}

std::string render_json(const Diagnostics& ds, const FileTable& files) {
  auto list = nlohmann::ordered_json::array();
  for (const Diagnostic& d : ds.all()) {
    list.push_back({{"code", d.code},
                    {"severity", severity_text(d.severity)},
                    {"file", utf8_name(files, d.span.file)},
                    {"line", d.span.line},
                    {"column", d.span.column},
                    {"end_line", d.span.end_line},
                    {"end_column", d.span.end_column},
                    {"message", to_utf8(d.message)},
                    {"hint", to_utf8(d.hint)}});
  }
  for (const auto& [code, more] : ds.more()) {
    list.push_back({{"code", code},
                    {"severity", severity_text(more.severity)},
                    {"more", more.count},
                    {"message", more_text(code, more, files)}});
  }
  return list.dump(2) + '\n';
}

}  // namespace cnctrans
