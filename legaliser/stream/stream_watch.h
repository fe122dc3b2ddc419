// What a stream of blocks has to know of the passes: which blocks none of them touches, which ones the block-local
// passes settle, and which ones (or the blocks before them) need the whole program.
#pragma once

#include <optional>

#include "ir/analysis/dataflow.h"
#include "legaliser/legalise.h"
#include "legaliser/technology/offset_tables.h"
#include "legaliser/technology/tool_lengths.h"

namespace cnctrans::ir {

/// The passes for the head of a stream, in order: those of one block, and those that do something once a program.
std::vector<std::string_view> head_passes();
inline constexpr std::string_view gear_pass = "gears", offset_pass = "offset_tables", length_pass = "tool_lengths",
                                  tool_pass = "tool_names";
/// The pass is one of those that do something once a program.
bool once_a_program(std::string_view pass);

class StreamWatch {
 public:
  enum class Verdict : std::uint8_t {
    plain,  ///< no pass touches the block
    local,  ///< the block-local passes settle it, in a program of this block alone on the machine `source_for()`
    whole   ///< a pass would look at other blocks too
  };

  StreamWatch(const Capabilities& target, const machine::Profile& source, const machine::Profile& target_machine);

  /// False: no program of these machines can be streamed (the words of the diameter axis mean something else).
  [[nodiscard]] bool possible() const;
  /// The head: the blocks up to the point where nothing that follows can change what safe_start and the pass over
  /// feeds do to them. They are legalised together. False: the whole program is needed.
  bool take_head(const Statement& s);
  [[nodiscard]] bool head_done() const { return head_done_; }

  /// A block behind the head. Does not follow it.
  [[nodiscard]] Verdict look(const Block& block) const;
  /// The passes for a program of this block alone, in order.
  [[nodiscard]] std::vector<std::string_view> passes_for(const Block& block) const;
  /// The block is done: what it changes holds for those that follow.
  /// \return it is the first to move a tool that has come without a D: bare_tool().tell()
  bool follow(const Statement& s);
  [[nodiscard]] const passes::BareTool& bare_tool() const { return bare_tool_; }
  /// The source machine in the state before the block, for a program of this block alone.
  [[nodiscard]] machine::Profile source_for(const Block& block) const;
  /// Where the block starts, as a move before it: an arc by a centre from its start, for a target that wants the
  /// absolute centre. nullopt: the block does not need it.
  [[nodiscard]] std::optional<Statement> start_of(const Block& block) const;
  /// Blocks were written that follow() has not seen; they change positions only.
  void passed_by() { places_stale_ = true; }
  /// Arcs by the offset of their centre need the place where they begin: no line may be passed by before them.
  [[nodiscard]] bool needs_places() const { return needs_places_; }
  /// Numbers with more places than these count as something else: see follow().
  [[nodiscard]] int places() const { return places_; }
  /// Everything that look() goes by besides the block.
  [[nodiscard]] std::uint64_t key() const;

 private:
  [[nodiscard]] bool needs_whole(const Block& block) const;
  [[nodiscard]] bool action_needs_whole(const Block& block, const Action& action) const;
  [[nodiscard]] bool motion_needs_whole(const Block& block) const;
  [[nodiscard]] bool is_arc_from_start(const Block& block) const;
  [[nodiscard]] bool knows_start(const Block& block) const;
  [[nodiscard]] bool rapid_under_compensation(const Block& block) const;
  [[nodiscard]] bool cuts_without_feed(const Block& block) const;
  [[nodiscard]] bool takes_length(const Block& block) const;
  [[nodiscard]] bool gear_is_new(const Block& block) const;
  [[nodiscard]] bool offset_is_new(const Block& block) const;
  [[nodiscard]] bool too_long(const Value& value) const;
  void follow_head(const Block& block);

  const Capabilities& target_;
  const machine::Profile& source_;
  const machine::Profile& target_machine_;
  ModalState state_;
  int places_;                ///< of the target's coordinates, in the unit that has fewer
  bool at_once_;              ///< the target changes tools at T
  bool keeps_differ_;         ///< a change of the offsets keeps another point on the target
  bool stop_differs_;         ///< a stop stops the spindle on one machine only
  bool rapid_differs_;        ///< a rapid move under radius compensation is compensated on one machine only
  bool adds_length_;          ///< the target wants length compensation switched on, the source has it always
  bool never_on_;             ///< the source switches it, the target has it always
  bool needs_gear_;           ///< the target wants a gear range before the spindle starts
  bool tables_differ_;        ///< D numbers name other rows of the tool data on the target
  bool gear_said_ = false;    ///< a range, or the start of the spindle that gets one
  bool offset_said_ = false;  ///< a D number that has been warned of
  passes::OffsetNumbers offset_numbers_{};
  passes::BareTool bare_tool_{};
  bool bare_differs_;        ///< a tool without a D has another offset on the target
  bool pitch_each_block_;    ///< joined threads get the pitch of the first one, or give up their start angle
  bool mixed_feeds_differ_;  ///< F counts otherwise where linear and rotary axes move together
  bool lengths_differ_;      ///< another plane has the tool's length along another axis on the target
  bool needs_places_;        ///< the target wants the absolute centre of an arc
  Facts facts_;              ///< needs_places_: the positions before the block at hand, and what they follow from
  bool places_stale_ = false;
  bool head_done_ = false;  ///< from here on the head's
  bool said_motion_ = false, moved_ = false, fed_ = false, waits_for_feed_ = false;
  bool long_word_ = false;        ///< a coordinate so far has more places than the target writes
  bool offset_changed_ = false;   ///< a work offset was selected
  bool length_wanted_ = true;     ///< adds_length_: the next move along the tool switches it on
  bool comp_begins_ = false;      ///< radius compensation was switched, and no move has followed
  bool length_switched_ = false;  ///< the source has switched length compensation
};

}  // namespace cnctrans::ir
