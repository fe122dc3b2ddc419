#include "frontends/heidenhain/program/finish.h"

#include <algorithm>
#include <utility>

#include "frontends/heidenhain/program/cycle_calls.h"
#include "frontends/heidenhain/state/datum.h"
#include "frontends/heidenhain/ways/from_pole.h"

namespace cnctrans::frontends::heidenhain {

namespace {

ir::Value pole_datum(bool first) {
  return ir::Value(datum(first ? ir::Datum::pole_first : ir::Datum::pole_second, "CC"));
}

class Finisher {
 public:
  Finisher(Lowering& lowering, const Flow& flow)
      : lowering_(lowering), flow_(flow), flat_(lowering.flat()), cycles_(lowering, flow) {}

  void run(std::vector<std::vector<ir::Statement>>& out) {
    for (std::size_t i = 0; i < flat_.items.size(); ++i) {
      other_planes(i);
      if (flat_.items[i].polar) poles_stay_ = true;
      if (flat_.items[i].by_pole && !(flat_.items[i].contour && !arrival(i).reached)) centre(i);
    }
    cycles_.prepare();
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

  /// A pole along the tool axis counts for the lines that were read about it, and for no others.
  void other_planes(std::size_t i) {
    Item& item = flat_.items[i];
    const Arrival& a = arrival(i);
    if (!a.reached || !(item.polar || item.by_pole || item.other_pole >= 0)) return;
    const Pole* pole = a.pole < 0 ? nullptr : &flat_.poles[static_cast<std::size_t>(a.pole)];
    const bool other = pole != nullptr && pole->other;
    if (item.other_pole < 0 ? !other : a.pole == item.other_pole && !a.written) return;
    lowering_.report().start(item.statement.line.span);
    lowering_.report().keep("HEI-008", {},
                            "whether CC lies in the plane of the tool here, and where, depends on the way",
                            "motion.geometry", "write the points with L");
    keep_text(item, "motion.geometry", "LP");
    item.polar = false;
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
      if (given && c.mode == ir::CenterMode::from_start && a.moved) {
        const auto from = from_pole(flat_, a);
        if (!from) return false;
        c.value = ir::negate(axis == plane.u ? from->first : from->second);
        given = c.value.literal() || !a.changed;
      } else if (!c.value.literal() && a.written) {
        given = false;
      }
      if (!given) return false;
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

  /// CALL SELECTED PGM: the program of the SEL PGM that the ways bring.
  void selected(Item& item, const Arrival& a) {
    Report& report = lowering_.report();
    report.start(item.statement.line.span);
    if (a.selected >= 0) {
      std::get<ir::CallRoutine>(item.statement.node).routine.text =
          flat_.programs[static_cast<std::size_t>(a.selected)];
      if (a.selected_outside)
        report.warn("HEI-011", {},
                    "a program of another file runs between SEL PGM and this call: it is taken to select "
                    "no other one");
    } else if (a.reached) {
      report.refuse("HEI-011", {},
                    a.selected == Arrival::none ? "CALL SELECTED PGM has no SEL PGM before it in this file"
                                                : "which SEL PGM is in force here depends on the way to this block");
      keep_text(item, "language.statement", "CALL SELECTED PGM");
    }
  }
  void one(std::size_t i, std::vector<ir::Statement>& out) {
    Item& item = flat_.items[i];
    const Arrival& a = arrival(i);
    const bool remark = !item.statement.line.comments.empty() || !item.statement.line.labels.empty();
    if (item.contour && !a.reached) {  // its lines are in the cycles that work on it
      if (item.statement.line.comments.empty()) return;
      item.statement.node = ir::Block{};
      item.statement.line.number = {};
      item.statement.line.labels.clear();
      out.push_back(std::move(item.statement));
      return;
    }
    switch (item.kind) {
      case ItemKind::cycle: cycles_.definition(item, out); return;
      case ItemKind::pole:
        if (poles_stay_ && !flat_.poles[static_cast<std::size_t>(item.index)].other ? pole_statement(item) : remark)
          out.push_back(std::move(item.statement));
        return;
      case ItemKind::sub_end:
        if (remark) out.push_back(std::move(item.statement));
        return;
      default: break;
    }
    if (item.calls_selected) selected(item, a);
    if (item.kind != ItemKind::plain) {
      out.push_back(std::move(item.statement));
      return;
    }
    if (item.index >= 0) return cycles_.pattern(i, out);
    if (item.at_pattern) return cycles_.at_points(i, out);
    const bool modal = item.moves && a.reached && a.modal == 1 && item.call == CycleCall::none;
    if (item.moves && a.reached && a.modal == Arrival::several) {
      Report& report = lowering_.report();
      report.start(item.statement.line.span);
      report.refuse("HEI-017", {}, "whether M89 is in force here depends on the way to this block",
                    "write M99 where the cycle shall run");
    }
    if (modal || item.call != CycleCall::none) return cycles_.call(i, out);
    out.push_back(std::move(item.statement));
  }

  Lowering& lowering_;
  const Flow& flow_;
  Flat& flat_;
  CycleCalls cycles_;
  bool poles_stay_ = false;
};

}  // namespace

void finish_items(Lowering& lowering, const Flow& flow, std::vector<std::vector<ir::Statement>>& statements) {
  Finisher(lowering, flow).run(statements);
}

}  // namespace cnctrans::frontends::heidenhain
