#include "interpreter/machine/profile_contour.h"

#include <algorithm>
#include <cmath>

#include "interpreter/machine/block_machine.h"

namespace cnctrans::interpreter {

namespace {

constexpr std::uint64_t most_elements = 100'000;
constexpr double no_place = 1e9;  ///< mm: a coordinate that no block has given yet

/// Moves become elements.
class ElementSink final : public TraceSink {
 public:
  void on_event(const Event& e) override {
    if (e.kind != EventKind::linear && e.kind != EventKind::arc && e.kind != EventKind::rapid) {
      if (e.kind == EventKind::thread || e.kind == EventKind::probe) strange = true;
      return;
    }
    const ir::cycles::TurnPoint to{e.to.value[ir::axis::x], e.to.value[ir::axis::z]};
    open = open || to.x > no_place / 2 || to.z > no_place / 2;
    if (e.kind != EventKind::rapid && begun) {
      auto& list = blank ? out.blank : out.part;
      list.push_back({at, to, e.kind == EventKind::arc, !e.cw, {e.center_v, e.center_u}});
      if (e.kind == EventKind::arc && e.plane != ir::Plane::zx) strange = true;
    }
    at = to;
    begun = true;
  }
  ir::cycles::TurnProfile out;
  ir::cycles::TurnPoint at;
  bool begun = false, blank = false, strange = false;
  bool open = false;  ///< a coordinate of the first point is missing
};

/// The same in any plane; the way to the first point belongs to no contour.
class MillSink final : public TraceSink {
 public:
  MillSink(ir::Plane plane, bool several, bool in_space) : plane_(plane), several_(several), in_space_(in_space) {}
  void on_event(const Event& e) override {
    const bool rapid = e.kind == EventKind::rapid;
    if (!rapid && e.kind != EventKind::linear && e.kind != EventKind::arc) {
      if (e.kind == EventKind::thread || e.kind == EventKind::probe) strange = true;
      return;
    }
    const auto axes = ir::plane_axes(plane_);
    const double u = e.to.value[axes.u], v = e.to.value[axes.v], w = e.to.value[axes.w];
    const bool arc = e.kind == EventKind::arc;
    if (!begun || (several_ && rapid)) {
      strange = strange || arc;
      open = open || u > no_place / 2 || v > no_place / 2;
      out.emplace_back();
      if (several_ && w < no_place / 2) out.back().surface = w;
      open = open || (in_space_ && w > no_place / 2);
      if (in_space_) out.back().heights.push_back(w);
    } else if (arc || std::hypot(u - u_, v - v_) > 1e-9) {
      strange = strange || rapid || (arc && (e.plane != plane_ || e.turns != 0));
      out.back().elements.push_back({u_, v_, u, v, arc, !e.cw, e.center_u, e.center_v});
      if (in_space_) out.back().heights.push_back(w);
    } else if (in_space_) {
      strange = strange || std::abs(w - out.back().heights.back()) > 1e-9;  // straight down
    }
    u_ = u;
    v_ = v;
    begun = true;
  }
  std::vector<ir::cycles::MillContour> out;
  bool begun = false, strange = false;
  bool open = false;  ///< a coordinate of the first point is missing

