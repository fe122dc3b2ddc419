// G functions of Sinumerik: group, index in the group, what they set (reference-language 15, 14.2-14.8).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace cnctrans::sinumerik {

/// What a G function is for.
enum class GUse : std::uint8_t {
  motion,   ///< a = ir::MotionKind
  setting,  ///< a = ir::Setting, b = value
  units,    ///< a = ir::Units, b = 1: F too (G700, G710)
  feed,     ///< a = ir::FeedMode, b = 0: spindle mode untouched, 1: rpm, 2: constant cutting speed
  path,     ///< a = ir::PathMode, b = 1: with smoothing whose tolerance is not carried
  dwell,
  exact_stop_block,
  frame,         ///< a = FrameVerb
  work_offset,   ///< a = row (0: G500)
  suppress,      ///< G53, G153, SUPA
  pole,          ///< a = 0 G110, 1 G111, 2 G112
  limit,         ///< a = 0 lower (G25), 1 upper (G26)
  approach,      ///< reference point, fixed point: a = ir::MotionKind
  inclined,      ///< plunging with an inclined axis: a = 0 to its start (G7), 1 the plunge (G5)
  timing,        ///< timing, dynamics, smoothing: the nominal path is the same
  compensation,  ///< how radius compensation goes round corners and starts: the programmed path is the same
  joint,         ///< the ends of the moves are the programmed ones, the way between them is another
  tool_frame,    ///< a = the axis (0 to 2) that the tool's direction becomes, 3: ends it; b = 1: the origin, too
  table_frame,   ///< the frame of an orientable table
  own_block,     ///< its block is read apart: G751 is two blocks, G291 begins lines of another language
  unsupported    ///< could move the machine differently and is not carried
};
enum class FrameVerb : std::uint8_t { trans, atrans, rot, arot, scale, ascale, mirror, amirror, rots, arots, g58, g59 };

struct GFunction {
  std::string_view name;  ///< "G1", "TRANS", capitals
  std::int16_t number;    ///< 1 for G1; -1: named only
  std::uint8_t group;
  std::uint8_t index;  ///< place in the group: G[group]=index; 0: none
  bool modal;
  GUse use;
  std::uint8_t a = 0;
  std::uint8_t b = 0;
};

std::span<const GFunction> g_functions();
/// By number (G54 -> 54); null when there is none.
const GFunction* g_function(std::int32_t number);
/// By name in any case ("trans", "G1" are not numbers here: "TRANS"); null when there is none.
const GFunction* g_function(std::string_view name);
/// By group and index (`G[8]=2`); null when there is none.
const GFunction* g_function(std::int32_t group, std::int32_t index);

/// Entry of the missing-features registry that a G function of GUse::unsupported stands under; empty for any other.
std::string_view missing_feature(const GFunction& g);

}  // namespace cnctrans::sinumerik
