// The pass over the words of a block: each word by itself. What they mean together: resolve.cpp.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/num/limits.h"
#include "dialects/num/mcodes.h"
#include "frontends/num/state/actions.h"
#include "frontends/num/state/lower.h"

namespace cnctrans::frontends::num {

namespace facts = dialects::num;
using facts::GKind;

namespace {

constexpr std::array<ir::AxisId, 26> make_axis_slots() {
  std::array<ir::AxisId, 26> a{};
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = ir::fixed_axis(static_cast<char>('A' + i));
  return a;
}
constexpr auto axis_slots = make_axis_slots();

/// Digits separated by blanks ("1 0"), which the control joins.
bool joined_digits(std::string_view text) {
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if ((text[i] == ' ' || text[i] == '\t') && text[i - 1] >= '0' && text[i - 1] <= '9') return true;
  }
  return false;
}
bool has_blank(std::string_view text) {
  for (const char c : text) {
    if (c == ' ' || c == '\t' || c == '(') return true;
  }
  return false;
}

/// The number of a G, M, N or H word: a literal integer; -1 otherwise.
std::int64_t integer(const syntax::Word& w) {
  if (w.is_expression || w.number < 0 || w.number > 1e9) return -1;
  const auto n = saturate<std::int64_t>(w.number);
  return static_cast<double>(n) == w.number ? n : -1;
}

}  // namespace

Lowering::Lowering(const Settings& settings, Diagnostics& diagnostics)
    : settings_(settings), report_(diagnostics), expressions_(settings_, report_) {
  start_program(true);
}

void Lowering::start_program(bool main, std::int64_t number) {
  state_ = TextState{};
  state_.program = number;
  state_.main = state_.known = main;
  state_.distance = settings_.power_on.distance;
  state_.plane = settings_.power_on.plane;
  state_.motion = settings_.power_on.motion;
}

void Lowering::unknown(const Word& w, std::string_view why) {
  report_.refuse("NUM-005", w.pos, "`" + std::string(text_of(w)) + "`: " + std::string(why), {}, "block.word");
}

void Lowering::leave_out(const Word& w, std::string_view code, const std::string& what, std::size_t words) {
  const std::string message = "`" + std::string(text_of(w)) + "` " + what;
  if (block_->words.size() == words && block_->statements.empty()) {
    return report_.carry(code, w.pos, message + "; the block is kept as text", "block.word");
  }
  if (words != 1) return report_.warn(code, w.pos, message + "; it is left out");
  report_.warn(code, w.pos, message + "; programs for other controls leave it out");
  act(w, Step::special, ir::OpaqueWord{text_of(w)}, ir::Order::with);
}

/// G78, and G76 into another program (H): nothing of it shows in this program's path. The block is kept when it holds
/// nothing else. G76 into blocks of this program changes what they do.
void Lowering::only_text(const Word& w, const facts::GCode& row) {
  const bool save = row.kind == GKind::save_values;
  const std::string_view own = save ? "HN" : "PQ";
  bool alone = block_->statements.empty(), elsewhere = !save;
  for (const Word& x : block_->words) {
    elsewhere = elsewhere || x.address == "H";
    alone = alone && (&x == &w || (x.address.size() == 1 && own.find(x.address) != std::string_view::npos));
  }
  alone = alone && elsewhere;
  const std::string what = "`" + std::string(text_of(w)) + "` (" + std::string(row.title) + ")";
  if (alone) {
    return report_.carry("NUM-034", w.pos, what + " does not change the path of this program; kept as text",
                         save ? "language.statement" : "language.synchronised");
  }
  report_.keep(
      "NUM-004", w.pos, what + " is not carried here", save ? "language.statement" : "language.synchronised",
      save ? "it writes into blocks of this program, or stands beside other words" : "write it in a block of its own");
}

const syntax::Word* Lowering::use(int slot) {
  if (!has(slot)) return nullptr;
  used_ |= std::uint64_t{1} << slot;
  const Word* w = pending_[static_cast<std::size_t>(slot)];
  if (!w->has_value && !w->number_text.empty()) {
    report_.refuse("NUM-028", w->pos, "`" + std::string(text_of(*w)) + "`: a sign without a number means nothing here",
                   {}, "block.word");
  }
  return w;
}

