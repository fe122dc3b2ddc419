// Lathe cycles as a cycle of the target that leaves the same part by other passes (equivalences 25.2, 25.5).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ir/cycles/machining.h"
#include "ir/program.h"
#include "legaliser/capabilities.h"
#include "legaliser/cycles/turning/turning_forms.h"

namespace cnctrans::ir::passes {

/// The blocks of a profile that a cycle of the target reads where they stand: from the statement `first` to `last`.
struct ProfileUse {
  std::uint32_t first = 0, last = 0;  ///< ids
  std::string first_label, last_label;
  std::optional<Value> x, z;   ///< where the profile begins, when no block of it says so: a block for it comes first
  std::optional<double> tail;  ///< the profile goes on along X, with `face` along Z, to here: a word of that axis
  bool face = false;
  bool numbers = false;  ///< the labels are block numbers
  /// The blocks, when the program runs through them as well: the cycle reads a copy behind the end of the program.
  Body copy;
  Body blocks;  ///< as they stand
  /// Puts the labels into the words of the cycle.
  void name(NamedCycle& cycle) const;
  bool operator==(const ProfileUse& o) const {
    const auto same = [](const std::optional<Value>& a, const std::optional<Value>& b) {
      return a.has_value() == b.has_value() && (!a || equal(*a, *b));
    };
    return first == o.first && last == o.last && same(x, o.x) && same(z, o.z) && tail == o.tail;
  }
};

/// The target's cycle, and what makes everything behind it as behind the source's.
struct SimilarForm {
  NamedCycle cycle;
  TurnStart before;                  ///< a rapid move there comes first; empty: none
  TurnStart after;                   ///< a rapid move there follows; empty: none
  bool rapid_stays = false;          ///< that one is in force afterwards
  std::optional<MotionKind> motion;  ///< in force afterwards, where the target's cycle leaves another
  std::optional<Value> feed_before;  ///< that the target's cycle works with
  std::optional<Value> feed;         ///< in force afterwards; nullopt: the one of before
  std::optional<ProfileUse> use;     ///< labels go to its words first_label and last_label
  std::optional<double> tail;        ///< of `use`
  bool face = false;                 ///< of `use`
  std::string differs;               ///< for people: what is not the same
};

/// A cycle of the source with what is known around it.
struct SimilarSource {
  const NamedCycle& named;
  ModalState modes;
  TurnStart start;       ///< words that say where the tool stands
  cycles::TurnPoint at;  ///< the same in mm (x radius); NaN: not known
  double nose_width = 0;
  std::optional<bool> longer_in_x;
  std::optional<Value> feed;  ///< in force before it
  const cycles::TurnProfile* profile = nullptr;
  const Capabilities& target;
  std::function<Value(const Value&)> fold;  ///< with the numbers that the head of the program gives to variables
  TurnStart begins{};                       ///< words of the profile's first point
};

/// Cycles of the target that leave the same part; empty with a sentence: none.
std::optional<SimilarForm> similar_stock(const SimilarSource& source, std::string* why);
std::optional<SimilarForm> similar_thread(const SimilarSource& source, std::string* why);

/// The block numbers that stand in the program.
std::set<std::int64_t> block_numbers(const Program& program);
/// Takes the blocks of those profiles out of `blocks`.
void keep_used(const Program& program, const std::vector<ProfileUse>& uses, std::set<std::uint32_t>& blocks);
/// A copy of the blocks with the labels, to stand behind the end of the program.
Body copied_profile(const ProfileUse& use, Program& program);
/// Puts the labels of profiles that the target's cycles read, and their first points, into the program.
void label_profiles(Program& program, const std::vector<ProfileUse>& uses);

}  // namespace cnctrans::ir::passes
