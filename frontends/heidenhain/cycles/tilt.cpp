// Tilted planes (reference 18.7, 18.8, 18.10): cycle 19 and PLANE. The plane is turned about the datum in force; shifts
// behind it move the turned system.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "base/noise.h"
#include "base/text.h"
#include "dialects/heidenhain/tilts.h"
#include "frontends/heidenhain/state/lowering.h"
#include "ir/geometry/frame_angles.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;
using facts::TiltForm;

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;
using Vector = std::array<double, 3>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) out[i][j] += a[i][k] * b[k][j];
    }
  }
  return out;
}
Matrix about(std::size_t axis, double degrees) {
  const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  Matrix m{};
  m[axis][axis] = 1;
  m[u][u] = m[v][v] = c;
  m[u][v] = -s;
  m[v][u] = s;
  return m;
}
Vector cross_of(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Of length 1; false: it has none.
bool unit(Vector& a) {
  const double l = std::hypot(a[0], a[1], a[2]);
  if (l < 1e-9) return false;
  for (double& x : a) x /= l;
  return true;
}
/// X axis `x` as far as it lies across the normal `z`.
std::optional<Matrix> frame_of(Vector x, Vector z) {
  if (!unit(z)) return std::nullopt;
  const double along = x[0] * z[0] + x[1] * z[1] + x[2] * z[2];
  for (std::size_t i = 0; i < 3; ++i) x[i] -= along * z[i];
  if (!unit(x)) return std::nullopt;
  const Vector y = cross_of(z, x);
  Matrix m{};
  for (std::size_t i = 0; i < 3; ++i) m[i] = {x[i], y[i], z[i]};
  return m;
}
}  // namespace

/// The frame of the tilt and of the shift behind it.
void Lowering::put_tilt() {
  tilt_set();
  const auto frame = [](ir::FrameKind kind, ir::FrameCombine combine) {
    ir::FrameChange c;
    c.slot = ir::FrameSlot::chain;
    c.kind = kind;
    c.combine = combine;
    return c;
  };
  ir::Block b;
  const auto add = [&b](ir::FrameChange c) {
    b.actions.emplace_back().data = ir::FrameOp{std::make_shared<const ir::FrameChange>(std::move(c))};
  };
  ir::FrameChange turn = frame(ir::FrameKind::rotate, ir::FrameCombine::replace);
  for (const ir::AxisId axis : {ir::axis::x, ir::axis::y, ir::axis::z}) {
    ir::FrameWord w;
    w.axis = axis;
    if (tilt_) w.value = tilt_->angles[axis];
    turn.words.push_back(std::move(w));
  }
  add(std::move(turn));
  if (tilt_ && !tilt_->shift.empty()) {
    ir::FrameChange shift = frame(ir::FrameKind::translate, ir::FrameCombine::compose);
    for (const auto& [axis, v] : tilt_->shift) {
      ir::FrameWord w;
      w.axis = axis;
      w.value = v;
      shift.words.push_back(std::move(w));
    }
    add(std::move(shift));
  }
  if (tilt_) {
    for (const auto& c : tilt_->inner) add(c);
  }
  put(std::move(b));
}

/// Mirror, rotation or scale of the turned system. One programmed before the tilt is replaced.
bool Lowering::in_tilt(ir::FrameChange c) {
  const ir::FrameKind kind = c.kind;
  const bool neutral = c.combine == ir::FrameCombine::clear, adds = c.combine == ir::FrameCombine::add;
  if (outer_.erase(kind) != 0) {
    if (adds) return false;
    ir::FrameChange none = c;
    none.words.clear();
    none.has_angle = false;
    none.combine = ir::FrameCombine::clear;
    ir::Block b;
    b.actions.emplace_back().data = ir::FrameOp{std::make_shared<const ir::FrameChange>(std::move(none))};
    put(std::move(b));
  }
  auto& inner = tilt_->inner;
  const auto old = std::find_if(inner.begin(), inner.end(), [kind](const auto& i) { return i.kind == kind; });
  if (adds && old != inner.end()) c.angle = ir::add(old->angle, c.angle);
  if (old != inner.end()) inner.erase(old);
  c.slot = ir::FrameSlot::chain;
  c.combine = ir::FrameCombine::compose;
  const auto rank = [](const ir::FrameChange& f) {
    return f.kind == ir::FrameKind::mirror ? 0 : f.kind == ir::FrameKind::rotate ? 1 : 2;
  };
  const auto at = std::find_if(inner.begin(), inner.end(), [&](const auto& i) { return rank(i) > rank(c); });
  if (!neutral) inner.insert(at, std::move(c));
  put_tilt();
  return true;
}

/// Behind the tilt: the shift of the turned system.
bool Lowering::shift_in_tilt(ir::AxisId axis, const ir::Value& v, bool adds) {
  if (axis > ir::axis::z) return false;
  const auto it = tilt_->shift.find(axis);
  tilt_->shift[axis] = adds && it != tilt_->shift.end() ? ir::add(it->second, v) : v;
  return true;
}