bool Lowering::check_literal(const Word& w, double limit) {
  if (w.is_expression || std::abs(w.number) <= limit) return true;
  report_.refuse("NUM-008", w.pos, "`" + std::string(text_of(w)) + "` is beyond the range of the control");
  return false;
}

ir::Value Lowering::value(const Word& w) {
  if (w.is_expression) {
    const syntax::Expr& e = block_->exprs[static_cast<std::size_t>(w.expr)];
    if (e.kind == syntax::ExprKind::binary) {
      report_.warn("NUM-021", w.pos,
                   "`" + std::string(text_of(w)) + "`: an expression as the value of a word is read, " +
                       "but only later controls know it");
    }
    return ir::Value(expressions_.lower(e));
  }
  if (!has_blank(w.number_text)) return {w.number, w.has_value ? w.number_text : std::string_view{}};
  if (joined_digits(w.number_text)) {
    report_.warn("NUM-009", w.pos,
                 "`" + std::string(text_of(w)) + "`: blanks inside a number count for nothing; read as " +
                     std::string(w.address) + shortest(w.number));
  }
  return ir::Value(w.number);
}

ir::Value Lowering::axis_value(const Word& w, ir::AxisId axis) {
  if (!w.is_expression) return value(w);
  const syntax::Expr& e = block_->exprs[static_cast<std::size_t>(w.expr)];
  if (e.kind == syntax::ExprKind::binary) return value(w);
  return ir::Value(expressions_.lower_axis_value(e, axis));
}

void Lowering::coordinate(const Word& w, ir::AxisId axis) {
  const bool on_surface = axis == ir::axis::y && state_.surface != ir::Surface::none;
  if ((settings_.axes >> axis & 1U) == 0 && !on_surface) {
    report_.refuse(
        "NUM-006", w.pos,
        "`" + std::string(text_of(w)) + "`: the machine has no axis " + std::string(ir::fixed_axis_name(axis)),
        "choose a machine profile that has it (--machine)");
    return;
  }
  if (!w.has_value && !w.number_text.empty() && marks_.mirror == nullptr) {
    report_.refuse("NUM-028", w.pos, "`" + std::string(text_of(w)) + "`: a sign without a number means nothing here",
                   {}, "block.word");
    return;
  }
  if (!check_literal(w, facts::linear_max)) return;
  auto& c = out_->motion.coords.emplace_back();
  c.axis = axis;
  c.value = axis_value(w, axis);
  c.pos = w.pos;
  if ((settings_.modulo >> axis & 1U) != 0) c.direction = ir::RotaryDirection::by_sign;
}

bool Lowering::take(const Word& w) {
  const int s = slot_of(w.address);
  if (s == slot::letter('G')) {
    code(w);
    return true;
  }
  if (s == slot::letter('M')) {
    machine_function(w);
    return true;
  }
  if (s == slot::letter('N')) {
    if (flow_->label_count == flow_->labels.size())
      unknown(w, "too many block numbers");
    else
      flow_->labels[flow_->label_count++] = &w;
    return true;
  }
  if (s < 0 || s >= 64) {
    unknown(w, "no address of this control, or one that is not carried");
    return false;
  }
  const std::uint64_t bit = std::uint64_t{1} << s;
  if ((present_ & bit) != 0 && !has(slot::e('M'))) {
    report_.refuse("NUM-007", w.pos, "`" + std::string(text_of(w)) + "`: the address stands twice in the block");
    return false;
  }
  present_ |= bit;
  const ir::AxisId axis = s < 26 ? axis_slots[static_cast<std::size_t>(s)] : ir::axis::none;
  if (axis != ir::axis::none) {
    used_ |= bit;
    coordinate(w, axis);
  } else {
    pending_[static_cast<std::size_t>(s)] = &w;
  }
  return true;
}

void Lowering::motion_code(const Word& w, ir::MotionKind kind) {
  if (marks_.motion) {
    report_.refuse("NUM-011", w.pos, "`" + std::string(text_of(w)) + "`: a second motion function in the block");
    return;
  }
  marks_.motion = true;
  auto& m = out_->motion;
  m.kind = kind;
  m.explicit_code = true;
  m.code_pos = w.pos;
  m.code_text = text_of(w);
  state_.motion = kind;
  out_->has_motion = true;
}

