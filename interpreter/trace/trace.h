// Events of a run, and where they go. The JSON form is the contract of docs/trace.md.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"
#include "ir/axis.h"
#include "ir/modal.h"

namespace cnctrans::interpreter {

enum class EventKind : std::uint8_t {
  rapid,
  linear,
  arc,
  thread,
  dwell,
  feed_stop,
  spindle,
  tool,
  offset,
  comp,
  coolant,
  m,
  probe,
  message,
  stop,
  end
};
/// Machine position of every axis of the channel: mm (radius) or degrees. Bit n of `known`: axis n is known.
struct Position {
  std::array<double, ir::axis::count_max> value{};
  std::uint32_t known = 0;
};
/// Which axes stand where the data of the tool bring them (its length; under radius compensation its radius): bit n of
/// `with` holds for axis n where bit n of `known` says so.
/// `switched_off`: without length because the length compensation is off, not by D0; `unsaid`: so by power-on or by the
/// change of the tool, by no D and no word of length compensation; `of_start`: no D and no change of the tool has said
/// which offset it is; `selected`: a D has, even if it brings nothing to this axis; `elsewhere`: the tool has an
/// offset, whose length acts along another axis than that of the plane of power-on.
struct OffsetAxes {
  std::uint32_t with = 0, known = 0, switched_off = 0, unsaid = 0, of_start = 0, selected = 0, elsewhere = 0;
};
/// Whether the path stops at the end of a feed move, in place of going on round the corner.
/// `in_block`: by a word of its block (G9), not by the mode.
struct PathStop {
  bool exact = false, in_block = false;
};
enum class EndReason : std::uint8_t { program_end, error, event_limit, step_limit };

/// One flat struct for all kinds: the fields a kind has are listed in docs/trace.md.
struct Event {
  EventKind kind = EventKind::rapid;
  FileId file = 0;
  std::uint32_t line = 0;
  Position to;
  double feed = 0;
  ir::FeedMode feed_mode = ir::FeedMode::per_minute;
  // arc; with radius compensation every move
  ir::Plane plane = ir::Plane::xy;
  /// Where the tool's centre goes beside the path, in the plane of the machine (a mirror changes it; not printed).
  ir::CompSide centre_side = ir::CompSide::off;
  // arc
  double center_u = 0, center_v = 0;
  bool cw = false;
  std::int32_t turns = 0;
  // thread
  double pitch = 0, pitch_change = 0, start_angle = 0;
  // dwell
  double amount = 0;
  bool revolutions = false;
  bool in_machine = false;  ///< a move programmed in machine coordinates (not printed)
  bool zero_open = false;   ///< a move by the zero point of power-on: nothing has selected another (not printed)
  OffsetAxes offset;        ///< behind a move (not printed)
  PathStop stop;            ///< at the end of a feed move (not printed)
  // spindle, tool, offset, comp, coolant, m, stop
  std::int32_t number = 0;
  std::string state;  ///< cw ccw off oriented / off left right / coolant state
  bool css = false;
  double value = 0;
  bool has_limit = false;
  double limit = 0;
  double angle = 0;
  std::string text;     ///< tool name, message, error text
  bool change = false;  ///< tool: carried out; probe: toward the part
  bool optional_stop = false;
  // end
  EndReason reason = EndReason::program_end;
  std::string code;
};

class TraceSink {
 public:
  virtual ~TraceSink() = default;
  virtual void on_event(const Event& e) = 0;
};
/// Keeps all events.
class TraceRecorder : public TraceSink {
 public:
  void on_event(const Event& e) override { events.push_back(e); }
  std::vector<Event> events;
};
/// Counts only: for `run` without --trace.
class TraceCounter : public TraceSink {
 public:
  void on_event(const Event& e) override {
    ++count;
    last = e.kind;
  }
  std::uint64_t count = 0;
  EventKind last = EventKind::end;
};

/// One JSON object without a line end, keys in the contract's order, numbers shortest round-trip.
void append_json(std::string& out, const Event& e, const FileTable& files, const std::vector<std::string>& axis_names);
std::string to_json(const Event& e, const FileTable& files, const std::vector<std::string>& axis_names);
std::string_view name(EventKind k);
std::string_view name(EndReason r);

}  // namespace cnctrans::interpreter
