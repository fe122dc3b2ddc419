#include "ir/passes/variable_pools.h"

#include <algorithm>

#include "base/text.h"

namespace cnctrans::ir::passes {

std::vector<VariablePool> target_pools(const LegaliseContext& context) {
  std::vector<VariablePool> list;
  for (VariablePool pool : context.target.pools) {
    if (pool.prefix.empty()) continue;  // names: nothing to number
    std::string key = context.target_machine.dialect + ".";
    for (const char c : pool.prefix) key += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    const auto count = parse_decimal(context.target_machine.option(key + "_count"));
    if (count && pool.lo == 0) pool.hi = static_cast<std::int64_t>(*count) - 1;
    if (pool.hi >= pool.lo) list.push_back(std::move(pool));
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

VariablePools::Found VariablePools::run_of_free(std::int64_t size, bool compensated) const {
  for (const bool temporaries : {false, true}) {
    for (const auto& p : pools_) {
      if (p.temporaries != temporaries || !usable(p, false)) continue;
      if (compensated && p.outside_compensation) continue;
      std::int64_t run = 0;
      for (std::int64_t n = p.lo; n <= p.hi; ++n) {
        run = free(p.prefix, n) ? run + 1 : 0;
        if (run == size) return std::make_pair(&p, n - size + 1);
      }
    }
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
