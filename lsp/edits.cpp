#include "lsp/edits.h"

#include <algorithm>
#include <map>

#include "base/nearest.h"
#include "base/text.h"

namespace cnctrans::lsp {

namespace {

bool is_identifier(std::string_view text) {
  const auto fits = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !text.empty() && (text[0] < '0' || text[0] > '9') && std::all_of(text.begin(), text.end(), fits);
}

/// The digits at the end of a name, and what stands before them.
std::pair<std::string, std::string> split_number(std::string_view name) {
  std::size_t digits = name.size();
  while (digits > 0 && name[digits - 1] >= '0' && name[digits - 1] <= '9') --digits;
  return {to_upper_ascii(name.substr(0, digits)), std::string(name.substr(digits))};
}

std::string key_of(const Occurrence& name, const std::string& shown) {
  if (name.kind == NameKind::routine) return "/" + to_upper_ascii(shown);
  if (name.kind == NameKind::label)
    return name.numbered ? "N" + split_number(shown).second : "." + to_upper_ascii(shown);
  return name.numbered ? to_upper_ascii(shown) : "." + to_upper_ascii(shown);
}

/// The text with the edits, which are in its order.
std::string with_edits(const Document& document, const std::vector<Edit>& edits) {
  Document copy = document;
  for (auto e = edits.rbegin(); e != edits.rend(); ++e) copy.edit(e->range, e->text);
  return copy.text();
}

/// Both texts move the machine the same way, or one of them can't be replayed at all.
bool same_program(const Analysis& analysis, const std::string& text) {
  translator::TranslateOptions options;
  options.from = options.to = analysis.dialect().name;
  options.verify = true;
  options.libraries = analysis.folders();
  const auto other = SourceText::from_string(analysis.source()->name(), text);
  const auto result = translator::verify(analysis.source(), {other}, options);
  return result.error.empty() && result.verdict.status != verifier::Status::differs;
}

std::vector<Edit> trimmed_ends(const Document& document) {
  std::vector<Edit> out;
  for (std::uint32_t n = 1; n <= document.line_count(); ++n) {
    const std::string_view line = document.line(n);
    const std::size_t end = line.find_last_not_of(" \t");
    const std::size_t keep = end == std::string_view::npos ? 0 : end + 1;
    if (keep == line.size()) continue;
    out.push_back({{document.position(n, static_cast<std::uint32_t>(keep + 1)),
                    document.position(n, static_cast<std::uint32_t>(line.size() + 1))},
                   ""});
  }
  return out;
}

/// Conversational blocks count from 0; nothing refers to their numbers.
std::vector<Edit> counted_blocks(const Document& document) {
  std::vector<Edit> out;
  int next = 0;
  for (std::uint32_t n = 1; n <= document.line_count(); ++n) {
    const std::string_view line = document.line(n);
    const std::size_t end = std::min(line.find_first_not_of("0123456789"), line.size());
    if (end == 0) continue;
    const std::string number = std::to_string(next++);
    if (line.substr(0, end) != number)
      out.push_back({{document.position(n, 1), document.position(n, static_cast<std::uint32_t>(end + 1))}, number});
  }
  return out;
}

/// New numbers by the order of the lines; nullopt, and why: a number stands twice.
std::optional<std::map<std::pair<int, std::string>, std::string>> new_numbers(const std::vector<Occurrence>& names,
                                                                              std::string& why) {
  std::map<std::pair<int, std::string>, std::string> out;
  int next = 0;  // in one row through the file
  for (const auto& n : names) {
    if (n.kind != NameKind::label || !n.numbered || !n.defines) continue;
    const std::string number = std::to_string(next += 10);
    if (out.emplace(std::pair(n.routine, n.key), number).second) continue;
    why = "block number " + n.shown + " stands twice: which one a jump means depends on where it looks first";
    return std::nullopt;
  }
  return out;
}

}  // namespace

Edits rename(Analysis& analysis, const Document& document, const Occurrence& name, const std::string& to) {
  Edits out;
  const auto [prefix, digits] = split_number(to);
  const auto [own_prefix, own_digits] = split_number(name.shown);
  std::string wanted = to;
  if (name.numbered) {
    const bool bare = prefix.empty() && !digits.empty();
    if (digits.empty() || (!bare && prefix != own_prefix)) {
      out.refused = name.shown + " is a number behind " + (own_prefix.empty() ? "nothing" : own_prefix) +
                    ": the new name must be one too";
      return out;
    }
    wanted = own_prefix + digits;
  } else if (!is_identifier(to)) {
    out.refused = "\"" + to + "\" is no name: letters, digits and _ make one, and a letter begins it";
    return out;
  }
  if (name.kind == NameKind::variable && name.numbered) {
    if (name.routine >= 0) {
      out.refused = name.shown + " belongs to a call: the letters of the call choose it by its number";
    } else if (has_computed_variables(analysis.program())) {
      out.refused = "a variable is chosen by a computed number: it may be " + name.shown;
    }
    if (!out.refused.empty()) return out;
  }
  const std::string key = key_of(name, wanted);
  const auto& all = analysis.names();
  if (key != name.key && std::any_of(all.begin(), all.end(), [&](const Occurrence& o) {
        return o.kind == name.kind && o.key == key && (o.routine == name.routine || o.routine < 0 || name.routine < 0);
      })) {
    out.refused = wanted + " is there already: two things would become one";
    return out;
  }
  for (const auto& o : all) {
    if (!same_name(o, name)) continue;
    std::string text = wanted;
    if (name.numbered) {  // what stands before the number stays as it is written
      const std::string_view written =
          document.line(o.span.line).substr(o.span.column - 1, o.span.end_column - o.span.column);
      const std::size_t first = written.find_first_of("0123456789");
      const std::size_t last = written.find_last_of("0123456789");
      text = std::string(written.substr(0, first)) + digits + std::string(written.substr(last + 1));
    }
    out.edits.push_back({document.range(o.span), text});
  }
  if (name.kind != NameKind::routine && !same_program(analysis, with_edits(document, out.edits)))
    out = {{}, "with the other name the program would do something else: a text or a cycle names " + name.shown};
  return out;
}

Edits format(Analysis& analysis, const Document& document) {
  Edits out;
  const auto& names = analysis.names();
  const auto is_number = [](const Occurrence& n) { return n.kind == NameKind::label && n.numbered && n.defines; };
  const bool by_n = analysis.language().numbered_by_n;
  std::vector<Edit> edits = by_n ? std::vector<Edit>() : counted_blocks(document);
  if (by_n && std::any_of(names.begin(), names.end(), is_number)) {
    if (has_computed_labels(analysis.program())) {
      out.refused = "a jump computes its label: the numbers of the blocks stay";
    } else if (const auto numbers = new_numbers(names, out.refused)) {
      for (const auto& n : names) {
        if (n.kind != NameKind::label || !n.numbered) continue;
        const auto found = numbers->find({n.routine, n.key});
        const std::string_view written =
            document.line(n.span.line).substr(n.span.column - 1, n.span.end_column - n.span.column);
        if (found == numbers->end() || written.substr(1) == found->second) continue;
        edits.push_back({document.range(n.span), std::string(written.substr(0, 1)) + found->second});
      }
      if (!edits.empty() && !same_program(analysis, with_edits(document, edits))) {
        edits.clear();
        out.refused = "with other numbers the program would do something else: a text or a cycle names them";
      }
    }
  }
  for (auto& e : trimmed_ends(document)) edits.push_back(std::move(e));
  std::stable_sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) {
    return std::pair(a.range.start.line, a.range.start.character) <
           std::pair(b.range.start.line, b.range.start.character);
  });
  out.edits = std::move(edits);
  return out;
}

