#include "translator/files/contours.h"

#include <memory>
#include <string>
#include <utility>

#include "interpreter/machine/profile_contour.h"
#include "ir/cycles/milling/mill_contour.h"
#include "ir/cycles/profile_blocks.h"
#include "legaliser/analysis/head_constants.h"
#include "legaliser/cycles/milling/pocket_calls.h"
#include "legaliser/cycles/turning/machining_moves.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::translator {

namespace {

/// The cycle of an action that has a profile; null: it has none.
const ir::NamedCycle* profiled(const ir::Action& a) {
  const auto* d = std::get_if<ir::CycleDefine>(&a.data);
  const auto* named = d != nullptr && d->cycle ? std::get_if<ir::NamedCycle>(&d->cycle->node) : nullptr;
  return named != nullptr && ir::cycles::has_profile(*named) ? named : nullptr;
}

using ir::passes::HeadConstants;

/// The cycle and its blocks with numbers for what the head of the program sets.
struct Folded {
  ir::NamedCycle cycle;
  std::vector<ir::Statement> blocks;
  std::map<std::string, double> used;

  Folded(const ir::NamedCycle& from, const HeadConstants& constants, const ir::Routine& routine,
         const ir::Statement& at)
      : cycle(from), constants_(constants), routine_(routine), at_(at) {
    for (auto& [word, v] : cycle.words) v = constants.fold(v, routine, at, &used);
  }
  std::vector<const ir::Statement*> with(const std::vector<const ir::Statement*>& statements) {
    for (const auto* s : statements) blocks.push_back(*s);
    std::vector<const ir::Statement*> out;
    for (auto& s : blocks) {
      if (auto* b = std::get_if<ir::Block>(&s.node)) {
        ir::passes::visit_values(*b, [this](ir::Value& v, const ir::passes::Place&) {
          if (v.literal()) return false;
          v = constants_.fold(v, routine_, at_, &used);
          return true;
        });
      }
      out.push_back(&s);
    }
    return out;
  }

 private:
  const HeadConstants& constants_;
  const ir::Routine& routine_;
  const ir::Statement& at_;
};

void read_one(ir::NamedCycle& cycle, const ir::Program& program, const ir::Routine& routine, const ir::Statement& s,
              const ir::Facts& facts, const machine::Profile& machine, const HeadConstants& constants) {
  const auto& b = std::get<ir::Block>(s.node);
  Folded folded(cycle, constants, routine, s);
  const auto modes = ir::passes::modes_at(b, facts, machine.power_on);
  ir::cycles::TurnNumbers numbers;
  // Of its words only the first point counts for the contour.
  ir::NamedCycle place{folded.cycle.name, {}};
  for (const auto& w : folded.cycle.words) {
    if (w.first == "x" || w.first == "z") place.words.push_back(w);
  }
  if (!modes || !ir::passes::machining_numbers(place, *modes, numbers))
    return ir::cycles::put_contour_fault(cycle, "its words or the modes in force are known only when the program runs");
  std::string error;
  const auto blocks = ir::cycles::profile_blocks(program, routine, cycle, &error);
  if (blocks.empty()) return ir::cycles::put_contour_fault(cycle, error);
  const auto start = ir::cycles::contour_start(numbers, *modes);
  const auto contour = interpreter::contour_of(machine, start, folded.with(blocks), nullptr, &error);
  if (contour)
    ir::cycles::put_contour(cycle, *contour);
  else
    ir::cycles::put_contour_fault(cycle, error);
  const std::string values = ir::passes::listed(folded.used);
  if (!values.empty()) cycle.words.emplace_back("contour_values", ir::Value(ir::string_literal(values)));
}

/// A milling cycle with contours; null: none.
const ir::HoleCycle* milling_along(const ir::Action& a) {
  const auto* d = std::get_if<ir::CycleDefine>(&a.data);
  const auto* hole = d != nullptr && d->cycle ? std::get_if<ir::HoleCycle>(&d->cycle->node) : nullptr;
  return hole != nullptr && !ir::cycles::contours_named(*hole).empty() ? hole : nullptr;
}

void read_mill(ir::HoleCycle& cycle, const ir::Program& program, const ir::Routine& routine, const ir::Statement& s,
               const ir::Facts& facts, const machine::Profile& machine, const HeadConstants& constants) {
  const auto& b = std::get<ir::Block>(s.node);
  auto modes = ir::passes::modes_at(b, facts, machine.power_on);
  const auto plane = ir::passes::setting_in<ir::Plane>(b, facts, ir::Setting::plane);
  if (!modes || !plane)
    return ir::cycles::put_contour_fault(cycle, "the modes in force are known only when the program runs");
  modes->plane = *plane;
  std::vector<ir::cycles::MillContour> contours;
  const auto names = ir::cycles::contours_named(cycle);
  const bool several = names.size() == 1 && cycle.mill.shape.starts_with("pocket.");
  for (const auto& named : names) {
    std::string error;
    Folded folded(named, constants, routine, s);
    const auto blocks = ir::cycles::profile_blocks(program, routine, named, &error);
    if (blocks.empty()) return ir::cycles::put_contour_fault(cycle, error);
    auto read = interpreter::mill_contours_of(machine, *modes, folded.with(blocks), several, nullptr, &error);
    if (!read) return ir::cycles::put_contour_fault(cycle, error);
    for (auto& contour : *read) contours.push_back(std::move(contour));
    if (!folded.used.empty())
      cycle.mill.words.emplace_back("contour_values", ir::Value(ir::string_literal(ir::passes::listed(folded.used))));
  }
  ir::cycles::put_contours(cycle, contours);
}

}  // namespace

void read_contours(ir::Program& program, const machine::Profile& source_machine) {
  ir::passes::write_out_pocket_calls(program, source_machine.power_on);
  bool any = false;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&any](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i)
        any = any || profiled(b->actions[i]) != nullptr || milling_along(b->actions[i]) != nullptr;
    });
  }
  if (!any) return;
  ir::number_statements(program);
  const HeadConstants constants(program);
  const auto table = ir::analyse(program, source_machine.power_on);
  for (auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](ir::Statement& s) {
      auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr) return;
      for (auto& a : b->actions) {
        if (const auto* hole = milling_along(a)) {
          ir::HoleCycle copy = *hole;
          read_mill(copy, program, r, s, table.before(s.id), source_machine, constants);
          std::get<ir::CycleDefine>(a.data).cycle = std::make_shared<const ir::Cycle>(ir::Cycle{std::move(copy)});
          continue;
        }
        const auto* named = profiled(a);
        if (named == nullptr) continue;
        ir::NamedCycle copy = *named;
        read_one(copy, program, r, s, table.before(s.id), source_machine, constants);
        std::get<ir::CycleDefine>(a.data).cycle = std::make_shared<const ir::Cycle>(ir::Cycle{std::move(copy)});
      }
    });
  }
}

}  // namespace cnctrans::translator
