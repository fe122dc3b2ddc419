// TextMate grammars from the same tables.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "lsp/server.h"
#include "lsp/words/words.h"

namespace cnctrans::lsp {

namespace {

using nlohmann::ordered_json;

/// "\\b(A|B)\\b" of the words of a kind, the longer ones first; empty: there are none.
std::string any_of_words(const Language& language, WordKind kind, bool codes) {
  std::vector<std::string> words;
  for (const auto& w : language.words) {
    const bool code =
        (w.word[0] == 'G' || w.word[0] == 'M') && w.word.size() > 1 && w.word[1] >= '0' && w.word[1] <= '9';
    if (w.kind != kind || code != codes) continue;
    std::string pattern;
    for (const char c : w.word)
      pattern += c == ' ' ? std::string("\\s+") : c == '<' || c == '>' ? std::string(1, c) : std::string(1, c);
    words.push_back(pattern);
  }
  std::sort(words.begin(), words.end(),
            [](const auto& a, const auto& b) { return a.size() != b.size() ? a.size() > b.size() : a < b; });
  words.erase(std::unique(words.begin(), words.end()), words.end());
  std::string out;
  for (const auto& w : words) out += (out.empty() ? "" : "|") + w;
  return out.empty() ? out : "(?i)(?<![A-Z0-9_])(" + out + ")(?![A-Z_0-9])";
}

}  // namespace

std::string text_mate_grammar(const std::string& dialect) {
  const Language* l = language(dialect);
  if (l == nullptr) return {};
  ordered_json patterns = ordered_json::array();
  const auto match = [&patterns, &dialect](const std::string& pattern, const char* name) {
    if (!pattern.empty()) patterns.push_back({{"name", std::string(name) + "." + dialect}, {"match", pattern}});
  };
  if (l->message_lines) match("^\\s*\\$.*$", "string.unquoted");
  if (!l->line_comment.empty()) match(std::string(l->line_comment) + ".*$", "comment.line");
  if (!l->comment_open.empty()) match("\\([^)]*\\)?", "comment.block");
  match("\"[^\"]*\"?", "string.quoted.double");
  match(l->numbered_by_n ? "(?i)^\\s*/?[0-9]?\\s*[N:][0-9]+" : "^\\s*/?[0-9]+", "entity.name.tag.block-number");
  match("^\\s*%.*$", "entity.name.section");
  match(any_of_words(*l, WordKind::cycle, false), "support.function.cycle");
  match(any_of_words(*l, WordKind::keyword, false), "keyword.control");
  match(any_of_words(*l, WordKind::function, false), "support.function");
  match(any_of_words(*l, WordKind::code, false), "keyword.other");
  match("(?i)(?<![A-Z_])G[0-9]+(\\.[0-9]+)?", "keyword.other.g-code");
  match("(?i)(?<![A-Z_])M[0-9]+", "keyword.other.m-code");
  const std::string before = l->variable_letters.empty() ? "(?<![A-Z0-9_])" : "";
  match("(?i)" + before + "(" + std::string(l->variables) + ")", "variable.other");
  match("(?i)(?<![A-Z])N[0-9]+", "entity.name.tag.label");
  match("[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)", "constant.numeric");
  match("(?i)(?<![A-Z0-9_])[A-Z]{1,2}(?![A-Z_])", "variable.parameter.address");
  const ordered_json grammar = {
      {"$schema", "https://raw.githubusercontent.com/martinring/tmlanguage/master/tmlanguage.json"},
      {"name", dialect},
      {"scopeName", "source." + dialect},
      {"patterns", patterns}};
  return grammar.dump(2) + "\n";
}

}  // namespace cnctrans::lsp
