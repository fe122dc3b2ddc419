#include "legaliser/technology/offset_tables.h"

#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

void check_offset_tables(Program& program, const LegaliseContext& context) {
  if (!offset_tables_differ(context.source_machine, context.target_machine)) return;
  const bool edges = context.target_machine.policies.tool_offset == machine::ToolOffset::edge;
  bool said = false;  // once a program
  for (const auto& r : program.routines) {
    OffsetNumbers numbers;
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || said) return;
      for (const auto& a : b->actions) {
        if (const auto* t = std::get_if<ToolSelect>(&a.data)) numbers.follow(*t);
      }
      for (const auto& a : b->actions) {
        const auto* o = std::get_if<ToolOffset>(&a.data);
        if (o == nullptr || !numbers.differs(*o) || said) continue;
        said = true;
        context.diagnostics.warning(
            "TRN-392", word_span(s.line.span, a.pos),
            edges ? "offset numbers keep their number, but count otherwise: here the source names a row of its one "
                    "offset table, the target an edge of the tool in force (said once a program)"
                  : "offset numbers keep their number, but count otherwise: here the source names an edge of the tool "
                    "in force, the target a row of its one offset table (said once a program)",
            edges ? "enter the data of the row as the edge of this number of that tool, or change the D numbers"
                  : "enter the data of each edge in the row of its D number, which no other tool may use, or change "
                    "the D numbers");
      }
    });
  }
}

}  // namespace cnctrans::ir::passes
