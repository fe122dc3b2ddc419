// Patterns of points (equivalences 23): in the words of the target, else a block for each point.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/text.h"
#include "ir/cycles/pattern.h"
#include "ir/cycles/words.h"
#include "legaliser/cycles/parts/cycle_parts.h"

namespace cnctrans::ir::passes {

namespace {

using cycles::PatternKind;
using cycles::PatternPoint;

struct PatternPlace {
  AxisId u = axis::x, v = axis::y;
  std::optional<double> at_u, at_v;  ///< program units
};

std::optional<PatternPlace> place(const Block& b, const Facts& facts) {
  const auto plane = setting_in<Plane>(b, facts, Setting::plane);
  if (!plane) return std::nullopt;
  const auto axes = plane_axes(*plane);
  PatternPlace p;
  p.u = axes.u;
  p.v = axes.v;
  p.at_u = facts.position[axes.u];
  p.at_v = facts.position[axes.v];
  return p;
}

/// The words as numbers in program units; nullopt: computed when the program runs.
std::optional<cycles::PatternNumbers> numbers_of(const NamedCycle& pattern) {
  cycles::PatternNumbers numbers;
  for (const auto& [word, v] : pattern.words) {
    const auto* p = cycles::find_pattern_parameter(word);
    const auto x = v.literal() ? std::optional(v.number) : constant_value(v.expr);
    if (p == nullptr || !x) return std::nullopt;
    numbers[p->name] = *x;
  }
  return numbers;
}

double clean_point(double x) {
  const double r = std::round(x * 1e9) / 1e9;
  return r == 0 ? 0 : r;
}

CoordWord coordinate(AxisId axis, double value, bool absolute) {
  CoordWord c;
  c.axis = axis;
  c.mode = absolute ? WordMode::absolute : WordMode::incremental;
  c.value = Value{clean_point(value)};
  return c;
}

CenterWord centre(AxisId axis, double value) {
  CenterWord c;
  c.axis = axis;
  c.value = Value{clean_point(value)};
  return c;
}

MotionKind kind_of(PatternPoint::Way way) {
  switch (way) {
    case PatternPoint::Way::rapid: return MotionKind::rapid;
    case PatternPoint::Way::linear: return MotionKind::linear;
    case PatternPoint::Way::cw: return MotionKind::arc_cw;
    case PatternPoint::Way::ccw: break;
  }
  return MotionKind::arc_ccw;
}

/// Points as they stand, computed ones too.
Body listed_points(const NamedCycle& pattern, const LineInfo& like, const PatternPlace& at) {
  Body blocks;
  for (char digit = '1'; digit <= '9'; ++digit) {
    const Value* u = cycles::find_word(pattern, std::string{'u', digit});
    const Value* v = cycles::find_word(pattern, std::string{'v', digit});
    if (u == nullptr && v == nullptr) continue;
    Block block;
    block.has_motion = true;
    block.motion.kind = MotionKind::rapid;
    block.motion.explicit_code = true;
    block.motion.keeps_modal = false;
    block.motion.coords = {coordinate(at.u, 0, true), coordinate(at.v, 0, true)};
    if (u != nullptr) block.motion.coords[0].value = *u;
    if (v != nullptr) block.motion.coords[1].value = *v;
    blocks.push_back(made(like, std::move(block)));
  }
  return blocks;
}

}  // namespace

const NamedCycle* pattern_in(const Block& b) {
  for (const auto& a : b.actions) {
    const auto* d = std::get_if<CycleDefine>(&a.data);
    const auto* named = d != nullptr && d->cycle ? std::get_if<NamedCycle>(&d->cycle->node) : nullptr;
    if (named != nullptr && cycles::find_pattern(named->name) != nullptr) return named;
  }
  return nullptr;
}

std::optional<Body> pattern_blocks(const NamedCycle& pattern, const LineInfo& like, const Block& b, const Facts& facts,
                                   bool* guessed, std::string* error) {
  const auto* row = cycles::find_pattern(pattern.name);
  const auto at = place(b, facts);
  const auto numbers = numbers_of(pattern);
  if (row != nullptr && at && row->kind == PatternKind::list) return listed_points(pattern, like, *at);
  if (row == nullptr || !at || !numbers) {
    *error = at ? "" : "the plane is not known here";
    return std::nullopt;
  }
  const bool known = at->at_u && at->at_v;
  if (!known && row->from_tool && facts.modal_call != 0) {
    *error = "it counts from the tool, and where the modal subprogram leaves it is not known here";
    return std::nullopt;
  }
  if (row->kind == PatternKind::row && numbers->contains("count") && numbers->at("count") > 1) {
    const double angle = numbers->contains("angle") ? numbers->at("angle") * std::acos(-1.0) / 180 : 0;
    const bool by_u = std::fabs(std::cos(angle)) > 1e-9, by_v = std::fabs(std::sin(angle)) > 1e-9;
    *guessed = (by_u && !at->at_u) || (by_v && !at->at_v);
  }
  const auto points = cycles::pattern_points(*row, *numbers, at->at_u.value_or(0), at->at_v.value_or(0), error);
  if (!points) return std::nullopt;
  const bool absolute = known || !row->from_tool;
  Body blocks;
  LineInfo line;
  line.span = like.span;
  line.skip_mask = like.skip_mask;
  double u = at->at_u.value_or(0), v = at->at_v.value_or(0);
  for (const auto& p : *points) {
    Block block;
    block.has_motion = true;
    block.motion.kind = kind_of(p.way);
    block.motion.explicit_code = true;
    block.motion.keeps_modal = false;
    const bool arc = p.way == PatternPoint::Way::cw || p.way == PatternPoint::Way::ccw;
    if (arc || std::fabs(p.u - u) > 1e-9 || (!known && absolute))
      block.motion.coords.push_back(coordinate(at->u, absolute ? p.u : p.u - u, absolute));
    if (arc || std::fabs(p.v - v) > 1e-9 || (!known && absolute))
      block.motion.coords.push_back(coordinate(at->v, absolute ? p.v : p.v - v, absolute));
    if (block.motion.coords.empty()) block.motion.coords.push_back(coordinate(at->u, absolute ? p.u : 0, absolute));
    if (arc && !known) {
      *error = "the tool goes from point to point on arcs, and where it stands is not known here";
      return std::nullopt;
    }
    if (arc) {
      block.motion.centers.push_back(centre(at->u, p.centre_u - u));
      block.motion.centers.push_back(centre(at->v, p.centre_v - v));
    }
    if (p.way != PatternPoint::Way::rapid) block.actions.push_back(action(SetFeed{Value{p.feed}, false, true}));
    u = p.u;
    v = p.v;
    blocks.push_back(made(line, std::move(block)));
  }
  return blocks;
}

void balance_increments(Body& points, const Statement& s, const Block& b, const Facts& facts,
                        const LegaliseContext& context) {
  const bool inch = setting_in<Units>(b, facts, Setting::units) == Units::inch;
  const double place = std::pow(10, inch ? context.target.word_decimals_inch : context.target.word_decimals);
  std::map<AxisId, std::pair<double, double>> way;  // exact, and as it is written
  double most = 0;
  for (auto& p : points) {
    auto* block = std::get_if<Block>(&p.node);
    if (block == nullptr || !block->has_motion || !block->motion.centers.empty()) continue;
    for (auto& c : block->motion.coords) {
      if (c.mode != WordMode::incremental || !c.value.literal()) continue;
      auto& [exact, written] = way[c.axis];
      exact += c.value.number;
      c.value = Value{clean_point(std::round(exact * place) / place - written)};
      written += c.value.number;
      most = std::max(most, std::fabs(exact - written));
    }
  }
  if (most < 1e-8) return;
  context.diagnostics.warning("TRN-626", s.line.span,
                              "the points of the pattern are written as increments, since the place before it is not "
                              "known: rounded for the target, every point stands at most " +
                                  shortest(0.5 / place) + " beside its place on each axis",
                              "move the tool to a place in the plane before it");
}

std::optional<CyclePtr> native_pattern(const NamedCycle& pattern, const Block& b, const Facts& facts,
                                       const LegaliseContext& context) {
  const auto& native = context.target.native_cycle;
  if (!native || context.options.cycles == CycleWriting::explode) return std::nullopt;
  const auto accepted = [&](NamedCycle c) -> std::optional<CyclePtr> {
    auto said = std::make_shared<Cycle>();
    said->node = std::move(c);
    if (!native(*said)) return std::nullopt;
    return CyclePtr(std::move(said));
  };
  if (auto as_is = accepted(pattern)) return as_is;
  const auto* row = cycles::find_pattern(pattern.name);
  const auto at = place(b, facts);
  const auto numbers = numbers_of(pattern);
  if (row == nullptr || !at || !at->at_u || !at->at_v || !numbers || numbers->contains("skip1")) return std::nullopt;
  std::string error;
  const auto points = cycles::pattern_points(*row, *numbers, *at->at_u, *at->at_v, &error);
  if (!points || points->empty()) return std::nullopt;
  for (const auto& p : *points) {
    if (p.way != PatternPoint::Way::rapid) return std::nullopt;
  }
  const auto count = Value{static_cast<double>(points->size())};
  NamedCycle c;
  if (row->kind == PatternKind::line) {
    // A row from the point that is done: the tool stands at its nearer end.
    const double step = std::hypot(points->front().u - *at->at_u, points->front().v - *at->at_v);
    const double angle = cycles::find_word(pattern, "angle") != nullptr ? numbers->at("angle") : 0;
    const double radians = angle * std::acos(-1.0) / 180;
    const double along =
        std::cos(radians) * (points->front().u - *at->at_u) + std::sin(radians) * (points->front().v - *at->at_v);
    const double turned = angle + (along < 0 ? 180 : 0);
    c.name = "points.row";
    c.words = {{"u", Value{*at->at_u}},
               {"v", Value{*at->at_v}},
               {"angle", Value{turned}},
               {"first", Value{clean_point(step)}},
               {"step", Value{clean_point(step)}},
               {"count", count}};
    return accepted(std::move(c));
  }
  if (row->kind == PatternKind::circle || row->kind == PatternKind::arc) {
    const double cu = numbers->at("centre_u"), cv = numbers->at("centre_v");
    const double radius = std::hypot(cu, cv), degrees = 180 / std::acos(-1.0);
    const double start = std::atan2(-cv, -cu) * degrees;
    const double first = std::atan2(points->front().v - *at->at_v - cv, points->front().u - *at->at_u - cu) * degrees;
    double step = first - start;
    if (numbers->contains("angle_step")) {
      step = numbers->at("angle_step");
    } else {
      while (step <= 0) step += 360;
    }
    c.name = "points.ring";
    c.words = {{"u", Value{clean_point(*at->at_u + cu)}}, {"v", Value{clean_point(*at->at_v + cv)}},
               {"radius", Value{clean_point(radius)}},    {"angle", Value{clean_point(start + step)}},
               {"angle_step", Value{clean_point(step)}},  {"count", count}};
    return accepted(std::move(c));
  }
  return std::nullopt;
}

}  // namespace cnctrans::ir::passes
