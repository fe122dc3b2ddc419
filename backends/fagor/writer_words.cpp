// Words of settings, technology and machine functions.
#include <algorithm>
#include <cmath>

#include "backends/fagor/capabilities.h"
#include "backends/fagor/tables.h"
#include "backends/fagor/writer.h"
#include "base/text.h"
#include "dialects/fagor/cycles.h"
#include "dialects/fagor/pockets.h"
#include "ir/edit/search.h"

namespace cnctrans::backends::fagor {
namespace {

using dialects::fagor::Use;

template <class T>
bool holds(const ir::Action& a) {
  return std::holds_alternative<T>(a.data);
}

bool sets(const ir::Action& a, ir::Setting s) {
  const auto* m = std::get_if<ir::ModalSet>(&a.data);
  return m != nullptr && m->setting == s;
}

const ir::FrameChange* frame_change(const ir::Action& a) {
  const auto* f = std::get_if<ir::FrameOp>(&a.data);
  return f != nullptr ? f->change.get() : nullptr;
}

}  // namespace

std::string_view Writer::g(Use use, int value) const {
  return g_word(lathe_, use, value);
}

std::string Writer::word(std::string_view address, const ir::Value& value, WordPos pos) {
  std::string text(address);
  if (value.literal()) return text + number_text(value);
  if (const auto* n = std::get_if<ir::Number>(&value.expr->node))
    return text + number_text(ir::Value(n->value, n->text));
  const std::string parameter = printer_.parameter(value.expr);
  if (parameter.empty()) {
    refuse("TRN-203", pos, "a word holds a number or one parameter here, no expression");
    return text;
  }
  if (const std::string problem = printer_.take_problem(); !problem.empty()) refuse("TRN-203", pos, problem);
  return text + parameter;
}

bool is_empty_line(const ir::Statement& s) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  return b != nullptr && b->empty() && s.line.span.known() && !s.line.joined && s.line.comments.empty() &&
         s.line.number.empty() && s.line.labels.empty() && s.line.skip_mask == 0;
}

// ---- decisions -----------------------------------------------------------------------------------------------------

/// The block in the words of the surface in force: C for the second coordinate, X a radius; the plane of the cylinder
/// has Z as its abscissa, so that every sense of turning is the other one.
ir::Block Writer::on_surface(const ir::Block& b, ir::Surface surface) const {
  ir::Block out = b;
  const bool cylinder = surface == ir::Surface::cylinder;
  const auto own_text = [this](std::string_view text) { return same_dialect() && !text.empty(); };
  for (ir::Action& a : out.actions) {
    auto* m = std::get_if<ir::ModalSet>(&a.data);
    if (m == nullptr) continue;
    if (cylinder && m->setting == ir::Setting::comp && m->value != 0 && !own_text(a.text)) m->value = 3 - m->value;
    if (cylinder && m->setting == ir::Setting::plane && m->value == code_value(ir::Plane::yz)) a.text = "G16 ZC";
  }
  ir::Motion& m = out.motion;
  const bool turned = cylinder && !own_text(m.code_text);
  if (turned && m.kind == ir::MotionKind::arc_cw) {
    m.kind = ir::MotionKind::arc_ccw;
  } else if (turned && m.kind == ir::MotionKind::arc_ccw) {
    m.kind = ir::MotionKind::arc_cw;
  }
  for (ir::CoordWord& w : m.coords) {
    if (w.axis == ir::axis::y) w.axis = ir::axis::c;
    if (w.axis == ir::axis::x && surface == ir::Surface::face) w.scale = ir::WordScale::modal;
  }
  for (ir::CenterWord& w : m.centers) {
    if (w.axis == ir::axis::y) w.axis = ir::axis::z;  // K is the letter of C as well
    const bool from_start = w.mode == ir::CenterMode::from_start;
    if (w.axis == ir::axis::x && surface == ir::Surface::face)
      w.scale = from_start ? ir::WordScale::radius : ir::WordScale::modal;
  }
  return out;
}

