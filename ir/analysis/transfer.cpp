// What one statement does to the modal facts.
#include <cmath>

#include "base/saturate.h"
#include "ir/analysis/dataflow.h"
#include "ir/analysis/fact_set.h"
#include "ir/analysis/modal_runs.h"
#include "ir/analysis/pattern_ends.h"
#include "ir/check/missing_features.h"
#include "ir/cycles/hole.h"
#include "ir/cycles/machining.h"
#include "ir/cycles/milling/pocket_call.h"
#include "ir/geometry/contour.h"
#include "ir/geometry/geometry.h"
#include "ir/known_number.h"
#include "ir/motion_kinds.h"
#include "ir/opaque_words.h"

namespace cnctrans::ir {
namespace {

class Transfer {
 public:
  explicit Transfer(Facts& facts, const detail::FrameReach& framed = {}, std::uint32_t id = 0)
      : f_(facts), framed_(framed), id_(id) {}

  void block(const Block& b) {
    for (const auto& a : b.actions) {
      if (a.order != Order::after && !leaves_path_alone(a)) std::visit(*this, a.data);
    }
    if (b.has_motion) motion(b);
    const auto points_end = detail::pattern_end(b, f_);
    if (runs_here_ || (b.has_motion && b.motion.moves()) || detail::path_words(b)) cycle_moves();
    if (detail::has_pattern(b)) forget_positions();
    for (const auto& a : b.actions) {
      // A word kept as text that acts behind the block says something of the tool, not of the path.
      if (a.order == Order::after && !std::holds_alternative<OpaqueWord>(a.data)) std::visit(*this, a.data);
    }
    if (runs_here_) cycle_moves();
    for (const auto& [axis, place] : points_end) set_position(axis, place);
    if (follows_) forget_positions();  // the end follows from the next element
    if (machining_ != nullptr) machined();
    if (pocket_) {  // its operations have tools, feeds and functions of their own
      f_.forget();
      f_.motion = MotionKind::rapid;
      for (const auto& a : b.actions) {
        if (a.order == Order::after) std::visit(*this, a.data);
      }
    }
    if (not_understood_) f_.forget();
  }

