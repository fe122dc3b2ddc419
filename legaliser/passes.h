// The passes, one function each, in the order of the pipeline (legalise.cpp). They report through the context and leave
// an Opaque statement where the target can't keep the meaning.
#pragma once

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

void move_headings(Program& program, const LegaliseContext& context);  ///< comments above the header of a routine
void normalise_returns(Program& program,
                       const LegaliseContext& context);  ///< early returns, program end in subprograms
void lower_modal_calls(Program& program, const LegaliseContext& context);  ///< calls after every block with motion
void lower_calls(Program& program, const LegaliseContext& context);        ///< local levels, arguments, results
void map_variables(Program& program, const LegaliseContext& context);      ///< spaces, numbers and names of the target
void lower_repeats(Program& program, const LegaliseContext& context);      ///< ranges in place, block repeats, counts
void lower_computed_jumps(Program& program, const LegaliseContext& context);  ///< jumps to computed labels
void lower_control(Program& program, const LegaliseContext& context);         ///< structured statements, switches
void lower_cycles(Program& program, const LegaliseContext& context);    ///< native or exploded, how they are modal
void convert_frames(Program& program, const LegaliseContext& context);  ///< work offsets, programmable frame
/// Presets that the target would keep behind the end of the program become shifts; behind all that counts from the
/// place that a preset says.
void shift_lasting_presets(Program& program, const LegaliseContext& context);
void convert_poles(Program& program, const LegaliseContext& context);       ///< poles, arcs by polar words
void write_out_corners(Program& program, const LegaliseContext& context);   ///< chords, lasting corners, their feeds
void write_out_tangents(Program& program, const LegaliseContext& context);  ///< entries, exits, tangent arcs
void convert_arcs(Program& program, const LegaliseContext& context);        ///< centre forms, radius, helix
void convert_distance(Program& program, const LegaliseContext& context);    ///< absolute and incremental words
/// Machine data that the program writes, under the target's name and in its unit.
void write_data_forms(Program& program, const LegaliseContext& context);
void convert_units(Program& program, const LegaliseContext& context);
/// The coordinates of the face and the cylinder of work with the C axis, as the target says them.
void convert_surfaces(Program& program, const LegaliseContext& context);
void convert_diameters(Program& program, const LegaliseContext& context);
void lower_conditions(Program& program, const LegaliseContext& context);    ///< AND, OR, NOT, tolerance
void lower_expressions(Program& program, const LegaliseContext& context);   ///< operators and functions
void check_tool_lengths(Program& program, const LegaliseContext& context);  ///< T without D, length in other planes
void convert_tools(Program& program, const LegaliseContext& context);       ///< tool change, length compensation
void choose_gears(Program& program, const LegaliseContext& context);        ///< a gear range where the target needs one
void check_offset_tables(Program& program, const LegaliseContext& context);  ///< what a D number names
void check_compensation(Program& program, const LegaliseContext& context);   ///< rapid moves under compensation
void convert_feed(Program& program, const LegaliseContext& context);         ///< F after a change of feed mode
void split_blocks(Program& program, const LegaliseContext& context);         ///< order of actions inside a block
void convert_dwells(Program& program, const LegaliseContext& context);       ///< dwells, exact stop, path mode
void check_skips(Program& program, const LegaliseContext& context);
void convert_messages(Program& program, const LegaliseContext& context);
void resolve_labels(Program& program, const LegaliseContext& context);  ///< searches, duplicates, names, limits
void name_routines(Program& program, const LegaliseContext& context);
void safe_start(Program& program, const LegaliseContext& context);
void tidy(Program& program, const LegaliseContext& context);
void order_numbers(Program& program, const LegaliseContext& context);  ///< block numbers that passes made

}  // namespace cnctrans::ir::passes
