// One run of the cycle pass over a routine.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "ir/edit/search.h"
#include "legaliser/cycles/cycle_callees.h"
#include "legaliser/cycles/cycle_words.h"
#include "legaliser/cycles/milling/milling_moves.h"
#include "legaliser/cycles/parts/cycle_parts.h"
#include "legaliser/cycles/turning/machining_moves.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::ir::passes {

inline constexpr std::string_view offset_ends =
    "the work offset ends while a cycle is active: whether its levels go along is not the same on every control";

class CyclePass {
 public:
  CyclePass(Program& program, Routine& routine, const LegaliseContext& context, const FactsOf& facts,
            const FeedsBefore& feeds, CycleCallees& callees, StaleWords* stale = nullptr)
      : program_(program),
        context_(context),
        facts_(facts),
        feeds_(feeds),
        callees_(callees),
        stale_(stale),
        editor_(program, routine, context),
        uses_(label_uses(program, routine)),
        turning_(program, routine, context, feeds),
        milling_(program, routine, context, feeds),
        height_(uses_),
        sense_(program),
        feed_scale_(feed_scale(program, context.source_machine)) {
    if (routine.kind != RoutineKind::main) sense_.forget();
    by_call_ = context.target.modal_cycle_by_call;
    look_for_definitions();
  }

  void run() {
    for_each_statement(editor_.routine.body, [this](Statement& s) {
      each_label_ref(s, [&](LabelRef& l, bool is_end) {
        if (!is_end) first_use_.emplace(std::pair{l.is_number, l.text}, s.id);
      });
    });
    look_for_writes();
    Body out;
    walk(editor_.routine.body, out);
    add_copies(out);
    editor_.routine.body = std::move(out);
    report_unsure();
  }
  [[nodiscard]] std::set<std::uint32_t> profiles() const {
    auto all = turning_.profile_blocks();
    all.insert(milling_.contour_blocks().begin(), milling_.contour_blocks().end());
    return all;
  }

  [[nodiscard]] const std::vector<ProfileUse>& uses_of_profiles() const { return uses_of_profiles_; }

 private:
  struct Active {
    std::uint32_t from = 0;  ///< the statement that defined it or changed its words last
    CyclePtr source;
    CyclePtr native;  ///< null: written out
    CycleTrigger trigger = CycleTrigger::plane_axis_word;
    bool single = false;           ///< not every way to a point leads through the first one: each gets its own run
    bool on_target = false;        ///< the target's own cycle is in force
    bool was_on_target = false;    ///< it has been
    bool deferred = false;         ///< the first point on the target defines it
    std::uint32_t defined_in = 0;  ///< the statement of that point
    TapNeeds needs;
    bool maybe_on_target = false;          ///< in force on one of the ways that lead here
    std::optional<AxisId> axis;            ///< of the tool at the definition
    std::optional<double> defined_at;      ///< height of the tool at the definition, mm
    std::optional<double> height;          ///< of the tool over the holes, mm
    bool left_height = false;              ///< the tool has left the height of its definition
    bool repeats = false;                  ///< a loop made for a pattern comes here again, from another height
    std::optional<Units> units;            ///< of its words
    std::vector<VarRef> stale;             ///< read by its words and changed since its definition
    std::vector<std::uint32_t> said_by{};  ///< the statements that gave it its words
    bool told = true;                      ///< what is to be said of its reference plane, at its first point
    bool told_feedless = false;            ///< that it taps by an F that nobody has given
  };

  /// How the cycle stands on the ways to a label.
  struct Left {
    bool on = false, off = false;  ///< the target's own is in force, or is not
    bool left_height = false;
    std::optional<double> height;
  };

  void walk(Body& body, Body& out);
  void bodies(Statement& s);
  [[nodiscard]] bool begins_with_point(const Body& body) const;  ///< nothing moves or calls before it
  void walk_inside(Body& inner) {
    Body nested;
    walk(inner, nested);
    inner = std::move(nested);
  }

  // --- the cycle of the text and those of the ways (cycle_ways.cpp) ---------------------------------------------

