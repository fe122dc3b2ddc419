#include "lsp/complete.h"

#include <algorithm>
#include <set>

#include "base/text.h"

namespace cnctrans::lsp {

namespace {

bool part_of_word(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '$';
}

/// Where the word begins that ends before a column.
std::size_t word_begin(std::string_view line, std::size_t end) {
  std::size_t begin = std::min(end, line.size());
  while (begin > 0 && part_of_word(line[begin - 1])) --begin;
  return begin;
}

bool called_with_brackets(const WordInfo& word) {
  return word.kind == WordKind::cycle && !word.word.starts_with("G") && !word.word.starts_with("CYCL ");
}

/// What is inserted for a cycle: its parameters as places to fill in.
std::string snippet_of(const WordInfo& word) {
  if (word.kind != WordKind::cycle || word.parameters.empty()) return {};
  std::string out = word.word;
  int place = 0;
  const auto hole = [&place](const std::string& text) { return "${" + std::to_string(++place) + ":" + text + "}"; };
  if (called_with_brackets(word)) {
    out += "(";
    for (const auto& p : word.parameters) {
      if (place != 0) out += ",";
      out += hole(p.name);
    }
    return out + ")";
  }
  if (word.word.starts_with("CYCL ")) {
    out += " " + to_upper_ascii(word.title);
    for (const auto& p : word.parameters)
      out += " ~\n    " + p.name + "=" + hole("+0") + " ;" + to_upper_ascii(p.meaning.substr(0, p.meaning.find(" (")));
    return out;
  }
  for (const auto& p : word.parameters) {
    if (p.needed) out += " " + p.name + hole("0");
  }
  return out;
}

/// The cycle whose brackets are open at the end of the text, and how many commas stand in them.
struct OpenCall {
  std::string word;
  std::size_t commas = 0;
};
std::optional<OpenCall> open_call(std::string_view text) {
  int depth = 0;
  std::size_t commas = 0;
  for (std::size_t i = text.size(); i-- > 0;) {
    if (text[i] == ')') ++depth;
    if (text[i] == ',' && depth == 0) ++commas;
    if (text[i] != '(') continue;
    if (depth-- > 0) continue;
    const std::size_t begin = word_begin(text, i);
    if (begin == i) return std::nullopt;
    return OpenCall{std::string(text.substr(begin, i - begin)), commas};
  }
  return std::nullopt;
}

}  // namespace

std::string usage_of(const WordInfo& word) {
  std::string out = word.word;
  if (called_with_brackets(word)) out += "(";
  bool first = true;
  for (const auto& p : word.parameters) {
    if (called_with_brackets(word)) {
      out += (first ? "" : ", ") + p.name;
    } else {
      out += p.needed ? " " + p.name : " [" + p.name + "]";
    }
    first = false;
  }
  return called_with_brackets(word) ? out + ")" : out;
}

std::string parameter_list(const WordInfo& word) {
  std::string out;
  for (const auto& p : word.parameters) {
    if (!p.meaning.empty())
      out += "- `" + p.name + "` " + p.meaning + (p.needed || called_with_brackets(word) ? "" : ", may be left out") +
             "\n";
  }
  return out;
}

const WordInfo* cycle_of_lines(const Analysis& analysis, const Document& document, std::uint32_t line) {
  constexpr std::string_view definition = "CYCL DEF ";
  while (line > 1 && trim(document.line(line - 1)).ends_with('~')) --line;
  const std::string text = to_upper_ascii(document.line(line));
  const auto at = text.find(definition);
  if (at == std::string::npos) return nullptr;
  const auto end = text.find_first_not_of("0123456789", at + definition.size());
  return analysis.language().find(text.substr(at, (end == std::string::npos ? text.size() : end) - at),
                                  analysis.lathe());
}

std::vector<Item> complete(Analysis& analysis, std::string_view line, std::uint32_t column) {
  std::vector<Item> out;
  const std::size_t end = std::min<std::size_t>(line.size(), column - 1), begin = word_begin(line, end);
  const std::string typed = to_upper_ascii(line.substr(begin, end - begin));
  for (const auto& w : analysis.language().words) {
    if (!(analysis.lathe() ? w.lathe : w.mill)) continue;
    if (!typed.empty() && !w.word.starts_with(typed)) continue;
    out.push_back({w.word, w.title.empty() ? usage_of(w) : w.title, parameter_list(w), snippet_of(w),
                   w.kind == WordKind::cycle ? ItemKind::cycle : ItemKind::word});
  }
  std::set<std::string> seen;
  for (const auto& n : analysis.names()) {
    if (!seen.insert(n.key).second) continue;
    if (n.kind == NameKind::label && !n.defines) continue;
    const ItemKind kind = n.kind == NameKind::label     ? ItemKind::label
                          : n.kind == NameKind::routine ? ItemKind::routine
                                                        : ItemKind::variable;
    out.push_back({n.shown,
                   n.kind == NameKind::label     ? "label"
                   : n.kind == NameKind::routine ? "subprogram"
                                                 : "variable",
                   "", "", kind});
  }
  return out;
}

std::optional<Signature> signature(const Analysis& analysis, std::string_view line, std::uint32_t column) {
  const std::string_view before = line.substr(0, std::min<std::size_t>(line.size(), column - 1));
  const auto call = open_call(before);
  if (call) {
    const WordInfo* word = analysis.language().find(call->word, analysis.lathe());
    if (word == nullptr || word->parameters.empty()) return std::nullopt;
    return Signature{usage_of(*word), word->title, word->parameters, call->commas};
  }
  for (std::size_t i = before.size(); i-- > 0;) {  // G81 Z2 I-: the last cycle of the block
    if (before[i] != 'G' && before[i] != 'g') continue;
    std::size_t end = i + 1;
    while (end < before.size() && before[end] >= '0' && before[end] <= '9') ++end;
    const WordInfo* word = analysis.language().find(before.substr(i, end - i), analysis.lathe());
    if (word == nullptr || word->kind != WordKind::cycle || word->parameters.empty()) continue;
    Signature s{usage_of(*word), word->title, word->parameters, word->parameters.size()};
    const std::size_t last = before.find_last_of(" ");
    const std::string_view typed = before.substr(last == std::string_view::npos ? 0 : last + 1);
    for (std::size_t p = 0; p < word->parameters.size(); ++p) {
      if (typed.starts_with(word->parameters[p].name)) s.active = p;
    }
    return s;
  }
  return std::nullopt;
}

}  // namespace cnctrans::lsp
