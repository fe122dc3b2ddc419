// Short notations for tests: parsed blocks (`G1 R1=(a+b)`) and lowered programs (textual IR).
#pragma once

#include <string>
#include <string_view>

#include "dialects/options.h"
#include "frontends/sinumerik/program/frontend.h"
#include "frontends/sinumerik/syntax/parse.h"
#include "ir/text/text.h"

namespace cnctrans::sinumerik::testing {

/// Fully bracketed: (a+b), SIN(x), R[5], -5 as (-5).
inline std::string show(const syntax::Expr& e) {
  using syntax::ExprKind;
  if (e.kind == ExprKind::binary) return "(" + show(e.args[0]) + " " + e.text + " " + show(e.args[1]) + ")";
  std::string list;
  for (const auto& a : e.args) list += (&a == e.args.data() ? "" : ",") + show(a);
  switch (e.kind) {
    case ExprKind::string: return '"' + e.text + '"';
    case ExprKind::variable: return e.text + (e.args.empty() ? "" : "[" + list + "]");
    case ExprKind::unary: return "(" + e.text + " " + list + ")";
    case ExprKind::call: return e.text + "(" + list + ")";
    case ExprKind::missing: return "_";
    default: return e.text + (e.args.empty() ? "" : "[" + list + "]");
  }
}

inline std::string show(const syntax::Statement& s) {
  std::string out = s.keyword + "<";
  for (std::size_t i = 0; i < s.args.size(); ++i) out += (i == 0 ? "" : ", ") + show(s.args[i]);
  if (!s.text.empty()) out += "'" + s.text + "'";
  for (const auto& c : s.children) out += " " + show(c);
  return out + ">";
}

inline std::string show(const syntax::Block& b) {
  std::string out;
  const auto add = [&](const std::string& s) { out += (out.empty() ? "" : " ") + s; };
  if (b.skip_mask != 0) add("/" + std::to_string(b.skip_mask));
  if (!b.number.empty()) add(std::string(1, b.number_mark) + std::string(b.number));
  for (const auto& l : b.labels) add(std::string(l) + ":");
  std::size_t s = 0;
  for (const auto& w : b.words) {
    while (s < b.statements.size() && b.statements[s].pos.column < w.pos.column) add(show(b.statements[s++]));
    std::string t(w.address);
    if (w.extension >= 0) t += "'" + std::to_string(w.extension);
    if (w.equals) t += "=";
    if (w.is_expression) t += show(b.exprs[static_cast<std::size_t>(w.expr)]);
    if (!w.is_expression && w.has_value) t += w.number_text;
    add(t);
  }
  while (s < b.statements.size()) add(show(b.statements[s++]));
  for (const auto& c : b.comments) add(";" + std::string(c.text));
  return out;
}

/// The block, or "!column message".
inline std::string parse(std::string_view line) {
  BlockParser p;
  syntax::Block b;
  ParseError e;
  if (p.parse_block(line, b, e)) return show(b);
  return "!" + std::to_string(e.column) + " " + e.message;
}

/// A file read for a machine, with what was said about it.
struct Read {
  ir::Program program;
  FileTable files;
  Diagnostics diagnostics;
  frontends::ReadStats stats;

  /// Codes of all diagnostics of this severity in order: "SIN-001 SIN-006".
  [[nodiscard]] std::string codes(Severity severity) const {
    std::string out;
    for (const auto& d : diagnostics.all()) {
      if (d.severity == severity) out += (out.empty() ? "" : " ") + d.code;
    }
    return out;
  }
  [[nodiscard]] std::string errors() const { return codes(Severity::error); }
  [[nodiscard]] std::string warnings() const { return codes(Severity::warning); }
};

inline Read read(std::string text, const std::string& machine = "sinumerik-mill", const std::string& file = "TEST.MPF",
                 const std::vector<std::pair<std::string, std::string>>& options = {}) {
  Read out;
  std::string error;
  auto profile = dialects::load_profile(machine, &error);
  for (const auto& [name, value] : options) dialects::options().set(*profile, name, value, &error);
  const SourcePtr source = SourceText::from_string(file, std::move(text));
  const FileId id = out.files.add(source);
  const frontends::ReadOptions read_options{frontends::Reader::both, &*profile};
  out.program = frontends::sinumerik::make_frontend()->read(source, id, read_options, out.diagnostics, &out.stats);
  return out;
}

/// The body of the only routine as textual IR, one line a statement, without numbers, comments and the writing of
/// words.
inline std::string body(std::string text, const std::string& machine = "sinumerik-mill") {
  const Read r = read(std::move(text), machine);
  std::string out;
  for (const auto& s : r.program.routines.at(0).body) {
    if (!out.empty()) out += '\n';
    out += ir::to_text(s, r.program);
  }
  while (!out.empty() && out.back() == '\n') out.pop_back();
  const std::string errors = r.errors();
  return errors.empty() ? out : "errors: " + errors;
}

}  // namespace cnctrans::sinumerik::testing
