#include "lsp/describe.h"

#include "base/text.h"
#include "ir/text/text.h"
#include "lsp/names.h"
#include "lsp/words/words_common.h"

namespace cnctrans::lsp {

namespace {

std::string number_text(std::uint8_t n) {
  return n == 1 ? std::string() : " " + std::to_string(n);
}

/// What one action of a block does; empty: nothing to say.
class ActionText {
 public:
  ActionText(const DescribeContext& context, std::vector<std::string>& out) : c_(context), out_(out) {}

  void operator()(const ir::ModalSet& a) { say(setting_title(a.setting, a.value)); }
  void operator()(const ir::SetFeed& a) { say("feed " + value(a.value)); }
  void operator()(const ir::SetSpindle& a) { say("speed of spindle" + number_text(a.number) + ": " + value(a.value)); }
  void operator()(const ir::SpindleRun& a) {
    const std::string spindle = "spindle" + number_text(a.number);
    if (a.state == ir::SpindleState::off) return say(spindle + " stops");
    say(spindle + (a.state == ir::SpindleState::cw ? " clockwise" : " counter-clockwise"));
  }
  void operator()(const ir::SpindleOrient& a) {
    say("spindle" + number_text(a.number) + " to " + value(a.angle) + "°");
  }
  void operator()(const ir::SpindleLimit& a) {
    say((a.lower ? "lower" : "upper") + std::string(" limit of the speed: ") + value(a.value));
  }
  void operator()(const ir::SpindleGear& a) { say("gear " + std::to_string(a.gear)); }
  void operator()(const ir::MasterSpindle& a) {
    say("spindle " + std::to_string(a.number) + " is the one that counts");
  }
  void operator()(const ir::ToolSelect& a) {
    say("tool " + (a.name.empty() ? value(a.number) : std::string(a.name)) +
        (a.changes ? ", changed at once" : " made ready"));
  }
  void operator()(const ir::ToolChange&) { say("tool change"); }
  void operator()(const ir::ToolOffset& a) { say("tool offset " + value(a.number)); }
  void operator()(const ir::WorkOffset& a) {
    say(a.off ? "no zero offset" : "zero offset, row " + value(a.index) + " of the table");
  }
  void operator()(const ir::FrameOp& a) {
    std::string text = "frame: ";
    switch (a.change->kind) {
      case ir::FrameKind::translate: text += "shift"; break;
      case ir::FrameKind::rotate: text += "rotation"; break;
      case ir::FrameKind::scale: text += "scale"; break;
      case ir::FrameKind::mirror: text += "mirror"; break;
    }
    if (a.change->combine == ir::FrameCombine::clear) text += " off";
    for (const auto& w : a.change->words) text += " " + axis(w.axis) + value(w.value);
    if (a.change->has_angle) text += " " + value(a.change->angle) + "°";
    say(text);
  }
  void operator()(const ir::PoleSet&) { say("pole of polar coordinates"); }
  void operator()(const ir::Dwell& a) {
    say("dwell " + (a.value.literal() ? shortest(a.value.number * a.scale) : value(a.value)) +
        (a.revolutions ? " revolutions" : " s"));
  }
  void operator()(const ir::ExactStopBlock&) { say("exact stop at the end of the block"); }
  void operator()(const ir::Coolant& a) { say(a.state == ir::CoolantState::off ? "coolant off" : "coolant on"); }
  void operator()(const ir::MachineFunction& a) {
    say((a.auxiliary ? "H" : "M") + std::to_string(a.code) + ": a function of the machine");
  }
  void operator()(const ir::Stop& a) { say(a.optional ? "optional stop" : "stop"); }
  void operator()(const ir::CycleDefine& a) {
    for (auto& line : describe_cycle(*a.cycle, c_)) say(std::move(line));
    if (a.modal) say(a.here ? "runs here, and at every point from here on" : "runs at every point from here on");
  }
  void operator()(const ir::CycleCancel&) { say("end of the cycle in force"); }
  void operator()(const ir::Corner& a) {
    say((a.kind == ir::CornerKind::round ? "corner rounded by " : "corner chamfered by ") + value(a.value));
  }
  void operator()(const ir::TangentialEnd& a) {
    say((a.end == ir::TangentEnd::entry ? "tangential entry, radius " : "tangential exit, radius ") + value(a.radius));
  }
  void operator()(const ir::PreparationStop&) { say("look-ahead waits"); }
  void operator()(const ir::OpaqueWord& a) { say(std::string(a.word) + ": kept as text"); }
  void operator()(const ir::SplineAxes&) { say("axes of the splines"); }
  void operator()(const ir::SurfaceSet& a) { say("coordinates on: " + spoken(ir::name(a.surface))); }

  void motion(const ir::Motion& m) {
    const ir::MotionKind kind =
        m.kind != ir::MotionKind::modal ? m.kind : c_.facts.motion.value_or(ir::MotionKind::modal);
    std::string text = kind == ir::MotionKind::modal ? "move in the mode in force" : motion_title(kind);
    if (!m.coords.empty()) text += " to";
    for (const auto& w : m.coords) {
      text += " " + axis(w.axis) + value(w.value);
      if (w.mode == ir::WordMode::incremental) text += " (increment)";
    }
    for (const auto& w : m.centers) text += ", centre " + axis(w.axis) + value(w.value);
    if (m.radius_given) text += ", radius " + value(m.radius);
    if (m.frame != ir::FrameUse::normal) text += ", in machine coordinates";
    say(text);
  }

