#include "interpreter/profile_contour.h"

#include <cmath>

#include "interpreter/block_machine.h"

namespace cnctrans::interpreter {

namespace {

constexpr std::uint64_t most_elements = 100'000;

/// Moves become elements.
class ElementSink final : public TraceSink {
 public:
  void on_event(const Event& e) override {
    if (e.kind != EventKind::linear && e.kind != EventKind::arc && e.kind != EventKind::rapid) {
      if (e.kind == EventKind::thread || e.kind == EventKind::probe) strange = true;
      return;
    }
    const ir::cycles::TurnPoint to{e.to.value[ir::axis::x], e.to.value[ir::axis::z]};
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

}  // namespace

void BlockMachine::stand_for_contour(const ir::ModalState& state, std::optional<ir::cycles::TurnPoint> from) {
  restore_modal(state);
  for_contour_ = true;
  for (auto& slot : slots_) slot = Frame{};
  use_frame(Frame{});
  modal_.motion = ir::MotionKind::linear;
  modal_.plane = ir::Plane::zx;
  modal_.comp = ir::CompSide::off;
  hole_.reset();
  base_pending_ = 0;
  p_.fill(0);
  if (!from) return;
  p_[ir::axis::x] = from->x;
  p_[ir::axis::z] = from->z;
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
  if (sink.strange) return *error = "its profile holds a motion that is no contour", std::nullopt;
  if (emitter.limit_reached()) return *error = "its profile is too long", std::nullopt;
  return std::move(sink.out);
}

}  // namespace cnctrans::interpreter