 private:
  ir::Plane plane_;
  bool several_, in_space_;
  double u_ = 0, v_ = 0;
};

/// The block without what is no geometry.
ir::Block geometry_of(const ir::Block& b) {
  ir::Block out = b;
  std::erase_if(out.actions, [](const ir::Action& a) {
    const auto* m = std::get_if<ir::ModalSet>(&a.data);
    const bool keeps = m != nullptr ? m->setting != ir::Setting::comp
                                    : std::holds_alternative<ir::Corner>(a.data) ||
                                          std::holds_alternative<ir::TangentialEnd>(a.data) ||
                                          std::holds_alternative<ir::PoleSet>(a.data);
    return !keeps;
  });
  out.repeat_given = 0;
  return out;
}

/// The contours of a pocket know no frame, and the first point of all is absolute.
bool fits_pocket(const ir::Block& b, bool must_be_absolute, std::string* error) {
  bool absolute = false;
  for (const auto& a : b.actions) {
    if (std::holds_alternative<ir::FrameOp>(a.data) || std::holds_alternative<ir::WorkOffset>(a.data))
      return *error = "the contour of a pocket holds a shift, mirror image, scale or rotation", false;
    const auto* set = std::get_if<ir::ModalSet>(&a.data);
    absolute = absolute || (set != nullptr && set->setting == ir::Setting::distance &&
                            set->value == static_cast<std::uint8_t>(ir::Distance::absolute));
  }
  if (must_be_absolute && !absolute)
    return *error = "the contour of the pocket begins under incremental coordinates; write absolute ones", false;
  return true;
}

}  // namespace

void BlockMachine::stand_for_contour(const ir::ModalState& state, std::optional<ir::cycles::TurnPoint> from) {
  restore_modal(state);
  for_contour_ = true;
  parts_.replace_all(Frame{});
  use_frame(Frame{});
  modal_.motion = ir::MotionKind::linear;
  modal_.plane = ir::Plane::zx;
  modal_.comp = ir::CompSide::off;
  cycle_.hole.reset();
  increments_.pending = 0;
  p_.fill(0);
  // Without a start the move to the first point is seen wherever that lies.
  path_event_.to.value[ir::axis::x] = from ? from->x : no_place;
  path_event_.to.value[ir::axis::z] = from ? from->z : no_place;
  if (!from) return;
  p_[ir::axis::x] = from->x;
  p_[ir::axis::z] = from->z;
}

void BlockMachine::stand_for_mill_contour(const ir::ModalState& state, bool with_height) {
  const auto plane = ir::plane_axes(state.plane);
  stand_for_contour(state, std::nullopt);
  modal_.plane = state.plane;
  p_[plane.u] = p_[plane.v] = no_place;
  path_event_.to.value[plane.u] = path_event_.to.value[plane.v] = no_place;
  if (with_height) p_[plane.w] = path_event_.to.value[plane.w] = no_place;
}

std::optional<std::vector<ir::cycles::MillContour>> mill_contours_of(const machine::Profile& machine,
                                                                     const ir::ModalState& modal,
                                                                     const std::vector<const ir::Statement*>& blocks,
                                                                     bool several, ValueSource* values,
                                                                     std::string* error, bool in_space) {
  MillSink sink(modal.plane, several, in_space);
  Emitter emitter(sink, most_elements);
  Failure failure;
  BlockMachine reader(machine, emitter, failure, values);
  reader.stand_for_mill_contour(modal, several || in_space);
  for (const auto* s : blocks) {
    const auto& whole = std::get<ir::Block>(s->node);
    if (several && !fits_pocket(whole, s == blocks.front() && modal.distance == ir::Distance::incremental, error))
      return std::nullopt;
    const auto b = geometry_of(whole);
    if (b.has_motion && b.motion.frame != ir::FrameUse::normal)
      return *error = "a machine position in the contour is not carried out", std::nullopt;
    if (!reader.block(b, s->line.span)) break;
  }
  if (!failure.set) reader.finish();
  if (failure.set) return *error = "its contour can't be read: " + failure.text, std::nullopt;
  if (sink.open)
    return *error = in_space ? "the first block of the contour names all three axes"
                             : "the first block of the contour names both axes of the plane",
           std::nullopt;
  if (sink.strange) return *error = "its contour holds a motion that is no line or arc in the plane", std::nullopt;
  if (emitter.limit_reached()) return *error = "its contour is too long", std::nullopt;
  if (several && !sink.out.empty() && !sink.out.front().surface)
    return *error = "the first block of the contour names the height of the surface too", std::nullopt;
  const bool empty = std::any_of(sink.out.begin(), sink.out.end(), [](const auto& c) { return c.elements.empty(); });
  if (sink.out.empty() || empty) return *error = "its contour has no elements", std::nullopt;
  return std::move(sink.out);
}

std::optional<ir::cycles::TurnProfile> contour_of(const machine::Profile& machine, const ContourStart& start,
                                                  const std::vector<const ir::Statement*>& blocks, ValueSource* values,
                                                  std::string* error) {
  ElementSink sink;
  Emitter emitter(sink, most_elements);
  Failure failure;
  BlockMachine reader(machine, emitter, failure, values);
  reader.stand_for_contour(start.modal, start.from);
  if (start.from) {
    sink.at = *start.from;
    sink.begun = true;
  }
  for (const auto* s : blocks) {
    const auto b = geometry_of(std::get<ir::Block>(s->node));
    if (b.has_motion && b.motion.frame != ir::FrameUse::normal)
      return *error = "a machine position in the profile is not carried out", std::nullopt;
    if (start.rapid_begins_blank && b.has_motion && b.motion.kind == ir::MotionKind::rapid) sink.blank = true;
    if (!reader.block(b, s->line.span)) break;
  }
  if (!failure.set) reader.finish();
  if (failure.set) return *error = "its profile can't be read: " + failure.text, std::nullopt;
  if (sink.open) return *error = "the first block of the profile names both X and Z", std::nullopt;
  if (sink.strange) return *error = "its profile holds a motion that is no contour", std::nullopt;
  if (emitter.limit_reached()) return *error = "its profile is too long", std::nullopt;
  return std::move(sink.out);
}

}  // namespace cnctrans::interpreter
