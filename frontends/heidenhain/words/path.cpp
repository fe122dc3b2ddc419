// Path functions (reference 5, 9, 10): L, C, CR, CT, LP, CP, CTP, CC, RND, CHF, and lines of M functions.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/heidenhain/limits.h"
#include "dialects/heidenhain/patterns.h"
#include "dialects/heidenhain/sentences.h"
#include "frontends/heidenhain/state/datum.h"
#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;

namespace {

bool is(const syntax::Word& w, std::string_view address) {
  return iequals_ascii(w.address, address);
}
bool bare(const syntax::Word& w) {
  return !w.has_value && w.number_text.empty();
}

using Form = PathForm;

/// The path function that a block begins with; none: axis words alone, which are read as L.
Form form_of(const syntax::Word& first) {
  struct Row {
    std::string_view word;
    Form form;
  };
  static constexpr std::array rows{Row{"L", Form::line},
                                   Row{"C", Form::arc},
                                   Row{"CR", Form::by_radius},
                                   Row{"CT", Form::tangent},
                                   Row{"LP", Form::polar_line},
                                   Row{"CP", Form::polar_arc},
                                   Row{"CTP", Form::polar_tangent},
                                   Row{"LN", Form::normal_line}};
  for (const auto& row : rows) {
    if (is(first, row.word) && bare(first)) return row.form;
  }
  return Form::none;
}

/// Full turns that a polar arc by its signed angle makes beyond the first.
ir::Value turns_of(const ir::Value& angle) {
  constexpr double full = 360;
  if (angle.literal()) return ir::Value(std::max(0.0, std::ceil(std::abs(angle.number) / full - 1e-9) - 1));
  using ir::BinaryOp;
  const ir::ExprPtr rounds = ir::binary(BinaryOp::divide, ir::call(ir::Function::abs, {angle.expr}), ir::number(full));
  return ir::Value(ir::binary(BinaryOp::subtract, ir::call(ir::Function::ceil, {rounds}), ir::number(1)));
}

}  // namespace

ir::Value Lowering::value(const Word& w) {
  if (!w.is_expression) return {w.number, w.number_text};
  return ir::Value(expression(block_->exprs[static_cast<std::size_t>(w.expr)]));
}

ir::Action& Lowering::act(const Word& w, ir::ActionData data, ir::Order order) {
  ir::Action& a = out_.actions.emplace_back();
  a.data = std::move(data);
  a.order = order;
  a.pos = w.pos;
  return a;
}

void Lowering::axis_word(const Word& w, ir::AxisId axis, bool incremental) {
  if (!w.has_value) return report_.refuse("HEI-002", w.pos, "`" + std::string(slice(w)) + "` has no value");
  if (!has_axis(axis)) {
    return report_.refuse(
        "HEI-003", w.pos,
        "`" + std::string(slice(w)) + "`: the machine has no axis " + std::string(ir::fixed_axis_name(axis)),
        "choose a machine profile that has it (--machine)", "machine.axis");
  }
  if (!w.is_expression && std::abs(w.number) > facts::value_max)
    return report_.refuse("HEI-024", w.pos, "`" + std::string(slice(w)) + "` is beyond the range of the control");
  for (const auto& c : out_.motion.coords) {
    if (c.axis == axis)
      return report_.refuse("HEI-004", w.pos, "`" + std::string(slice(w)) + "`: the axis stands twice in the block");
  }
  ir::CoordWord& c = out_.motion.coords.emplace_back();
  c.axis = axis;
  c.mode = incremental ? ir::WordMode::incremental : ir::WordMode::modal;  // absolute is in force always
  c.value = value(w);
  c.pos = w.pos;
  if (ir::is_rotary_letter(axis)) rotary_moved_.insert(axis);
  if (ir::is_rotary_letter(axis)) relies(AlongText::shortest);
  if (shortest_ && ir::is_rotary_letter(axis) && !incremental) c.direction = ir::RotaryDirection::shortest;
}

