// Compares the traces of a source and of its translation: did both move the machine the same way?
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/source.h"
#include "interpreter/trace/cycle_runs.h"
#include "interpreter/trace/trace.h"
#include "machine/profile.h"
#include "machine/world.h"

namespace cnctrans::verifier {

/// How far two values may be apart. Lengths in mm, angles in degrees, times in seconds.
struct Tolerances {
  double length = 0.001;  ///< end points (3 decimals round by 0.0005 mm)
  double center = 0.002;  ///< arc centres
  double angle = 0.0011;
  double feed_relative = 1e-6;
  double seconds = 0.0051;  ///< a dwell unit of 0.01 s rounds by 0.005
  double speed_relative = 1e-6;
  double contour = 0.004;  ///< contours that two similar cycles leave
};

/// The same in programs with inches, whose 4 decimals round by 0.00127 mm.
inline constexpr double length_in_inches = 0.0014;

struct Options {
  Tolerances tolerances;
  /// Compare numbers of tools and offsets literally; off: only that a change happens.
  bool tool_numbers = true;
  bool offset_numbers = false;
  /// The zero point of power-on is another one on the target's machine: the translation has to select the source's.
  bool selects_zero = false;
  /// Where the source has the tool offset of its start, a word of the translation may not select another, or none.
  bool offset_of_start = true;
  /// The target's language can switch the length compensation off: where the source does, the translation has to.
  bool switches_length = false;
  /// The target's language has an exact stop as a mode, and in one block; where it lacks one, the source's is left
  /// aside.
  bool stops_by_mode = false, stops_in_block = false;
  /// No machine of the two is a turret, which makes no tool ready.
  bool makes_ready = true;
  /// The target's language shows texts; where it can't, the source's are left aside.
  bool shows_messages = true;
  /// Power-on selects none on the source's machine, and the target's begins otherwise.
  bool zero_is_open = false;
  /// Where the machines stand before the first event; no axis known: the first move has no length to judge by.
  interpreter::Position source_start{}, target_start{};
  /// Cycles that the two runs carried out: where their moves differ they are compared by what they leave. Null: none.
  const std::vector<interpreter::CycleRun>* source_cycles = nullptr;
  const std::vector<interpreter::CycleRun>* target_cycles = nullptr;
};
/// Feeds, speeds and pitches. A small one may be off by the rounding of its word: F0.0254 is written F0.025.
bool close_relative(double a, double b, double tolerance);
/// The position of a machine before a program; `world`: where it is put; null: as its profile says.
interpreter::Position start_of(const machine::Profile& machine, const machine::World* world = nullptr);

enum class Status : std::uint8_t {
  verified,          ///< every event agrees within 1e-6
  within_tolerance,  ///< agrees within the tolerances; `max_length` says how far apart
  differs,
  nothing_to_compare,  ///< no motion in the source's trace: an empty trace never verifies
  not_replayable       ///< one of the runs ended in an error or by a limit
};

/// What of a program the comparison leaves aside, in numbers.
struct LeftOut {
  std::size_t offset_numbers = 0, path_modes = 0, preselected_tools = 0, messages = 0;
};

/// The first true difference.
struct Difference {
  std::string what;  ///< one sentence: "end point of the linear move: X 10 there, X 20 here"
  FileId source_file = 0, target_file = 0;
  std::uint32_t source_line = 0, target_line = 0;
  std::size_t source_event = 0, target_event = 0;
  std::string target_code{};  ///< of the error that ends the translation's run there
};

/// What of the source the replay has come to.
struct Coverage {
  struct Lines {
    FileId file = 0;
    std::uint32_t first = 0, last = 0;  ///< no line between them was replayed
  };
  std::size_t blocks = 0, replayed = 0;  ///< lines that do something
  std::vector<Lines> missed;
  FileId main = 0;  ///< the file whose lines are named without it
  /// A condition that only ever came out one way.
  struct Branch {
    FileId file = 0;
    std::uint32_t line = 0;
    bool always = false;  ///< it always held; else never
  };
  std::string also;                      ///< inputs of a second replay that agreed too; empty: there was none
  bool explored = false;                 ///< more than one replay was looked for; then:
  std::size_t replays = 1;               ///< that were compared
  std::size_t ways = 0, ways_taken = 0;  ///< of conditions: each can hold or not
  std::vector<Branch> open;              ///< of the conditions that were reached
};

struct Verdict {
  Status status = Status::nothing_to_compare;
  std::uint64_t events = 0;  ///< compared after normalisation
  std::uint64_t moves = 0;
  double max_length = 0;              ///< mm
  std::uint64_t similar_cycles = 0;   ///< compared by the part they leave, not by their passes
  double similar_length = 0;          ///< mm: the largest distance between the parts that two of them leave
  std::uint64_t open_zero_moves = 0;  ///< of the source by the zero point of power-on: no offset was selected
  std::uint64_t unfed_moves = 0;      ///< at a feed that the source never gives, where the translation has one
  double assumed_radius = 0;          ///< mm, of tools whose radius nobody gives: milling cycles ran with it; 0: none
  Difference difference;
  std::string reason;  ///< with not_replayable
  std::string inputs;  ///< what the replay that failed was started with, as options of the command line; empty: nothing
  Coverage coverage;
  Coverage target_coverage;  ///< lines only
  LeftOut left_out;          ///< of the source
  /// Variables that were read before anything gave them a value: of the source, and of the translation alone.
  std::vector<std::string> read_first, target_read_first;
  bool kept_values_tried = false;  ///< with other values in them too
  /// Where the second replay ran; it stands at the zero point when the program needs that, or is warned of it.
  std::optional<machine::World> world;
  bool one_world = false;  ///< the source does not run with zero points other than those of the profiles
  /// With not_replayable: the source ran to its end, the translation moved and did not.
  bool target_stopped = false;
  [[nodiscard]] bool good() const { return status == Status::verified || status == Status::within_tolerance; }
  /// The translation does otherwise than the source. Neither good nor this: nothing is known.
  [[nodiscard]] bool differs() const { return status == Status::differs || target_stopped; }
};

/// Aligns and compares. Normalised first: a linear or rapid move split in collinear parts with the same feed is one
/// move; repeated commands that change nothing (spindle already so, coolant already so, offset again) are dropped on
/// both sides; order inside one block of non-motion events is not compared across a motion-free stretch, order against
/// motion is.
Verdict compare(const std::vector<interpreter::Event>& source, const std::vector<interpreter::Event>& target,
                const Options& options);

/// What the two machines have for a zero point at the start.
void compare_zeros(Options& options, const machine::Profile& source, const machine::Profile& target);

/// What a further replay adds to a good verdict: how far the traces are apart there.
void add_distance(Verdict& sum, const Verdict& further);

/// Text for people: status line, and with a difference both source lines.
std::string describe(const Verdict& verdict, const FileTable& source_files, const FileTable& target_files);
/// In one line why neither sameness nor a difference was found: "not proved: the program moves nothing".
std::string not_proved(const Verdict& verdict);
std::string_view name(Status s);

}  // namespace cnctrans::verifier
