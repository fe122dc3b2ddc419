#include "legaliser/data/given_data.h"

#include <algorithm>
#include <set>

#include "base/text.h"
#include "ir/edit/rewrite.h"
#include "ir/frame_rows.h"

namespace cnctrans::ir::passes {

namespace {

/// The datum with a fixed index as a program writes it: PLCM12, $A_IN[3].
struct Spelling {
  std::string name;   ///< without its index
  std::string index;  ///< empty: none
};

std::optional<Spelling> spelled(const SystemRef& ref, const Program& program) {
  Spelling s{to_upper_ascii(ref.text), {}};
  if (ref.axis != axis::none && ref.args.empty() && !s.name.ends_with(program.axis_name(ref.axis)))
    s.index = program.axis_name(ref.axis);
  const bool one = ref.datum == Datum::active_modal || ref.datum == Datum::spindle_state;  // its code, then what it is
  for (std::size_t i = 0; i < (one ? std::min<std::size_t>(ref.args.size(), 1) : ref.args.size()); ++i) {
    const auto n = constant_value(ref.args[i]);
    if (!n) return std::nullopt;
    s.index += (s.index.empty() ? "" : ",") + shortest(*n);
  }
  return s;
}

class GivenData {
 public:
  GivenData(Program& program, const LegaliseContext& context) : program_(program), context_(context) {}

  void statement(Statement& s) {
    StatementVisitor visit;
    visit.expression = [&](const ExprPtr& e) {
      return map_expr(e, [&](const ExprPtr& x) {
        const auto* ref = std::get_if<SystemRef>(&x->node);
        const auto own = ref != nullptr ? place_of(*ref, s) : std::nullopt;
        if (!own) return x;
        Expr named = *x;
        named.node = *own;
        return std::make_shared<const Expr>(std::move(named));
      });
    };
    visit_statement(s, visit);
    auto* a = std::get_if<Assign>(&s.node);
    if (a == nullptr) return;
    for (auto& i : a->items) {
      if (!i.to_system) continue;
      if (const auto own = place_of(i.system, s)) i.system = *own;
    }
  }

 private:
  std::optional<SystemRef> place_of(const SystemRef& ref, const Statement& s) {
    if (has_name(ref, context_)) return std::nullopt;
    const auto text = name_given_to(ref, program_, *context_.names);
    if (!text) return std::nullopt;
    if (told_.insert(name_of_datum(ref, program_)).second) tell(name_of_datum(ref, program_), *text, s);
    SystemRef given;
    given.text = *text;
    given.given = true;
    return given;
  }
  void tell(const std::string& from, const std::string& to, const Statement& s) const {
    context_.diagnostics.note("TRN-560", s.line.span,
                              from + " is written as " + to + ": the map of names says what stands for it",
                              "check that the target's machine gives " + to + " the meaning of " + from);
    if (context_.report == nullptr) return;
    context_.report->renamed.push_back({Renamed::Kind::variable, from, to, std::string(given_data_mark)});
  }

  Program& program_;
  const LegaliseContext& context_;
  std::set<std::string> told_;
};

bool holds_base_frame(const SystemRef& ref) {
  const auto row = ref.datum == Datum::frame_settable && !ref.args.empty() ? constant_value(ref.args[0]) : std::nullopt;
  return row && *row >= frame_rows::first;
}

}  // namespace

std::string name_of_datum(const SystemRef& ref, const Program& program) {
  if (ref.text.empty()) return std::string(name(ref.datum));
  const auto s = spelled(ref, program);
  if (!s || holds_base_frame(ref)) return ref.text;  // the row is a number of ours
  return s->index.empty() ? s->name : s->name + '[' + s->index + ']';
}

/// A row of the work offsets that the target lacks: place_missing_offsets() gives it variables, or refuses it.
static bool is_placed_later(const SystemRef& ref, const Capabilities& target) {
  const auto row = ref.args.size() == 1 ? constant_value(ref.args[0]) : std::nullopt;
  if (ref.datum != Datum::work_offset || target.work_offset_rows != 1 || !row || *row <= 1 || !target.data_form)
    return false;
  SystemRef only = ref;
  only.args[0] = number(1);
  const auto own = target.data_form(only);
  return own && own->writable;
}

bool has_name(const SystemRef& ref, const LegaliseContext& context) {
  const auto& target = context.target;
  if (is_placed_later(ref, target)) return true;
  if (ref.given || (target.system_data && target.system_data(ref))) return true;
  const auto own = target.data_form ? target.data_form(ref) : std::nullopt;  // it is written with that name later on
  return own && own->writable;
}

std::optional<std::string> name_given_to(const SystemRef& ref, const Program& program, const NameMap& names) {
  const auto s = spelled(ref, program);
  if (!s) return std::nullopt;
  for (const std::string& key : {s->name + s->index, s->name + '[' + s->index + ']'}) {
    if (const auto it = names.data.find(key); it != names.data.end()) return it->second;
  }
  const auto any = s->index.empty() ? names.data.end() : names.data.find(s->name + "[*]");
  if (any == names.data.end()) return std::nullopt;
  std::string text = any->second;
  if (const auto star = text.find('*'); star != std::string::npos) text.replace(star, 1, s->index);
  return text;
}

void name_given_data(Program& program, const LegaliseContext& context) {
  if (context.names == nullptr || context.names->data.empty() || program.dialect == context.target.dialect) return;
  GivenData pass(program, context);
  for (auto& r : program.routines) for_each_statement(r.body, [&pass](Statement& s) { pass.statement(s); });
}

std::vector<std::string> given_data(const LegaliseReport& report) {
  std::vector<std::string> out;
  for (const auto& r : report.renamed) {
    if (r.routine == given_data_mark) out.push_back(r.from);
  }
  return out;
}

}  // namespace cnctrans::ir::passes
