#include "dialects/fagor/g_codes.h"

#include <array>

namespace cnctrans::dialects::fagor {

namespace {

using ir::MotionKind;
using ir::Setting;

constexpr GCode motion(std::int16_t code, MotionKind kind, std::string_view section) {
  return {code, Model::both, Group::motion, Use::motion, Setting::plane, 0, kind, false, section};
}
constexpr GCode straight(std::int16_t code, MotionKind kind, std::string_view section, std::string_view title) {
  return {code, Model::both, Group::motion, Use::straight, Setting::plane, 0, kind, false, section, title};
}
template <class Value>
constexpr GCode setting(std::int16_t code, Model model, Group group, Setting s, Value value, std::string_view section) {
  return {code, model, group, Use::setting, s, static_cast<std::uint8_t>(value), MotionKind::modal, false, section};
}
constexpr GCode own(std::int16_t code, Model model, Group group, Use use, std::uint8_t value, bool alone,
                    std::string_view section, std::string_view title = {}) {
  return {code, model, group, use, Setting::plane, value, MotionKind::modal, alone, section, title};
}
constexpr GCode comp(std::int16_t code, ir::CompSide side) {
  return {code,
          Model::both,
          Group::compensation,
          Use::compensation,
          Setting::comp,
          static_cast<std::uint8_t>(side),
          MotionKind::modal,
          false,
          "8.2"};
}
constexpr GCode carried(std::int16_t code, Model model, std::string_view section, std::string_view title,
                        std::string_view feature) {
  return {code, model, Group::none, Use::no_path, Setting::plane, 0, MotionKind::modal, true, section, title, feature};
}
constexpr GCode refused(std::int16_t code, Model model, std::string_view section, std::string_view title,
                        std::string_view feature) {
  return {code, model, Group::none, Use::refused, Setting::plane, 0, MotionKind::modal, true, section, title, feature};
}
constexpr GCode call(std::int16_t code) {
  return own(code, Model::both, Group::none, Use::call, 0, true, "12.5.1");
}

constexpr auto T = Model::lathe;
constexpr auto M = Model::mill;
constexpr auto B = Model::both;

constexpr std::array g_table = {
    motion(0, MotionKind::rapid, "6.1"),
    motion(1, MotionKind::linear, "6.2"),
    motion(2, MotionKind::arc_cw, "6.3"),
    motion(3, MotionKind::arc_ccw, "6.3"),
    own(4, B, Group::none, Use::dwell, 0, false, "7.1"),
    setting(5, B, Group::corner, Setting::path_mode, ir::PathMode::continuous, "7.3"),
    own(6, B, Group::none, Use::absolute_centre, 0, false, "6.4"),
    setting(7, B, Group::corner, Setting::path_mode, ir::PathMode::exact_stop, "7.3"),
    own(8, B, Group::none, Use::tangent_arc, 0, false, "6.5"),
    own(9, B, Group::none, Use::three_point_arc, 0, false, "6.6"),
    own(10, B, Group::none, Use::mirror_off, 0, false, "7.5"),
    own(11, B, Group::none, Use::mirror_axis, ir::axis::x, false, "7.5"),
    own(12, B, Group::none, Use::mirror_axis, ir::axis::y, false, "7.5"),
    own(13, B, Group::none, Use::mirror_axis, ir::axis::z, false, "7.5"),
    own(14, B, Group::none, Use::mirror_axes, 0, true, "7.5"),
    own(15, T, Group::none, Use::c_axis, 0, true, "6.15", "the C axis"),
    own(15, M, Group::none, Use::longitudinal, 0, true, "25.1", "the choice of the longitudinal axis"),
    own(16, B, Group::plane, Use::plane_axes, 0, true, "3.2"),
    own(17, B, Group::plane, Use::plane, static_cast<std::uint8_t>(ir::Plane::xy), false, "3.2"),
    own(18, B, Group::plane, Use::plane, static_cast<std::uint8_t>(ir::Plane::zx), false, "3.2"),
    own(19, B, Group::plane, Use::plane, static_cast<std::uint8_t>(ir::Plane::yz), false, "3.2"),
    carried(20, B, "3.8", "a work zone limit", "work_zone"),
    carried(21, B, "3.8", "a work zone limit", "work_zone"),
    carried(22, B, "3.8", "a work zone", "work_zone"),
    refused(23, M, "25.9", "tracing", "motion.probe"),
    refused(24, M, "25.9", "digitising", "motion.probe"),
    refused(25, M, "25.9", "tracing", "motion.probe"),
    refused(27, M, "25.9", "tracing", "motion.probe"),
    GCode{28, B, Group::none, Use::spindle_choice, Setting::plane, 2, MotionKind::modal, true, "5.4, 7.8",
          "the exchange of axes", "language.synchronised"},
    GCode{29, B, Group::none, Use::spindle_choice, Setting::plane, 1, MotionKind::modal, true, "5.4, 7.8",
          "the exchange of axes", "language.synchronised"},
    GCode{30, B, Group::none, Use::spindle_couple, Setting::plane, 0, MotionKind::modal, true, "5.5",
          "spindle synchronisation", "language.synchronised"},
    setting(32, B, Group::feed, Setting::feed_mode, ir::FeedMode::inverse_time, "5.2"),
    motion(33, MotionKind::thread, "6.12"),
    motion(34, MotionKind::thread_variable, "6.14"),
    own(36, B, Group::none, Use::round, 0, false, "6.10"),
    own(37, B, Group::none, Use::tangent_entry, 0, false, "6.8"),
    own(38, B, Group::none, Use::tangent_exit, 0, false, "6.9"),
    own(39, B, Group::none, Use::chamfer, 0, false, "6.11"),
    comp(40, ir::CompSide::off),
    comp(41, ir::CompSide::left),
    comp(42, ir::CompSide::right),
    setting(43, M, Group::length, Setting::length_comp, ir::OnOff::on, "25.1"),
    setting(44, M, Group::length, Setting::length_comp, ir::OnOff::off, "25.1"),
    refused(45, B, "6.18", "tangential control", "beside.coupling"),
    refused(46, B, "13", "the angular axis", "motion.transformation"),
    refused(47, M, "25.6", "the tool axis move", "motion.transformation"),
    refused(48, M, "25.6", "the tool centre point transformation", "beside.compensation"),
    GCode{49, M, Group::none, Use::inclined_plane, Setting::plane, 0, MotionKind::modal, true, "25.6",
          "the inclined plane", "motion.transformation"},
    own(50, B, Group::corner, Use::soft_corner, 0, false, "7.3"),
    own(51, B, Group::corner, Use::look_ahead, 0, true, "7.4"),
    straight(52, MotionKind::to_stop, "6.16", "the move to a hard stop"),
    own(53, B, Group::offset, Use::machine_coordinates, 0, false, "4.3"),
    own(54, B, Group::offset, Use::work_offset, 1, true, "4.4.2"),
    own(55, B, Group::offset, Use::work_offset, 2, true, "4.4.2"),
    own(56, B, Group::offset, Use::work_offset, 3, true, "4.4.2"),
    own(57, B, Group::offset, Use::work_offset, 4, true, "4.4.2"),
    own(58, B, Group::offset, Use::table_shift, 5, true, "4.4.2"),
    own(59, B, Group::offset, Use::table_shift, 6, true, "4.4.2"),
    own(60, T, Group::none, Use::machining, 60, false, "9.13", "a driven-tool cycle"),
    own(61, T, Group::none, Use::machining, 61, false, "9.14", "a driven-tool cycle"),
    own(62, T, Group::none, Use::machining, 62, false, "9.16", "a keyway cycle"),
    own(63, T, Group::none, Use::machining, 63, false, "9.17", "a keyway cycle"),
    own(60, M, Group::none, Use::pattern, 60, false, "25.4", "multiple machining on a line"),
    own(61, M, Group::none, Use::pattern, 61, false, "25.4", "multiple machining on a parallelogram"),
    own(62, M, Group::none, Use::pattern, 62, false, "25.4", "multiple machining on a grid"),
    own(63, M, Group::none, Use::pattern, 63, false, "25.4", "multiple machining on a circle"),
    own(64, M, Group::none, Use::pattern, 64, false, "25.4", "multiple machining on an arc"),
    own(65, M, Group::none, Use::pattern, 65, false, "25.4", "machining by an arc's chord"),
    own(66, T, Group::none, Use::machining, 66, false, "9.1", "the pattern repeat cycle"),
    own(66, M, Group::none, Use::pocket, 66, false, "25.5", "the irregular pocket"),
    own(67, M, Group::none, Use::pocket, 67, false, "25.5", "the pocket's roughing"),
    own(68, T, Group::none, Use::machining, 68, false, "9.2", "the stock removal cycle along X"),
    own(68, M, Group::none, Use::pocket, 68, false, "25.5", "the pocket's finishing"),
    own(69, T, Group::none, Use::machining, 69, false, "9.3", "the stock removal cycle along Z"),
    own(69, M, Group::none, Use::hole_cycle, 69, false, "25.3", "the deep hole cycle with variable pecks"),
    setting(70, B, Group::units, Setting::units, ir::Units::inch, "3.3"),
    setting(71, B, Group::units, Setting::units, ir::Units::metric, "3.3"),
    own(72, B, Group::none, Use::scale, 0, true, "7.6"),
    own(73, M, Group::none, Use::rotation, 0, true, "25.1"),
    own(74, B, Group::none, Use::home, 0, false, "4.2"),
    straight(75, MotionKind::probe_toward, "10.1", "the probing move"),
    straight(76, MotionKind::probe_away, "10.1", "the probing move"),
    GCode{77, B, Group::none, Use::spindle_couple, Setting::plane, 0, MotionKind::modal, true, "5.5, 7.7",
          "axis coupling", "language.synchronised"},
    GCode{78, B, Group::none, Use::spindle_couple, Setting::plane, 0, MotionKind::modal, true, "5.5, 7.7",
          "axis coupling", "language.synchronised"},
    own(79, M, Group::none, Use::cycle_change, 0, false, "25.2", "the change of a cycle's parameters"),
    own(80, M, Group::none, Use::cycle_cancel, 0, false, "25.2"),
    own(81, T, Group::none, Use::machining, 81, false, "9.4", "the turning cycle"),
    own(82, T, Group::none, Use::machining, 82, false, "9.5", "the facing cycle"),
    own(83, T, Group::none, Use::machining, 83, false, "9.6", "the axial drilling and tapping cycle"),
    own(84, T, Group::none, Use::machining, 84, false, "9.7", "the turning cycle with an arc"),
    own(85, T, Group::none, Use::machining, 85, false, "9.8", "the facing cycle with an arc"),
    own(86, T, Group::none, Use::machining, 86, false, "9.9", "the longitudinal threading cycle"),
    own(87, T, Group::none, Use::machining, 87, false, "9.10", "the face threading cycle"),
    own(88, T, Group::none, Use::machining, 88, false, "9.11", "the grooving cycle along X"),
    own(89, T, Group::none, Use::machining, 89, false, "9.12", "the grooving cycle along Z"),
    own(81, M, Group::none, Use::hole_cycle, 81, false, "25.3", "the drilling cycle"),
    own(82, M, Group::none, Use::hole_cycle, 82, false, "25.3", "the drilling cycle with dwell"),
    own(83, M, Group::none, Use::hole_cycle, 83, false, "25.3", "the deep hole cycle"),
    own(84, M, Group::none, Use::hole_cycle, 84, false, "25.3", "the tapping cycle"),
    own(85, M, Group::none, Use::hole_cycle, 85, false, "25.3", "the reaming cycle"),
    own(86, M, Group::none, Use::hole_cycle, 86, false, "25.3", "the boring cycle"),
    own(87, M, Group::none, Use::hole_cycle, 87, false, "25.3", "the rectangular pocket"),
    own(88, M, Group::none, Use::hole_cycle, 88, false, "25.3", "the circular pocket"),
    own(89, M, Group::none, Use::hole_cycle, 89, false, "25.3", "the boring cycle"),
    setting(90, B, Group::distance, Setting::distance, ir::Distance::absolute, "3.4"),
    setting(91, B, Group::distance, Setting::distance, ir::Distance::incremental, "3.4"),
    own(92, B, Group::offset, Use::preset, 0, true, "4.4.1"),
    own(93, B, Group::none, Use::pole, 0, true, "4.5"),
    setting(94, B, Group::feed, Setting::feed_mode, ir::FeedMode::per_minute, "5.2"),
    setting(95, B, Group::feed, Setting::feed_mode, ir::FeedMode::per_rev, "5.2"),
    setting(96, T, Group::speed_mode, Setting::spindle_mode, ir::SpindleMode::css, "5.3"),
    setting(97, T, Group::speed_mode, Setting::spindle_mode, ir::SpindleMode::rpm, "5.3"),
    setting(96, M, Group::speed_mode, Setting::feed_point, ir::FeedPoint::contact, "25.1"),
    setting(97, M, Group::speed_mode, Setting::feed_point, ir::FeedPoint::centre, "25.1"),
    setting(98, M, Group::retract, Setting::retract_plane, ir::RetractPlane::initial, "25.2"),
    setting(99, M, Group::retract, Setting::retract_plane, ir::RetractPlane::reference, "25.2"),
    refused(145, B, "6.19", "tangential control", "beside.coupling"),
    GCode{151, T, Group::diameter, Use::setting_after, Setting::diameter,
          static_cast<std::uint8_t>(ir::DiameterMode::diameter), MotionKind::modal, false, "3.5"},
    GCode{152, T, Group::diameter, Use::setting_after, Setting::diameter,
          static_cast<std::uint8_t>(ir::DiameterMode::radius), MotionKind::modal, false, "3.5"},
    own(158, B, Group::offset, Use::shift, 0, true, "4.4.2"),
    own(159, B, Group::offset, Use::numbered_offset, 0, true, "4.4.2"),
    call(180),
    call(181),
    call(182),
    call(183),
    call(184),
    call(185),
    call(186),
    call(187),
    call(188),
    call(189),
    refused(210, M, "25.3", "bore milling", "cycle.milling"),
    refused(211, M, "25.3", "thread milling", "cycle.milling"),
    refused(212, M, "25.3", "thread milling", "cycle.milling"),
    carried(233, B, "6.13", "the withdrawal after a stop in a thread", "block.word"),
    call(380),
    call(381),
    call(382),
    call(383),
    call(384),
    call(385),
    call(386),
    call(387),
    call(388),
    call(389),
    call(390),
    call(391),
    call(392),
    call(393),
    call(394),
    call(395),
    call(396),
    call(397),
    call(398),
    call(399),
};

/// Row number + 1 of every code; 0: none. One table a model.
constexpr std::array<std::uint8_t, max_g_code + 1> rows_of(Model model) {
  std::array<std::uint8_t, max_g_code + 1> rows{};
  for (std::size_t i = 0; i < g_table.size(); ++i) {
    if ((static_cast<int>(g_table[i].model) & static_cast<int>(model)) != 0) {
      rows[static_cast<std::size_t>(g_table[i].code)] = static_cast<std::uint8_t>(i + 1);
    }
  }
  return rows;
}
static_assert(g_table.size() < 255);
constexpr auto lathe_rows = rows_of(Model::lathe);
constexpr auto mill_rows = rows_of(Model::mill);

}  // namespace

std::span<const GCode> g_codes() {
  return g_table;
}

const GCode* find_g(int code, bool lathe) {
  if (code < 0 || code > max_g_code) return nullptr;
  const std::uint8_t row = (lathe ? lathe_rows : mill_rows)[static_cast<std::size_t>(code)];
  return row == 0 ? nullptr : &g_table[row - 1];
}

}  // namespace cnctrans::dialects::fagor
