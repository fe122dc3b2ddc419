// Well-formedness of statements, routines and the program: what every reader and every pass must leave behind.
#include "ir/check/well_formed.h"

#include <set>
#include <utility>

#include "ir/edit/labels.h"
#include "ir/fields_statement.h"
#include "ir/nesting.h"
#include "ir/text/enum_names.h"
#include "ir/text/text.h"

namespace cnctrans::ir {
namespace detail {
namespace {

bool is_condition(Type t) {
  return t == Type::real || t == Type::integer || t == Type::boolean;
}

/// A visitor of fields(): everything that is looked at wherever it stands.
class Checker {
 public:
  Checker(const Program& program, Diagnostics& diagnostics) : report_{program, diagnostics, {}} {}

  void check();

  // --- visitor of fields() ---
  void word(std::string_view) {}
  void item(std::string_view, const ExprPtr& e) { check_expression(e, report_); }
  template <class T>
  void item(std::string_view, const T& x) {
    look(x);
  }
  template <class T, class D = T>
  void opt(std::string_view, const T& x, const D& = D{}) {
    look(x);
  }
  template <class E>
  void bare(std::string_view, E, E) {}
  void flag(std::string_view, bool) {}
  void flag_off(std::string_view, std::string_view, bool) {}
  template <class T>
  void given(std::string_view, bool has, const T& x) {
    if (has) look(x);
  }
  void axis(std::string_view, AxisId id) { check_axis(id, report_); }
  void axis_opt(std::string_view, AxisId id) {
    if (id != axis::none) check_axis(id, report_);
  }
  void pos(WordPos) {}
  void place(std::string_view, WordPos) {}
  void quoted(std::string_view, std::string_view) {}
  void code(bool, std::string_view) {}
  template <class T>
  void words(std::string_view, const std::vector<T>& list) {
    std::set<AxisId> seen;
    for (const auto& x : list) {
      if (!seen.insert(x.axis).second) report_.error("IR-032", "an axis has two words in one block");
      look(x);
    }
  }
  template <class T>
  void each(std::string_view, const std::vector<T>& list) {
    for (const auto& x : list) look(x);
  }
  void exprs(std::string_view, const std::vector<ExprPtr>& list) {
    for (const auto& e : list) check_expression(e, report_);
  }
  void pairs(std::string_view, const std::vector<std::pair<std::string, Value>>& list) {
    for (const auto& [key, x] : list) look(x);
  }
  template <class T>
  void group(std::string_view, const T& x) {
    look(x);
  }
  template <class P>
  void pointer(std::string_view, const P& p) {
    if (p) look(*p);
  }
  template <class P>
  void target(std::string_view name, const P& p) {
    if (p) {
      look(*p);
    } else if (name != "at") {
      report_.error("IR-034", "a " + std::string(name) + " is missing");
    }
  }
  void label(std::string_view, const LabelRef& l) { look(l.computed); }
  void routine_name(std::string_view, const RoutineName&) {}
  void space(std::string_view, SpaceId id) {
    if (id < report_.program.spaces.size()) return;
    report_.error("IR-010", "variables of space " + std::to_string(id) + ", which is not there");
  }
  void setting(const ModalSet& x) {
    if (x.setting < Setting::count_ && !setting_value_name(x.setting, x.value).empty()) return;
    report_.error("IR-030",
                  "the setting " + std::string(enum_name(x.setting)) + " has no value " + std::to_string(x.value));
  }
  void action(const ActionData& data) {
    std::visit([this](const auto& x) { fields(*this, x); }, data);
  }
  void cycle(const std::variant<HoleCycle, NamedCycle>& node) {
    std::visit([this](const auto& x) { fields(*this, x); }, node);
  }
  void block(const Block& b);
  void body(std::string_view, const Body&, const LineInfo&) {}
  void then_else(const If&) {}
  void assignments(std::string_view, const std::vector<Assign::Item>& items);
  void arguments(std::string_view, const std::vector<Argument>& list) {
    for (const auto& a : list) look(a);
  }
  void declared(std::string_view, const std::vector<Declare::Item>& items);
  void cases(std::string_view, const std::vector<std::pair<ExprPtr, Jump>>& list) {
    for (const auto& [key, jump] : list) {
      check_expression(key, report_);
      look(jump);
    }
  }

