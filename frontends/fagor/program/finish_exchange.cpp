#include <cctype>
#include <string>

#include "base/text.h"
#include "dialects/fagor/axis_exchange.h"
#include "frontends/fagor/program/finish_parts.h"

namespace cnctrans::fagor {

namespace {

constexpr std::string_view exchange_fault = "FAG-051";

/// The words of the block as written: without skip marks, label and comment.
std::string words_of(const ir::Program& program, const Span& where) {
  const SourcePtr source = program.files.empty() ? nullptr : program.texts->source(program.files[0].name);
  if (!source) return {};
  std::string_view text = source->line_text(where.line);
  text = trim(text.substr(0, text.find(';')));
  const auto skip_digits = [&text] {
    while (!text.empty() && text.front() >= '0' && text.front() <= '9') text.remove_prefix(1);
    text = trim(text);
  };
  while (!text.empty() && text.front() == '/') {
    text.remove_prefix(1);
    skip_digits();
  }
  if (!text.empty() && (text.front() == 'N' || text.front() == 'n')) {
    text = trim(text.substr(1));
    skip_digits();
  }
  return std::string(text);
}

/// The block as text; a run stops there.
void keep(ir::Program& program, ir::Statement& s, std::string feature) {
  s.node = ir::Opaque{words_of(program, s.line.span), std::move(feature), false};
}

void refuse(ir::Program& program, LowerState& state, ir::Statement& s, ir::passes::ExchangeFault fault) {
  using ir::passes::ExchangeFault;
  state.set_line(s.line.span);
  switch (fault) {
    case ExchangeFault::unsure:
      state.warning(
          exchange_fault, {},
          "whether axes are exchanged (G28, G29) depends on the way that leads here; the block is kept as text",
          "a run stops here; write G29 with the axis before the block");
      return keep(program, s, "language.synchronised");
    case ExchangeFault::not_said:
      state.warning(
          exchange_fault, {},
          "arcs, angles, cycles, offsets and compensation with exchanged axes (G28) are not carried; the block "
          "is kept as text",
          "a run stops here; write the block with the axes that move, behind G29");
      return keep(program, s, "language.synchronised");
    case ExchangeFault::twice:
      state.error(exchange_fault, {}, "an axis that is exchanged already [1029]", "write G29 with the axis before it");
      return;
    case ExchangeFault::outside:
      state.warning(
          exchange_fault, {},
          "a subroutine of another file is called while axes are exchanged (G28): its words are read as those of "
          "the axes that they name",
          "write G29 with the axis before the call");
      return;
  }
}

/// Signs of rotary words mean a direction on a rollover axis; words of an axis that the machine lacks move nothing.
void settle(ir::Program& program, LowerState& state, ir::Statement& s) {
  auto& m = std::get<ir::Block>(s.node).motion;
  for (auto& w : m.coords) {
    if (!state.has_axis(w.axis)) {
      state.set_line(s.line.span);
      state.warning(exchange_fault, w.pos,
                    "the machine has no axis " + std::string(ir::fixed_axis_name(w.axis)) +
                        ", which this word moves after G28; the block is kept as text",
                    "a run stops here; choose a machine profile that has the axis");
      return keep(program, s, "machine.axis");
    }
    w.direction =
        ir::is_rotary_letter(w.axis) && state.rollover() ? ir::RotaryDirection::by_sign : ir::RotaryDirection::as_value;
  }
}

}  // namespace

void resolve_exchanges(ir::Program& program, LowerState& state) {
  if (!state.facts.axes_exchanged) return;
  ir::passes::exchange_axes(
      program, dialects::fagor::axis_exchange,
      [&](ir::Statement& s, ir::passes::ExchangeFault fault) { refuse(program, state, s, fault); },
      [&](ir::Statement& s) { settle(program, state, s); });
}

}  // namespace cnctrans::fagor
