#include "machine/options.h"

#include <algorithm>

#include "base/nearest.h"

namespace cnctrans::machine {
namespace {

constexpr std::array specs{
    option<&Policies::arc_tangent_straight>(
        "arc.tangent_straight", "error|line", "error",
        "a tangent arc whose end lies straight ahead: refused, or the straight line there"),
    option<&Policies::block_m_functions>("block.m_functions", "number", "0",
                                         "M functions that a block takes; 0: no limit"),
    option<&Policies::block_machine_functions>(
        "block.machine_functions", "number", "0",
        "functions of the machine among the M functions that a block takes; 0: no limit"),
    option<&Policies::calls_local_levels>("calls.local_levels", "number", "0",
                                          "levels of own local parameters that may be open at once; 0: no limit"),
    option<&Policies::call_missing>(
        "call.missing", "error|passed_over", "error",
        "a call of a subprogram that is nowhere: the program is refused, or a run goes past the call with a warning"),
    option<&Policies::call_decoration>(
        "call.decoration", "text", "",
        "what the name of a called program may have about it in a computed text: a prefix and suffixes, separated by "
        "|; folders before it count for nothing then"),
    option<&Policies::call_modal_in_modal>(
        "call.modal_in_modal", "allowed|refused", "allowed",
        "a modal call of a program within a program that is called modally itself: it takes its place, or an "
        "error"),
    option<&Policies::call_modal_words>(
        "call.modal_words", "no|yes", "no",
        "under a modal call of a subprogram, F, S and a bare G0 or G1 run it as well, without motion"),
    option<&Policies::call_uncalled_state>(
        "call.uncalled_state", "when_needed|unknown|power_on", "when_needed",
        "what a subprogram that nothing at hand calls starts with in a translation: nothing is known, or the state "
        "of power-on; when_needed: that state where the program would be refused without it"),
    option<&Policies::corner_chamfer_at_arc>("corner.chamfer_at_arc", "no|yes", "no",
                                             "a chamfer at an arc: cut off along the elements, or refused"),
    option<&Policies::corner_without_successor>(
        "corner.without_successor", "error|left_out", "error",
        "a corner function that no second element in the plane follows: refused, or left out with a warning"),
    option<&Policies::call_saves_modals>("call.saves_modals", "no|yes", "no",
                                         "a subprogram can give its caller the modal state back (SAVE)"),
    option<&Policies::comp_interruptions>(
        "comp.interruptions", "taken|refused", "taken",
        "a stop (M00, M01) or a move in machine coordinates while radius compensation is on"),
    option<&Policies::comp_rapid>(
        "comp.rapid", "kept|suspended", "kept",
        "a rapid move while radius compensation is on: compensated, or carried out without it"),
    option<&Policies::comp_rotation>("comp.rotation", "kept|ended", "kept",
                                     "radius compensation where the coordinates are rotated"),
    option<&Policies::corner_straight_on>(
        "corner.straight_on", "left_out|refused", "left_out",
        "a corner function of a block between two elements that meet without a corner: nothing is inserted, or "
        "an error"),
    option<&Policies::stop_spindle>(
        "stop.spindle", "goes_on|stops", "goes_on",
        "a stop of the program (M00, M01 where the operator asks for it): the spindle turns on, or stands still"),
    option<&Policies::cycle_axis_word>(
        "cycle.axis_word", "moves|refused", "moves",
        "a word of the tool axis in a block while a hole cycle is active: a move, or an error"),
    option<&Policies::cycle_levels>(
        "cycle.levels", "as_written|by_mode", "as_written",
        "levels of a cycle in a block under increments: each says what it is, or all follow the mode"),
    option<&Policies::cycle_below_reference>(
        "cycle.below_reference", "passes|refused", "passes",
        "a hole cycle called while the tool stands between its reference plane and its depth"),
    option<&Policies::cycle_stops>(
        "cycle.stops", "needed|all", "needed",
        "what a run says of a hole cycle: the moves that it needs, or its stop at the reference plane on the way "
        "out and each turn of the spindle of a tap that breaks chips as well"),
    option<&Policies::cycle_positioning>(
        "cycle.positioning", "modal|rapid", "modal",
        "how a block reaches the next hole of a modal cycle when it writes no motion code of its own"),
    option<&Policies::cycle_pocket_entry>(
        "cycle.pocket_entry", "arc|straight", "arc",
        "finishing of a pocket with islands: onto the wall and off it on a quadrant, or straight down onto it"),
    option<&Policies::cycle_pocket_links>(
        "cycle.pocket_links", "at_depth|over", "at_depth",
        "from one ring of such a pocket to the next: through the pocket where no wall lies between, or always "
        "over the reference plane"),
    option<&Policies::cycle_pocket_tolerance>(
        "cycle.pocket_tolerance", "number", "0.001",
        "mm by which chords may leave the arcs of such a pocket where its area is computed: 0.00001 to 0.1"),
    option<&Policies::cycle_relief_edge>(
        "cycle.relief_edge", "usual|refused", "usual",
        "an undercut whose side follows from a tool of which the profile gives no nose 1 to 4: outside (DIN 76 C "
        "and D inside) with the shoulder toward -Z, or refused"),
    option<&Policies::cycle_rotary_triggers>("cycle.rotary_triggers", "no|yes", "no",
                                             "a rotary axis word alone runs the modal hole cycle too"),
    option<&Policies::cycle_plane_function>("cycle.plane_function", "keeps|ends", "keeps",
                                            "a plane function while a hole cycle is active"),
    option<&Policies::cycle_face_groove_left>(
        "cycle.face_groove_left", "unknown|larger_x|smaller_x", "unknown",
        "where the left start of a shaped groove in the face lies; unknown: such grooves are refused"),
    option<&Policies::cycle_groove_edge>(
        "cycle.groove_edge", "minus|plus", "minus",
        "which corner of its insert is the programmed point of a grooving tool whose nose is not 1 to 4"),
    option<&Policies::cycle_groove_depth>(
        "cycle.groove_depth", "smaller|absolute|increment", "smaller",
        "depth of an alternating groove that does not say how it counts: from the surface, if that is not the "
        "deeper cut (else refused), a coordinate of the base, or from the surface"),
    option<&Policies::cycle_groove_dwell>("cycle.groove_dwell", "number", "0",
                                          "seconds that an alternating groove waits behind each plunge"),
    option<&Policies::cycle_groove_position>(
        "cycle.groove_position", "as_shaped|mirrored", "as_shaped",
        "on which side of an alternating groove its start lies: by the digits of the shaped groove, or on the "
        "other one"),
    option<&Policies::cycle_parting_after>(
        "cycle.parting_after", "kept|restored", "kept",
        "parting off: behind it the spindle turns as at its end, or speed and G96 or G97 of the caller come back"),
    option<&Policies::cycle_parting_part>(
        "cycle.parting_part", "plus|minus", "plus",
        "parting off: the part lies toward +Z of the place in the call and the insert toward -Z, or the other "
        "way round"),
    option<&Policies::cycle_parting_retract>(
        "cycle.parting_retract", "always|by_variant", "always",
        "parting off: the tool goes back at the end whatever the variant, or stays at the depth with 1"),
    option<&Policies::cycle_parting_speed>(
        "cycle.parting_speed", "by_limit|by_mode", "by_limit",
        "parting off: a speed that comes with a limit is a cutting speed, or only the mode says so"),
    option<&Policies::file_lines>(
        "file.lines", "opened|named", "opened",
        "how a program writes lines into a program of the control: into the one it has opened, or each says "
        "which one"),
    option<&Policies::frame_change_keeps>(
        "frame.change_keeps", "machine|programmed", "machine",
        "what an incremental word adds to after a frame change: the present point seen in the new frame, or the "
        "coordinate programmed last (the difference of the frames is travelled)"),
    option<&Policies::frame_first_arc>(
        "frame.first_arc", "any|absolute_centre", "any",
        "how an arc gives its centre that is the first move behind a mirror or a rotation"),
    option<&Policies::frame_mirror_order>(
        "frame.mirror_order", "stated|assumed_with_rotation|assumed", "stated",
        "whether the maker's manual says in which order a mirror and the other parts of the frame apply: yes, not "
        "beside a rotation, not beside a rotation or a shift"),
    option<&Policies::frame_plane_change>(
        "frame.plane_change", "keeps|may_end_rotation", "keeps",
        "a plane function while a rotation is in force: the rotation stays, or that is not certain"),
    option<&Policies::frame_shift>("frame.shift", "as_said|by_distance", "as_said",
                                   "what increments make of the words of a shift: add to it"),
    option<&Policies::frame_preset>(
        "frame.preset", "own|with_work_offset", "own",
        "a preset of the zero point stands by itself, or belongs to the work offset and is out of force with it"),
    option<&Policies::arc_through_point>(
        "arc.through_point", "in_plane|in_space", "in_plane",
        "an arc through a point that also moves along the third axis: a helix, or a circle in space"),
    option<&Policies::frame_preset_outlasts>(
        "frame.preset_outlasts", "no|yes", "no",
        "a preset of the zero point is written into the datum table: it holds on behind the end of the program"),
    option<&Policies::frame_rotation_centre>("frame.rotation_centre", "as_written|scaled_and_mirrored", "as_written",
                                             "whether the centre of a rotation goes through scale and mirror"),
    option<&Policies::compare_equal_within>(
        "compare.equal_within", "number", "0",
        "two numbers that differ by no more than this are equal for = and <>; 0: exactly equal"),
    option<&Policies::helix_pitch_mismatch>(
        "helix.pitch_mismatch", "error|nearest", "error",
        "a helix whose pitch does not fit its travel: refused, or run with the nearest pitch"),
    option<&Policies::machine_data_lengths>(
        "machine_data.lengths", "text", "",
        "names of machine data that are lengths, separated by |, with * and # as in \"data_at_rest\": written in "
        "the unit that machine_data.units tells, and kept in mm"),
    option<&Policies::machine_data_units>(
        "machine_data.units", "modal|machine|with_feed", "machine",
        "lengths read from machine data: in the unit and diameter mode in force, always mm and radius, or in the "
        "unit in force as long as it is that of F too"),
    option<&Policies::machine_move_units>("machine_move.units", "modal|machine", "modal",
                                          "unit of machine coordinates: as the other words, or always millimetres"),
    option<&Policies::machine_position_scale>(
        "machine_position.scale", "radius|words", "radius",
        "how a program reads a machine position: radius in mm, or in the unit and diameter mode of its words"),
    option<&Policies::machine_move_words>(
        "machine_move.words", "modal|absolute", "modal",
        "words of a move in machine coordinates: increments in incremental mode, or positions in any mode"),
    option<&Policies::path_curve_tolerance>(
        "path.curve_tolerance", "number", "0.001",
        "mm (degrees on rotary axes) by which the straight steps of a spline or polynomial leave the curve at "
        "most: 0.000001 to 1"),
    option<&Policies::polar_plane_resets_pole>("polar.plane_resets_pole", "no|yes", "no",
                                               "a plane function puts the pole to the zero point"),
    option<&Policies::polar_pole_follows_arc>("polar.pole_follows_arc", "no|yes", "no",
                                              "the centre of an arc becomes the pole"),
    option<&Policies::polar_radius>(
        "polar.radius", "present|programmed", "present",
        "radius of polar words without one: the tool's distance from the pole, or the one programmed last"),
    option<&Policies::polar_pole_stays>(
        "polar.pole_stays", "no|yes", "no",
        "a pole that the program has set stays in its place when the zero point moves, or moves along"),
    option<&Policies::feed_mixed_axes>(
        "feed.mixed_axes", "resultant|linear", "resultant",
        "what F counts where linear and rotary axes move together: degrees as millimetres of one way, or the "
        "linear axes alone"),
    option<&Policies::rotary_direction>(
        "rotary.direction", "by_sign|in_word", "by_sign",
        "how a rotary move says its direction: by the sign of its value, or by a word of its own"),
    option<&Policies::round_up_negative>("round_up.negative", "stated|unstated", "stated",
                                         "whether the maker's manual says what rounding up makes of a negative value"),
    option<&Policies::run_faults>(
        "run.faults", "before|when_reached", "before",
        "blocks that can't be read, labels and subprograms that are nowhere, where the program could come to them: "
        "it is refused before anything moves, or the run stops where it does come to one"),
    option<&Policies::cycle_unknown_radius>(
        "cycle.unknown_radius", "assumed|stop", "assumed",
        "a milling cycle whose tool has no known radius: its passes are those of a usual tool, with a warning, "
        "or the run stops"),
    option<&Policies::thread_pitch>("thread.pitch", "each_block|modal", "each_block",
                                    "how long the pitch of a thread (G33) stays in force"),
    option<&Policies::thread_start_angle>("thread.start_angle", "block|modal", "block",
                                          "how long the start angle of a thread stays in force"),
    option<&Policies::tool_bare_offset>(
        "tool.bare_offset", "kept|table|edge", "kept",
        "offset of a tool that comes without a D: the one in force stays, the one that the tool table has for "
        "the tool, or an edge that machine data name"),
    option<&Policies::tool_length_axis>(
        "tool.length_axis", "tool|plane", "tool",
        "axis of the tool's length on a mill: that of the tool, or the one across the plane in force"),
    option<&Policies::tool_offset>(
        "tool.offset", "row|edge", "row",
        "what a D number names: a row of one table for all tools, or an edge of the tool in force"),
    option<&Policies::tool_radius_data>(
        "tool.radius_data", "text", "",
        "names of machine data with the radius of the tool in use, separated by |; #T and #D stand for the "
        "numbers of the tool and of its offset or edge"),
    option<&Policies::tool_width_data>(
        "tool.width_data", "text", "",
        "names of machine data with the width of the grooving tool in use, written like tool.radius_data"),
    option<&Policies::work_offset_kept>(
        "work_offset.kept", "no|yes", "no",
        "whether the work offset selected last stays in force over the end of a program and power-off"),
    option<&Policies::work_offset_write>(
        "work_offset.write", "on_select|at_once", "on_select",
        "when a written row of the work offset table counts: when it is selected again, or at once"),
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
