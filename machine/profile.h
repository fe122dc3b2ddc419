// Machine profile: what a program needs to know of its machine. JSON on disk (schema: machine/profile.schema.json).
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ir/block.h"
#include "ir/modal.h"
#include "machine/policies.h"

namespace cnctrans::machine {

class OptionTable;

enum class Kind : std::uint8_t { mill, lathe };

struct AxisSpec {
  ir::AxisId id = ir::axis::x;
  std::string name;
  bool rotary = false;
  bool diameter = false;               ///< words of this axis follow Setting::diameter
  double start = 0;                    ///< mm (radius) or degrees at program start
  double reference_point = 0;          ///< machine coordinate of the reference point
  std::vector<double> fixed_points{};  ///< machine coordinates of the fixed points 1, 2, ...
};

/// What a machine function does here.
enum class MMeaning : std::uint8_t {
  machine_function,  ///< no known meaning: event `m`
  stop,
  optional_stop,
  program_end,
  subprogram_end,
  spindle_cw,
  spindle_ccw,
  spindle_stop,
  spindle_orient,
  tool_change,
  coolant_off,
  coolant_flood,
  coolant_mist,
  coolant_second,
  gear,
  none
};
struct MCode {
  std::int32_t code = 0;
  MMeaning meaning = MMeaning::machine_function;
  ir::Order order = ir::Order::before;
  std::int32_t argument = 0;  ///< gear number
  std::string text;           ///< what it is on this machine, for reports
};

struct Tool {
  std::int32_t number = 0;
  std::string name;
  double radius = 0;  ///< mm
  double length = 0;  ///< mm; lathe: length along Z
  double length_x = 0;
  std::int32_t nose = 0;
  double nose_width = 0;    ///< mm; insert width of a grooving tool
  std::int32_t offset = 0;  ///< default offset number / edge
};

/// Slots of the frame from the outermost to the innermost: pm = slot0 . slot1 ... . p
using FrameOrder = std::vector<ir::FrameSlot>;

struct Profile {
  std::string name;     ///< "fagor-mill"
  std::string dialect;  ///< registry name of the control's language
  Kind kind = Kind::mill;
  std::vector<AxisSpec> axes;
  ir::ModalState power_on;
  FrameOrder frame_order;
  double power_on_feed = 0;  ///< 0: none programmed
  std::vector<MCode> m_codes;
  std::vector<Tool> tools;
  /// Settable work offsets, row 1..: axis -> mm (radius). Missing rows are zero.
  std::map<std::int32_t, std::map<ir::AxisId, double>> work_offsets;
  /// Values of machine data that only this machine knows, by the name a program reads them under ("FRO", "PLCM12").
  std::map<std::string, double> data;
  /// Options as the profile writes them ("frame.preset" = "own"); OptionTable::set keeps `policies` with them.
  std::map<std::string, std::string, std::less<>> options;
  Policies policies;
  double max_rapid = 10000;     ///< mm/min, for reports only
  double arc_tolerance = 0.02;  ///< mm: |r0 - r1| of an arc by centre
  std::int32_t call_depth = 16;

  [[nodiscard]] const AxisSpec* axis(ir::AxisId id) const;
  [[nodiscard]] const MCode* m_code(std::int32_t code) const;
};

/// Built-in profiles are compiled in from machine/profiles/*.json.
std::vector<std::string> builtin_names();
/// A built-in name or a path to a JSON file. nullopt and a message in `error` otherwise.
/// `options`: every option that it may set, the languages' own among them.
std::optional<Profile> load(const std::string& name_or_path, const OptionTable& options, std::string* error);
std::optional<Profile> from_json(std::string_view text, const OptionTable& options, std::string* error);
std::string to_json(const Profile& profile);

}  // namespace cnctrans::machine
