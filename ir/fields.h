// One description of every node's fields, in one order, for whoever has to treat all of them: the printer and the
// reader of the textual form, the JSON form, and random programs in tests. Only for .cpp files of ir/ and tests.
//
// fields(v, node) calls `v` for each field. What a visitor must offer ("name" is the member in JSON and the keyword in
// the textual form; the notes say how the textual form shows it):
//   word(text)                       a fixed word, no field
//   item(name, x)                    always there, by position, no keyword
//   opt(name, x [, default])         `name x`, left out when it has the default
//   bare(name, x, default)           an enumerator alone, left out when it is the default
//   flag(name, b)                    the keyword alone when true
//   flag_off(keyword, name, b)       the keyword alone when false
//   given(name, has, x)              `name x` when `has`
//   axis(name, a), axis_opt(name, a) an axis by position; by keyword unless it is axis::none
//   pos(p), place(name, p)           place of a word; with keyword
//   quoted(name, text)               `as "text"` unless empty
//   code(is_explicit, text)          the code of a motion
//   words(name, list)                elements side by side, each beginning with an axis
//   each(name, list)                 the keyword before each element
//   exprs(name, list)                `(a, b)` unless empty
//   pairs(name, list)                `("a" 1, "b" 2)`
//   group(name, x)                   `name` and the fields of x, left out when all have their defaults
//   pointer(name, p)                 `name` and the fields of *p unless null
//   target(name, p)                  the fields of *p by position, or `nothing`
//   label(name, l), routine_name(name, n), space(name, id)
//   setting(ModalSet), action(data), cycle(node)  what the name says
//   body(name, b, line)              nested statements and their closing line; then_else for an If
//   assignments, arguments, declared lists with a form of their own
#pragma once

#include <concepts>
#include <type_traits>

#include "ir/program.h"

