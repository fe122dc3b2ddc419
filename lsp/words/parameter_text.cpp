#include "lsp/words/parameter_text.h"

#include <array>

#include "ir/cycles/machining.h"
#include "ir/cycles/milling/milling.h"
#include "ir/cycles/pattern.h"
#include "lsp/words/words.h"

namespace cnctrans::lsp {

namespace {

/// What the tables call plain: an angle, a time or a speed by its name.
ParameterUnit plain_unit(std::string_view name) {
  struct Row {
    std::string_view part;
    ParameterUnit unit;
  };
  constexpr std::array rows = {Row{"angle", ParameterUnit::degrees}, Row{"opening", ParameterUnit::degrees},
                               Row{"dwell", ParameterUnit::seconds}, Row{"speed", ParameterUnit::speed},
                               Row{"feed", ParameterUnit::feed}};
  for (const auto& row : rows) {
    if (name.find(row.part) != std::string_view::npos) return row.unit;
  }
  return ParameterUnit::none;
}

}  // namespace

ParameterUnit unit_of(std::string_view name) {
  namespace cycles = ir::cycles;
  if (const auto* p = cycles::find_mill_parameter(name)) {
    if (p->quantity == cycles::MillQuantity::plain) return plain_unit(name);
    return p->quantity == cycles::MillQuantity::feed ? ParameterUnit::feed : ParameterUnit::length;
  }
  if (const auto* p = cycles::find_parameter(name)) {
    switch (p->quantity) {
      case cycles::Quantity::cross:
      case cycles::Quantity::along:
      case cycles::Quantity::length: return ParameterUnit::length;
      case cycles::Quantity::feed: return ParameterUnit::feed;
      case cycles::Quantity::centiseconds: return ParameterUnit::seconds;
      case cycles::Quantity::plain:
      case cycles::Quantity::text: return plain_unit(name);
    }
  }
  if (const auto* p = cycles::find_pattern_parameter(name)) {
    return p->quantity == cycles::PatternQuantity::length ? ParameterUnit::length : plain_unit(name);
  }
  return plain_unit(name);
}

std::string_view unit_text(ParameterUnit unit, bool inch, bool per_rev) {
  switch (unit) {
    case ParameterUnit::length: return inch ? "inch" : "mm";
    case ParameterUnit::feed: return per_rev ? (inch ? "inch/rev" : "mm/rev") : (inch ? "inch/min" : "mm/min");
    case ParameterUnit::degrees: return "°";
    case ParameterUnit::seconds: return "s";
    case ParameterUnit::speed: return "rev/min";
    case ParameterUnit::none: break;
  }
  return {};
}

std::string parameter_meaning(std::string_view name) {
  const auto* mill = ir::cycles::find_mill_parameter(name);
  return mill != nullptr && !mill->meaning.empty() ? std::string(mill->meaning) : spoken(name);
}

std::string parameter_with_unit(std::string_view name) {
  const std::string_view unit = unit_text(unit_of(name), false, false);
  return parameter_meaning(name) + (unit.empty() ? "" : " (" + std::string(unit) + ")");
}

}  // namespace cnctrans::lsp
