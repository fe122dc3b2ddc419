// Data that only a real machine knows, as a machine at rest that nobody touches would answer (overrides 100 %, no input
// on, timers and counters 0), and data that a run can answer under the control's own name.
//
// Names are written as a program reads them, with their index in brackets ("PLCI[1]"). In a table a name may hold `*`
// (any text), `?` (one character) and `#` (one digit); a name without them counts first, then the longest that fits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "machine/profile.h"

namespace cnctrans::machine {

/// What a run answers for a datum that it follows itself ("data_of_run" of the profile).
enum class RunDatum : std::uint8_t {
  travelled,         ///< way of the axis that the name ends with, mm or degrees; starts at 0, can be written
  next_offset,       ///< offset number selected last, in force or waiting for its tool change
  spindle_angle,     ///< of the last orientation, degrees; 0 before the first
  rpm,               ///< programmed spindle speed, 1/min
  cutting_speed,     ///< programmed, m/min
  spindle_limit,     ///< 1/min, 0: none
  call_level,        ///< calls open, 0 in the main program
  next_tool,         ///< tool number selected last, in the spindle or waiting for its change
  spindle_position,  ///< degrees, of a spindle that stands oriented; else not known
  turning_speed,  ///< 1/min as programmed of a spindle that turns at a fixed speed, 0 of one that stands; assumed: the
                  ///< real speed is the machine's
  plane_normal,   ///< place of the axis that stands on the plane among the axes of the machine, from 1; 0: no such axis
  program_number,     ///< of the running program's header; else not known
  last_label,         ///< number of the numbered block carried out last; else not known
  numbered_position,  ///< index: a number of steps. The position of the axis so many places from its present one in the
                      ///< machine's table of it (data CAC[axis,number]); else not known
  block_coordinate    ///< index: block, program. The word of the axis that the name ends with in this numbered block of
                      ///< the main program of that number, as written; 100000 where the block has none; else not known
};
inline constexpr std::size_t run_datum_count = 15;
struct RunAnswer {
  RunDatum datum = RunDatum::travelled;
  std::int32_t spindle = 1;  ///< of the spindle data
};

/// nullopt: the profile has no such table, or no such name in it.
std::optional<double> data_at_rest(const Profile& profile, std::string_view name);
std::optional<RunAnswer> data_of_run(const Profile& profile, std::string_view name);

/// The datum is one of the lengths that the option machine_data.lengths names.
bool is_length_datum(const Profile& profile, std::string_view name);

/// What the profile gives a datum, or else what a machine at rest would answer; `name` with or without brackets about
/// its index.
std::optional<double> value_of_data(const Profile& profile, const std::string& name);

/// Takes the assumed values out: what nobody has said must not make two programs the same.
void forget_data_at_rest(Profile& profile);

// For the JSON form: both tables live in Profile::data, under names that no program can write.
inline constexpr std::string_view at_rest_mark = "at rest: ";
inline constexpr std::string_view of_run_mark = "of run: ";
/// "travelled", or with its spindle "rpm:2".
std::optional<double> run_answer_code(std::string_view text);
std::string run_answer_text(double code);

}  // namespace cnctrans::machine
