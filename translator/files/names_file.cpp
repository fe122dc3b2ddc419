#include "translator/files/names_file.h"

#include <nlohmann/json.hpp>

#include "base/source.h"
#include "base/text.h"
#include "translator/files/registry.h"

namespace cnctrans::translator {

namespace {

using Json = nlohmann::ordered_json;
constexpr std::string_view format = "cnctrans-names-1";

bool no_answer(const Json& j) {
  return j.is_null() || (j.is_string() && j.get_ref<const std::string&>().empty());
}

std::string dumped(const Json& j) {
  return j.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// A number or a text as text; nullopt: something else.
std::optional<std::string> word_of(const Json& j) {
  if (j.is_string()) return j.get<std::string>();
  if (j.is_number_unsigned()) return std::to_string(j.get<std::uint64_t>());
  return std::nullopt;
}

class Reader {
 public:
  Reader(const Json& file, Names& names, std::string* error) : file_(file), names_(names), error_(error) {}

  bool run() {
    return texts("programs", false, names_.map.programs) && routines() &&
           texts("variables", true, names_.map.variables) && texts("data", true, names_.map.data) && sizes();
  }

 private:
  bool fail(std::string why) {
    *error_ = std::move(why);
    return false;
  }
  /// Calls `entry(key, value)` for each entry of a part; one without an answer is kept for the next text of the file.
  template <class Entry>
  bool part(const char* key, bool capitals, const Entry& entry) {
    const auto part = file_.find(key);
    if (part == file_.end()) return true;
    if (!part->is_object()) return fail(std::string("\"") + key + "\" is no object");
    for (const auto& [from, to] : part->items()) {
      const std::string name = capitals ? to_upper_ascii(from) : from;
      if (no_answer(to)) {
        names_.by_hand[key][name] = dumped(to);
      } else if (!entry(name, to)) {
        return false;
      }
    }
    return true;
  }

  /// A part of the map: every value is a text. Names of routines and variables are the same in capitals.
  bool texts(const char* key, bool capitals, std::map<std::string, std::string>& out) {
    return part(key, capitals, [&](const std::string& from, const Json& to) {
      if (!to.is_string()) return fail(std::string("\"") + key + "\": the name given to \"" + from + "\" is no text");
      out[from] = to.get<std::string>();
      return true;
    });
  }

  bool routines() {
    return part("routines", true, [this](const std::string& name, const Json& j) {
      if (const auto word = word_of(j)) {
        names_.map.routines[name] = *word;
        return true;
      }
      if (!j.is_object()) return fail("\"routines\": what is said of \"" + name + "\" is no text, number or object");
      names_.by_hand["routines"][name] = dumped(j);
      return routine(name, j);
    });
  }
  bool routine(const std::string& name, const Json& j) {
    OutsideRoutine says;
    bool answered = false;
    for (const auto& [key, value] : j.items()) {
      if (no_answer(value)) continue;
      if (key == "number" || key == "name") {
        const auto word = word_of(value);
        if (!word) return fail("\"" + key + "\" of " + name + " is no number or text");
        names_.map.routines[name] = *word;
      } else if (key == "keeps_state") {
        if (!value.is_boolean()) return fail("\"keeps_state\" of " + name + " is true or false");
        says.keeps_state = value.get<bool>();
        answered = true;
      } else if (key == "arguments") {
        if (!arguments(name, value, says)) return false;
        answered = answered || !says.arguments.empty();
      } else {
        return fail("\"" + key + "\" of " + name + " is not known: number, name, keeps_state, arguments");
      }
    }
    if (answered) names_.outside[name] = std::move(says);
    return true;
  }
  bool arguments(const std::string& name, const Json& j, OutsideRoutine& says) {
    if (!j.is_array() && !j.is_object())
      return fail("\"arguments\" of " + name + " is a list, or an object by letters, of variables of the target");
    for (const auto& [key, value] : j.items()) {
      if (!no_answer(value) && !value.is_string())
        return fail("\"arguments\" of " + name + ": a variable of the target is wanted, as in \"P120\"");
      const std::string to = value.is_string() ? value.get<std::string>() : std::string();
      says.arguments.emplace_back(j.is_array() ? std::string() : to_upper_ascii(key), to);
      // No variable of a program may get that number.
      if (!to.empty()) names_.map.data['=' + name + '/' + std::to_string(says.arguments.size())] = to;
    }
    return true;
  }

  bool sizes() {
    return part("sizes", true, [this](const std::string& name, const Json& j) {
      auto& list = names_.sizes[name];
      if (!j.is_array()) return fail("\"sizes\" of " + name + " is a list such as [10] or [3, 2], or [] for one value");
      constexpr std::int64_t largest = 100'000;
      for (const auto& n : j) {
        if (!n.is_number_unsigned() || n.get<std::uint64_t>() < 1 || n.get<std::uint64_t>() > largest)
          return fail("\"sizes\" of " + name + ": a count from 1 to " + std::to_string(largest) + " is wanted");
        list.push_back(n.get<std::int64_t>());
      }
      names_.by_hand["sizes"][name] = dumped(j);
      return true;
    });
  }

  const Json& file_;
  Names& names_;
  std::string* error_;
};

std::string text_at(const Json& file, const char* key) {
  const auto it = file.find(key);
  return it != file.end() && it->is_string() ? it->get<std::string>() : std::string();
}

}  // namespace

std::optional<Names> parse_names(std::string_view text, std::string_view from, std::string_view to,
                                 std::string* error) {
  const Json file = Json::parse(text.begin(), text.end(), nullptr, false);
  if (!file.is_object() || text_at(file, "format") != format) {
    *error = "this is no file of names (\"format\": \"" + std::string(format) + "\" is missing)";
    return std::nullopt;
  }
  if (text_at(file, "from") != from || text_at(file, "to") != to) {
    *error = "its names are for --from " + text_at(file, "from") + " --to " + text_at(file, "to");
    return std::nullopt;
  }
  Names names;
  if (!Reader(file, names, error).run()) return std::nullopt;
  return names;
}

std::optional<Names> read_names(const std::string& path, std::string_view from, std::string_view to,
                                std::string* error) {
  const SourcePtr text = SourceText::open(path, error);
  auto found = text ? parse_names(text->text(), from, to, error) : std::nullopt;
  if (!found) *error = path + ": " + *error;
  return found;
}

std::string names_text(const Names& names, std::string_view from, std::string_view to) {
  Json file{{"format", format}, {"from", from}, {"to", to}};
  const auto part = [&](const char* key, const std::map<std::string, std::string>& texts, bool always) {
    std::map<std::string, Json> entries;
    for (const auto& [name, text] : texts) {
      if (name.front() != '=') entries[name] = text;
    }
    if (const auto it = names.by_hand.find(key); it != names.by_hand.end()) {
      for (const auto& [name, text] : it->second) entries[name] = Json::parse(text, nullptr, false);
    }
    if (always || !entries.empty()) file[key] = Json(entries);
  };
  part("programs", names.map.programs, true);
  part("routines", names.map.routines, true);
  part("variables", names.map.variables, true);
  part("data", names.map.data, false);
  part("sizes", {}, false);
  return file.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void add_names(ir::NameMap& names, const ir::NameMap& more) {
  names.programs.insert(more.programs.begin(), more.programs.end());
  names.routines.insert(more.routines.begin(), more.routines.end());
  names.variables.insert(more.variables.begin(), more.variables.end());
  names.data.insert(more.data.begin(), more.data.end());
}

std::size_t add_questions(Names& names, const std::vector<Question>& questions) {
  std::size_t added = 0;
  for (const auto& q : questions) {
    const char* part = q.kind == Question::Kind::routine ? "routines"
                       : q.kind == Question::Kind::datum ? "data"
                                                         : "sizes";
    auto& entries = names.by_hand[part];
    const bool known = entries.count(q.name) != 0 || names.map.routines.count(q.name) != 0 ||
                       names.map.data.count(q.name) != 0 || names.sizes.count(q.name) != 0;
    if (known) continue;
    ++added;
    if (q.kind != Question::Kind::routine) {
      entries[q.name] = q.kind == Question::Kind::datum ? "\"\"" : "null";
      continue;
    }
    Json entry{{"number", nullptr}, {"keeps_state", nullptr}};
    const bool letters = !q.arguments.empty() && !q.arguments.front().empty();
    Json list = letters ? Json::object() : Json::array();
    for (const auto& a : q.arguments) {
      if (letters) {
        list[a] = "";
      } else {
        list.push_back("");
      }
    }
    if (!q.arguments.empty()) entry["arguments"] = std::move(list);
    entries[q.name] = dumped(entry);
  }
  return added;
}

SourcePtr definitions_of(const Names& names, std::string_view from, const std::string& path, std::string* error) {
  if (names.sizes.empty()) return nullptr;
  const Dialect* dialect = find_dialect(from);
  if (dialect == nullptr || dialect->definition == nullptr) {
    *error = path + ": \"sizes\" are of names that a machine defines for all its programs; " + std::string(from) +
             " has none";
    return nullptr;
  }
  std::string text;
  for (const auto& [name, sizes] : names.sizes) text += dialect->definition(name, sizes) + '\n';
  return SourceText::from_string(path, text);
}

}  // namespace cnctrans::translator
