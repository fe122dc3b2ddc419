// Rows of the table of frames (Datum::frame_settable) that are no settable offsets: base frames, which lie outside of
// the settable one, and frames of the control that nobody sets.
#pragma once

#include <cstdint>

namespace cnctrans::ir::frame_rows {

inline constexpr std::int32_t first = 1000;  ///< smaller rows are settable offsets
/// Base frames as they are stored: they come into force with the next selection of a settable offset. In the order of
/// their rows, the outermost first.
inline constexpr std::int32_t stored_base = 1000;
/// The same rows in force: a change acts at once.
inline constexpr std::int32_t active_base = 1100;
/// Neutral frames; they can only be read.
inline constexpr std::int32_t neutral = 1200;
/// All base frames in force, one behind the other; it can only be read.
inline constexpr std::int32_t total_base = 1300;
/// Behind the row stand 18 values: three ideal and three measured points. The frame takes the ones to the others; read
/// as a number the row is what is left between them (motion reference 8).
inline constexpr std::int32_t measured = 1400;

}  // namespace cnctrans::ir::frame_rows