std::vector<Fix> fixes(Analysis& analysis, const Document& document, const Diagnostic& diagnostic) {
  std::vector<Fix> out;
  if (!diagnostic.span.known()) return out;
  const std::string_view line = document.line(diagnostic.span.line);
  const auto of_word = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '$';
  };
  std::vector<std::string> known;
  for (const auto& w : analysis.language().words) {
    if (w.word.size() > 2) known.push_back(w.word);
  }
  for (const auto& n : analysis.names()) {
    if (n.defines || n.writes) known.push_back(n.shown);
  }
  const std::size_t from = std::max<std::size_t>(1, diagnostic.span.column) - 1;
  const std::size_t to = diagnostic.span.end_line > diagnostic.span.line
                             ? line.size()
                             : std::min<std::size_t>(line.size(), diagnostic.span.end_column);
  for (std::size_t i = from; i < to;) {
    std::size_t end = i;
    while (end < line.size() && of_word(line[end])) ++end;
    const std::string word = to_upper_ascii(line.substr(i, end - i));
    const bool looks = word.size() > 2 && (word[0] < '0' || word[0] > '9');
    if (looks &&
        std::none_of(known.begin(), known.end(), [&](const std::string& k) { return iequals_ascii(k, word); })) {
      if (const std::string better = nearest(word, known); !better.empty()) {
        const auto at = [&](std::size_t c) {
          return document.position(diagnostic.span.line, static_cast<std::uint32_t>(c + 1));
        };
        out.push_back({"Write " + better + " in place of " + word, {{{at(i), at(end)}, better}}});
      }
    }
    i = std::max(end, i + 1);
  }
  return out;
}

}  // namespace cnctrans::lsp