void Lowering::code(const Word& w) {
  if (w.number_text == "O" || w.number_text == "o") {
    if (settings_.options.letter_o == dialects::num::LetterO::letter)
      return unknown(w, "the letter O where a number should be");
    report_.warn("NUM-010", w.pos, "`" + std::string(text_of(w)) + "`: the letter O is read as the digit 0",
                 "write G0");
  } else if (has_blank(w.number_text) && joined_digits(w.number_text)) {
    value(w);  // for its warning
  }
  const std::int64_t n = integer(w);
  const facts::GCode* row = n < 0 ? nullptr : facts::g_code(static_cast<double>(n));
  const bool signed_code = row != nullptr && (n == 76 || row->kind == GKind::transform);
  if (!w.has_value && !w.number_text.empty() && !signed_code) row = nullptr;  // a sign after the number
  if (row != nullptr) return code_action(w, *row);
  if (n >= facts::g_macro_first && n <= facts::g_macro_last && macros_.count(n) != 0) {
    if (marks_.macro != nullptr) return unknown(w, "a second macro in the block");
    marks_.macro = &w;
    return;
  }
  if (n >= facts::g_macro_first && n <= facts::g_macro_last) {
    report_.refuse("NUM-003", w.pos,
                   "`" + std::string(text_of(w)) + "` calls the macro %10" + std::to_string(n) + " of the machine",
                   "replace it by what the macro does", "language.macro");
    return;
  }
  report_.refuse("NUM-002", w.pos, "`" + std::string(text_of(w)) + "`: the control has no such function", {},
                 "block.word");
}

void Lowering::setting_code(const Word& w, const facts::GCode& row) {
  switch (row.kind) {
    case GKind::plane:
      state_.plane = static_cast<ir::Plane>(row.value);
      marks_.plane = true;
      return setting(w, ir::Setting::plane, state_.plane);
    case GKind::comp:
      state_.spatial = false;
      return setting(w, ir::Setting::comp, static_cast<ir::CompSide>(row.value));
    case GKind::units:
      marks_.unit = true;
      state_.inch = static_cast<ir::Units>(row.value) == ir::Units::inch;
      return setting(w, ir::Setting::units, static_cast<ir::Units>(row.value));
    case GKind::feed_mode: return setting(w, ir::Setting::feed_mode, static_cast<ir::FeedMode>(row.value));
    default:  // spindle_mode
      if (row.value == facts::u8(ir::SpindleMode::css)) {
        marks_.css = &w;
        marks_.any = true;
      }
      return setting(w, ir::Setting::spindle_mode, static_cast<ir::SpindleMode>(row.value));
  }
}

void Lowering::cycle_off(const Word& w) {
  act(w, Step::setting, ir::CycleCancel{});
  marks_.cycle_off = true;
  state_.cycle = {};
  state_.turning_profile = false;
  state_.stock.reset();
}