/// False: it was refused. `named`: Q120 to Q122 get the angles of the axes, where those are known.
bool Lowering::tilt(std::array<ir::Value, 3> angles, bool named) {
  const auto refuse = [this](std::string text) {
    report_.keep("HEI-022", {}, std::move(text), "motion.transformation");
    return false;
  };
  if (scaled_about_) return refuse("a tilted plane beside cycle 26 about a centre is not carried");
  if (tilt_ && !tilt_->inner.empty())
    return refuse(
        "a mirror, rotation or scale that was programmed in the tilted plane outlasts it; take it back before");
  bool any = false;
  for (const auto& a : angles) any = any || !a.is(0);
  if (!any && !tilt_) {
    relies(AlongText::tilt);
    report_.carry("HEI-021", {}, "no tilted plane is in force: kept as text", "motion.transformation");
    return true;
  }
  const bool shifted =
      tilt_ && std::any_of(tilt_->shift.begin(), tilt_->shift.end(), [](const auto& s) { return !s.second.is(0); });
  if (shifted)
    report_.warn("HEI-022", {}, "the datum shift that was programmed in the tilted plane is taken to end with it",
                 "take the shift back before");
  tilt_.reset();
  if (any) tilt_ = Tilt{angles, {}, {}};
  put_tilt();
  if (!any || !named || (!angles[0].is(0) && !angles[1].is(0))) return true;
  // Q120 to Q122: of axes that turn as the spatial angles say.
  for (std::int64_t k = 0; k < 3; ++k) {
    ir::Assign::Item item;
    item.target.space = 0;
    item.target.index = ir::number(static_cast<double>(120 + k));
    item.value = ir::as_expr(angles[static_cast<std::size_t>(k)]);
    ir::Assign assign;
    Item& put_item = put(ir::Assign{});
    put_item.writes.push_back(item.target);
    assign.items.push_back(std::move(item));
    put_item.statement.node = std::move(assign);
  }
  return true;
}

/// TURN and MOVE: the axes that turn as the spatial angles say. The tip of the tool stays, with MOVE, or is not told.
bool Lowering::turn_axes(const std::array<ir::Value, 3>& angles, bool rapid, const Word* own_feed) {
  ir::Block b;
  b.has_motion = true;
  b.motion.kind = rapid || own_feed == nullptr ? ir::MotionKind::rapid : ir::MotionKind::linear;
  b.motion.explicit_code = true;
  for (const ir::AxisId axis : {ir::axis::a, ir::axis::b, ir::axis::c}) {
    const ir::Value& to = angles[axis - ir::axis::a];
    if (to.is(0) && rotary_moved_.count(axis) == 0) continue;
    if (!has_axis(axis)) return false;
    ir::CoordWord& c = b.motion.coords.emplace_back();
    c.axis = axis;
    c.mode = ir::WordMode::absolute;
    c.value = to;
    rotary_moved_.insert(axis);
  }
  if (b.motion.coords.empty()) return true;
  if (own_feed != nullptr && !rapid) {
    ir::SetFeed f{value(*own_feed)};
    f.block_only = true;
    b.actions.emplace_back().data = std::move(f);
  }
  put(std::move(b));
  return true;
}

bool Lowering::tilt_words(const facts::TiltRow& row, TiltWords& out) {
  const auto& words = block_->words;
  for (std::size_t i = 1; i < words.size() && !report_.refused(); ++i) {
    std::string address = to_upper_ascii(words[i].address);
    const Word* number = &words[i];
    if (address == "P" && number->has_value && i + 1 < words.size()) {  // P1X+20 is two words
      address += shortest(number->number) + to_upper_ascii(words[i + 1].address);
      number = &words[++i];
    }
    out.stays = out.stays || address == "STAY";
    out.turns = out.turns || address == "TURN" || address == "MOVE";
    if (out.stays || out.turns) {  // what follows says how the axes are moved
      const Word& w = words[i];
      const bool max = i + 1 < words.size() && iequals_ascii(words[i + 1].address, "MAX");
      if (address == "FMAX" || (address == "F" && max)) out.fast = true;
      if (address == "F" && w.has_value) out.feed = &w;
      if (address == "MB" && w.has_value) out.back = &w;
      if (address == "MBMAX" || (address == "MB" && max)) out.far = true;
      if (address == "SEQ" && w.number_text == "-") out.other = true;
      continue;
    }
    if (!number->has_value || !facts::in_words(row.words, address)) {
      report_.refuse("HEI-002", words[i].pos,
                     "`" + std::string(slice(words[i])) + "` means nothing in PLANE " + std::string(row.word), {},
                     "block.word");
      return false;
    }
    out.given[address] = value(*number);
    out.literal = out.literal && out.given[address].literal();
  }
  return !report_.refused();
}

