// Which initial values and skip levels lead a program into the branches that its replays have not taken.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/program/interpreter.h"
#include "ir/program.h"
#include "verifier/compare.h"

namespace cnctrans::translator {

/// What a replay starts with, beside the machine.
struct Inputs {
  std::vector<std::pair<std::string, std::string>> set;  ///< NAME=VALUE, as of --set
  std::uint16_t skip_mask = 0;                           ///< block-skip switches that are on
};

/// A number may stand in brackets: PLCM12, PLCM[12].
std::string plain_name(const std::string& name);

/// Every block-skip switch that some block of the program asks.
std::uint16_t skip_switches(const ir::Program& program);

/// The option that sets these switches, "--skip 0,2"; `first`: number of the control's first one.
std::string skip_option(std::uint16_t mask, int first);

/// Proposes inputs one by one. Values come from the program: what its conditions compare with, one less and one more,
/// numbers of labels where the label is computed, 0, 1 and -1; for the variables that a condition depends on, also
/// through assignments and arguments.
class Explorer {
 public:
  /// `start`: what the user gave; it is only added to. `settable`: the variable has one meaning in the whole program,
  /// here and in the translation.
  Explorer(const ir::Program& program, Inputs start, std::function<bool(const std::string&)> settable);
  /// The next inputs to try, other than `start`; nullopt: nothing is left that could lead anywhere new.
  std::optional<Inputs> next();
  /// A replay with `inputs` has run and counts; they are not proposed any more.
  void note(const Inputs& inputs, const interpreter::Result& result);
  /// Adds to `c` the replays noted so far, and the branches with those that none of them has taken.
  void report(verifier::Coverage& c) const;
  /// Statements that some replay has carried out, by Statement::id.
  [[nodiscard]] const std::vector<bool>& covered() const { return covered_; }

 private:
  struct Branch {
    std::uint32_t id = 0;
    FileId file = 0;
    std::uint32_t line = 0;
    bool two_ways = false;  ///< a condition: it holds or it does not; else as many ways as there are values
    std::set<std::string> variables;
  };
  /// What is known of a variable of the program.
  struct Known {
    std::vector<std::string> values;  ///< to try, the most telling first
    std::set<std::string> set_from;   ///< variables that its assignments read
    std::vector<ir::ExprPtr> sums;    ///< assignments from one variable and one number
  };

  void collect(const ir::Program& program, const ir::Routine& routine, const ir::Statement& s);
  void branch(const ir::Program& program, const ir::Statement& s, const ir::ExprPtr& e, bool two_ways);
  void assigned(const ir::Program& program, const ir::VarRef& target, const ir::ExprPtr& value);
  void add_value(const std::string& variable, std::string value);
  void add_number(const std::string& variable, double value, bool around);
  static std::optional<double> solved(const ir::Binary& sum, double wanted);
  void spread_values(const ir::Program& program);
  [[nodiscard]] bool open(const Branch& b) const;
  [[nodiscard]] std::vector<std::string> relevant() const;

  Inputs start_;
  std::function<bool(const std::string&)> settable_;
  std::vector<Branch> branches_;
  std::map<std::string, Known> known_;
  std::set<std::string> defined_;  ///< get their value from a definition or a call
  std::uint16_t skips_ = 0;
  std::vector<Inputs> kept_;  ///< those that led to something new
  std::set<std::pair<std::vector<std::pair<std::string, std::string>>, std::uint16_t>> tried_;
  std::vector<bool> covered_;
  std::vector<std::uint8_t> outcomes_;
  std::size_t replays_ = 0;
};

}  // namespace cnctrans::translator