void Lowering::code_action(const Word& w, const facts::GCode& row) {
  if (row.machine == facts::GMachine::lathe && !settings_.lathe) {
    report_.refuse("NUM-002", w.pos,
                   "`" + std::string(text_of(w)) + "` (" + std::string(row.title) + ") exists on lathes only",
                   "choose a lathe profile (--machine)", "block.word");
    return;
  }
  const auto mark = [this, &w](const Word*& which) {
    which = &w;
    marks_.any = true;
  };
  const auto missing = [&](std::string_view feature) {
    report_.keep(
        "NUM-004", w.pos,
        "`" + std::string(text_of(w)) + "` (" + std::string(row.title) +
            ") is kept as text, no run and no translation carries it: " + std::string(facts::g_reason(row.code)),
        feature);
  };
  switch (row.kind) {
    case GKind::motion: return motion_code(w, static_cast<ir::MotionKind>(row.value));
    case GKind::plane:
    case GKind::comp:
    case GKind::units:
    case GKind::feed_mode:
    case GKind::spindle_mode: return setting_code(w, row);
    case GKind::distance:
      if (marks_.distance_count == marks_.distances.size()) return unknown(w, "too many changes between G90 and G91");
      marks_.distances[marks_.distance_count++] = &w;
      marks_.any = true;
      return;
    case GKind::dwell: return mark(marks_.dwell);
    case GKind::exact_stop: act(w, Step::special, ir::ExactStopBlock{}); return;
    case GKind::surface: return mark_surface(w, static_cast<ir::Surface>(row.value));
    case GKind::handwheel:
      return leave_out(w, "NUM-034", "(" + std::string(row.title) + ") does not change the path", 1);
    case GKind::tool_axis: return mark(marks_.tool_axis);
    case GKind::three_points: return mark(marks_.three_points);
    case GKind::mirror: return mark(marks_.mirror);
    case GKind::machine_frame: return mark(marks_.machine_frame);
    case GKind::shift: return mark(marks_.shift);
    case GKind::preset: return mark(marks_.preset);
    case GKind::hole_cycle: return mark(marks_.cycle);
    case GKind::retract_sub: return mark(marks_.retract);
    case GKind::interruptible: return mark(marks_.interruptible);
    case GKind::offsets_off: act(w, Step::frame, ir::WorkOffset{{}, true}); return;
    case GKind::offsets_on: act(w, Step::frame, ir::WorkOffset{ir::Value(1), false}); return;
    case GKind::scale_off:
    case GKind::scale_on: return scale(w, row.kind == GKind::scale_on);
    case GKind::call:
    case GKind::jump:
    case GKind::spline:
      if (flow_->code != nullptr) return unknown(w, "a second jump or call in the block");
      flow_->code = &row;
      flow_->word = &w;
      return;
    case GKind::cycle_off: return cycle_off(w);
    case GKind::synchronise:
    case GKind::save_values: return only_text(w, row);
    case GKind::thread_segment: return mark(marks_.thread);
    case GKind::turning_cycle:
      if (facts::missing_feature(row).empty()) return mark(marks_.turning);
      return missing(facts::missing_feature(row));
    case GKind::milling_cycle:
      if (facts::missing_feature(row).empty()) return mark(marks_.cycle);
      return missing(facts::missing_feature(row));
    case GKind::spatial_comp: return mark(marks_.spatial);
    case GKind::transform:
    case GKind::grinding_axis:
    case GKind::lathe_transform:
    case GKind::concatenation: return missing(facts::missing_feature(row));
    case GKind::unknown: break;
  }
}

/// One modal and one other coded M function in a block [4.1]; which those of the builder are only the machine knows.
void Lowering::coded_function(const Word& w) {
  const bool modal = facts::is_modal_coded_m(integer(w));
  ++marks_.coded_m;
  if (modal) ++marks_.modal_coded_m;
  const bool too_many = marks_.coded_m > 2 || marks_.modal_coded_m > 1;
  if (!too_many && (marks_.coded_m < 2 || marks_.modal_coded_m == 1)) return;
  report_.warn("NUM-057", w.pos,
               "`" + std::string(text_of(w)) +
                   (too_many ? "`: one coded M function too many for a block: the control refuses it"
                             : "`: a second coded M function in the block; the control takes two only if one of them "
                               "is modal"),
               "write it in a block of its own");
}

/// An M function that the machine parameters give a program to (13.6): the block, then the program. In that program the
/// function is itself.
bool Lowering::calls_program(const Word& w, std::int64_t code, ir::Order order) {
  const auto found = settings_.m_programs.find(code);
  if (found == settings_.m_programs.end() || found->second == state_.program) return false;
  if (flow_->m_program >= 0) {
    unknown(w, "a second call of a program by an M function in the block");
    return true;
  }
  flow_->m_program = found->second;
  flow_->m_program_after = order == ir::Order::after;
  flow_->m_program_pos = w.pos;
  return true;
}

/// Whether the program of an M function runs before the move or behind it, only M functions that act after a move say.
void Lowering::check_program_call() {
  const bool moves = out_->has_motion && !flow_->m_program_after;
  const bool other = flow_->code != nullptr || flow_->linear_after || flow_->probes || !flow_->preset.empty();
  if (!moves && !other) return;
  report_.refuse("NUM-061", flow_->m_program_pos,
                 "an M function that calls a program beside a " + std::string(moves ? "move" : "jump or call") +
                     ": which comes first is not described",
                 "write it in a block of its own", "language.macro");
}