  void look_for_definitions();
  /// The active cycle of the text is in force on every way to the statement.
  [[nodiscard]] bool sure(const Facts& facts) const;
  [[nodiscard]] bool surely_on(const Facts& facts) const { return surely_active_ || facts.cycle_active_known; }
  /// A cycle of the target may be in force before a statement with these facts.
  [[nodiscard]] bool old_may_run(const Facts& facts) const;
  /// By the text none is active, and on some way to the block one of this routine is.
  [[nodiscard]] bool cycle_by_another_way(const Block& b, const Facts& facts) const;
  [[nodiscard]] bool refuses_axis_word(const Block& b, const Facts& facts) const;
  /// The block is a point in the words of the target too, whichever of its own cycles is in force.
  [[nodiscard]] bool bare_point(const Block& b, const Facts& facts) const;
  void refuse_other_ways(Statement& s) const;
  void refuse_other_ways(Statement&& s, Body& out) const {
    refuse_other_ways(s);
    out.push_back(std::move(s));
  }
  [[nodiscard]] bool gives_back(bool reachable) const;  ///< a subprogram, a modal call that it leaves in force
  void leave_while_off(const Statement& s) const;
  /// The end of the routine or of its cycle in the text; on other ways the cycle goes on, and the target has none.
  void leave_off() const;
  /// F, S or a motion code alone under a cycle by call of another program part: it runs there in the source alone.
  [[nodiscard]] bool path_word_under_call(const Block& b, const Facts& facts) const;
  /// The block is a point of whichever hole cycle may be in force: not along the tool alone, or modal calls run there.
  [[nodiscard]] bool may_be_point(const Block& b, const Facts& facts) const;
  /// A block or a call under a cycle that another routine defines, perhaps.
  void note_foreign(const Statement& s, const Facts& facts) const;
  /// It changes the plane that a hole of such a cycle goes back to, and the target's cycle names it. True: refused.
  [[nodiscard]] bool refuse_foreign_plane(Statement& s, Body& out) const;
  /// Where the hole goes back to by G98 or G99, which differ by the way: refused. True: done.
  [[nodiscard]] bool refuse_unknown_plane(Statement& s, const CyclePtr& cycle, Body& out) const;
  /// The point is reached in rapid under the cycle and by the function in force without it: refused. True: done.
  [[nodiscard]] bool refuse_two_ways(Statement& s, Body& out) const;
  void callee_sets_plane(const CallRoutine& call, const Statement& s) const;
  [[nodiscard]] bool off_between() const {
    return active_ && active_->native && !by_call_ && active_->was_on_target && !active_->on_target &&
           !active_->maybe_on_target && !active_->single;
  }
  /// Points of a cycle by call that depend on the way are right as long as the target has every cycle.
  void report_unsure() const;

  /// A way that comes in at a label has perhaps not passed the point that defines the target's cycle, or the block that
  /// has switched it off.
  void join(const Statement& s);

  /// All that leads to the label stands behind the point that defines the target's cycle.
  [[nodiscard]] bool behind(const LabelRef& l) const {
    const auto it = first_use_.find({l.is_number, l.text});
    return !uses_.computed && it != first_use_.end() && it->second > active_->defined_in;
  }

  void leave(Statement& s);
  void note_end(const std::vector<LabelRef>& labels, const Statement* written);  ///< of a repeated range, perhaps
  void perhaps_skipped(const Active& before);  ///< a switch may leave the statement out that came behind this state
  void behind_range(const Statement& s);       ///< a repeat leaves the cycle as the end of its range does
  void end_elsewhere(const Statement& s);      ///< a subprogram has ended the cycle, on every way
  void one(Statement&& s, Body& out) {
    end_elsewhere(s);
    join(s);
    leave(s);
    const Statement seen = std::holds_alternative<Block>(s.node) ? s : made(s.line, Label{});
    if (height_.enter(s)) sense_.forget();
    sense_.within(s);
    const bool harmless = ToolHeight::keeps(s);
    const std::size_t first = out.size();
    ran_.reset();
    const auto* source = std::get_if<Block>(&seen.node);
    branch_before_first_point(s);
    const bool moved = moves_coordinates(s);
    const auto labels = labels_on(s.line);
    const auto skipped = s.line.skip_mask != 0 ? active_ : std::nullopt;
    lower(std::move(s), out);
    if (skipped && active_) perhaps_skipped(*skipped);
    note_end(labels, out.size() > first ? &out.back() : nullptr);
    late_.clear();  // of a refused block
    then_.clear();
    for (std::size_t i = first; i < out.size() && source != nullptr && !source->empty(); ++i) settle(out[i]);
    const auto* b = std::get_if<Block>(&seen.node);
    if (!ran_ && active_ && b != nullptr && !position_only(*b) && triggers(*b, facts_.before(seen))) ran_ = active_;
    if (moved && active_) lose_height(seen);
    std::optional<double> initial;
    if (ran_ && b != nullptr) initial = in_units(ran_->defined_at, *b, facts_.before(seen));
    height_.follow(seen, facts_.before(seen), ran_ ? ran_->source : nullptr, harmless, initial);
    sense_.follow(seen, b != nullptr || harmless);
  }
  /// A modal call that the target defines at the first point, and a branch comes before that point.
  void branch_before_first_point(Statement& s);
  void lower(Statement&& s, Body& out);

