#include "legaliser/technology/tool_lengths.h"

#include <set>
#include <string>

#include "base/text.h"
#include "ir/analysis/call_graph.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

bool BareTool::follow(const Block& block, const LineInfo& line) {
  if (used_) return false;
  bool changes = false;
  for (const auto& a : block.actions) {
    if (const auto* t = std::get_if<ToolSelect>(&a.data)) {
      given_ = false;
      chosen_ = true;
      chosen_under_ = line.skip_mask;
      changes = changes || t->changes;
    } else if (std::holds_alternative<ToolChange>(a.data)) {
      changes = true;
      if (keeps_ || !chosen_) given_ = false;
    }
  }
  for (const auto& a : block.actions)
    given_ = given_ ||
             ((line.skip_mask == 0 || line.skip_mask == chosen_under_) && std::holds_alternative<ToolOffset>(a.data));
  if (changes && !waiting_ && !given_) change_ = line.span;
  if (changes) waiting_ = true;
  if (given_) waiting_ = false;
  used_ = waiting_ && has_motion(block);
  return used_;
}

namespace {

std::string bare_offset(const machine::Profile& machine) {
  const auto how = machine.policies.tool_bare_offset;
  if (how == machine::ToolBareOffset::table) return "the offset that its tool table has for the tool";
  return how == machine::ToolBareOffset::edge ? "the edge that the machine data name"
                                              : "the offset in force before, or none";
}

/// Warns once a program, where a tool without a D is used. Calls are followed in the order of the text.
class BareTools {
 public:
  BareTools(const Program& program, const LegaliseContext& context)
      : program_(program), context_(context), calls_(program) {
    for (const auto& r : program.routines) {
      BareTool tool(context.source_machine, r.kind != RoutineKind::main);
      follow(r, tool);
    }
  }

 private:
  void follow(const Routine& r, BareTool& tool) {
    open_.insert(&r);
    for_each_statement(r.body, [&](const Statement& s) {
      if (told_) return;
      if (std::holds_alternative<Opaque>(s.node)) tool.forget();
      if (const auto* call = std::get_if<CallRoutine>(&s.node)) return called(*call, tool);
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || !tool.follow(*b, s.line)) return;
      told_ = true;
      tool.tell(context_);
    });
    open_.erase(&r);
  }
  void called(const CallRoutine& call, BareTool& tool) {
    const auto callee = call.computed || call.has_range ? std::nullopt : calls_.index_of(call.routine);
    if (!callee || !tool.waits() || open_.count(&program_.routines[*callee]) != 0) return tool.forget();
    follow(program_.routines[*callee], tool);
  }

  const Program& program_;
  const LegaliseContext& context_;
  const CallGraph calls_;
  std::set<const Routine*> open_;
  bool told_ = false;
};

/// Warns once a program, at the first other plane.
void check_planes(const Program& program, const LegaliseContext& context) {
  const Plane usual = context.source_machine.power_on.plane;
  bool said = false, offset = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || said) return;
      for (const auto& a : b->actions) {
        offset = offset || std::holds_alternative<ToolOffset>(a.data) || std::holds_alternative<ToolSelect>(a.data);
        const auto* set = std::get_if<ModalSet>(&a.data);
        if (said || !offset || set == nullptr || set->setting != Setting::plane ||
            set->value == static_cast<std::uint8_t>(usual))
          continue;
        said = true;
        const bool follows = context.target_machine.policies.tool_length_axis == machine::ToolLengthAxis::plane;
        context.diagnostics.warning(
            "TRN-523", word_span(s.line.span, a.pos),
            follows
                ? "another plane: the length of the tool stays along its axis on the source's machine, on the target's "
                  "it goes to the axis across the plane (said once a program)"
                : "another plane: the length of the tool goes to the axis across the plane on the source's machine, "
                  "on the target's it stays along the axis of the tool (said once a program)",
            "check along which axis the tool stands, and select its axis on the target");
      }
    });
  }
}

}  // namespace

void BareTool::tell(const LegaliseContext& context) const {
  context.diagnostics.warning("TRN-522", change_,
                              "a tool without a D: the source takes " + bare_offset(context.source_machine) +
                                  ", the target " + bare_offset(context.target_machine) +
                                  "; the tool may stand off by its length (said once a program)",
                              "write the D beside the T, D0 for no offset");
}

void check_tool_lengths(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect) return;
  if (bare_offsets_differ(context.source_machine, context.target_machine)) BareTools(program, context);
  if (length_axes_differ(context.source_machine, context.target_machine)) check_planes(program, context);
}

}  // namespace cnctrans::ir::passes
