// A short notation of parsed blocks, for tests: `G1 X-10.5 [unary - L5]`.
#pragma once

#include <string>
#include <string_view>

#include "frontends/num/syntax/parse.h"

namespace cnctrans::frontends::num::testing {

/// Fully bracketed prefix-free form: (a+b), S(x), L5, [NAME](1,2).
inline std::string show(const syntax::Expr& e) {
  using syntax::ExprKind;
  const auto list = [&] {
    std::string s;
    for (const auto& a : e.args) s += (s.empty() ? "" : ",") + show(a);
    return s;
  };
  switch (e.kind) {
    case ExprKind::number: return e.text;
    case ExprKind::variable:
      if (e.text[0] == '[' || e.text[0] == '\'') return e.text + (e.args.empty() ? "" : "(" + list() + ")");
      return e.text + show(e.args.at(0));
    case ExprKind::unary: return "(" + e.text + show(e.args.at(0)) + ")";
    case ExprKind::binary: return "(" + show(e.args.at(0)) + e.text + show(e.args.at(1)) + ")";
    case ExprKind::call: return e.text + "{" + show(e.args.at(0)) + "}";
    case ExprKind::missing: return "_";
    default: return e.text;
  }
}

inline std::string show(const syntax::Statement& s) {
  std::string out = s.keyword + "<";
  for (const auto& c : s.children) out += show(c) + ";";
  for (std::size_t i = 0; i < s.args.size(); ++i) out += (i == 0 ? "" : ",") + show(s.args[i]);
  if (!s.text.empty()) out += "'" + s.text + "'";
  return out + ">";
}

inline std::string show(const syntax::Block& b) {
  std::string out;
  const auto add = [&](const std::string& s) { out += (out.empty() ? "" : " ") + s; };
  if (b.skip_mask != 0) add("/");
  if (!b.number.empty()) add("N" + std::string(b.number));
  std::size_t s = 0;
  for (const auto& w : b.words) {
    while (s < b.statements.size() && b.statements[s].pos.column < w.pos.column) add(show(b.statements[s++]));
    std::string t(w.address);
    t += w.is_expression ? "=" + show(b.exprs[static_cast<std::size_t>(w.expr)]) : "=" + std::string(w.number_text);
    if (!w.has_value) t += "?";
    add(t);
  }
  while (s < b.statements.size()) add(show(b.statements[s++]));
  for (const auto& c : b.comments) add("(" + std::string(c.text) + ")");
  return out;
}

inline std::string parse(std::string_view line, bool structured = true) {
  BlockParser parser(structured);
  syntax::Block b;
  ParseError e;
  if (!parser.parse(line, b, e)) return "error " + std::to_string(e.pos.column) + ": " + e.message;
  return show(b);
}

}  // namespace cnctrans::frontends::num::testing
