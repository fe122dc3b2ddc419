// Numbers of the target's variables that can be handed out.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// The number that a local name of the source has: "P3@20" wants 3.
std::optional<std::int64_t> preferred_number(const std::string& name);

/// The first values of a definition as assignments to the numbers that its names have become (`places`).
Assign first_values(const Statement& s, const std::map<std::pair<SpaceId, std::string>, VarRef>& places);

class VariablePools {
 public:
  explicit VariablePools(const LegaliseContext& context);
  bool level_is_global = false;  ///< no call opens a level: local parameters serve as variables of the program

  using Found = std::optional<std::pair<const VariablePool*, std::int64_t>>;
  /// The pool that has number `n` and can hold variables of `segment`; nullptr: none.
  [[nodiscard]] const VariablePool* holding(std::int64_t n, const SpaceSegment& segment) const;
  [[nodiscard]] const VariablePool* holding_any(std::int64_t n) const;
  /// The pool of the whole program with these letters and number; nullptr: none.
  [[nodiscard]] const VariablePool* pool_with(const std::string& prefix, std::int64_t n) const;
  [[nodiscard]] const VariablePool* holding_prefix(const SpaceSegment& segment) const;
  /// A pool and a distance by which all `used` numbers (those from `from` on) fit in and are free.
  [[nodiscard]] Found shift_for(const SpaceSegment& segment, std::int64_t from,
                                const std::vector<std::int64_t>& used) const;
  /// `compensated`: it is used while radius compensation is on.
  [[nodiscard]] Found any_free(const SpaceSegment& segment, bool compensated = false) const;
  [[nodiscard]] Found run_of_free(std::int64_t size, bool compensated = false) const;
  /// Some of the numbers can't be used while radius compensation is on.
  [[nodiscard]] bool depends_on_compensation() const;
  [[nodiscard]] const VariablePool* level_pool() const;
  bool take(const std::string& prefix, std::int64_t n) { return taken_.insert({prefix, n}).second; }
  /// A computed number may reach these: names get other ones as long as there are others.
  void keep_clear(const std::string& prefix, std::int64_t lo, std::int64_t hi) { clear_.push_back({prefix, lo, hi}); }
  [[nodiscard]] SpaceId space(const std::string& prefix) const;
  [[nodiscard]] bool starts_at_zero(const VarRef& v) const;
  [[nodiscard]] bool persistent(const VarRef& v) const;

 private:
  [[nodiscard]] bool usable(const VariablePool& pool, bool persistent) const;
  [[nodiscard]] bool free(const std::string& prefix, std::int64_t n) const { return taken_.count({prefix, n}) == 0; }
  const LegaliseContext& context_;
  std::vector<VariablePool> pools_;
  struct Reach {
    std::string prefix;
    std::int64_t lo, hi;
  };
  [[nodiscard]] bool reached(const std::string& prefix, std::int64_t n) const;
  std::set<std::pair<std::string, std::int64_t>> taken_;
  std::vector<Reach> clear_;
};

/// The target's pools, cut to what its machine profile says ("<dialect>.<prefix>_count").
std::vector<VariablePool> target_pools(const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
