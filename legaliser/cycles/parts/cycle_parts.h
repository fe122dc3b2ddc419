// The parts of the cycle pass.
#pragma once

#include "ir/cycles/hole.h"
#include "ir/edit/rewrite.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/analysis/feed_before.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

bool uses_cycles(const Program& program);
/// The tool axis of a cycle: its own, or the normal of the plane in force.
std::optional<AxisId> cycle_axis(const HoleCycle& c, const Block& b, const Facts& facts);
/// The cycle with absolute levels as far as the circumstances are known; what is not known stays as it is.
/// `initial`: height of the tool at the definition in program units, when it is known better than by the facts.
HoleCycle with_absolute_levels(const HoleCycle& c, const Block& b, const Facts& facts,
                               std::optional<double> initial = std::nullopt);
/// The form of the cycle that the target writes natively; nullopt: none.
/// Units of F in one unit of length: 25.4 in inches where F stays metric; nullopt: that differs by the place.
struct FeedScale {
  std::optional<double> metric = 1, inch;
};
FeedScale feed_scale(const Program& program, const machine::Profile& source);
/// What a tap in other words asks of the blocks around it.
struct TapNeeds {
  std::optional<Value> feed;  ///< F while the cycle is in force, program units: it gives the pitch
  FeedScale scale;            ///< given by the pass
  bool bound = false;         ///< a new F or S under the cycle would change the pitch on one of the two controls
  std::string differs;        ///< for people: what the target's tap does not do; empty: nothing
  bool pecks_from_elsewhere = false;  ///< its pecks are counted from another plane already
};
struct TapForm {
  HoleCycle cycle;
  TapNeeds needs;
};
/// `sense`: of the spindle before the cycle, when it is known; taps need it on targets that ask for it in numbers.
std::optional<CyclePtr> native_form(const CyclePtr& cycle, const Block& b, const Facts& facts,
                                    const LegaliseContext& context, std::optional<double> initial = std::nullopt,
                                    std::optional<SpindleState> sense = std::nullopt, TapNeeds* needs = nullptr);
/// The words of a tap that the target lacks, said in another way: see cycle_taps.cpp. Best first.
std::vector<TapForm> tap_forms(const HoleCycle& c, const Block& b, const Facts& facts,
                               std::optional<SpindleState> sense, const FeedScale& scale);
/// native_form() of a tap without the dwell in its hole, where the target's has none.
std::optional<CyclePtr> without_dwell(const HoleCycle& c, const Block& b, const Facts& facts,
                                      const LegaliseContext& context, std::optional<double> initial,
                                      std::optional<SpindleState> sense, TapNeeds* needs);
/// native_form() of a tap whose pecks the target counts from the other plane, surface or reference.
std::optional<CyclePtr> with_pecks_from_elsewhere(const HoleCycle& c, const Block& b, const Facts& facts,
                                                  const LegaliseContext& context, std::optional<double> initial,
                                                  std::optional<SpindleState> sense, TapNeeds* needs);
/// The sense in which the spindle turns, by the text; a stopped one is started clockwise by a tap.
class SpindleSense {
 public:
  explicit SpindleSense(const Program& program);
  /// Where the block moves: behind what acts before that.
  void within(const Statement& s);
  /// Behind the statement. `straight`: control comes to the next statement only from here.
  void follow(const Statement& s, bool straight);
  void forget();
  [[nodiscard]] std::optional<SpindleState> now() const { return only_cw_ ? SpindleState::cw : state_; }
  /// The text has switched it off, and no other way leads here.
  [[nodiscard]] bool stands() const { return stands_; }
  /// As now(), and off where it stands.
  [[nodiscard]] std::optional<SpindleState> or_off() const { return stands_ ? SpindleState::off : now(); }
  /// How it turns here for certain, off where it stands; nullopt: the text does not tell.
  [[nodiscard]] std::optional<SpindleState> surely() const { return known_ ? known_ : always_; }

