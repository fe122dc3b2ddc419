// Numbers of a hole cycle -> moves of one hole.
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/tiny.h"
#include "ir/cycles/hole.h"

namespace cnctrans::ir::cycles {
namespace {

constexpr std::size_t most_pecks = 100'000;  ///< longer schedules end with one stroke for the rest

/// Writes the moves and leaves out those that go nowhere.
class Path {
 public:
  Path(const HoleNumbers& hole, double height, std::vector<CycleMove>& moves)
      : hole_(hole), w_(height), moves_(moves) {}

  void rapid(double w) { rapid(w, 0, 0); }
  void rapid(double w, double du, double dv) {
    if (std::abs(w - w_) < tiny && std::abs(du - du_) < tiny && std::abs(dv - dv_) < tiny) return;
    w_ = w;
    du_ = du;
    dv_ = dv;
    add(CycleStep::rapid);
  }
  void feed(double w, double factor = 1) {
    if (std::abs(w - w_) < tiny) return;
    w_ = w;
    auto& m = add(CycleStep::feed);
    m.has_feed = hole_.has_feed;
    m.feed = hole_.feed;
    m.feed_factor = factor;
  }
  void feed_out(double w) {
    if (std::abs(w - w_) < tiny) return;
    w_ = w;
    auto& m = add(CycleStep::feed);
    m.has_feed = hole_.has_feed_out || hole_.has_feed;
    m.feed = hole_.has_feed_out ? hole_.feed_out : hole_.feed;
  }
  void thread(double w) {
    w_ = w;
    auto& m = add(CycleStep::thread);
    m.pitch = hole_.pitch;
    m.has_feed = hole_.has_feed;
    m.feed = hole_.feed;
  }
  void dwell(double amount) {
    if (amount <= 0) return;
    auto& m = add(CycleStep::dwell);
    m.amount = amount;
    m.revolutions = hole_.dwell_in_revolutions;
  }
  void spindle(CycleStep step, double angle = 0) { add(step).amount = angle; }
  [[nodiscard]] double height() const { return w_; }

