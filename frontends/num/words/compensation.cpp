#include "frontends/num/words/compensation.h"

#include <algorithm>
#include <optional>

#include "base/text.h"
#include "dialects/num/variables.h"
#include "ir/analysis/dataflow.h"

namespace cnctrans::frontends::num {

namespace {

namespace facts = dialects::num;
constexpr std::string_view code = "NUM-051", straight_code = "NUM-055";

bool is_arc(std::optional<ir::MotionKind> k) {
  return k == ir::MotionKind::arc_cw || k == ir::MotionKind::arc_ccw || k == ir::MotionKind::arc_through_point;
}

/// A block that inherits G02 or G03 and gives no arc: neither centre nor radius.
bool only_inherits(const ir::Motion& m) {
  return m.kind == ir::MotionKind::modal && m.centers.empty() && !m.radius_given && m.extra == nullptr;
}

std::optional<std::uint8_t> set_in(const ir::Block& b, ir::Setting s) {
  std::optional<std::uint8_t> value;
  for (const auto& a : b.actions) {
    if (const auto* m = std::get_if<ir::ModalSet>(&a.data); m != nullptr && m->setting == s) value = m->value;
  }
  return value;
}

/// ED.
bool turns_frame(const ir::Block& b) {
  return std::any_of(b.actions.begin(), b.actions.end(), [](const ir::Action& a) {
    const auto* f = std::get_if<ir::FrameOp>(&a.data);
    return f != nullptr && f->change && f->change->slot == ir::FrameSlot::rotation;
  });
}

bool worth_a_look(const ir::Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&found](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr) return;
      const auto comp = set_in(*b, ir::Setting::comp), feed = set_in(*b, ir::Setting::feed_mode);
      found = found || (comp && *comp != 0) || feed == static_cast<std::uint8_t>(ir::FeedMode::inverse_time);
    });
  }
  return found;
}

class Judge {
 public:
  Judge(const ir::FactTable& table, Diagnostics& diagnostics) : table_(table), diagnostics_(diagnostics) {}

  void routine() { begins_ = false; }
  void statement(ir::Statement& s) {
    const ir::Facts& before = table_.before(s.id);
    if (!before.reachable) return;
    const auto comp = before.settings[static_cast<std::size_t>(ir::Setting::comp)];
    const bool on = comp && *comp != 0;
    if (auto* b = std::get_if<ir::Block>(&s.node)) {
      block(s, *b, before, on);
    } else if (const auto* a = std::get_if<ir::Assign>(&s.node); a != nullptr && on) {
      for (const auto& item : a->items) late_variable(s, item);
    }
  }

 private:
  void say(const ir::Statement& s, std::string text, std::string hint) const {
    diagnostics_.error(code, s.line.span, std::move(text), std::move(hint));
  }

  void block(const ir::Statement& s, ir::Block& b, const ir::Facts& before, bool on) {
    const auto own = set_in(b, ir::Setting::comp);
    const bool moves = b.has_motion && b.motion.moves();
    const bool arc = moves && is_arc(b.motion.kind == ir::MotionKind::modal ? before.motion : b.motion.kind);
    if (own) begins_ = (*own != 0) != on;
    if (arc && begins_ && own && *own == 0 && only_inherits(b.motion))
      ends_straight(s, b.motion);
    else if (arc && begins_)
      say(s, "radius compensation begins or ends with an arc", "begin and end it with a straight move (G00, G01)");
    if (moves) begins_ = false;
    const bool stays = on && (!own || *own != 0);
    const auto plane = set_in(b, ir::Setting::plane);
    if (stays && plane && *plane != before.settings[static_cast<std::size_t>(ir::Setting::plane)])
      say(s, "another plane while radius compensation is on", "write G40 before it");
    const bool stops = std::any_of(b.actions.begin(), b.actions.end(),
                                   [](const ir::Action& a) { return std::holds_alternative<ir::Stop>(a.data); });
    if ((own ? *own != 0 : on) && stops) say(s, "M00 or M01 while radius compensation is on", "write G40 before it");
    if (stays && moves && b.motion.frame == ir::FrameUse::machine)
      say(s, "G52 while radius compensation is on", "write G40 before it");
    if (stays && turns_tool(b)) say(s, "G16 while radius compensation is on", "write G40 before it");
    if (stays && turns_frame(b))
      diagnostics_.warning("NUM-058", s.line.span,
                           "ED turns the coordinates while radius compensation is on; it belongs before G41 or G42",
                           "write G40 before it");
    auto mode = before.settings[static_cast<std::size_t>(ir::Setting::feed_mode)];
    if (const auto here = set_in(b, ir::Setting::feed_mode)) mode = here;
    if (arc && mode == static_cast<std::uint8_t>(ir::FeedMode::inverse_time))
      say(s, "an arc under G93", "write G94 and the feed per minute");
  }

