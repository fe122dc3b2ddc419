// Lengths read from machine data or written to them: one control answers in the unit and the diameter mode of its
// words, another in millimetres and radius. The values are rescaled where the two differ.
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "legaliser/analysis/words.h"
#include "legaliser/early_passes.h"

namespace cnctrans::ir::passes {

namespace {

/// A datum whose value is a length; the others have no unit, or the same one everywhere.
bool is_length(Datum d) {
  switch (d) {
    case Datum::machine_position:
    case Datum::work_offset:
    case Datum::active_shift:
    case Datum::programmed_shift:
    case Datum::tool_length:
    case Datum::tool_radius:
    case Datum::tool_wear:
    case Datum::tool_nose_width: return true;
    default: return false;
  }
}

class MachineDataPass {
 public:
  MachineDataPass(const Program& program, const LegaliseContext& context, const FactsOf& facts)
      : context_(context), facts_(facts) {
    const auto& on = context.source_machine.power_on;
    if (on.units == Units::inch) inches(on.units_feed_too);
    for (const Routine& r : program.routines) {
      for_each_statement(r.body, [this](const Statement& s) {
        const auto* b = std::get_if<Block>(&s.node);
        if (b == nullptr) return;
        for (const Action& a : b->actions) {
          const auto* m = std::get_if<ModalSet>(&a.data);
          if (m != nullptr && m->setting == Setting::units && m->value == static_cast<std::uint8_t>(Units::inch))
            inches(m->feed_too);
        }
      });
    }
  }

  void statement(Statement& s) {
    bool used = false;
    each_expression(s, [&used](const ExprPtr& e) {
      walk(e, [&used](const ExprPtr& x) { used = used || datum_of(x) != nullptr; });
    });
    const auto* a = std::get_if<Assign>(&s.node);
    used = used || (a != nullptr && std::any_of(a->items.begin(), a->items.end(), [](const Assign::Item& i) {
                      return i.to_system && is_length(i.system.datum);
                    }));
    if (!used) return;
    StatementVisitor visit;
    visit.expression = [&](const ExprPtr& e) {
      return map_expr(e, [&](const ExprPtr& x) {
        const auto* datum = datum_of(x);
        return datum == nullptr ? one_factor(x) : times(x, factor(s, *datum));
      });
    };
    visit_statement(s, visit);
    if (auto* to = std::get_if<Assign>(&s.node)) {
      for (auto& i : to->items) {
        if (i.to_system && is_length(i.system.datum)) i.value = times(i.value, factor(s, i.system).inverse());
      }
    }
  }

 private:
  void inches(bool feed_too) { (feed_too ? with_feed_ : without_feed_) = true; }
  static const SystemRef* datum_of(const ExprPtr& e) {
    const auto* ref = e ? std::get_if<SystemRef>(&e->node) : nullptr;
    return ref != nullptr && is_length(ref->datum) ? ref : nullptr;
  }
  /// `to` units of the target for `from` units of the source.
  struct Ratio {
    double to = 1, from = 1;
    [[nodiscard]] double value() const { return to / from; }
    [[nodiscard]] Ratio inverse() const { return {from, to}; }
  };

  /// A division where its number is the shorter one: 25.4 instead of 0.03937..
  static ExprPtr times(const ExprPtr& e, const Ratio& ratio) {
    if (ratio.value() == 1) return e;
    if (const auto constant = constant_value(e)) return number(*constant * ratio.value());
    const double divisor = ratio.inverse().value();
    if (shortest(divisor).size() < shortest(ratio.value()).size()) return binary(BinaryOp::divide, e, number(divisor));
    return binary(BinaryOp::multiply, e, number(ratio.value()));
  }

