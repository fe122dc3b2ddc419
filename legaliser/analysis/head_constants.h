// Variables that a program sets once, at its head, to a number: at every later place they have this value.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "ir/edit/rewrite.h"

namespace cnctrans::ir::passes {

/// "P1=40, P2=3".
std::string listed(const std::map<std::string, double>& values);

class HeadConstants {
 public:
  /// Looks at the straight way from the start of the main program to its first jump, branch, loop or call.
  explicit HeadConstants(const Program& program);

  /// The expression with the numbers in the place of these variables, as it is read by the statement. The names and
  /// numbers that were put in are added to `used` ("P1=40"), when it is given.
  [[nodiscard]] Value fold(const Value& v, const Routine& routine, const Statement& at,
                           std::map<std::string, double>* used = nullptr) const;
  /// A computed number of times, rounded or not, that is a number by them.
  [[nodiscard]] std::optional<double> count(const ExprPtr& times, const Routine& routine, const Statement& at) const;
  [[nodiscard]] bool empty() const { return known_.empty(); }

 private:
  using Key = std::tuple<SpaceId, std::string, std::int64_t>;
  struct Known {
    double value = 0;
    std::uint32_t line = 0;  ///< of the assignment; it holds behind it
    int writes = 1;          ///< by the statement that sets it: 0 for a definition with a value
  };
  static std::optional<Key> key_of(const VarRef& v);
  void look_at_head(const Routine& main);
  /// What is set twice, by a computed number, as the result of a call, or where it can't be seen goes, for good.
  /// \return something went
  bool forget_written_elsewhere();

  const Program& program_;
  std::map<Key, Known> known_;
  std::set<Key> changing_;  ///< is no constant, and nothing that is computed from it
};

}  // namespace cnctrans::ir::passes
