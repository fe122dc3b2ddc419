#include "frontends/fagor/lower_block.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "dialects/fagor/limits.h"
#include "frontends/fagor/lower_expr.h"

namespace cnctrans::fagor {

namespace {

namespace facts = dialects::fagor;
using facts::Use;
using ir::Order;

/// What a letter is in an ISO block, and its place in the order the control wants (0: no place of its own).
enum class Letter : std::uint8_t { other, g, axis, m, radius };
struct LetterInfo {
  Letter kind = Letter::other;
  std::uint8_t rank = 0;
  ir::AxisId axis = ir::axis::none;
};
constexpr std::array<LetterInfo, 26> make_letters() {
  std::array<LetterInfo, 26> t{};
  for (std::size_t i = 0; i < t.size(); ++i) {
    const ir::AxisId axis = ir::fixed_axis(static_cast<char>('A' + i));
    if (axis != ir::axis::none) t[i] = {Letter::axis, 2, axis};
  }
  t['G' - 'A'] = {Letter::g, 1, ir::axis::none};
  t['F' - 'A'].rank = 3;
  t['S' - 'A'].rank = 4;
  t['T' - 'A'].rank = 5;
  t['D' - 'A'].rank = 6;
  t['M' - 'A'] = {Letter::m, 7, ir::axis::none};
  t['R' - 'A'].kind = Letter::radius;
  return t;
}
constexpr std::array<LetterInfo, 26> letter_info = make_letters();

std::string word_name(const syntax::Word& w) {
  return std::string(word_text(w));
}

}  // namespace

// --- collecting -----------------------------------------------------------------------------------------------------

const syntax::Word* BlockLowerer::take(char c) {
  if ((unused_ & bit(c)) == 0) return nullptr;
  unused_ &= ~bit(c);
  return letters_[index(c)];
}

ir::Value BlockLowerer::value(const Word& w) {
  return lower_value(w, *in_, state_);
}
ir::Value BlockLowerer::value_of(char c) {
  const Word* w = take(c);
  return w ? value(*w) : ir::Value{};
}

void BlockLowerer::gather_g(const Word& w) {
  if (w.expr >= 0) {
    state_.error("FAG-012", w.pos, "a G function computed by a parameter can't be translated",
                 "write the function's number");
    return;
  }
  const GCode* row = w.number >= 0 && w.number == std::floor(w.number) && w.number <= facts::max_g_code
                         ? state_.g(static_cast<int>(w.number))
                         : nullptr;
  if (!row) {
    state_.error(
        "FAG-003", w.pos,
        "there is no function " + word_name(w) + (state_.lathe() ? " on the lathe model" : " on the mill model"));
    return;
  }
  if (g_count_ == max_g) {
    state_.error("FAG-006", w.pos, "too many G functions in one block");
    return;
  }
  g_[g_count_++] = {row, &w};
}

void BlockLowerer::gather_m(const Word& w) {
  if (m_count_ == max_m) {
    state_.error("FAG-017", w.pos, "too many M functions in one block", "the control takes seven");
    return;
  }
  m_[m_count_++] = &w;
}

void BlockLowerer::gather(const syntax::Block& in) {
  g_count_ = m_count_ = coord_count_ = radius_count_ = radii_taken_ = 0;
  seen_ = unused_ = 0;
  coords_taken_ = cycle_ = stop_dwell_ = false;
  motion_code_ = nullptr;
  absolute_centre_ = tangent_arc_ = three_points_ = machine_coords_ = home_ = nullptr;
  if (has_extra_) {
    extra_ = ir::MotionExtra{};
    has_extra_ = false;
  }
  std::uint8_t rank = 0;
  const Word* unordered = nullptr;
  bool lower_case = false;
  for (const Word& w : in.words) {
    const char c = word_letter(w);
    const std::uint32_t mask = bit(c);
    const LetterInfo& info = letter_info[index(c)];
    lower_case = lower_case || w.address[0] != c;
    const bool angle = c == 'S' && m_count_ != 0 && m_[m_count_ - 1]->number == 19;  // M19 S30
    if (info.rank != 0 && !angle) {
      if (info.rank < rank) unordered = &w;
      rank = info.rank;
    }
    if (info.kind == Letter::g) {
      gather_g(w);
      continue;
    }
    if (info.kind == Letter::m) {
      gather_m(w);
      continue;
    }
    if (info.kind == Letter::radius) {
      if (radius_count_ < radii_.size()) radii_[radius_count_] = &w;
      if (++radius_count_ > 2) state_.error("FAG-005", w.pos, "the word R stands too often in the block");
      continue;
    }
    if ((seen_ & mask) != 0) {
      state_.error("FAG-005", w.pos, std::string("the word ") + c + " stands twice in the block");
      continue;
    }
    seen_ |= mask;
    letters_[index(c)] = &w;
    if (info.kind == Letter::axis)
      coords_[coord_count_++] = &w;
    else
      unused_ |= mask;
  }
  if (unordered) {
    state_.warning("FAG-010", unordered->pos,
                   "the control wants G functions, axes, F, S, T, D and M functions in this order",
                   "it reports an error for the block; the translation reads it as written");
  }
  if (lower_case) state_.note("FAG-011", {}, "small letters are read as capitals");
  if (m_count_ > static_cast<std::size_t>(facts::max_m_functions))
    state_.warning("FAG-017", m_[7]->pos, "the control takes seven M functions in a block");
}

/// Functions of one group exclude each other; some want a block of their own.
void BlockLowerer::check_groups() {
  std::uint32_t groups = 0;
  for (std::size_t i = 0; i < g_count_; ++i) {
    const GCode& row = *g_[i].row;
    const std::uint32_t mask = 1U << static_cast<unsigned>(row.group);
    bool twice = row.group != facts::Group::none && (groups & mask) != 0;
    for (std::size_t k = 0; k < i; ++k) twice = twice || g_[k].row == g_[i].row;
    if (twice)
      state_.error("FAG-006", g_[i].word->pos,
                   word_name(*g_[i].word) + " does not go with another function of this block", "split the block");
    groups |= mask;
  }
  for (std::size_t i = 0; i < g_count_; ++i) {
    const GCode& row = *g_[i].row;
    if (!row.alone || row.use == Use::refused || row.use == Use::no_path || row.use == Use::call) continue;
    const bool offset = row.use == Use::work_offset || row.use == Use::table_shift || row.use == Use::numbered_offset;
    const std::string text = word_name(*g_[i].word) + " has to stand alone in its block";
    if (offset && (coord_count_ != 0 || g_count_ > 1)) {
      state_.warning("FAG-006", g_[i].word->pos, text, "it is read as acting before the rest of the block");
    } else if (g_count_ > 1) {
      state_.error("FAG-006", g_[i].word->pos, text, "split the block");
    }
  }
}

void BlockLowerer::lower(const syntax::Block& in, ir::Block& out, BlockResult& result) {
  in_ = &in;
  out_ = &out;
  result_ = &result;
  out.clear();
  const std::size_t errors = state_.errors();
  gather(in);
  if (g_count_ != 0) {
    if (g_count_ > 1 || g_[0].row->alone) check_groups();
    for (std::size_t i = 0; i < g_count_ && result.opaque.empty() && !result.call; ++i) apply(g_[i]);
  }
  if (result.call) return;
  if (result.opaque.empty()) {
    technology();
    machine_functions();
    motion();
    repeat();
    leftovers();
  }
  if (state_.errors() != errors && !result.harmless) {
    if (result.opaque.empty()) result.opaque = "text.unread";
    result.harmless = false;
  }
}

// --- F S T D M ------------------------------------------------------------------------------------------------------

void BlockLowerer::technology() {
  if (const Word* f = take('F')) act(ir::SetFeed{value(*f), true}, f);
  bool orients = false, changes = false, live = false;
  for (std::size_t i = 0; i < m_count_; ++i) {
    const machine::MCode* m = m_[i]->expr < 0 ? state_.m(static_cast<int>(m_[i]->number)) : nullptr;
    orients = orients || (m && m->meaning == machine::MMeaning::spindle_orient);
    changes = changes || (m && m->meaning == machine::MMeaning::tool_change);
    live = live || (m_[i]->expr < 0 && m_[i]->number == 45);
  }
  if (live) {
    state_.error("FAG-007", {}, "the driven tool (M45) is not translated yet");
    result_->opaque = "block.word";
    return;
  }
  if (!orients) {
    if (const Word* s = take('S')) act(ir::SetSpindle{1, value(*s)}, s);
  }
  if (const Word* t = take('T')) {
    ir::ToolSelect select;
    select.number = value(*t);
    select.changes = !state_.tool_changer();
    act(std::move(select), t);
  }
  if (changes) return;
  if (const Word* d = take('D')) act(ir::ToolOffset{value(*d)}, d);
}

void BlockLowerer::machine_function(const Word& w) {
  if (w.expr >= 0 || w.number < 0 || w.number != std::floor(w.number) || w.number > 9999) {
    state_.error("FAG-012", w.pos, "an M function computed by a parameter, or with decimals, can't be translated",
                 "write the function's number");
    return;
  }
  const auto code = static_cast<std::int32_t>(w.number);
  const machine::MCode* m = state_.m(code);
  const Order order = m ? m->order : Order::before;
  using machine::MMeaning;
  switch (m ? m->meaning : MMeaning::machine_function) {
    case MMeaning::stop: act(ir::Stop{false}, &w, order); return;
    case MMeaning::optional_stop: act(ir::Stop{true}, &w, order); return;
    case MMeaning::program_end: result_->end = &w; return;
    case MMeaning::spindle_cw: act(ir::SpindleRun{1, ir::SpindleState::cw}, &w, order); return;
    case MMeaning::spindle_ccw: act(ir::SpindleRun{1, ir::SpindleState::ccw}, &w, order); return;
    case MMeaning::spindle_stop: act(ir::SpindleRun{1, ir::SpindleState::off}, &w, order); return;
    case MMeaning::spindle_orient: act(ir::SpindleOrient{1, value_of('S')}, &w, order); return;
    case MMeaning::tool_change:
      act(ir::ToolChange{}, &w, order);
      if (const Word* d = take('D')) act(ir::ToolOffset{value(*d)}, d, order);  // of the tool that comes in
      return;
    case MMeaning::coolant_off: act(ir::Coolant{ir::CoolantState::off}, &w, order); return;
    case MMeaning::coolant_flood: act(ir::Coolant{ir::CoolantState::flood}, &w, order); return;
    case MMeaning::coolant_mist: act(ir::Coolant{ir::CoolantState::mist}, &w, order); return;
    case MMeaning::coolant_second: act(ir::Coolant{ir::CoolantState::second}, &w, order); return;
    case MMeaning::gear: act(ir::SpindleGear{1, m->argument, false}, &w, order); return;
    case MMeaning::subprogram_end:
    case MMeaning::none:
    case MMeaning::machine_function: break;
  }
  ir::MachineFunction f;
  f.code = code;
  act(std::move(f), &w, order);
}

/// In the written order; those after the motion come last.
void BlockLowerer::machine_functions() {
  for (std::size_t i = 0; i < m_count_; ++i) machine_function(*m_[i]);
  bool sorted = true, after = false;
  for (const auto& a : out_->actions) {
    sorted = sorted && !(after && a.order != Order::after);
    after = after || a.order == Order::after;
  }
  if (sorted) return;
  std::stable_partition(out_->actions.begin(), out_->actions.end(),
                        [](const ir::Action& a) { return a.order != Order::after; });
}

// --- motion ---------------------------------------------------------------------------------------------------------

ir::MotionExtra& BlockLowerer::extra() {
  has_extra_ = true;
  return extra_;
}

void BlockLowerer::coordinates(ir::Motion& m) {
  for (std::size_t i = 0; i < coord_count_; ++i) {
    const Word& w = *coords_[i];
    const ir::AxisId axis = letter_info[index(word_letter(w))].axis;
    if (!state_.has_axis(axis)) {
      state_.error("FAG-009", w.pos, std::string("the machine has no axis ") + word_letter(w),
                   "choose a machine profile that has it");
      continue;
    }
    if (!(std::fabs(w.number) <= facts::max_coordinate_mm)) {
      state_.error("FAG-013", w.pos, "the coordinate " + word_name(w) + " is beyond 99999.9999");
      continue;
    }
    ir::CoordWord& c = m.coords.emplace_back();
    c.axis = axis;
    c.value = value(w);
    c.pos = w.pos;
    if (ir::is_rotary_letter(axis)) rotary(c, w);
  }
}

/// Absolute words of a rollover axis: the sign is the sense of turning and the value the target (3.7).
void BlockLowerer::rotary(ir::CoordWord& c, const Word& w) {
  if (state_.rollover()) {
    c.direction = ir::RotaryDirection::by_sign;
  } else if (!state_.facts.rotary) {
    state_.facts.rotary = true;
    state_.warning("FAG-035", w.pos,
                   std::string("the words of the rotary axis ") + word_letter(w) + " are read as plain coordinates",
                   "on a rollover axis the sign of an absolute word is its direction: set the option "
                   "fagor.rotary_rollover to yes");
  }
}

/// I J K: the centre from the start of the arc, absolute with G6, the point on the way with G9. The letter of an axis
/// outside the plane is the pitch of a helix.
void BlockLowerer::centers(ir::Motion& m) {
  for (const char c : {'I', 'J', 'K'}) {
    const Word* w = take(c);
    if (!w) continue;
    const auto axis = static_cast<ir::AxisId>(c - 'I');
    ir::CenterWord center;
    center.axis = axis;
    center.value = value(*w);
    center.pos = w->pos;
    if (axis == ir::plane_axes(state_.plane_now()).w) {
      (void)state_.plane_by_text();
      result_->needs_program = true;
      extra().has_pitch = true;
      extra().pitch = std::move(center.value);
      continue;
    }
    if (three_points_) {
      center.mode = ir::CenterMode::follows_distance;
      center.scale = ir::WordScale::modal;
      extra().through.push_back(std::move(center));
      continue;
    }
    if (absolute_centre_) {
      center.mode = ir::CenterMode::absolute;
      center.scale = ir::WordScale::modal;
    }
    m.centers.push_back(std::move(center));
  }
}

/// R: radius of an arc when the block has coordinates, else polar radius. Q: polar angle; with a coordinate of a
/// straight line the angle of the line; of a thread the start angle.
void BlockLowerer::radius_and_polar(ir::Motion& m) {
  const bool straight = m.kind == ir::MotionKind::rapid || m.kind == ir::MotionKind::linear;
  const bool arc = m.kind == ir::MotionKind::arc_cw || m.kind == ir::MotionKind::arc_ccw;
  const Word* r = radii_taken_ < radius_count_ ? radii_[radius_count_ == 2 && radii_taken_ == 1 ? 1 : 0] : nullptr;
  const Word* q = m.kind == ir::MotionKind::thread || m.kind == ir::MotionKind::thread_variable ? nullptr : take('Q');
  if (!r && !q) return;
  if (r) ++radii_taken_;
  if (r && !q && !straight && !m.coords.empty()) {
    m.radius_given = true;
    m.radius = value(*r);
    m.radius_pos = r->pos;
    return;
  }
  result_->needs_program = true;
  if (q && !r && !arc && m.centers.empty() && !m.coords.empty()) {
    extra().has_line_angle = true;
    extra().line_angle = value(*q);
    return;
  }
  if (r) {
    extra().has_polar_radius = true;
    extra().polar_radius = value(*r);
  }
  if (q) {
    extra().has_polar_angle = true;
    extra().polar_angle = value(*q);
  }
}

void BlockLowerer::thread(ir::Motion& m) {
  const bool variable = m.kind == ir::MotionKind::thread_variable;
  const bool thread = variable || m.kind == ir::MotionKind::thread;
  const Word* lead = thread || m.kind == ir::MotionKind::modal ? take('L') : nullptr;
  if (thread && !lead && !m.coords.empty()) {
    state_.error("FAG-014", motion_code_->word->pos, "the thread has no pitch L");
    return;
  }
  if (!lead) return;
  if (!thread && state_.motion_by_text != ir::MotionKind::thread &&
      state_.motion_by_text != ir::MotionKind::thread_variable) {
    state_.error("FAG-004", lead->pos, "a pitch L has no meaning without G33 or G34");
    return;
  }
  extra().has_lead = true;
  extra().lead = value(*lead);
  if (variable) extra().lead_change = value_of('K');
  if (const Word* q = take('Q')) {
    extra().has_start_angle = true;
    extra().start_angle = value(*q);
  }
  if (m.coords.size() > 1) {
    state_.warning("FAG-029", lead->pos,
                   "the manual does not say along which axis the pitch of a taper thread is measured",
                   "it is taken along the longer axis; check the first part");
  }
}

void BlockLowerer::motion() {
  const bool coords = coord_count_ != 0 && !coords_taken_;
  const bool words =
      coords || radii_taken_ < radius_count_ || (unused_ & (bit('I') | bit('J') | bit('K') | bit('Q'))) != 0;
  if (!words && !motion_code_ && !tangent_arc_ && !three_points_ && !home_) return;
  ir::Motion& m = out_->motion;
  out_->has_motion = true;
  const Word* code = motion_code_    ? motion_code_->word
                     : tangent_arc_  ? tangent_arc_
                     : three_points_ ? three_points_
                                     : home_;
  if (code) {
    m.explicit_code = true;
    m.code_pos = code->pos;
    m.code_text = word_text(*code);
  }
  if (motion_code_) m.kind = state_.motion_by_text = motion_code_->row->motion;
  if (tangent_arc_ || three_points_ || home_) {
    if (motion_code_) state_.error("FAG-006", code->pos, "two kinds of motion in one block");
    m.kind = home_          ? ir::MotionKind::reference_point
             : tangent_arc_ ? ir::MotionKind::arc_tangent
                            : ir::MotionKind::arc_through_point;
    m.keeps_modal = false;
  }
  if (cycle_ && !motion_code_ && state_.motion_by_text != ir::MotionKind::rapid) {  // to the hole in rapid (25.3)
    m.kind = ir::MotionKind::rapid;
    m.keeps_modal = false;
  }
  if (machine_coords_) {
    m.frame = ir::FrameUse::machine;
    m.frame_pos = machine_coords_->pos;
  }
  if (coords) coordinates(m);
  if (!words) return;
  thread(m);
  if ((unused_ & (bit('I') | bit('J') | bit('K'))) != 0) {
    if (m.kind == ir::MotionKind::rapid || m.kind == ir::MotionKind::linear) {
      state_.error("FAG-004", code ? code->pos : WordPos{}, "I, J and K have no meaning in a straight move");
    }
    centers(m);
  }
  radius_and_polar(m);
  if (absolute_centre_ && m.centers.empty())
    state_.error("FAG-014", absolute_centre_->pos, "G6 needs the centre I, J or K");
  if (three_points_ && extra_.through.empty())
    state_.error("FAG-014", three_points_->pos, "G9 needs the point on the way I, J or K");
  if (has_extra_) m.extra = std::make_shared<const ir::MotionExtra>(extra_);
}

void BlockLowerer::repeat() {
  const Word* n = take('N');
  if (!n) return;
  const bool whole =
      n->expr >= 0 || (n->number >= 0 && n->number == std::floor(n->number) && n->number <= facts::max_repeat);
  if (!whole || !n->has_value) {
    state_.error("FAG-016", n->pos, "a repeat count is a whole number from 0 to 9999, or a parameter");
  } else if (!out_->has_motion) {
    state_.error("FAG-016", n->pos, "only a block with motion can be repeated");
  }
  out_->repeat_given = 1;
  out_->repeat = value(*n);
  result_->needs_program = true;
}

void BlockLowerer::leftovers() {
  if (radii_taken_ < radius_count_ && radius_count_ != 0) unused_ |= bit('R');
  if (unused_ == 0) return;
  for (const Word& w : in_->words) {
    const char c = word_letter(w);
    if ((unused_ & bit(c)) != 0)
      state_.error("FAG-004", w.pos, "the word " + word_name(w) + " has no meaning in this block");
  }
}

}  // namespace cnctrans::fagor