  /// x*25.4*1000 is x*25400, and x/2*1000/1000 is x/2: one factor behind a datum, where it can be said in short.
  static ExprPtr one_factor(const ExprPtr& e) {
    const auto* outer = std::get_if<Binary>(&e->node);
    const auto* inner = outer != nullptr ? std::get_if<Binary>(&outer->left->node) : nullptr;
    if (inner == nullptr || datum_of(inner->left) == nullptr) return e;
    const auto a = ratio_of(*inner), b = ratio_of(*outer);
    if (!a || !b) return e;
    const Ratio both{a->to * b->to, a->from * b->from};
    const ExprPtr one = times(inner->left, both);
    const auto* left = std::get_if<Binary>(&one->node);
    return left != nullptr && shortest(std::get<Number>(left->right->node).value).size() > 6 ? e : one;
  }
  static std::optional<Ratio> ratio_of(const Binary& b) {
    const auto* n = std::get_if<Number>(&b.right->node);
    if (n == nullptr || n->value == 0) return std::nullopt;
    if (b.op == BinaryOp::multiply) return Ratio{n->value, 1};
    if (b.op == BinaryOp::divide) return Ratio{1, n->value};
    return std::nullopt;
  }

  /// What the source reads, in units of what the target reads: where the unit or the mode is not known here, the same
  /// for all of them.
  Ratio factor(const Statement& s, const SystemRef& ref) {
    static const Block none;
    const auto* b = std::get_if<Block>(&s.node);
    const Block& block = b != nullptr ? *b : none;
    const auto unit = setting_in<Units>(block, facts_.before(s), Setting::units);
    const auto mode = setting_in<DiameterMode>(block, facts_.before(s), Setting::diameter);
    std::optional<Ratio> all;
    bool same = true;
    for (const Units u : {unit.value_or(Units::metric), unit.value_or(Units::inch)}) {
      for (const DiameterMode m : {mode.value_or(DiameterMode::radius), mode.value_or(DiameterMode::diameter)}) {
        const auto from = millimetres(ref, context_.source_machine, u, m);
        const auto to = millimetres(ref, context_.target_machine, u, m);
        same = same && from && to && (!all || std::fabs(*to / *from - all->value()) < 1e-12);
        if (same) all = Ratio{*to, *from};
      }
    }
    if (same && all) return *all;
    context_.diagnostics.error("TRN-173", s.line.span,
                               "in which unit " + ref.text + " is read depends on the path that leads here",
                               "write the unit and the diameter or radius code before this block on every path");
    return {};
  }

  /// Millimetres (radius) of the value 1 in this unit and mode; nullopt: that depends on more.
  [[nodiscard]] std::optional<double> millimetres(const SystemRef& ref, const machine::Profile& machine, Units unit,
                                                  DiameterMode mode) const {
    const auto units = machine.policies.machine_data_units;
    const bool by_feed = units == machine::MachineDataUnits::with_feed;
    const bool modal = units == machine::MachineDataUnits::modal || (by_feed && with_feed_);
    const bool position = ref.datum == Datum::machine_position;
    const auto* axis = machine.axis(ref.axis);
    if ((!modal && !(position && machine.policies.machine_position_scale == machine::MachinePositionScale::words)) ||
        (axis != nullptr && axis->rotary))
      return 1;
    const double length = unit == Units::inch ? 25.4 : 1;
    if (by_feed) {
      if (unit == Units::inch && without_feed_) return std::nullopt;
      return length;
    }
    return position && axis != nullptr && axis->diameter && mode != DiameterMode::radius ? length / 2 : length;
  }

  const LegaliseContext& context_;
  const FactsOf& facts_;
  bool with_feed_ = false, without_feed_ = false;  ///< the program changes to inches of F too, of the lengths alone
};

}  // namespace

void convert_machine_data(Program& program, const LegaliseContext& context) {
  const auto &source = context.source_machine.policies, &target = context.target_machine.policies;
  if (source.machine_data_units == target.machine_data_units &&
      source.machine_position_scale == target.machine_position_scale)
    return;
  const FactsOf facts(program, context);
  MachineDataPass pass(program, context, facts);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&pass](Statement& s) { pass.statement(s); });
  }
}

}  // namespace cnctrans::ir::passes
