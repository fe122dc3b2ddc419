// CYCL DEF with its Q parameters, CYCL CALL and M99 (reference 14). A cycle is defined where it is called first, and
// again where the text does not show that the same definition is in force.
#include "backends/heidenhain/cycles.h"
#include "backends/heidenhain/tables.h"
#include "backends/heidenhain/writer.h"

namespace cnctrans::backends::heidenhain {

namespace facts = dialects::heidenhain;

std::string Writer::q_line(std::int16_t cycle, std::int16_t number, const ir::Value& value, WordPos pos) {
  constexpr std::size_t width = 8;
  std::string text = "Q" + std::to_string(number) + '=';
  std::string amount = signed_amount(value, pos);
  amount.resize(std::max(amount.size(), width), ' ');
  text += amount;
  const auto* row = facts::find_q_word(number, cycle);
  return row != nullptr && !row->text.empty() ? text + " ;" + std::string(row->text) : text;
}

/// `call`: the statement that runs it.
std::string Writer::definition(const ir::Statement& call, const ir::CycleDefine& d) {
  const auto* hole = std::get_if<ir::HoleCycle>(&d.cycle->node);
  const ir::Facts* f = facts_before(call);
  const bool per_minute = f == nullptr || f->settings[static_cast<std::size_t>(ir::Setting::feed_mode)] ==
                                              code_value(ir::FeedMode::per_minute);
  const auto feed = f != nullptr && f->feed && per_minute ? std::optional(*f->feed) : std::nullopt;
  const auto text = hole != nullptr ? cycle_text(*hole, ir::Value(feed.value_or(1))) : std::nullopt;
  if (!text) {
    refuse(no_cycle, {}, "this cycle is not one of this control's", "use --cycles=explode");
    return {};
  }
  const bool own = hole->has_feed || hole->kind == ir::HoleKind::mill;
  if (!feed && !own && facts::find_parameter(*text->row, 206) != nullptr) {
    refuse(no_cycle, {}, "a cycle names its feed here, and which F is in force is not known",
           "write F before the cycle on every path, or use --cycles=explode");
    return {};
  }
  std::string out = "CYCL DEF " + std::to_string(text->row->number) + ' ' + std::string(text->row->title);
  for (const auto& p : text->row->parameters) {
    if (p.number == 0) continue;
    const auto at = text->values.find(p.number);
    const ir::Value value = at != text->values.end() ? at->second : ir::Value(p.fallback);
    out += " ~\n  " + q_line(text->row->number, p.number, value, {});
  }
  return out;
}

/// On a line of its own, where it is not in force already.
void Writer::define_cycle(const ir::Statement& call, const ir::CycleDefine& d) {
  std::string text = definition(call, d);
  if (refused() || text == defined_) return;
  defined_ = text;
  add(std::move(text), Rank::head);
  next_line();
}

void Writer::spindle_again(const ir::CycleDefine& d) {
  const auto* hole = std::get_if<ir::HoleCycle>(&d.cycle->node);
  if (const int code = hole != nullptr ? spindle_after(*hole) : 0; code != 0) {
    next_line();
    add(m_word(code), Rank::machine);
  }
}

void Writer::cycle_define(const ir::Action& a, const ir::CycleDefine& c) {
  if (!c.cycle || c.modal || !c.here) return ProgramWriter::cycle_define(a, c);
  if (plan_.is_called(current())) return;
  define_cycle(current(), c);
  const auto* hole = std::get_if<ir::HoleCycle>(&c.cycle->node);
  if (hole != nullptr && hole->has_speed) own_speed(*hole);
  if (refused()) return;
  if (side_) {  // it begins or ends before the cycle runs
    add(take_waiting(), Rank::head);
    next_line();
  }
  add("CYCL CALL", Rank::head);
  spindle_again(c);
}

/// Says the speed of a tap where another one may be in force; it stays behind the tap.
void Writer::own_speed(const ir::HoleCycle& c) {
  const ir::Facts* f = facts();
  if (f != nullptr && f->spindle == c.speed.number) return;
  add("TOOL CALL S" + amount(c.speed, {}), Rank::head);
  next_line();
}

/// Nothing is modal here: the end of a cycle needs no word.
void Writer::cycle_cancel(const ir::Action& /*a*/) {}

}  // namespace cnctrans::backends::heidenhain
