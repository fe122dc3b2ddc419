// Which block numbers are jump targets, and what becomes of the numbers when the program is renumbered.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "ir/program.h"

namespace cnctrans::backends {

/// "0020" -> "20", "000" -> "0".
std::string_view without_leading_zeros(std::string_view digits);

/// Facts about the labels of a program, per routine.
class LabelUse {
 public:
  explicit LabelUse(const ir::Program& program);
  /// Is block number `digits` of routine `routine` named by a jump, a range or a call?
  [[nodiscard]] bool is_target(std::size_t routine, std::string_view digits) const;
  [[nodiscard]] bool is_target_name(std::size_t routine, std::string_view name) const;
  /// Block numbers and names that delimit a repeated range.
  [[nodiscard]] bool delimits_range(std::size_t routine, std::string_view digits) const;
  /// Is the number needed though the others are left away: a target, or what a computed jump or a cycle may name?
  [[nodiscard]] bool must_stay(std::size_t routine, std::string_view digits) const;
  /// No label is computed at run time, every target number stands in its routine, once.
  [[nodiscard]] bool certain() const { return certain_; }
  /// Numbers can be changed: they are certain, and no cycle names its profile by them.
  [[nodiscard]] bool renumberable() const { return certain_ && profiles_.empty(); }
  [[nodiscard]] const std::string& why_not() const { return why_not_; }

 private:
  void use(std::size_t routine, const ir::LabelRef& label, bool range);
  void use_cycles(const ir::Statement& s);
  void use_body(const ir::Program& program, std::size_t routine, const ir::Body& body);
  /// Every number that something names stands in its routine, once.
  void check_targets(const ir::Program& program);
  std::set<std::pair<std::size_t, std::string>, std::less<>> targets_, names_, ranges_;
  std::set<std::string, std::less<>> profiles_;  ///< numbers that cycles name; they count in the whole file
  bool certain_ = true, computed_ = false;
  std::string why_not_;
};

/// While a file is renumbered, a jump to a block number is written as a mark, and resolved when all lines are there.
class Renumbering {
 public:
  [[nodiscard]] static std::string mark(std::size_t routine, std::string_view digits);
  void set(std::size_t routine, std::string_view digits, std::int64_t number);
  /// Replaces the marks; a label that was never written keeps its old number.
  void resolve(std::string& text) const;

 private:
  std::map<std::pair<std::size_t, std::string>, std::int64_t> numbers_;
};

}  // namespace cnctrans::backends