 private:
  void say(std::string text) { out_.push_back(std::move(text)); }
  [[nodiscard]] std::string value(const ir::Value& v) const { return value_text(v, c_); }
  [[nodiscard]] std::string axis(ir::AxisId a) const { return std::string(c_.program.axis_name(a)); }

  const DescribeContext& c_;
  std::vector<std::string>& out_;
};

}  // namespace

std::string value_text(const ir::Value& v, const DescribeContext& context) {
  if (v.literal()) return shortest(v.number);
  const WordPos at = v.expr->pos;
  if (at.column != 0 && at.column - 1 + at.length <= context.line.size())
    return std::string(context.line.substr(at.column - 1, at.length));
  return ir::to_text(v.expr, context.program);
}

std::vector<std::string> describe(const ir::Statement& s, const DescribeContext& context) {
  std::vector<std::string> out;
  if (const auto* b = std::get_if<ir::Block>(&s.node)) {
    ActionText text(context, out);
    for (const auto& a : b->actions) {
      if (a.order != ir::Order::after) std::visit(text, static_cast<const ir::ActionData::variant&>(a.data));
    }
    if (b->has_motion) text.motion(b->motion);
    for (const auto& a : b->actions) {
      if (a.order == ir::Order::after) std::visit(text, static_cast<const ir::ActionData::variant&>(a.data));
    }
    if (b->repeat_given != 0) out.push_back("carried out " + value_text(b->repeat, context) + " times");
  } else if (const auto* j = std::get_if<ir::Jump>(&s.node)) {
    out.push_back(std::string(j->condition ? "jump on a condition" : "jump") +
                  (j->target.computed ? ", target computed" : " to " + j->target.text));
  } else if (const auto* c = std::get_if<ir::CallRoutine>(&s.node)) {
    std::string text = "call of " + (c->computed ? std::string("a computed subprogram") : shown_name(c->routine));
    for (const auto& a : c->arguments) {
      if (a.value)
        text += (&a == c->arguments.data() ? ": " : ", ") + (a.name.empty() ? "" : a.name + "=") +
                value_text(ir::Value(a.value), context);
    }
    out.push_back(text);
  } else if (const auto* r = std::get_if<ir::Repeat>(&s.node)) {
    out.push_back("the blocks from " + r->first.text + (r->last.text.empty() ? "" : " to " + r->last.text) + " again");
  } else if (const auto* m = std::get_if<ir::ModalCall>(&s.node)) {
    out.push_back(m->off ? "end of the modal call" : "modal call: behind every later motion");
    if (m->cycle) {
      for (auto& line : describe_cycle(*m->cycle, context)) out.push_back(std::move(line));
    }
  } else if (std::holds_alternative<ir::Assign>(s.node)) {
    out.emplace_back("values of variables");
  } else if (std::holds_alternative<ir::If>(s.node)) {
    out.emplace_back("what follows is done where the condition holds");
  } else if (std::holds_alternative<ir::End>(s.node)) {
    out.emplace_back("end of the program");
  } else if (std::holds_alternative<ir::Return>(s.node)) {
    out.emplace_back("back to the caller");
  } else if (std::holds_alternative<ir::Message>(s.node)) {
    out.emplace_back("message to the operator");
  } else if (const auto* o = std::get_if<ir::Opaque>(&s.node)) {
    out.push_back(o->harmless ? "kept as text; it moves nothing" : "kept as text: a run stops here");
  }
  return out;
}

std::string describe_facts(const DescribeContext& c) {
  if (!c.facts.reachable) return "nothing is known here: no way leads to this block";
  std::string out = c.facts.motion ? motion_title(*c.facts.motion) : "motion not known";
  for (const auto s :
       {ir::Setting::plane, ir::Setting::distance, ir::Setting::units, ir::Setting::feed_mode, ir::Setting::comp}) {
    const auto& v = c.facts.settings[static_cast<std::size_t>(s)];
    out += ", " + (v ? (s == ir::Setting::comp ? "compensation " : "") + spoken(ir::setting_value_name(s, *v))
                     : (s == ir::Setting::comp ? "compensation" : spoken(ir::name(s))) + " not known");
  }
  if (c.facts.work_offset) out += ", zero offset " + std::to_string(*c.facts.work_offset);
  if (c.facts.feed) out += ", feed " + shortest(*c.facts.feed);
  if (c.facts.spindle) out += ", speed " + shortest(*c.facts.spindle);
  std::string at;
  for (std::size_t i = 0; i < c.facts.position.size(); ++i) {
    const auto axis = static_cast<ir::AxisId>(i);
    if (!c.facts.position[i]) continue;
    at += " " + std::string(c.program.axis_name(axis)) +
          rounded(*c.facts.position[i] * (c.diameter && axis == ir::axis::x ? 2 : 1), 4);
  }
  if (!at.empty()) out += "; tool at" + at + (c.diameter ? " (X as diameter)" : "");
  if (c.facts.cycle_active && c.facts.cycle_active_known) out += "; a cycle is in force";
  return out;
}

}  // namespace cnctrans::lsp
