#include "machine/options.h"

#include <algorithm>

#include "base/nearest.h"

namespace cnctrans::machine {
namespace {

constexpr std::array specs{
    OptionSpec{"arc.tangent_straight", "error|line", "error", &put_option<&Policies::arc_tangent_straight>,
               "a tangent arc whose end lies straight ahead: refused, or the straight line there"},
    OptionSpec{"block.m_functions", "number", "0", &put_option<&Policies::block_m_functions>,
               "M functions that a block takes; 0: no limit"},
    OptionSpec{"block.machine_functions", "number", "0", &put_option<&Policies::block_machine_functions>,
               "functions of the machine among the M functions that a block takes; 0: no limit"},
    OptionSpec{"calls.local_levels", "number", "0", &put_option<&Policies::calls_local_levels>,
               "levels of own local parameters that may be open at once; 0: no limit"},
    OptionSpec{
        "call.missing", "error|passed_over", "error", &put_option<&Policies::call_missing>,
        "a call of a subprogram that is nowhere: the program is refused, or a run goes past the call with a warning"},
    OptionSpec{
        "call.decoration", "text", "", &put_option<&Policies::call_decoration>,
        "what the name of a called program may have about it in a computed text: a prefix and suffixes, separated by "
        "|; folders before it count for nothing then"},
    OptionSpec{"call.modal_in_modal", "allowed|refused", "allowed", &put_option<&Policies::call_modal_in_modal>,
               "a modal call of a program within a program that is called modally itself: it takes its place, or an "
               "error"},
    OptionSpec{"call.modal_words", "no|yes", "no", &put_option<&Policies::call_modal_words>,
               "under a modal call of a subprogram, F, S and a bare G0 or G1 run it as well, without motion"},
    OptionSpec{
        "call.uncalled_state", "when_needed|unknown|power_on", "when_needed",
        &put_option<&Policies::call_uncalled_state>,
        "what a subprogram that nothing at hand calls starts with in a translation: nothing is known, or the state "
        "of power-on; when_needed: that state where the program would be refused without it"},
    OptionSpec{"corner.chamfer_at_arc", "no|yes", "no", &put_option<&Policies::corner_chamfer_at_arc>,
               "a chamfer at an arc: cut off along the elements, or refused"},
    OptionSpec{"corner.without_successor", "error|left_out", "error", &put_option<&Policies::corner_without_successor>,
               "a corner function that no second element in the plane follows: refused, or left out with a warning"},
    OptionSpec{"call.saves_modals", "no|yes", "no", &put_option<&Policies::call_saves_modals>,
               "a subprogram can give its caller the modal state back (SAVE)"},
    OptionSpec{"comp.interruptions", "taken|refused", "taken", &put_option<&Policies::comp_interruptions>,
               "a stop (M00, M01) or a move in machine coordinates while radius compensation is on"},
    OptionSpec{"comp.rapid", "kept|suspended", "kept", &put_option<&Policies::comp_rapid>,
               "a rapid move while radius compensation is on: compensated, or carried out without it"},
    OptionSpec{"comp.rotation", "kept|ended", "kept", &put_option<&Policies::comp_rotation>,
               "radius compensation where the coordinates are rotated"},
    OptionSpec{"corner.straight_on", "left_out|refused", "left_out", &put_option<&Policies::corner_straight_on>,
               "a corner function of a block between two elements that meet without a corner: nothing is inserted, or "
               "an error"},
    OptionSpec{
        "stop.spindle", "goes_on|stops", "goes_on", &put_option<&Policies::stop_spindle>,
        "a stop of the program (M00, M01 where the operator asks for it): the spindle turns on, or stands still"},
    OptionSpec{"cycle.axis_word", "moves|refused", "moves", &put_option<&Policies::cycle_axis_word>,
               "a word of the tool axis in a block while a hole cycle is active: a move, or an error"},
    OptionSpec{"cycle.levels", "as_written|by_mode", "as_written", &put_option<&Policies::cycle_levels>,
               "levels of a cycle in a block under increments: each says what it is, or all follow the mode"},
    OptionSpec{"cycle.below_reference", "passes|refused", "passes", &put_option<&Policies::cycle_below_reference>,
               "a hole cycle called while the tool stands between its reference plane and its depth"},
    OptionSpec{
        "cycle.stops", "needed|all", "needed", &put_option<&Policies::cycle_stops>,
        "what a run says of a hole cycle: the moves that it needs, or its stop at the reference plane on the way "
        "out and each turn of the spindle of a tap that breaks chips as well"},
    OptionSpec{"cycle.positioning", "modal|rapid", "modal", &put_option<&Policies::cycle_positioning>,
               "how a block reaches the next hole of a modal cycle when it writes no motion code of its own"},
    OptionSpec{"cycle.pocket_entry", "arc|straight", "arc", &put_option<&Policies::cycle_pocket_entry>,
               "finishing of a pocket with islands: onto the wall and off it on a quadrant, or straight down onto it"},
    OptionSpec{"cycle.pocket_links", "at_depth|over", "at_depth", &put_option<&Policies::cycle_pocket_links>,
               "from one ring of such a pocket to the next: through the pocket where no wall lies between, or always "
               "over the reference plane"},
    OptionSpec{"cycle.pocket_tolerance", "number", "0.001", &put_option<&Policies::cycle_pocket_tolerance>,
               "mm by which chords may leave the arcs of such a pocket where its area is computed: 0.00001 to 0.1"},
    OptionSpec{
        "cycle.relief_edge", "usual|refused", "usual", &put_option<&Policies::cycle_relief_edge>,
        "an undercut whose side follows from a tool of which the profile gives no nose 1 to 4: outside (DIN 76 C "
        "and D inside) with the shoulder toward -Z, or refused"},
    OptionSpec{"cycle.rotary_triggers", "no|yes", "no", &put_option<&Policies::cycle_rotary_triggers>,
               "a rotary axis word alone runs the modal hole cycle too"},
    OptionSpec{"cycle.plane_function", "keeps|ends", "keeps", &put_option<&Policies::cycle_plane_function>,
               "a plane function while a hole cycle is active"},
    OptionSpec{"cycle.face_groove_left", "unknown|larger_x|smaller_x", "unknown",
               &put_option<&Policies::cycle_face_groove_left>,
               "where the left start of a shaped groove in the face lies; unknown: such grooves are refused"},
    OptionSpec{"cycle.groove_edge", "minus|plus", "minus", &put_option<&Policies::cycle_groove_edge>,
               "which corner of its insert is the programmed point of a grooving tool whose nose is not 1 to 4"},
    OptionSpec{"cycle.groove_depth", "smaller|absolute|increment", "smaller",
               &put_option<&Policies::cycle_groove_depth>,
               "depth of an alternating groove that does not say how it counts: from the surface, if that is not the "
               "deeper cut (else refused), a coordinate of the base, or from the surface"},
    OptionSpec{"cycle.groove_dwell", "number", "0", &put_option<&Policies::cycle_groove_dwell>,
               "seconds that an alternating groove waits behind each plunge"},
    OptionSpec{"cycle.groove_position", "as_shaped|mirrored", "as_shaped",
               &put_option<&Policies::cycle_groove_position>,
               "on which side of an alternating groove its start lies: by the digits of the shaped groove, or on the "
               "other one"},
    OptionSpec{
        "cycle.parting_after", "kept|restored", "kept", &put_option<&Policies::cycle_parting_after>,
        "parting off: behind it the spindle turns as at its end, or speed and G96 or G97 of the caller come back"},
    OptionSpec{"cycle.parting_part", "plus|minus", "plus", &put_option<&Policies::cycle_parting_part>,
               "parting off: the part lies toward +Z of the place in the call and the insert toward -Z, or the other "
               "way round"},
    OptionSpec{"cycle.parting_retract", "always|by_variant", "always", &put_option<&Policies::cycle_parting_retract>,
               "parting off: the tool goes back at the end whatever the variant, or stays at the depth with 1"},
    OptionSpec{"cycle.parting_speed", "by_limit|by_mode", "by_limit", &put_option<&Policies::cycle_parting_speed>,
               "parting off: a speed that comes with a limit is a cutting speed, or only the mode says so"},
    OptionSpec{"file.lines", "opened|named", "opened", &put_option<&Policies::file_lines>,
               "how a program writes lines into a program of the control: into the one it has opened, or each says "
               "which one"},
    OptionSpec{"frame.change_keeps", "machine|programmed", "machine", &put_option<&Policies::frame_change_keeps>,
               "what an incremental word adds to after a frame change: the present point seen in the new frame, or the "
               "coordinate programmed last (the difference of the frames is travelled)"},
    OptionSpec{"frame.first_arc", "any|absolute_centre", "any", &put_option<&Policies::frame_first_arc>,
               "how an arc gives its centre that is the first move behind a mirror or a rotation"},
    OptionSpec{
        "frame.mirror_order", "stated|assumed_with_rotation|assumed", "stated",
        &put_option<&Policies::frame_mirror_order>,
        "whether the maker's manual says in which order a mirror and the other parts of the frame apply: yes, not "
        "beside a rotation, not beside a rotation or a shift"},
    OptionSpec{"frame.plane_change", "keeps|may_end_rotation", "keeps", &put_option<&Policies::frame_plane_change>,
               "a plane function while a rotation is in force: the rotation stays, or that is not certain"},
    OptionSpec{"frame.shift", "as_said|by_distance", "as_said", &put_option<&Policies::frame_shift>,
               "what increments make of the words of a shift: add to it"},
    OptionSpec{
        "frame.preset", "own|with_work_offset", "own", &put_option<&Policies::frame_preset>,
        "a preset of the zero point stands by itself, or belongs to the work offset and is out of force with it"},
    OptionSpec{"arc.through_point", "in_plane|in_space", "in_plane", &put_option<&Policies::arc_through_point>,
               "an arc through a point that also moves along the third axis: a helix, or a circle in space"},
    OptionSpec{"frame.preset_outlasts", "no|yes", "no", &put_option<&Policies::frame_preset_outlasts>,
               "a preset of the zero point is written into the datum table: it holds on behind the end of the program"},
    OptionSpec{"frame.rotation_centre", "as_written|scaled_and_mirrored", "as_written",
               &put_option<&Policies::frame_rotation_centre>,
               "whether the centre of a rotation goes through scale and mirror"},
    OptionSpec{"compare.equal_within", "number", "0", &put_option<&Policies::compare_equal_within>,
               "two numbers that differ by no more than this are equal for = and <>; 0: exactly equal"},
    OptionSpec{"helix.pitch_mismatch", "error|nearest", "error", &put_option<&Policies::helix_pitch_mismatch>,
               "a helix whose pitch does not fit its travel: refused, or run with the nearest pitch"},
    OptionSpec{
        "machine_data.lengths", "text", "", &put_option<&Policies::machine_data_lengths>,
        "names of machine data that are lengths, separated by |, with * and # as in \"data_at_rest\": written in "
        "the unit that machine_data.units tells, and kept in mm"},
    OptionSpec{
        "machine_data.units", "modal|machine|with_feed", "machine", &put_option<&Policies::machine_data_units>,
        "lengths read from machine data: in the unit and diameter mode in force, always mm and radius, or in the "
        "unit in force as long as it is that of F too"},
    OptionSpec{"machine_move.units", "modal|machine", "modal", &put_option<&Policies::machine_move_units>,
               "unit of machine coordinates: as the other words, or always millimetres"},
    OptionSpec{"machine_position.scale", "radius|words", "radius", &put_option<&Policies::machine_position_scale>,
               "how a program reads a machine position: radius in mm, or in the unit and diameter mode of its words"},
    OptionSpec{"machine_move.words", "modal|absolute", "modal", &put_option<&Policies::machine_move_words>,
               "words of a move in machine coordinates: increments in incremental mode, or positions in any mode"},
    OptionSpec{"path.curve_tolerance", "number", "0.001", &put_option<&Policies::path_curve_tolerance>,
               "mm (degrees on rotary axes) by which the straight steps of a spline or polynomial leave the curve at "
               "most: 0.000001 to 1"},
    OptionSpec{"polar.plane_resets_pole", "no|yes", "no", &put_option<&Policies::polar_plane_resets_pole>,
               "a plane function puts the pole to the zero point"},
    OptionSpec{"polar.pole_follows_arc", "no|yes", "no", &put_option<&Policies::polar_pole_follows_arc>,
               "the centre of an arc becomes the pole"},
    OptionSpec{"polar.radius", "present|programmed", "present", &put_option<&Policies::polar_radius>,
               "radius of polar words without one: the tool's distance from the pole, or the one programmed last"},
    OptionSpec{"polar.pole_stays", "no|yes", "no", &put_option<&Policies::polar_pole_stays>,
               "a pole that the program has set stays in its place when the zero point moves, or moves along"},
    OptionSpec{"feed.mixed_axes", "resultant|linear", "resultant", &put_option<&Policies::feed_mixed_axes>,
               "what F counts where linear and rotary axes move together: degrees as millimetres of one way, or the "
               "linear axes alone"},
    OptionSpec{"rotary.direction", "by_sign|in_word", "by_sign", &put_option<&Policies::rotary_direction>,
               "how a rotary move says its direction: by the sign of its value, or by a word of its own"},
    OptionSpec{"round_up.negative", "stated|unstated", "stated", &put_option<&Policies::round_up_negative>,
               "whether the maker's manual says what rounding up makes of a negative value"},
    OptionSpec{
        "run.faults", "before|when_reached", "before", &put_option<&Policies::run_faults>,
        "blocks that can't be read, labels and subprograms that are nowhere, where the program could come to them: "
        "it is refused before anything moves, or the run stops where it does come to one"},
    OptionSpec{"cycle.unknown_radius", "assumed|stop", "assumed", &put_option<&Policies::cycle_unknown_radius>,
               "a milling cycle whose tool has no known radius: its passes are those of a usual tool, with a warning, "
               "or the run stops"},
    OptionSpec{"thread.pitch", "each_block|modal", "each_block", &put_option<&Policies::thread_pitch>,
               "how long the pitch of a thread (G33) stays in force"},
    OptionSpec{"thread.start_angle", "block|modal", "block", &put_option<&Policies::thread_start_angle>,
               "how long the start angle of a thread stays in force"},
    OptionSpec{"tool.bare_offset", "kept|table|edge", "kept", &put_option<&Policies::tool_bare_offset>,
               "offset of a tool that comes without a D: the one in force stays, the one that the tool table has for "
               "the tool, or an edge that machine data name"},
    OptionSpec{"tool.length_axis", "tool|plane", "tool", &put_option<&Policies::tool_length_axis>,
               "axis of the tool's length on a mill: that of the tool, or the one across the plane in force"},
    OptionSpec{"tool.offset", "row|edge", "row", &put_option<&Policies::tool_offset>,
               "what a D number names: a row of one table for all tools, or an edge of the tool in force"},
    OptionSpec{"tool.radius_data", "text", "", &put_option<&Policies::tool_radius_data>,
               "names of machine data with the radius of the tool in use, separated by |; #T and #D stand for the "
               "numbers of the tool and of its offset or edge"},
    OptionSpec{"tool.width_data", "text", "", &put_option<&Policies::tool_width_data>,
               "names of machine data with the width of the grooving tool in use, written like tool.radius_data"},
    OptionSpec{"work_offset.kept", "no|yes", "no", &put_option<&Policies::work_offset_kept>,
               "whether the work offset selected last stays in force over the end of a program and power-off"},
    OptionSpec{"work_offset.write", "on_select|at_once", "on_select", &put_option<&Policies::work_offset_write>,
               "when a written row of the work offset table counts: when it is selected again, or at once"},
};

}  // namespace

std::optional<std::size_t> value_number(std::string_view value, std::string_view values) {
  for (std::size_t at = 0; !values.empty(); ++at) {
    const auto bar = std::min(values.find('|'), values.size());
    if (values.substr(0, bar) == value) return at;
    values.remove_prefix(std::min(bar + 1, values.size()));
  }
  return std::nullopt;
}

std::span<const OptionSpec> common_options() {
  return specs;
}

OptionTable::OptionTable(const std::vector<std::span<const OptionSpec>>& languages)
    : rows_(specs.begin(), specs.end()) {
  for (const auto& rows : languages) rows_.insert(rows_.end(), rows.begin(), rows.end());
}

const OptionSpec* OptionTable::find(std::string_view name) const {
  const auto it = std::find_if(rows_.begin(), rows_.end(), [name](const OptionSpec& s) { return s.name == name; });
  return it == rows_.end() ? nullptr : &*it;
}

bool OptionTable::check(std::string_view name, std::string_view value, std::string* error) const {
  const auto* spec = find(name);
  if (spec == nullptr) {
    std::vector<std::string> names;
    for (const auto& s : rows_) names.emplace_back(s.name);
    *error = "there is no option \"" + std::string(name) + "\"" + did_you_mean(name, names);
    return false;
  }
  if (spec->values == "text" || (value.empty() && spec->fallback.empty())) return true;  // empty: as if not set
  if (spec->values == "number" ? parse_decimal(value).has_value() : value_number(value, spec->values).has_value())
    return true;
  *error = "option \"" + std::string(name) + "\" does not take \"" + std::string(value) + "\" but " +
           std::string(spec->values);
  return false;
}

bool OptionTable::set(Profile& profile, std::string_view name, std::string_view value, std::string* error) const {
  if (!check(name, value, error)) return false;
  const auto* spec = find(name);
  if (spec->put != nullptr) spec->put(profile.policies, value, value_number(value, spec->values).value_or(0));
  profile.options[std::string(name)] = value;
  return true;
}

void OptionTable::begin(Profile& profile) const {
  const std::string own = profile.dialect + ".";
  for (const auto& spec : rows_) {
    if (spec.put != nullptr && spec.name.starts_with(own))
      spec.put(profile.policies, spec.fallback, value_number(spec.fallback, spec.values).value_or(0));
  }
}

}  // namespace cnctrans::machine
