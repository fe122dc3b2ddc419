#include "ir/passes/written_data.h"

#include <algorithm>

#include "base/text.h"
#include "ir/passes/blocks.h"
#include "ir/passes/rewrite.h"

namespace cnctrans::ir::passes {

std::string datum_name(const SystemRef& ref) {
  std::string out = ref.text;
  for (std::size_t i = 0; i < ref.args.size(); ++i) {
    const auto n = constant_value(ref.args[i]);
    out += (i == 0 ? "[" : ",") + (n ? shortest(*n) : std::string("*"));
  }
  return ref.args.empty() ? out : out + "]";
}

std::map<std::string, std::optional<double>> written_data(const Program& program) {
  std::map<std::string, std::optional<double>> out;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&out](const Statement& s) {
      const auto* assign = std::get_if<Assign>(&s.node);
      if (assign == nullptr) return;
      for (const auto& item : assign->items) {
        if (!item.to_system) continue;
        const auto value = constant_value(item.value);
        const auto [it, fresh] = out.emplace(datum_name(item.system), value);
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
