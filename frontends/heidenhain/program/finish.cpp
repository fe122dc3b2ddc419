#include "frontends/heidenhain/program/finish.h"

#include <algorithm>
#include <utility>

#include "base/text.h"
#include "dialects/heidenhain/variables.h"
#include "frontends/heidenhain/cycles/build.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;

namespace {

/// What the control does besides in the block; on other controls it is a block of its own.
ir::Statement behind(const ir::Statement& to, ir::StatementNode node) {
  ir::Statement s;
  s.line.span = to.line.span;
  s.line.skip_mask = to.line.skip_mask;
  s.node = std::move(node);
  return s;
}

ir::Value pole_datum(bool first) {
  ir::SystemRef ref;
  ref.datum = first ? ir::Datum::pole_first : ir::Datum::pole_second;
  ref.text = "CC";
  auto e = std::make_shared<ir::Expr>();
  e->node = std::move(ref);
  return ir::Value(ir::ExprPtr(std::move(e)));
}

class Finisher {
 public:
  Finisher(Lowering& lowering, const Flow& flow) : lowering_(lowering), flow_(flow), flat_(lowering.flat()) {}

  void run(std::vector<std::vector<ir::Statement>>& out) {
    for (std::size_t i = 0; i < flat_.items.size(); ++i) {
      if (flat_.items[i].polar) poles_stay_ = true;
      if (flat_.items[i].by_pole) centre(i);
    }
    link_globals();
    find_stored();
    out.resize(flat_.items.size());
    for (std::size_t i = 0; i < flat_.items.size(); ++i) one(i, out[i]);
  }

 private:
  [[nodiscard]] const Arrival& arrival(std::size_t i) const { return flow_.arrivals()[i]; }
  static void keep_text(Item& item, std::string_view feature, std::string text) {
    ir::Opaque o;
    o.feature = feature;
    o.text = std::move(text);
    item.statement.node = std::move(o);
    item.moves = item.by_pole = false;
    item.call = CycleCall::none;
  }

  // --- arcs ----------------------------------------------------------------------------------------------------------

  void centre(std::size_t i) {
    Item& item = flat_.items[i];
    const Arrival& a = arrival(i);
    if (!a.reached) return by_datum(item, ir::plane_axes(ir::Plane::xy));
    Report& report = lowering_.report();
    report.start(item.statement.line.span);
    if (a.pole == Arrival::none) {
      report.refuse("HEI-008", {}, "no CC stands before this arc: its centre is unknown", "write CC");
      return keep_text(item, "text.unread", "C");
    }
    const auto plane = ir::plane_axes(a.plane == Arrival::several ? ir::Plane::xy : static_cast<ir::Plane>(a.plane));
    const Pole* pole = a.pole == Arrival::several ? nullptr : &flat_.poles[static_cast<std::size_t>(a.pole)];
    if (pole == nullptr || !by_words(item, a, *pole, plane)) by_datum(item, plane);
  }
  /// The centre as CC has it, where nothing has changed that it refers to.
  bool by_words(Item& item, const Arrival& a, const Pole& pole, const ir::PlaneAxes& plane) {
    std::vector<ir::CenterWord> centres;
    for (const ir::AxisId axis : {plane.u, plane.v}) {
      ir::CenterWord c;
      c.axis = axis;
      c.mode = ir::CenterMode::from_start;
      bool given = pole.words.empty();
      for (std::size_t k = 0; k < pole.words.size(); ++k) {
        if (pole.words[k].axis != axis) continue;
        given = true;
        c.value = pole.words[k].value;
        if (!pole.incremental[k]) c.mode = ir::CenterMode::absolute;
      }
      const bool all_incremental = !pole.words.empty() && std::find(pole.incremental.begin(), pole.incremental.end(),
                                                                    false) == pole.incremental.end();
      given = given || all_incremental;
      if (!given || (!c.value.literal() && a.written)) return false;
      if (c.mode == ir::CenterMode::from_start && a.moved) return false;
      centres.push_back(std::move(c));
    }
    std::get<ir::Block>(item.statement.node).motion.centers = std::move(centres);
    return true;
  }
  void by_datum(Item& item, const ir::PlaneAxes& plane) {
    poles_stay_ = true;
    auto& m = std::get<ir::Block>(item.statement.node).motion;
    for (const bool first : {true, false}) {
      ir::CenterWord c;
      c.axis = first ? plane.u : plane.v;
      c.mode = ir::CenterMode::absolute;
      c.value = pole_datum(first);
      m.centers.push_back(std::move(c));
    }
  }
  bool pole_statement(Item& item) {
    const Pole& pole = flat_.poles[static_cast<std::size_t>(item.index)];
    ir::PoleSet set;
    if (!pole.words.empty()) {
      auto change = std::make_shared<ir::FrameChange>();
      const auto incremental = std::count(pole.incremental.begin(), pole.incremental.end(), true);
      if (incremental != 0 && incremental != static_cast<std::ptrdiff_t>(pole.words.size())) {
        lowering_.report().start(item.statement.line.span);
        lowering_.report().refuse("HEI-008", {}, "CC with an absolute and an incremental word is not carried here");
        return false;
      }
      change->combine = incremental != 0 ? ir::FrameCombine::compose : ir::FrameCombine::replace;
      change->words = pole.words;
      set.at = std::move(change);
    }
    ir::Block b;
    b.actions.emplace_back().data = std::move(set);
    item.statement.node = std::move(b);
    return true;
  }

