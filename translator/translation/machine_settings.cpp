#include "translator/translation/machine_settings.h"

#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "base/text.h"
#include "ir/edit/rewrite.h"
#include "machine/data_at_rest.h"
#include "translator/files/given_names.h"

namespace cnctrans::translator {

namespace {

/// "$MN_USER_DATA_INT[7]", "$MA_MAX_AX_VELO[AX6]"; nullopt: an index is computed.
std::optional<std::string> spelled_setting(const ir::SystemRef& ref) {
  std::string text = to_upper_ascii(ref.text);
  for (std::size_t i = 0; i < ref.args.size(); ++i) {
    const auto number = ir::constant_value(ref.args[i]);
    const auto* name = std::get_if<ir::String>(&ref.args[i]->node);
    if (!number && name == nullptr) return std::nullopt;
    text += (i == 0 ? "[" : ",") + (number ? shortest(*number) : name->text);
  }
  return ref.args.empty() ? text : text + ']';
}

std::set<std::string> written_names(const ir::Program& program) {
  std::set<std::string> names;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&names](const ir::Statement& s) {
      const auto* a = std::get_if<ir::Assign>(&s.node);
      if (a == nullptr) return;
      for (const auto& i : a->items) {
        if (i.to_system) names.insert(i.system.text);
      }
    });
  }
  return names;
}

}  // namespace

void settings_as_variables(ir::Program& program, const Dialect& from, const machine::Profile& machine,
                           const std::map<std::string, std::string>* placed, Diagnostics& diagnostics) {
  const auto space = global_numbers(program);
  if (from.is_setting == nullptr || !space || program.routines.empty()) return;
  const auto written = written_names(program);
  std::map<std::string, double> values;
  ir::Body head;
  const auto variable = [&](const ir::ExprPtr& x, const Span& where) {
    const auto* ref = std::get_if<ir::SystemRef>(&x->node);
    const bool setting = ref != nullptr && ref->datum == ir::Datum::other && x->type != ir::Type::string &&
                         from.is_setting(to_upper_ascii(ref->text)) && !written.contains(ref->text);
    const auto name = setting ? spelled_setting(*ref) : std::nullopt;
    if (!name || answered(*name, placed)) return x;
    if (!values.contains(*name)) {
      const auto value = machine::value_of_data(machine, *name);
      if (!value) return x;
      values.emplace(*name, *value);
      machine::Profile said = machine;
      machine::forget_data_at_rest(said);
      if (machine::value_of_data(said, *name)) {
        diagnostics.note("TRN-465", where,
                         *name + " is " + shortest(*value) +
                             " by the profile of the source's machine: "
                             "a variable that the head sets stands for it");
      } else {
        diagnostics.warning("TRN-465", where,
                            "nobody says what " + *name + " is on the source's machine: it counts as " +
                                shortest(*value) + ", in a variable that the head sets",
                            "put the value into \"data\" of the machine profile, or change it at the head");
      }
      ir::Declare d;
      d.space = *space;
      d.items.push_back({*name, {}, {ir::number(*value)}});
      ir::Statement made;
      made.line.span = where;
      made.node = std::move(d);
      head.push_back(std::move(made));
    }
    ir::Expr copy = *x;
    copy.node = ir::VarRef{*space, *name, nullptr, {}};
    return ir::ExprPtr(std::make_shared<const ir::Expr>(std::move(copy)));
  };
  for (auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](ir::Statement& s) {
      const Span where = s.line.span;
      ir::passes::visit_statement(s, {[&](const ir::ExprPtr& e) {
                                        return ir::passes::map_expr(
                                            e, [&](const ir::ExprPtr& x) { return variable(x, where); });
                                      },
                                      {}});
    });
  }
  if (head.empty()) return;
  auto& body = program.routines[head_routine(program)].body;
  body.insert(body.begin(), std::make_move_iterator(head.begin()), std::make_move_iterator(head.end()));
  ir::number_statements(program);
}

}  // namespace cnctrans::translator