/// The angles about X, Y and Z that make the plane; nullopt with a sentence in `why`.
std::optional<std::array<ir::Value, 3>> Lowering::tilt_angles(const facts::TiltRow& row, const TiltWords& words,
                                                              std::string* why) {
  const auto get = [&words](const char* name) {
    const auto it = words.given.find(name);
    return it == words.given.end() ? ir::Value(0) : it->second;
  };
  const auto n = [&get](const char* name) { return get(name).number; };
  std::optional<Matrix> m;
  switch (row.form) {
    case TiltForm::spatial: return {{get("SPA"), get("SPB"), get("SPC")}};
    case TiltForm::axial: return {{get("A"), get("B"), get("C")}};
    case TiltForm::reset: return std::array<ir::Value, 3>{};
    case TiltForm::relative: {
      relies(AlongText::tilt);
      if (!tilt_) return {{get("SPA"), get("SPB"), get("SPC")}};
      Matrix before = about(0, 0);
      for (const std::size_t axis : {std::size_t{2}, std::size_t{1}, std::size_t{0}}) {
        if (!tilt_->angles[axis].literal()) return *why = "the plane before it is not known by numbers", std::nullopt;
        before = product(before, about(axis, tilt_->angles[axis].number));
      }
      m = product(before, product(about(2, n("SPC")), product(about(1, n("SPB")), about(0, n("SPA")))));
      break;
    }
    case TiltForm::euler:
      m = product(about(2, n("EULPR")), product(about(0, n("EULNU")), about(2, n("EULROT"))));
      break;
    case TiltForm::vector:
      m = frame_of({n("BX"), n("BY"), n("BZ")}, {n("NX"), n("NY"), n("NZ")});
      if (!m) return *why = "the vectors give no plane", std::nullopt;
      break;
    case TiltForm::points: {
      const Vector p{n("P1X"), n("P1Y"), n("P1Z")};
      const Vector x{n("P2X") - p[0], n("P2Y") - p[1], n("P2Z") - p[2]};
      const Vector y{n("P3X") - p[0], n("P3Y") - p[1], n("P3Z") - p[2]};
      m = frame_of(x, cross_of(x, y));
      if (!m) return *why = "the points give no plane", std::nullopt;
      break;
    }
    case TiltForm::projected: {
      const Matrix across = about(1, n("PROPR")), along = about(0, n("PROMIN"));  // the traces of the plane
      const Vector x{across[0][0], across[1][0], across[2][0]}, y{along[0][1], along[1][1], along[2][1]};
      m = frame_of(x, cross_of(x, y));
      if (!m) return *why = "the angles give no plane", std::nullopt;
      m = product(*m, about(2, n("ROT")));
      break;
    }
  }
  constexpr double places = 1e10;
  const auto column = [&m](std::size_t k) { return std::array<double, 3>{(*m)[0][k], (*m)[1][k], (*m)[2][k]}; };
  const ir::Turns a = ir::turns_of(column(0), column(1), column(2));
  std::array<ir::Value, 3> angles;
  for (std::size_t i = 0; i < 3; ++i) angles[i] = ir::Value(without_noise(a[i], places));
  return angles;
}

bool Lowering::plane(const syntax::Statement& s) {
  const auto& words = block_->words;
  const facts::TiltRow* row = words.empty() ? nullptr : facts::find_tilt(to_upper_ascii(words[0].address));
  if (row == nullptr) {
    report_.refuse("HEI-022", s.pos,
                   "PLANE is followed by SPATIAL, PROJECTED, EULER, VECTOR, POINTS, RELATIV, AXIAL or RESET");
    return false;
  }
  TiltWords said;
  if (!tilt_words(*row, said)) return false;
  const auto refuse = [&](std::string text) {
    report_.keep("HEI-022", s.pos, std::move(text), "motion.transformation");
    return false;
  };
  if (said.other && said.turns) return refuse("SEQ-: where the rotary axes stand then is known to the machine only");
  if (said.other)
    report_.warn("HEI-022", s.pos, "SEQ-: Q120 to Q122 are not set: the machine alone knows these angles");
  if (!said.literal && row->form != TiltForm::spatial) return refuse("its angles must be numbers");
  if (row->form == TiltForm::projected)
    report_.warn("HEI-022", s.pos, "the projected angles are taken to turn as SPB and SPA do");
  std::string why;
  const auto angles = tilt_angles(*row, said, &why);
  if (!angles) return refuse(why);
  const bool by_axes = (*angles)[0].is(0) || (*angles)[1].is(0);
  if (said.turns && !by_axes)
    return refuse("TURN and MOVE position the rotary axes: to where is known to the machine only");
  const std::size_t before = flat_.items.size();
  if (said.turns && (said.back != nullptr || said.far)) {  // first the tool goes back
    retract_far_ = said.far;
    if (!said.far) retract_ = *said.back;
    rapid_ = said.fast;
    retract(said.fast ? nullptr : said.feed, false);
    put(std::exchange(out_, {}));
  }
  if (!tilt(*angles, !said.other)) return false;
  if (said.turns && !turn_axes(*angles, said.fast, said.feed))
    return refuse("the machine has no rotary axis for this plane");
  if (flat_.items.size() == before && !report_.refused()) put(ir::Block{});
  return !report_.refused();
}

}  // namespace cnctrans::frontends::heidenhain
