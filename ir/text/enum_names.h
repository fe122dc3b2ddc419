// Names of every enumerator of the IR, and back, for the textual and the JSON form. Only for the .cpp files of ir/.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

#include "ir/program.h"

namespace cnctrans::ir::detail {

/// EnumText<E>: `count` enumerators from 0 and `at(i)`, the name of the i-th.
template <class E>
struct EnumText;

/// Enums whose names are given by a function name(E) of the IR.
template <class E, E last>
struct NamedByFunction {
  static constexpr std::size_t count = static_cast<std::size_t>(last) + 1;
  static std::string_view at(std::size_t i) { return name(static_cast<E>(i)); }
};
template <std::size_t n>
using NameList = std::array<std::string_view, n>;
/// Enums whose names stand here.
template <const auto& names>
struct NamedByTable {
  static constexpr std::size_t count = names.size();
  static constexpr std::string_view at(std::size_t i) { return names[i]; }
};

// clang-format off
template <> struct EnumText<Plane> : NamedByFunction<Plane, Plane::yz> {};
template <> struct EnumText<Distance> : NamedByFunction<Distance, Distance::incremental> {};
template <> struct EnumText<Units> : NamedByFunction<Units, Units::inch> {};
template <> struct EnumText<MotionKind> : NamedByFunction<MotionKind, MotionKind::tap_floating> {};
template <> struct EnumText<Setting> : NamedByFunction<Setting, Setting::surface> {};
template <> struct EnumText<Surface> : NamedByFunction<Surface, Surface::tool> {};
template <> struct EnumText<HoleKind> : NamedByFunction<HoleKind, HoleKind::mill> {};
template <> struct EnumText<LevelBase> : NamedByFunction<LevelBase, LevelBase::distance_mode> {};
template <> struct EnumText<PeckLaw> : NamedByFunction<PeckLaw, PeckLaw::balanced> {};
template <> struct EnumText<Type> : NamedByFunction<Type, Type::frame> {};
template <> struct EnumText<Datum> : NamedByFunction<Datum, Datum::axis_feed> {};
template <> struct EnumText<UnaryOp> : NamedByFunction<UnaryOp, UnaryOp::bit_not> {};
template <> struct EnumText<BinaryOp> : NamedByFunction<BinaryOp, BinaryOp::concat> {};
template <> struct EnumText<Function> : NamedByFunction<Function, Function::frame_with> {};

inline constexpr NameList<2> compare_names{"exact", "relative"};
inline constexpr NameList<3> half_names{"away", "up", "even"};
inline constexpr NameList<3> word_mode_names{"modal", "absolute", "incremental"};
inline constexpr NameList<3> word_scale_names{"modal", "radius", "diameter"};
inline constexpr NameList<5> rotary_names{"as_value", "positive", "negative", "shortest", "by_sign"};
inline constexpr NameList<3> positioning_names{"with_path", "alone", "alone_not_awaited"};
inline constexpr NameList<3> center_names{"from_start", "absolute", "follows_distance"};
inline constexpr NameList<4> frame_use_names{"normal", "machine", "machine_with_length", "no_programmable"};
inline constexpr NameList<3> feed_memory_names{"shared", "per_mode", "cleared"};
inline constexpr NameList<3> spindle_state_names{"off", "cw", "ccw"};
inline constexpr NameList<5> spindle_step_names{"usual", "none", "cw", "ccw", "off"};
inline constexpr NameList<6> frame_slot_names{"preset", "shift", "rotation", "scale", "mirror", "chain"};
inline constexpr NameList<4> frame_kind_names{"translate", "rotate", "scale", "mirror"};
inline constexpr NameList<6> frame_combine_names{"replace", "replace_named", "add", "compose", "clear", "preset"};
inline constexpr NameList<4> coolant_names{"off", "flood", "mist", "second"};
inline constexpr NameList<3> corner_names{"round", "chamfer_leg", "chamfer_chord"};
inline constexpr NameList<2> tangent_names{"entry", "exit"};
inline constexpr NameList<3> order_names{"before", "with", "after"};
inline constexpr NameList<2> trigger_names{"plane_axis_word", "path_motion"};
inline constexpr NameList<3> comment_names{"line_end", "own", "mid"};
inline constexpr NameList<5> search_names{"whole_first", "forward", "backward", "forward_then_backward", "to_start"};
inline constexpr NameList<2> level_names{"shared", "new_level"};
inline constexpr NameList<3> message_names{"show", "clear", "error"};
inline constexpr NameList<4> file_use_names{"create", "replace", "append", "line"};
inline constexpr NameList<5> scope_names{"global", "level", "routine", "program", "system"};
inline constexpr NameList<4> curve_use_names{"none", "define", "run", "remove"};
inline constexpr NameList<2> routine_names{"main", "sub"};
inline constexpr NameList<2> locality_names{"global", "file_local"};
inline constexpr NameList<2> encoding_names{"utf8", "windows1252"};
inline constexpr NameList<3> eol_names{"lf", "crlf", "cr"};

template <> struct EnumText<SpindleStep> : NamedByTable<spindle_step_names> {};
template <> struct EnumText<Compare> : NamedByTable<compare_names> {};
template <> struct EnumText<RoundHalf> : NamedByTable<half_names> {};
template <> struct EnumText<WordMode> : NamedByTable<word_mode_names> {};
template <> struct EnumText<WordScale> : NamedByTable<word_scale_names> {};
template <> struct EnumText<RotaryDirection> : NamedByTable<rotary_names> {};
template <> struct EnumText<Positioning> : NamedByTable<positioning_names> {};
template <> struct EnumText<CenterMode> : NamedByTable<center_names> {};
template <> struct EnumText<FrameUse> : NamedByTable<frame_use_names> {};
template <> struct EnumText<FeedMemory> : NamedByTable<feed_memory_names> {};
template <> struct EnumText<SpindleState> : NamedByTable<spindle_state_names> {};
template <> struct EnumText<FrameSlot> : NamedByTable<frame_slot_names> {};
template <> struct EnumText<FrameKind> : NamedByTable<frame_kind_names> {};
template <> struct EnumText<FrameCombine> : NamedByTable<frame_combine_names> {};
template <> struct EnumText<CoolantState> : NamedByTable<coolant_names> {};
template <> struct EnumText<CornerKind> : NamedByTable<corner_names> {};
template <> struct EnumText<TangentEnd> : NamedByTable<tangent_names> {};
template <> struct EnumText<Order> : NamedByTable<order_names> {};
template <> struct EnumText<CycleTrigger> : NamedByTable<trigger_names> {};
template <> struct EnumText<CommentPlace> : NamedByTable<comment_names> {};
template <> struct EnumText<Search> : NamedByTable<search_names> {};
template <> struct EnumText<CallLevel> : NamedByTable<level_names> {};
template <> struct EnumText<MessageKind> : NamedByTable<message_names> {};
template <> struct EnumText<FileUse> : NamedByTable<file_use_names> {};
template <> struct EnumText<Scope> : NamedByTable<scope_names> {};
template <> struct EnumText<CurveUse> : NamedByTable<curve_use_names> {};
template <> struct EnumText<RoutineKind> : NamedByTable<routine_names> {};
template <> struct EnumText<Locality> : NamedByTable<locality_names> {};
template <> struct EnumText<Encoding> : NamedByTable<encoding_names> {};
template <> struct EnumText<Eol> : NamedByTable<eol_names> {};
// clang-format on

/// "?" for a value that is no enumerator.
template <class E>
std::string_view enum_name(E e) {
  const auto i = static_cast<std::size_t>(e);
  return i < EnumText<E>::count ? EnumText<E>::at(i) : std::string_view{"?"};
}
template <class E>
std::optional<E> enum_value(std::string_view text) {
  for (std::size_t i = 0; i < EnumText<E>::count; ++i) {
    if (EnumText<E>::at(i) == text) return static_cast<E>(i);
  }
  return std::nullopt;
}

/// Keyword of each kind of action, in the order of ActionData. A modal setting has its own name as keyword.
inline constexpr NameList<27> action_names{
    "set",          "feed",           "spindle",      "spindle_run",      "spindle_orient", "spindle_limit",
    "spindle_gear", "master_spindle", "tool",         "tool_change",      "tool_offset",    "work_offset",
    "frame",        "pole",           "dwell",        "exact_stop_block", "coolant",        "machine_function",
    "stop",         "cycle",          "cycle_cancel", "corner",           "tangential",     "preparation_stop",
    "opaque_word",  "spline_axes",    "surface_set"};
static_assert(action_names.size() == std::variant_size_v<ActionData::variant>);

/// Keyword of each kind of statement, in the order of Statement::node.
inline constexpr NameList<19> statement_names{
    "block",  "set",  "if",         "while",  "until",       "for",     "loop",    "exit",  "jump",  "switch",
    "repeat", "call", "modal_call", "return", "end_program", "message", "declare", "label", "opaque"};
static_assert(statement_names.size() == std::variant_size_v<StatementNode::variant>);

}  // namespace cnctrans::ir::detail
