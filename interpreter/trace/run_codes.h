// Codes of the faults of a run. Each has a paragraph in docs/diagnostics/run.md.
#pragma once

#include <string_view>

namespace cnctrans::interpreter::code {

// Found while running.
inline constexpr std::string_view division_by_zero = "RUN-001";
inline constexpr std::string_view function_domain = "RUN-002";
inline constexpr std::string_view number_range = "RUN-003";
inline constexpr std::string_view no_variable = "RUN-004";
inline constexpr std::string_view array_index = "RUN-005";
inline constexpr std::string_view wrong_type = "RUN-006";
inline constexpr std::string_view no_datum = "RUN-007";
inline constexpr std::string_view read_only = "RUN-008";
inline constexpr std::string_view no_axis = "RUN-010";
inline constexpr std::string_view arc_radii = "RUN-011";
inline constexpr std::string_view arc_radius = "RUN-012";
inline constexpr std::string_view arc_undefined = "RUN-013";
inline constexpr std::string_view helix_pitch = "RUN-014";
inline constexpr std::string_view arc_frame = "RUN-015";
inline constexpr std::string_view corner_fit = "RUN-016";
inline constexpr std::string_view corner_alone = "RUN-017";
inline constexpr std::string_view bad_cycle = "RUN-018";
inline constexpr std::string_view radius_assumed = "RUN-140";
inline constexpr std::string_view polar = "RUN-019";
inline constexpr std::string_view thread_pitch = "RUN-009";
inline constexpr std::string_view label_missing = "RUN-020";
inline constexpr std::string_view routine_missing = "RUN-021";
inline constexpr std::string_view call_depth = "RUN-022";
inline constexpr std::string_view level_depth = "RUN-023";
inline constexpr std::string_view repeat_depth = "RUN-024";
inline constexpr std::string_view bad_count = "RUN-025";
inline constexpr std::string_view argument = "RUN-026";
inline constexpr std::string_view frame = "RUN-027";
inline constexpr std::string_view contour = "RUN-031";
inline constexpr std::string_view contour_open = "RUN-032";
inline constexpr std::string_view contour_chosen = "RUN-033";
inline constexpr std::string_view program_error = "RUN-030";
inline constexpr std::string_view file_fault = "RUN-150";
inline constexpr std::string_view file_open_still = "RUN-151";
inline constexpr std::string_view limit_words = "RUN-170";
inline constexpr std::string_view modal_in_modal = "RUN-190";
inline constexpr std::string_view passed_over = "RUN-130";
inline constexpr std::string_view not_carried = "RUN-040";
inline constexpr std::string_view spindle_number = "RUN-041";
inline constexpr std::string_view needs_whole_program = "RUN-042";
inline constexpr std::string_view beside_path = "RUN-043";
inline constexpr std::string_view data_at_rest = "RUN-044";
inline constexpr std::string_view curve_assumed = "RUN-045";
inline constexpr std::string_view curve_place = "RUN-046";
inline constexpr std::string_view curve_data = "RUN-047";
inline constexpr std::string_view value_limits = "RUN-055";
inline constexpr std::string_view pocket_order = "RUN-090";
inline constexpr std::string_view corner_left_out = "RUN-075";
inline constexpr std::string_view text_cut = "RUN-056";
inline constexpr std::string_view surface = "RUN-050";
inline constexpr std::string_view nearly_equal = "RUN-080";
// Found before anything moves.
inline constexpr std::string_view unknown_label = "RUN-101";
inline constexpr std::string_view unknown_routine = "RUN-102";
inline constexpr std::string_view opaque = "RUN-103";
inline constexpr std::string_view no_program = "RUN-104";
inline constexpr std::string_view exit_outside = "RUN-105";
inline constexpr std::string_view bad_set = "RUN-106";
inline constexpr std::string_view unused_set = "RUN-107";

}  // namespace cnctrans::interpreter::code