  void put(Body& out, Body&& pieces, Statement&& s) {
    const std::size_t main = pieces.size();
    pieces.push_back(std::move(s));
    put_group(out, std::move(pieces), main);
  }
  /// What was held back goes behind all pieces: into the last one where that is the block itself, and the target
  /// carries it out behind the hole.
  void put_group(Body& out, Body&& pieces, std::size_t main);
  /// What acts after the motion acts after the hole: behind all its pieces.
  void hold_back(Block& b) {
    for (auto& a : take_after(b)) late_.push_back(std::move(a));
  }

  // --- definitions ----------------------------------------------------------------------------------------------

  void define_each(Statement&& s, const CycleDefine& d, Active&& a, Body&& pieces, Body& out);
  Active define(const CyclePtr& cycle, CycleTrigger trigger, const Block& b, const Facts& facts) const {
    Active a;
    a.needs.scale = feed_scale_;
    a.units = setting_in<Units>(b, facts, Setting::units);
    a.source = with_fixed_bases(cycle, setting_in<Distance>(b, facts, Setting::distance));
    a.trigger = trigger;
    if (const auto* hole = std::get_if<HoleCycle>(&cycle->node); hole != nullptr && hole->keeps_initial) {
      a.source = changed(std::get<HoleCycle>(a.source->node), b, facts);
      a.height = active_->height;
      a.defined_at = active_->defined_at;
      a.said_by = active_->said_by;
      if (auto native =
              native_form(a.source, b, facts, context_, in_units(a.defined_at, b, facts), sense_.now(), &a.needs))
        a.native = *native;
      // Over the holes the tool stands elsewhere than at the definition, whose height nobody knows.
      const auto w = tool_axis(cycle, b, facts);
      if (w && height_mm(b, facts, *w) && !back_is_known(std::get<HoleCycle>(a.source->node), a.defined_at, b, facts))
        a.native = nullptr;
      if (a.native && w && !by_call_ && std::holds_alternative<HoleCycle>(a.native->node) &&
          !stands_right(std::get<HoleCycle>(a.native->node), in_units(height_.at(*w), b, facts)))
        a.native = nullptr;
      return a;
    }
    a.axis = tool_axis(cycle, b, facts);
    if (a.axis) a.height = height_mm(b, facts, *a.axis);
    if (!a.height && a.axis) a.height = height_.at(*a.axis);
    a.defined_at = a.height;
    if (auto native = native_form(cycle, b, facts, context_, in_units(a.height, b, facts), sense_.now(), &a.needs))
      a.native = *native;
    return a;
  }
  /// The facts before a definition; a feed that surely nobody has given is 0, and needs no way back.
  [[nodiscard]] Facts facts_for_tap(const Statement& s, const Block& b) const {
    Facts facts = facts_.before(s);
    if (feeds_.at(s, b, facts).none) facts.feed = 0;
    return facts;
  }
  /// The bottom that a change does not name: it stays at its height, also where it is said from a reference plane that
  /// moves. nullopt: that height is not known (cycle_heights.cpp).
  [[nodiscard]] std::optional<Level> kept_bottom(const HoleCycle& change, const Block& b, const Facts& facts) const;
  bool refuse_lost_bottom(Statement& s, const CycleDefine& d, Body& out);
  /// The cycle in force with the words of the change.
  CyclePtr changed(HoleCycle change, const Block& b, const Facts& facts) const {
    const auto& before = std::get<HoleCycle>(active_->source->node);
    change.keeps_initial = false;
    if (!change.bottom.given) change.bottom = kept_bottom(change, b, facts).value_or(before.bottom);
    if (!change.reference.given) change.reference = before.reference;
    auto whole = std::make_shared<Cycle>();
    whole->node = std::move(change);
    return whole;
  }
  /// A pattern: as one of the target's, else a block for each point.
  void pattern(Statement&& s, const CycleDefine& d, Body&& pieces, Body& out);
  bool way_by_itself(Statement& p, const FeedBefore& feed, Body& before);
  void tell_guessed_row(const Statement& s) const;
  void pattern_as_loop(Statement&& s, PatternLoop&& loop, Body&& pieces, Body& out);
  /// One feed into the hole and out of it: an F in force while the target's cycle runs (cycle_feeds.cpp).
  void feed_as_a_word(Active& a, const Block& b, const Facts& facts) const;
  /// The F that gives a tap its pitch stands beside its definition; the one before it comes back behind the cycle.
  void feed_for_tap(Block& b, const Active& a);
  static std::optional<Action> feed_after_tap(const Active& a, const Facts& facts);
  /// A tap by F over S where no F has been given, said once for each definition.
  void judge_feedless(Active& a, const Statement& s) const;
  /// Behind the tap, where the block has no F of its own. Also when the tap was off already, or another cycle follows.
  void feed_comes_back(const Statement& s, Block& b, const Facts& facts);
  /// A tap that stands elsewhere in the text may be in force here too.
  [[nodiscard]] bool tap_by_a_jump(const Facts& facts) const;
  /// One run behind the way to the hole, which has another F than the tap.
  static void run_alone(Statement&& run, const Active& a, const Block& way, const Facts& facts, Body& pieces);
  /// A new F, S or sense at a point would give the tap another pitch or end on one of the two controls only.
  void check_tap(const Statement& s) const;

