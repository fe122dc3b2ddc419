#include "legaliser/pipeline/pipeline.h"

#include <array>

#include "legaliser/control/called_labels.h"
#include "legaliser/control/jumped_ends.h"
#include "legaliser/control/skip_groups.h"
#include "legaliser/control/skip_levels.h"
#include "legaliser/cycles/cycle_spindles.h"
#include "legaliser/data/given_data.h"
#include "legaliser/data/missing_offsets.h"
#include "legaliser/data/written_files.h"
#include "legaliser/early_passes.h"
#include "legaliser/expressions/polar_turns.h"
#include "legaliser/frames/axis_scales.h"
#include "legaliser/motion/balance_increments.h"
#include "legaliser/names/declared_arrays.h"
#include "legaliser/passes.h"
#include "legaliser/style/shift_modes.h"
#include "legaliser/technology/mixed_feeds.h"
#include "legaliser/technology/motion_codes.h"
#include "legaliser/technology/spindle_limits.h"
#include "legaliser/technology/thread_leads.h"

namespace cnctrans::ir {

namespace {

constexpr std::array table{
    Pass{"move_headings", passes::move_headings, PassScope::program,
         "Comments above the header of a routine go below it, where the target has no place for them above."},
    Pass{"settle_kept_text", passes::settle_kept_text, PassScope::program,
         "What the reader keeps as text is refused at its line; a chosen axis of the tool's length becomes a remark."},
    Pass{"refuse_transformations", passes::refuse_transformations, PassScope::program,
         "Positions in the coordinates of a transformation of the machine are refused where they begin."},
    Pass{"check_spindle_limits", passes::check_spindle_limits, PassScope::program,
         "Limits of the spindle speed that one control keeps and the other forgets."},
    Pass{"check_mixed_feeds", passes::check_mixed_feeds, PassScope::program,
         "A feed that counts otherwise where linear and rotary axes move together."},
    Pass{"write_known_texts", passes::write_known_texts, PassScope::program,
         "Variables of texts and axes whose value the program gives are written as that value."},
    Pass{"separate_called_parts", passes::separate_called_parts, PassScope::program,
         "Blocks of another program that are called become a subprogram, for a target that calls whole programs."},
    Pass{"name_jumped_ends", passes::name_jumped_ends, PassScope::program,
         "An end of a repeated part that is jumped to gets a name of its own."},
    Pass{"say_known_frames", passes::say_known_frames, PassScope::program,
         "Frames as values, base frames and turned settable frames, where they are known, as the programmable frame."},
    Pass{"drop_unused_offsets", passes::drop_unused_offsets, PassScope::program,
         "Work offsets that are off while nothing counts in them are left out for a target that always has one."},
    Pass{"normalise_returns", passes::normalise_returns, PassScope::program,
         "Early returns, and the end of the program inside a subprogram."},
    Pass{"mark_range_ends", passes::mark_range_ends, PassScope::program,
         "The end of a repeated range stands on the last statement that its source line became."},
    Pass{"restore_modals", passes::restore_modals, PassScope::program,
         "A routine that saves the modal state of its caller writes it back before its returns."},
    Pass{"solve_contours", passes::solve_contours, PassScope::program,
         "Points of a contour that follow from angles, tangency and intersections are written out."},
    Pass{"write_out_curves", passes::write_out_curves, PassScope::program,
         "Splines and polynomials as straight steps within the tolerance of the source's profile."},
    Pass{"say_tangent_arcs", passes::say_tangent_arcs, PassScope::program,
         "A tangent arc that is in force in the source is said in each block."},
    Pass{"check_tool_lengths", passes::check_tool_lengths, PassScope::program,
         "A tool without an offset, and its length in other planes."},
    Pass{"open_skip_groups", passes::open_skip_groups, PassScope::program,
         "Blocks of one skip mark that became several are opened as a group."},
    Pass{"write_thread_angles", passes::write_thread_angles, PassScope::program,
         "The start angle that stays in force is said in each thread."},
    Pass{"write_floating_taps", passes::write_floating_taps, PassScope::program,
         "A tap with a compensating chuck as a straight move."},
    Pass{"say_axial_taps", passes::say_axial_taps, PassScope::program,
         "The tapping form of the axial drilling cycle of a lathe as a tap."},
    Pass{"write_block_feeds", passes::write_block_feeds, PassScope::program,
         "A feed of one block as a feed, and the one of before behind it."},
    Pass{"write_positioning", passes::write_positioning, PassScope::program,
         "Axes that move by themselves as straight moves."},
    Pass{"choose_directions", passes::choose_directions, PassScope::program,
         "Computed rotary positions whose sign is a direction become a branch."},
    Pass{"name_tool_rows", passes::name_tool_rows, PassScope::program,
         "The data of a row of the one tool table as those of an edge of its tool."},
    Pass{"write_signed_turns", passes::write_signed_turns, PassScope::program,
         "Rotary positions get the sign of the way to them where that is the target's direction of turning."},
    Pass{"convert_machine_data", passes::convert_machine_data, PassScope::program,
         "Lengths of machine data in the unit of the target."},
    Pass{"write_known_data", passes::write_known_data, PassScope::program,
         "Machine data that follow from the program become numbers; others get the target's name and unit."},
    Pass{"name_given_data", passes::name_given_data, PassScope::program,
         "Machine data that are given from outside become variables of the target."},
    Pass{"separate_pattern_words", passes::separate_pattern_words, PassScope::program,
         "What stands beside a pattern of points in its block gets blocks of its own."},
    Pass{"know_polar_turns", passes::know_polar_turns, PassScope::program,
         "Turns of an arc by a computed angle, from the constants at the head of the program."},
    Pass{"branch_block_counts", passes::branch_block_counts, PassScope::program,
         "A computed count of a block as a branch: with 0 the block moves and runs nothing."},
    Pass{"lower_modal_calls", passes::lower_modal_calls, PassScope::program, "Calls after every block with motion."},
    Pass{"lower_calls", passes::lower_calls, PassScope::program, "Local levels, arguments and results of calls."},
    Pass{"declare_arrays", passes::declare_arrays, PassScope::program,
         "Arrays whose indices are computed, and large ones, become arrays of the target under their names."},
    Pass{"map_variables", passes::map_variables, PassScope::program,
         "Spaces, numbers and names of variables become those of the target."},
    Pass{"name_written_files", passes::name_written_files, PassScope::program,
         "Files that the program writes get names that the target takes."},
    Pass{"lower_repeats", passes::lower_repeats, PassScope::program, "Ranges in place, repeats of a block, counts."},
    Pass{"raise_structure", passes::raise_structure, PassScope::program,
         "Jumps become IF, WHILE, REPEAT and LOOP where the options ask for it."},
    Pass{"lower_control", passes::lower_control, PassScope::program,
         "Structured statements and switches become jumps where the target lacks them."},
    Pass{"separate_first_moves", passes::separate_first_moves, PassScope::program,
         "A move whose motion function differs between the ways to it is written for each of them."},
    Pass{"select_written_offsets", passes::select_written_offsets, PassScope::program,
         "A work offset that the program writes is selected again where it does not count at once."},
    Pass{"place_missing_offsets", passes::place_missing_offsets, PassScope::program,
         "Work offsets that the target lacks: its one stands for the one in use, or each selection writes it."},
    Pass{"write_tap_speeds", passes::write_tap_speeds, PassScope::program,
         "Taps that turn the spindle by themselves, for targets whose taps take the spindle as it runs."},
    Pass{"lower_cycles", passes::lower_cycles, PassScope::program,
         "The target's own cycles, or moves; and how cycles are modal."},
    Pass{"write_data_forms", passes::write_data_forms, PassScope::program,
         "Machine data that the program writes, under the target's name and in its unit."},
    Pass{"name_cycle_spindles", passes::name_cycle_spindles, PassScope::program,
         "The spindle of a cycle is said where the target asks for it."},
    Pass{"convert_reference_moves", passes::convert_reference_moves, PassScope::block,
         "The search of a reference point as a move to its place."},
    Pass{"settle_preset_steps", passes::settle_preset_steps, PassScope::program,
         "Increments right behind a preset of the zero point become absolute where controls count them differently."},
    Pass{"join_shift_parts", passes::join_shift_parts, PassScope::program,
         "The coarse or the fine part of a shift as the whole shift."},
    Pass{"write_thread_leads", passes::write_thread_leads, PassScope::program,
         "The lead of a thread in the words of the target."},
    Pass{"complete_scales", passes::complete_scales, PassScope::program,
         "A scale of two axes as one of all, with the words of the third axis divided."},
    Pass{"write_axis_scales", passes::write_axis_scales, PassScope::program, "A scale of one axis by its words."},
    Pass{"convert_surfaces", passes::convert_surfaces, PassScope::program,
         "The coordinates of the face and the cylinder of work with the C axis."},
    Pass{"convert_frames", passes::convert_frames, PassScope::program,
         "Work offsets, shifts, rotation, mirror and scale."},
    Pass{"say_shift_modes", passes::say_shift_modes, PassScope::program,
         "Absolute words are said before a shift that counts by them, where they are not known to be in force."},
    Pass{"convert_poles", passes::convert_poles, PassScope::program, "Poles, and arcs by polar words."},
    Pass{"write_line_angles", passes::write_line_angles, PassScope::program,
         "Lines by their angle and one coordinate, for a target without such words."},
    Pass{"write_out_corners", passes::write_out_corners, PassScope::program,
         "Chamfers, roundings, lasting corners and their feeds."},
    Pass{"write_out_tangents", passes::write_out_tangents, PassScope::program,
         "Tangential entries and exits, tangent arcs."},
    Pass{"convert_arcs", passes::convert_arcs, PassScope::block, "Forms of centres, radius, helix."},
    Pass{"shift_lasting_presets", passes::shift_lasting_presets, PassScope::program,
         "Presets that the target would keep behind the end of the program become shifts."},
    Pass{"convert_distance", passes::convert_distance, PassScope::block, "Absolute and incremental words."},
    Pass{"convert_units", passes::convert_units, PassScope::block, "Millimetres and inches."},
    Pass{"convert_diameters", passes::convert_diameters, PassScope::block, "Diameter and radius words of a lathe."},
    Pass{"convert_dwells", passes::convert_dwells, PassScope::block, "Dwells, exact stop, path mode."},
    Pass{"convert_messages", passes::convert_messages, PassScope::program,
         "Messages to the operator; what is not shown is not computed."},
    Pass{"lower_conditions", passes::lower_conditions, PassScope::program,
         "AND, OR, NOT, comparison within a tolerance."},
    Pass{"lower_expressions", passes::lower_expressions, PassScope::program, "Operators and functions."},
    Pass{"number_tools", passes::number_tools, PassScope::program,
         "Tools called by name get numbers where the target has no names."},
    Pass{"convert_tools", passes::convert_tools, PassScope::block, "Tool change and length compensation."},
    Pass{"choose_gears", passes::choose_gears, PassScope::program, "A gear range where the target needs one."},
    Pass{"check_offset_tables", passes::check_offset_tables, PassScope::program, "What an offset number names."},
    Pass{"check_compensation", passes::check_compensation, PassScope::block, "Rapid moves under radius compensation."},
    Pass{"convert_feed", passes::convert_feed, PassScope::program, "The feed behind a change of the feed mode."},
    Pass{"split_blocks", passes::split_blocks, PassScope::block,
         "The order of actions inside a block, and what needs a block of its own."},
    Pass{"close_skip_groups", passes::close_skip_groups, PassScope::program, "Groups of skipped blocks are closed."},
    Pass{"split_skip_levels", passes::split_skip_levels, PassScope::program, "Skip levels that the target lacks."},
    Pass{"check_skips", passes::check_skips, PassScope::block, "What a skipped block leaves behind."},
    Pass{"fold_range_ends", passes::fold_range_ends, PassScope::program,
         "The marks of mark_range_ends behind what stayed one line go."},
    Pass{"resolve_labels", passes::resolve_labels, PassScope::program,
         "Searches for labels, duplicates, names, limits."},
    Pass{"name_called_labels", passes::name_called_labels, PassScope::program, "Labels that calls of ranges ask for."},
    Pass{"name_routines", passes::name_routines, PassScope::program, "Names and numbers of programs."},
    Pass{"check_call_limits", passes::check_call_limits, PassScope::program,
         "More calls in each other than the target takes."},
    Pass{"order_numbers", passes::order_numbers, PassScope::program, "Block numbers that passes made."},
    Pass{"balance_rows", passes::balance_rows, PassScope::program,
         "Increments that are rounded do not add up to an error."},
    Pass{"safe_start", passes::safe_start, PassScope::program,
         "What the source takes for granted at its start is said in the first blocks."},
    Pass{"say_motion_codes", passes::say_motion_codes, PassScope::program,
         "A motion code that the target would not have in force is said."},
    Pass{"tidy", passes::tidy, PassScope::program, "Empty blocks and words that say nothing new go."},
};

}  // namespace

std::span<const Pass> pipeline() {
  return table;
}

}  // namespace cnctrans::ir
