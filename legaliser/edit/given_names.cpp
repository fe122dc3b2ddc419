#include "legaliser/edit/given_names.h"

#include "base/text.h"

namespace cnctrans::ir::passes {

namespace {

struct Numbers {
  std::string prefix;
  std::int64_t first = 0, last = 0;
};

/// "P105": letters and number.
std::optional<Numbers> one_number(std::string_view text) {
  const auto digit = text.find_first_of("0123456789");
  if (digit == 0 || digit == std::string_view::npos || text.size() - digit > 9) return std::nullopt;
  if (text.find_first_not_of("0123456789", digit) != std::string_view::npos) return std::nullopt;
  const auto n = static_cast<std::int64_t>(parse_decimal(text.substr(digit)).value_or(-1));
  return Numbers{to_upper_ascii(text.substr(0, digit)), n, n};
}

/// "P105" or "R20..R29".
std::optional<Numbers> numbers_of(std::string_view text) {
  const auto dots = text.find("..");
  if (dots == std::string_view::npos) return one_number(text);
  auto first = one_number(text.substr(0, dots));
  const auto last = one_number(text.substr(dots + 2));
  constexpr std::int64_t longest = 100'000;
  if (!first || !last || first->prefix != last->prefix || last->first < first->first ||
      last->first - first->first > longest)
    return std::nullopt;
  first->last = last->first;
  return first;
}

}  // namespace

std::string name_in_map(const std::string& name) {
  const auto at = name.find('@');
  if (at == std::string::npos) return name;
  const std::string owner = name.substr(at + 1);
  return owner == "0" ? name.substr(0, at) : name.substr(0, at) + "(" + owner + ")";
}

std::string place_in_map(const std::string& first, std::int64_t size) {
  const auto n = size > 1 ? one_number(first) : std::nullopt;
  return n ? first + ".." + n->prefix + std::to_string(n->first + size - 1) : first;
}

GivenNames::GivenNames(const LegaliseContext& context, VariablePools& pools) : context_(context), pools_(pools) {
  if (context.names == nullptr) return;
  for (const auto& [from, to] : context.names->variables) {
    const auto wanted = numbers_of(to);
    const VariablePool* pool = wanted ? pools.pool_with(wanted->prefix, wanted->first) : nullptr;
    if (pool == nullptr || wanted->last > pool->hi) {
      context.diagnostics.error(
          "TRN-440", {},
          "the map of names gives " + from + " the variable " + to + ", which the target has not for whole programs",
          "give it a variable of the target's numbered range in the map");
      continue;
    }
    bool free = true;
    for (std::int64_t n = wanted->first; n <= wanted->last; ++n) free = pools.take(pool->prefix, n) && free;
    if (!free) {
      context.diagnostics.error("TRN-440", {}, "the map of names gives " + to + " to " + from + " and to another one",
                                "give one of them another variable in the map");
    }
    places_[from] = Place{pool, wanted->first, wanted->last - wanted->first + 1, to};
  }
  std::set<std::string> places;  // one may stand for several data of the machine
  for (const auto& [from, to] : context.names->data) {
    const auto wanted = one_number(to);
    const VariablePool* pool = wanted ? pools.pool_with(wanted->prefix, wanted->first) : nullptr;
    if (pool == nullptr || !places.insert(wanted->prefix + std::to_string(wanted->first)).second) continue;
    if (!pools.take(pool->prefix, wanted->first))
      context.diagnostics.error("TRN-440", {}, "the map of names gives " + to + " to " + from + " and to a variable",
                                "give one of them another variable in the map");
  }
}

std::optional<VarRef> GivenNames::place_of(const std::string& name, bool compensated, std::int64_t size) const {
  const auto it = places_.find(name_in_map(name));
  if (it == places_.end()) return std::nullopt;
  const Place& p = it->second;
  if (compensated && p.pool->outside_compensation) {
    context_.diagnostics.error(
        "TRN-440", {},
        "the map of names gives " + it->first + " the variable " + p.text +
            ", which the target can't use under radius compensation; it is on where the program uses it, or may be",
        "give it another variable in the map");
  }
  if (size > p.size) {
    context_.diagnostics.error(
        "TRN-440", {},
        "the map of names gives the array " + it->first + " " + std::to_string(p.size) + " variables (" + p.text +
            "), and it has " + std::to_string(size) + " elements",
        "give it as many variables, as in " + place_in_map(p.pool->prefix + std::to_string(p.number), size));
  }
  return VarRef{pools_.space(p.pool->prefix), {}, number(static_cast<double>(p.number)), {}};
}

std::string temporary_in_map(const RoutineName& routine, int n) {
  return "TEMPORARY " + std::to_string(n) + "(" + to_upper_ascii(NameMap::key(routine)) + ")";
}

std::optional<std::pair<std::string, std::int64_t>> given_number(const LegaliseContext& context,
                                                                 const std::string& name) {
  const NameMap* const made = context.report == nullptr ? nullptr : &context.report->names;
  for (const NameMap* map : {context.names, made}) {
    if (map == nullptr) continue;
    const auto it = map->variables.find(name);
    const auto n = it == map->variables.end() ? std::nullopt : one_number(it->second);
    if (n) return std::pair(n->prefix, n->first);
  }
  return std::nullopt;
}

std::set<std::pair<std::string, std::int64_t>> given_numbers(const LegaliseContext& context) {
  std::set<std::pair<std::string, std::int64_t>> out;
  if (context.names == nullptr) return out;
  const auto take = [&out](const std::string& to) {
    const auto wanted = numbers_of(to);
    for (std::int64_t n = wanted ? wanted->first : 1; n <= (wanted ? wanted->last : 0); ++n)
      out.insert({wanted->prefix, n});
  };
  for (const auto& [from, to] : context.names->variables) take(to);
  for (const auto& [from, to] : context.names->data) take(to);
  return out;
}

}  // namespace cnctrans::ir::passes