void Writer::block(const ir::Block& b) {
  if (is_empty_line(current())) return add(std::string(style().blank_line), Rank::head);
  auto surface = has_surfaces_ ? known<ir::Surface>(ir::Setting::surface) : std::optional(ir::Surface::none);
  for (const ir::Action& a : b.actions) {
    const auto* s = std::get_if<ir::SurfaceSet>(&a.data);
    if (s != nullptr && a.order != ir::Order::after) surface = s->surface;
  }
  if (!surface && b.has_motion && b.motion.moves())
    return refuse(no_word, b.motion.code_pos,
                  "whether this block counts on the face, the cylinder or neither is not known here");
  if (surface && *surface != ir::Surface::none) {
    surface_block_ = on_surface(b, *surface);
    return plain_block(surface_block_);
  }
  plain_block(b);
}

void Writer::plain_block(const ir::Block& b) {
  offset_before_ = after_offset_;
  if (!b.empty()) after_offset_ = false;
  // A cycle runs at the point of its block: its words follow the move.
  const bool cycle = b.has_motion && std::any_of(b.actions.begin(), b.actions.end(), holds<ir::CycleDefine>);
  if (b.repeat_given == 0 && !cycle) {
    block_ = &b;
    ProgramWriter::block(b);
  } else {
    ir::Block once = b;
    once.repeat_given = 0;
    for (ir::Action& a : once.actions) {
      if (holds<ir::CycleDefine>(a)) a.order = ir::Order::after;
    }
    block_ = &once;
    ProgramWriter::block(once);
    if (b.repeat_given != 0) add(word("N", b.repeat, {}), Rank::tail);
  }
  block_ = nullptr;
}

ir::Order Writer::target_order(const ir::Action& a) const {
  if (sets(a, ir::Setting::diameter)) return ir::Order::after;  // G151 G152 act on the blocks that follow (3.5)
  if (holds<ir::CycleDefine>(a) || holds<ir::Corner>(a) || holds<ir::TangentialEnd>(a)) return a.order;
  return ProgramWriter::target_order(a);
}

/// A tool that is only selected: a D beside it would wait for its M06 (9.3).
static bool waits_for_change(const ir::Block& b) {
  const auto* t = ir::action_in<ir::ToolSelect>(b);
  return t != nullptr && !t->changes && ir::action_in<ir::ToolChange>(b) == nullptr;
}

bool Writer::own_line(const ir::Action& a, const ir::Block& b) {
  const bool others = b.actions.size() > 1 || b.has_motion;
  if (others && stands_alone(a) && !(same_dialect() && !a.text.empty())) return true;
  if (holds<ir::ToolOffset>(a) && has_tool_changes_ && waits_for_change(b) && waiting_.count(&current()) == 0)
    return true;
  return ProgramWriter::own_line(a, b);
}

/// Words that belong to the code are said by the hooks; the other words stand by themselves.
bool Writer::spelling_is_whole_word(const ir::Action& a) const {
  if (holds<ir::SpindleOrient>(a) || holds<ir::SpindleLimit>(a) || holds<ir::Corner>(a) || holds<ir::TangentialEnd>(a))
    return false;
  return ProgramWriter::spelling_is_whole_word(a);
}

/// What another word of the block says already: a work offset ends a preset, a plane resets the pole (8.3, 7), going
/// home ends the compensations (8.1).
bool Writer::implied(const ir::Action& a) {
  if (a.pos.column != 0 || !a.text.empty() || block_ == nullptr) return false;  // the source wrote it
  bool offset = offset_before_;
  bool plane = false;
  for (const ir::Action& other : block_->actions) {
    if (&other == &a) break;
    offset = offset || holds<ir::WorkOffset>(other);
    plane = plane || sets(other, ir::Setting::plane);
  }
  if (const ir::FrameChange* f = frame_change(a); f != nullptr && f->combine == ir::FrameCombine::clear && offset) {
    return f->slot == ir::FrameSlot::preset || (same_dialect() && f->slot == ir::FrameSlot::shift);
  }
  if (holds<ir::CycleCancel>(a) && same_dialect()) {  // the plane and the search for home end a cycle by themselves
    const bool home_here = block_->has_motion && block_->motion.kind == ir::MotionKind::reference_point;
    return home_here || std::any_of(block_->actions.begin(), block_->actions.end(),
                                    [](const ir::Action& other) { return sets(other, ir::Setting::plane); });
  }
  const auto machining = [](const ir::Action& other) {
    const auto* d = std::get_if<ir::CycleDefine>(&other.data);
    const auto* named = d != nullptr && d->cycle ? std::get_if<ir::NamedCycle>(&d->cycle->node) : nullptr;
    return named != nullptr && (dialects::fagor::find_cycle(named->name) != nullptr ||
                                dialects::fagor::find_pocket(named->name) != nullptr);
  };
  if (std::any_of(block_->actions.begin(), block_->actions.end(), machining))
    return sets(a, ir::Setting::comp) || sets(a, ir::Setting::distance);  // ch. 9: how the cycle leaves
  if (const auto* s = std::get_if<ir::SurfaceSet>(&a.data); s != nullptr && s->surface == ir::Surface::none)
    return same_dialect();  // by the plane or the spindle function
  const bool home =
      block_->has_motion &&
      (block_->motion.kind == ir::MotionKind::reference_point || block_->motion.kind == ir::MotionKind::probe_toward ||
       block_->motion.kind == ir::MotionKind::probe_away || block_->motion.kind == ir::MotionKind::to_stop);
  return home && (sets(a, ir::Setting::comp) || sets(a, ir::Setting::length_comp));
}

