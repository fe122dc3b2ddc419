// The parts of the cycle pass.
#pragma once

#include "ir/cycles/hole.h"
#include "ir/passes/editor.h"
#include "ir/passes/facts.h"
#include "ir/passes/rewrite.h"

namespace cnctrans::ir::passes {

bool uses_cycles(const Program& program);
/// The tool axis of a cycle: its own, or the normal of the plane in force.
std::optional<AxisId> cycle_axis(const HoleCycle& c, const Block& b, const Facts& facts);
/// The cycle with absolute levels as far as the circumstances are known; what is not known stays as it is.
/// `initial`: height of the tool at the definition in program units, when it is known better than by the facts.
HoleCycle with_absolute_levels(const HoleCycle& c, const Block& b, const Facts& facts,
                               std::optional<double> initial = std::nullopt);
/// The form of the cycle that the target writes natively; nullopt: none.
std::optional<CyclePtr> native_form(const CyclePtr& cycle, const Block& b, const Facts& facts,
                                    const LegaliseContext& context, std::optional<double> initial = std::nullopt);

/// The moves of one hole as blocks, from `height` (mm); empty and a text in `error`: it can't be expanded.
struct Explosion {
  Body blocks;
  double end_height = 0;  ///< mm
};
std::optional<Explosion> explode(const HoleCycle& c, const LineInfo& like, const Block& b, const Facts& facts,
                                 double height, double defined_at, std::string* error);
/// Where the tool stands along its axis, by the text: after cycles the dataflow does not say.
class ToolHeight {
 public:
  explicit ToolHeight(LabelUses uses) : uses_(std::move(uses)) {}
  /// Statements other than blocks that leave the tool where it is and control in the text.
  static bool keeps(const Statement& s);
  /// `ran`: the cycle that the block ran; null: none.
  void follow(const Statement& s, const Facts& facts, const CyclePtr& ran, bool harmless);
  [[nodiscard]] std::optional<double> at(AxisId axis) const { return axis == axis_ ? value_ : std::nullopt; }  ///< mm

 private:
  LabelUses uses_;
  AxisId axis_ = axis::z;
  std::optional<double> value_;
};

/// Moves along the tool axis beside those in the plane.
bool has_plane_word(const Block& b, AxisId tool_axis);

/// Takes the definition or the end of a cycle out of the block.
std::optional<CycleDefine> take_definition(Block& b, WordPos& pos);
bool take_cancel(Block& b);
/// A block without a point at which a modal cycle by call runs all the same, on the controls that have it.
bool disturbs_call(const Block& b);
/// Ends, starts and runs the target's cycle.
Statement off_statement(const LineInfo& like, bool by_call);
Statement on_statement(const LineInfo& like, const CyclePtr& cycle);
Statement single_run(const LineInfo& like, const CyclePtr& cycle);

}  // namespace cnctrans::ir::passes
