// Machine data that were given: written by the program, set for the run, or standing in the profile.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "base/diagnostics.h"
#include "ir/expr.h"
#include "machine/profile.h"

namespace cnctrans::interpreter {

/// The name of a datum with its indices: `$TC_DP6[1,1]`.
std::string datum_key(const ir::SystemRef& ref, std::span<const double> args);

class GivenData {
 public:
  explicit GivenData(const machine::Profile& profile) : profile_(profile) {}

  /// --set of a datum by its name.
  void preset(const std::string& name, double value);
  [[nodiscard]] bool preset_unread(const std::string& name) const { return unread_.count(name) != 0; }

  /// By its name and indices; a name with an index may be set without brackets. Null: nobody gave it.
  [[nodiscard]] const double* find(const ir::SystemRef& ref, std::span<const double> args) const;
  /// By its name alone; it counts as read then.
  const double* by_name(const std::string& name);
  void read_now(const ir::SystemRef& ref, std::span<const double> args);
  /// The program wrote a length: it is kept in mm, whatever unit is in force when it is read.
  [[nodiscard]] bool in_mm(const std::string& name) const { return in_mm_.contains(name); }
  void write(const std::string& name, double value, bool length);

  /// Radius or length of a tool as written, by whatever name of the control. Null: not written.
  [[nodiscard]] const double* tool(ir::Datum datum, ir::AxisId axis, std::span<const double> args) const;
  void write_tool(ir::Datum datum, ir::AxisId axis, std::span<const double> args, double value);

  /// Data that nobody gave: the value of a machine at rest was taken, here for the first time.
  struct Assumed {
    Span where;
    std::string name;
    double value = 0;
    std::string hint;  ///< how to give another
  };
  void assume(const Span& where, const std::string& name, double value, const std::string& hint);
  [[nodiscard]] const std::vector<Assumed>& assumed() const { return assumed_; }

 private:
  const machine::Profile& profile_;
  std::map<std::string, double> written_;
  std::set<std::string> in_mm_;   ///< of written_
  std::set<std::string> unread_;  ///< of written_: what --set gave and nothing has asked for
  std::map<std::tuple<ir::Datum, ir::AxisId, std::vector<double>>, double> tools_;
  std::vector<Assumed> assumed_;
};

}  // namespace cnctrans::interpreter