namespace cnctrans::ir::detail {

template <class T, class X>
concept Is = std::same_as<std::remove_const_t<T>, X>;

// --- words of a motion ------------------------------------------------------------------------------------------

template <class V, Is<CoordWord> T>
void fields(V& v, T& x) {
  v.axis("axis", x.axis);
  v.bare("mode", x.mode, WordMode::modal);
  v.bare("scale", x.scale, WordScale::modal);
  v.bare("direction", x.direction, RotaryDirection::as_value);
  v.bare("positioning", x.positioning, Positioning::with_path);
  v.item("value", x.value);
  v.pos(x.pos);
}
template <class V, Is<ComputedWord> T>
void fields(V& v, T& x) {
  v.item("value", x.value);
  v.opt("of", x.axis);
  v.bare("mode", x.mode, WordMode::modal);
  v.pos(x.pos);
}
template <class V, Is<CenterWord> T>
void fields(V& v, T& x) {
  v.axis("axis", x.axis);
  v.bare("mode", x.mode, CenterMode::from_start);
  v.bare("scale", x.scale, WordScale::radius);
  v.item("value", x.value);
  v.pos(x.pos);
}
template <class V, Is<PolynomialWord> T>
void fields(V& v, T& x) {
  v.axis_opt("of", x.axis);
  v.opt("end", x.end);
  v.opt("a2", x.a2);
  v.opt("a3", x.a3);
  v.opt("a4", x.a4);
  v.opt("a5", x.a5);
  v.opt("degree", x.degree, 1);
  v.flag("after_address", x.after_address);
  v.place("at", x.pos);
}
template <class V, Is<MotionExtra> T>
void fields(V& v, T& x) {
  v.given("turns", x.has_turns, x.turns);
  v.given("pitch", x.has_pitch, x.pitch);
  v.given("angle", x.has_angle, x.opening_angle);
  v.flag("signed", x.opening_signed);
  v.each("through", x.through);
  v.given("polar_radius", x.has_polar_radius, x.polar_radius);
  v.given("polar_angle", x.has_polar_angle, x.polar_angle);
  v.opt("polar_mode", x.polar_mode, WordMode::modal);
  v.opt("polar_angle_mode", x.polar_angle_mode, WordMode::modal);
  v.given("line_angle", x.has_line_angle, x.line_angle);
  v.given("lead", x.has_lead, x.lead);
  v.axis_opt("lead_axis", x.lead_axis);
  v.opt("lead_change", x.lead_change);
  v.given("start_angle", x.has_start_angle, x.start_angle);
  v.opt("tolerance", x.probe_tolerance);
  v.given("probe", x.has_probe_edge, x.probe_edge);
  v.flag("probe_goes_on", x.probe_goes_on);
  v.given("fixed_point", x.has_fixed_point, x.fixed_point);
  v.each("computed", x.computed);
  v.each("polynomial", x.polynomials);
  v.given("interval", x.has_interval, x.interval);
  v.given("weight", x.has_weight, x.weight);
  v.given("spline_degree", x.has_degree, x.degree);
}
template <class V, Is<Motion> T>
void fields(V& v, T& x) {
  v.item("kind", x.kind);
  v.code(x.explicit_code, x.code_text);
  v.place("code_at", x.code_pos);
  v.flag_off("once", "keeps_modal", x.keeps_modal);
  v.opt("in_frame", x.frame, FrameUse::normal);
  v.place("frame_at", x.frame_pos);
  v.words("coords", x.coords);
  v.each("centre", x.centers);
  v.given("radius", x.radius_given, x.radius);
  v.place("radius_at", x.radius_pos);
  v.pointer("extra", x.extra);
}

// --- actions ----------------------------------------------------------------------------------------------------

template <class V, Is<ModalSet> T>
void fields(V& v, T& x) {
  v.setting(x);
  v.flag_off("not_feed", "feed_too", x.feed_too);
  v.opt("feed_memory", x.feed_memory, FeedMemory::shared);
}
template <class V, Is<SetFeed> T>
void fields(V& v, T& x) {
  v.item("value", x.value);
  v.flag("zero_is_maximum", x.zero_is_maximum);
  v.flag("block_only", x.block_only);
}
template <class V, Is<SetSpindle> T>
void fields(V& v, T& x) {
  v.item("value", x.value);
  v.opt("of", x.number, 1);
}
template <class V, Is<SpindleRun> T>
void fields(V& v, T& x) {
  v.item("state", x.state);
  v.opt("of", x.number, 1);
}
template <class V, Is<SpindleOrient> T>
void fields(V& v, T& x) {
  v.item("angle", x.angle);
  v.flag("incremental", x.incremental);
  v.opt("of", x.number, 1);
}
template <class V, Is<SpindleLimit> T>
void fields(V& v, T& x) {
  v.item("value", x.value);
  v.flag("lower", x.lower);
  v.opt("of", x.number, 1);
}
template <class V, Is<SpindleGear> T>
void fields(V& v, T& x) {
  v.item("gear", x.gear);
  v.flag("automatic", x.automatic);
  v.opt("of", x.number, 1);
}
template <class V, Is<MasterSpindle> T>
void fields(V& v, T& x) {
  v.item("number", x.number);
}
template <class V, Is<ToolSelect> T>
void fields(V& v, T& x) {
  v.item("number", x.number);
  v.opt("name", x.name);
  v.flag("changes", x.changes);
}
template <class V, Is<ToolChange> T>
void fields(V&, T&) {}
template <class V, Is<ToolOffset> T>
void fields(V& v, T& x) {
  v.item("number", x.number);
}
template <class V, Is<WorkOffset> T>
void fields(V& v, T& x) {
  v.flag("off", x.off);
  if (x.off) {
    v.opt("index", x.index);
  } else {
    v.item("index", x.index);
  }
}
template <class V, Is<FrameWord> T>
void fields(V& v, T& x) {
  v.axis("axis", x.axis);
  v.bare("scale", x.scale, WordScale::modal);
  v.item("value", x.value);
  v.pos(x.pos);
}
template <class V, Is<FrameChange> T>
void fields(V& v, T& x) {
  v.item("slot", x.slot);
  v.item("kind", x.kind);
  v.item("combine", x.combine);
  v.flag("by_distance_mode", x.by_distance_mode);
  v.flag("uniform", x.uniform_scale);
  v.flag("fine", x.fine);
  v.words("words", x.words);
  v.given("angle", x.has_angle, x.angle);
  v.axis_opt("about", x.rotation_axis);
}
template <class V, Is<FrameOp> T>
void fields(V& v, T& x) {
  v.target("change", x.change);
}
template <class V, Is<PoleSet> T>
void fields(V& v, T& x) {
  v.target("at", x.at);
}
template <class V, Is<Dwell> T>
void fields(V& v, T& x) {
  v.item("value", x.value);
  v.opt("scale", x.scale, 1.0);
  v.flag("revolutions", x.revolutions);
}
template <class V, Is<ExactStopBlock> T>
void fields(V&, T&) {}
template <class V, Is<Coolant> T>
void fields(V& v, T& x) {
  v.item("state", x.state);
}
template <class V, Is<MachineFunction> T>
void fields(V& v, T& x) {
  v.item("code", x.code);
  v.opt("extension", x.extension, -1);
  v.flag("auxiliary", x.auxiliary);
  v.flag("computed", x.computed);
  v.opt("value", x.value);
}
template <class V, Is<Stop> T>
void fields(V& v, T& x) {
  v.flag("optional", x.optional);
}
template <class V, Is<CycleDefine> T>
void fields(V& v, T& x) {
  v.flag_off("once", "modal", x.modal);
  v.flag_off("later", "here", x.here);
  v.bare("trigger", x.trigger, CycleTrigger::plane_axis_word);
  v.target("cycle", x.cycle);
}
template <class V, Is<CycleCancel> T>
void fields(V&, T&) {}
template <class V, Is<Corner> T>
void fields(V& v, T& x) {
  v.item("kind", x.kind);
  v.item("value", x.value);
  v.flag("modal", x.modal);
  v.pointer("feed", x.feed);
}
template <class V, Is<TangentialEnd> T>
void fields(V& v, T& x) {
  v.item("end", x.end);
  v.item("radius", x.radius);
}
template <class V, Is<PreparationStop> T>
void fields(V&, T&) {}
template <class V, Is<OpaqueWord> T>
void fields(V& v, T& x) {
  v.item("word", x.word);
}
template <class V, Is<SplineAxis> T>
void fields(V& v, T& x) {
  v.axis("axis", x.axis);
}
template <class V, Is<SplineAxes> T>
void fields(V& v, T& x) {
  v.words("axes", x.axes);
}
template <class V, Is<SurfaceSet> T>
void fields(V& v, T& x) {
  v.item("surface", x.surface);
  v.opt("diameter", x.diameter);
}
template <class V, Is<Action> T>
void fields(V& v, T& x) {
  v.action(x.data);
  v.bare("order", x.order, Order::before);
  v.quoted("text", x.text);
  v.place("at", x.pos);
}

// --- cycles -----------------------------------------------------------------------------------------------------

/// `given` is not among them: a level is a `given` field of its cycle.
template <class V, Is<Level> T>
void fields(V& v, T& x) {
  v.bare("base", x.base, LevelBase::absolute);
  v.opt("otherwise", x.otherwise, LevelBase::from_initial);
  v.item("value", x.value);
}
template <class V, Is<Pecks> T>
void fields(V& v, T& x) {
  v.item("law", x.law);
  v.opt("first", x.first);
  v.given("first_to", x.first_to.given, x.first_to);
  v.opt("count", x.count);
  v.opt("degression", x.degression);
  v.opt("minimum", x.minimum);
  v.opt("lift", x.lift);
  v.flag("lift_rapid", x.lift_rapid);
  v.opt("reapproach", x.reapproach);
  v.flag("reapproach_automatic", x.reapproach_automatic);
  v.flag("withdraws_to_retract", x.withdraws_to_retract);
  v.flag("first_from_surface", x.first_from_surface);
  v.opt("dwell", x.dwell);
  v.given("first_feed_factor", x.has_first_feed_factor, x.first_feed_factor);
}
template <class V, Is<MillWords> T>
void fields(V& v, T& x) {
  v.item("shape", x.shape);
  v.pairs("words", x.words);
}
template <class V, Is<HoleCycle> T>
void fields(V& v, T& x) {
  v.item("kind", x.kind);
  v.axis_opt("axis", x.axis);
  v.given("surface", x.surface.given, x.surface);
  v.given("reference", x.reference.given, x.reference);
  v.given("bottom", x.bottom.given, x.bottom);
  v.given("retract", x.retract.given, x.retract);
  v.opt("dwell_bottom", x.dwell_bottom);
  v.opt("dwell_scale", x.dwell_scale, 1.0);
  v.flag("dwell_in_revolutions", x.dwell_in_revolutions);
  v.opt("dwell_top", x.dwell_top);
  v.given("feed", x.has_feed, x.feed);
  v.given("feed_out", x.has_feed_out, x.feed_out);
  v.group("pecks", x.pecks);
  v.opt("pitch", x.pitch);
  v.flag("rigid", x.rigid);
  v.opt("orient_angle", x.orient_angle);
  v.opt("shift_u", x.shift_u);
  v.opt("shift_v", x.shift_v);
  v.opt("shift_w", x.shift_w);
  v.flag("reference_may_be_below", x.reference_may_be_below);
  v.flag("approach_by_retract", x.approach_by_retract);
  v.flag("keeps_initial", x.keeps_initial);
  v.flag("orient_first", x.orient_first);
  v.opt("spindle_before", x.spindle_before, SpindleStep::usual);
  v.opt("spindle_bottom", x.spindle_bottom, SpindleStep::usual);
  v.opt("spindle_after", x.spindle_after, SpindleStep::usual);
  v.flag("spindle_after_retract", x.spindle_after_retract);
  v.given("speed", x.has_speed, x.speed);
  v.given("speed_out", x.has_speed_out, x.speed_out);
  v.group("mill", x.mill);
}
template <class V, Is<NamedCycle> T>
void fields(V& v, T& x) {
  v.item("name", x.name);
  v.pairs("words", x.words);
}
template <class V, Is<Cycle> T>
void fields(V& v, T& x) {
  v.cycle(x.node);
}

}  // namespace cnctrans::ir::detail
