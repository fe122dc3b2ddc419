#include "legaliser/edit/variable_pools.h"

#include <algorithm>

#include "base/text.h"

namespace cnctrans::ir::passes {

std::vector<VariablePool> target_pools(const LegaliseContext& context) {
  std::vector<VariablePool> list;
  for (VariablePool pool : context.target.pools) {
    if (pool.prefix.empty()) continue;  // names: nothing to number
    const double count = context.target_machine.policies.numbered_variables;
    if (count > 0 && pool.lo == 0) pool.hi = static_cast<std::int64_t>(count) - 1;
    if (pool.hi >= pool.lo) list.push_back(std::move(pool));
  }
  return list;
}

std::optional<std::int64_t> preferred_number(const std::string& name) {
  const auto at = name.find('@');
  std::string_view digits = std::string_view(name).substr(0, at);
  while (!digits.empty() && (digits.front() < '0' || digits.front() > '9')) digits.remove_prefix(1);
  if (at == std::string::npos || digits.empty() || digits.size() > 6 || name.size() < 2 || name[1] < '0' ||
      name[1] > '9')
    return std::nullopt;
  return static_cast<std::int64_t>(parse_decimal(digits).value_or(-1));
}

Assign first_values(const Statement& s, const std::map<std::pair<SpaceId, std::string>, VarRef>& places) {
  Assign list;
  const auto* d = std::get_if<Declare>(&s.node);
  if (d == nullptr) return list;
  for (const auto& i : d->items) {
    const auto place = places.find({d->space, i.name});
    if (place == places.end() || !place->second.name.empty()) continue;
    for (std::size_t k = 0; k < i.initial.size(); ++k) {
      if (!i.initial[k]) continue;
      VarRef to = place->second;
      if (k != 0) to.index = number(constant_value(to.index).value_or(0) + static_cast<double>(k));
      list.items.push_back({std::move(to), i.initial[k], {}, {}, false});
    }
  }
  return list;
}

VariablePools::VariablePools(const LegaliseContext& context) : context_(context), pools_(target_pools(context)) {}

bool VariablePools::usable(const VariablePool& pool, bool persistent) const {
  if (pool.scope == Scope::global) return true;
  return pool.scope == Scope::level && level_is_global && !persistent;
}

const VariablePool* VariablePools::holding(std::int64_t n, const SpaceSegment& segment) const {
  for (const auto& p : pools_) {
    if (n >= p.lo && n <= p.hi && usable(p, segment.persistent)) return &p;
  }
  return nullptr;
}

const VariablePool* VariablePools::holding_any(std::int64_t n) const {
  for (const auto& p : pools_) {
    if (n >= p.lo && n <= p.hi && usable(p, false)) return &p;
  }
  return nullptr;
}

const VariablePool* VariablePools::pool_with(const std::string& prefix, std::int64_t n) const {
  for (const auto& p : pools_) {
    if (p.prefix == prefix && n >= p.lo && n <= p.hi && p.scope == Scope::global) return &p;
  }
  return nullptr;
}

const VariablePool* VariablePools::holding_prefix(const SpaceSegment& segment) const {
  for (const auto& p : pools_) {
    if (usable(p, segment.persistent)) return &p;
  }
  return nullptr;
}

VariablePools::Found VariablePools::shift_for(const SpaceSegment& segment, std::int64_t from,
                                              const std::vector<std::int64_t>& used) const {
  const std::int64_t first = used.empty() ? from : used.front(), last = used.empty() ? from : used.back();
  for (const auto& p : pools_) {
    if (!usable(p, segment.persistent)) continue;
    std::vector<std::int64_t> bases{p.lo};
    if (from == segment.lo) {  // the same last digits when possible
      const std::int64_t digits = (from % 100 + 100) % 100;
      const std::int64_t base = p.lo + ((digits - p.lo % 100) % 100 + 100) % 100;
      bases.insert(bases.begin(), base);
    }
    for (const auto base : bases) {
      const std::int64_t shift = base - from;
      if (first + shift < p.lo || last + shift > p.hi) continue;
      if (std::all_of(used.begin(), used.end(), [&](std::int64_t n) { return free(p.prefix, n + shift); })) {
        return std::make_pair(&p, shift);
      }
    }
  }
  return std::nullopt;
}

VariablePools::Found VariablePools::any_free(const SpaceSegment& segment, bool compensated) const {
  for (const bool temporaries : {false, true}) {
    for (const auto& p : pools_) {
      if (p.temporaries != temporaries || !usable(p, segment.persistent)) continue;
      if (compensated && p.outside_compensation) continue;
      for (std::int64_t n = p.lo; n <= p.hi; ++n) {
        if (free(p.prefix, n)) return std::make_pair(&p, n);
      }
    }
  }
  return std::nullopt;
}

bool VariablePools::reached(const std::string& prefix, std::int64_t n) const {
  return std::any_of(clear_.begin(), clear_.end(),
                     [&](const Reach& r) { return r.prefix == prefix && n >= r.lo && n <= r.hi; });
}

VariablePools::Found VariablePools::run_of_free(std::int64_t size, bool compensated) const {
  for (const bool within_reach : {false, true}) {
    for (const bool temporaries : {false, true}) {
      for (const auto& p : pools_) {
        if (p.temporaries != temporaries || !usable(p, false)) continue;
        if (compensated && p.outside_compensation) continue;
        std::int64_t run = 0;
        for (std::int64_t n = p.lo; n <= p.hi; ++n) {
          run = free(p.prefix, n) && (within_reach || !reached(p.prefix, n)) ? run + 1 : 0;
          if (run == size) return std::make_pair(&p, n - size + 1);
        }
      }
    }
    if (clear_.empty()) break;
  }
  return std::nullopt;
}

bool VariablePools::depends_on_compensation() const {
  return std::any_of(pools_.begin(), pools_.end(), [](const VariablePool& p) { return p.outside_compensation; });
}

const VariablePool* VariablePools::level_pool() const {
  for (const auto& p : pools_) {
    if (p.scope == Scope::level) return &p;
  }
  return nullptr;
}

SpaceId VariablePools::space(const std::string& prefix) const {
  const auto& spaces = context_.target.spaces;
  for (std::size_t i = 0; i < spaces.size(); ++i) {
    if (spaces[i].prefix == prefix && !spaces[i].named()) return static_cast<SpaceId>(i);
  }
  return 0;
}

bool VariablePools::starts_at_zero(const VarRef& v) const {
  return v.space < context_.target.spaces.size() && context_.target.spaces[v.space].starts_at_zero;
}

bool VariablePools::persistent(const VarRef& v) const {
  if (v.space >= context_.target.spaces.size() || !v.index) return false;
  const auto n = constant_value(v.index);
  for (const auto& s : context_.target.spaces[v.space].segments) {
    if (n && *n >= static_cast<double>(s.lo) && *n <= static_cast<double>(s.hi)) return s.persistent;
  }
  return false;
}

}  // namespace cnctrans::ir::passes