  void cancel_statement(Statement&& s, Body& out);

  static void leave_line(Statement&& s, Body& out) {
    if (s.line.number.empty() && s.line.labels.empty() && s.line.comments.empty()) return;
    s.node = Label{};
    out.push_back(std::move(s));
  }

  /// `MCALL CYCLE..`: the cycle runs at later points.
  void modal_call(Statement&& s, Body& out);

  // --- blocks ---------------------------------------------------------------------------------------------------

  void block(Statement&& s, Body& out) {
    auto& b = std::get<Block>(s.node);
    WordPos pos;
    if (position_only(b)) {
      if (by_call_ && active_ && active_->on_target && refuse_stale(s, out)) return;
      return position(std::move(s), out);
    }
    if (refuse_other_levels(s, out)) return;
    if (!active_ || !active_->needs.feed) tap_feed_ = tap_feed_ && action_in<SetFeed>(b) == nullptr;
    const bool cancelled = take_cancel(b);
    if (!cancelled && pattern_in(b) != nullptr) note_foreign(s, facts_.before(s));
    const auto definition = take_definition(b, pos);
    Body pieces;
    if (cancelled || definition) tap_feed_ = tap_feed_ || tap_by_a_jump(facts_.before(s));
    if (cancelled) cancel(s, b, definition.has_value(), pieces);
    if (definition) {
      define_in_block(std::move(s), *definition, std::move(pieces), out);
      return;
    }
    if (!cancelled) note_foreign(s, facts_.before(s));
    if (!cancelled && !active_ && path_word_under_call(b, facts_.before(s))) {
      refuse_other_ways(s);
      out.push_back(std::move(s));
      return;
    }
    if (active_) {
      point(std::move(s), std::move(pieces), out);
      return;
    }
    if (!cancelled && (refuse_two_ways(s, out) || refuse_foreign_plane(s, out))) return;
    if (!cancelled && cycle_by_another_way(b, facts_.before(s))) {
      if (bare_point(b, facts_.before(s))) {
        unsure_.push_back(s.line.span);
        if (by_call_) position_kind(b, context_);
        return put(out, std::move(pieces), std::move(s));
      }
      refuse_other_ways(s);
      out.push_back(std::move(s));
      return;
    }
    if (b.empty() && !pieces.empty()) {
      pieces.back().line = s.line;
      out.push_back(std::move(pieces.back()));
      return;
    }
    put(out, std::move(pieces), std::move(s));
  }

  /// The move to a point without the cycle.
  void position(Statement&& s, Body& out);

  void cancel(const Statement& s, Block& b, bool defines_again, Body& pieces);

