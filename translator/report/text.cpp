// The report as Markdown, and the HTML page put together.
#include <fmt/format.h>

#include "base/markup.h"
#include "base/text.h"
#include "translator/report/data.h"
#include "translator/report/embedded.h"

namespace cnctrans::translator {

std::string_view report_text(std::string_view name) {
  for (std::size_t i = 0; i < report_texts_count; ++i) {
    if (report_texts[i].name == name) return report_texts[i].text;
  }
  return {};
}

namespace {

/// JSON inside a <script>: nothing in it may end the element.
std::string script_safe(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

/// In a table cell: no bars, no line ends, no markup.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : to_utf8(text)) {
    if (c == '\n' || c == '\r') {
      out += ' ';
    } else {
      if (c == '|' || c == '*' || c == '_' || c == '<' || c == '`' || c == '\\') out += '\\';
      out += c;
    }
  }
  return out;
}

std::string heading(const Report& r) {
  return r.refused ? "refused, nothing is written" : (r.verdict_text.empty() ? r.verdict : r.verdict_text);
}

void add_diagnostics(std::string& out, const Report& r) {
  if (r.diagnostics.empty()) {
    out += "Nothing to say: every line was carried as it is.\n";
    return;
  }
  out += "| line | | code | what | to do |\n|---|---|---|---|---|\n";
  for (const auto& d : r.diagnostics.all()) {
    const std::string place = d.span.known() ? fmt::format("{}:{}", r.files.name(d.span.file), d.span.line) : "";
    out += fmt::format("| {} | {} | {} | {} | {} |\n", cell(place), severity_text(d.severity), d.code, cell(d.message),
                       cell(d.hint));
  }
  for (const auto& [code, more] : r.diagnostics.more())
    out += fmt::format("| | {} | {} | {} more of this code | |\n", severity_text(more.severity), code, more.count);
}

std::string lines_text(const ToDo& item) {
  std::string text;
  std::uint32_t last = 0;
  for (const Span& s : item.places) {
    if (s.line == 0 || s.line == last) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(s.line);
    last = s.line;
  }
  return text;
}

void add_to_do(std::string& out, const Report& r) {
  out += "\n## To do\n\n| | code | times | lines | what | to decide |\n|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < r.to_do.size(); ++i) {
    const ToDo& item = r.to_do[i];
    out += fmt::format("| {} | {} | {} | {} | {} | {} |\n", i + 1, item.code, item.places.size(), lines_text(item),
                       cell(item.message), cell(item.hint));
  }
}

}  // namespace

std::string report_markdown(const Report& r) {
  std::string out = fmt::format("# {}: {} to {}\n\n", cell(r.source_name), r.from, r.to);
  out += fmt::format("Machines: {} to {}. Result: **{}**.\n\n", cell(r.source_machine), cell(r.target_machine),
                     cell(r.refused ? "refused" : r.verdict));
  out += "```text\n" + to_utf8(heading(r)) + (heading(r).ends_with('\n') ? "" : "\n") +
         "```\n\n## Lines of the source\n\n";
  out += "| status | lines |\n|---|---|\n";
  const auto n = r.counts();
  for (std::size_t i = 0; i < n.size(); ++i) {
    const auto status = static_cast<LineStatus>(i);
    if (n[i] != 0 || status != LineStatus::untranslated) out += fmt::format("| {} | {} |\n", name(status), n[i]);
  }
  if (!r.to_do.empty()) add_to_do(out, r);
  out += "\n## What has to be known\n\n";
  add_diagnostics(out, r);
  if (!r.targets.empty()) {
    out += "\n## Files written\n\n";
    for (const auto& f : r.targets) out += fmt::format("- {} ({} lines)\n", cell(f.name), f.lines.size());
  }
  return out;
}

std::string report_html(const Report& r) {
  const auto part = [&r](std::string_view mark) -> std::string {
    if (mark == "TITLE") return html_text(to_utf8(r.source_name) + ": " + r.from + " to " + r.to);
    if (mark == "DATA") return script_safe(report_data(r, true));
    return std::string(report_text(mark));
  };
  std::string page;
  std::string_view rest = report_text("page");
  while (!rest.empty()) {
    const auto open = rest.find("{{"), close = rest.find("}}", open);
    page += rest.substr(0, open);
    if (close == std::string_view::npos) break;
    page += part(rest.substr(open + 2, close - open - 2));
    rest.remove_prefix(close + 2);
  }
  return page;
}

}  // namespace cnctrans::translator