 private:
  void carry_out(const Action& a, bool surely);
  bool only_cw_ = true;
  std::optional<SpindleState> state_ = SpindleState::cw;
  bool stands_ = false;
  std::optional<SpindleState> known_ = SpindleState::off;
  std::optional<SpindleState> always_;  ///< behind the straight beginning of the program, to its end
};
/// A tap that the spindle stands before: each control starts it, or does not, by itself.
void tell_standing_tap(const Cycle& cycle, const LineInfo& where, const LegaliseContext& context);
/// True, with an error, in another language: a tap whose pitch is F over S runs where no F has been given. The feed of
/// power-on is one in the feed mode of power-on alone.
bool judge_feedless_tap(const Cycle& cycle, const FeedBefore& feed, std::optional<FeedMode> mode, const LineInfo& where,
                        const Program& program, const LegaliseContext& context);
/// The pattern that stands in the block; nullptr: none.
const NamedCycle* pattern_in(const Block& b);
/// The points of a pattern as blocks with a move each; empty and a text in `error`: it can't be said. `guessed`: set
/// when the row begins at the end nearer to the tool, whose place is not known and is taken to be the zero point.
std::optional<Body> pattern_blocks(const NamedCycle& pattern, const LineInfo& like, const Block& b, const Facts& facts,
                                   bool* guessed, std::string* error);
/// Increments from an unknown place, with the decimals of the target: so rounded that every point stands as near to its
/// place as a single word could put it (TRN-626).
void balance_increments(Body& points, const Statement& s, const Block& b, const Facts& facts,
                        const LegaliseContext& context);
/// A pattern whose words only the run knows, as a loop: `setup`, then `first` when there is one, then `next` with
/// `counter` counted up behind it while `again` holds.
struct PatternLoop {
  bool guessed = false;  ///< as in pattern_blocks()
  std::vector<VarRef> taken;
  Body setup;
  std::optional<Block> first;
  Block next;
  VarRef counter;
  ExprPtr again;
};
/// nullopt and a text in `error`: it can't be said. The variables in `taken` are the caller's to release.
std::optional<PatternLoop> pattern_loop(const NamedCycle& pattern, const LineInfo& like, const Block& b,
                                        const Facts& facts, Editor& editor, std::string* error);
/// A pattern in the words of the target, from the point where the tool stands; nullopt: none.
std::optional<CyclePtr> native_pattern(const NamedCycle& pattern, const Block& b, const Facts& facts,
                                       const LegaliseContext& context);

/// The moves of one hole as blocks, from `height` (mm); empty and a text in `error`: it can't be expanded. Without a
/// text: some of its words only the run knows.
struct Explosion {
  Body blocks;
  std::optional<double> end_height;  ///< mm, when it is a number
};
std::optional<Explosion> explode(const HoleCycle& c, const LineInfo& like, const Block& b, const Facts& facts,
                                 const FeedBefore& feed, double height, double defined_at,
                                 std::optional<SpindleState> sense, std::string* error);
/// The same with words that only the run knows: expressions, and a loop over the pecks. `downward`: set when the hole
/// is taken to go downward because no number says so.
std::optional<Explosion> explode_computed(const HoleCycle& c, const LineInfo& like, const Block& b, const Facts& facts,
                                          const FeedBefore& feed, std::optional<double> defined_at,
                                          std::optional<SpindleState> sense, Editor& editor, bool* downward,
                                          std::string* error);
/// Where the tool stands along its axis, by the text: after cycles the dataflow does not say.
class ToolHeight {
 public:
  explicit ToolHeight(LabelUses uses) : uses_(std::move(uses)) {}
  /// Statements other than blocks that leave the tool where it is and control in the text.
  static bool keeps(const Statement& s);
  /// `ran`: the cycle that the block ran; null: none. `initial`: height at its definition in program units.
  void follow(const Statement& s, const Facts& facts, const CyclePtr& ran, bool harmless,
              std::optional<double> initial);
  /// Before the statement: other ways than the text lead to its labels. True: one that the text names.
  bool enter(const Statement& s);
  [[nodiscard]] std::optional<double> at(AxisId axis) const { return axis == axis_ ? value_ : std::nullopt; }  ///< mm