/// F500, FMAX, FAUTO, FU0.2. False: no feed word.
bool Lowering::feed(const Word& w) {
  if (is(w, "FMAX")) {
    rapid_ = true;
    return true;
  }
  const auto mode = [&](ir::FeedMode m) {
    act(w, ir::ModalSet{ir::Setting::feed_mode, static_cast<std::uint8_t>(m), true, ir::FeedMemory::shared});
  };
  if (is(w, "F") || is(w, "FAUTO") || is(w, "FU") || is(w, "FZ")) relies(AlongText::per_rev), sets(AlongText::per_rev);
  if (is(w, "FAUTO")) {
    if (!tool_feed_) {
      report_.refuse("HEI-005", w.pos, "FAUTO takes the feed of TOOL CALL, and the one above has none", "write F");
    } else {
      if (std::exchange(feed_by_fu_, false)) mode(per_rev_ ? ir::FeedMode::per_rev : ir::FeedMode::per_minute);
      act(w, ir::SetFeed{*tool_feed_});
      feed_of_tool_ = true;
    }
    return true;
  }
  const bool per_tooth = is(w, "FZ");
  if ((is(w, "FU") || per_tooth) && w.has_value) {  // the teeth are those of the tool table
    mode(ir::FeedMode::per_rev);
    feed_by_fu_ = true;
    const ir::Value amount = value(w);
    const ir::ExprPtr teeth = per_tooth ? datum(ir::Datum::other, "CUT") : nullptr;
    act(w, ir::SetFeed{teeth ? ir::Value(ir::binary(ir::BinaryOp::multiply, ir::as_expr(amount), teeth)) : amount});
    return true;
  }
  if (is(w, "FT") || is(w, "FMAXT")) {
    report_.keep("HEI-005", w.pos,
                 "`" + std::string(slice(w)) + "`: a feed by time needs data that are not in the program",
                 "feed.of_the_tool", "write F");
    return true;
  }
  if (!is(w, "F")) return false;
  if (!w.has_value) {
    report_.refuse("HEI-005", w.pos, "`F` has no value");
    return true;
  }
  if (!w.is_expression && w.number < 0) report_.refuse("HEI-005", w.pos, "a feed is not negative");
  if (std::exchange(feed_by_fu_, false)) mode(per_rev_ ? ir::FeedMode::per_rev : ir::FeedMode::per_minute);
  act(w, ir::SetFeed{value(w)});
  return true;
}

/// The words that any path function may end with. False: the word is none of them.
bool Lowering::tail(const Word& w) {
  const auto comp = [&](ir::CompSide side) {
    act(w, ir::ModalSet{ir::Setting::comp, static_cast<std::uint8_t>(side)});
    return true;
  };
  if (feed(w)) return true;
  if (is(w, "RL") && bare(w)) return comp(ir::CompSide::left);
  if (is(w, "RR") && bare(w)) return comp(ir::CompSide::right);
  if (is(w, "R") && w.has_value && !w.is_expression && w.number == 0) return comp(ir::CompSide::off);
  if (is(w, "M") && w.has_value) {
    machine_function(w);
    return true;
  }
  return false;
}

/// `(` behind the words: a remark of the programmer; the control knows none.
bool Lowering::remark(const Word& w) {
  if (w.address != "(") return false;
  report_.warn("HEI-026", w.pos, "text in brackets is read as a remark", "write it behind `;`");
  const std::string_view text = text_.substr(w.pos.column - 1);
  line_.comments.insert(line_.comments.begin(), {text.substr(0, text.find(';')), ir::CommentPlace::end_of_line, w.pos});
  return true;
}

/// Polar words, the sense and rapid make one motion.
void Lowering::end_motion() {
  ir::Motion& m = out_.motion;
  if (angle_) {
    auto extra = m.extra ? std::make_shared<ir::MotionExtra>(*m.extra) : std::make_shared<ir::MotionExtra>();
    extra->has_polar_angle = true;
    extra->polar_angle = *angle_;
    extra->polar_angle_mode = angle_incremental_ ? ir::WordMode::incremental : ir::WordMode::modal;
    const bool arc = m.kind == ir::MotionKind::arc_cw || m.kind == ir::MotionKind::arc_ccw;
    if (arc && angle_incremental_) {
      const ir::Value turns = turns_of(*angle_);
      extra->has_turns = !turns.is(0);
      extra->turns = turns;
      constexpr double full = 360;
      if (angle_->literal() && std::fmod(angle_->number, full) == 0) {  // to its start
        extra->has_polar_angle = false;
        extra->polar_angle = ir::Value{};
        extra->polar_angle_mode = ir::WordMode::modal;
      }
      if (extra->has_polar_angle || extra->has_turns || extra->has_polar_radius) m.extra = extra;
      return;
    }
    m.extra = std::move(extra);
  }
}