  /// G40 with coordinates alone behind arcs: the last move of compensation is a straight one [9.3].
  void ends_straight(const ir::Statement& s, ir::Motion& m) const {
    diagnostics_.warning(straight_code, s.line.span,
                         "G40 ends radius compensation with a straight move, though G02 or G03 is in force",
                         "write G01 in this block");
    m.kind = ir::MotionKind::linear;
    m.keeps_modal = false;
  }

  void late_variable(const ir::Statement& s, const ir::Assign::Item& item) const {
    if (item.to_system || item.target.space != facts::space_l) return;
    const auto n = ir::constant_value(item.target.index);
    if (n && *n >= 100 && *n <= 199)
      say(s, "L100 to L199 can't be written while radius compensation is on", "use L0 to L19, or write G40 before it");
  }

  const ir::FactTable& table_;
  Diagnostics& diagnostics_;
  bool begins_ = false;  ///< switched on or off since the last move of the text
};

}  // namespace

bool turns_tool(const ir::Block& b) {
  return std::any_of(b.actions.begin(), b.actions.end(), [](const ir::Action& a) {
    const auto* w = std::get_if<ir::OpaqueWord>(&a.data);
    return w != nullptr && iequals_ascii(w->word.substr(0, 3), "G16");
  });
}

bool CompensationWatch::suspects(const ir::Block& b) {
  if (b.has_motion && b.motion.kind != ir::MotionKind::modal) motion_ = b.motion.kind;
  if (const auto mode = set_in(b, ir::Setting::feed_mode))
    inverse_time_ = *mode == static_cast<std::uint8_t>(ir::FeedMode::inverse_time);
  const bool was_on = on_;
  if (const auto own = set_in(b, ir::Setting::comp)) {
    begins_ = begins_ || (*own != 0) != on_;
    on_ = *own != 0;
  }
  const bool moves = b.has_motion && b.motion.moves();
  const bool arc = moves && is_arc(motion_);
  const bool stops = std::any_of(b.actions.begin(), b.actions.end(),
                                 [](const ir::Action& a) { return std::holds_alternative<ir::Stop>(a.data); });
  const bool under = (was_on || on_) && (stops || turns_frame(b) || turns_tool(b) || set_in(b, ir::Setting::plane) ||
                                         (moves && b.motion.frame == ir::FrameUse::machine));
  const bool suspicious = under || (arc && (begins_ || inverse_time_));
  if (moves) begins_ = false;
  return suspicious;
}

void judge_compensation(ir::Program& program, const ir::ModalState& power_on, Diagnostics& diagnostics) {
  if (!worth_a_look(program)) return;
  ir::number_statements(program);
  const ir::FactTable table = ir::analyse(program, power_on);
  Judge judge(table, diagnostics);
  for (auto& r : program.routines) {
    judge.routine();
    ir::for_each_statement(r.body, [&judge](ir::Statement& s) { judge.statement(s); });
  }
}

}  // namespace cnctrans::frontends::num