static bool stops_spindle(const syntax::Block& b) {
  return std::any_of(b.words.begin(), b.words.end(), [](const syntax::Word& w) {
    return (w.address == "M" || w.address == "m") && !w.is_expression && w.number == 5;
  });
}

void Lowering::machine_function(const Word& w) {
  const std::int64_t n = integer(w);
  if (n < 0 || n > facts::m_max) return unknown(w, "no M function");
  const MEntry& m = settings_.m[static_cast<std::size_t>(n)];
  if (calls_program(w, n, m.order)) return;
  const Step step = m.order == ir::Order::after ? Step::after : Step::machine_before;
  const auto put = [&](auto data) { act(w, step, std::move(data), m.order); };
  using machine::MMeaning;
  switch (m.meaning) {
    case MMeaning::stop:
      // M12 lets it turn, and M05 beside it stops it anyway.
      if (n == 0 && settings_.stop_ends_spindle && !stops_spindle(*block_))
        put(ir::SpindleRun{1, ir::SpindleState::off});
      return put(ir::Stop{false});
    case MMeaning::optional_stop: return put(ir::Stop{true});
    case MMeaning::program_end:
    case MMeaning::subprogram_end:
      flow_->end = true;
      flow_->end_text = text_of(w);
      return;
    case MMeaning::spindle_cw: return put(ir::SpindleRun{1, ir::SpindleState::cw});
    case MMeaning::spindle_ccw: return put(ir::SpindleRun{1, ir::SpindleState::ccw});
    case MMeaning::spindle_stop: return put(ir::SpindleRun{1, ir::SpindleState::off});
    case MMeaning::spindle_orient:
      marks_.orient = &w;
      marks_.any = true;
      return;
    case MMeaning::tool_change: return put(ir::ToolChange{});
    case MMeaning::coolant_off: return put(ir::Coolant{ir::CoolantState::off});
    case MMeaning::coolant_flood: return put(ir::Coolant{ir::CoolantState::flood});
    case MMeaning::coolant_mist: return put(ir::Coolant{ir::CoolantState::mist});
    case MMeaning::coolant_second: return put(ir::Coolant{ir::CoolantState::second});
    case MMeaning::gear: return put(ir::SpindleGear{1, m.argument, false});
    case MMeaning::none:
      if (n == 48 || n == 49) {
        return put(ir::ModalSet{ir::Setting::feed_override, facts::u8(n == 48 ? ir::OnOff::on : ir::OnOff::off)});
      }
      break;
    case MMeaning::machine_function: break;
  }
  if (n == 30 && !m.known) {
    report_.warn(
        "NUM-029", w.pos,
        "`" + std::string(text_of(w)) + "` is no program end on this control; read as a function of the machine",
        "write M02, or set num.m30 to end in the machine profile");
  }
  if (n >= 63 && n <= 65) {
    report_.warn("NUM-030", w.pos,
                 "`" + std::string(text_of(w)) +
                     "` gives the commands that follow to another spindle; they are read as of spindle 1");
  }
  if (!facts::is_decoded_m(n)) coded_function(w);
  ir::MachineFunction f;
  f.code = static_cast<std::int32_t>(n);
  put(std::move(f));
}

bool Lowering::words(const syntax::Block& b, const Span& line, std::string_view text, ir::Block& out, Flow& flow) {
  report_.start(line);
  out.clear();
  flow.clear();
  block_ = &b;
  text_ = text;
  out_ = &out;
  flow_ = &flow;
  marks_ = Marks{};
  if (arrivals_ != nullptr) arrive(line.line);
  marks_.distance_before = state_.distance;
  present_ = used_ = 0;
  steps_.clear();
  for (const Word& w : b.words) take(w);
  if (marks_.macro != nullptr && !report_.refused()) {
    macro_words();
  } else if (!report_.refused()) {
    resolve();
  }
  if (flow.m_program >= 0 && !report_.refused()) check_program_call();
  return !report_.refused();
}

}  // namespace cnctrans::frontends::num