 private:
  void follow_block(const Statement& s, const Facts& facts, const CyclePtr& ran, bool harmless,
                    std::optional<double> initial);
  LabelUses uses_;
  AxisId axis_ = axis::z;
  std::optional<double> value_;
};

/// Moves along the tool axis beside those in the plane.
bool has_plane_word(const Block& b, AxisId tool_axis);
/// A word of a rotary axis, on a machine where it alone makes the block a point of the cycle.
bool turns_to_point(const Block& b, const machine::Profile& machine);

/// Takes the definition or the end of a cycle out of the block.
std::optional<CycleDefine> take_definition(Block& b, WordPos& pos);
bool take_cancel(Block& b);
/// A block without a point at which a modal cycle by call runs all the same, on the controls that have it.
bool disturbs_call(const Block& b);
/// The cycle with its levels absolute or incremental by the mode at its definition, whatever holds at later points.
CyclePtr with_fixed_bases(const CyclePtr& cycle, std::optional<Distance> distance);
/// The retract plane that the words of the cycle say as a number.
std::optional<double> retract_mm(const HoleCycle* hole, std::optional<Units> units);
/// A height in the program's unit at the block.
std::optional<double> in_units(std::optional<double> mm, const Block& b, const Facts& facts);
/// The plane to which the cycle goes back: that of its definition at `defined_at` counts where it goes back to the
/// initial plane.
bool back_is_known(const HoleCycle& hole, std::optional<double> defined_at, const Block& b, const Facts& facts);
/// A block with the count 0 under a cycle goes to its point and runs nothing.
bool position_only(const Block& b);
/// Something of a defining block stands before the new cycle is called: F, S, or a move that is no point.
bool runs_old(const Block& b, bool point_here, bool here);
/// The motion function by which the source goes to the point of the block.
std::optional<MotionKind> way_to_hole(const Block& b, const Facts& facts, const LegaliseContext& context);
/// Height of the tool along `w` before the block in mm, where the dataflow knows it.
std::optional<double> height_mm(const Block& b, const Facts& facts, AxisId w);
/// The tool axis of the cycle at the block; nullopt: no hole cycle, or the plane is not known.
std::optional<AxisId> tool_axis(const CyclePtr& cycle, const Block& b, const Facts& facts);
/// A word of the axis in a block that moves.
bool moves_along(const Block& b, AxisId w);
/// Height of the tool along `w` after the block in mm, where its words say it.
std::optional<double> height_after(const Block& b, const Facts& facts, AxisId w);
bool sets_retract_plane(const Block& b);
/// The way to a hole: rapid on controls that always position so.
void position_kind(Block& b, const LegaliseContext& context);
/// The target's cycle positions in rapid by itself, and takes no motion code beside it.
void by_itself(Block& b);
/// The target goes to the cycle's retract plane by a move of its own, between the way to the hole and the cycle.
bool comes_in_two_moves(const CyclePtr& native, const LegaliseContext& context);
/// A rapid that the block of a cycle puts in force, where the target takes no motion code beside its cycle: a block of
/// its own before it. Empty: none is needed.
std::optional<Block> code_before_cycle(Block& b, const Facts& facts, const LegaliseContext& context);
/// A cycle that starts over its retract plane makes no detour: the tool stands there, or there is one plane only.
/// `height` and the levels in program units.
bool stands_right(const HoleCycle& c, std::optional<double> height);
/// No level of the cycle is counted from where the tool stands.
bool stands_by_itself(const HoleCycle& c);
/// Writes the rapid out by which the source positions without a code.
void position_rapid(Block& b, const LegaliseContext& context);
/// Ends, starts and runs the target's cycle.
Statement off_statement(const LineInfo& like, bool by_call);
Statement on_statement(const LineInfo& like, const CyclePtr& cycle);
Statement single_run(const LineInfo& like, const CyclePtr& cycle);

}  // namespace cnctrans::ir::passes