void Writer::action(const ir::Action& a) {
  if (implied(a)) {
    if (const auto* s = std::get_if<ir::SurfaceSet>(&a.data))
      note_setting(ir::Setting::surface, static_cast<std::uint8_t>(s->surface));
    if (const auto* m = std::get_if<ir::ModalSet>(&a.data)) note_setting(m->setting, m->value);
    return;
  }
  if (const ir::FrameChange* f = frame_change(a);
      f != nullptr && f->slot == ir::FrameSlot::preset && line().has_column(a.pos.column)) {
    return frame_words(*f, a.pos);  // G92 S X: the code stands there already
  }
  ProgramWriter::action(a);
  if (holds<ir::WorkOffset>(a)) after_offset_ = true;
}

// ---- settings ------------------------------------------------------------------------------------------------------

void Writer::modal_set(const ir::Action& a, const ir::ModalSet& m) {
  if (m.setting == ir::Setting::plane && a.text == "G16 ZC") return add("G16 ZC", Rank::setting, a.pos);
  if (m.setting == ir::Setting::plane) plane_by_text_ = static_cast<ir::Plane>(m.value);
  const bool neutral =
      (m.setting == ir::Setting::diameter && !lathe_ && m.value == 0) ||
      (m.setting == ir::Setting::spindle_mode && !lathe_ && m.value == code_value(ir::SpindleMode::rpm)) ||
      (m.setting == ir::Setting::length_comp && lathe_ && m.value == code_value(ir::OnOff::on)) ||
      (m.setting == ir::Setting::feed_point && lathe_ && m.value == code_value(ir::FeedPoint::centre)) ||
      (m.setting == ir::Setting::retract_plane && lathe_) ||
      (m.setting == ir::Setting::plane && m.value == code_value(ir::Plane::xy) && !same_dialect() && has_surfaces_ &&
       setting(ir::Setting::surface) == code_value(ir::Surface::face));  // G16 XC has said it
  if (neutral) return;                                                   // always so on this model
  if (m.setting == ir::Setting::feed_override) {
    diagnostics().note("TRN-211", span_of(a.pos), "the switch of the feed override has no counterpart and is left out");
    return;
  }
  if (m.setting == ir::Setting::units && !m.feed_too) {
    return refuse(no_word, a.pos, "a unit that leaves the feed alone has no counterpart here");
  }
  if (m.setting == ir::Setting::retract_plane && block_ != nullptr) {  // after the code of its cycle (25.2)
    for (const ir::Action& other : block_->actions) {
      if (!holds<ir::CycleDefine>(other)) continue;
      add(std::string(modal_code(style(), m.setting, m.value)), Rank::motion_code, a.pos);
      return;
    }
  }
  ProgramWriter::modal_set(a, m);
}

/// G15 R unrolls the cylinder, G16 XC chooses the face; another plane and M3, M4, M5 end both (6.15).
void Writer::surface_set(const ir::Action& a, const ir::SurfaceSet& s) {
  if (!lathe_ || s.surface == ir::Surface::none) return ProgramWriter::surface_set(a, s);
  if (s.surface == ir::Surface::face) {
    add(std::string(g(Use::c_axis)), Rank::setting, a.pos);
    further_line(a.pos);
    return add("G16 XC", Rank::setting, a.pos);
  }
  add(std::string(g(Use::c_axis)) + ' ' + word("R", ir::scale(s.diameter, 0.5), a.pos), Rank::setting, a.pos);
}

