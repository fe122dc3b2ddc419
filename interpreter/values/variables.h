// Storage of variables: numbered spaces (global numbers, and numbers with one set per call level) and named variables.
// Spaces of several programs are one when their prefix is the same.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interpreter/trace/failure.h"
#include "interpreter/values/frame.h"
#include "ir/declared_limits.h"
#include "ir/program.h"

namespace cnctrans::interpreter {

/// Numbers above this are not kept, whatever a space allows.
inline constexpr std::int64_t largest_number = (1 << 20) - 1;

struct NumberedSpace {
  enum class Where : std::uint8_t { none, global, level };
  struct Number {
    Where where = Where::none;
    bool read_only = false;
    bool given = false;  ///< holds a value before the program: reading it first is no fault
  };
  std::string prefix;
  ir::Type type = ir::Type::real;
  bool starts_at_zero = false;  ///< else a variable keeps what an earlier program left
  std::vector<Number> numbers;  ///< by number
  std::vector<double> value;    ///< of the global ones, by number
  std::vector<std::uint8_t> set;
  std::uint32_t level_base = 0;   ///< where this space's level variables begin in a Level
  std::uint32_t level_count = 0;  ///< level variables have numbers below this

  [[nodiscard]] const Number* find(double n) const;
};

/// Variables of one call level.
struct Level {
  std::vector<double> value;
  std::vector<std::uint8_t> set;
  std::uint32_t depth = 0;
  std::uint64_t arguments = 0;  ///< bit n: argument n was given
};

/// A named variable or array.
struct NamedVariable {
  std::string name;
  ir::Type type = ir::Type::real;
  std::vector<std::uint32_t> dimensions;  ///< empty: a single value
  std::vector<double> number;
  std::vector<std::string> text;
  std::vector<Frame> frame;
  std::vector<std::uint8_t> set;
  ir::DeclaredLimits limits;
  bool declared = false;

  void shape(ir::Type t, std::vector<std::uint32_t> dims);
  [[nodiscard]] bool is_text() const { return type == ir::Type::string; }
  [[nodiscard]] bool is_frame() const { return type == ir::Type::frame; }
};

/// Where a value lives.
struct Place {
  NamedVariable* named = nullptr;  ///< element `index` of it, or
  NumberedSpace* space = nullptr;  ///< number `index` of it, of
  Level* level = nullptr;          ///< this level when it is a level variable
  std::uint32_t index = 0;
  [[nodiscard]] bool valid() const { return named != nullptr || space != nullptr; }
};

/// A named local of one activation: its own, or a reference to the caller's.
struct Local {
  NamedVariable own;
  bool reference = false;
  Place target;
};
using Locals = std::deque<Local>;

/// `value` as a variable of this type keeps it: integers rounded (halves away from zero), booleans 0 or 1.
double stored(ir::Type type, double value);

class Variables {
 public:
  explicit Variables(Failure& failure) : failure_(failure) { push_level(); }

  /// Adds the spaces of a program; answers, for each of its SpaceIds, the numbered space (null: a named one).
  std::vector<NumberedSpace*> add_program(const ir::Program& program);
  NumberedSpace* numbered(std::string_view prefix);
  /// The space whose numbers belong to a call level; null when there is none.
  NumberedSpace* level_space();

  /// A named variable that all routines see; made with this type when it is new.
  NamedVariable& global(const std::string& name, ir::Type type = ir::Type::real);
  /// Value of a named variable or array element from outside: holds at once, or as soon as there is such a variable.
  void preset(const std::string& name, const std::string& value);
  /// Gives a variable just made or declared what was preset for it.
  void apply_presets(NamedVariable& v);
  struct Preset {
    std::string name, value;
    bool found = false;  ///< a variable of this name came up
    bool fits = true;    ///< the value is one for its type
  };
  [[nodiscard]] const std::vector<Preset>& presets() const { return presets_; }

  /// The place of number `n` of a space as seen from the present level. Fails with no_variable.
  bool place(NumberedSpace& space, double n, Place& out);
  [[nodiscard]] static double number(const Place& p);
  [[nodiscard]] static const std::string& text(const Place& p);
  static void assign(const Place& p, double value);
  static void assign(const Place& p, std::string value);
  /// As assign(), within what the variable takes: a number outside is a failure, a text is cut to the length of the
  /// variable.
  bool store(const Place& p, double value);
  void store(const Place& p, std::string value);
  /// Texts that were cut.
  struct Cut {
    Span where;  ///< the first time
    std::string name;
    std::size_t length = 0;
  };
  [[nodiscard]] const std::vector<Cut>& cuts() const { return cuts_; }

  /// A value is used that nothing has given: variable `n` of a space, a named one.
  void note_unset(const NumberedSpace& space, std::uint32_t n);
  void note_unset(const NamedVariable& v);
  /// The same of whatever is read at this place, also through a parameter by reference.
  void note_read(const Place& p);
  [[nodiscard]] const std::vector<std::string>& read_first() const { return read_first_; }

  void push_level();
  void pop_level();
  [[nodiscard]] Level& level() { return *levels_.back(); }
  [[nodiscard]] std::size_t depth() const { return levels_.size() - 1; }

  /// The values of a routine's locals that is left are kept for the report (`depth` 0: of the main program).
  void leave(const Locals& locals, std::uint32_t depth);
  /// Every variable that was ever set, as the contract writes it.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> report() const;

 private:
  void archive(const Level& level);

  Failure& failure_;
  std::deque<NumberedSpace> spaces_;
  std::deque<NamedVariable> globals_;
  std::map<std::string, NamedVariable*, std::less<>> global_names_;
  std::vector<Preset> presets_;
  std::vector<Cut> cuts_;
  std::vector<std::string> read_first_;
  std::uint32_t level_size_ = 0;
  std::vector<std::unique_ptr<Level>> levels_;
  std::vector<std::unique_ptr<Level>> spare_;
  using Key = std::pair<std::uint32_t, std::uint32_t>;  // depth, place in the level
  std::map<Key, double> left_levels_;
  std::map<std::pair<std::uint32_t, std::string>, std::string> left_locals_;
};

/// Reports one named variable: calls `out(name, json)` for every element that was set.
template <class Out>
void report_named(const NamedVariable& v, const Out& out);
/// Number of a --set: decimal, TRUE or FALSE.
std::optional<double> preset_number(std::string_view text);
std::string json_number(double value);
std::string json_text(std::string_view text);
std::string element_name(const NamedVariable& v, std::size_t index);

template <class Out>
void report_named(const NamedVariable& v, const Out& out) {
  for (std::size_t i = 0; i < v.set.size(); ++i) {
    if (v.set[i] == 0) continue;
    out(element_name(v, i), v.is_text() ? json_text(v.text[i]) : json_number(v.number[i]));
  }
}

}  // namespace cnctrans::interpreter
