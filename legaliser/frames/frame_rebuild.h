// The programmable frame said in the target's own slots.
#pragma once

#include <optional>
#include <vector>

#include "ir/edit/rewrite.h"
#include "legaliser/frames/frame_state.h"

namespace cnctrans::ir::passes {

class FrameTarget {
 public:
  /// `ends_preset`: the program takes a preset back somewhere; a target that can't do that gets it as a shift.
  FrameTarget(const Program& program, const LegaliseContext& context, bool ends_preset)
      : program_(program),
        context_(context),
        preset_as_shift_(ends_preset && !can(FrameSlot::preset, FrameCombine::clear)) {}

  [[nodiscard]] bool can(FrameSlot slot, FrameCombine combine) const;
  /// The preset of the source is written as one, so that it is no part of what the other slots hold.
  [[nodiscard]] bool keeps_preset() const { return !preset_as_shift_ && can(FrameSlot::preset, FrameCombine::preset); }
  [[nodiscard]] bool chains() const { return can(FrameSlot::chain, FrameCombine::replace); }

  /// The change as the target can make it in the same slot, so that its slots stay equal to the source's; empty: the
  /// frame must be rebuilt. `plane`: in force here.
  [[nodiscard]] std::optional<FrameChange> as_it_is(const FrameChange& c, const FrameState& before,
                                                    const FrameState& after, std::optional<Distance> distance) const;

  /// A preset where nobody knows the place of the tool (millimetres): a shift inside of all that is in force, by the
  /// coordinate that it has less the one that it gets, leaves every point where the preset puts it:
  /// `ATRANS X=$P_EP[X]-10`. Empty: the place is known, or the target can't say it.
  [[nodiscard]] std::optional<FrameChange> preset_from_here(const FrameChange& c, const FrameState& after) const;

  /// Parts of the canonical frame that a change leaves as they are.
  struct Parts {
    bool shift = false, turn = false, factor = false, mirror = false;
  };
  [[nodiscard]] Parts kept_by(const FrameChange& c, const FrameState& before, const FrameState& after) const;

  enum class Result : std::uint8_t { done, unknown, foreign, impossible };
  /// Actions that make the target's frame equal to `after`. `before`: what it holds; empty: not known at all.
  Result rebuild(const FrameChange& c, const std::optional<PlanarFrame>& before, const PlanarFrame& after,
                 const Parts& kept, std::optional<Plane> plane, std::vector<Action>& out) const;
  /// The target has taken the shift back with the work offset just selected: it is said again. False: how far it is
  /// shifted is not known.
  [[nodiscard]] bool shift_again(const FrameState& state, std::vector<Action>& out) const;
  /// What makes the frame neutral that `state` may hold.
  [[nodiscard]] std::vector<Action> taken_back(const FrameState& state) const;
  /// On a target whose frames are chained: `next` is `here` and more inside it, or the same.
  [[nodiscard]] static bool extends(const PlanarFrame& here, const PlanarFrame& next);
  /// The part of a state that the rebuilt slots hold.
  [[nodiscard]] PlanarFrame part(const FrameState& state) const {
    return state.whole(context_.source_machine, !keeps_preset());
  }

 private:
  [[nodiscard]] bool only_chain(const FrameState& state) const;
  void name_all_mirrored(FrameChange& change, const std::optional<std::uint32_t>& mirrored) const;
  bool to_chain(const std::optional<PlanarFrame>& before, const PlanarFrame& f, bool shift, std::optional<Plane> plane,
                std::vector<Action>& out) const;
  bool to_slots(const std::optional<PlanarFrame>& before, const PlanarFrame& f, bool shift, std::optional<Plane> plane,
                std::vector<Action>& out) const;
  bool inside(const PlanarFrame& before, const PlanarFrame& after, const Parts& kept, std::optional<Plane> plane,
              std::vector<Action>& out) const;
  bool added(const FrameChange& c, const PlanarFrame& before, std::optional<Plane> plane,
             std::vector<Action>& out) const;
  bool beside(const PlanarFrame& before, const PlanarFrame& after, const Parts& kept, std::optional<Plane> plane,
              std::vector<Action>& out) const;
  bool shift_slot(const PlanarFrame* before, const PlanarFrame& f, std::vector<Action>& out) const;
  bool turn_slot(const PlanarFrame* before, const PlanarFrame& f, std::vector<Action>& out) const;
  bool scale_slot(const PlanarFrame* before, const PlanarFrame& f, std::vector<Action>& out) const;
  bool mirror_slot(const PlanarFrame* before, const PlanarFrame& f, std::vector<Action>& out) const;
  [[nodiscard]] bool same_order(const FrameState& before, const FrameState& after, FrameSlot changed) const;

  const Program& program_;
  const LegaliseContext& context_;
  bool preset_as_shift_ = false;
};

}  // namespace cnctrans::ir::passes