  // --- cycles --------------------------------------------------------------------------------------------------------

  [[nodiscard]] bool differs(std::int16_t q) const {
    const QValue* first = nullptr;
    for (const auto& c : flat_.cycles) {
      const auto it = c.values.find(q);
      if (c.row == nullptr || !c.row->called || it == c.values.end()) continue;
      if (first != nullptr && !ir::equal(first->value, it->second.value)) return true;
      first = &it->second;
    }
    return false;
  }
  /// PREDEF is the value of GLOBAL DEF, where the file has one only.
  void link_globals() {
    for (auto& c : flat_.cycles) {
      for (auto& [q, v] : c.values) {
        const auto it = lowering_.globals().find(q);
        if (v.kind != QValue::Kind::linked || it == lowering_.globals().end()) continue;
        const auto& all = it->second;
        if (!std::all_of(all.begin(), all.end(), [&all](const auto& one) { return ir::equal(one, all.front()); }))
          continue;
        v.kind = QValue::Kind::value;
        v.value = all.front();
      }
    }
  }
  /// Parameters whose Q the program itself uses, or that are computed: the definition sets them.
  void find_stored() {
    for (std::size_t i = 0; i < flat_.items.size(); ++i) {
      several_ = several_ || (flat_.items[i].call != CycleCall::none && arrival(i).cycle == Arrival::several);
    }
    for (const auto& c : flat_.cycles) {
      for (const auto& [q, v] : c.values) {
        const bool used = lowering_.own_reads().count(q) != 0 || lowering_.own_writes().count(q) != 0;
        if (used || !v.value.literal() || (several_ && differs(q))) stored_.insert(q);
      }
    }
  }
  void definition(const Item& item, std::vector<ir::Statement>& out) {
    const CycleDefinition& cycle = flat_.cycles[static_cast<std::size_t>(item.index)];
    ir::Assign assign;
    for (const auto& [q, v] : cycle.values) {
      if (stored_.count(q) == 0) continue;
      ir::Assign::Item one;
      one.target.space = facts::space_q;
      one.target.index = ir::number(q);
      one.value = ir::as_expr(v.value);
      assign.items.push_back(std::move(one));
    }
    if (assign.items.empty()) return;
    ir::Statement s = item.statement;
    s.node = std::move(assign);
    out.push_back(std::move(s));
  }
  [[nodiscard]] ir::Value parameter(const CycleDefinition& cycle, std::int16_t q, bool any) const {
    const auto it = cycle.values.find(q);
    if (it == cycle.values.end()) return ir::Value(0);
    const bool variable = lowering_.own_writes().count(q) != 0 || !it->second.value.literal() || (any && differs(q));
    return variable ? ir::Value(ir::numbered(facts::space_q, q)) : it->second.value;
  }
  /// The definition in force; null and a fault: which one that is can't be told.
  const CycleDefinition* in_force(const Item& item, const Arrival& a) {
    Report& report = lowering_.report();
    report.start(item.statement.line.span);
    if (!a.reached) return nullptr;
    if (a.cycle == Arrival::none) {
      report.refuse("HEI-017", {}, "a cycle is called, and no CYCL DEF stands before it", "define it in this file");
      return nullptr;
    }
    if (a.outside && !std::exchange(outside_told_, true)) {
      report.warn("HEI-017", {},
                  "a program of another file runs between the definition of the cycle and its call: it is taken to "
                  "define no other one (said once a file)");
    }
    if (a.cycle != Arrival::several) return &flat_.cycles[static_cast<std::size_t>(a.cycle)];
    const CycleDefinition* first = nullptr;
    for (const auto& c : flat_.cycles) {
      if (c.row != nullptr ? !c.row->called : c.old != nullptr && !c.old->called) continue;
      if ((first != nullptr && (first->number != c.number || c.row == nullptr)) || c.row == nullptr) {
        report.refuse("HEI-017", {}, "which cycle is called here depends on the way to this block",
                      "define the cycle right before its call");
        return nullptr;
      }
      first = &c;
    }
    return first;
  }
  ir::CyclePtr cycle_at(const Item& item, const Arrival& a, const CycleDefinition* overlay) {
    const CycleDefinition* cycle = in_force(item, a);
    if (cycle == nullptr) return nullptr;
    const bool any = a.cycle == Arrival::several;
    if (a.overlaid && overlay == nullptr && heights_differ(*cycle)) {
      lowering_.report().refuse("HEI-017", {},
                                "cycle 220 or 221 has left other heights (Q200, Q203, Q204) for this cycle",
                                "define the cycle again behind the pattern");
      return nullptr;
    }
    CycleContext context;
    context.shift = item.shift;
    context.inch = lowering_.inch();
    context.value = [&](std::int16_t q) {
      const bool height = q == 200 || q == 203 || q == 204;
      if (overlay == nullptr || !height) return parameter(*cycle, q, any);
      return overlay->values.at(q).value;
    };
    return build_cycle(*cycle, context, lowering_.report());
  }
  [[nodiscard]] bool heights_differ(const CycleDefinition& cycle) const {
    for (const auto& c : flat_.cycles) {
      if (c.row == nullptr || c.row->kind != facts::CycleKind::pattern) continue;
      for (const auto q : std::initializer_list<std::int16_t>{200, 203, 204}) {
        const auto mine = cycle.values.find(q);
        if (mine == cycle.values.end() || !ir::equal(mine->second.value, c.values.at(q).value)) return true;
      }
    }
    return false;
  }
  /// Cycle 12: a program is the machining cycle.
  bool program_call(Item& item, const Arrival& a, std::vector<ir::Statement>& out) {
    const CycleDefinition* cycle =
        a.reached && a.cycle >= 0 ? &flat_.cycles[static_cast<std::size_t>(a.cycle)] : nullptr;
    if (cycle == nullptr || cycle->old == nullptr || cycle->old->kind != facts::OldKind::program) return false;
    const auto part = cycle->parts.find(1);
    std::string_view text = part == cycle->parts.end() ? std::string_view{} : std::string_view(part->second.text);
    constexpr std::string_view word = "PGM";
    if (iequals_ascii(text.substr(0, word.size()), word)) text.remove_prefix(word.size());
    ir::CallRoutine routine;
    routine.routine.text = program_name(text);
    routine.level = ir::CallLevel::new_level;
    if (item.shift || routine.routine.text.empty()) return false;
    const auto* block = std::get_if<ir::Block>(&item.statement.node);
    if (block != nullptr && block->empty()) {
      item.statement.node = std::move(routine);
      out.push_back(std::move(item.statement));
      return true;
    }
    out.push_back(std::move(item.statement));
    out.push_back(behind(out.back(), std::move(routine)));
    return true;
  }
  void call(std::size_t i, std::vector<ir::Statement>& out) {
    Item& item = flat_.items[i];
    if (program_call(item, arrival(i), out)) return;
    const ir::CyclePtr cycle = cycle_at(item, arrival(i), nullptr);
    auto* block = std::get_if<ir::Block>(&item.statement.node);
    if (cycle == nullptr) {
      if (!lowering_.report().refused()) {  // depth 0, or never reached
        out.push_back(std::move(item.statement));
        return;
      }
      out.push_back(std::move(item.statement));
      ir::Opaque o;
      o.text = "CYCL CALL";
      o.feature = lowering_.report().feature();
      out.push_back(behind(out.back(), std::move(o)));
      return;
    }
    ir::CycleDefine define;
    define.cycle = cycle;
    define.modal = false;
    if (block != nullptr && block->empty()) {
      block->actions.emplace_back().data = std::move(define);
      out.push_back(std::move(item.statement));
      return;
    }
    out.push_back(std::move(item.statement));
    ir::Block run;
    run.actions.emplace_back().data = std::move(define);
    out.push_back(behind(out.back(), std::move(run)));
  }
  static ir::CoordWord coordinate(ir::AxisId axis, double v) {
    ir::CoordWord c;
    c.axis = axis;
    c.mode = ir::WordMode::absolute;
    c.value = ir::Value(v);
    return c;
  }
  /// 220 and 221: to the second clearance, from point to point, the cycle at each.
  void pattern(std::size_t i, std::vector<ir::Statement>& out) {
    Item& item = flat_.items[i];
    const CycleDefinition& own = flat_.cycles[static_cast<std::size_t>(item.index)];
    const Arrival& a = arrival(i);
    Report& report = lowering_.report();
    const ir::CyclePtr cycle = cycle_at(item, a, &own);
    const auto points = cycle ? pattern_points(own, report) : std::vector<PatternPoint>{};
    if (cycle == nullptr || points.empty()) {
      ir::Opaque o;
      o.text = "CYCL DEF " + std::to_string(own.number);
      o.feature = report.feature().empty() ? "cycle.pattern" : report.feature();
      o.harmless = !report.refused();
      item.statement.node = std::move(o);
      out.push_back(std::move(item.statement));
      return;
    }
    auto hole = std::get<ir::HoleCycle>(cycle->node);
    const bool low = own.values.at(301).value.is(0);
    if (low) hole.retract = hole.reference;
    const auto plane = ir::plane_axes(a.plane == Arrival::several ? ir::Plane::xy : static_cast<ir::Plane>(a.plane));
    const auto number = [&own](std::int16_t q) { return own.values.at(q).value.number; };
    const double top = number(203) + std::max(number(204), number(200));
    const auto rapid = [](std::vector<ir::CoordWord> words) {
      ir::Block b;
      b.has_motion = true;
      b.motion.kind = ir::MotionKind::rapid;
      b.motion.explicit_code = true;
      b.motion.coords = std::move(words);
      return b;
    };
    item.statement.node = rapid({coordinate(plane.w, top)});
    out.push_back(std::move(item.statement));
    const ir::Statement first = out.back();
    for (std::size_t k = 0; k < points.size(); ++k) {
      ir::Block b = rapid({coordinate(plane.u, points[k].u), coordinate(plane.v, points[k].v)});
      if (k == 0) {
        ir::CycleDefine define;
        define.cycle = std::make_shared<const ir::Cycle>(ir::Cycle{hole});
        b.actions.emplace_back().data = std::move(define);
      }
      out.push_back(behind(first, std::move(b)));
    }
    ir::Block cancel;
    cancel.actions.emplace_back().data = ir::CycleCancel{};
    out.push_back(behind(first, std::move(cancel)));
    if (low) out.push_back(behind(first, rapid({coordinate(plane.w, top)})));
  }

