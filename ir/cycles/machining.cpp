#include "ir/cycles/machining.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ir/cycles/assumed.h"
#include "ir/cycles/blank_points.h"
#include "ir/cycles/turning_moves.h"
#include "ir/cycles/words.h"

namespace cnctrans::ir::cycles {

namespace {

constexpr std::array machining_parameters = {
    Parameter{"x", Quantity::cross},
    Parameter{"x_end", Quantity::cross},
    Parameter{"z", Quantity::along},
    Parameter{"z_end", Quantity::along},
    Parameter{"x_2", Quantity::cross},
    Parameter{"z_2", Quantity::along},
    Parameter{"x_3", Quantity::cross},
    Parameter{"z_3", Quantity::along},
    Parameter{"pitch_2", Quantity::length},
    Parameter{"pitch_3", Quantity::length},
    Parameter{"measured", Quantity::along},
    Parameter{"measured_x", Quantity::cross},
    Parameter{"centre_x", Quantity::length},
    Parameter{"centre_z", Quantity::length},
    Parameter{"step", Quantity::length},
    Parameter{"withdrawal", Quantity::length},
    Parameter{"stock_x", Quantity::length},
    Parameter{"stock_z", Quantity::length},
    Parameter{"total", Quantity::length},
    Parameter{"section", Quantity::length},
    Parameter{"depth", Quantity::length},
    Parameter{"infeed", Quantity::length},
    Parameter{"minimum_infeed", Quantity::length},
    Parameter{"clearance", Quantity::length},
    Parameter{"finish_stock", Quantity::length},
    Parameter{"pitch", Quantity::length},
    Parameter{"pitch_change", Quantity::length},
    Parameter{"exit", Quantity::length},
    Parameter{"peck", Quantity::length},
    Parameter{"minimum_peck", Quantity::length},
    Parameter{"lift", Quantity::length},
    Parameter{"reapproach", Quantity::length},
    Parameter{"length", Quantity::length},
    Parameter{"rough_feed", Quantity::feed},
    Parameter{"finish_feed", Quantity::feed},
    Parameter{"groove_feed", Quantity::feed},
    Parameter{"mill_feed", Quantity::feed},
    Parameter{"dwell", Quantity::centiseconds},
    Parameter{"infeed_angle", Quantity::plain},
    Parameter{"start_angle", Quantity::plain},
    Parameter{"first_angle", Quantity::plain},
    Parameter{"angle_step", Quantity::plain},
    Parameter{"count", Quantity::plain},
    Parameter{"starts", Quantity::plain},
    Parameter{"entry", Quantity::plain},
    Parameter{"repair", Quantity::plain},
    Parameter{"factor", Quantity::plain},
    Parameter{"main_axis", Quantity::plain},
    Parameter{"first_label", Quantity::plain},
    Parameter{"last_label", Quantity::plain},
    Parameter{"program", Quantity::plain},
    Parameter{"routine", Quantity::text},
    Parameter{"contour", Quantity::text},
    Parameter{"contour_fault", Quantity::text},
    Parameter{"contour_values", Quantity::text},
    Parameter{"live_speed", Quantity::plain},
    Parameter{"size", Quantity::plain},
    Parameter{"run_in", Quantity::length},
    Parameter{"run_out", Quantity::length},
    Parameter{"passes", Quantity::plain},
    Parameter{"idle", Quantity::plain},
    Parameter{"variant", Quantity::plain},
    Parameter{"stock", Quantity::length},
    Parameter{"chip_dwell", Quantity::plain},
    Parameter{"chip_length", Quantity::length},
    Parameter{"cone", Quantity::plain},
    Parameter{"axial_step", Quantity::length},
    Parameter{"reversed", Quantity::plain},
    Parameter{"entry_angle", Quantity::plain},
    Parameter{"limit_x", Quantity::cross},
    Parameter{"limit_z", Quantity::along},
    Parameter{"width", Quantity::length},
    Parameter{"slope_angle", Quantity::plain},
    Parameter{"flank_1", Quantity::plain},
    Parameter{"flank_2", Quantity::plain},
    Parameter{"outer_1", Quantity::length},
    Parameter{"outer_2", Quantity::length},
    Parameter{"inner_1", Quantity::length},
    Parameter{"inner_2", Quantity::length},
    Parameter{"stock_base", Quantity::length},
    Parameter{"stock_flank", Quantity::length},
    Parameter{"base_dwell", Quantity::plain},
    Parameter{"second_edge", Quantity::plain},
    Parameter{"group_step", Quantity::length},
    Parameter{"width_top", Quantity::length},
    Parameter{"mode", Quantity::plain},
    Parameter{"first_speed", Quantity::plain},
    Parameter{"speed_limit", Quantity::plain},
    Parameter{"second_speed", Quantity::plain},
    Parameter{"sense", Quantity::plain},
    Parameter{"catcher", Quantity::length},
    Parameter{"form", Quantity::plain},
    Parameter{"quadrant", Quantity::plain},
    Parameter{"position", Quantity::plain},
    Parameter{"nominal", Quantity::length},
    Parameter{"nominal_end", Quantity::length},
    Parameter{"change_depth", Quantity::length},
    Parameter{"flank_infeed", Quantity::length},
    Parameter{"first_infeed", Quantity::length},
    Parameter{"first_start", Quantity::plain},
    Parameter{"pitch_unit", Quantity::plain},
    Parameter{"display", Quantity::plain},
    Parameter{assumed_word, Quantity::text},
    Parameter{"assumed_width", Quantity::plain},
    // Words of newer signatures: carried, and only 0 is carried out.
    Parameter{"spare_1", Quantity::plain},
    Parameter{"spare_2", Quantity::plain},
    Parameter{"spare_3", Quantity::plain},
    Parameter{"spare_4", Quantity::plain},
    Parameter{"spare_5", Quantity::plain},
    Parameter{"spare_6", Quantity::plain},
    Parameter{"spare_7", Quantity::plain},
    Parameter{"spare_8", Quantity::plain},
    Parameter{"spare_9", Quantity::plain},
    Parameter{"spare_10", Quantity::plain},
    Parameter{"spare_11", Quantity::plain},
    Parameter{"spare_12", Quantity::plain},
    Parameter{"spare_13", Quantity::plain},
    Parameter{"spare_14", Quantity::plain},
};

using Kind = MachiningKind;
constexpr std::array cycles = {
    MachiningCycle{"turn.copy", Kind::copy, false, true, true},
    MachiningCycle{"turn.profile", Kind::profile, false, true, true},
    MachiningCycle{"face.profile", Kind::profile, true, true, true},
    MachiningCycle{"turn.straight", Kind::straight, false, false, false},
    MachiningCycle{"face.straight", Kind::straight, true, false, false},
    MachiningCycle{"turn.arc", Kind::arc, false, false, false},
    MachiningCycle{"face.arc", Kind::arc, true, false, false},
    MachiningCycle{"turn.drill", Kind::drill, true, true, false, CycleEnd::approach},
    MachiningCycle{"turn.thread", Kind::thread, false, true, false, CycleEnd::approach},
    MachiningCycle{"face.thread", Kind::thread, true, true, false, CycleEnd::approach},
    MachiningCycle{"turn.groove", Kind::groove, false, true, false},
    MachiningCycle{"face.groove", Kind::groove, true, true, false},
    MachiningCycle{"face.live_drill", Kind::live_drill, true, true, false, CycleEnd::approach},
    MachiningCycle{"side.live_drill", Kind::live_drill, false, true, false, CycleEnd::approach},
    MachiningCycle{"side.live_key", Kind::live_key, false, true, false, CycleEnd::approach},
    MachiningCycle{"thread.counted", Kind::thread, false, false, false, CycleEnd::elsewhere},
    MachiningCycle{"thread.chain", Kind::thread, false, false, false, CycleEnd::elsewhere},
    MachiningCycle{"thread.chased", Kind::thread, false, false, false},
    MachiningCycle{"stock.contour", Kind::profile, false, false, false, CycleEnd::elsewhere},
    MachiningCycle{"stock.blank", Kind::profile, false, false, false},
    MachiningCycle{"groove.shaped", Kind::shaped, false, false, false, CycleEnd::elsewhere},
    MachiningCycle{"groove.alternate", Kind::shaped, false, false, false, CycleEnd::elsewhere},
    MachiningCycle{"part.off", Kind::shaped, false, false, false, CycleEnd::elsewhere},
    MachiningCycle{"relief.shoulder", Kind::shaped, false, true, false, CycleEnd::elsewhere},
    MachiningCycle{"relief.thread", Kind::shaped, false, true, false, CycleEnd::elsewhere},
    MachiningCycle{"relief.placed", Kind::shaped, false, true, false, CycleEnd::elsewhere},
    MachiningCycle{"shape.thread", Kind::shaped, false, false, false, CycleEnd::elsewhere},
    MachiningCycle{"shape.corner", Kind::shaped, false, false, false, CycleEnd::elsewhere},
    MachiningCycle{"stock.groove", Kind::profile, false, false, false},
    MachiningCycle{"stock.reentrant", Kind::profile, false, false, false, CycleEnd::elsewhere},
    MachiningCycle{"groove.plunged", Kind::groove, false, false, false},
    MachiningCycle{"face.live_key", Kind::live_key, true, true, false, CycleEnd::approach},
};

}  // namespace

double factor_of(Quantity quantity, const TurnUnits& units) {
  switch (quantity) {
    case Quantity::cross: return units.cross;
    case Quantity::along: return units.along;
    case Quantity::length: return units.length;
    case Quantity::feed: return units.feed;
    case Quantity::centiseconds: return 0.01;
    case Quantity::plain:
    case Quantity::text: break;
  }
  return 1;
}

const Parameter* find_parameter(std::string_view name) {
  if (!name.starts_with("blank_")) return find_row(machining_parameters, name);
  struct Point {
    std::array<char, 10> x{}, z{};
  };
  static const auto names = [] {
    std::array<Point, most_blank_points> out;
    for (std::size_t k = 0; k < out.size(); ++k) {
      blank_name('x', k + 1).copy(out[k].x.data(), 9);
      blank_name('z', k + 1).copy(out[k].z.data(), 9);
    }
    return out;
  }();
  static const auto table = [] {
    std::vector<Parameter> out;
    for (const auto& p : names) {
      out.push_back({p.x.data(), Quantity::cross});
      out.push_back({p.z.data(), Quantity::along});
    }
    return out;
  }();
  return find_row(table, name);
}
std::string blank_name(char axis, std::size_t point) {
  return std::string("blank_") + axis + std::to_string(point);
}
const MachiningCycle* find_machining(std::string_view name) {
  return find_row(cycles, name);
}

std::string_view family_of(std::string_view cycle) {
  const auto* row = find_machining(cycle);
  if (row == nullptr) return {};
  switch (row->kind) {
    case Kind::profile: return cycle == "stock.groove" || cycle == "stock.reentrant" ? std::string_view{} : "stock";
    case Kind::copy: return "stock";
    case Kind::thread: return cycle == "thread.chain" ? std::string_view{} : "thread";
    case Kind::shaped: return cycle == "shape.thread" ? "thread" : std::string_view{};
    default: return {};
  }
}

std::optional<std::vector<TurnMove>> expand(const MachiningCycle& cycle, const TurnNumbers& numbers,
                                            const TurnContext& context, std::string* error) {
  error->clear();
  bool face = cycle.face;
  if (cycle.kind == Kind::copy) {
    const auto it = numbers.find("main_axis");
    if (it == numbers.end() && !context.longer_in_x) {
      *error = "the main axis of the cycle is not given and the lengths of the tool are not known";
      return std::nullopt;
    }
    face = it != numbers.end() ? it->second != 0 : !*context.longer_in_x;
  }
  if (cycle.name == "stock.contour" || cycle.name == "groove.shaped") {
    const auto it = numbers.find("variant");
    face = it != numbers.end() && std::fmod(std::abs(it->second), 2) == 0;
  } else if (cycle.name == "groove.alternate") {
    const auto it = numbers.find("variant");
    face = it != numbers.end() && std::fmod(std::floor(std::abs(it->second) / 100), 2) == 0;
  } else if (cycle.name == "stock.blank" || cycle.name == "stock.groove" || cycle.name == "stock.reentrant") {
    face = numbers.contains("axial_step");
  } else if (cycle.name == "groove.plunged") {
    const auto it = numbers.find("main_axis");
    face = it != numbers.end() && it->second != 0;
  }
  for (const auto& [name, value] : numbers) {
    if (!name.starts_with("spare_") || value == 0) continue;
    *error = "parameters of the cycle's newer signature other than 0 are not carried out";
    return std::nullopt;
  }
  if (const auto it = numbers.find("display"); it != numbers.end() && it->second != 0 && it->second != 2) {
    *error = "a cycle of the lathe in another plane than that of Z and X is not carried out";
    return std::nullopt;
  }
  if (cycle.name.starts_with("shape.")) return detail::newer_signature(cycle.name, numbers, context, error);
  const MachiningCycle turned{cycle.name, cycle.kind, face, cycle.ends_comp, cycle.ends_modes};
  detail::Roles roles(turned, numbers, context);
  bool done = false;
  switch (cycle.kind) {
    case Kind::straight:
    case Kind::arc: done = detail::straight_or_arc(cycle.kind == Kind::arc, roles, error); break;
    case Kind::drill: done = detail::axial_drill(roles, error); break;
    case Kind::thread:
      done = cycle.name == "thread.counted"  ? detail::counted_thread(roles, error)
             : cycle.name == "thread.chased" ? detail::chased_thread(roles, error)
             : cycle.name == "thread.chain"  ? detail::chained_thread(roles, error)
                                             : detail::thread(roles, error);
      break;
    case Kind::groove:
      done = cycle.name == "groove.plunged" ? detail::plunged_groove(roles, context.nose_width, face, error)
                                            : detail::groove(roles, context.nose_width, error);
      break;
    case Kind::shaped:
      done = cycle.name == "groove.shaped"      ? detail::shaped_groove(roles, context, face, error)
             : cycle.name == "groove.alternate" ? detail::alternate_groove(roles, context, face, error)
             : cycle.name == "part.off"         ? detail::part_off(roles, context, error)
                                                : detail::relief(roles, context, error);
      break;
    case Kind::profile:
      done = cycle.name == "stock.contour"     ? detail::contour_stock(roles, context, face, error)
             : cycle.name == "stock.blank"     ? detail::blank_stock(roles, context, face, error)
             : cycle.name == "stock.groove"    ? detail::groove_stock(roles, context, face, error)
             : cycle.name == "stock.reentrant" ? detail::reentrant_stock(roles, context, face, error)
                                               : detail::stock_removal(roles, context, face, false, error);
      break;
    case Kind::copy: done = detail::stock_removal(roles, context, face, cycle.kind == Kind::copy, error); break;
    case Kind::live_drill:
    case Kind::live_key: done = detail::live_tool(roles, cycle.kind == Kind::live_key, error); break;
  }
  if (!done) return std::nullopt;
  return roles.take();
}

}  // namespace cnctrans::ir::cycles
