// The polygons of a pocket (library: Clipper 6, Debian's libpolyclipping).
#include "ir/cycles/milling/pocket_area.h"

#include "ir/cycles/milling/pocket_refit.h"

#ifdef CNC_POLYGONS

#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>

namespace cnctrans::ir::cycles {

namespace {

namespace cl = ClipperLib;

constexpr double per_mm = 1e6;  ///< integer units in one mm
constexpr double pi = 3.14159265358979323846;
constexpr double same_place = 1e-3;  ///< mm between the ends of a closed contour
constexpr double farthest = 1e6;     ///< mm: coordinates that the integers hold with room to spare

cl::IntPoint to_int(double u, double v) {
  return {static_cast<cl::cInt>(std::llround(u * per_mm)), static_cast<cl::cInt>(std::llround(v * per_mm))};
}
PocketPoint to_mm(const cl::IntPoint& p) {
  return {static_cast<double>(p.X) / per_mm, static_cast<double>(p.Y) / per_mm};
}
std::vector<PocketPoint> to_mm(const cl::Path& path) {
  std::vector<PocketPoint> out;
  for (const auto& p : path) out.push_back(to_mm(p));
  return out;
}

/// Corners of the polygon that stands for the way; arcs by chords.
cl::Path polygon_of(const PocketWay& way, double tolerance) {
  cl::Path out;
  for (const auto& e : way) {
    long parts = 1;
    if (e.arc) {
      const double r = std::hypot(e.u0 - e.cu, e.v0 - e.cv);
      const double step = r > tolerance ? 2 * std::acos(1 - tolerance / r) : pi / 2;
      parts = std::max(4L, std::lround(std::ceil(length_of(e) / std::max(r, 1e-9) / step)));
    }
    for (long k = 0; k < parts; ++k) {
      const auto p = point_on(e, static_cast<double>(k) / static_cast<double>(parts));
      out.push_back(to_int(p.u, p.v));
    }
  }
  return out;
}

cl::Paths grown(const cl::Paths& paths, double by, double tolerance, cl::EndType end = cl::etClosedPolygon) {
  cl::ClipperOffset offset(2, tolerance * per_mm);
  offset.AddPaths(paths, cl::jtRound, end);
  cl::Paths out;
  offset.Execute(out, by * per_mm);
  return out;
}
cl::Paths combined(cl::ClipType how, const cl::Paths& a, const cl::Paths& b) {
  cl::Clipper clipper;
  clipper.AddPaths(a, cl::ptSubject, true);
  clipper.AddPaths(b, cl::ptClip, true);
  cl::Paths out;
  clipper.Execute(how, out, cl::pftNonZero, cl::pftNonZero);
  return out;
}
double area_of(const cl::Paths& paths) {
  double sum = 0;
  for (const auto& p : paths) sum += cl::Area(p);
  return sum / per_mm / per_mm;
}

}  // namespace

struct PocketPolygons {
  cl::Paths paths;  ///< the outline counter-clockwise, holes clockwise
  cl::Paths wider;  ///< the same and a little more: what lies on the edge is in it
};

struct PocketArea::Data {
  cl::Paths area;
  std::vector<PocketWay> walls;  ///< the area on their left
  double tolerance = 0;
  bool ccw = false, overlap = false;
};

bool contains(const PocketPiece& piece, double u, double v) {
  const auto p = to_int(u, v);
  bool in = false;
  for (const auto& path : piece.polygons->wider) {
    if (cl::PointInPolygon(p, path) != 0) in = !in;
  }
  return in;
}

bool passes(const PocketPiece& piece, PocketPoint from, PocketPoint to) {
  const auto a = to_int(from.u, from.v), b = to_int(to.u, to.v);
  if (a == b) return contains(piece, from.u, from.v);
  cl::Clipper clipper;
  clipper.AddPath({a, b}, cl::ptSubject, false);
  clipper.AddPaths(piece.polygons->wider, cl::ptClip, true);
  cl::PolyTree outside;
  clipper.Execute(cl::ctDifference, outside, cl::pftNonZero, cl::pftNonZero);
  return outside.Total() == 0 && contains(piece, from.u, from.v);
}

std::vector<MillElement> stripes(const PocketPiece& piece, double degrees, double step) {
  // In a frame that is turned so that the lines run along its first axis.
  const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  cl::Paths turned = piece.polygons->paths;
  double low = 1e300, high = -1e300, left = 1e300, right = -1e300;
  for (auto& path : turned) {
    for (auto& p : path) {
      const auto m = to_mm(p);
      const double along = m.u * c + m.v * s, across = m.v * c - m.u * s;
      p = to_int(along, across);
      low = std::min(low, across);
      high = std::max(high, across);
      left = std::min(left, along);
      right = std::max(right, along);
    }
  }
  const double gaps = std::max(1.0, std::ceil((high - low) / step - 1e-9));
  const auto lines = static_cast<long>(gaps) - 1;
  std::vector<MillElement> out;
  for (long k = 1; k <= lines; ++k) {
    const double across = low + (high - low) * static_cast<double>(k) / gaps;
    cl::Clipper clipper;
    clipper.AddPath({to_int(left - 1, across), to_int(right + 1, across)}, cl::ptSubject, false);
    clipper.AddPaths(turned, cl::ptClip, true);
    cl::PolyTree tree;
    clipper.Execute(cl::ctIntersection, tree, cl::pftNonZero, cl::pftNonZero);
    cl::Paths open;
    cl::OpenPathsFromPolyTree(tree, open);
    std::vector<std::pair<double, double>> parts;
    for (const auto& path : open) {
      const auto a = to_mm(path.front()), b = to_mm(path.back());
      if (std::abs(a.u - b.u) > 1e-6) parts.emplace_back(std::min(a.u, b.u), std::max(a.u, b.u));
    }
    std::sort(parts.begin(), parts.end());
    const bool back = k % 2 == 0;
    if (back) std::reverse(parts.begin(), parts.end());
    for (auto [from, to] : parts) {
      if (back) std::swap(from, to);
      out.push_back({from * c - across * s, from * s + across * c, to * c - across * s, to * s + across * c});
    }
  }
  return out;
}

namespace {

/// The contours as they are, and the polygons that stand for them. False: one of them is none.
bool closed_ways(const std::vector<MillContour>& contours, double tolerance, std::vector<PocketWay>& ways,
                 std::vector<cl::Path>& polygons, std::string* error) {
  const auto no = [error](const char* why) {
    *error = why;
    return false;
  };
  if (contours.empty()) return no("the pocket has no contour");
  for (const auto& contour : contours) {
    PocketWay way = contour.elements;
    if (way.empty()) return no("a contour of the pocket has no elements");
    for (const auto& e : way) {
      for (const double x : {e.u0, e.v0, e.u1, e.v1, e.cu, e.cv}) {
        if (!(std::abs(x) < farthest)) return no("a contour of the pocket lies too far away");
      }
    }
    auto& last = way.back();
    if (std::hypot(last.u1 - way.front().u0, last.v1 - way.front().v0) > same_place)
      return no("a contour of the pocket is not closed");
    last.u1 = way.front().u0;
    last.v1 = way.front().v0;
    cl::Path polygon = polygon_of(way, tolerance / 2);
    for (const auto& other : polygons) {
      if (other.front() == polygon.front()) return no("two contours of the pocket begin at the same point");
    }
    const double area = std::abs(cl::Area(polygon));
    cl::Paths simple;
    cl::SimplifyPolygon(polygon, simple, cl::pftEvenOdd);
    double sum = 0;
    for (const auto& p : simple) sum += std::abs(cl::Area(p));
    const double dust = tolerance * per_mm * per_mm;
    if (area < dust) return no("a contour of the pocket encloses no area");
    if (simple.size() != 1 || std::abs(sum - area) > dust) return no("a contour of the pocket crosses itself");
    polygons.push_back(std::move(polygon));
    ways.push_back(std::move(way));
  }
  return true;
}

}  // namespace

std::optional<PocketArea> PocketArea::of(const std::vector<MillContour>& contours, bool first_is_outside,
                                         double tolerance, std::string* error) {
  auto data = std::make_shared<Data>();
  data->tolerance = tolerance;
  std::vector<cl::Path> polygons;
  std::vector<PocketWay> ways;
  if (!closed_ways(contours, tolerance, ways, polygons, error)) return std::nullopt;
  std::size_t outside = 0;
  for (std::size_t i = 1; i < polygons.size() && !first_is_outside; ++i) {
    if (std::abs(cl::Area(polygons[i])) > std::abs(cl::Area(polygons[outside]))) outside = i;
  }
  data->ccw = cl::Orientation(polygons[outside]);
  cl::Paths islands;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const bool ccw = cl::Orientation(polygons[i]), outer = i == outside;
    data->walls.push_back(ccw == outer ? ways[i] : reversed(ways[i]));
    if (!ccw) cl::ReversePath(polygons[i]);
    if (!outer) islands.push_back(polygons[i]);
  }
  const cl::Paths outline{polygons[outside]};
  data->area = combined(cl::ctDifference, outline, islands);
  const double islands_sum = area_of(islands), islands_in = area_of(combined(cl::ctIntersection, outline, islands));
  data->overlap = std::abs(islands_sum - islands_in) > tolerance;
  if (data->area.empty()) {
    *error = "the islands leave nothing of the pocket";
    return std::nullopt;
  }
  PocketArea out;
  out.data_ = std::move(data);
  return out;
}

