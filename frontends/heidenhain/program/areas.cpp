#include "frontends/heidenhain/program/areas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "frontends/heidenhain/ways/way.h"
#include "interpreter/machine/profile_contour.h"
#include "ir/cycles/milling/pocket_area.h"

namespace cnctrans::frontends::heidenhain {

namespace {

using dialects::heidenhain::Contours;
using ir::cycles::MillContour;

struct Box {
  double u0 = 1e300, v0 = 1e300, u1 = -1e300, v1 = -1e300;
  void add(double u, double v) {
    u0 = std::min(u0, u);
    v0 = std::min(v0, v);
    u1 = std::max(u1, u);
    v1 = std::max(v1, v);
  }
  [[nodiscard]] bool within(const Box& b) const { return u0 >= b.u0 && v0 >= b.v0 && u1 <= b.u1 && v1 <= b.v1; }
  [[nodiscard]] bool apart(const Box& b) const { return u1 < b.u0 || b.u1 < u0 || v1 < b.v0 || b.v1 < v0; }
};
Box box_of(const MillContour& c) {
  Box box;
  for (const auto& e : c.elements) {
    box.add(e.u0, e.v0);
    box.add(e.u1, e.v1);
    const double r = std::hypot(e.u0 - e.cu, e.v0 - e.cv);
    if (!e.arc) continue;
    box.add(e.cu - r, e.cv - r);
    box.add(e.cu + r, e.cv + r);
  }
  return box;
}
/// Above 0: counter-clockwise.
double signed_area(const MillContour& c) {
  double twice = 0;
  for (const auto& e : c.elements) {
    twice += e.u0 * e.v1 - e.u1 * e.v0;
    if (!e.arc) continue;
    const double a = std::atan2(e.v0 - e.cv, e.u0 - e.cu), b = std::atan2(e.v1 - e.cv, e.u1 - e.cu);
    double turn = b - a;
    constexpr double full = 6.283185307179586;
    if (e.ccw && turn <= 1e-9) turn += full;
    if (!e.ccw && turn >= -1e-9) turn -= full;
    const double r = std::hypot(e.u0 - e.cu, e.v0 - e.cv);
    twice += r * r * (turn - std::sin(turn));  // the segment beside the chord
  }
  return twice;
}

class AreaReader {
 public:
  AreaReader(Lowering& lowering, const machine::Profile& profile)
      : lowering_(lowering), profile_(profile), flat_(lowering.flat()) {}

  void run() {
    for (auto& c : flat_.cycles) {
      if (!c.labels.empty()) c.area_fault = areas(c);
    }
  }

 private:
  struct Contour {
    MillContour line;
    bool pocket = false;
    int side = 0;
  };

  std::string areas(CycleDefinition& cycle) {
    std::vector<Contour> all;
    if (cycle.row->contours != Contours::areas) {
      Contour c;
      if (cycle.labels.size() != 1) return "it takes one contour";
      if (std::string fault = contour(cycle, cycle.labels[0], c); !fault.empty())
        return "LBL " + cycle.labels[0] + ": " + fault;
      cycle.side = c.side;
      cycle.areas.push_back({std::move(c.line)});
      return {};
    }
    for (const auto& label : cycle.labels) {
      Contour c;
      if (std::string fault = contour(cycle, label, c); !fault.empty()) return "LBL " + label + ": " + fault;
      all.push_back(std::move(c));
    }
    if (std::string fault = pockets(all, cycle.areas); !fault.empty()) return fault;
    if (cycle.areas.empty()) return "none of the contours is a pocket";
    for (const Contour& c : all) {
      if (c.pocket) continue;
      const Box box = box_of(c.line);
      bool inside = false;
      for (auto& area : cycle.areas) {
        if (box.apart(box_of(area.front()))) continue;
        area.push_back(c.line);
        inside = true;
      }
      if (!inside) return "an island lies in no pocket";
    }
    return {};
  }

