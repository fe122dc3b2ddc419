// The registry of what is not carried yet: the gap is code. Called where it would matter; docs' support matrix reads
// it.
#pragma once

#include <span>
#include <string_view>

namespace cnctrans::ir {

struct MissingFeature {
  std::string_view key;     ///< stable, e.g. "cycle.pocket"
  std::string_view title;   ///< what it is, for people
  std::string_view reason;  ///< why it is missing, and until when
  /// It acts beside the programmed path (couplings, tool management, actions in real time): a run goes past it with a
  /// warning. A translation refuses it like the others.
  bool beside_path = false;
  /// It belongs to the one machine that the program was written for: another one has its own. A translation leaves it
  /// out with a warning.
  bool of_one_machine = false;
};
std::span<const MissingFeature> missing_features();
/// What a person does with a line of that feature that a translation refuses.
std::string_view not_translated_hint(std::string_view key);
/// The entry; nullptr when there is none.
const MissingFeature* find_missing_feature(std::string_view key);
/// The entry; an unknown key is a programming error and aborts in debug builds.
const MissingFeature& missing_feature(std::string_view key);

}  // namespace cnctrans::ir
