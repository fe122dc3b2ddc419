#include "machine/options.h"

#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>
#include <vector>

#include "base/nearest.h"
#include "base/text.h"

namespace cnctrans::machine {
namespace {

template <auto Field>
void put(Policies& out, std::string_view value, std::size_t at) {
  using T = std::remove_reference_t<decltype(out.*Field)>;
  if constexpr (std::is_same_v<T, std::string>) {
    out.*Field = value;
  } else if constexpr (std::is_same_v<T, double>) {
    out.*Field = parse_decimal(value).value_or(0);
  } else {
    out.*Field = static_cast<T>(at);
  }
}

constexpr std::array specs{
    // Read by the interpreter, whatever the control.
    OptionSpec{"arc.tangent_straight", "error|line", "error", &put<&Policies::arc_tangent_straight>,
               "a tangent arc whose end lies straight ahead: refused, or the straight line there"},
    OptionSpec{"block.m_functions", "number", "0", &put<&Policies::block_m_functions>,
               "M functions that a block takes; 0: no limit"},
    OptionSpec{"block.machine_functions", "number", "0", &put<&Policies::block_machine_functions>,
               "functions of the machine among the M functions that a block takes; 0: no limit"},
    OptionSpec{"calls.local_levels", "number", "0", &put<&Policies::calls_local_levels>,
               "levels of own local parameters that may be open at once; 0: no limit"},
    OptionSpec{
        "call.missing", "error|passed_over", "error", &put<&Policies::call_missing>,
        "a call of a subprogram that is nowhere: the program is refused, or a run goes past the call with a warning"},
    OptionSpec{
        "call.decoration", "text", "", &put<&Policies::call_decoration>,
        "what the name of a called program may have about it in a computed text: a prefix and suffixes, separated by "
        "|; folders before it count for nothing then"},
    OptionSpec{"call.modal_in_modal", "allowed|refused", "allowed", &put<&Policies::call_modal_in_modal>,
               "a modal call of a program within a program that is called modally itself: it takes its place, or an "
               "error"},
    OptionSpec{"call.modal_words", "no|yes", "no", &put<&Policies::call_modal_words>,
               "under a modal call of a subprogram, F, S and a bare G0 or G1 run it as well, without motion"},
    OptionSpec{
        "call.uncalled_state", "when_needed|unknown|power_on", "when_needed", &put<&Policies::call_uncalled_state>,
        "what a subprogram that nothing at hand calls starts with in a translation: nothing is known, or the state "
        "of power-on; when_needed: that state where the program would be refused without it"},
    OptionSpec{"corner.chamfer_at_arc", "no|yes", "no", &put<&Policies::corner_chamfer_at_arc>,
               "a chamfer at an arc: cut off along the elements, or refused"},
    OptionSpec{"corner.without_successor", "error|left_out", "error", &put<&Policies::corner_without_successor>,
               "a corner function that no second element in the plane follows: refused, or left out with a warning"},
    OptionSpec{"call.saves_modals", "no|yes", "no", &put<&Policies::call_saves_modals>,
               "a subprogram can give its caller the modal state back (SAVE)"},
    OptionSpec{"comp.interruptions", "taken|refused", "taken", &put<&Policies::comp_interruptions>,
               "a stop (M00, M01) or a move in machine coordinates while radius compensation is on"},
    OptionSpec{"comp.rapid", "kept|suspended", "kept", &put<&Policies::comp_rapid>,
               "a rapid move while radius compensation is on: compensated, or carried out without it"},
    OptionSpec{"comp.rotation", "kept|ended", "kept", &put<&Policies::comp_rotation>,
               "radius compensation where the coordinates are rotated"},
    OptionSpec{"corner.straight_on", "left_out|refused", "left_out", &put<&Policies::corner_straight_on>,
               "a corner function of a block between two elements that meet without a corner: nothing is inserted, or "
               "an error"},
    OptionSpec{
        "stop.spindle", "goes_on|stops", "goes_on", &put<&Policies::stop_spindle>,
        "a stop of the program (M00, M01 where the operator asks for it): the spindle turns on, or stands still"},
    OptionSpec{"cycle.axis_word", "moves|refused", "moves", &put<&Policies::cycle_axis_word>,
               "a word of the tool axis in a block while a hole cycle is active: a move, or an error"},
    OptionSpec{"cycle.levels", "as_written|by_mode", "as_written", &put<&Policies::cycle_levels>,
               "levels of a cycle in a block under increments: each says what it is, or all follow the mode"},
    OptionSpec{"cycle.below_reference", "passes|refused", "passes", &put<&Policies::cycle_below_reference>,
               "a hole cycle called while the tool stands between its reference plane and its depth"},
    OptionSpec{
        "cycle.stops", "needed|all", "needed", &put<&Policies::cycle_stops>,
        "what a run says of a hole cycle: the moves that it needs, or its stop at the reference plane on the way "
        "out and each turn of the spindle of a tap that breaks chips as well"},
    OptionSpec{"cycle.positioning", "modal|rapid", "modal", &put<&Policies::cycle_positioning>,
               "how a block reaches the next hole of a modal cycle when it writes no motion code of its own"},
    OptionSpec{"cycle.pocket_entry", "arc|straight", "arc", &put<&Policies::cycle_pocket_entry>,
               "finishing of a pocket with islands: onto the wall and off it on a quadrant, or straight down onto it"},
    OptionSpec{"cycle.pocket_links", "at_depth|over", "at_depth", &put<&Policies::cycle_pocket_links>,
               "from one ring of such a pocket to the next: through the pocket where no wall lies between, or always "
               "over the reference plane"},
    OptionSpec{"cycle.pocket_tolerance", "number", "0.001", &put<&Policies::cycle_pocket_tolerance>,
               "mm by which chords may leave the arcs of such a pocket where its area is computed: 0.00001 to 0.1"},
    OptionSpec{
        "cycle.relief_edge", "usual|refused", "usual", &put<&Policies::cycle_relief_edge>,
        "an undercut whose side follows from a tool of which the profile gives no nose 1 to 4: outside (DIN 76 C "
        "and D inside) with the shoulder toward -Z, or refused"},
    OptionSpec{"cycle.rotary_triggers", "no|yes", "no", &put<&Policies::cycle_rotary_triggers>,
               "a rotary axis word alone runs the modal hole cycle too"},
    OptionSpec{"cycle.plane_function", "keeps|ends", "keeps", &put<&Policies::cycle_plane_function>,
               "a plane function while a hole cycle is active"},
    OptionSpec{"cycle.face_groove_left", "unknown|larger_x|smaller_x", "unknown",
               &put<&Policies::cycle_face_groove_left>,
               "where the left start of a shaped groove in the face lies; unknown: such grooves are refused"},
    OptionSpec{"cycle.groove_edge", "minus|plus", "minus", &put<&Policies::cycle_groove_edge>,
               "which corner of its insert is the programmed point of a grooving tool whose nose is not 1 to 4"},
    OptionSpec{"cycle.groove_depth", "smaller|absolute|increment", "smaller", &put<&Policies::cycle_groove_depth>,
               "depth of an alternating groove that does not say how it counts: from the surface, if that is not the "
               "deeper cut (else refused), a coordinate of the base, or from the surface"},
    OptionSpec{"cycle.groove_dwell", "number", "0", &put<&Policies::cycle_groove_dwell>,
               "seconds that an alternating groove waits behind each plunge"},
    OptionSpec{"cycle.groove_position", "as_shaped|mirrored", "as_shaped", &put<&Policies::cycle_groove_position>,
               "on which side of an alternating groove its start lies: by the digits of the shaped groove, or on the "
               "other one"},
    OptionSpec{
        "cycle.parting_after", "kept|restored", "kept", &put<&Policies::cycle_parting_after>,
        "parting off: behind it the spindle turns as at its end, or speed and G96 or G97 of the caller come back"},
    OptionSpec{"cycle.parting_part", "plus|minus", "plus", &put<&Policies::cycle_parting_part>,
               "parting off: the part lies toward +Z of the place in the call and the insert toward -Z, or the other "
               "way round"},
    OptionSpec{"cycle.parting_retract", "always|by_variant", "always", &put<&Policies::cycle_parting_retract>,
               "parting off: the tool goes back at the end whatever the variant, or stays at the depth with 1"},
    OptionSpec{"cycle.parting_speed", "by_limit|by_mode", "by_limit", &put<&Policies::cycle_parting_speed>,
               "parting off: a speed that comes with a limit is a cutting speed, or only the mode says so"},
    OptionSpec{"file.lines", "opened|named", "opened", &put<&Policies::file_lines>,
               "how a program writes lines into a program of the control: into the one it has opened, or each says "
               "which one"},
    OptionSpec{"frame.change_keeps", "machine|programmed", "machine", &put<&Policies::frame_change_keeps>,
               "what an incremental word adds to after a frame change: the present point seen in the new frame, or the "
               "coordinate programmed last (the difference of the frames is travelled)"},
    OptionSpec{"frame.first_arc", "any|absolute_centre", "any", &put<&Policies::frame_first_arc>,
               "how an arc gives its centre that is the first move behind a mirror or a rotation"},
    OptionSpec{
        "frame.mirror_order", "stated|assumed_with_rotation|assumed", "stated", &put<&Policies::frame_mirror_order>,
        "whether the maker's manual says in which order a mirror and the other parts of the frame apply: yes, not "
        "beside a rotation, not beside a rotation or a shift"},
    OptionSpec{"frame.plane_change", "keeps|may_end_rotation", "keeps", &put<&Policies::frame_plane_change>,
               "a plane function while a rotation is in force: the rotation stays, or that is not certain"},
    OptionSpec{"frame.shift", "as_said|by_distance", "as_said", &put<&Policies::frame_shift>,
               "what increments make of the words of a shift: add to it"},
    OptionSpec{
        "frame.preset", "own|with_work_offset", "own", &put<&Policies::frame_preset>,
        "a preset of the zero point stands by itself, or belongs to the work offset and is out of force with it"},
    OptionSpec{"arc.through_point", "in_plane|in_space", "in_plane", &put<&Policies::arc_through_point>,
               "an arc through a point that also moves along the third axis: a helix, or a circle in space"},
    OptionSpec{"frame.preset_outlasts", "no|yes", "no", &put<&Policies::frame_preset_outlasts>,
               "a preset of the zero point is written into the datum table: it holds on behind the end of the program"},
    OptionSpec{"frame.rotation_centre", "as_written|scaled_and_mirrored", "as_written",
               &put<&Policies::frame_rotation_centre>,
               "whether the centre of a rotation goes through scale and mirror"},
    OptionSpec{"compare.equal_within", "number", "0", &put<&Policies::compare_equal_within>,
               "two numbers that differ by no more than this are equal for = and <>; 0: exactly equal"},
    OptionSpec{"helix.pitch_mismatch", "error|nearest", "error", &put<&Policies::helix_pitch_mismatch>,
               "a helix whose pitch does not fit its travel: refused, or run with the nearest pitch"},
    OptionSpec{
        "machine_data.lengths", "text", "", &put<&Policies::machine_data_lengths>,
        "names of machine data that are lengths, separated by |, with * and # as in \"data_at_rest\": written in "
        "the unit that machine_data.units tells, and kept in mm"},
    OptionSpec{
        "machine_data.units", "modal|machine|with_feed", "machine", &put<&Policies::machine_data_units>,
        "lengths read from machine data: in the unit and diameter mode in force, always mm and radius, or in the "
        "unit in force as long as it is that of F too"},
    OptionSpec{"machine_move.units", "modal|machine", "modal", &put<&Policies::machine_move_units>,
               "unit of machine coordinates: as the other words, or always millimetres"},
    OptionSpec{"machine_position.scale", "radius|words", "radius", &put<&Policies::machine_position_scale>,
               "how a program reads a machine position: radius in mm, or in the unit and diameter mode of its words"},
    OptionSpec{"machine_move.words", "modal|absolute", "modal", &put<&Policies::machine_move_words>,
               "words of a move in machine coordinates: increments in incremental mode, or positions in any mode"},
    OptionSpec{"path.curve_tolerance", "number", "0.001", &put<&Policies::path_curve_tolerance>,
               "mm (degrees on rotary axes) by which the straight steps of a spline or polynomial leave the curve at "
               "most: 0.000001 to 1"},
    OptionSpec{"polar.plane_resets_pole", "no|yes", "no", &put<&Policies::polar_plane_resets_pole>,
               "a plane function puts the pole to the zero point"},
    OptionSpec{"polar.pole_follows_arc", "no|yes", "no", &put<&Policies::polar_pole_follows_arc>,
               "the centre of an arc becomes the pole"},
    OptionSpec{"polar.radius", "present|programmed", "present", &put<&Policies::polar_radius>,
               "radius of polar words without one: the tool's distance from the pole, or the one programmed last"},
    OptionSpec{"polar.pole_stays", "no|yes", "no", &put<&Policies::polar_pole_stays>,
               "a pole that the program has set stays in its place when the zero point moves, or moves along"},
    OptionSpec{"feed.mixed_axes", "resultant|linear", "resultant", &put<&Policies::feed_mixed_axes>,
               "what F counts where linear and rotary axes move together: degrees as millimetres of one way, or the "
               "linear axes alone"},
    OptionSpec{"rotary.direction", "by_sign|in_word", "by_sign", &put<&Policies::rotary_direction>,
               "how a rotary move says its direction: by the sign of its value, or by a word of its own"},
    OptionSpec{"round_up.negative", "stated|unstated", "stated", &put<&Policies::round_up_negative>,
               "whether the maker's manual says what rounding up makes of a negative value"},
    OptionSpec{
        "run.faults", "before|when_reached", "before", &put<&Policies::run_faults>,
        "blocks that can't be read, labels and subprograms that are nowhere, where the program could come to them: "
        "it is refused before anything moves, or the run stops where it does come to one"},
    OptionSpec{"cycle.unknown_radius", "assumed|stop", "assumed", &put<&Policies::cycle_unknown_radius>,
               "a milling cycle whose tool has no known radius: its passes are those of a usual tool, with a warning, "
               "or the run stops"},
    OptionSpec{"thread.pitch", "each_block|modal", "each_block", &put<&Policies::thread_pitch>,
               "how long the pitch of a thread (G33) stays in force"},
    OptionSpec{"thread.start_angle", "block|modal", "block", &put<&Policies::thread_start_angle>,
               "how long the start angle of a thread stays in force"},
    OptionSpec{"tool.bare_offset", "kept|table|edge", "kept", &put<&Policies::tool_bare_offset>,
               "offset of a tool that comes without a D: the one in force stays, the one that the tool table has for "
               "the tool, or an edge that machine data name"},
    OptionSpec{"tool.length_axis", "tool|plane", "tool", &put<&Policies::tool_length_axis>,
               "axis of the tool's length on a mill: that of the tool, or the one across the plane in force"},
    OptionSpec{"tool.offset", "row|edge", "row", &put<&Policies::tool_offset>,
               "what a D number names: a row of one table for all tools, or an edge of the tool in force"},
    OptionSpec{"tool.radius_data", "text", "", &put<&Policies::tool_radius_data>,
               "names of machine data with the radius of the tool in use, separated by |; #T and #D stand for the "
               "numbers of the tool and of its offset or edge"},
    OptionSpec{"tool.width_data", "text", "", &put<&Policies::tool_width_data>,
               "names of machine data with the width of the grooving tool in use, written like tool.radius_data"},
    OptionSpec{"work_offset.kept", "no|yes", "no", &put<&Policies::work_offset_kept>,
               "whether the work offset selected last stays in force over the end of a program and power-off"},
    OptionSpec{"work_offset.write", "on_select|at_once", "on_select", &put<&Policies::work_offset_write>,
               "when a written row of the work offset table counts: when it is selected again, or at once"},
    // Read by the language readers and writers.
    OptionSpec{"fagor.tool_change", "turret|m6", "m6", nullptr, "T changes at once, or selects for M06"},
    OptionSpec{
        "fagor.rotary_rollover", "no|yes", "no", nullptr,
        "absolute words of rotary axes: the sign is the direction and the value the target, or a plain coordinate"},
    OptionSpec{"fagor.mcall_repeat", "sub_only|move_and_sub", "move_and_sub", nullptr,
               "what a block repeat does under MCALL"},
    OptionSpec{"fagor.g92_mirror", "untouched|through", "untouched", nullptr,
               "G92 of a mirrored axis: the origin is set as without the mirror image, or so that the axis stands at "
               "the value in the mirrored coordinates"},
    OptionSpec{"fagor.plane_angles", "trace|axis", "trace", nullptr,
               "angles I J of G49: between an axis and the line in which the plane meets the plane of that axis and Z, "
               "or between the axis and the plane itself"},
    OptionSpec{"fagor.plane_tilt", "rises|falls", "rises", nullptr,
               "a positive angle I or J of G49: the plane rises, or falls, toward the plus side of the axis"},
    OptionSpec{"num.family", "7xx|10xx|flx", "10xx", nullptr, "series of the control"},
    OptionSpec{"num.g02_center", "absolute_in_G90|incremental", "absolute_in_G90", nullptr,
               "I J K of an arc under G90"},
    OptionSpec{"num.linear_unit_um", "number", "1", nullptr, "micrometres in one unit of a linear E parameter"},
    OptionSpec{"num.rotary_modulo", "text", "BC", nullptr,
               "letters of the axes on which the sign of an absolute word is its direction; - for none"},
    OptionSpec{"num.rotary_unit", "number", "0.0001", nullptr, "degrees in one unit of a rotary E parameter"},
    OptionSpec{
        "num.g31", "tool|1+|1-|2+|2-", "", nullptr,
        "what takes the point of G31 to its depth: the tool itself, or an axis of the plane; not set: as tool in "
        "a run, and no translation"},
    OptionSpec{"num.g31_back", "oriented|middle|reversed", "oriented", nullptr,
               "way out of the thread of G31: spindle stopped and 2 mm aside, from the middle, or along the thread"},
    OptionSpec{"num.g63", "corner|tool", "", nullptr,
               "where G63 begins: before the corner of the blank, or where the tool stands; not set: as corner in a "
               "run, and no translation"},
    OptionSpec{"num.g66", "from_tool|from_end", "", nullptr,
               "the first plunge of G66; not set: as from_tool in a run, and no translation"},
    OptionSpec{"num.g66_axis", "by_step|x|z", "by_step", nullptr,
               "axis of the plunges of G66; by_step: Z with P, X with R"},
    OptionSpec{"num.g66_back", "rapid|feed", "rapid", nullptr, "how a plunge of G66 comes back"},
    OptionSpec{"num.g66_steps", "equal|whole", "equal", nullptr, "steps of G66"},
    OptionSpec{"num.g66_width", "text", "", nullptr,
               "mm between the two edges of the tool of G66; empty: the width in the tool table"},
    OptionSpec{"num.face_x", "radius|machine", "radius", nullptr, "X under G21: a radius, or as the machine's X is"},
    OptionSpec{"num.lenient_letter_O", "true|false", "true", nullptr,
               "the letter O is read as the digit 0 in GO, with a warning"},
    OptionSpec{"num.missing_range_end", "error|to_last_lower", "error", nullptr,
               "a block range whose last block is missing"},
    OptionSpec{"num.m30", "none|end", "none", nullptr, "M30 ends the program"},
    OptionSpec{"num.m_programs", "text", "", nullptr,
               "M functions that call a program, as M:program separated by blanks (\"6:9100\")"},
    OptionSpec{"num.g83_withdraw", "EH|ER", "EH", nullptr,
               "height to which a deep hole with EH withdraws between its pecks"},
    OptionSpec{"num.peck_law", "degressive|constant", "degressive", nullptr,
               "pecks of a deep hole with first and last size"},
    OptionSpec{"num.range_order", "number|position", "number", nullptr,
               "how the two ends of a block range are put in order"},
    OptionSpec{"num.structured", "no|yes", "yes", nullptr, "structured statements are written for the 10xx and later"},
    OptionSpec{"num.default_gear", "text", "M41", nullptr,
               "gear word written when the source has none; empty: the machine has no gear ranges"},
    OptionSpec{"sinumerik.tool_change", "immediate|m6", "m6", nullptr,
               "T changes at once, or selects for M6 (MD22550)"},
    OptionSpec{"sinumerik.default_edge", "number", "0", nullptr,
               "D that a tool change selects when none is written after its T (MD20270); 0: none"},
    OptionSpec{"sinumerik.spigot_size", "radius|diameter", "radius", nullptr,
               "PRAD and AP1 of CYCLE77: radii, or diameters (a spigot that is taken for a diameter is cut smaller)"},
    OptionSpec{"sinumerik.undefined_names", "error|global", "error", nullptr,
               "a name that nothing defines: refused, or a global user variable (GUD) that starts at 0"},
    OptionSpec{
        "sinumerik.geometry_axes", "XYZ|YZX|ZXY", "XYZ", nullptr,
        "which axis is the first, second and third geometry axis (MD20050): G17 to G19 and I, J, K go by this order"},
    OptionSpec{"sinumerik.contour_ok", "0|1", "0", nullptr,
               "what EXECUTE answers where a contour could be prepared (the manual says both)"},
    OptionSpec{"sinumerik.inclined_axis", "plus|minus", "plus", nullptr,
               "which way Z goes where an inclined axis alone takes X up (G5, G7 under TRAANG with an angle above 0)"},
    OptionSpec{"sinumerik.r_count", "number", "100", nullptr, "number of R parameters"},
    OptionSpec{"sinumerik.pud_visible", "no|yes", "no", nullptr,
               "variables of the main program are seen in subprograms (MD11120)"},
    OptionSpec{"sinumerik.gotos", "goes_on|jumps", "goes_on", nullptr,
               "GOTOS: the PLC does not ask for the jump (DB21.DBX384.0 is 0: one pass), or it always does"},
    OptionSpec{
        "sinumerik.table_turn", "unknown|with_angle|against_angle", "unknown", nullptr,
        "which way PAROT turns the coordinates with an angle of a table in $TC_CARR; unknown: such a turn is refused"},
    OptionSpec{"sinumerik.exact_greater", "no|yes", "no", nullptr, "> and < compare exactly (MD10280 bit 0)"},
};

/// Which of the values, parted by '|', it is.
std::optional<std::size_t> place_in(std::string_view value, std::string_view list) {
  for (std::size_t at = 0; !list.empty(); ++at) {
    const auto bar = std::min(list.find('|'), list.size());
    if (list.substr(0, bar) == value) return at;
    list.remove_prefix(std::min(bar + 1, list.size()));
  }
  return std::nullopt;
}

}  // namespace

std::span<const OptionSpec> option_specs() {
  return specs;
}

const OptionSpec* find_option(std::string_view name) {
  for (const auto& s : specs) {
    if (s.name == name) return &s;
  }
  return nullptr;
}

bool check_option(std::string_view name, std::string_view value, std::string* error) {
  const auto* spec = find_option(name);
  if (spec == nullptr) {
    std::vector<std::string> names;
    for (const auto& s : specs) names.emplace_back(s.name);
    *error = "there is no option \"" + std::string(name) + "\"" + did_you_mean(name, names);
    return false;
  }
  if (spec->values == "text" || (value.empty() && spec->fallback.empty())) return true;  // empty: as if not set
  if (spec->values == "number" ? parse_decimal(value).has_value() : place_in(value, spec->values).has_value())
    return true;
  *error = "option \"" + std::string(name) + "\" does not take \"" + std::string(value) + "\" but " +
           std::string(spec->values);
  return false;
}

bool set_option(Profile& profile, std::string_view name, std::string_view value, std::string* error) {
  if (!check_option(name, value, error)) return false;
  const auto* spec = find_option(name);
  if (spec->put != nullptr) spec->put(profile.policies, value, place_in(value, spec->values).value_or(0));
  profile.options[std::string(name)] = value;
  return true;
}

}  // namespace cnctrans::machine
