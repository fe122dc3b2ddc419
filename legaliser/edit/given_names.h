// What the map of names (--names) says of the target's variables.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "legaliser/edit/variable_pools.h"
#include "legaliser/name_map.h"

namespace cnctrans::ir::passes {

/// Text of a variable of the source in the map: its name, with the subprogram that owns it in brackets. `name` may end
/// in "@owner", as the passes tell variables of one name apart.
std::string name_in_map(const std::string& name);
/// Text of the variable `first` of the target, or of the run of them that an array of `size` elements takes: "P105",
/// "R20..R29".
std::string place_in_map(const std::string& first, std::int64_t size);

class GivenNames {
 public:
  /// Takes every variable that the map gives out of `pools`: no other one may get it. TRN-440: the target has no such
  /// variable, or it is given twice.
  GivenNames(const LegaliseContext& context, VariablePools& pools);
  /// The (first) variable that the map gives to this one of the source, which has `size` elements. `compensated`: it is
  /// used while radius compensation is on. TRN-440 when the given one does not serve.
  [[nodiscard]] std::optional<VarRef> place_of(const std::string& name, bool compensated, std::int64_t size) const;

 private:
  struct Place {
    const VariablePool* pool = nullptr;
    std::int64_t number = 0, size = 1;
    std::string text;
  };
  const LegaliseContext& context_;
  const VariablePools& pools_;
  std::map<std::string, Place> places_;
};

/// How the nth intermediate value of a subprogram stands in the map.
std::string temporary_in_map(const RoutineName& routine, int n);
/// The variable that the map gives to a name, or that this translation has given it: letters and number.
std::optional<std::pair<std::string, std::int64_t>> given_number(const LegaliseContext& context,
                                                                 const std::string& name);
/// Variables of the map by letters and number, which no temporary may take.
std::set<std::pair<std::string, std::int64_t>> given_numbers(const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
