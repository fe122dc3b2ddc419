// Rows of a tool table as edges of tools (equivalences 15): where one control keeps the data of an offset in one table
// for all tools and the other beside each tool, the data of row n become those of edge n of the tool that the program
// uses with it.
#include <map>
#include <optional>
#include <set>

#include "base/text.h"
#include "ir/edit/search.h"
#include "legaliser/analysis/words.h"
#include "legaliser/early_passes.h"
#include "legaliser/technology/offset_tables.h"

namespace cnctrans::ir::passes {

namespace {

/// The tool that each offset of the program belongs to, as far as the order of the text tells it.
class RowTools {
 public:
  explicit RowTools(const Program& program) {
    for (const auto& r : program.routines) {
      selected_.reset();
      in_use_.reset();
      for_each_statement(r.body, [this](const Statement& s) {
        if (const auto* b = std::get_if<Block>(&s.node)) block(*b);
      });
    }
  }

  /// The one tool of the offset; nullopt: none, several, or one that is not known.
  [[nodiscard]] std::optional<double> tool(double row) const {
    const auto at = tools_.find(row);
    if (unclear_ || at == tools_.end() || at->second.size() != 1 || *at->second.begin() < 0) return std::nullopt;
    return *at->second.begin();
  }

 private:
  void block(const Block& b) {
    bool changes = false;
    for (const auto& a : b.actions) {
      if (const auto* t = std::get_if<ToolSelect>(&a.data)) {
        const bool number = t->name.empty() && t->number.literal();
        selected_ = number ? std::optional(t->number.number) : std::optional(-1.0);
      }
      changes = changes || std::holds_alternative<ToolChange>(a.data);
    }
    if (changes) in_use_ = selected_;
    for (const auto& a : b.actions) {
      const auto* o = std::get_if<ToolOffset>(&a.data);
      if (o == nullptr || o->number.is(0)) continue;
      if (!o->number.literal()) {
        unclear_ = true;
        continue;
      }
      // A tool that waits for its change: the offset may be that of either.
      const bool waits = in_use_ && selected_ != in_use_;
      tools_[o->number.number].insert(selected_ && !waits ? *selected_ : -1.0);
    }
  }

  std::map<double, std::set<double>> tools_;  ///< of each row; -1: one that is not known
  std::optional<double> selected_, in_use_;   ///< nullopt: nothing in this routine says it
  bool unclear_ = false;                      ///< an offset is computed
};

/// The radius of the row in use is that of the tool in use.
bool is_active_radius(const SystemRef& ref) {
  const auto* row = ref.datum == Datum::tool_radius && ref.args.size() == 1 && ref.args[0]
                        ? std::get_if<SystemRef>(&ref.args[0]->node)
                        : nullptr;
  return row != nullptr && row->datum == Datum::offset_number;
}

bool is_table_datum(const SystemRef& ref) {
  return (ref.datum == Datum::tool_radius || ref.datum == Datum::tool_length) && ref.args.size() == 1;
}

}  // namespace

void name_tool_rows(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || !context.target.system_data ||
      !offset_tables_differ(context.source_machine, context.target_machine) ||
      context.target_machine.policies.tool_offset != machine::ToolOffset::edge)
    return;
  const RowTools tools(program);
  const auto edge = [&](SystemRef& ref) {
    const bool active = is_active_radius(ref);
    const auto row = is_table_datum(ref) ? constant_value(ref.args[0]) : std::nullopt;
    const auto tool = row ? tools.tool(*row) : std::nullopt;
    if (!tool && !active) return false;
    SystemRef named = ref;
    if (active)
      named.args.clear();
    else
      named.args.insert(named.args.begin(), number(*tool));
    if (!context.target.system_data(named)) return false;
    ref = std::move(named);
    return true;
  };
  for (auto& r : program.routines) {
    std::set<double> chosen;  // offsets selected above
    for_each_statement(r.body, [&](Statement& s) {
      StatementVisitor visit;
      visit.expression = [&](const ExprPtr& e) {
        return map_expr(e, [&](const ExprPtr& x) {
          const auto* ref = std::get_if<SystemRef>(&x->node);
          if (ref == nullptr || !is_table_datum(*ref)) return x;
          Expr copy = *x;
          return edge(std::get<SystemRef>(copy.node)) ? std::make_shared<const Expr>(std::move(copy)) : x;
        });
      };
      visit_statement(s, visit);
      if (const auto* b = std::get_if<Block>(&s.node)) {
        const auto* o = action_in<ToolOffset>(*b);
        if (o != nullptr && o->number.literal()) chosen.insert(o->number.number);
      }
      auto* a = std::get_if<Assign>(&s.node);
      if (a == nullptr) return;
      for (auto& item : a->items) {
        if (!item.to_system || !edge(item.system)) continue;
        const auto row = constant_value(item.system.args[1]);
        if (!row || chosen.count(*row) == 0) continue;
        context.diagnostics.warning("TRN-550", s.line.span,
                                    "the data of offset D" + shortest(*row) +
                                        " change below its selection: on the target they count from the next D on",
                                    "select the offset again behind it");
      }
    });
  }
}

}  // namespace cnctrans::ir::passes