std::optional<PocketArea> PocketArea::joined(const std::vector<MillContour>& contours, bool common, double tolerance,
                                             std::string* error) {
  auto data = std::make_shared<Data>();
  data->tolerance = tolerance;
  std::vector<cl::Path> polygons;
  if (!closed_ways(contours, tolerance, data->walls, polygons, error)) return std::nullopt;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (!cl::Orientation(polygons[i])) {
      cl::ReversePath(polygons[i]);
      data->walls[i] = reversed(data->walls[i]);
    }
    const cl::Paths one{polygons[i]};
    data->area = i == 0 ? one : combined(common ? cl::ctIntersection : cl::ctUnion, data->area, one);
  }
  data->ccw = true;
  PocketArea out;
  out.data_ = std::move(data);
  return out;
}

bool PocketArea::outside_ccw() const {
  return data_->ccw;
}
bool PocketArea::overlap() const {
  return data_->overlap;
}

std::vector<PocketPiece> PocketArea::inside(double distance) const {
  const double tolerance = data_->tolerance;
  cl::ClipperOffset offset(2, tolerance / 2 * per_mm);
  offset.AddPaths(data_->area, cl::jtRound, cl::etClosedPolygon);
  cl::PolyTree tree;
  offset.Execute(tree, -distance * per_mm);
  std::vector<detail::ExactCurve> curves;
  for (const auto& wall : data_->walls) detail::parallel_curves(wall, distance, curves);
  const double off = 2 * tolerance;
  const auto way_of = [&](cl::Path path) {
    cl::CleanPolygon(path, tolerance / 20 * per_mm);
    return path.size() < 3 ? PocketWay{} : detail::refit(to_mm(path), curves, off);
  };
  std::vector<PocketPiece> out;
  for (const auto* node = tree.GetFirst(); node != nullptr; node = node->GetNext()) {
    if (node->IsHole()) continue;
    PocketPiece piece;
    piece.outside = way_of(node->Contour);
    if (piece.outside.empty()) continue;
    auto polygons = std::make_shared<PocketPolygons>();
    polygons->paths.push_back(node->Contour);
    for (const auto* hole : node->Childs) {
      auto way = way_of(hole->Contour);
      if (way.empty()) continue;
      piece.islands.push_back(std::move(way));
      polygons->paths.push_back(hole->Contour);
    }
    polygons->wider = grown(polygons->paths, 4 * tolerance, tolerance);
    piece.polygons = std::move(polygons);
    out.push_back(std::move(piece));
  }
  // From left to right, whatever order the library has.
  const auto corner = [](const PocketPiece& p) {
    double u = 1e300, v = 1e300;
    for (const auto& e : p.outside) {
      u = std::min(u, e.u0);
      v = std::min(v, e.v0);
    }
    return std::pair(std::round(u * 1e3), std::round(v * 1e3));
  };
  std::stable_sort(out.begin(), out.end(),
                   [&corner](const PocketPiece& a, const PocketPiece& b) { return corner(a) < corner(b); });
  return out;
}