  void one(std::size_t i, std::vector<ir::Statement>& out) {
    Item& item = flat_.items[i];
    const Arrival& a = arrival(i);
    const bool remark = !item.statement.line.comments.empty() || !item.statement.line.labels.empty();
    switch (item.kind) {
      case ItemKind::cycle: definition(item, out); return;
      case ItemKind::pole:
        if (poles_stay_ ? pole_statement(item) : remark) out.push_back(std::move(item.statement));
        return;
      case ItemKind::sub_end:
        if (remark) out.push_back(std::move(item.statement));
        return;
      default: break;
    }
    if (item.kind != ItemKind::plain) {
      out.push_back(std::move(item.statement));
      return;
    }
    if (item.index >= 0) return pattern(i, out);
    const bool modal = item.moves && a.reached && a.modal == 1 && item.call == CycleCall::none;
    if (item.moves && a.reached && a.modal == Arrival::several) {
      Report& report = lowering_.report();
      report.start(item.statement.line.span);
      report.refuse("HEI-017", {}, "whether M89 is in force here depends on the way to this block",
                    "write M99 where the cycle shall run");
    }
    if (modal || item.call != CycleCall::none) return call(i, out);
    out.push_back(std::move(item.statement));
  }

  Lowering& lowering_;
  const Flow& flow_;
  Flat& flat_;
  bool poles_stay_ = false, several_ = false, outside_told_ = false;
  std::set<std::int16_t> stored_;
};

}  // namespace

void finish_items(Lowering& lowering, const Flow& flow, std::vector<std::vector<ir::Statement>>& statements) {
  Finisher(lowering, flow).run(statements);
}

}  // namespace cnctrans::frontends::heidenhain