  /// The tool stands below the plane to which the target's cycle would go first.
  [[nodiscard]] bool below_retract_plane(const Block& b, const Facts& facts) const;
  std::optional<Value> leave_by_own_move(CyclePtr& cycle, const Active& a) const;
  /// The target's cycle may not be called between its reference plane and its depth, and the tool stands there.
  [[nodiscard]] bool rises_first(const Active& a, const Block& b, const Facts& facts) const;
  /// The point, the move up to the reference plane, then the cycle where the tool stands.
  void rise_and_define(Statement&& s, const Active& a, bool modal, Body&& pieces, Body& out);
  void define_in_block(Statement&& s, const CycleDefine& d, Body&& pieces, Body& out);
  void define_here(Statement&& s, const CycleDefine& d, Body&& pieces, Body& out);
  /// The unit of lengths has changed since the definition: the cycle is said in the new one. True: refused.
  bool follow_units(Statement& s, const Block& b, const Facts& facts, Body& pieces, Body& out);
  void define_by_words(Statement&& s, const CycleDefine& d, Active&& a, bool old_may, Body&& pieces, Body& out);
  void put_words(Statement& s, CycleDefine&& native, const Active& a, bool old_may, Body& pieces);
  void define_by_call(Statement&& s, const CycleDefine& d, Active&& a, bool point_here, Body&& pieces, Body& out);

  bool triggers(const Block& b, const Facts& facts) const {
    if (active_->trigger == CycleTrigger::path_motion) {
      if (b.has_motion && b.motion.frame != FrameUse::normal) return false;
      if (b.has_motion && b.motion.moves()) return true;
      const auto kind = motion_in(b, facts);  // a bare G0 or G1, and F or S under one of them, run it as well
      if (kind && kind != MotionKind::rapid && kind != MotionKind::linear) return false;
      return disturbs_call(b);
    }
    if (!b.has_motion || !b.motion.moves() || b.motion.frame != FrameUse::normal) return false;
    const auto w = tool_axis(active_->source, b, facts);
    return !w || has_plane_word(b, *w) || turns_to_point(b, context_.source_machine);
  }

  /// A point of a modal call in another plane than that of its definition: defined again.
  void turn(const Block& b, const Facts& facts, const LineInfo& like, Body& pieces);
  /// A block while a cycle is active.
  void point(Statement&& s, Body&& pieces, Body& out);

  /// The routine that a plain call runs; nullopt: another call, or it is not in the program.
  [[nodiscard]] std::optional<std::size_t> callee_of(const CallRoutine& call) const;
  /// The points lie in the called routine, and the target's cycle needs to be defined or written out there: the call
  /// goes to a copy of it for this cycle. False: the call stays as it is.
  bool call_with_cycle(CallRoutine& call, const LineInfo& where, const Facts& facts);
  void name_copy(CycleCallees::Copy& copy);
  CycleCallees::Copy& write_copy(std::size_t callee);
  void check_words(const Statement& s);
  /// The cycle would be written once more, with words that mean something else by now. True: refused.
  [[nodiscard]] bool refuse_stale(Statement& s, Body& out);
  [[nodiscard]] bool refuse_stale_change(Statement& s, const CycleDefine& d, Body& out);
  /// The variables that the statement writes, a routine that it calls included.
  std::vector<VarRef> writes_of(const Statement& s, std::set<std::size_t>& called) const;
  void look_for_writes();
  void note_write(const VarRef& v);
  void note_stale(const VarRef& v) const;  ///< for who keeps the words in variables of their own
  void note_writes_of_loop(std::uint32_t first, std::uint32_t last);
  void come_back_to(const Statement& s);

  /// Absolute levels that the target would take for increments in this block.
  [[nodiscard]] bool levels_by_mode(const CyclePtr& native, const Block& b, const Facts& facts) const;
  /// A point on a target that defines the cycle in the block of its first point.
  void native_point(Statement&& s, Body&& pieces, Body& out);
  void run_once(Statement&& s, Body&& pieces, bool apart, Body& out);
  void plain(Statement&& s, Body&& pieces, Body& out);
  /// A new retract plane while the cycle is active is a new cycle. True: the target's own one has changed.
  bool follow_retract_plane(const Block& b, const Facts& facts);
  /// The tool leaves the height at which the cycle was defined, which only the run knows: a cycle of the target that
  /// begins anew would take the present one for it. True: the target's own one has changed.
  bool follow_height(const Block& b, const Facts& facts);
  /// The coordinates along the tool change while a cycle is active: its levels go along on some controls. True:
  /// refused.
  [[nodiscard]] bool refuse_other_levels(Statement& s, Body& out) const;
  /// Heights from before count in other coordinates behind it.
  [[nodiscard]] bool moves_coordinates(const Statement& s) const;
  void lose_height(const Statement& s);   ///< which moves the coordinates
  void leave_height(const Statement& s);  ///< one that a loop or a called routine carries out

  // --- written out ----------------------------------------------------------------------------------------------

