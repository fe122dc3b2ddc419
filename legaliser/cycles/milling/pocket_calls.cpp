#include "legaliser/cycles/milling/pocket_calls.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "ir/analysis/dataflow.h"
#include "ir/cycles/milling/pocket_call.h"
#include "ir/cycles/milling/pocket_moves.h"
#include "ir/edit/rewrite.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/cycles/milling/milling_moves.h"

namespace cnctrans::ir::passes {

namespace {

/// The call in a block; null: none.
const NamedCycle* call_in(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
    const auto* d = std::get_if<CycleDefine>(&b->actions[i].data);
    const auto* named = d != nullptr && d->cycle ? std::get_if<NamedCycle>(&d->cycle->node) : nullptr;
    if (named != nullptr && named->name == cycles::pocket::call) return named;
  }
  return nullptr;
}

bool sets_incremental(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
        const auto* set = std::get_if<ModalSet>(&b->actions[i].data);
        found = found || (set != nullptr && set->setting == Setting::distance &&
                          set->value != static_cast<std::uint8_t>(Distance::absolute));
      }
    });
  }
  return found;
}

/// What the call leaves in force. Radius compensation is off already: a pocket does not run under it.
Statement ending(const Statement& call, bool absolute) {
  Statement s;
  s.line.span = call.line.span;
  s.line.skip_mask = call.line.skip_mask;
  Block b;
  for (const auto& a : std::get<Block>(call.node).actions) {
    if (a.order != Order::after) continue;
    const auto* set = std::get_if<ModalSet>(&a.data);
    if (set != nullptr && (set->setting == Setting::comp || (set->setting == Setting::distance && !absolute))) continue;
    b.actions.push_back(a);
    b.actions.back().order = Order::before;
  }
  b.has_motion = true;
  b.motion.kind = MotionKind::rapid;
  b.motion.explicit_code = true;
  s.node = std::move(b);
  return s;
}

Body pieces_of(const Statement& call, cycles::PocketOperations&& operations, bool absolute) {
  Body out;
  Statement before = call;
  auto& b = std::get<Block>(before.node);
  std::erase_if(b.actions,
                [](const Action& a) { return a.order == Order::after || std::holds_alternative<CycleDefine>(a.data); });
  const bool own = !b.actions.empty() || b.has_motion;
  if (own) out.push_back(before);
  for (auto& s : operations.blocks) {
    s.line.number = {};
    s.line.labels.clear();
    s.line.skip_mask = call.line.skip_mask;
    s.line.joined = false;
    if (out.empty()) {
      s.line.number = call.line.number;
      s.line.number_mark = call.line.number_mark;
      s.line.labels = call.line.labels;
      s.line.blank_lines_before = call.line.blank_lines_before;
      s.line.comments.insert(s.line.comments.begin(), call.line.comments.begin(), call.line.comments.end());
    }
    out.push_back(std::move(s));
  }
  out.push_back(ending(call, absolute));
  return out;
}

}  // namespace

void write_out_pocket_calls(Program& program, const ModalState& power_on) {
  bool any = false;
  for (const auto& r : program.routines)
    for_each_statement(r.body, [&any](const Statement& s) { any = any || call_in(s) != nullptr; });
  if (!any) return;
  number_statements(program);
  const auto facts = analyse(program, power_on);
  const bool absolute = sets_incremental(program);
  std::map<std::uint32_t, Body> written;
  std::set<std::uint32_t> retired;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* call = call_in(s);
      if (call == nullptr) return;
      std::string error;
      auto operations = cycles::pocket_operations(program, r, *call, &error);
      if (!operations) return;
      for (const auto* block : operations->originals) {
        if (!facts.before(block->id).reachable) retired.insert(block->id);
      }
      written.emplace(s.id, pieces_of(s, *std::move(operations), absolute));
    });
  }
  for (auto& r : program.routines) {
    rewrite_body(r.body, [&](Statement&& s, Body& out) {
      if (const auto it = written.find(s.id); it != written.end()) {
        for (auto& piece : it->second) out.push_back(std::move(piece));
        return;
      }
      if (retired.count(s.id) != 0) {
        s.line.number = {};
        s.line.labels.clear();
        s.node = Block{};
      }
      out.push_back(std::move(s));
    });
  }
  number_statements(program);
}