std::vector<PocketWay> PocketArea::left_over(const PocketPiece& piece, const std::vector<PocketWay>& ways,
                                             double radius) const {
  const double tolerance = data_->tolerance;
  cl::Paths lines, open;
  for (const auto& way : ways) {
    auto path = polygon_of(way, 2 * tolerance);
    const auto& end = way.back();
    const bool closed = std::hypot(end.u1 - way.front().u0, end.v1 - way.front().v0) < same_place;
    if (!closed) path.push_back(to_int(end.u1, end.v1));
    (closed ? lines : open).push_back(std::move(path));
  }
  cl::ClipperOffset offset(2, 2 * tolerance * per_mm);
  offset.AddPaths(lines, cl::jtRound, cl::etClosedLine);
  offset.AddPaths(open, cl::jtRound, cl::etOpenRound);
  cl::Paths swept;
  offset.Execute(swept, radius * per_mm);
  const auto rest = combined(cl::ctDifference, piece.polygons->paths, swept);
  const double hair = 8 * tolerance;
  const auto solid = grown(grown(rest, -hair, tolerance), hair, tolerance);
  std::vector<PocketWay> out;
  for (const auto& path : solid) {
    if (!cl::Orientation(path)) continue;
    cl::Path clean = path;
    cl::CleanPolygon(clean, 10 * tolerance * per_mm);
    if (clean.size() < 3) clean = path;
    out.push_back(detail::refit(to_mm(clean), {}, tolerance));
  }
  return out;
}

}  // namespace cnctrans::ir::cycles

#else

namespace cnctrans::ir::cycles {

struct PocketPolygons {};
struct PocketArea::Data {};

std::optional<PocketArea> PocketArea::of(const std::vector<MillContour>&, bool, double, std::string* error) {
  *error =
      "this build of the program has no polygon library (Debian: libpolyclipping-dev): a pocket along contours "
      "is not carried out";
  return std::nullopt;
}
std::optional<PocketArea> PocketArea::joined(const std::vector<MillContour>& contours, bool, double tolerance,
                                             std::string* error) {
  return of(contours, true, tolerance, error);
}
bool contains(const PocketPiece&, double, double) {
  return false;
}
bool passes(const PocketPiece&, PocketPoint, PocketPoint) {
  return false;
}
std::vector<MillElement> stripes(const PocketPiece&, double, double) {
  return {};
}
bool PocketArea::outside_ccw() const {
  return false;
}
bool PocketArea::overlap() const {
  return false;
}
std::vector<PocketPiece> PocketArea::inside(double) const {
  return {};
}
std::vector<PocketWay> PocketArea::left_over(const PocketPiece&, const std::vector<PocketWay>&, double) const {
  return {};
}

}  // namespace cnctrans::ir::cycles

#endif