 private:
  CycleMove& add(CycleStep step) {
    CycleMove m;
    m.step = step;
    m.w = w_;
    m.du = du_;
    m.dv = dv_;
    moves_.push_back(m);
    return moves_.back();
  }
  const HoleNumbers& hole_;
  double w_, du_ = 0, dv_ = 0;
  std::vector<CycleMove>& moves_;
};

/// Distance above the last bottom where feeding starts again.
double reapproach(const HoleNumbers& h, double depth) {
  if (!h.reapproach_automatic) return h.reapproach;
  return depth <= 30 ? 0.6 : std::min(depth / 50, 7.0);
}

void pecks(const HoleNumbers& h, Path& path, double retract) {
  const double top = h.from_surface ? h.surface : h.reference;
  const double depth = std::abs(top - h.bottom);
  const auto sizes = peck_sizes(h, depth);
  const double gap = reapproach(h, depth);
  double z = top;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const bool last = i + 1 == sizes.size();
    if (i > 0 && h.kind == HoleKind::peck_full) {
      path.rapid(h.withdraws_to_retract ? retract : h.reference);
      path.dwell(h.dwell_top);
      path.rapid(h.up * std::min(h.up * h.reference, h.up * (z + h.up * gap)));
    } else if (i > 0 && h.lift > 0) {
      const double lifted = h.up * std::min(h.up * h.reference, h.up * (z + h.up * h.lift));
      if (h.lift_rapid) {
        path.rapid(lifted);
        path.rapid(h.up * std::min(h.up * lifted, h.up * (z + h.up * gap)));
      } else {
        path.feed(lifted);
      }
    }
    z = last ? h.bottom : z - h.up * sizes[i];
    path.feed(z, i == 0 ? h.first_feed_factor : 1);
    path.dwell(last ? h.dwell_bottom : h.dwell_peck);
  }
}

/// The spindle at a step; `usual` is what the kind does by itself.
void spindle(Path& path, SpindleStep step, std::optional<CycleStep> usual) {
  switch (step) {
    case SpindleStep::usual:
      if (usual) path.spindle(*usual);
      break;
    case SpindleStep::none: break;
    case SpindleStep::cw: path.spindle(CycleStep::spindle_cw); break;
    case SpindleStep::ccw: path.spindle(CycleStep::spindle_ccw); break;
    case SpindleStep::off: path.spindle(CycleStep::spindle_stop); break;
  }
}

/// Taps may break the chip: back by the lift, or to the reference plane when there is none.
void tap(const HoleNumbers& h, Path& path) {
  if (h.orient_first) path.spindle(CycleStep::spindle_orient, h.orient_angle);
  if (h.has_speed) path.spindle(CycleStep::spindle_speed, h.speed);
  double z = h.from_surface ? h.surface : h.reference;
  const auto sizes = peck_sizes(h, std::abs(z - h.bottom));
  for (std::size_t i = 0; i + 1 < sizes.size(); ++i) {
    z -= h.up * sizes[i];
    path.thread(z);
    path.dwell(h.dwell_bottom);
    if (h.told_in_full) path.spindle(CycleStep::spindle_reverse);
    path.thread(h.lift > 0 ? h.up * std::min(h.up * h.reference, h.up * z + h.lift) : h.reference);
    if (h.told_in_full) path.spindle(CycleStep::spindle_restore);
  }
  path.thread(h.bottom);
  if (!h.told_in_full) path.dwell(h.dwell_bottom);
  spindle(path, h.spindle_bottom, CycleStep::spindle_reverse);
  if (h.told_in_full) path.dwell(h.dwell_bottom);  // the reversal takes its time
  if (h.has_speed_out) path.spindle(CycleStep::spindle_speed, h.speed_out);
  path.thread(h.reference);
}

void shifted_bore(const HoleNumbers& h, Path& path, double retract) {
  path.feed(h.bottom);
  path.dwell(h.dwell_bottom);
  path.spindle(CycleStep::spindle_orient, h.orient_angle);
  path.rapid(h.bottom + h.shift_w, h.shift_u, h.shift_v);
  if (h.has_feed_out) {
    path.feed_out(h.reference);
    path.rapid(retract, h.shift_u, h.shift_v);
  } else {
    path.rapid(h.reference, h.shift_u, h.shift_v);
  }
  path.rapid(retract, 0, 0);
}

/// Through the hole with the tip turned inward, up into the work from below by the reapproach, and out again.
void back_bore(const HoleNumbers& h, Path& path, double retract) {
  const double below = h.bottom - h.up * h.reapproach;
  const auto through = [&](double to, double then) {
    path.spindle(CycleStep::spindle_orient, h.orient_angle);
    path.rapid(path.height(), h.shift_u, h.shift_v);
    path.feed_out(to);
    path.rapid(then, h.shift_u, h.shift_v);
    path.rapid(then, 0, 0);
  };
  through(below, below);
  path.spindle(CycleStep::spindle_restore);
  path.feed(h.bottom);
  path.dwell(h.dwell_bottom);
  path.feed_out(below);
  through(h.reference, retract);
}

/// The sense after the cycle, before the retract or behind it; kinds that leave the spindle alone have none.
void restore_spindle(const HoleNumbers& h, Path& path) {
  const bool switches = h.kind == HoleKind::tap || h.kind == HoleKind::tap_floating || h.kind == HoleKind::bore_shift ||
                        h.kind == HoleKind::bore_stop || h.kind == HoleKind::back_bore;
  spindle(path, h.spindle_after, switches ? std::optional(CycleStep::spindle_restore) : std::nullopt);
}

/// The first peck is the one programmed, whatever is left behind it.
void balanced(const HoleNumbers& h, double depth, std::vector<double>& sizes) {
  sizes.push_back(std::min(h.first, depth));
  double rest = depth - sizes.front();
  while (rest > 2 * h.first - tiny && sizes.size() < most_pecks) {
    sizes.push_back(h.first);
    rest -= h.first;
  }
  if (rest <= h.first + tiny) {
    if (rest > tiny) sizes.push_back(rest);
  } else {
    sizes.push_back(rest / 2);
    sizes.push_back(rest / 2);
  }
}

/// Each smaller by `degression`, down to that (and the minimum). A remainder below two of the smallest strokes is
/// shared between the last two, whatever the stroke has come down to; the first is the one programmed.
void arithmetic(const HoleNumbers& h, double depth, std::vector<double>& sizes) {
  const double smallest = std::min(h.first, std::max({h.degression, h.minimum, tiny * 10}));
  double stroke = h.first, rest = depth;
  while (rest > tiny && sizes.size() < most_pecks) {
    if (rest <= stroke + tiny) {
      sizes.push_back(rest);
      return;
    }
    if (!sizes.empty() && rest < 2 * smallest - tiny) {
      sizes.push_back(rest / 2);
      sizes.push_back(rest / 2);
      return;
    }
    sizes.push_back(stroke);
    rest -= stroke;
    stroke = std::max(smallest, stroke - h.degression);
  }
}

/// q = min(max(p, minimum unless the factor is 1), rest); p = p * factor.
void geometric(const HoleNumbers& h, double depth, std::vector<double>& sizes) {
  double p = h.first, rest = depth;
  while (rest > tiny && sizes.size() < most_pecks) {
    const double least = h.degression == 1 ? 0 : h.minimum;
    double q = std::min(std::max(p, least), rest);
    if (q < tiny || rest - q < tiny) q = rest;
    sizes.push_back(q);
    rest -= q;
    p *= h.degression;
  }
}

void linear(const HoleNumbers& h, double depth, std::vector<double>& sizes) {
  const double last = h.minimum;
  const double n = std::min(std::max(2.0, std::ceil(2 * depth / (h.first + last) - tiny)), double{most_pecks});
  double sum = 0;
  for (double i = 0; i < n; ++i) {
    sizes.push_back(h.first + (last - h.first) * i / (n - 1));
    sum += sizes.back();
  }
  for (auto& s : sizes) s *= depth / sum;
}

}  // namespace

