#include "frontends/fagor/words/block.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "base/saturate.h"
#include "dialects/fagor/limits.h"
#include "dialects/fagor/m_codes.h"
#include "dialects/fagor/patterns.h"
#include "dialects/fagor/pockets.h"
#include "frontends/fagor/statements/expr.h"
#include "frontends/fagor/words/letters.h"

namespace cnctrans::fagor {

namespace {

namespace facts = dialects::fagor;
using facts::Use;
using ir::Order;

/// Its words follow an order of their own, not that of a plain block.
bool has_own_words(const facts::GCode& row) {
  return row.use == Use::refused || row.use == Use::no_path || row.use == Use::call || row.use == Use::hole_cycle ||
         row.use == Use::cycle_change || row.use == Use::machining || row.use == Use::pattern ||
         row.use == Use::pocket || row.use == Use::inclined_plane;
}

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

/// GP100 where the parameter holds a fixed number: the function of this number, a motion or a setting.
const facts::GCode* BlockLowerer::fixed_function(const Word& w) {
  if (w.expr < 0 || g_count_ == max_g) return nullptr;
  const ir::Value v = value(w);
  const auto* variable = v.expr ? std::get_if<ir::VarRef>(&v.expr->node) : nullptr;
  const auto number = variable ? ir::constant_value(variable->index) : std::nullopt;
  const double* code = number ? state_.constant(saturate<std::int64_t>(*number)) : nullptr;
  if (!code || *code < 0 || *code != std::floor(*code) || *code > facts::max_g_code) return nullptr;
  const GCode* row = state_.g(saturate<int>(*code));
  if (!row || (row->use != Use::motion && row->use != Use::setting && row->use != Use::plane)) return nullptr;
  state_.note("FAG-012", w.pos, word_name(w) + " is G" + std::to_string(row->code) + " here");
  return row;
}

void BlockLowerer::gather_g(const Word& w) {
  if (const GCode* row = fixed_function(w)) {
    g_[g_count_++] = {row, &w};
    return;
  }
  if (w.expr >= 0) {
    state_.warning("FAG-012", w.pos, "a G function computed by a parameter: the block is kept as text",
                   "a run stops here; write the function's number");
    result_->opaque = "block.word";
    result_->needs_program = true;
    return;
  }
  const GCode* row = w.number >= 0 && w.number == std::floor(w.number) && w.number <= facts::max_g_code
                         ? state_.g(saturate<int>(w.number))
                         : nullptr;
  if (!row) {
    state_.error(
        "FAG-003", w.pos,
        "there is no function " + word_name(w) + (state_.lathe() ? " on the lathe model" : " on the mill model"));
    return;
  }
  const auto same = [row](const GWord& g) { return g.row == row; };
  if ((row->use == Use::motion || row->use == Use::setting) &&
      std::any_of(g_.begin(), g_.begin() + static_cast<std::ptrdiff_t>(g_count_), same)) {
    state_.note("FAG-006", w.pos, word_name(w) + " is said already in this block: it counts once");
    return;
  }
  if (g_count_ == max_g) {
    state_.error("FAG-006", w.pos, "too many G functions in one block");
    return;
  }
  const bool cycle = row->use == Use::machining || row->use == Use::pattern || row->use == Use::pocket;
  if (cycle && cycle_row_ != nullptr) {
    state_.error("FAG-006", w.pos, word_name(w) + " stands in a block with another cycle");
    return;
  }
  if (row->use == Use::machining) cycle_row_ = facts::find_cycle(row->code);
  if (row->use == Use::pattern) cycle_row_ = facts::find_pattern(row->code);
  if (row->use == Use::pocket) cycle_row_ = facts::find_pocket(row->code);
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
  coords_taken_ = cycle_ = has_after_ = surface_here_ = surface_ends_ = false;
  motion_code_ = nullptr;
  argument_ = nullptr;
  cycle_row_ = nullptr;
  cycle_word_count_ = 0;
  absolute_centre_ = tangent_arc_ = three_points_ = machine_coords_ = home_ = nullptr;
  straight_ = nullptr;
  if (has_extra_) {
    extra_ = ir::MotionExtra{};
    has_extra_ = false;
  }
  std::uint8_t rank = 0;
  const Word* unordered = nullptr;
  bool lower_case = false;
  for (const Word& w : in.words) {
    const char c = word_letter(w);
    if (cycle_row_ && gather_cycle_word(w, c)) continue;
    const std::uint32_t mask = bit(c);
    const LetterInfo& info = letter_info[index(c)];
    lower_case = lower_case || w.address[0] != c;
    const bool angle =
        c == 'S' && m_count_ != 0 && (m_[m_count_ - 1]->number == 19 || m_[m_count_ - 1]->number == 45);  // M19 S30
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
    if (c == 'P' && w.extension >= 0) {  // P3=2: only calls take it, see lower_g_call
      argument_ = &w;
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
  const bool own_order = std::any_of(g_.begin(), g_.begin() + static_cast<std::ptrdiff_t>(g_count_),
                                     [](const GWord& g) { return has_own_words(*g.row); });
  if (unordered && !own_order) {
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
  if (argument_ && result.opaque.empty())
    state_.error("FAG-004", argument_->pos, "the word " + word_name(*argument_) + " has no meaning in this block");
  if (result.opaque.empty()) {
    if ((unused_ & technology_letters) != 0 || m_count_ != 0) {
      technology();
      machine_functions();
    }
    if (!result.opaque.empty()) return;
    if (has_after_) after_motion_last();
    motion();
    check_block();
    if (unused_ != 0 || radius_count_ != 0) {
      repeat();
      leftovers();
    }
  }
  if (state_.surface_by_text != ir::Surface::none) note_surface();
  if (state_.errors() != errors && !result.harmless) {
    if (result.opaque.empty()) result.opaque = "text.unread";
    result.harmless = false;
  }
}

// --- F S T D M ------------------------------------------------------------------------------------------------------

void BlockLowerer::technology() {
  if (const Word* f = take('F')) act(ir::SetFeed{value(*f), true}, f);
  bool orients = false, changes = false;
  const Word* live = nullptr;
  for (std::size_t i = 0; i < m_count_; ++i) {
    const machine::MCode* m = m_[i]->expr < 0 ? state_.m(saturate<int>(m_[i]->number)) : nullptr;
    orients = orients || (m && m->meaning == machine::MMeaning::spindle_orient);
    changes = changes || (m && m->meaning == machine::MMeaning::tool_change);
    if (m_[i]->expr < 0 && m_[i]->number == 45) live = m_[i];
  }
  if (live) live_tool(*live);
  if (!result_->opaque.empty()) return;
  if (!orients) {
    if (const Word* s = take('S')) act(ir::SetSpindle{state_.spindle(), value(*s)}, s);
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

/// The driven tool is the spindle behind the two of 5.4; the sign of S is its sense (5.7.9).
void BlockLowerer::live_tool(const Word& code) {
  const Word* s = take('S');
  if (s && s->expr >= 0) {
    state_.warning("FAG-007", code.pos, "a driven tool (M45) with a computed speed is kept as text",
                   "a run stops here; only a program for this control can be written with it");
    result_->opaque = "block.word";
    result_->needs_program = true;
    return;
  }
  const double speed = s ? s->number : 0;
  if (s) act(ir::SetSpindle{facts::live_tool_spindle, ir::Value(std::fabs(speed))}, s);
  const auto sense = speed > 0 ? ir::SpindleState::cw : speed < 0 ? ir::SpindleState::ccw : ir::SpindleState::off;
  act(ir::SpindleRun{facts::live_tool_spindle, sense}, &code);
}

void BlockLowerer::machine_function(const Word& w) {
  if (w.expr >= 0 || w.number < 0 || w.number != std::floor(w.number) || w.number > 9999) {
    state_.warning("FAG-012", w.pos,
                   "an M function computed by a parameter, or with decimals: the block is kept as text",
                   "a run stops here; write the function's number");
    result_->opaque = "block.word";
    result_->needs_program = true;
    return;
  }
  const auto code = saturate<std::int32_t>(w.number);
  if (code == 45) return;  // see live_tool
  const machine::MCode* m = state_.m(code);
  const Order order = m ? m->order : Order::before;
  using machine::MMeaning;
  const auto meaning = m ? m->meaning : MMeaning::machine_function;
  if (meaning >= MMeaning::spindle_cw && meaning <= MMeaning::spindle_orient && state_.spindle_now() == 1)
    leave_surface(order);  // the spindle is no C axis any more (6.15)
  switch (meaning) {
    case MMeaning::stop: act(ir::Stop{false}, &w, order); return;
    case MMeaning::optional_stop: act(ir::Stop{true}, &w, order); return;
    case MMeaning::program_end: result_->end = &w; return;
    case MMeaning::spindle_cw: act(ir::SpindleRun{state_.spindle(), ir::SpindleState::cw}, &w, order); return;
    case MMeaning::spindle_ccw: act(ir::SpindleRun{state_.spindle(), ir::SpindleState::ccw}, &w, order); return;
    case MMeaning::spindle_stop: act(ir::SpindleRun{state_.spindle(), ir::SpindleState::off}, &w, order); return;
    case MMeaning::spindle_orient: act(ir::SpindleOrient{state_.spindle(), value_of('S')}, &w, order); return;
    case MMeaning::tool_change:
      act(ir::ToolChange{}, &w, order);
      if (const Word* d = take('D')) act(ir::ToolOffset{value(*d)}, d, order);  // of the tool that comes in
      return;
    case MMeaning::coolant_off: act(ir::Coolant{ir::CoolantState::off}, &w, order); return;
    case MMeaning::coolant_flood: act(ir::Coolant{ir::CoolantState::flood}, &w, order); return;
    case MMeaning::coolant_mist: act(ir::Coolant{ir::CoolantState::mist}, &w, order); return;
    case MMeaning::coolant_second: act(ir::Coolant{ir::CoolantState::second}, &w, order); return;
    case MMeaning::gear: act(ir::SpindleGear{state_.spindle(), m->argument, false}, &w, order); return;
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
}

void BlockLowerer::after_motion_last() {
  std::stable_partition(out_->actions.begin(), out_->actions.end(),
                        [](const ir::Action& a) { return a.order != Order::after; });
}

// --- repeat count, words without meaning
// ------------------------------------------------------------------------------

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
