// Rows of the table of frames (Datum::frame_settable) that are no settable offsets: base frames, which lie outside of
// the settable one, and frames of the control that nobody sets.
#pragma once

#include <cstdint>

namespace cnctrans::ir::frame_rows {

inline constexpr std::int32_t first = 1000;  ///< smaller rows are settable offsets
/// Base frames as they are stored: they come into force with the next selection of a settable offset. In the order of
/// their rows, the outermost first: frames of the control, from `own_base` on those of the program.
inline constexpr std::int32_t stored_base = 1000;
/// The same rows in force: a change acts at once.
inline constexpr std::int32_t active_base = 1100;
inline constexpr std::int32_t own_base = 10;
/// Neutral frames; they can only be read.
inline constexpr std::int32_t neutral = 1200;
/// All base frames in force from `own_base` on, one behind the other; it can only be read.
inline constexpr std::int32_t total_base = 1300;
/// Behind the row stand 18 values: three ideal and three measured points. The frame takes the ones to the others; read
/// as a number the row is what is left between them (motion reference 8).
inline constexpr std::int32_t measured = 1400;
/// No frame: where two elements of contours cut. Behind the row stand what is asked (0: do they, 1, 2: abscissa,
/// ordinate of the point), for each element its code (units digit 0 to 3: G0 to G3), start, end and centre, and the
/// answer where there is no point (motion reference 19.4).
inline constexpr std::int32_t crossing = 1500;

}  // namespace cnctrans::ir::frame_rows