std::vector<double> peck_sizes(const HoleNumbers& h, double depth) {
  std::vector<double> sizes;
  switch (h.law) {
    case PeckLaw::none: break;
    case PeckLaw::constant:
      for (double rest = depth; rest > tiny && sizes.size() < most_pecks; rest -= h.first) {
        sizes.push_back(rest <= h.first + tiny ? rest : h.first);
        if (rest <= h.first + tiny) break;
      }
      break;
    case PeckLaw::count:
      sizes.assign(static_cast<std::size_t>(std::clamp(std::round(h.count), 1.0, 1e5)),
                   depth / std::clamp(std::round(h.count), 1.0, 1e5));
      break;
    case PeckLaw::arithmetic: arithmetic(h, depth, sizes); break;
    case PeckLaw::geometric: geometric(h, depth, sizes); break;
    case PeckLaw::linear: linear(h, depth, sizes); break;
    case PeckLaw::balanced: balanced(h, depth, sizes); break;
  }
  if (sizes.empty()) sizes.assign(1, depth);
  return sizes;
}

double retract_level(const HoleNumbers& h, RetractPlane plane) {
  if (h.has_retract) return h.retract;
  return plane == RetractPlane::initial ? h.initial : h.reference;
}

std::vector<CycleMove> expand(const HoleNumbers& h, double height, RetractPlane plane, std::string* error) {
  std::vector<CycleMove> moves;
  Path path(h, height, moves);
  const double retract = retract_level(h, plane);
  if (h.approach_by_retract && h.has_retract) path.rapid(retract);
  path.rapid(h.reference);
  spindle(path, h.spindle_before, std::nullopt);
  switch (h.kind) {
    case HoleKind::drill:
      path.feed(h.bottom, h.first_feed_factor);
      path.dwell(h.dwell_bottom);
      break;
    case HoleKind::peck_full:
    case HoleKind::peck_break: pecks(h, path, retract); break;
    case HoleKind::tap:
    case HoleKind::tap_floating: tap(h, path); break;
    case HoleKind::ream:
    case HoleKind::bore:
      path.feed(h.bottom);
      path.dwell(h.dwell_bottom);
      path.feed_out(h.reference);
      break;
    case HoleKind::bore_stop:
      path.feed(h.bottom);
      path.dwell(h.dwell_bottom);
      spindle(path, h.spindle_bottom, CycleStep::spindle_stop);
      path.rapid(retract);
      break;
    case HoleKind::bore_manual:
      path.feed(h.bottom);
      path.dwell(h.dwell_bottom);
      spindle(path, h.spindle_bottom, CycleStep::spindle_stop);
      path.spindle(CycleStep::operator_stop);
      break;
    case HoleKind::bore_shift: shifted_bore(h, path, retract); break;
    case HoleKind::back_bore:
      if (h.reapproach > tiny) {
        back_bore(h, path, retract);
        break;
      }
      *error = "boring from the back needs the distance below the work at which the tip turns";
      moves.clear();
      return moves;
    case HoleKind::mill:
      *error = "milling cycles have an expansion of their own";
      moves.clear();
      return moves;
  }
  if (!h.spindle_after_retract) restore_spindle(h, path);
  if (h.told_in_full && h.up * (h.reference - path.height()) > tiny) path.rapid(h.reference);
  path.rapid(retract);
  if (h.spindle_after_retract) restore_spindle(h, path);
  return moves;
}

}  // namespace cnctrans::ir::cycles
