// Replays a program and its translation and compares the two: once, or with one set of inputs after the other.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/program/interpreter.h"
#include "legaliser/legalise.h"
#include "translator/files/loader.h"
#include "verifier/compare.h"

namespace cnctrans::translator {

/// The radius of whatever tool is in use, as --set gives it: a datum of both machines, no variable of the program.
inline constexpr std::string_view tool_radius = "TOOL_RADIUS";

using Settings = std::vector<std::pair<std::string, std::string>>;  ///< NAME=VALUE, as of --set

/// What --set gives to the source's variables, under the names that they have in the translation.
Settings renamed_settings(const Settings& set, const ir::LegaliseReport& names);

/// A program, its machine, and who finds what it calls.
struct Side {
  const ir::Program& program;
  const machine::Profile& profile;
  Loader& loader;
};

/// Replays behind the first one, which takes the program as it is written and the machines as their profiles are. All
/// of them run in a world where zeros, reference points and tool data coincide with nothing, if the source can.
struct FurtherReplays {
  bool skips = false;       ///< one with every block-skip switch on that the program uses
  std::size_t explore = 0;  ///< most replays with other inputs; this one is the first of them
  /// Exploring ends after this time. What it comes to depends on the computer then: only a difference is told.
  std::optional<std::chrono::milliseconds> time;
};
/// What a translation gets without being asked.
inline constexpr FurtherReplays usual_replays{true, 20, std::chrono::milliseconds(100)};

struct ProofOptions {
  interpreter::Options run;  ///< of the first replay, with the names of the source
  std::function<Settings(const Settings&)> target_settings;
  /// Machine data that the map of names places on the target, under the source's names: both replays read the same
  /// values of them.
  std::vector<std::string> shared_data;
  FurtherReplays further;
  int first_skip_switch = 0;  ///< number of the first block-skip switch on the source's control
  ir::Capabilities target;    ///< what the target's language can say; what it lacks is not asked of it
  /// The translation counts on a start at the zero point, and a warning says so.
  bool counts_on_start = false;
  /// The translation has no tool offset where the source has that of its start, and a warning says so.
  bool leaves_offset_of_start = false;
};

/// One run with its trace.
struct Replayed {
  std::vector<interpreter::Event> events;
  std::vector<interpreter::CycleRun> cycles;
  interpreter::Result result;
  Diagnostics diagnostics;
};

struct Proof {
  verifier::Verdict verdict;  ///< of all replays together, or of the first that fails
  Replayed source, target;    ///< the first replay, or the one that fails
};

/// Inputs that the source itself can't run with (error, limit) prove nothing and are passed over, but for those of the
/// first replay.
Proof prove(const Side& source, const Side& target, const ProofOptions& options);

}  // namespace cnctrans::translator