bool Lowering::path() {
  const Word& first = block_->words.front();
  if (is(first, "RND") || is(first, "CHF"))
    return corner(first, is(first, "RND") ? ir::CornerKind::round : ir::CornerKind::chamfer_leg);
  if (is(first, "CC")) return pole();
  if (is(first, "QC")) {
    report_.keep("HEI-013", first.pos, "formulas of contours are kept as text", "language.statement");
    return false;
  }
  PathLine line;
  line.form = form_of(first);
  if (!path_words(line) || !path_fits(line) || !path_motion(line) ||
      !polar_in_other_plane(line.straight(), line.polar() || line.about_pole()))
    return false;
  if (retract_ || retract_far_) retract(line.retract_feed);
  if (from_maker_point_) {
    for (auto& c : out_.motion.coords) {
      const ir::ExprPtr point = datum(ir::Datum::other, "M92_" + std::string(ir::fixed_axis_name(c.axis)));
      c.value = ir::add(c.value, ir::Value(point));
    }
  }
  put_path(line);
  return true;
}

bool Lowering::path_words(PathLine& line) {
  const auto& words = block_->words;
  for (std::size_t i = line.form == Form::none ? 0 : 1; i < words.size() && !report_.refused(); ++i) {
    const Word& written = words[i];
    Word w = written;
    // A name and its MAX or AUTO with a blank between them.
    if (is(w, "F") && bare(w) && i + 1 < words.size() && bare(words[i + 1])) {
      const Word& next = words[i + 1];
      if (is(next, "MAX") || is(next, "AUTO")) {
        w.address = is(next, "MAX") ? "FMAX" : "FAUTO";
        w.pos.length = next.pos.column + next.pos.length - w.pos.column;
        ++i;
      }
    }
    if (w.has_value && !w.is_expression && w.number_text.empty() && slice(w).find("+-") != std::string_view::npos)
      report_.warn("HEI-023", w.pos, "`" + std::string(slice(w)) + "`: two signs are read as a minus");
    if (remark(w)) break;
    if (is(w, "M") && w.has_value) {
      i += with_own_words(i);
    } else if (!place_word(line, written) && !kept_word(line, w) && !tail(w)) {
      report_.refuse("HEI-002", w.pos, "`" + std::string(slice(w)) + "` means nothing in this block", {}, "block.word");
    }
  }
  return !report_.refused();
}

/// Axes, centres, angles, radii and the sense: where the block goes. False: the word is none of them.
bool Lowering::place_word(PathLine& line, const Word& w) {
  const bool incremental = is_incremental(w.address);
  const ir::AxisId axis = axis_of(incremental ? w.address.substr(1) : w.address);
  if (axis != ir::axis::none && (w.has_value || line.straight_in_axes())) {
    axis_word(w, axis, incremental);
    return true;
  }
  if (is(w, "DR") && !w.number_text.empty() && !w.has_value) {
    sense_ = w.number_text == "+" ? 1 : -1;
    return true;
  }
  if (!w.has_value) return false;
  const Word** place = is(w, "PR") || is(w, "IPR")   ? &line.polar_radius
                       : is(w, "PA") || is(w, "IPA") ? &line.polar_angle
                                                     : nullptr;
  if (is(w, "R") && line.form == Form::by_radius && line.radius == nullptr) place = &line.radius;
  if (is(w, "F") && (retract_ || retract_far_)) place = &line.retract_feed;
  if (place != nullptr) *place = &w;
  return place != nullptr;
}

/// M with the words that belong to it. Returns how many these are.
std::size_t Lowering::with_own_words(std::size_t at) {
  const auto& words = block_->words;
  const Word& w = words[at];
  const auto code = w.is_expression ? -1 : saturate<std::int64_t>(w.number);
  machine_function(w);
  if (at + 1 >= words.size()) return 0;
  const Word& next = words[at + 1];
  if (code == 140 && (is(next, "MBMAX") || (is(next, "MB") && bare(next)))) {
    retract_far_ = true;
    return is(next, "MB") ? 2 : 1;  // MB MAX
  }
  if (code == 140 && is(next, "MB")) {
    retract_ = next;
    return 1;
  }
  const bool own_feed = (code == 103 || code == 128) && is(next, "F");
  const bool own = own_feed || (code == 120 && is(next, "LA")) || (code == 124 && is(next, "T")) ||
                   (code == 118 && axis_of(next.address) != ir::axis::none);
  if (code == 103 && own) plunge_ = plunge_share(value(next));
  return own ? 1 : 0;
}