namespace {

/// A pocket's call or operation, or a hole cycle that finds its places in one; null: none.
const CycleDefine* pocket_in(const Statement& s) {
  const auto* b = std::get_if<Block>(&s.node);
  for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
    const auto* d = std::get_if<CycleDefine>(&b->actions[i].data);
    if (d == nullptr || !d->cycle) continue;
    const auto* named = std::get_if<NamedCycle>(&d->cycle->node);
    const auto* hole = std::get_if<HoleCycle>(&d->cycle->node);
    if (named != nullptr && cycles::is_pocket_cycle(named->name)) return d;
    if (hole != nullptr && hole->mill.shape == cycles::pocket_entries_shape) return d;
  }
  return nullptr;
}

/// A block for each hole, behind the other words of the block.
Body holes_of(Statement&& s, const CycleDefine& drill, const std::vector<cycles::PocketPoint>& places, PlaneAxes axes,
              double unit) {
  Body out;
  CycleDefine define = drill;
  HoleCycle hole = std::get<HoleCycle>(drill.cycle->node);
  hole.mill = {};
  define.cycle = std::make_shared<const Cycle>(Cycle{std::move(hole)});
  auto& b = std::get<Block>(s.node);
  std::erase_if(b.actions, [](const Action& a) { return std::holds_alternative<CycleDefine>(a.data); });
  const LineInfo like = s.line;
  const bool own = !b.actions.empty();
  if (own) out.push_back(std::move(s));
  for (const auto& p : places) {
    Block hole_block;
    hole_block.has_motion = true;
    auto& m = hole_block.motion;
    m.kind = MotionKind::rapid;
    m.explicit_code = true;
    m.keeps_modal = false;
    for (const auto& [axis, at] : {std::pair(axes.u, p.u), std::pair(axes.v, p.v)}) {
      CoordWord w;
      w.axis = axis;
      w.mode = WordMode::absolute;
      w.value = Value{std::round(at / unit * 1e9) / 1e9};
      m.coords.push_back(w);
    }
    Action a;
    a.data = define;
    hole_block.actions.push_back(std::move(a));
    out.push_back(made(like, std::move(hole_block)));
  }
  return out;
}

}  // namespace

void settle_pockets(Program& program, const LegaliseContext& context) {
  bool any = false;
  for (const auto& r : program.routines)
    for_each_statement(r.body, [&any](const Statement& s) { any = any || pocket_in(s) != nullptr; });
  if (!any) return;
  const FactsOf facts(program, context);
  const FeedsBefore feeds(program, context);
  for (auto& r : program.routines) {
    const MillCycles milling(program, r, context, feeds);
    const Routine caller = r;  // the blocks as they were, for the reasons
    rewrite_body(r.body, [&](Statement&& s, Body& out) {
      const auto* d = pocket_in(s);
      if (d == nullptr) return out.push_back(std::move(s));
      std::string error;
      if (const auto* named = std::get_if<NamedCycle>(&d->cycle->node)) {
        if (named->name == cycles::pocket::call)
          (void)cycles::pocket_operations(program, caller, *named, &error);
        else
          error = "an operation of a pocket that no call leads to";
        refuse(s, program, context, "TRN-510", "a pocket that can't be taken apart: " + error,
               "put the operations and contours behind the end of this program");
        return out.push_back(std::move(s));
      }
      const auto& b = std::get<Block>(s.node);
      const Facts& here = facts.before(s);
      const auto places = milling.entries(std::get<HoleCycle>(d->cycle->node), b, here, &error);
      const auto plane = setting_in<Plane>(b, here, Setting::plane);
      const auto units = setting_in<Units>(b, here, Setting::units);
      if (places.empty() || !plane || !units) {
        refuse(s, program, context, "TRN-512", "where the drilling of this pocket goes in is not known here: " + error,
               "give the radius of the roughing tool in the source's machine profile");
        return out.push_back(std::move(s));
      }
      const CycleDefine define = *d;
      for (auto& piece : holes_of(std::move(s), define, places, plane_axes(*plane), *units == Units::inch ? 25.4 : 1))
        out.push_back(std::move(piece));
    });
  }
  number_statements(program);
}

}  // namespace cnctrans::ir::passes
