// Passes that say plainly, before all others, what the source leaves to its control.
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// What the reader keeps as text is refused at its line.
void settle_kept_text(Program& program, const LegaliseContext& context);
/// More calls in each other than the target takes.
void check_call_limits(Program& program, const LegaliseContext& context);
/// Positions in the coordinates of a transformation that the target is not given.
void refuse_transformations(Program& program, const LegaliseContext& context);
/// Statements that read machine data which the target lacks, where the translation goes on without them.
void leave_out_refused_data(Program& program, const LegaliseContext& context);
/// M functions that are too many for one block of the target, and two commands to one spindle.
void split_crowded_blocks(Program& program, const LegaliseContext& context);
/// Radius compensation that begins or ends with an arc; a G40 that ends nothing before an arc goes.
void check_compensation_ends(Program& program, const LegaliseContext& context);
/// Tools called by name get numbers where the target has no names.
void number_tools(Program& program, const LegaliseContext& context);
/// The end of a repeated range stands on the last statement that its source line became.
void mark_range_ends(Program& program, const LegaliseContext& context);
/// The marks of `mark_range_ends` behind what stayed one line go.
void fold_range_ends(Program& program, const LegaliseContext& context);
/// A routine that saves the modal state of its caller writes it back before its returns, for a target without that.
void restore_modals(Program& program, const LegaliseContext& context);

/// Work offsets that are off while nothing counts in them, for a target that always has one.
void drop_unused_offsets(Program& program, const LegaliseContext& context);
/// A work offset that the program writes counts at once on some controls: others are told to select it again.
void select_written_offsets(Program& program, const LegaliseContext& context);
/// The other way round: a writing that counts from the next selection on stands right before it.
void hold_written_offsets(Program& program, const LegaliseContext& context);
/// Points of a contour that follow from its angles, tangency and intersections, written out.
void solve_contours(Program& program, const LegaliseContext& context);
/// Lines by their angle and one coordinate, for a target without such words.
void write_line_angles(Program& program, const LegaliseContext& context);
/// Splines and polynomials as straight steps within the tolerance of the source's profile.
void write_out_curves(Program& program, const LegaliseContext& context);
/// A tangent arc that is in force in the source is said in each block.
void say_tangent_arcs(Program& program, const LegaliseContext& context);
/// The start angle that stays in force in the source is said in each thread of other controls.
void write_thread_angles(Program& program, const LegaliseContext& context);
/// A tap with a compensating chuck as a straight move.
void write_floating_taps(Program& program, const LegaliseContext& context);
/// The two strokes of a rigid tap, in and back out, as a tap.
void say_stroke_taps(Program& program, const LegaliseContext& context);
/// The tapping form of the axial drilling cycle of a lathe as a tap.
void say_axial_taps(Program& program, const LegaliseContext& context);
/// Taps that turn the spindle by themselves, for targets whose taps take the spindle as it runs.
void write_tap_speeds(Program& program, const LegaliseContext& context);
/// A computed count of a block as a branch: with 0 the block moves and runs nothing.
void branch_block_counts(Program& program, const LegaliseContext& context);
/// What stands beside a pattern of points in its block gets blocks of its own before and behind it.
void separate_pattern_words(Program& program, const LegaliseContext& context);
/// A feed of one block as a feed and the one of before behind it.
void write_block_feeds(Program& program, const LegaliseContext& context);
/// Axes that move by themselves as straight moves.
void write_positioning(Program& program, const LegaliseContext& context);
/// Computed rotary positions whose sign is a direction become a branch where the target writes the direction itself.
void choose_directions(Program& program, const LegaliseContext& context);
/// Rotary positions get the sign of the way to them where that sign is the target's direction of turning.
void write_signed_turns(Program& program, const LegaliseContext& context);
/// The coarse or the fine part of a shift as the whole shift.
void join_shift_parts(Program& program, const LegaliseContext& context);
/// A scale of two axes as one of all, with the words of the third axis divided.
void complete_scales(Program& program, const LegaliseContext& context);
/// The search of a reference point as a move to its place, for a target without such a function.
void convert_reference_moves(Program& program, const LegaliseContext& context);
/// Increments right behind a preset of the zero point become absolute where the controls count them differently.
void settle_preset_steps(Program& program, const LegaliseContext& context);
/// Blocks of another program that are called become a subprogram, for a target that calls whole programs only.
void separate_called_parts(Program& program, const LegaliseContext& context);
/// The data of a row of the one tool table as those of an edge of its tool.
void name_tool_rows(Program& program, const LegaliseContext& context);
/// Lengths of machine data in the unit of the target.
void convert_machine_data(Program& program, const LegaliseContext& context);

/// Variables of texts and axes whose value the program gives, for a target that has numbers only.
void write_known_texts(Program& program, const LegaliseContext& context);
/// Frames as values, base frames and turned settable frames, where they are known, as the programmable frame.
void say_known_frames(Program& program, const LegaliseContext& context);
/// Machine data that follow from the program become numbers; others get the target's name and unit.
void write_known_data(Program& program, const LegaliseContext& context);

/// IF, WHILE, REPEAT and LOOP in the place of jumps, where the options ask for it.
void raise_structure(Program& program, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
