#include "ir/cycles/profile_blocks.h"

#include <algorithm>
#include <cmath>

#include "base/saturate.h"
#include "ir/cycles/words.h"
#include "ir/edit/labels.h"

namespace cnctrans::ir::cycles {

namespace {

/// Key of a label word: a fixed block number or an identifier; empty: computed.
std::string key_of(const Value& v) {
  if (const auto* s = text_in(v)) return label_key(*s, false);
  const auto n = v.literal() ? std::optional(v.number) : constant_value(v.expr);
  if (!n || *n < 0 || *n != std::floor(*n) || *n > 1e15) return {};
  return label_key(std::to_string(saturate<std::int64_t>(*n)), true);
}
bool carries(const LineInfo& line, const std::string& key) {
  if (!line.number.empty() && label_key(line.number, true) == key) return true;
  return std::any_of(line.labels.begin(), line.labels.end(),
                     [&key](std::string_view l) { return label_key(l, false) == key; });
}
bool quiet(const Statement& s) {
  const auto* o = std::get_if<Opaque>(&s.node);
  return std::holds_alternative<Label>(s.node) || std::holds_alternative<Message>(s.node) ||
         (o != nullptr && o->harmless);
}

/// What has been gathered of a range.
struct Range {
  std::string first, last;  ///< keys; both empty: everything
  std::vector<const Statement*> blocks;
  bool begun = false, ended = false;
  const Statement* stranger = nullptr;

  void take(const Statement& s) {
    // All statements of the last line belong to the range.
    if (ended && !(s.line.joined && !blocks.empty() && s.line.span.line == blocks.back()->line.span.line)) return;
    begun = begun || first.empty() || carries(s.line, first);
    if (!begun) return;
    if (std::holds_alternative<Block>(s.node))
      blocks.push_back(&s);
    else if (!quiet(s) && !std::holds_alternative<Return>(s.node) && stranger == nullptr)
      stranger = &s;
    ended = ended || (!last.empty() && carries(s.line, last));
  }
  [[nodiscard]] bool complete() const { return begun && (ended || last.empty()); }
};

}  // namespace

ContourStart contour_start(const TurnNumbers& numbers, const ModalState& modal) {
  ContourStart start;
  start.modal = modal;
  const auto x = numbers.find("x"), z = numbers.find("z");
  if (x == numbers.end() || z == numbers.end()) return start;
  start.from = TurnPoint{x->second, z->second};
  start.rapid_begins_blank = true;
  return start;
}

bool is_text(const Value& value) {
  return text_in(value) != nullptr;
}

bool has_profile(const NamedCycle& cycle) {
  return find_word(cycle, "first_label") != nullptr || find_word(cycle, "routine") != nullptr;
}

std::optional<RoutineName> profile_routine(const NamedCycle& cycle) {
  RoutineName name;
  if (const Value* routine = find_word(cycle, "routine")) {
    const auto* text = text_in(*routine);
    if (text == nullptr) return std::nullopt;
    name.text = *text;
    return name;
  }
  const Value* number = find_word(cycle, "program");
  if (number == nullptr || !number->literal()) return std::nullopt;
  name.number = saturate<std::int64_t>(number->number);
  return name;
}

std::vector<const Statement*> profile_blocks(const Program& program, const Routine& caller, const NamedCycle& cycle,
                                             std::string* error) {
  error->clear();
  Range wanted;
  const Value *first = find_word(cycle, "first_label"), *last = find_word(cycle, "last_label");
  const Value *number = find_word(cycle, "program"), *routine = find_word(cycle, "routine");
  if (first != nullptr) {
    wanted.first = key_of(*first);
    wanted.last = last != nullptr ? key_of(*last) : wanted.first;
    if (wanted.first.empty() || wanted.last.empty()) {
      *error = "the labels of the profile are computed";
      return {};
    }
  }
  const auto fits = [&](const Routine& r) {
    if (number != nullptr) return number->literal() && double(r.name.number) == number->number;
    if (routine != nullptr) {
      const auto* name = text_in(*routine);
      return name != nullptr && !r.name.text.empty() && label_key(r.name.text, false) == label_key(*name, false);
    }
    return true;
  };
  const auto look = [&](const Routine& r) {
    Range range = wanted;
    for_each_statement(r.body, [&range](const Statement& s) { range.take(s); });
    return range;
  };
  std::optional<Range> found;
  if (number == nullptr && routine == nullptr) {
    Range range = look(caller);
    if (range.complete()) found = std::move(range);
  }
  for (const auto& r : program.routines) {
    if (found) break;
    if (!fits(r)) continue;
    Range range = look(r);
    if (range.complete()) found = std::move(range);
  }
  if (!found || found->blocks.empty()) {
    *error = "the blocks of the profile are not in the program";
    return {};
  }
  if (found->stranger != nullptr) {
    *error = "the profile holds a line that is no plain block";
    return {};
  }
  return found->blocks;
}

void put_contour(NamedCycle& cycle, const TurnProfile& profile) {
  for (const bool blank : {false, true}) {
    for (const auto& e : blank ? profile.blank : profile.part) {
      const double kind = e.arc ? (e.ccw ? 2 : 1) : 0;
      for (const double n : {blank ? 1.0 : 0.0, kind, e.from.x, e.from.z, e.to.x, e.to.z, e.centre.x, e.centre.z})
        cycle.words.emplace_back("contour", Value(n));
    }
  }
}

void put_contour_fault(NamedCycle& cycle, const std::string& why) {
  cycle.words.emplace_back("contour_fault", Value(string_literal(why)));
}

std::optional<TurnProfile> contour_in(const NamedCycle& cycle, std::string* error) {
  std::vector<double> n;
  for (const auto& [name, v] : cycle.words) {
    if (name == "contour" && v.literal()) n.push_back(v.number);
    if (const auto* why = text_in(v); why != nullptr && name == "contour_fault") *error = *why;
  }
  if (!error->empty()) return std::nullopt;
  if (n.empty()) return *error = "its profile has not been read", std::nullopt;
  TurnProfile out;
  for (std::size_t i = 0; i + numbers_per_element <= n.size(); i += numbers_per_element) {
    ProfileElement e{{n[i + 2], n[i + 3]}, {n[i + 4], n[i + 5]}, n[i + 1] != 0, n[i + 1] == 2, {n[i + 6], n[i + 7]}};
    (n[i] != 0 ? out.blank : out.part).push_back(e);
  }
  return out;
}

}  // namespace cnctrans::ir::cycles