  // --- actions ---
  void operator()(const ModalSet& x) {
    auto& setting = f_.settings[static_cast<std::size_t>(x.setting)];
    const auto before = setting;
    setting = x.value;
    if (before == x.value) {
      // Inches may hold for lengths alone or for F too: the same number may be another feed now.
      if (x.setting == Setting::units && static_cast<Units>(x.value) == Units::inch) f_.feed.reset();
      return;
    }
    if (x.setting == Setting::units) {
      if (before)
        scale_positions(static_cast<Units>(x.value) == Units::inch ? 1 / 25.4 : 25.4);
      else
        forget_positions();
      if (x.feed_too) f_.feed.reset();
    } else if (x.setting == Setting::feed_mode && x.feed_memory != FeedMemory::shared) {
      f_.feed.reset();
    } else if (x.setting == Setting::spindle_mode) {
      f_.spindle.reset();
    }
  }
  void operator()(const SetFeed& x) {
    if (x.block_only) return;
    f_.feed = x.zero_is_maximum && !x.value.literal() ? std::nullopt : known_number(x.value);
    if (x.zero_is_maximum && f_.feed == 0.0) f_.feed.reset();
  }
  void operator()(const SetSpindle& x) {
    if (f_.master == x.number) f_.spindle = detail::speed_number(x.value, f_);
    const bool taken_over = framed_.cycles_turn && (f_.cycle_active || !f_.cycle_active_known);
    if (!f_.master || taken_over) f_.spindle.reset();
  }
  /// Each spindle keeps its own speed and its own kind of speed.
  void operator()(const MasterSpindle& x) {
    if (f_.master == x.number) return;
    f_.master = x.number;
    f_.spindle.reset();
    f_.settings[static_cast<std::size_t>(Setting::spindle_mode)].reset();
  }
  void operator()(const WorkOffset& x) {
    const auto row = x.off ? std::optional(0.0) : known_number(x.index);
    std::optional<std::int32_t> offset;
    if (row && std::fabs(*row) < 1e6) offset = saturate<std::int32_t>(std::round(*row));
    // What holds before any is selected is no more known to be without an offset than the target's start is.
    if (!offset || offset == 0 || offset != f_.work_offset || framed_.rows_change) forget_positions();
    f_.work_offset = offset;
  }
  /// Presetting says where the tool is; any other frame change moves the coordinates under it.
  void operator()(const FrameOp& x) {
    if (!x.change || x.change->combine != FrameCombine::preset) {
      forget(framed_.axes);
      return;
    }
    if (framed_.presets_by_offset && f_.work_offset == 0) return;
    const bool in_force = f_.work_offset.has_value() || !framed_.presets_by_offset;
    for (const auto& w : x.change->words)
      set_position(w.axis, !in_force ? std::nullopt : resolved(w.axis, w.scale, true, known_number(w.value)));
  }
  void operator()(const CycleDefine& x) {
    const auto* hole = x.cycle ? std::get_if<HoleCycle>(&x.cycle->node) : nullptr;
    const bool plain_hole = hole != nullptr && cycles::ends_over_its_place(*hole, x.here && !x.modal);
    if (hole != nullptr) detail::take_speeds(*hole, f_, x.here);
    runs_here_ = x.here;
    here_is_hole_ = plain_hole;
    if (x.here && plain_hole) hole_here_ = hole;  // its retract plane may stand behind it in the block
    along_ = x.here && hole != nullptr && hole->kind != HoleKind::mill && hole->axis != axis::none ? hole : nullptr;
    if (x.here && plain_hole) place_ = cycles::own_place(*hole);
    const auto* named = x.cycle ? std::get_if<NamedCycle>(&x.cycle->node) : nullptr;
    const auto* cycle = named != nullptr && !x.modal && x.here ? cycles::find_machining(named->name) : nullptr;
    pocket_ = pocket_ || (named != nullptr && named->name == cycles::pocket::call);
    if (cycle != nullptr) {
      runs_here_ = false;
      machining_ = named;
      kind_ = cycle;
    }
    if (!x.modal) return;
    f_.cycle_active = f_.cycle_active_known = true;
    f_.cycle_is_hole = plain_hole;
    f_.cycle_from = id_;
  }
  void operator()(const CycleCancel&) {
    f_.cycle_active = f_.cycle_is_hole = false;
    f_.cycle_active_known = true;
    f_.cycle_from = 0;
  }
  void operator()(const OpaqueWord& x) {
    const bool contour = x.word == contour::mark::secant || x.word == contour::mark::tangent ||
                         x.word == contour::mark::plus || x.word == contour::mark::minus;
    (contour ? follows_ : not_understood_) = true;
  }
  /// The same place in other coordinates.
  void operator()(const SurfaceSet& x) {
    auto& setting = f_.settings[static_cast<std::size_t>(Setting::surface)];
    if (setting == static_cast<std::uint8_t>(x.surface) && x.surface != Surface::cylinder) return;
    setting = static_cast<std::uint8_t>(x.surface);
    for (const AxisId a : {axis::x, axis::y, axis::c}) f_.position[a].reset();
  }
  template <class T>
  void operator()(const T&) {}

  /// Where a hole carried out here leaves the tool.
  void leaves_at(const HoleCycle& hole) {
    const auto plane = setting(Setting::retract_plane);
    const bool to_reference = !hole.retract.given && plane == static_cast<std::uint8_t>(RetractPlane::reference);
    stays_ = (!hole.retract.given && plane == static_cast<std::uint8_t>(RetractPlane::initial)) ||
             (hole.retract.given && hole.retract.base == LevelBase::from_initial && hole.retract.value.is(0));
    const Level& left = to_reference ? hole.reference : hole.retract;
    const bool absolute = left.base == LevelBase::absolute ||
                          (left.base == LevelBase::distance_mode &&
                           setting(Setting::distance) == static_cast<std::uint8_t>(Distance::absolute));
    if (left.given && absolute) left_at_ = known_number(left.value);
  }