/// Words that change no position: kept as text. False: the word is none of them.
bool Lowering::kept_word(const PathLine& line, const Word& w) {
  const bool by_radius = is(w, "R") && !w.has_value && !w.number_text.empty();  // R+ and R- of a move of one axis
  if (by_radius)
    report_.warn("HEI-006", w.pos,
                 "`" + std::string(slice(w)) +
                     "`: positions are the programmed ones; the control lengthens or shortens the move by the tool "
                     "radius",
                 "write L with RL or RR");
  const bool of_vector =
      line.form == Form::normal_line && w.has_value && facts::in_words(facts::vector_words, w.address);
  if (by_radius || of_vector) act(w, ir::OpaqueWord{slice(w)});
  return by_radius || of_vector;
}

/// The words belong together. False: refused.
bool Lowering::path_fits(const PathLine& line) {
  const WordPos at = block_->words.front().pos;
  const auto refused = [&](WordPos where, std::string_view what, std::string_view hint = {}) {
    report_.refuse("HEI-006", where, std::string(what), std::string(hint));
    return false;
  };
  const Word* polar = line.polar_radius != nullptr ? line.polar_radius : line.polar_angle;
  if (polar != nullptr && !line.polar()) return refused(polar->pos, "polar words belong to LP, CP and CTP");
  if (line.by_sense() && sense_ == 0) return refused(at, "the arc has no sense", "write DR+ or DR-");
  if (!line.by_sense() && sense_ != 0) return refused(at, "DR belongs to an arc");
  if (line.form == Form::normal_line)
    report_.warn("HEI-006", at,
                 "LN: positions are those of the tool's tip; the control turns the tool and shifts it by the vectors");
  if (rapid_ && !line.straight())
    return refused(at, "an arc is not run in rapid traverse: its feed is unknown", "write F");
  if (line.form == Form::by_radius && line.radius == nullptr) return refused(at, "the arc has no radius", "write R");
  if (line.form == Form::none && out_.motion.coords.size() > 1)
    report_.warn("HEI-006", at, "axis words without a path function are read as L", "write L before them");
  return true;
}

/// The motion of the block from its words. False: refused.
bool Lowering::path_motion(const PathLine& line) {
  using ir::MotionKind;
  ir::Motion& m = out_.motion;
  if (const Word* w = line.polar_angle) {
    angle_ = value(*w);
    angle_incremental_ = w->address.size() == 3;
    if (line.form == Form::polar_arc && angle_incremental_ && angle_->literal() && angle_->number * sense_ < 0) {
      report_.refuse("HEI-006", w->pos, "the sign of IPA and DR contradict each other");
      return false;
    }
  }
  if (const Word* w = line.polar_radius) {
    auto extra = std::make_shared<ir::MotionExtra>();
    extra->has_polar_radius = true;
    extra->polar_radius = value(*w);
    extra->polar_mode = w->address.size() == 3 ? ir::WordMode::incremental : ir::WordMode::modal;
    m.extra = std::move(extra);
  }
  m.kind = line.straight()   ? (rapid_ ? MotionKind::rapid : MotionKind::linear)
           : line.by_sense() ? (sense_ > 0 ? MotionKind::arc_ccw : MotionKind::arc_cw)
                             : MotionKind::arc_tangent;
  end_motion();
  out_.has_motion = m.moves() || line.about_pole();  // without an end point: a full circle
  m.explicit_code = out_.has_motion;
  if (line.radius != nullptr) {
    m.radius_given = true;
    m.radius = value(*line.radius);
    m.radius_pos = line.radius->pos;
  }
  return true;
}

void Lowering::put_path(const PathLine& line) {
  const bool moves = out_.has_motion;
  if (untilted_) relies(AlongText::tilt);
  const auto tilted = untilted_ ? std::exchange(tilt_, std::nullopt) : std::nullopt;
  if (tilted) put_tilt();
  const bool only_ends = !end_text_.empty() && out_.empty() && call_ == CycleCall::none;
  if (!only_ends) {
    Item& item = put(ItemKind::plain, std::move(out_));
    item.moves = moves;
    item.by_pole = line.about_pole();
    item.polar = line.polar() && line.form != Form::polar_arc && other_pole_ < 0;
    if (line.polar()) item.other_pole = other_pole_;
    item.call = call_;
    item.plunge = plunge_;
  }
  if (tilted) {
    tilt_ = tilted;
    put_tilt();
  }
  if (end_text_.empty()) return;
  ir::End end;
  end.text = end_text_;
  put(ItemKind::end, std::move(end));
  ended_ = true;
}

