// The support matrix of docs/dialects/fagor8055.md is made from the code tables and the registry of missing features.
// With CNCTRANS_WRITE_DOCS set the test writes it.
#include <gtest/gtest.h>

#include "dialects/fagor/g_codes.h"
#include "dialects/fagor/m_codes.h"
#include "dialects/fagor/variables.h"
#include "dialects/fagor/words.h"
#include "dialects/options.h"
#include "ir/check/missing_features.h"
#include "machine/data_at_rest.h"
#include "machine/profile.h"
#include "tests/language/matrix.h"

namespace cnctrans {
namespace {

namespace facts = dialects::fagor;
using facts::Use;

std::string reason(std::string_view key) {
  return "not carried: " + std::string(ir::missing_feature(key).title) + " (`" + std::string(key) + "`)";
}

/// What the function is: by its title, or by what it sets.
std::string what(const facts::GCode& g) {
  if (!g.title.empty()) return std::string(g.title.substr(g.title.rfind("the ", 0) == 0 ? 4 : 0));
  switch (g.use) {
    case Use::motion: return "motion: " + std::string(ir::name(g.motion));
    case Use::setting:
    case Use::setting_after:
    case Use::compensation:
      return std::string(ir::name(g.setting)) + ": " + std::string(ir::setting_value_name(g.setting, g.value));
    case Use::plane: return "plane: " + std::string(ir::setting_value_name(ir::Setting::plane, g.value));
    case Use::plane_axes: return "plane by its axes";
    case Use::dwell: return "dwell, stop of the preparation";
    case Use::absolute_centre: return "arc centre absolute";
    case Use::tangent_arc: return "tangent arc";
    case Use::three_point_arc: return "arc by three points";
    case Use::mirror_off: return "mirror off";
    case Use::mirror_axis:
    case Use::mirror_axes: return "mirror";
    case Use::round: return "corner rounding";
    case Use::chamfer: return "chamfer";
    case Use::tangent_entry: return "tangential entry";
    case Use::tangent_exit: return "tangential exit";
    case Use::look_ahead: return "look-ahead";
    case Use::soft_corner: return "controlled corner";
    case Use::machine_coordinates: return "machine coordinates, offset off";
    case Use::work_offset: return "zero offset";
    case Use::table_shift: return "zero offset on top";
    case Use::numbered_offset: return "zero offset by number";
    case Use::shift: return "programmed shift";
    case Use::preset: return "preset, speed limit";
    case Use::pole: return "polar origin";
    case Use::scale: return "scale";
    case Use::rotation: return "rotation";
    case Use::inclined_plane: return "inclined plane";
    case Use::home: return "home search";
    case Use::cycle_cancel: return "cycle off";
    case Use::call: return "subroutine of the same number";
    default: return "";
  }
}

std::string support(const facts::GCode& g) {
  switch (g.use) {
    case Use::refused:
      return std::string(g.code == 46 ? "S0 and S1 kept as text: no effect on the programmed point (FAG-008); S2 "
                                      : "") +
             reason(g.feature);
    case Use::no_path: return "kept as text: no effect on the path (FAG-008)";
    case Use::spindle_choice: return "spindles: carried; with axes: carried for straight moves (FAG-051)";
    case Use::spindle_couple:
      return "spindles: kept as text (FAG-037)" + (g.code == 30 ? "" : "; axes " + reason("beside.coupling"));
    case Use::soft_corner:
    case Use::look_ahead: return "carried as G05 (FAG-008)";
    case Use::c_axis: return "alone kept as text: C in degrees (FAG-008); with R carried (FAG-045)";
    case Use::plane_axes:
      return "carried for XY, ZX, YZ, on the lathe also XC and ZC (FAG-045); others " + reason("motion.transformation");
    case Use::inclined_plane: return "carried with A B C, with Q R S, with T (FAG-054) and with I J K (FAG-102)";
    case Use::home: return "carried with axes; alone " + reason("block.word");
    default: return "carried";
  }
}

/// Canned cycles have a chapter of their own on the page.
bool is_cycle(const facts::GCode& g) {
  return (g.code >= 60 && g.code <= 69) || (g.code >= 79 && g.code <= 89) || (g.code >= 210 && g.code <= 212);
}

std::string g_table() {
  std::string s = "| G | Model | Function | Reference | Support |\n|---|---|---|---|---|\n";
  for (const auto& g : facts::g_codes()) {
    if (is_cycle(g)) continue;
    const char* model = g.model == facts::Model::both ? "" : g.model == facts::Model::mill ? "M" : "T";
    s += "| G" + std::to_string(g.code) + " | " + model + " | " + what(g) + " | " + std::string(g.section) + " | " +
         support(g) + " |\n";
  }
  return s;
}

std::string statement_table() {
  std::string s = "| Statement | Meaning | Reference | Support |\n|---|---|---|---|\n";
  for (const auto& w : facts::statements) {
    const std::string how = w.carried == facts::Carried::yes       ? "carried"
                            : w.carried == facts::Carried::no_path ? "kept as text: no effect on the path (FAG-023)"
                                                                   : reason(w.feature);
    s += "| `" + std::string(w.word) + "` | " + std::string(w.title) + " | " + std::string(w.section) + " | " + how +
         " |\n";
  }
  return s;
}

std::string m_table() {
  std::string s = "| M | Acts |\n|---|---|\n";
  for (const auto& m : facts::m_codes) {
    s += "| M" + std::to_string(m.code) + " | " + (m.order == ir::Order::after ? "after" : "before") + " |\n";
  }
  return s + "| others | before; event `m` |\n";
}

std::string variable_table() {
  std::string error;
  const auto lathe = dialects::load_profile("fagor-lathe", &error), mill = dialects::load_profile("fagor-mill", &error);
  const auto given = [&](const facts::VariableInfo& v) {
    const std::string name = std::string(v.name) + (v.axis ? "X" : "");
    const auto in = [](const machine::Profile& p, const std::string& key) {
      return p.data.count(key) != 0 || p.data.count(key + "[*]") != 0;
    };
    return in(*lathe, name) || in(*mill, name);
  };
  const auto name_in = [&](const facts::VariableInfo& v) {
    return std::string(v.name) + (v.axis ? "X" : "") + (v.index == facts::Index::none ? "" : "[0]");
  };
  std::string s = "| Variable | Access | Unit | Answered by |\n|---|---|---|---|\n";
  for (const auto& v : facts::variables()) {
    const std::string_view access = v.access == facts::Access::read         ? "R"
                                    : v.access == facts::Access::write      ? "W"
                                    : v.access == facts::Access::read_write ? "R/W"
                                                                            : "-";
    const std::string index = v.index == facts::Index::always ? "n" : v.index == facts::Index::maybe ? "[n]" : "";
    const std::string by = given(v)                                  ? "the profile"
                           : v.datum != ir::Datum::other             ? "the program"
                           : v.access == facts::Access::write        ? "-"
                           : machine::data_of_run(*mill, name_in(v)) ? "the program"
                           : machine::data_at_rest(*mill, name_in(v))
                               ? "`--set` or the profile, else a machine at rest (RUN-044)"
                               : "`--set` or the profile: " + reason("language.system_variable");
    s += "| `" + std::string(v.name) + (v.axis ? "(X-C)" : "") + index + "` | " + std::string(access) + " | " +
         std::string(facts::name(v.unit)) + " | " + by + " |\n";
  }
  return s;
}

TEST(SupportMatrix, OfFagorIsTheOneOfTheTables) {
  const std::string made = "\n### G functions\n\n" + g_table() + "\n### Statements\n\n" + statement_table() +
                           "\n### M functions\n\n" + m_table() + "\n### Variables\n\n" + variable_table() + "\n";
  expect_support_matrix("fagor8055.md", made);
}

}  // namespace
}  // namespace cnctrans