  /// The same points in the other unit; rotary axes have none.
  void scale_positions(double factor) {
    for (std::size_t a = 0; a < f_.position.size(); ++a) {
      if (!f_.position[a]) continue;
      if (is_rotary_letter(static_cast<AxisId>(a)) || a >= axis::first_extra)
        f_.position[a].reset();
      else
        *f_.position[a] *= factor;
    }
  }
  void forget_positions() { f_.position.fill(std::nullopt); }
  void forget(std::uint32_t axes) {
    for (std::size_t i = 0; i < f_.position.size(); ++i) {
      if ((axes >> i & 1U) != 0) f_.position[i].reset();
    }
  }

 private:
  void set_position(AxisId id, std::optional<double> x) {
    if (id < f_.position.size()) f_.position[id] = x;
  }
  std::optional<std::uint8_t> setting(Setting s) const { return f_.settings[static_cast<std::size_t>(s)]; }

  /// A coordinate as radius. Only X can be a diameter axis.
  std::optional<double> resolved(AxisId id, WordScale scale, bool absolute, std::optional<double> x) const {
    if (!x || scale == WordScale::radius) return x;
    if (scale == WordScale::diameter) return *x / 2;
    if (id != axis::x) return x;
    const auto mode = setting(Setting::diameter);
    if (!mode) return std::nullopt;
    const auto m = static_cast<DiameterMode>(*mode);
    const bool diameter = m == DiameterMode::diameter || (m == DiameterMode::absolute_only && absolute);
    return diameter ? *x / 2 : *x;
  }

  std::optional<double> target(const CoordWord& w, bool repeated) const {
    std::optional<std::uint8_t> mode = setting(Setting::distance);
    if (w.mode != WordMode::modal) {
      mode = static_cast<std::uint8_t>(w.mode == WordMode::absolute ? Distance::absolute : Distance::incremental);
    }
    if (!mode || w.axis >= f_.position.size() || w.direction != RotaryDirection::as_value) return std::nullopt;
    const bool absolute = *mode == static_cast<std::uint8_t>(Distance::absolute);
    const auto x = resolved(w.axis, w.scale, absolute, known_number(w.value));
    if (absolute || !x) return x;
    const auto start = f_.position[w.axis];
    return start && !repeated ? std::optional(*start + *x) : std::nullopt;
  }

  void motion(const Block& b) {
    const Motion& m = b.motion;
    const auto kind = m.kind == MotionKind::modal ? f_.motion : std::optional(m.kind);
    if (m.kind != MotionKind::modal && m.keeps_modal) f_.motion = left_in_force(m.kind);
    const bool plain = kind && !ends_at_the_machine(*kind) && m.frame == FrameUse::normal;
    if (m.coords.empty() && kind && ends_at_the_machine(*kind)) return forget_positions();
    const auto before = f_.position;
    if (!plain) forget(framed_.turned);  // an axis of the machine moves more than one coordinate of theirs
    for (const auto& w : m.coords) set_position(w.axis, plain ? target(w, b.repeat_given != 0) : std::nullopt);
    if (m.extra && !m.extra->computed.empty()) forget_positions();  // the axis is known to the run only
    if (m.extra) extra(*m.extra, m);
    if (m.extra && m.extra->has_line_angle && plain && b.repeat_given == 0) by_angle(*m.extra, m, before);
    if (m.extra && m.extra->has_angle && plain && b.repeat_given == 0) by_opening(*m.extra, m, kind, before);
  }

  /// The end of an arc by its centre and its angle.
  void by_opening(const MotionExtra& x, const Motion& m, std::optional<MotionKind> kind,
                  const decltype(Facts::position)& before) {
    const auto plane = setting(Setting::plane), distance = setting(Setting::distance);
    const auto angle = known_number(x.opening_angle);
    const bool arc = kind == MotionKind::arc_cw || kind == MotionKind::arc_ccw;
    if (!plane || !angle || !arc || m.centers.empty() || m.radius_given || x.has_polar_radius || x.has_polar_angle)
      return;
    const PlaneAxes axes = plane_axes(static_cast<Plane>(*plane));
    const auto u = before[axes.u], v = before[axes.v];
    if (!u || !v || has_word(m, axes.u) || has_word(m, axes.v)) return;
    geometry::Vec centre{*u, *v};
    for (const auto& w : m.centers) {
      const bool relative =
          w.mode == CenterMode::from_start ||
          (w.mode == CenterMode::follows_distance && distance == static_cast<std::uint8_t>(Distance::incremental));
      const auto value = resolved(w.axis, w.scale, !relative, known_number(w.value));
      if (!value || (!relative && w.mode == CenterMode::follows_distance && !distance)) return;
      if (w.axis != axes.u && w.axis != axes.v) return;
      (w.axis == axes.u ? centre.u : centre.v) = *value + (relative ? (w.axis == axes.u ? *u : *v) : 0);
    }
    const double sweep = std::fabs(*angle);
    const auto end = geometry::turned({*u, *v}, centre, kind == MotionKind::arc_ccw ? sweep : -sweep);
    set_position(axes.u, end.u);
    set_position(axes.v, end.v);
  }