  static std::string pockets(const std::vector<Contour>& all, std::vector<std::vector<MillContour>>& areas) {
    std::vector<MillContour> open;
    std::vector<std::size_t> group;  // the first pocket of those that hang together
    for (const Contour& c : all) {
      if (!c.pocket) continue;
      group.push_back(open.size());
      for (std::size_t k = 0; k < open.size(); ++k) {
        if (box_of(open[k]).apart(box_of(c.line))) continue;
        const std::size_t mine = group.back(), other = group[k];
        for (auto& g : group) {
          if (g == mine || g == other) g = std::min(mine, other);
        }
      }
      open.push_back(c.line);
    }
    for (std::size_t first = 0; first < open.size(); ++first) {
      std::vector<MillContour> together;
      for (std::size_t i = first; i < open.size(); ++i) {
        if (group[i] == first) together.push_back(open[i]);
      }
      if (together.size() == 1) areas.push_back(together);
      if (together.size() < 2) continue;
      if (std::string fault = join(together, areas); !fault.empty()) return fault;
    }
    return {};
  }
  /// Pockets that overlap are one; where the first one begins inside the second, it is what both have (17.3).
  static std::string join(const std::vector<MillContour>& pockets, std::vector<std::vector<MillContour>>& areas) {
    using ir::cycles::PocketArea;
    constexpr double tolerance = 0.001;
    std::string fault;
    bool inside = false;
    for (std::size_t k = 1; k < pockets.size(); ++k) {
      const auto later = PocketArea::joined({pockets[k]}, false, tolerance, &fault);
      if (!later) return fault;
      for (const auto& piece : later->inside(0)) {
        inside = inside || std::any_of(pockets.begin(), pockets.begin() + static_cast<std::ptrdiff_t>(k), [&](auto& p) {
                   return ir::cycles::contains(piece, p.elements.front().u0, p.elements.front().v0);
                 });
      }
    }
    if (inside && pockets.size() > 2)
      return "one of three pockets or more begins inside of a later one: which part of them is meant is not described";
    const auto joined = PocketArea::joined(pockets, inside, tolerance, &fault);
    if (!joined) return fault;
    for (auto& piece : joined->inside(0)) {
      auto& area = areas.emplace_back();
      area.push_back({std::move(piece.outside), {}, {}});
      for (auto& hole : piece.islands) area.push_back({std::move(hole), {}, {}});
    }
    return {};
  }

