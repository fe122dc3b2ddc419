// syntax expressions -> IR expressions. NUM variables become spaces L, E (memory) and symbols; an E parameter that
// mirrors machine data becomes a neutral datum in millimetres or degrees, with its scaling written out.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "dialects/num/variables.h"
#include "frontends/common/report.h"
#include "frontends/common/syntax.h"
#include "frontends/num/state/settings.h"
#include "ir/statement.h"

namespace cnctrans::frontends::num {

class Expressions {
 public:
  Expressions(const Settings& settings, Report& report) : settings_(settings), report_(report) {}

  /// Null after a refusal.
  ir::ExprPtr lower(const syntax::Expr& e);
  /// The variable as the value of an axis word: an E parameter is in system units there.
  ir::ExprPtr lower_axis_value(const syntax::Expr& e, ir::AxisId axis);
  /// Appends target and value of one assignment; false after a refusal. PREF or DEC1 of a program that uses both give a
  /// second item: their sum is the offset of the machine.
  bool assignment(const syntax::Statement& s, std::vector<ir::Assign::Item>& items);
  /// E7x001 := the machine position of the axis.
  ir::Assign::Item latched(ir::AxisId axis) const;
  /// Axes of the G59 shift that assignments to E6x005 gave since the last call.
  std::vector<ir::FrameWord> take_shifts() { return std::exchange(shifts_, {}); }
  /// PREF, DEC1 and DEC3 are kept apart (memory), because the program works with more than DEC1.
  void keep_offsets_apart(bool apart) { offsets_apart_ = apart; }
  /// The program writes none of them: PREF is what the offset in force leaves for it, beside DEC1 and DEC3.
  void know_offsets_only_read(bool only_read) { offsets_only_read_ = only_read; }
  [[nodiscard]] bool offsets_apart() const { return offsets_apart_; }
  /// PREF takes over what a G92 made of the axis: two assignments.
  void take_over_preset(ir::AxisId axis, std::vector<ir::Assign::Item>& items) const;

  /// Symbols declared so far, and those used: an undeclared one is a fault (see frontend.cpp).
  void declare(std::string name) { declared_.insert(std::move(name)); }
  [[nodiscard]] bool declared(const std::string& name) const { return declared_.count(name) != 0; }
  struct Use {
    std::string name;
    Span span;
  };
  /// E parameters of the program that no list names: user variables.
  [[nodiscard]] const std::set<std::int64_t>& unlisted() const { return unlisted_; }
  [[nodiscard]] const std::vector<Use>& undeclared() const { return undeclared_; }
  void forget_symbols() {
    declared_.clear();
    undeclared_.clear();
  }

 private:
  ir::ExprPtr variable(const syntax::Expr& e);
  ir::ExprPtr parameter(const syntax::Expr& e);
  std::optional<ir::VarRef> symbol(const syntax::Expr& e);
  std::optional<ir::VarRef> l_variable(const syntax::Expr& e);
  bool user_parameter(const syntax::Expr& e, std::int64_t n);
  bool assign_parameter(const syntax::Expr& target, ir::ExprPtr value, std::vector<ir::Assign::Item>& items,
                        WordPos pos);
  [[nodiscard]] bool is_memory(const dialects::num::EParameter& row) const;
  /// PREF := offset in force - DEC1 - DEC3.
  [[nodiscard]] ir::Assign::Item preset_left(ir::AxisId axis) const;
  bool offsets_apart_ = false;
  bool offsets_only_read_ = false;
  std::set<ir::AxisId> presets_read_;  ///< by the value at hand

  const Settings& settings_;
  Report& report_;
  std::set<std::string> declared_;
  std::vector<Use> undeclared_;
  std::set<std::int64_t> unlisted_;
  std::vector<ir::FrameWord> shifts_;
};

/// The number of an L or E variable.
std::int64_t variable_number(const syntax::Expr& e);

}  // namespace cnctrans::frontends::num
