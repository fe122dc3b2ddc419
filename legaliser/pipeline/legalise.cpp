#include "legaliser/legalise.h"

#include <array>

#include "ir/edit/lines.h"
#include "legaliser/control/called_labels.h"
#include "legaliser/control/jumped_ends.h"
#include "legaliser/control/skip_groups.h"
#include "legaliser/control/skip_levels.h"
#include "legaliser/cycles/cycle_spindles.h"
#include "legaliser/data/given_data.h"
#include "legaliser/data/written_files.h"
#include "legaliser/early_passes.h"
#include "legaliser/frames/axis_scales.h"
#include "legaliser/motion/balance_increments.h"
#include "legaliser/passes.h"
#include "legaliser/stream/stream_watch.h"
#include "legaliser/technology/mixed_feeds.h"
#include "legaliser/technology/motion_codes.h"
#include "legaliser/technology/spindle_limits.h"
#include "legaliser/technology/thread_leads.h"

namespace cnctrans::ir {

namespace {

struct Pass {
  std::string_view name;
  void (*run)(Program&, const LegaliseContext&);
  bool block_local;  ///< looks at one block and the modal state before it only
};

constexpr std::array pipeline{
    Pass{"headings", passes::move_headings, false},
    Pass{"spindle_limits", passes::check_spindle_limits, false},
    Pass{"mixed_feeds", passes::check_mixed_feeds, false},
    Pass{"texts", passes::write_known_texts, false},
    Pass{"called_parts", passes::separate_called_parts, false},
    Pass{"jumped_ends", passes::name_jumped_ends, false},
    Pass{"known_frames", passes::say_known_frames, false},
    Pass{"returns", passes::normalise_returns, false},
    Pass{"range_ends", passes::mark_range_ends, false},
    Pass{"saved_modals", passes::restore_modals, false},
    Pass{"contours", passes::solve_contours, false},
    Pass{"curves", passes::write_out_curves, false},
    Pass{"said_tangents", passes::say_tangent_arcs, false},
    Pass{"skip_groups", passes::open_skip_groups, false},
    Pass{"thread_angles", passes::write_thread_angles, false},
    Pass{"floating_taps", passes::write_floating_taps, false},
    Pass{"axial_taps", passes::say_axial_taps, false},
    Pass{"block_feeds", passes::write_block_feeds, false},
    Pass{"positioning", passes::write_positioning, false},
    Pass{"directions", passes::choose_directions, false},
    Pass{"tool_rows", passes::name_tool_rows, false},
    Pass{"signed_turns", passes::write_signed_turns, false},
    Pass{"machine_data", passes::convert_machine_data, false},
    Pass{"known_data", passes::write_known_data, false},
    Pass{"given_data", passes::name_given_data, false},
    Pass{"pattern_words", passes::separate_pattern_words, false},
    Pass{"block_counts", passes::branch_block_counts, false},
    Pass{"modal_calls", passes::lower_modal_calls, false},
    Pass{"calls", passes::lower_calls, false},
    Pass{"variables", passes::map_variables, false},
    Pass{"written_files", passes::name_written_files, false},
    Pass{"repeats", passes::lower_repeats, false},
    Pass{"structure", passes::raise_structure, false},
    Pass{"control", passes::lower_control, false},
    Pass{"written_offsets", passes::select_written_offsets, false},
    Pass{"tap_speeds", passes::write_tap_speeds, false},
    Pass{"cycles", passes::lower_cycles, false},
    Pass{"data_forms", passes::write_data_forms, false},
    Pass{"cycle_spindles", passes::name_cycle_spindles, false},
    Pass{"reference_moves", passes::convert_reference_moves, true},
    Pass{"preset_steps", passes::settle_preset_steps, false},
    Pass{"shift_parts", passes::join_shift_parts, false},
    Pass{"thread_leads", passes::write_thread_leads, false},
    Pass{"plane_scales", passes::complete_scales, false},
    Pass{"axis_scales", passes::write_axis_scales, false},
    Pass{"surfaces", passes::convert_surfaces, false},
    Pass{"frames", passes::convert_frames, false},
    Pass{"poles", passes::convert_poles, false},
    Pass{"corners", passes::write_out_corners, false},
    Pass{"tangents", passes::write_out_tangents, false},
    Pass{"arcs", passes::convert_arcs, true},
    Pass{"lasting_presets", passes::shift_lasting_presets, false},
    Pass{"distance", passes::convert_distance, true},
    Pass{"units", passes::convert_units, true},
    Pass{"diameters", passes::convert_diameters, true},
    Pass{"dwells", passes::convert_dwells, true},
    Pass{"messages", passes::convert_messages, false},  // what is not shown is not computed
    Pass{"conditions", passes::lower_conditions, false},
    Pass{"expressions", passes::lower_expressions, false},
    Pass{tool_pass, passes::number_tools, false},
    Pass{length_pass, passes::check_tool_lengths, false},
    Pass{"tools", passes::convert_tools, true},
    Pass{gear_pass, passes::choose_gears, false},
    Pass{offset_pass, passes::check_offset_tables, false},
    Pass{"compensation", passes::check_compensation, true},
    Pass{"feed", passes::convert_feed, false},
    Pass{"order", passes::split_blocks, true},
    Pass{"skip_lines", passes::close_skip_groups, false},
    Pass{"skip_levels", passes::split_skip_levels, false},
    Pass{"skips", passes::check_skips, true},
    Pass{"end_marks", passes::fold_range_ends, false},
    Pass{"labels", passes::resolve_labels, false},
    Pass{"called_labels", passes::name_called_labels, false},
    Pass{"routines", passes::name_routines, false},
    Pass{"call_limits", passes::check_call_limits, false},
    Pass{"numbers", passes::order_numbers, false},
    Pass{"balance", passes::balance_rows, false},
    Pass{"safe_start", passes::safe_start, false},
    Pass{"motion_codes", passes::say_motion_codes, false},
    Pass{"tidy", passes::tidy, false},
};

bool run(const Pass& pass, Program& program, const LegaliseContext& context) {
  const std::size_t before = context.diagnostics.error_count();
  pass.run(program, context);
  return context.diagnostics.error_count() == before;
}

}  // namespace

bool legalise(Program& program, const LegaliseContext& context) {
  std::set<const char*> source_numbers;
  for (const auto& r : program.routines) {
    passes::each_line(r.body, [&](const LineInfo& line) {
      if (!line.number.empty()) source_numbers.insert(line.number.data());
    });
  }
  LegaliseContext numbered = context;
  numbered.source_numbers = &source_numbers;
  bool good = true;
  for (const auto& pass : pipeline) good = run(pass, program, numbered) && good;
  number_statements(program);
  return good;
}

std::vector<std::string_view> pass_names() {
  std::vector<std::string_view> names;
  for (const auto& pass : pipeline) names.push_back(pass.name);
  return names;
}

std::vector<std::string_view> block_local_passes() {
  std::vector<std::string_view> names;
  for (const auto& pass : pipeline) {
    if (pass.block_local) names.push_back(pass.name);
  }
  return names;
}

bool once_a_program(std::string_view pass) {
  return pass == gear_pass || pass == offset_pass || pass == length_pass || pass == tool_pass;
}

std::vector<std::string_view> head_passes() {
  std::vector<std::string_view> names;
  for (const auto& pass : pipeline) {
    if (pass.block_local || once_a_program(pass.name)) names.push_back(pass.name);
  }
  return names;
}

bool run_pass(std::string_view name, Program& program, const LegaliseContext& context) {
  for (const auto& pass : pipeline) {
    if (pass.name == name) return run(pass, program, context);
  }
  context.diagnostics.error("TRN-100", {}, "no pass is called '" + std::string(name) + "'");
  return false;
}

}  // namespace cnctrans::ir
