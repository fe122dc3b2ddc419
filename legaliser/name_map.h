// Names that a translation is given and those that it chooses: the same variable of a shop's programs keeps its number
// on the other control, from run to run and from program to program.
#pragma once

#include <map>
#include <string>

#include "ir/statement.h"

namespace cnctrans::ir {

struct NameMap {
  /// Part programs: file stem of the source -> file name in the target, or "%12" where programs are called by number.
  std::map<std::string, std::string> programs;
  /// Subprograms, also those that are not at hand: name or number of the source -> number (or name) of the target.
  std::map<std::string, std::string> routines;
  /// Variables: "R5", "DEPTH", "DEPTH(L20)" for one of a single subprogram -> variable of the target ("P105").
  std::map<std::string, std::string> variables;
  /// Machine data of the source, written by hand: "PLCM[12]", "PLCM[*]", "KEY" -> what stands for it on the target.
  std::map<std::string, std::string> data;
  bool operator==(const NameMap&) const = default;

  /// How a subprogram stands in the map.
  static std::string key(const RoutineName& name) {
    return name.text.empty() ? std::to_string(name.number) : name.text;
  }
  /// What the map gives it; nullptr: nothing.
  [[nodiscard]] const std::string* given(const RoutineName& name) const {
    const auto it = routines.find(key(name));
    return it == routines.end() ? nullptr : &it->second;
  }
};

}  // namespace cnctrans::ir
