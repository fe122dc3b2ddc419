// Contours whose points follow from later blocks: they wait until the data close, then go out one after the other.
#include "interpreter/machine/block_machine.h"
#include "interpreter/trace/run_codes.h"

namespace cnctrans::interpreter {

bool BlockMachine::contour_element(const ir::Motion& m, ir::MotionKind kind, Move move) {
  const auto plane = ir::plane_axes(move.plane);
  if (!check_axis(plane.u) || !check_axis(plane.v)) return false;
  const bool first = contour_.elements.empty();
  if (first) {
    contour_.frame = frame_serial_;
    contour_.events = emitter_.seen();
  }
  if (contour_.frame != frame_serial_ || contour_.events != emitter_.seen() ||
      (!first && contour_.elements.front().move.plane != move.plane)) {
    return failure_.fail(code::contour_open,
                         "the end of an element before follows from this block: no change of the plane or of the zero "
                         "point, and no machine function may stand between them");
  }
  if (!first) move.from = move.to = contour_.elements.back().move.to;
  OpenElement item;
  if (!contour_data(m, kind, move, item.data)) return false;
  for (const auto& w : m.coords) {
    if (!check_axis(w.axis)) return false;
    const bool absolute = w.mode == ir::WordMode::absolute ||
                          (w.mode == ir::WordMode::modal && modal_.distance == ir::Distance::absolute);
    if (!absolute) return failure_.fail(code::contour_open, "a contour by angles and tangency needs absolute words");
    const double x = coordinate(w.axis, w.value, w.scale, true);
    if (w.axis == plane.u) {
      item.data.u = x;
    } else if (w.axis == plane.v) {
      item.data.v = x;
    } else {
      move.to[w.axis] = w.direction == ir::RotaryDirection::as_value ? x : rotary_target(w, x);
    }
  }
  if (failure_.set) return false;
  move.kind = item.data.arc ? Move::Kind::arc : kind == ir::MotionKind::rapid ? Move::Kind::rapid : Move::Kind::linear;
  move.ccw = item.data.ccw;
  item.move = move;
  item.corner = std::exchange(now_.corner, std::nullopt);
  contour_.elements.push_back(item);
  if (contour_.elements.back().data.end != ir::contour::ElementEnd::given) {
    return contour_.elements.size() < ir::contour::longest ||
           failure_.fail(code::contour, "more than 3 elements in a row whose end follows from the next one");
  }
  return close_contour();
}

/// Direction, centre, radius of the element; the end is left to the caller.
bool BlockMachine::contour_data(const ir::Motion& m, ir::MotionKind kind, const Move& move, ir::contour::Element& e) {
  const auto plane = ir::plane_axes(move.plane);
  e.arc = kind == ir::MotionKind::arc_cw || kind == ir::MotionKind::arc_ccw;
  e.ccw = kind == ir::MotionKind::arc_ccw;
  if (!e.arc && kind != ir::MotionKind::linear && kind != ir::MotionKind::rapid)
    return failure_.fail(code::contour_open, "only lines and arcs can stand in a contour by angles and tangency");
  e.end = now_.marks.end;
  e.branch = now_.marks.branch;
  if (m.extra) {
    if (m.extra->has_line_angle) e.angle = value(m.extra->line_angle);
    if (m.extra->has_polar_angle || m.extra->has_polar_radius || m.extra->has_turns || m.extra->has_pitch)
      return failure_.fail(code::contour_open, "polar words and helices do not stand in an open contour");
  }
  if (m.radius_given) {
    const double r = value(m.radius) * unit();
    if (!(r > 0)) return failure_.fail(code::arc_radius, "the radius of an arc must be above 0");
    e.radius = r;
  }
  if (m.centers.empty()) return !failure_.set;
  ir::contour::Point c;
  int given = 0;
  for (const auto& w : m.centers) {
    const bool absolute = w.mode == ir::CenterMode::absolute ||
                          (w.mode == ir::CenterMode::follows_distance && modal_.distance == ir::Distance::absolute);
    if (!absolute || (w.axis != plane.u && w.axis != plane.v))
      return failure_.fail(code::contour_open, "the centre of an arc in an open contour is absolute and in the plane");
    (w.axis == plane.u ? c.u : c.v) = coordinate(w.axis, w.value, w.scale, true);
    ++given;
  }
  if (given != 2) return failure_.fail(code::arc_undefined, "the centre of the arc is incomplete");
  e.centre = c;
  return !failure_.set;
}

bool BlockMachine::close_contour() {
  const auto plane = ir::plane_axes(contour_.elements.front().move.plane);
  std::vector<ir::contour::Element> elements;
  elements.reserve(contour_.elements.size());
  for (const auto& item : contour_.elements) elements.push_back(item.data);
  const auto solved = ir::contour::solve({p_[plane.u], p_[plane.v]}, elements, profile_.arc_tolerance);
  if (!solved.ok) return failure_.fail(code::contour, solved.error);
  if (solved.chosen) contour_.chosen.push_back(failure_.where);
  const std::vector<OpenElement> items = std::exchange(contour_.elements, {});
  for (std::size_t i = 0; i < items.size(); ++i) {
    Move move = items[i].move;
    const auto& s = solved.elements[i];
    move.from = p_;
    move.to[plane.u] = s.to.u;
    move.to[plane.v] = s.to.v;
    move.centre = {s.centre.u, s.centre.v};
    now_.corner = items[i].corner;
    path_event_.file = move.file;
    path_event_.line = move.line;
    if (!send(move)) return false;
  }
  return true;
}

}  // namespace cnctrans::interpreter
