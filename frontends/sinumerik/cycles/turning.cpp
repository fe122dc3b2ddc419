// Turning cycles: CYCLE95, CYCLE97, CYCLE98 (reference-language 18.4).
#include <algorithm>
#include <memory>
#include <string>

#include "base/text.h"
#include "dialects/sinumerik/assumed.h"
#include "dialects/sinumerik/cycles.h"
#include "dialects/sinumerik/turning.h"
#include "frontends/sinumerik/cycles/cycle_arguments.h"
#include "frontends/sinumerik/state/statements.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

namespace {

/// A label as a contour names it: an identifier, or N with digits.
ir::Value label_value(std::string_view text) {
  const std::string name = to_upper_ascii(std::string(text));
  const bool number = name.size() > 1 && name.size() < 10 && name[0] == 'N' &&
                      std::all_of(name.begin() + 1, name.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (number) return ir::Value(static_cast<double>(std::stol(name.substr(1))));
  return ir::Value(ir::string_literal(name));
}

}  // namespace

void warn_of_assumptions(const std::string& name, FileContext& c, WordPos pos) {
  const AssumedCycle* cycle = assumed_cycle(name);
  if (cycle == nullptr) return;
  std::string taken;
  for (const auto& point : cycle->points) {
    if (point.option.empty() || c.machine.profile->options.contains(std::string(point.option))) continue;
    taken += (taken.empty() ? "" : "; ") + std::string(point.text) + " (" + std::string(point.option) + ')';
  }
  if (taken.empty()) return;
  c.warning(cycle->code, pos,
            "the maker's manual leaves parts of " + name + " open, and the profile does not say them; taken: " + taken);
}

void contour_words(const std::string& text, std::vector<std::pair<std::string, ir::Value>>& words) {
  const auto colon = text.find(':');
  if (colon == std::string::npos) {
    words.emplace_back("routine", ir::Value(ir::string_literal(to_upper_ascii(text))));
    return;
  }
  words.emplace_back("first_label", label_value(trim(std::string_view(text).substr(0, colon))));
  words.emplace_back("last_label", label_value(trim(std::string_view(text).substr(colon + 1))));
}

ir::CyclePtr StatementLowering::turning(const std::string& name, const std::vector<Expr>& args, WordPos pos) {
  const CycleRow& row = *sinumerik::cycle(name);
  const TurningCycle& cycle = *turning_cycle(name);
  const std::uint32_t before = c_.errors;
  ir::NamedCycle out;
  out.name = std::string(cycle.cycle);
  const auto at = [&](std::string_view parameter) -> const Expr* {
    const int i = parameter_index(row, parameter);
    if (i < 0 || static_cast<std::size_t>(i) >= args.size()) return nullptr;
    const Expr& e = args[static_cast<std::size_t>(i)];
    return e.kind == ExprKind::missing ? nullptr : &e;
  };
  for (std::string_view rest = cycle.needs; !rest.empty();) {
    const auto comma = std::min(rest.find(','), rest.size());
    const std::string parameter(rest.substr(0, comma));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    if (at(parameter) == nullptr) c_.error("SIN-021", pos, name + " needs its parameter " + parameter);
  }
  if (const Expr* e = at(contour_parameter)) {
    if (e->kind != ExprKind::string || trim(e->text).empty())
      c_.error("SIN-021", e->pos, "the contour of " + name + " is a fixed name, or two labels with a colon");
    else
      contour_words(e->text, out.words);
  }
  for (const auto& [own, neutral] : cycle.parameters) {
    const Expr* e = own.empty() ? nullptr : at(own);
    if (e == nullptr) continue;
    if (own == form_parameter || e->kind == ExprKind::string) {
      const std::string text = e->kind == ExprKind::string ? std::string(e->text) : std::string();
      if (own == form_parameter && (text.size() != 1 || text[0] < 'A' || text[0] > 'Z'))
        c_.error("SIN-021", e->pos, "the form of " + name + " is one fixed capital letter");
      else if (own == form_parameter)
        out.words.emplace_back(std::string(neutral), ir::Value(static_cast<double>(text[0])));
      else if (text.empty())
        out.words.emplace_back(std::string(neutral), ir::Value(ir::string_literal(text)));
      else
        c_.error("SIN-021", e->pos, name + " with " + std::string(own) + " is not carried yet");
      continue;
    }
    Attribute attribute = Attribute::none;
    out.words.emplace_back(std::string(neutral), exprs_.value_of(*e, attribute));
    if (attribute != Attribute::none)
      c_.error("SIN-012", e->pos, "AC() and IC() have no meaning in the call of a cycle");
  }
  const Expr* side = at("VARI");
  const bool by_tool = parameter_index(row, form_parameter) >= 0 && parameter_index(row, "LAGE") < 0 &&
                       (side == nullptr || (side->kind == ExprKind::number && side->number == 0));
  const auto& tools = c_.machine.profile->tools;
  if (by_tool && std::none_of(tools.begin(), tools.end(), [](const auto& t) { return t.nose >= 1 && t.nose <= 4; }))
    c_.warning("SIN-021", pos,
               "the side of the undercut follows from the edge of the tool, and no tool of the machine has one "
               "(\"nose\"): it is taken outside (forms C and D inside), the shoulder toward -Z");
  if (c_.errors != before) return nullptr;
  warn_of_assumptions(name, c_, pos);
  auto made = std::make_shared<ir::Cycle>();
  made->node = std::move(out);
  return made;
}

}  // namespace cnctrans::sinumerik