  std::string contour(CycleDefinition& cycle, const std::string& label, Contour& out) {
    const Contours kind = cycle.row->contours;
    std::size_t first = 0;
    while (first < flat_.items.size() && !(flat_.items[first].kind == ItemKind::label && flat_.items[first].number &&
                                           flat_.items[first].label == label))
      ++first;
    if (first == flat_.items.size()) return "there is no such label in this file";
    Way way(flat_);
    std::vector<ir::Statement> statements;
    int side = 0;
    std::size_t i = first + 1;
    for (; i < flat_.items.size() && flat_.items[i].kind != ItemKind::sub_end; ++i) {
      const Item& item = flat_.items[i];
      const auto* b = std::get_if<ir::Block>(&item.statement.node);
      const auto* o = std::get_if<ir::Opaque>(&item.statement.node);
      way.step(item);
      if (item.kind == ItemKind::pole || item.kind == ItemKind::label || (o != nullptr && o->harmless)) continue;
      if (item.kind != ItemKind::plain || b == nullptr) return "it holds more than lines and arcs";
      for (const auto& a : b->actions) {
        if (std::holds_alternative<ir::FrameOp>(a.data)) return "it holds a coordinate transformation";
      }
      if (side == 0) side = way.side().value_or(0);
      ir::Statement s;
      s.line.span = item.statement.line.span;
      if (kind == Contours::middle_line && item.leads_on) continue;
      ir::Block block = *b;
      if (item.by_pole || item.polar) {
        if (!way.pole() || !way.pole()->literal()) return "its pole is no point by numbers";
        if (std::string fault = resolve(item, way, block); !fault.empty()) return fault;
      }
      if (kind == Contours::middle_line && statements.empty()) {  // the way onto its first point may be an arc
        block.motion.kind = ir::MotionKind::linear;
        block.motion.centers.clear();
      }
      if (kind == Contours::developed) {
        if (std::string fault = develop(cycle, block.motion); !fault.empty()) return fault;
      }
      s.node = std::move(block);
      statements.push_back(std::move(s));
    }
    if (i == flat_.items.size()) return "it has no LBL 0";
    std::vector<const ir::Statement*> blocks;
    for (const auto& s : statements) blocks.push_back(&s);
    ir::ModalState modal = profile_.power_on;
    modal.units = lowering_.inch() ? ir::Units::inch : ir::Units::metric;
    std::string error;
    auto read =
        interpreter::mill_contours_of(profile_, modal, blocks, false, nullptr, &error, kind == Contours::line_in_space);
    if (!read) return error;
    out.line = std::move(read->front());
    out.side = side;
    const bool bounds = kind == Contours::areas;
    if (bounds) close(out.line);
    if (bounds && side == 0) return "RL or RR says whether it is a pocket or an island";
    out.pocket = bounds && (signed_area(out.line) > 0) == (side > 0);
    for (std::size_t k = first; k <= i; ++k) flat_.items[k].contour = true;
    return {};
  }
  /// Polar words and the centre become coordinates. `way` stands behind the block.
  static std::string resolve(const Item& item, const Way& way, ir::Block& b) {
    const auto p = way.plane();
    const auto& pole = *way.pole();
    const auto end = way.point();
    if (!end || !end->literal()) return "a point of it is not known by numbers";
    if (b.motion.extra != nullptr) {
      b.motion.extra = nullptr;
      b.motion.coords.clear();
      for (const bool first : {true, false}) {
        auto& c = b.motion.coords.emplace_back();
        c.axis = first ? p.u : p.v;
        c.mode = ir::WordMode::absolute;
        c.value = (first ? end->u : end->v).value();
      }
    }
    if (!item.by_pole) return {};
    b.motion.centers.clear();
    for (const bool first : {true, false}) {
      auto& c = b.motion.centers.emplace_back();
      c.axis = first ? p.u : p.v;
      c.mode = ir::CenterMode::absolute;
      c.value = (first ? pole.u : pole.v).value();
    }
    return {};
  }
  /// The words of a rotary and a linear axis become those of a plane: lengths around the cylinder and along it.
  static std::string develop(CycleDefinition& cycle, ir::Motion& m) {
    if (!m.centers.empty()) return "an arc on the cylinder is CR";
    for (auto& c : m.coords) {
      const bool rotary = c.axis == ir::axis::a || c.axis == ir::axis::b || c.axis == ir::axis::c;
      ir::AxisId& own = rotary ? cycle.around : cycle.along;
      if (own == ir::axis::none) own = c.axis;
      if (own != c.axis || (!rotary && c.axis != ir::axis::x && c.axis != ir::axis::y))
        return "it has a rotary axis and X or Y, always the same";
      c.axis = rotary ? ir::axis::x : ir::axis::y;
      const auto &radius = cycle.values.at(16).value, &lengths = cycle.values.at(17).value;
      if (!radius.literal() || !lengths.literal() || !c.value.literal()) return "its points and Q16 must be numbers";
      if (rotary && lengths.is(0)) c.value = ir::Value(c.value.number * std::numbers::pi / 180 * radius.number);
    }
    return {};
  }
  /// An open contour is closed by a straight line.
  static void close(MillContour& c) {
    const auto &a = c.elements.front(), &b = c.elements.back();
    if (std::hypot(a.u0 - b.u1, a.v0 - b.v1) < 1e-6) return;
    c.elements.push_back({b.u1, b.v1, a.u0, a.v0});
  }

  Lowering& lowering_;
  const machine::Profile& profile_;
  Flat& flat_;
};

}  // namespace

void read_areas(Lowering& lowering, const machine::Profile& profile) {
  const auto& cycles = lowering.flat().cycles;
  if (std::any_of(cycles.begin(), cycles.end(), [](const auto& c) { return !c.labels.empty(); }))
    AreaReader(lowering, profile).run();
}

}  // namespace cnctrans::frontends::heidenhain