  void write_out(Statement&& s, Body&& pieces, Body& out);
  void write_out_machining(Statement&& s, const NamedCycle& cycle, Body&& pieces, Body& out);
  void add_copies(Body& out);
  void own_labels(SimilarForm& form);
  /// What the target's tap does not do.
  void tell_tap(const Active& a, const LineInfo& where) const;
  /// Where the reference plane lies only the run knows.
  void tell_reference(const Active& a, const LineInfo& where) const;
  /// A tap as the target's, one a peck, each back to the reference plane, from which a rapid move goes on to the
  /// retract level; nullopt: the target has none. `differs`: what is not the same.
  std::optional<Explosion> tap_strokes(const HoleCycle& c, const Statement& s, const Block& b, std::string* differs);
  /// A tap at the middle of the work as the tapping form of the target's axial drilling cycle (lathes). `sense`: of the
  /// spindle there. nullopt: the target has none, or something is not known.
  std::optional<Explosion> axial_tap(const HoleCycle& c, const Statement& s, const Block& b,
                                     std::optional<SpindleState> sense);
  /// A pocket as the target's own cycle, by other passes. True: done.
  bool put_similar_pocket(const HoleCycle& hole, Statement& s, Body& pieces, std::optional<double> height,
                          bool last_resort, Body& out);
  void run_at_the_point(Block& b, const Facts& facts, Body& blocks) const;
  /// The words of the source above the moves that they become.
  void remark_words(const LineInfo& line, Body& out);
  /// The moves are those of an option that nobody has confirmed.
  void refuse_assumed(Statement&& s, const std::string& option, Body& out);
  void put_similar(Statement&& s, SimilarForm&& form, Body&& pieces, Body& out);
  void put_moves(Statement&& s, Body&& moves, Body&& pieces, Body& out);
  /// What follows the statement at hand may cut, or do whatever else, with the feed that a cycle leaves in force.
  [[nodiscard]] bool feed_is_used() const;
  /// Takes a feed away that nothing would use from the end of the moves.
  void drop_idle_feed(Body& moves) const;
  void no_moves(Statement&& s, const std::string& why, Body& out);
  Program& program_;
  const LegaliseContext& context_;
  const FactsOf& facts_;
  const FeedsBefore& feeds_;
  CycleCallees& callees_;
  StaleWords* stale_;  ///< may be null
  Editor editor_;
  LabelUses uses_;
  TurnCycles turning_;
  MillCycles milling_;
  std::vector<ProfileUse> uses_of_profiles_;
  std::map<std::pair<bool, std::string>, std::uint32_t> first_use_;  ///< label: the first statement that leads to it
  std::map<std::pair<bool, std::string>, Left> left_;  ///< label: what jumps made while a cycle is active take there
  std::map<std::pair<bool, std::string>, std::pair<bool, bool>> ends_;  ///< label: the target's is or may be in force
  std::map<std::pair<bool, std::string>, std::uint32_t> last_use_;      ///< label: the last statement that leads to it
  std::vector<std::pair<std::uint32_t, VarRef>> writes_;                ///< by the statements of this routine
  std::uint32_t last_id_ = 0;
  ToolHeight height_;
  SpindleSense sense_;
  FeedScale feed_scale_;
  bool by_call_ = false;
  std::set<std::pair<bool, std::string>> under_cycle_;  ///< labels before which the target has its own cycle in force
  bool surely_active_ = false, may_end_ = false;        ///< a copy for one cycle that does not touch it, or does
  bool written_out_ = false;
  bool lacking_ = false;                                   ///< the target lacks a cycle that later points run
  std::set<std::uint32_t> definitions_;                    ///< statements of this routine
  bool has_modal_calls_ = false, calls_anywhere_ = false;  ///< of cycles; in the program
  bool plane_words_ = false;                               ///< the program has G98 or G99
  bool enters_unsure_ = false;  ///< the callers do not agree on a cycle, and nothing here has begun or ended one yet
  std::optional<Span> falls_;   ///< the last line, where the routine ends without a return
  std::vector<Span> unsure_;    ///< points of a cycle by call that depend on the way
  std::optional<Active> active_;
  std::vector<Action> late_;   ///< of the block at hand, behind the hole
  std::vector<Action> then_;   ///< made by the pass: in a block of its own behind the hole
  bool tap_feed_ = false;      ///< the F in force on the target is that of a tap
  std::optional<Active> ran_;  ///< what the block at hand runs by its definition
  std::pair<const Statement*, const Statement*> rest_{nullptr, nullptr};  ///< behind the statement at hand
};

/// Puts the copies into the program.
void add_callees(Program& program, CycleCallees& callees);

}  // namespace cnctrans::ir::passes