  /// The other end of a line by its angle and one coordinate of the plane.
  void by_angle(const MotionExtra& x, const Motion& m, const decltype(Facts::position)& before) {
    const auto plane = setting(Setting::plane);
    const auto angle = known_number(x.line_angle);
    if (!plane || !angle || x.has_polar_radius || x.has_polar_angle || x.has_angle) return;
    const PlaneAxes axes = plane_axes(static_cast<Plane>(*plane));
    const bool first = has_word(m, axes.u);
    if (first == has_word(m, axes.v)) return;
    const AxisId given = first ? axes.u : axes.v, other = first ? axes.v : axes.u;
    const auto from = before[given], to = f_.position[given], start = before[other];
    if (!from || !to || !start) return;
    const double radians = *angle * std::acos(-1.0) / 180;
    const double along = first ? std::cos(radians) : std::sin(radians);
    if (std::fabs(along) < 1e-9) return;
    set_position(other, *start + (*to - *from) * (first ? std::sin(radians) : std::cos(radians)) / along);
  }

  static bool has_word(const Motion& m, AxisId id) {
    for (const auto& w : m.coords) {
      if (w.axis == id) return true;
    }
    return false;
  }

  /// Ends that follow from angles, radii and turns are not computed here.
  void extra(const MotionExtra& x, const Motion& m) {
    const auto plane = setting(Setting::plane);
    // An opening angle beside the end, without a centre: the centre follows.
    const auto ends_by_words = [&](const PlaneAxes& axes) {
      return m.centers.empty() && (has_word(m, axes.u) || has_word(m, axes.v));
    };
    const bool opens = x.has_angle && !(plane && ends_by_words(plane_axes(static_cast<Plane>(*plane))));
    const bool in_plane = x.has_polar_radius || x.has_polar_angle || x.has_line_angle || opens;
    const bool along_normal = x.has_pitch;
    if (!in_plane && !along_normal) return;
    if (!plane) {
      for (const AxisId id : {axis::x, axis::y, axis::z}) {
        if (!has_word(m, id) || in_plane) set_position(id, std::nullopt);
      }
      return;
    }
    const PlaneAxes axes = plane_axes(static_cast<Plane>(*plane));
    const bool polar = x.has_polar_radius || x.has_polar_angle;
    for (const AxisId id : {axes.u, axes.v}) {
      if (in_plane && (polar || !has_word(m, id))) set_position(id, std::nullopt);
    }
    if (along_normal && !has_word(m, axes.w)) set_position(axes.w, std::nullopt);
  }

  /// A cycle that can run in this block leaves the tool elsewhere than the words say.
  void cycle_moves() {
    const bool active = f_.cycle_active || !f_.cycle_active_known;
    if (!active && !runs_here_) return;
    if (along_ != nullptr && f_.cycle_active_known && (!f_.cycle_active || f_.cycle_from == id_))
      return hole_along(*along_);
    const bool holes_only = (!active || (f_.cycle_active_known && f_.cycle_is_hole)) && (!runs_here_ || here_is_hole_);
    const auto plane = setting(Setting::plane);
    if (!holes_only || !plane) return forget_positions();
    const auto [u, v, w] = plane_axes(static_cast<Plane>(*plane));
    if (hole_here_ != nullptr) leaves_at(*hole_here_);
    for (const auto& [axis, value] : {std::pair(u, place_.first), std::pair(v, place_.second)}) {
      if (value != nullptr) set_position(axis, resolved(axis, WordScale::modal, true, known_number(*value)));
    }
    const bool defined_here = runs_here_ && here_is_hole_ && f_.cycle_from == id_;
    if ((active && !defined_here) || !runs_here_)
      set_position(w, std::nullopt);
    else if (!stays_)
      set_position(w, left_at_ ? resolved(w, WordScale::modal, true, left_at_) : std::nullopt);
  }