 private:
  void look(const ExprPtr& e) {
    if (e) check_expression(e, report_);
  }
  void look(const Value& v) { look(v.expr); }
  void look(const VarRef& v) {
    check_variable(v, report_);
    look(v.index);
    for (const auto& i : v.indices) check_expression(i, report_);
  }
  void look(const std::string&) {}
  void look(std::string_view) {}
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void look(T) {}
  template <class T>
  requires std::is_class_v<T>
  void look(const T& x) { fields(*this, x); }

  void condition(const ExprPtr& e, std::string_view of) {
    if (e && !is_condition(e->type)) {
      report_.error("IR-013", "the condition of " + std::string(of) + " is a " + std::string(name(e->type)));
    }
  }
  void routine(const Routine& r);
  void routines();
  void statements(const Body& b, bool in_loop);
  void structure(const Statement& s, bool in_loop);
  void jump(const Jump& j, std::uint32_t from);
  void found(const LabelRef& label, Search search, std::uint32_t from, bool quiet);
  void range(const Repeat& r, std::uint32_t from);
  void motion(const Motion& m);

  Report report_;
  const LabelTable* labels_ = nullptr;
};

// --- blocks -------------------------------------------------------------------------------------------------------

void Checker::motion(const Motion& m) {
  const bool arc = m.kind == MotionKind::arc_cw || m.kind == MotionKind::arc_ccw;
  std::set<AxisId> seen;
  for (const auto& c : m.centers) {
    if (!seen.insert(c.axis).second) report_.error("IR-033", "an arc has two centre words of one axis");
  }
  if (!arc) return;
  const bool has_angle = m.extra && m.extra->has_angle;
  const bool polar = m.extra && (m.extra->has_polar_radius || m.extra->has_polar_angle);
  if (m.radius_given && !m.centers.empty()) {
    report_.error("IR-033", "an arc has a radius as well as a centre");
  } else if (m.moves() && !m.radius_given && m.centers.empty() && !has_angle && !polar) {
    report_.error("IR-033", "an arc has neither a centre nor a radius");
  }
}

void Checker::block(const Block& b) {
  bool after_seen = false;
  for (const auto& a : b.actions) {
    if (after_seen && a.order != Order::after) {
      report_.error("IR-031", "an action before the motion stands behind one after it");
    }
    after_seen |= a.order == Order::after;
    look(a);
  }
  if (b.has_motion) {
    motion(b.motion);
    look(b.motion);
  }
  if (b.repeat_given != 0) look(b.repeat);
}

void Checker::assignments(std::string_view, const std::vector<Assign::Item>& items) {
  for (const auto& it : items) {
    if (it.to_system) {
      Expr e;
      e.node = it.system;
      check_expression(std::make_shared<const Expr>(std::move(e)), report_);
    } else {
      look(it.target);
    }
    check_expression(it.value, report_);
  }
}

void Checker::declared(std::string_view, const std::vector<Declare::Item>& items) {
  for (const auto& it : items) {
    if (it.name.empty()) report_.error("IR-011", "a variable is declared without a name");
    exprs("dimensions", it.dimensions);
    for (const auto& e : it.initial) look(e);
  }
}

// --- control flow -------------------------------------------------------------------------------------------------

void Checker::found(const LabelRef& label, Search search, std::uint32_t from, bool quiet) {
  if (label.computed || search == Search::to_start) return;
  const std::string shown = (label.is_number ? "N" : "") + label.text;
  if (!labels_->find(label, search, labels_->order(from))) {
    if (quiet) return;
    report_.diagnostics.error("IR-020", report_.line, "the label " + shown + " is not where this line looks for it",
                              "write the label, or correct the name");
  } else if (search == Search::whole_first && labels_->all(label.text, label.is_number).size() > 1) {
    report_.diagnostics.warning("IR-021", report_.line,
                                "the label " + shown + " stands more than once; the first one counts",
                                "give the others another label");
  }
}

void Checker::range(const Repeat& r, std::uint32_t from) {
  if (r.curve_use != CurveUse::none && r.first.text.empty()) return;  // a curve that nothing defines: the run says so
  if (r.first.computed || r.last.computed) return;
  if (r.last.text.empty()) return found(r.first, r.search, from, false);
  if (labels_->range(r, labels_->order(from))) return;
  report_.diagnostics.error("IR-020", report_.line,
                            "a label of the range " + r.first.text + " to " + r.last.text +
                                " is not there, or the labels stand in the wrong order",
                            "write the labels, or correct the names");
}

void Checker::jump(const Jump& j, std::uint32_t from) {
  condition(j.condition, "a jump");
  found(j.target, j.search, from, j.quiet);
}

void Checker::structure(const Statement& s, bool in_loop) {
  if (const auto* i = std::get_if<If>(&s.node)) {
    condition(i->condition, "IF");
    if (!i->has_else && !i->else_body.empty()) report_.error("IR-023", "an IF has an ELSE body without ELSE");
  } else if (const auto* w = std::get_if<While>(&s.node)) {
    condition(w->condition, "WHILE");
  } else if (const auto* u = std::get_if<Until>(&s.node)) {
    condition(u->condition, "UNTIL");
  } else if (std::holds_alternative<Exit>(s.node)) {
    if (!in_loop) report_.error("IR-022", "an exit stands outside of loops");
  } else if (const auto* j = std::get_if<Jump>(&s.node)) {
    jump(*j, s.id);
  } else if (const auto* w2 = std::get_if<Switch>(&s.node)) {
    for (const auto& c : w2->cases) jump(c.second, s.id);
    for (const auto& d : w2->fallback) jump(d, s.id);
    if (w2->fallback.size() > 1) report_.error("IR-023", "a switch has two defaults");
  } else if (const auto* r = std::get_if<Repeat>(&s.node); r != nullptr && !r->has_program) {
    range(*r, s.id);
  }
}

void Checker::statements(const Body& b, bool in_loop) {
  for (const auto& s : b) {
    report_.line = s.line.span;
    structure(s, in_loop);
    std::visit([this](const auto& x) { fields(*this, x); }, s.node);
    const bool loop = in_loop || (bodies_of(s)[0] != nullptr && !std::holds_alternative<If>(s.node));
    for (const Body* inner : bodies_of(s)) {
      if (inner != nullptr) statements(*inner, loop);
    }
  }
}

// --- the program --------------------------------------------------------------------------------------------------

void Checker::routine(const Routine& r) {
  report_.line = r.header.span;
  look(r);
  const LabelTable labels(r);
  labels_ = &labels;
  statements(r.body, false);
  labels_ = nullptr;
}

void Checker::routines() {
  std::set<std::pair<std::int64_t, std::string>> seen;
  bool sub_seen = false;
  for (const auto& r : report_.program.routines) {
    report_.line = r.header.span;
    const bool named = !r.name.empty();
    if (!named && r.kind == RoutineKind::sub) report_.error("IR-040", "a subprogram has no name");
    if (named && r.locality == Locality::global && !seen.emplace(r.name.number, r.name.text).second) {
      report_.error("IR-040", "two routines have the name " +
                                  (r.name.text.empty() ? std::to_string(r.name.number) : r.name.text));
    }
    if (r.kind == RoutineKind::main && sub_seen && report_.program.main() == &r) {
      report_.error("IR-041", "the main program is not the first routine");
    }
    sub_seen |= r.kind == RoutineKind::sub;
  }
}

void Checker::check() {
  routines();
  for (const auto& r : report_.program.routines) routine(r);
}

/// Ids run from 1 in text order.
bool numbered(const Program& program) {
  std::uint32_t next = 0;
  bool in_order = true;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) { in_order &= s.id == ++next; });
  }
  return in_order;
}

}  // namespace
}  // namespace detail

void check_well_formed(const Program& program, Diagnostics& diagnostics) {
  if (detail::numbered(program)) return detail::Checker(program, diagnostics).check();
  Program copy = program;
  number_statements(copy);
  detail::Checker(copy, diagnostics).check();
}

}  // namespace cnctrans::ir
