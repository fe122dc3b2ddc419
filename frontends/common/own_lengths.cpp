#include "frontends/common/own_lengths.h"

#include <cmath>
#include <memory>
#include <set>

#include "ir/analysis/dataflow.h"

namespace cnctrans::frontends {

namespace {

constexpr double inch = 25.4;

/// It is that length, in one unit or the other.
bool is_length(double value, double mm) {
  const auto near = [value](double x) { return std::fabs(std::fabs(value) - x) < 1e-9; };
  return mm > 0 && (near(mm) || near(mm / inch));
}
/// A number that no word of the program has given.
bool is_own(const ir::Value& v, double mm) {
  return v.literal() && v.text.empty() && is_length(v.number, mm);
}
double in_unit(double value, double mm, bool inches) {
  return std::copysign(inches ? mm / inch : mm, value);
}

/// Writes the lengths of the cycle that are the control's in the unit. \return it has any
bool settle(ir::HoleCycle& c, const OwnLengths& own, bool inches) {
  bool any = false;
  const auto length = [&](ir::Value& v, double mm) {
    if (!is_own(v, mm)) return;
    any = true;
    v.number = in_unit(v.number, mm, inches);
  };
  length(c.pecks.reapproach, own.reapproach);
  if (c.kind == ir::HoleKind::mill && c.reference.base == ir::LevelBase::from_surface)
    length(c.reference.value, own.above_surface);
  if (c.shift_u.literal() && c.shift_v.literal()) {
    const double now = std::hypot(c.shift_u.number, c.shift_v.number);
    if (!is_length(now, own.clearance)) return any;
    const double factor = in_unit(now, own.clearance, inches) / now;
    for (ir::Value* v : {&c.shift_u, &c.shift_v}) v->number = std::round(v->number * factor * 1e12) / 1e12;
    return true;
  }
  for (ir::Value* v : {&c.shift_u, &c.shift_v}) {  // the length times the cosine or sine of the angle
    const auto* product = v->expr ? std::get_if<ir::Binary>(&v->expr->node) : nullptr;
    const auto* n = product != nullptr && product->op == ir::BinaryOp::multiply
                        ? std::get_if<ir::Number>(&product->left->node)
                        : nullptr;
    if (n == nullptr || !is_length(n->value, own.clearance)) continue;
    any = true;
    *v = ir::Value(
        ir::binary(ir::BinaryOp::multiply, ir::number(in_unit(n->value, own.clearance, inches)), product->right));
  }
  return any;
}

const ir::HoleCycle* hole_in(const ir::Action& a) {
  const auto* d = std::get_if<ir::CycleDefine>(&a.data);
  return d != nullptr && d->cycle ? std::get_if<ir::HoleCycle>(&d->cycle->node) : nullptr;
}

const ir::ModalSet* units_in(const ir::Action& a) {
  const auto* m = std::get_if<ir::ModalSet>(&a.data);
  return m != nullptr && m->setting == ir::Setting::units ? m : nullptr;
}

/// The program has cycles, and both units.
bool concerned(const ir::Program& program, const ir::ModalState& power_on) {
  bool cycles = false;
  std::set<std::uint8_t> units{static_cast<std::uint8_t>(power_on.units)};
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) {
        cycles = cycles || hole_in(a) != nullptr;
        if (const auto* m = units_in(a)) units.insert(m->value);
      }
    });
  }
  return cycles && units.size() > 1;
}

}  // namespace

void settle_own_lengths(ir::Program& program, const ir::ModalState& power_on, const OwnLengths& own,
                        Diagnostics& diagnostics) {
  if (!concerned(program, power_on)) return;
  ir::number_statements(program);
  const ir::FactTable table = ir::analyse(program, power_on);
  for (auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](ir::Statement& s) {
      auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr) return;
      const ir::Facts& before = table.before(s.id);
      auto units = before.settings[static_cast<std::size_t>(ir::Setting::units)];
      for (auto& a : b->actions) {
        if (const auto* m = units_in(a); m != nullptr && a.order != ir::Order::after) units = m->value;
        const ir::HoleCycle* hole = hole_in(a);
        if (hole == nullptr || !before.reachable) continue;
        ir::HoleCycle settled = *hole;
        if (!settle(settled, own, units == static_cast<std::uint8_t>(ir::Units::inch))) continue;
        if (units) {
          std::get<ir::CycleDefine>(a.data).cycle = std::make_shared<const ir::Cycle>(ir::Cycle{std::move(settled)});
        } else {
          diagnostics.error(
              "TRN-590", s.line.span,
              "this cycle has a length of the control's own, which is millimetres, and the program reaches "
              "it under G70 and G71, or that can't be told",
              "write G70 or G71 before the cycle");
        }
      }
    });
  }
}

}  // namespace cnctrans::frontends
