// The options of a NUM (reference 1) machine profile: where the manual is silent, or machines differ. Each names its
// values, what holds when the profile does not say, and its meaning.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "machine/options.h"

namespace cnctrans::dialects::num {

// The values of an enum stand in the order of its row below.
enum class Family : std::uint8_t { n7xx, n10xx, flexium };
enum class ArcCentre : std::uint8_t { absolute_in_g90, incremental };
enum class ChasedBack : std::uint8_t { oriented, middle, reversed };
enum class PlungeAxis : std::uint8_t { by_step, x, z };
enum class PlungeBack : std::uint8_t { rapid, feed };
enum class PlungeSteps : std::uint8_t { equal, whole };
enum class FaceX : std::uint8_t { radius, machine };
enum class LetterO : std::uint8_t { digit, letter };
enum class MissingRangeEnd : std::uint8_t { error, to_last_lower };
enum class M30 : std::uint8_t { none, end };
enum class PeckWithdraw : std::uint8_t { eh, er };
enum class PeckLaw : std::uint8_t { degressive, constant };
enum class RangeOrder : std::uint8_t { number, position };

/// What the reader and the writer ask; the values are those of a profile that does not say.
struct Options {
  Family family = Family::n10xx;
  ArcCentre centre = ArcCentre::absolute_in_g90;
  double linear_unit_um = 1;
  double rotary_unit = 0.0001;
  std::string chased_radial;
  ChasedBack chased_back = ChasedBack::oriented;
  std::string reentrant;
  std::string plunged;
  PlungeAxis plunged_axis = PlungeAxis::by_step;
  PlungeBack plunged_back = PlungeBack::rapid;
  PlungeSteps plunged_steps = PlungeSteps::equal;
  std::string plunged_width;
  FaceX face_x = FaceX::radius;
  LetterO letter_o = LetterO::digit;
  MissingRangeEnd missing_range_end = MissingRangeEnd::error;
  M30 m30 = M30::none;
  std::string m_programs;
  PeckWithdraw peck_withdraw = PeckWithdraw::eh;
  PeckLaw peck_law = PeckLaw::degressive;
  RangeOrder range_order = RangeOrder::number;
  bool structured = true;

  bool operator==(const Options&) const = default;
};

inline constexpr std::array option_rows{
    machine::option<&Options::family>("num.family", "7xx|10xx|flx", "10xx", "series of the control"),
    machine::option<&Options::centre>("num.g02_center", "absolute_in_G90|incremental", "absolute_in_G90",
                                      "I J K of an arc under G90"),
    machine::option<&Options::linear_unit_um>("num.linear_unit_um", "number", "1",
                                              "micrometres in one unit of a linear E parameter"),
    machine::option<&Options::rotary_unit>("num.rotary_unit", "number", "0.0001",
                                           "degrees in one unit of a rotary E parameter"),
    machine::option<&Options::chased_radial>(
        "num.g31", "tool|1+|1-|2+|2-", "",
        "what takes the point of G31 to its depth: the tool itself, or an axis of the plane; "
        "not set: as tool in a run, and no translation"),
    machine::option<&Options::chased_back>(
        "num.g31_back", "oriented|middle|reversed", "oriented",
        "way out of the thread of G31: spindle stopped and 2 mm aside, from the middle, or along the thread"),
    machine::option<&Options::reentrant>(
        "num.g63", "corner|tool", "",
        "where G63 begins: before the corner of the blank, or where the tool stands; not set: "
        "as corner in a run, and no translation"),
    machine::option<&Options::plunged>("num.g66", "from_tool|from_end", "",
                                       "the first plunge of G66; not set: as from_tool in a run, and no translation"),
    machine::option<&Options::plunged_axis>("num.g66_axis", "by_step|x|z", "by_step",
                                            "axis of the plunges of G66; by_step: Z with P, X with R"),
    machine::option<&Options::plunged_back>("num.g66_back", "rapid|feed", "rapid", "how a plunge of G66 comes back"),
    machine::option<&Options::plunged_steps>("num.g66_steps", "equal|whole", "equal", "steps of G66"),
    machine::option<&Options::plunged_width>(
        "num.g66_width", "text", "", "mm between the two edges of the tool of G66; empty: the width in the tool table"),
    machine::option<&Options::face_x>("num.face_x", "radius|machine", "radius",
                                      "X under G21: a radius, or as the machine's X is"),
    machine::option<&Options::letter_o>("num.lenient_letter_O", "true|false", "true",
                                        "the letter O is read as the digit 0 in GO, with a warning"),
    machine::option<&Options::missing_range_end>("num.missing_range_end", "error|to_last_lower", "error",
                                                 "a block range whose last block is missing"),
    machine::option<&Options::m30>("num.m30", "none|end", "none", "M30 ends the program"),
    machine::option<&Options::m_programs>(
        "num.m_programs", "text", "", "M functions that call a program, as M:program separated by blanks (\"6:9100\")"),
    machine::option<&Options::peck_withdraw>("num.g83_withdraw", "EH|ER", "EH",
                                             "height to which a deep hole with EH withdraws between its pecks"),
    machine::option<&Options::peck_law>("num.peck_law", "degressive|constant", "degressive",
                                        "pecks of a deep hole with first and last size"),
    machine::option<&Options::range_order>("num.range_order", "number|position", "number",
                                           "how the two ends of a block range are put in order"),
    machine::option<&Options::structured>("num.structured", "no|yes", "yes",
                                          "structured statements are written for the 10xx and later"),
};
/// Those that set what every control has.
inline constexpr std::array shared_option_rows{
    machine::option<&machine::Policies::rotary_signed_axes>(
        "num.rotary_modulo", "text", "BC",
        "letters of the axes on which the sign of an absolute word is its direction; - for none"),
    machine::option<&machine::Policies::spindle_default_gear>(
        "num.default_gear", "text", "M41",
        "gear word written when the source has none; empty: the machine has no gear ranges"),
};

inline Options options_of(const machine::Profile& profile) {
  return machine::read_options(profile, option_rows);
}

}  // namespace cnctrans::dialects::num
