#include "interpreter/values/variables.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text.h"
#include "interpreter/trace/json_text.h"
#include "interpreter/trace/run_codes.h"
#include "ir/text/texts.h"

namespace cnctrans::interpreter {

const NumberedSpace::Number* NumberedSpace::find(double n) const {
  if (!(n >= 0) || n >= static_cast<double>(numbers.size()) || n != std::floor(n)) return nullptr;
  const auto& found = numbers[static_cast<std::size_t>(n)];
  return found.where == Where::none ? nullptr : &found;
}

void NamedVariable::shape(ir::Type t, std::vector<std::uint32_t> dims) {
  type = t;
  dimensions = std::move(dims);
  std::size_t count = 1;
  for (const auto d : dimensions) count *= d;
  number.assign(is_text() ? 0 : count, 0);
  text.assign(is_text() ? count : 0, {});
  frame.assign(is_frame() ? count : 0, {});
  set.assign(count, 0);
}

double stored(ir::Type type, double value) {
  if (type == ir::Type::integer) return std::round(value);
  if (type == ir::Type::boolean) return value != 0 ? 1 : 0;
  return value;
}

std::vector<NumberedSpace*> Variables::add_program(const ir::Program& program) {
  std::vector<NumberedSpace*> map;
  for (const auto& s : program.spaces) {
    if (s.named()) {
      map.push_back(nullptr);
      continue;
    }
    auto* space = numbered(s.prefix);
    if (space == nullptr) {
      space = &spaces_.emplace_back();
      space->prefix = s.prefix;
      space->type = s.type;
      space->starts_at_zero = s.starts_at_zero;
    }
    std::uint32_t levels = 0;
    for (const auto& segment : s.segments) {
      const auto hi = std::min(segment.hi, largest_number);
      if (hi >= static_cast<std::int64_t>(space->numbers.size()))
        space->numbers.resize(static_cast<std::size_t>(hi) + 1);
      const bool level = segment.scope == ir::Scope::level || segment.scope == ir::Scope::routine;
      for (auto n = std::max<std::int64_t>(segment.lo, 0); n <= hi; ++n) {
        auto& number = space->numbers[static_cast<std::size_t>(n)];
        if (number.where != NumberedSpace::Where::none) continue;
        number.where = level ? NumberedSpace::Where::level : NumberedSpace::Where::global;
        number.read_only = segment.read_only;
        number.given = segment.read_only || segment.zero_points;
      }
      if (level) levels = std::max(levels, static_cast<std::uint32_t>(hi) + 1);
    }
    space->value.resize(space->numbers.size(), 0);
    space->set.resize(space->numbers.size(), 0);
    if (levels > space->level_count) {
      space->level_base = level_size_;
      space->level_count = levels;
      level_size_ += levels;
      for (auto& l : levels_) {
        l->value.resize(level_size_, 0);
        l->set.resize(level_size_, 0);
      }
    }
    map.push_back(space);
  }
  return map;
}

NumberedSpace* Variables::numbered(std::string_view prefix) {
  const auto it = std::find_if(spaces_.begin(), spaces_.end(), [&](const auto& s) { return s.prefix == prefix; });
  return it == spaces_.end() ? nullptr : &*it;
}

NumberedSpace* Variables::level_space() {
  const auto it = std::find_if(spaces_.begin(), spaces_.end(), [](const auto& s) { return s.level_count > 0; });
  return it == spaces_.end() ? nullptr : &*it;
}

NamedVariable& Variables::global(const std::string& name, ir::Type type) {
  if (const auto it = global_names_.find(name); it != global_names_.end()) return *it->second;
  auto& v = globals_.emplace_back();
  v.name = name;
  v.shape(type, {});
  global_names_.emplace(name, &v);
  apply_presets(v);
  return v;
}

std::optional<double> preset_number(std::string_view text) {
  if (iequals_ascii(text, "true")) return 1;
  if (iequals_ascii(text, "false")) return 0;
  if (const auto x = parse_decimal(text)) return x;
  // A number as other programs print it: 1e+05.
  const auto first = text.find_first_not_of("+-");
  if (first == std::string_view::npos || first > 1 || text[first] < '0' || text[first] > '9') return std::nullopt;
  double x = 0;
  if (text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return x;
}

namespace {
/// A name in brackets is the name.
std::string_view bare(std::string_view name) {
  return name.size() > 2 && name.front() == '[' && name.back() == ']' ? name.substr(1, name.size() - 2) : name;
}
}  // namespace

void Variables::preset(const std::string& name, const std::string& value) {
  presets_.push_back({name, value, false, true});
  for (auto& v : globals_) apply_presets(v);
}

void Variables::apply_presets(NamedVariable& v) {
  for (auto& [name, value, found, fits] : presets_) {
    for (std::size_t i = 0; i < v.set.size(); ++i) {
      if (!iequals_ascii(bare(element_name(v, i)), bare(name))) continue;
      found = true;
      Place p;
      p.named = &v;
      p.index = static_cast<std::uint32_t>(i);
      v.declared = true;
      const auto x = preset_number(value);
      if (v.is_text()) {
        assign(p, value);
      } else if (x) {
        assign(p, *x);
      } else {
        fits = false;
      }
    }
  }
}

bool Variables::place(NumberedSpace& space, double n, Place& out) {
  const auto* number = space.find(n);
  if (number == nullptr) {
    return failure_.fail(code::no_variable, "there is no variable " + space.prefix + shortest(n));
  }
  out = Place{};
  out.space = &space;
  out.index = static_cast<std::uint32_t>(n);
  if (number->where == NumberedSpace::Where::level) out.level = levels_.back().get();
  return true;
}

double Variables::number(const Place& p) {
  if (p.named != nullptr) return p.named->number[p.index];
  return p.level != nullptr ? p.level->value[p.space->level_base + p.index] : p.space->value[p.index];
}

const std::string& Variables::text(const Place& p) {
  return p.named->text[p.index];
}

void Variables::assign(const Place& p, double value) {
  if (p.named != nullptr) {
    p.named->number[p.index] = stored(p.named->type, value);
    p.named->set[p.index] = 1;
  } else if (p.level != nullptr) {
    p.level->value[p.space->level_base + p.index] = stored(p.space->type, value);
    p.level->set[p.space->level_base + p.index] = 1;
  } else {
    p.space->value[p.index] = stored(p.space->type, value);
    p.space->set[p.index] = 1;
  }
}

void Variables::assign(const Place& p, std::string value) {
  p.named->text[p.index] = ir::ended_text(std::move(value));
  p.named->set[p.index] = 1;
}

bool Variables::store(const Place& p, double value) {
  if (p.named != nullptr && !p.named->is_text()) {
    constexpr double lowest = -2147483648.0, highest = 2147483647.0;
    const double kept = stored(p.named->type, value);
    const auto& limits = p.named->limits;
    const bool whole = p.named->type == ir::Type::integer;
    if ((whole && (kept < lowest || kept > highest)) || kept < limits.low || kept > limits.high) {
      const std::string low = shortest(whole ? std::max(limits.low, lowest) : limits.low);
      const std::string high = shortest(whole ? std::min(limits.high, highest) : limits.high);
      const std::string takes = std::isinf(limits.low) && !whole    ? "at most " + high
                                : std::isinf(limits.high) && !whole ? "at least " + low
                                                                    : low + " to " + high;
      return failure_.fail(code::value_limits, p.named->name + " takes " + takes + "; its new value would be " +
                                                   cnctrans::rounded(kept, 10));
    }
  }
  assign(p, value);
  return true;
}

void Variables::store(const Place& p, std::string value) {
  const std::size_t length = p.named->limits.length;
  if (value.size() > length) {
    value.resize(length);
    const auto same = [&](const Cut& c) { return c.name == p.named->name; };
    if (std::none_of(cuts_.begin(), cuts_.end(), same)) cuts_.push_back({failure_.where, p.named->name, length});
  }
  assign(p, std::move(value));
}

void Variables::note_unset(const NumberedSpace& space, std::uint32_t n) {
  if (space.starts_at_zero || space.numbers[n].given) return;
  std::string name = space.prefix + std::to_string(n);
  if (std::find(read_first_.begin(), read_first_.end(), name) == read_first_.end())
    read_first_.push_back(std::move(name));
}

void Variables::note_unset(const NamedVariable& v) {
  if (v.declared || v.is_text() || v.is_frame() || !v.dimensions.empty()) return;
  if (v.name.find(' ') != std::string::npos) return;  // a reader's own
  if (std::find(read_first_.begin(), read_first_.end(), v.name) == read_first_.end()) read_first_.push_back(v.name);
}

void Variables::note_read(const Place& p) {
  if (p.named != nullptr) {
    if (p.named->set[p.index] != 0) return;
    // What a routine calls its own is no global, though the caller's may be meant by it.
    if (std::any_of(globals_.begin(), globals_.end(), [&p](const auto& v) { return &v == p.named; }))
      note_unset(*p.named);
  } else if (p.level != nullptr) {
    if (p.level->set[p.space->level_base + p.index] == 0 && p.level->depth == 0) note_unset(*p.space, p.index);
  } else if (p.space->set[p.index] == 0) {
    note_unset(*p.space, p.index);
  }
}

void Variables::push_level() {
  std::unique_ptr<Level> level;
  if (spare_.empty()) {
    level = std::make_unique<Level>();
  } else {
    level = std::move(spare_.back());
    spare_.pop_back();
  }
  level->value.assign(level_size_, 0);
  level->set.assign(level_size_, 0);
  level->depth = static_cast<std::uint32_t>(levels_.size());
  level->arguments = 0;
  levels_.push_back(std::move(level));
}

void Variables::pop_level() {
  archive(*levels_.back());
  spare_.push_back(std::move(levels_.back()));
  levels_.pop_back();
}

void Variables::archive(const Level& level) {
  for (std::uint32_t i = 0; i < level.set.size(); ++i) {
    if (level.set[i] != 0) left_levels_[{level.depth, i}] = level.value[i];
  }
}

void Variables::leave(const Locals& locals, std::uint32_t depth) {
  for (const auto& l : locals) {
    if (l.reference) continue;
    report_named(l.own, [&](const std::string& name, std::string value) {
      left_locals_[{depth, name}] = std::move(value);
    });
  }
}

std::vector<std::pair<std::string, std::string>> Variables::report() const {
  std::vector<std::pair<std::string, std::string>> out;
  auto levels = left_levels_;
  for (const auto& l : levels_) {
    for (std::uint32_t i = 0; i < l->set.size(); ++i) {
      if (l->set[i] != 0) levels[{l->depth, i}] = l->value[i];
    }
  }
  const auto at_depth = [](std::string name, std::uint32_t depth) {
    return depth == 0 ? name : name + "@" + std::to_string(depth);
  };
  for (const auto& s : spaces_) {
    for (const auto& [key, value] : levels) {
      const auto [depth, place] = key;
      if (place < s.level_base || place >= s.level_base + s.level_count) continue;
      out.emplace_back(at_depth(s.prefix + std::to_string(place - s.level_base), depth), json_number(value));
    }
    for (std::size_t n = 0; n < s.set.size(); ++n) {
      if (s.set[n] != 0) out.emplace_back(s.prefix + std::to_string(n), json_number(s.value[n]));
    }
  }
  for (const auto& v : globals_) {
    if (v.name.find(' ') != std::string::npos) continue;  // a reader's own: no program can name it
    report_named(v, [&](std::string name, std::string value) { out.emplace_back(std::move(name), std::move(value)); });
  }
  for (const auto& [key, value] : left_locals_) out.emplace_back(at_depth(key.second, key.first), value);
  return out;
}

std::string json_number(double value) {
  std::string s;
  append_json_number(s, value);
  return s;
}

std::string json_text(std::string_view text) {
  std::string s;
  append_json_text(s, text);
  return s;
}

std::string element_name(const NamedVariable& v, std::size_t index) {
  if (v.dimensions.empty()) return v.name;
  std::string list;
  for (std::size_t i = v.dimensions.size(); i-- > 0;) {
    list = std::to_string(index % v.dimensions[i]) + (list.empty() ? "" : "," + list);
    index /= v.dimensions[i];
  }
  return v.name + "[" + list + "]";
}

}  // namespace cnctrans::interpreter