/// F0 is the greatest feed of the machine, on this control.
void Writer::set_feed(const ir::Action& a, const ir::SetFeed& f) {
  if (f.value.is(0) && !f.zero_is_maximum) {
    return refuse(no_word, a.pos, "a feed of zero can't be written: F0 is the greatest feed of the machine there");
  }
  add(word("F", f.value, a.pos), Rank::feed, a.pos);
}

// ---- spindle and tool ----------------------------------------------------------------------------------------------

/// G28 selects the second spindle, G29 the main one; alone in their blocks (5.4).
void Writer::master_spindle(const ir::Action& a, const ir::MasterSpindle& m) {
  if (!lathe_ || m.number < 1 || m.number > 2) return ProgramWriter::master_spindle(a, m);
  words_of_spindle_ = m.number;
  next_line();
  add(m.number == 2 ? "G28" : "G29", Rank::setting, a.pos);
  next_line();
}

void Writer::spindle_orient(const ir::Action& a, const ir::SpindleOrient& s) {
  if (s.number != words_of_spindle_ && !same_dialect())
    return refuse(no_word, a.pos, "a second spindle has no counterpart here");
  const bool marker = s.angle.is(0) && s.angle.text.empty();
  if (!marker) add(word("S", s.angle, a.pos), Rank::spindle);
  add(same_dialect() && !a.text.empty() ? std::string(a.text) : m_word(19), Rank::machine, a.pos);
}

void Writer::spindle_limit(const ir::Action& a, const ir::SpindleLimit& s) {
  if ((s.number != words_of_spindle_ && !same_dialect()) || s.lower)
    return refuse(no_word, a.pos, "this limit of the spindle speed has no counterpart here");
  add(std::string(g(Use::preset)), Rank::setting, a.pos);
  add(word("S", s.value, a.pos), Rank::spindle);
}

void Writer::spindle_gear(const ir::Action& a, const ir::SpindleGear& s) {
  if (s.automatic) {
    diagnostics().note("TRN-211", span_of(a.pos), "the automatic choice of the gear has no code there and is left out");
    return;
  }
  if (s.gear < 1 || s.gear > 4) return refuse(no_word, a.pos, "the control has the gears 1 to 4 (M41 to M44)");
  ProgramWriter::spindle_gear(a, s);
}

/// T changes at once on a turret (9.3); a T that does so elsewhere takes M6 with it.
void Writer::tool_select(const ir::Action& a, const ir::ToolSelect& t) {
  if (!t.name.empty()) return refuse(no_word, a.pos, "a tool called by its name has no counterpart here");
  add(word("T", t.number, a.pos), Rank::tool, a.pos);
  const bool at_once = profile().policies.tool_change == machine::ToolChange::on_select;
  if (same_dialect() || t.changes == at_once) return;
  if (t.changes) return tool_change(a);
  refuse(no_word, a.pos, "a tool that is selected before its change: T changes at once on the target machine");
}

// ---- dwell ---------------------------------------------------------------------------------------------------------

void Writer::dwell(const ir::Action& a, const ir::Dwell& d) {
  if (d.revolutions) return refuse(no_word, a.pos, "a dwell in revolutions of the spindle has no counterpart here");
  const std::string code = same_dialect() && !a.text.empty() ? std::string(a.text) : std::string(g(Use::dwell));
  ir::Value hundredths = d.value;
  if (d.scale != 0.01) {
    if (!d.value.literal())
      return refuse("TRN-203", a.pos, "a dwell is a number or a parameter in hundredths of a second here");
    hundredths = ir::Value(d.value.number * d.scale * 100);
  }
  if (hundredths.literal()) {
    const double whole = std::round(hundredths.number);
    if (whole <= 0) return;  // G04 K0 is no dwell but a stop of the preparation
    if (std::fabs(whole - hundredths.number) > 1e-9) {
      diagnostics().warning("TRN-210", span_of(a.pos), "the dwell is rounded to hundredths of a second");
      hundredths = ir::Value(whole);
    }
  }
  add(code, Rank::setting, a.pos);
  add(word("K", hundredths, a.pos), Rank::center);
}

}  // namespace cnctrans::backends::fagor
