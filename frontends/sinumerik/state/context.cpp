#include "frontends/sinumerik/state/context.h"

#include "base/saturate.h"
#include "base/text.h"

namespace cnctrans::sinumerik {

MachineFacts::MachineFacts(const machine::Profile& p) : profile(&p), options(options_of(p)), geometry(p) {
  axis_of.fill(ir::axis::none);
  for (const auto& a : p.axes) {
    if (a.name.size() == 1 && a.name[0] >= 'A' && a.name[0] <= 'Z')
      axis_of[static_cast<std::size_t>(a.name[0] - 'A')] = a.id;
  }
  for (const auto& a : p.axes) rotary[a.id] = a.rotary;
  for (const auto& m : p.m_codes) {
    if (m.code >= 0 && m.code < m_limit) m_codes[static_cast<std::size_t>(m.code)] = &m;
  }
  r_count = saturate<std::int32_t>(p.policies.numbered_variables);
}

ir::AxisId MachineFacts::axis(char letter) const {
  const char capital = letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
  return capital >= 'A' && capital <= 'Z' ? axis_of[static_cast<std::size_t>(capital - 'A')] : ir::axis::none;
}

ir::AxisId MachineFacts::axis(std::string_view name) const {
  if (name.size() == 1) return axis(name[0]);
  for (const auto& a : profile->axes) {
    if (a.name == name) return a.id;
  }
  return ir::axis::none;
}

void TextState::may_be_left_out(const TextState& before) {
  units_called = units_called || units_by_text != before.units_by_text;
  words_in_inches = words_in_inches || before.words_in_inches;
  thread_start.join(before.thread_start);
  corner_feed.join(before.corner_feed);
  speed_limit.join(before.speed_limit);
  css_limit.join(before.css_limit);
  const auto same = [](auto& value, const auto& other) {
    if (value != other) value.reset();
  };
  same(plane, before.plane);
  same(css, before.css);
  same(per_rev, before.per_rev);
  same(inclined, before.inclined);
  same(carrier.chosen, before.carrier.chosen);
  carrier.unsure = carrier.unsure || carrier.data != before.carrier.data;
  if (tool.state != before.tool.state || tool.vector != before.tool.vector) tool.state = ToolDirection::State::unsure;
}

void FileContext::beyond_r_parameters(WordPos pos) {
  if (!first_time("R parameters")) return;
  warning("SIN-050", pos,
          "the machine " + machine.profile->name + " has the parameters R0 to R" + std::to_string(machine.r_count - 1) +
              " only",
          "set the option sinumerik.r_count of the machine profile (MD28050)");
}

void FileContext::error(std::string_view code, WordPos pos, std::string message, std::string hint) {
  ++errors;
  diagnostics.error(code, word_span(line, pos), std::move(message), std::move(hint));
}
void FileContext::keep(std::string_view code, WordPos pos, std::string message, std::string hint) {
  ++errors;
  ++kept;
  if (hint.empty()) hint = "the block is kept as text; a run or a translation that comes here stops";
  diagnostics.warning(code, word_span(line, pos), std::move(message), std::move(hint));
}
void FileContext::warning(std::string_view code, WordPos pos, std::string message, std::string hint) {
  diagnostics.warning(code, word_span(line, pos), std::move(message), std::move(hint));
}
void FileContext::note(std::string_view code, WordPos pos, std::string message, std::string hint) {
  diagnostics.note(code, word_span(line, pos), std::move(message), std::move(hint));
}

/// G26 limits every speed of the spindle, LIMS= the one that follows from a cutting speed.
ir::Value FileContext::lower_limit(LastingWord& own, LastingWord& other, const ir::Value& value, WordPos pos) {
  const bool missed = own.set(value);
  const auto state = other.ask();
  if (state == LastingWord::State::none && !missed) return value;
  if (state == LastingWord::State::known && value.literal())
    return value.number <= other.value() ? value : ir::Value(other.value());
  warning(
      "SIN-091", pos,
      "G26 S and LIMS= limit the speed together, and the text does not tell both as numbers here: this one is taken "
      "as the limit, also where the other one is lower",
      "write both limits one behind the other, as numbers");
  return value;
}

ir::Value FileContext::millimetres(const ir::Value& mm, std::string_view what, std::string_view word, WordPos pos) {
  if (mm.is(0)) return mm;
  if (units_by_text && units_called) {  // what the called program leaves in force decides
    ir::SystemRef inch;
    inch.datum = ir::Datum::active_modal;
    inch.text = "$P_GG";
    inch.args = {ir::number(700), ir::number(static_cast<double>(ir::Setting::units)),
                 ir::number(static_cast<double>(ir::Units::inch))};
    auto in_force = std::make_shared<ir::Expr>();
    in_force->node = std::move(inch);
    const ir::Value less = ir::scale(mm, 1 / 25.4 - 1);
    return ir::Value(ir::binary(ir::BinaryOp::add, ir::as_expr(mm),
                                ir::binary(ir::BinaryOp::multiply, ir::as_expr(less), std::move(in_force))));
  }
  if (units_by_text) return ir::scale(mm, *units_by_text == ir::Units::inch ? 1 / 25.4 : 1);
  warning("SIN-080", pos,
          std::string(what) + ", and this subprogram does not say its units: it is taken to be called in millimetres",
          "write " + std::string(word) + ", or G71 (G710) or G70 (G700) before the cycle");
  return mm;
}

const CycleRow* FileContext::cycle_called(std::string_view capitals, WordPos pos) {
  const CycleRow* row = sinumerik::cycle(capitals);
  if (row == nullptr || !has_program || !has_program(capitals)) return row;
  if (first_time("cycle " + std::string(capitals)))
    warning("SIN-143", pos,
            "a program " + std::string(capitals) +
                " is there: it is called, not the control's cycle of this name, which is searched last",
            "give the program another name if the cycle is meant");
  return nullptr;
}

std::string_view FileContext::slice(WordPos pos) const {
  if (pos.column == 0 || pos.column > text.size()) return {};
  return text.substr(pos.column - 1, pos.length);
}

}  // namespace cnctrans::sinumerik