/// M140: back along the tool axis before the block moves otherwise, at the F behind it, else in rapid. MB MAX goes to
/// the end of the axis, which the profile says.
void Lowering::retract(const Word* own_feed, bool modal) {
  ir::Block up;
  ir::Motion& m = up.motion;
  const bool alone = !out_.has_motion;
  const auto is_feed = [](const ir::Action& a) { return std::holds_alternative<ir::SetFeed>(a.data); };
  const bool fed = own_feed != nullptr || (alone && std::any_of(out_.actions.begin(), out_.actions.end(), is_feed));
  m.kind = rapid_ || !fed ? ir::MotionKind::rapid : ir::MotionKind::linear;
  m.explicit_code = true;
  ir::CoordWord& c = m.coords.emplace_back();
  c.axis = static_cast<ir::AxisId>(tool_axis_);
  c.mode = retract_far_ ? ir::WordMode::absolute : ir::WordMode::incremental;
  if (retract_far_) {
    m.frame = ir::FrameUse::machine;
    c.value = ir::Value(datum(ir::Datum::other, "MB_MAX"));
  } else {
    c.value = value(*retract_);
    c.pos = retract_->pos;
  }
  up.has_motion = true;
  if (own_feed != nullptr && !(alone && modal)) {
    ir::SetFeed f{value(*own_feed)};
    f.block_only = true;
    up.actions.emplace_back().data = std::move(f);
  }
  if (alone) {
    if (own_feed != nullptr && modal) feed(*own_feed);
    if (own_feed != nullptr && !modal) out_.actions = std::move(up.actions);
    out_.motion = std::move(m);
    out_.has_motion = true;
    return;
  }
  put(std::move(up));
}

/// RND and CHF stand behind the element that ends in the corner.
bool Lowering::corner(const Word& first, ir::CornerKind kind) {
  const auto& words = block_->words;
  const Word* size = first.has_value ? &first : nullptr;
  const Word* own_feed = nullptr;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const Word& w = words[i];
    if (is(w, "R") && w.has_value && size == nullptr && kind == ir::CornerKind::round) {
      size = &w;
    } else if (is(w, "F") && w.has_value && own_feed == nullptr) {
      own_feed = &w;
    } else if (size == nullptr && w.address.empty() && w.has_value) {
      size = &w;
    } else {
      report_.refuse("HEI-002", w.pos, "`" + std::string(slice(w)) + "` means nothing in this block", {}, "block.word");
      return false;
    }
  }
  if (size == nullptr) {
    report_.refuse("HEI-007", first.pos, "the corner has no size");
    return false;
  }
  Item* before = nullptr;
  ir::Block* block = nullptr;
  for (std::size_t i = flat_.items.size(); i-- > 0;) {  // remarks may stand between
    before = &flat_.items[i];
    block = std::get_if<ir::Block>(&before->statement.node);
    if (block == nullptr || before->kind != ItemKind::plain || !block->empty()) break;
  }
  const bool follows = block != nullptr && before->kind == ItemKind::plain && before->moves && before->lead < 0 &&
                       before->call == CycleCall::none && block->motion.kind != ir::MotionKind::rapid;
  const bool taken = follows && std::any_of(block->actions.begin(), block->actions.end(), [](const ir::Action& a) {
                       return std::holds_alternative<ir::Corner>(a.data);
                     });
  if (!follows || taken) {
    report_.refuse("HEI-007", first.pos, "no path element stands right before the corner", {}, "motion.geometry");
    return false;
  }
  ir::Corner corner;
  corner.kind = kind;
  corner.value = value(*size);
  if (own_feed != nullptr) corner.feed = std::make_shared<const ir::Value>(value(*own_feed));
  if (report_.refused()) return false;
  ir::Action& a = block->actions.emplace_back();
  a.data = std::move(corner);
  if (!line_.comments.empty()) put(ir::Block{});
  return true;
}

}  // namespace cnctrans::frontends::heidenhain
