#include "legaliser/data/written_data.h"

#include <algorithm>

#include "base/text.h"
#include "ir/edit/rewrite.h"
#include "ir/edit/search.h"
#include "legaliser/edit/blocks.h"
#include "machine/data_at_rest.h"

namespace cnctrans::ir::passes {

std::string datum_name(const SystemRef& ref) {
  std::string out = ref.text;
  for (std::size_t i = 0; i < ref.args.size(); ++i) {
    const auto n = constant_value(ref.args[i]);
    out += (i == 0 ? "[" : ",") + (n ? shortest(*n) : std::string("*"));
  }
  return ref.args.empty() ? out : out + "]";
}

namespace {

bool may_be_inch(const Program& program, const machine::Profile& source) {
  const auto inch = static_cast<std::uint8_t>(Units::inch);
  return source.power_on.units == Units::inch || any_action(program, [inch](const Action& a) {
           const auto* m = std::get_if<ModalSet>(&a.data);
           return m != nullptr && m->setting == Setting::units && m->value == inch;
         });
}

}  // namespace

std::map<std::string, std::optional<double>> written_data(const Program& program, const machine::Profile& source) {
  std::map<std::string, std::optional<double>> out;
  const bool inch = may_be_inch(program, source);
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* assign = std::get_if<Assign>(&s.node);
      if (assign == nullptr) return;
      for (const auto& item : assign->items) {
        if (!item.to_system) continue;
        const std::string name = datum_name(item.system);
        auto value = constant_value(item.value);
        if (inch && machine::is_length_datum(source, name)) value.reset();
        const auto [it, fresh] = out.emplace(name, value);
        if (!fresh && it->second != value) it->second.reset();
      }
    });
  }
  return out;
}

bool left_out(const SystemRef& ref) {
  return ref.datum == Datum::tool_nose_width;
}

void leave_out_data(Program& program, const LegaliseContext& context) {
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&](Statement& s) {
      auto* assign = std::get_if<Assign>(&s.node);
      if (assign == nullptr) return;
      const auto lost = [&](const Assign::Item& i) {
        return i.to_system && left_out(i.system) && context.target.system_data && !context.target.system_data(i.system);
      };
      const auto it = std::find_if(assign->items.begin(), assign->items.end(), lost);
      if (it == assign->items.end()) return;
      context.diagnostics.warning(
          "TRN-453", s.line.span,
          "the target has no counterpart of " + it->system.text + ", the width of a grooving tool: it is left out",
          "cycles that are written out have its passes; enter it in the tool table of the "
          "target for cycles of its own");
      std::erase_if(assign->items, lost);
      if (assign->items.empty()) settle(s);
    });
  }
}

}  // namespace cnctrans::ir::passes
