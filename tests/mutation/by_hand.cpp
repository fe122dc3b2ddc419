#include "tests/mutation/by_hand.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "base/text.h"
#include "tests/language/markdown.h"
#include "tests/mutation/trial.h"
#include "tests/splice/watch.h"

namespace cnctrans::mutation {

namespace {

struct Case {
  std::string danger, expected;
  std::vector<std::pair<std::string, std::string>> edits;
};

std::string unescaped(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool line_end = text.compare(i, 2, "\\n") == 0;
    out += line_end ? '\n' : text[i];
    if (line_end) ++i;
  }
  return out;
}

/// `- `old` -> `new``, and `danger: medium`.
Case read_case(const testing::Section& s) {
  Case c;
  for (const auto& line : s.lines) {
    const auto value = [&line](const char* key) {
      const std::string head = std::string(key) + ": ";
      return line.rfind(head, 0) == 0 ? line.substr(head.size()) : "";
    };
    if (const auto v = value("danger"); !v.empty()) c.danger = v;
    if (const auto v = value("expected"); !v.empty()) c.expected = v;
    const auto middle = line.find("` -> `");
    if (line.rfind("- `", 0) == 0 && middle != std::string::npos)
      c.edits.emplace_back(unescaped(line.substr(3, middle - 3)),
                           unescaped(line.substr(middle + 6, line.rfind('`') - middle - 6)));
  }
  return c;
}

std::string name_of(Fate f) {
  switch (f) {
    case Fate::no_place: return "has no place";
    case Fate::nothing: return "changes nothing";
    case Fate::no_run: return "no longer runs";
    case Fate::caught: return "caught";
    case Fate::documented: return "documented";
    case Fate::undocumented: return "passes";
  }
  return {};
}

/// The whole text before and behind all edits as one fault.
std::optional<Fault> fault_of(const Translated& t, const Case& c, std::string& missing) {
  std::string text = text_of(t.lines);
  for (const auto& [old, now] : c.edits) {
    const auto at = text.find(old);
    if (old.empty() || at == std::string::npos) {
      missing = old;
      return std::nullopt;
    }
    text.replace(at, old.size(), now);
  }
  Fault f{"by hand", t.lines, {}, 0};
  for (std::size_t from = 0; from < text.size();) {
    const auto end = std::min(text.find('\n', from), text.size());
    f.after.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return f;
}

}  // namespace

int by_hand(const std::string& root, const std::string& only) {
  std::map<std::string, std::map<std::string, int>> figures;
  int wrong = 0;
  for (const auto& path : testing::files_below(root + "/tests/mutation/by-hand", {".md"})) {
    if (path.find(only) == std::string::npos) continue;
    std::optional<Translated> translation;
    std::string source = "there is no source";
    for (const auto& s : testing::read_markdown(path)) {
      const std::string place = path.substr(root.size() + 1) + ":" + std::to_string(s.line) + ": " + s.heading;
      if (s.level == 1 || s.heading.rfind("source", 0) == 0) {
        if (!s.has_fence) continue;
        std::string direction;
        bool lathe = false;
        for (const auto& line : s.lines) {
          if (line.rfind("direction: ", 0) == 0) direction = line.substr(11);
          if (line == "machine: lathe") lathe = true;
        }
        const auto dash = direction.find('-');
        source = place;
        if (dash == std::string::npos) continue;
        const auto program = splice::framed(direction.substr(0, dash), lathe, s.fence);
        splice::begins(place, program.text());
        translation = translated(program, direction.substr(dash + 1));
        continue;
      }
      const Case c = read_case(s);
      const auto fail = [&](const std::string& why) {
        std::printf("%s: %s\n", place.c_str(), why.c_str());
        ++wrong;
      };
      if (!translation) {
        fail("no verified translation of " + source);
        continue;
      }
      std::string missing;
      const auto fault = fault_of(*translation, c, missing);
      if (!fault || c.edits.empty() || c.danger.empty()) {
        fail("the translation has no `" + missing + "`:\n" + text_of(translation->lines));
        continue;
      }
      splice::begins(place, text_of(fault->after));
      const Outcome o = tried(*translation, *fault);
      ++figures[c.danger][name_of(o.fate)];
      if (c.expected == "passes" && (o.fate == Fate::caught || o.fate == Fate::documented))
        std::printf("%s: is %s now\n", place.c_str(), name_of(o.fate).c_str());
      else if (c.expected != name_of(o.fate))
        fail(name_of(o.fate) + ", not " + c.expected + (o.what.empty() ? "" : " (" + o.what + ")") + "\n  " + o.said);
    }
  }
  std::printf("%-12s %8s %10s %8s %8s\n", "danger", "caught", "documented", "passes", "other");
  for (auto& [danger, f] : figures) {
    int sum = 0;
    for (const auto& [name, n] : f) sum += n;
    std::printf("%-12s %8d %10d %8d %8d\n", danger.c_str(), f["caught"], f["documented"], f["passes"],
                sum - f["caught"] - f["documented"] - f["passes"]);
  }
  return wrong;
}

}  // namespace cnctrans::mutation