  /// A hole of this block along an axis of its own: the others stay.
  void hole_along(const HoleCycle& hole) {
    leaves_at(hole);
    if (!stays_)
      set_position(hole.axis, left_at_ ? resolved(hole.axis, WordScale::modal, true, left_at_) : std::nullopt);
  }

  const Value* word(std::string_view name) const {
    for (const auto& [n, v] : machining_->words) {
      if (n == name) return &v;
    }
    return nullptr;
  }
  /// Where a machining cycle leaves the tool, its feed and its motion function.
  void machined() {
    if (f_.cycle_active || !f_.cycle_active_known) return f_.forget();
    if (kind_->ends_modes) {
      f_.motion = MotionKind::rapid;
      for (const std::string_view name : {"rough_feed", "finish_feed"}) {
        const Value* v = word(name);
        const auto n = v != nullptr ? known_number(*v) : std::nullopt;
        if (v != nullptr && n != 0.0) f_.feed = n;
      }
    }
    if (machining_->name == "part.off") {  // it sets the speed, and may set its mode
      f_.spindle.reset();
      f_.settings[static_cast<std::size_t>(Setting::spindle_mode)].reset();
    }
    if (kind_->ends == cycles::CycleEnd::at_call) return;
    const auto number = [this](std::string_view name) {
      const Value* v = word(name);
      return v != nullptr ? known_number(*v) : std::optional(0.0);
    };
    const auto depth = number("depth"), clearance = number("clearance");
    std::optional<double> away;
    if (depth && clearance) away = (*depth < 0 ? -1 : 1) * std::fabs(*clearance);
    auto x = resolved(axis::x, WordScale::modal, true, number("x")), z = number("z");
    auto& raised = kind_->face ? z : x;
    raised = raised && away ? std::optional(*raised + *away) : std::nullopt;
    const bool elsewhere = kind_->ends == cycles::CycleEnd::elsewhere;
    f_.position[axis::x] = elsewhere ? std::nullopt : x;
    f_.position[axis::z] = elsewhere ? std::nullopt : z;
  }

