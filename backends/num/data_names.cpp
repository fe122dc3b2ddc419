#include "backends/num/data_names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "base/saturate.h"
#include "dialects/num/variables.h"

namespace cnctrans::backends::num {

namespace facts = dialects::num;
using facts::EMeaning;
using ir::Datum;

namespace {

/// Parameter of the row with this meaning and index.
std::optional<ir::DataForm> row(EMeaning meaning, std::int64_t index, double units) {
  for (const auto& p : facts::e_parameters) {
    const std::int64_t number = p.lo + (index - p.first) * p.step;
    if (p.meaning == meaning && number >= p.lo && number <= p.hi)
      return ir::DataForm{"E" + std::to_string(number), units, p.writable};
  }
  return std::nullopt;
}

std::optional<std::int64_t> fixed_index(const ir::SystemRef& ref) {
  const auto n = ref.args.size() == 1 ? ir::constant_value(ref.args[0]) : std::nullopt;
  if (!n || *n != std::floor(*n) || *n < 1 || *n > 255) return std::nullopt;
  return saturate<std::int64_t>(*n);
}

/// What the control has in force (reference 14.6).
constexpr std::array<std::pair<Datum, std::string_view>, 3> states{
    {{Datum::feed, "[.RF]"}, {Datum::spindle_speed, "[.RS]"}, {Datum::tool_number, "[.RT]"}}};

double units_of(ir::AxisId axis) {
  return ir::is_rotary_letter(axis) ? facts::units_per_degree : facts::units_per_mm;
}

}  // namespace

std::optional<ir::DataForm> data_form(const ir::SystemRef& ref, bool lathe, bool symbols) {
  const auto index = fixed_index(ref);
  switch (ref.datum) {
    case Datum::tool_radius: return index ? row(EMeaning::tool_radius, *index, facts::units_per_mm) : std::nullopt;
    case Datum::tool_length: {
      if (!index || (!lathe && ref.axis != ir::axis::none && ref.axis != ir::axis::z)) return std::nullopt;
      const bool along_z = lathe && ref.axis == ir::axis::z;
      if (lathe && !along_z && ref.axis != ir::axis::x) return std::nullopt;
      return row(along_z ? EMeaning::tool_length_z : EMeaning::tool_length, *index, facts::units_per_mm);
    }
    case Datum::work_offset:
      if (index != facts::offset_row || ref.axis >= ir::axis::first_extra) return std::nullopt;
      return row(EMeaning::dec1, ref.axis, units_of(ref.axis));
    case Datum::machine_position:
      return ref.axis < ir::axis::first_extra ? row(EMeaning::position, ref.axis, units_of(ref.axis)) : std::nullopt;
    case Datum::offset_number: return row(EMeaning::active_offset, 0, 1);
    case Datum::feed_override: return row(EMeaning::feed_override, 0, 1);
    default: break;
  }
  for (const auto& [datum, symbol] : states) {
    if (symbols && datum == ref.datum && ref.args.empty()) return ir::DataForm{std::string(symbol), 1, false};
  }
  return std::nullopt;
}

ir::ExprPtr work_position(ir::AxisId axis) {
  if (axis >= ir::axis::first_extra) return nullptr;
  constexpr std::array shifts{EMeaning::pref, EMeaning::dec1, EMeaning::dec3, EMeaning::shift};
  const auto datum = [axis](EMeaning meaning) {
    ir::SystemRef ref;
    ref.datum = meaning == EMeaning::position ? Datum::machine_position : Datum::other;
    ref.axis = axis;
    ref.text = row(meaning, axis, 1)->text;
    ir::Expr e;
    e.node = std::move(ref);
    return std::make_shared<const ir::Expr>(std::move(e));
  };
  ir::ExprPtr rest = datum(EMeaning::position);
  for (const EMeaning m : shifts) rest = ir::binary(ir::BinaryOp::subtract, rest, datum(m));
  return ir::binary(ir::BinaryOp::divide, rest, ir::number(units_of(axis)));
}

bool is_parameter_name(std::string_view text) {
  for (const auto& [datum, symbol] : states) {
    if (symbol == text) return true;
  }
  return text.size() == 6 && text[0] == 'E' &&
         std::all_of(text.begin() + 1, text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace cnctrans::backends::num
