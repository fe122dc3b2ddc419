// Word blocks: actions and motion (reference-language 14, 15).
#include <algorithm>
#include <cmath>

#include "backends/sinumerik/cycles.h"
#include "backends/sinumerik/tables.h"
#include "backends/sinumerik/writer.h"

namespace cnctrans::backends::sinumerik {
namespace {

template <class T>
bool has(const ir::Block& b) {
  for (const ir::Action& a : b.actions) {
    if (std::holds_alternative<T>(a.data)) return true;
  }
  return false;
}

bool is_group(const ir::Action& a) {
  const auto* m = std::get_if<ir::ModalSet>(&a.data);
  return m != nullptr && (m->setting == Setting::feed_mode || m->setting == Setting::spindle_mode);
}

}  // namespace

// ---- blocks --------------------------------------------------------------------------------------------------------

void Writer::block(const ir::Block& b) {
  block_has_offset_ = has<ir::ToolOffset>(b) || has<ir::ToolSelect>(b);
  feed_and_spindle_mode(b);
  offset_again(b);
  ProgramWriter::block(b);
}

/// Feed mode and spindle mode are one group here: the code for both after this block.
void Writer::feed_and_spindle_mode(const ir::Block& b) {
  group_code_.clear();
  group_written_ = false;
  std::optional<std::uint8_t> feed, spindle;
  bool named = false;
  for (const ir::Action& a : b.actions) {
    if (!is_group(a) || (same_dialect() && !a.text.empty())) continue;
    named = true;
    const auto& m = std::get<ir::ModalSet>(a.data);
    (m.setting == Setting::feed_mode ? feed : spindle) = m.value;
  }
  if (!named || same_dialect()) return;
  const bool sets_spindle = spindle.has_value(), names_feed = feed.has_value();
  const auto feed_before = setting(Setting::feed_mode);
  const auto spindle_before = uses_css_ ? setting(Setting::spindle_mode) : code_value(ir::SpindleMode::rpm);
  if (!feed) feed = feed_before;
  if (!feed && !needs_feed_mode(b)) feed = code_value(ir::FeedMode::per_rev);
  if (!spindle) spindle = spindle_before;
  if (!feed || !spindle) {
    return refuse("TRN-217", {}, "feed mode and spindle mode are one group here, and the one in force is not known",
                  "write feed mode and spindle mode in this block");
  }
  const auto feed_mode = static_cast<ir::FeedMode>(*feed);
  const auto spindle_mode = static_cast<ir::SpindleMode>(*spindle);
  group_code_ = feed_code(feed_mode, spindle_mode);
  const bool leaves_css = sets_spindle && spindle_mode == ir::SpindleMode::rpm && uses_css_ &&
                          spindle_before != code_value(ir::SpindleMode::rpm);
  if (leaves_css && feed_mode == ir::FeedMode::per_rev) group_code_ = "G97";
  if (leaves_css && feed_mode == ir::FeedMode::per_minute) group_code_ = "G971";
  // Speed in rpm that holds already: the programmer's G97 stays one; with a feed per minute it would be G971.
  const bool again = sets_spindle && !leaves_css && spindle_mode == ir::SpindleMode::rpm && !names_feed;
  if (again && feed_mode == ir::FeedMode::per_rev) group_code_ = "G97";
  if (again && feed_mode != ir::FeedMode::per_rev) group_written_ = true;
  if (group_code_.empty())
    refuse("TRN-202", {}, "inverse-time feed with constant cutting speed has no counterpart here");
}

/// The feed mode counts for this block, or for what is behind it before the program says one.
bool Writer::needs_feed_mode(const ir::Block& b) {
  const bool feeds = std::any_of(b.actions.begin(), b.actions.end(), [](const ir::Action& a) {
    return std::holds_alternative<ir::SetFeed>(a.data) || std::holds_alternative<ir::CycleDefine>(a.data);
  });
  if (feeds || (b.has_motion && b.motion.kind != ir::MotionKind::rapid)) return true;
  if (!calls_) calls_.emplace(program());
  if (!needs_) needs_.emplace(program(), *calls_);
  using ir::passes::ModalGroup;
  return needs_->behind(routine_index(), current(), {ModalGroup::Kind::setting, Setting::feed_mode});
}

/// After a move in machine coordinates without tool length (SUPA D0) the offset is selected again, in the first block
/// that needs it.
void Writer::offset_again(const ir::Block& b) {
  if (without_offset_ == nullptr) return;
  if (b.has_motion && b.motion.frame == ir::FrameUse::machine) return;
  if (!b.has_motion && !has<ir::CycleDefine>(b) && !block_has_offset_) return;
  const std::string again = block_has_offset_ ? std::string() : offset_word(current().line.span);
  without_offset_ = nullptr;
  if (!again.empty()) add(again, Rank::offset);
}

/// The offset comes back before the program can go on elsewhere, and before a place that is reached from elsewhere.
void Writer::before_statement(const ir::Statement& next) {
  if (without_offset_ == nullptr) return;
  const ir::LineInfo& line = next.line;
  const bool entered =
      !line.labels.empty() || (!line.number.empty() && labels().is_target(routine_index(), line.number));
  const auto* text = std::get_if<ir::Opaque>(&next.node);
  const bool stays = std::holds_alternative<ir::Block>(next.node) || std::holds_alternative<ir::Assign>(next.node) ||
                     std::holds_alternative<ir::Message>(next.node) || std::holds_alternative<ir::Label>(next.node) ||
                     std::holds_alternative<ir::Declare>(next.node) || std::holds_alternative<ir::End>(next.node) ||
                     (text != nullptr && text->harmless);
  if (entered || !stays || changes_branch(next)) offset_line(line.span);
}

void Writer::offset_line(const Span& span) {
  if (without_offset_ == nullptr) return;
  const std::string again = offset_word(span);
  without_offset_ = nullptr;
  if (!again.empty()) raw_line_in_branch(again, span);
}

/// The word of the offset in force before the move in machine coordinates. Empty: none was in force, or refused.
std::string Writer::offset_word(const Span& where) {
  if (!offsets_) {
    offset_domain_.emplace(program());
    offsets_.emplace(program(), *offset_domain_);
  }
  const OffsetsInForce* found = offsets_->before(*without_offset_);
  if (found == nullptr) return {};  // nothing comes here
  const OffsetsInForce& in_force = *found;
  if (in_force.words.empty() && !in_force.by_tool) {  // D0 stays
    if (!std::exchange(told_without_offset_, true))
      diagnostics().warning("TRN-218", where,
                            "behind the move in machine coordinates (D0) the target goes on without tool offset, the "
                            "source with the one that its machine has at the start: the program selects none before "
                            "(told once)",
                            "select the offset in the source before such a move");
    return {};
  }
  const char* select = "select the offset in the source after such a move";
  const std::size_t ways = in_force.words.size() + (!in_force.open && in_force.at_start ? 1 : 0) +
                           (!in_force.open && in_force.by_tool ? 1 : 0);
  if (ways > 1) {
    refuse("TRN-218", {}, "the tool offset in force before the move in machine coordinates is not known here", select);
    return {};
  }
  if (in_force.certain() && in_force.words[0].is(0)) return {};
  // With a tool the control selects D1; the source's perhaps does not.
  const std::string again = in_force.words.empty() ? "D1" : word("D", in_force.words[0], {});
  if (!in_force.certain())
    diagnostics().warning("TRN-218", where,
                          "the tool offset in force before the move in machine coordinates is not known for sure; " +
                              again + " is selected again here",
                          select);
  return again;
}

bool Writer::own_line(const ir::Action& a, const ir::Block& b) {
  if (same_dialect() && a.pos.column != 0) {  // one word of the source that does several things is written once
    for (const ir::Action& before : b.actions) {
      if (&before == &a) break;
      if (before.pos.column == a.pos.column) return false;
    }
  }
  const bool alone = std::holds_alternative<ir::FrameOp>(a.data) || std::holds_alternative<ir::PoleSet>(a.data) ||
                     std::holds_alternative<ir::CycleDefine>(a.data) || std::holds_alternative<ir::CycleCancel>(a.data);
  if (alone) return true;
  const bool beside_motion = b.has_motion && b.motion.moves();
  if (beside_motion &&
      (std::holds_alternative<ir::Dwell>(a.data) || std::holds_alternative<ir::PreparationStop>(a.data))) {
    return true;
  }
  return ProgramWriter::own_line(a, b);
}

bool Writer::spelling_is_whole_word(const ir::Action& a) const {
  if (std::holds_alternative<ir::CycleDefine>(a.data)) return !a.text.empty() && a.text.back() == ')';
  if (const auto* c = std::get_if<ir::Corner>(&a.data)) return c->feed == nullptr;
  if (std::holds_alternative<ir::SpindleLimit>(a.data)) return a.text.front() == 'L' || a.text.front() == 'l';
  return ProgramWriter::spelling_is_whole_word(a);
}

// ---- modal settings ------------------------------------------------------------------------------------------------

void Writer::modal_set(const ir::Action& a, const ir::ModalSet& m) {
  if (is_group(a)) {
    if (same_dialect()) return;  // the second meaning of G96, G97
    if (!group_written_) add(group_code_, Rank::setting, a.pos);
    group_written_ = true;
    return;
  }
  if (m.setting == Setting::units && !m.feed_too) {
    return add(m.value == code_value(ir::Units::inch) ? "G70" : "G71", Rank::setting, a.pos);
  }
  if (m.setting == Setting::plane) {
    ir::ModalSet usual = m;
    usual.value = code_value(geometry().usual(static_cast<ir::Plane>(m.value)));
    return ProgramWriter::modal_set(a, usual);
  }
  ProgramWriter::modal_set(a, m);
}

void Writer::work_offset(const ir::Action& a, const ir::WorkOffset& w) {
  if (w.off) return add("G500", Rank::setting, a.pos);
  const double row = w.index.number;
  if (!w.index.literal() || row != std::floor(row) || row < 1 || row > 99) {
    return refuse("TRN-202", a.pos, "the work offset must be a number from 1 to 99 here");
  }
  const int n = static_cast<int>(row);
  add('G' + std::to_string(n <= 4 ? 53 + n : 500 + n), Rank::setting, a.pos);
}

// ---- tool, M ----------------------------------------------------------------------------------------------

void Writer::set_feed(const ir::Action& a, const ir::SetFeed& f) {
  if (f.block_only) return add(word("FB", f.value, a.pos), Rank::feed, a.pos);
  ProgramWriter::set_feed(a, f);
}

void Writer::tool_select(const ir::Action& a, const ir::ToolSelect& t) {
  if (!t.name.empty()) return add("T=\"" + std::string(t.name) + '"', Rank::tool, a.pos);
  add(word("T", t.number, a.pos), Rank::tool, a.pos);
}

void Writer::tool_offset(const ir::Action& a, const ir::ToolOffset& t) {
  if (same_dialect() && a.text.empty()) return;  // selected by the tool change
  add(word("D", t.number, a.pos), Rank::offset, a.pos);
}

void Writer::machine_function(const ir::Action& a, const ir::MachineFunction& m) {
  if (m.auxiliary) {
    std::string address = "H";
    if (m.extension >= 0) address += std::to_string(m.extension);
    return add(word(address, m.value, a.pos), Rank::machine, a.pos);
  }
  if (m.computed || m.extension >= 0) {
    std::string address = "M";
    if (m.extension >= 0) address += std::to_string(m.extension);
    return add(word(address, m.computed ? m.value : ir::Value(m.code), a.pos), Rank::machine, a.pos);
  }
  ProgramWriter::machine_function(a, m);
}

void Writer::dwell(const ir::Action& a, const ir::Dwell& d) {
  const ir::Value amount = d.scale == 1 ? d.value : ir::scale(d.value, d.scale);
  const std::string code = same_dialect() && !a.text.empty() ? std::string(a.text) : "G4";
  add(code + ' ' + word(d.revolutions ? "S" : "F", amount, a.pos), Rank::setting, a.pos);
}

// ---- cycles, corners -----------------------------------------------------------------------------------------------

std::string Writer::cycle_text(const ir::Cycle& cycle, WordPos pos) {
  const bool own = same_dialect() && std::holds_alternative<ir::NamedCycle>(cycle.node);
  if (!own && !native_cycle(cycle)) {
    refuse("TRN-214", pos, "this cycle has no counterpart with the same moves here");
    return {};
  }
  return cycle_call(cycle, [&](const ir::Value& v) { return value_text(v, pos); });
}

void Writer::cycle_define(const ir::Action& a, const ir::CycleDefine& c) {
  if (c.modal && c.here)
    return refuse("TRN-214", a.pos, "a modal cycle that also runs where it is defined has no counterpart here");
  const std::string text = cycle_text(*c.cycle, a.pos);
  add(c.modal ? "MCALL " + text : text, Rank::head, a.pos);
}

void Writer::cycle_cancel(const ir::Action& a) {
  add("MCALL", Rank::head, a.pos);
}

void Writer::corner(const ir::Action& a, const ir::Corner& c) {
  std::string_view address = "CHR";
  if (c.kind == ir::CornerKind::chamfer_chord) address = "CHF";
  if (c.kind == ir::CornerKind::round) address = c.modal ? "RNDM" : "RND";
  if (c.modal && c.kind != ir::CornerKind::round)
    return refuse("TRN-202", a.pos, "a modal chamfer has no counterpart here");
  std::string text = word(address, c.value, a.pos);
  if (c.feed) text += ' ' + word("FRC", *c.feed, a.pos);
  add(std::move(text), Rank::motion_extra, same_dialect() ? a.pos : WordPos{});
}

// ---- motion --------------------------------------------------------------------------------------------------------

void Writer::frame_use(const ir::Motion& m) {
  if (!same_dialect() && (m.kind == ir::MotionKind::probe_toward || m.kind == ir::MotionKind::probe_away)) {
    diagnostics().warning("TRN-329", word_span(current().line.span, m.code_pos),
                          "a probing move: the target goes on without an alarm when the probe does not touch (or come "
                          "free), and the position of the contact is not the programmed one",
                          "check $AC_MEA[1] behind the move, and read the contact from $AA_MW[]");
  }
  if (m.frame == ir::FrameUse::normal) return;
  const std::string own = source_word(m.frame_pos);
  if (m.frame == ir::FrameUse::no_programmable) {
    return refuse("TRN-202", m.frame_pos, "a block without the programmable frame only has no counterpart here");
  }
  add(own.empty() ? "SUPA" : own, Rank::frame, m.frame_pos);
  if (m.frame != ir::FrameUse::machine || block_has_offset_) return;
  add("D0", Rank::offset);
  without_offset_ = &current();
}

namespace {

bool in_polynomial(const ir::Motion& m, ir::AxisId axis) {
  return m.extra && std::any_of(m.extra->polynomials.begin(), m.extra->polynomials.end(),
                                [axis](const auto& p) { return p.axis == axis; });
}

}  // namespace

/// "ACP", "ACN", "DC" for rotary moves with a direction; empty: a plain word.
std::string Writer::rotary_attribute(const ir::CoordWord& w) {
  switch (w.direction) {
    case ir::RotaryDirection::as_value: return {};
    case ir::RotaryDirection::positive: return "ACP";
    case ir::RotaryDirection::negative: return "ACN";
    case ir::RotaryDirection::shortest: return "DC";
    case ir::RotaryDirection::by_sign: break;
  }
  const auto mode = w.mode == ir::WordMode::modal
                        ? setting(Setting::distance)
                        : std::optional<std::uint8_t>(code_value(
                              w.mode == ir::WordMode::absolute ? ir::Distance::absolute : ir::Distance::incremental));
  if (mode == code_value(ir::Distance::incremental)) return {};
  if (!mode || !w.value.literal()) {
    refuse("TRN-202", w.pos, "the direction of this rotary move depends on a sign that is not known here");
    return {};
  }
  return std::signbit(w.value.number) ? "ACN" : "ACP";
}

void Writer::coordinate(const ir::Motion& m, const ir::CoordWord& w) {
  std::string name(axis_name(w.axis)), as_written = source_word(w.pos);
  if (m.kind == ir::MotionKind::reference_point)  // the machine's axis
    return add(as_written.empty() ? name + "1=0" : as_written, Rank::coordinate, w.pos);
  if (in_polynomial(m, w.axis)) return;  // written with its coefficients
  if (w.positioning == ir::Positioning::alone) name = "POS[" + name + ']';
  if (w.positioning == ir::Positioning::alone_not_awaited) name = "POSA[" + name + ']';
  std::string attribute = rotary_attribute(w);
  const bool by_sign = !attribute.empty() && w.direction == ir::RotaryDirection::by_sign;
  const bool incremental = w.mode == ir::WordMode::incremental;
  const bool plain_radius = w.scale == ir::WordScale::radius && plain_is_radius(w.axis);
  if (attribute.empty() && w.mode != ir::WordMode::modal) {
    const auto wanted = code_value(incremental ? ir::Distance::incremental : ir::Distance::absolute);
    const bool own = (w.scale == ir::WordScale::modal || plain_radius) && !same_dialect();
    if (!own || setting(ir::Setting::distance) != wanted) attribute = incremental ? "IC" : "AC";
  }
  if (w.scale != ir::WordScale::modal && !plain_radius) {
    if (w.mode == ir::WordMode::modal) {
      return refuse("TRN-202", w.pos,
                    "a word that is radius or diameter by itself must also say whether it is absolute here");
    }
    attribute = std::string(w.scale == ir::WordScale::diameter ? "D" : "R") + (incremental ? "IC" : "AC");
  }
  if (attribute.empty()) return add(word(name, w.value, w.pos), Rank::coordinate, w.pos);
  ir::Value value = w.value;
  if (by_sign) {  // the sign was the direction; the target lies in 0..360
    if (std::signbit(value.number)) value = ir::negate(value);
    if (value.number >= 360) value = ir::Value(std::fmod(value.number, 360.0));
  }
  add(attribute_word(name, attribute, value, w.pos), Rank::coordinate, w.pos);
}

/// PO[X]=(end,a2,a3), or X=PO(end,a2,a3); the common denominator PO[]=(end,a2).
void Writer::polynomial(const ir::Motion& m, const ir::PolynomialWord& p) {
  const auto word = std::find_if(m.coords.begin(), m.coords.end(), [&](const auto& w) { return w.axis == p.axis; });
  const bool common = p.axis == ir::axis::none;
  if (!common && word == m.coords.end()) return refuse("TRN-202", p.pos, "a polynomial without its end");
  const ir::Value& end = common ? p.end : word->value;
  std::string attribute;
  if (!common && word->mode != ir::WordMode::modal) attribute = word->mode == ir::WordMode::absolute ? "AC" : "IC";
  std::string values = value_text(end, p.pos);
  if (!attribute.empty() && p.after_address) values = attribute + '(' + values + ')';
  const ir::Value* const higher[] = {&p.a2, &p.a3, &p.a4, &p.a5};
  for (std::size_t i = 0; i + 1 < p.degree && i < std::size(higher); ++i) values += ',' + value_text(*higher[i], p.pos);
  const std::string name = common ? std::string{} : std::string(axis_name(p.axis));
  std::string text = p.after_address ? (common ? "PO(" : name + "=PO(") : "PO[" + name + "]=" + attribute + '(';
  add(text + values + ')', Rank::coordinate, p.pos);
}

void Writer::center(const ir::Motion& m, const ir::CenterWord& w) {
  if (w.axis > ir::axis::z)
    return refuse("TRN-202", w.pos, "the centre of an arc on this axis has no counterpart here");
  const std::string_view address = geometry().letter(w.axis);
  const bool absolute = w.mode == ir::CenterMode::absolute;
  const bool lathe_x = program().lathe && w.axis == ir::axis::x;
  const bool either = radius_on_face(w.axis) && w.scale != ir::WordScale::diameter;  // X is a radius anyway
  const bool scale_fits = !lathe_x || either || w.scale == (absolute ? ir::WordScale::modal : ir::WordScale::radius);
  if (w.mode == ir::CenterMode::follows_distance || !scale_fits) return ProgramWriter::center(m, w);
  if (absolute) return add(attribute_word(address, "AC", w.value, w.pos), Rank::center, w.pos);
  add(word(address, w.value, w.pos), Rank::center, w.pos);
}

void Writer::radius(const ir::Motion& m) {
  add(word("CR", m.radius, m.radius_pos), Rank::radius, m.radius_pos);
}

/// The axis along which the pitch of a thread counts when the source does not name it: the one with the longer way.
ir::AxisId Writer::main_axis(const ir::Motion& m) {
  if (m.coords.size() == 1) return m.coords.front().axis;
  ir::AxisId longest = ir::axis::none;
  double most = -1;
  for (const ir::CoordWord& w : m.coords) {
    const auto way = travel(w);
    if (!way) return ir::axis::none;
    if (*way > most) longest = w.axis;
    most = std::max(most, *way);
  }
  return longest;
}

/// Way of the axis in this block as radius; nullopt: the point before or a mode is not known here.
std::optional<double> Writer::travel(const ir::CoordWord& w) {
  const auto distance = setting(Setting::distance);
  const auto diameter = setting(Setting::diameter);
  const machine::AxisSpec* axis = profile().axis(w.axis);
  if (!w.value.literal() || axis == nullptr || (w.mode == ir::WordMode::modal && !distance)) return std::nullopt;
  const bool absolute = w.mode == ir::WordMode::absolute ||
                        (w.mode == ir::WordMode::modal && *distance == code_value(ir::Distance::absolute));
  double factor = 1;
  if (axis->diameter && w.scale == ir::WordScale::diameter) factor = 0.5;
  if (axis->diameter && w.scale == ir::WordScale::modal) {
    if (!diameter) return std::nullopt;
    const bool all = *diameter == code_value(ir::DiameterMode::diameter);
    const bool radius = *diameter == code_value(ir::DiameterMode::radius);
    if (all || (!radius && absolute)) factor = 0.5;
  }
  const double value = w.value.number * factor;
  if (!absolute) return std::abs(value);
  const ir::Facts* f = facts();
  const auto from = f != nullptr ? f->position[w.axis] : std::nullopt;
  if (!from) return std::nullopt;
  return std::abs(value - *from);
}

void Writer::motion_extra(const ir::Motion& m, const ir::MotionExtra& e) {
  if (e.has_pitch) return refuse("TRN-202", m.code_pos, "a helix by its pitch has no counterpart here");
  if (e.opening_signed) return refuse("TRN-202", m.code_pos, "an arc by a signed angle has no counterpart here");
  const auto extra = [&](std::string_view address, const ir::Value& v) {
    add(word(address, v, {}), Rank::motion_extra);
  };
  for (const ir::ComputedWord& w : e.computed) {
    const std::string address = "AX[" + expression_text(w.axis) + ']';
    const bool modal = w.mode == ir::WordMode::modal;
    const char* attribute = w.mode == ir::WordMode::incremental ? "IC" : "AC";
    add(modal ? word(address, w.value, w.pos) : attribute_word(address, attribute, w.value, w.pos), Rank::coordinate,
        w.pos);
  }
  for (const ir::PolynomialWord& p : e.polynomials) polynomial(m, p);
  if (e.has_degree) extra("SD", e.degree);
  if (e.has_weight) extra("PW", e.weight);
  if (e.has_interval) extra("PL", e.interval);
  const auto measures_axis = [](const ir::Action& a) {  // MEASA[X]=, written as it stood
    const auto* text = std::get_if<ir::OpaqueWord>(&a.data);
    return text != nullptr && to_upper_ascii(text->word.substr(0, 3)) == "MEA";
  };
  const auto* block = std::get_if<ir::Block>(&current().node);
  const bool said =
      same_dialect() && block != nullptr && std::any_of(block->actions.begin(), block->actions.end(), measures_axis);
  if (e.has_probe_edge && !said) extra(e.probe_goes_on ? "MEAW" : "MEAS", e.probe_edge);
  if (e.has_fixed_point) extra("FP", e.fixed_point);
  for (const ir::CenterWord& w : e.through) {
    if (w.axis > ir::axis::z) return refuse("TRN-202", w.pos, "this point of an arc has no counterpart here");
    const std::string address = std::string(geometry().letter(w.axis)) + '1';
    const std::string_view own = w.mode == ir::CenterMode::absolute     ? "AC"
                                 : w.mode == ir::CenterMode::from_start ? "IC"
                                                                        : "";
    add(own.empty() ? word(address, w.value, w.pos) : attribute_word(address, own, w.value, w.pos), Rank::center,
        w.pos);
  }
  if (e.has_polar_radius) polar_word(e.polar_mode, "RP", e.polar_radius);
  if (e.has_polar_angle) polar_word(e.polar_angle_mode, "AP", e.polar_angle);
  if (e.has_line_angle) extra("ANG", e.line_angle);
  if (e.has_angle) extra("AR", e.opening_angle);
  if (e.has_turns) extra("TURN", e.turns);
  const bool in_force = same_dialect() && e.start_angle.literal() && e.start_angle.text.empty();  // not written there
  if (!e.has_lead && e.has_start_angle && !in_force) extra("SF", e.start_angle);
  if (!e.has_lead) return;
  const ir::AxisId lead = e.lead_axis == ir::axis::none ? main_axis(m) : e.lead_axis;
  if (lead > ir::axis::z) return refuse("TRN-202", m.code_pos, "the lead of this thread has no axis");
  if (e.lead.is(0)) {
    return refuse(
        "TRN-202", m.code_pos,
        "a pitch of 0 goes on with the pitch that the thread before has reached: there is no word for it here",
        "write the pitch itself");
  }
  extra(geometry().letter(lead), e.lead);
  if (!e.lead_change.is(0))
    extra("F", e.lead_change.literal() && e.lead_change.number < 0 ? ir::negate(e.lead_change) : e.lead_change);
  if (e.has_start_angle ? !in_force : angles_) extra("SF", e.has_start_angle ? e.start_angle : ir::Value(0.0));
}

}  // namespace cnctrans::backends::sinumerik