  Facts& f_;
  detail::FrameReach framed_;
  std::uint32_t id_;
  std::optional<double> left_at_;  ///< height after the hole of this block
  bool stays_ = false;             ///< the hole of this block ends where it began
  const NamedCycle* machining_ = nullptr;
  const cycles::MachiningCycle* kind_ = nullptr;
  bool runs_here_ = false;
  bool here_is_hole_ = false;
  const HoleCycle* hole_here_ = nullptr;                           ///< the hole of this block
  const HoleCycle* along_ = nullptr;                               ///< the same, along an axis that it names
  std::pair<const Value*, const Value*> place_{nullptr, nullptr};  ///< that its words name
  bool not_understood_ = false, follows_ = false;
  bool pocket_ = false;
};

void assign(const Assign& a, Facts& f) {
  for (const auto& it : a.items) {
    if (!it.to_system || it.system.datum == Datum::axis_feed) continue;
    // A machine datum may be an offset or a frame: what depends on them is no longer known. F and S are words only.
    if (!detail::is_tool_datum(it.system.datum)) Transfer(f).forget_positions();
    if (it.system.datum == Datum::other) f.work_offset.reset();
    if (it.system.datum == Datum::diameter_on) {
      const auto value = constant_value(it.value);
      auto& mode = f.settings[static_cast<std::size_t>(Setting::diameter)];
      mode.reset();
      if (value) mode = static_cast<std::uint8_t>(*value != 0 ? DiameterMode::diameter : DiameterMode::radius);
    }
  }
}

}  // namespace

void Facts::forget() {
  const bool was_reachable = reachable;
  const bool chosen = master != std::uint8_t{1};
  *this = Facts{};
  reachable = was_reachable;
  if (chosen) master.reset();
  cycle_active_known = false;
  modal_call = -1;
}

void apply(const Statement& statement, Facts& facts) {
  detail::apply(statement, facts, {});
}

void detail::apply(const Statement& statement, Facts& facts, const FrameReach& framed) {
  if (const auto* b = std::get_if<Block>(&statement.node)) {
    Transfer(facts, framed, statement.id).block(*b);
    if (facts.modal_call_runs() && moves(statement)) facts.forget();
  } else if (const auto* a = std::get_if<Assign>(&statement.node)) {
    assign(*a, facts);
  } else if (const auto* o = std::get_if<Opaque>(&statement.node)) {
    const auto* feature = o->harmless ? nullptr : find_missing_feature(o->feature);
    const bool beside = feature != nullptr && feature->beside_path;
    if (!o->harmless && !o->feature.empty() && !beside) facts.forget();  // without a feature: see passes::refuse
  } else if (std::holds_alternative<CallRoutine>(statement.node)) {
    facts.forget();
  } else if (const auto* r = std::get_if<Repeat>(&statement.node)) {
    if (r->has_program || r->first.computed || r->last.computed) facts.forget();
  } else if (const auto* m = std::get_if<ModalCall>(&statement.node)) {
    const auto* turned = m->cycle ? std::get_if<HoleCycle>(&m->cycle->node) : nullptr;
    if (turned != nullptr) detail::take_speeds(*turned, facts, m->here);
    if (m->off && m->here) {  // a modal cycle stays in force
      facts.modal_call = 0;
      return;
    }
    if (m->here) facts.forget();
    const auto* hole = m->cycle ? std::get_if<HoleCycle>(&m->cycle->node) : nullptr;
    facts.cycle_active = !m->off && m->cycle != nullptr;
    facts.cycle_active_known = true;
    facts.cycle_is_hole = !m->off && hole != nullptr && cycles::ends_over_its_place(*hole);
    facts.cycle_from = facts.cycle_active ? statement.id : 0;
    facts.modal_call = m->off || m->cycle ? 0 : -1;
  }
}

namespace {

template <class T>
bool narrow(std::optional<T>& a, const std::optional<T>& b) {
  if (!a || a == b) return false;
  a.reset();
  return true;
}

bool narrow_cycle(Facts& a, const Facts& b) {
  const bool other = a.cycle_from != b.cycle_from && a.cycle_from != Facts::several_cycles;
  if (other) a.cycle_from = Facts::several_cycles;
  if (!a.cycle_active_known) return other;
  if (!b.cycle_active_known || a.cycle_active != b.cycle_active) {
    a.cycle_active_known = a.cycle_active = a.cycle_is_hole = false;
    return true;
  }
  if (!a.cycle_is_hole || b.cycle_is_hole) return other;
  a.cycle_is_hole = false;
  return true;
}

}  // namespace

bool join(Facts& facts, const Facts& other) {
  if (!other.reachable) return false;
  if (!facts.reachable) {
    facts = other;
    return true;
  }
  bool changed = false;
  for (std::size_t i = 0; i < setting_count; ++i) changed |= narrow(facts.settings[i], other.settings[i]);
  for (std::size_t i = 0; i < facts.position.size(); ++i) changed |= narrow(facts.position[i], other.position[i]);
  changed |= narrow(facts.motion, other.motion);
  changed |= narrow(facts.work_offset, other.work_offset);
  changed |= narrow(facts.feed, other.feed);
  changed |= narrow(facts.spindle, other.spindle);
  changed |= narrow(facts.master, other.master);
  changed |= narrow_cycle(facts, other);
  const bool none_runs = !facts.modal_call_runs() && !other.modal_call_runs();
  const std::int32_t joined = facts.modal_call == other.modal_call ? facts.modal_call
                              : none_runs                          ? Facts::in_modal_run
                                                                   : -1;
  if (facts.modal_call != joined && facts.modal_call != -1) {
    facts.modal_call = joined;
    changed = true;
  }
  return changed;
}

}  // namespace cnctrans::ir
