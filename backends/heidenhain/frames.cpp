// Datum shift, mirror, rotation, scale, preset (reference 18).
#include "backends/heidenhain/tables.h"
#include "backends/heidenhain/writer.h"

namespace cnctrans::backends::heidenhain {

void Writer::work_offset(const ir::Action& a, const ir::WorkOffset& w) {
  if (w.off) return refuse(no_word, a.pos, "a preset is always in force here: no work offset has no counterpart");
  add("CYCL DEF 247 DATUM SETTING ~\n  Q339=" + signed_amount(w.index, a.pos) + " ;DATUM NUMBER", Rank::head);
}

/// Cycle 7 keeps the axes that it does not name: a shift that holds for all names all.
void Writer::shift(const ir::Action& a, const ir::FrameChange& c) {
  if (plan_.is_taken_back(current())) return;
  std::vector<std::string> parts{"DATUM SHIFT"};
  if (c.combine == ir::FrameCombine::clear || c.combine == ir::FrameCombine::replace) {
    for (const auto& axis : profile().axes) {
      if (axis.rotary) continue;
      ir::Value v(0);
      for (const auto& w : c.words) {
        if (w.axis == axis.id) v = w.value;
      }
      parts.push_back(word(axis_name(axis.id), v, a.pos));
    }
    return old_cycle(7, parts);
  }
  bool add_up = c.combine == ir::FrameCombine::add;
  if (c.by_distance_mode) {
    const auto mode = setting(ir::Setting::distance);
    if (!mode) return refuse(no_word, a.pos, "whether this shift adds to the one before depends on the way here");
    add_up = *mode == code_value(ir::Distance::incremental);
  }
  for (const auto& w : c.words)
    parts.push_back(word((add_up ? "I" : "") + std::string(axis_name(w.axis)), w.value, w.pos));
  old_cycle(7, parts);
}

/// Whether cycle 11 scales the tool axis as well is a parameter of the machine (18.6); cycle 26 says each axis.
void Writer::scale(const ir::Action& a, const ir::Value& factor) {
  std::string axes;
  for (const auto& axis : profile().axes) {
    if (!axis.rotary && axis.id <= ir::axis::z) axes += std::string(axis_name(axis.id)) + amount(factor, a.pos) + ' ';
  }
  old_cycle(26, {"AXIS-SPEC. SCALING", axes + "CCX+0 CCY+0"});
}

void Writer::frame_op(const ir::Action& a, const ir::FrameOp& f) {
  const ir::FrameChange& c = *f.change;
  const bool clear = c.combine == ir::FrameCombine::clear;
  switch (c.slot) {
    case ir::FrameSlot::shift:
      if (c.kind == ir::FrameKind::translate && c.combine != ir::FrameCombine::preset) return shift(a, c);
      break;
    case ir::FrameSlot::rotation: {
      if (!c.words.empty()) return refuse(no_word, a.pos, "a rotation about a centre has no counterpart here");
      const bool by_plane = c.rotation_axis == ir::axis::none;
      const bool about_z =
          by_plane ? setting(ir::Setting::plane) == code_value(ir::Plane::xy) : c.rotation_axis == ir::axis::z;
      if (!clear && !about_z && !same_dialect())
        return refuse(no_word, a.pos, "a rotation about another axis than Z has no counterpart here",
                      "write the part with G17");
      const std::string sign = c.combine == ir::FrameCombine::add ? "IROT" : "ROT";
      return old_cycle(10, {"ROTATION", sign + signed_amount(clear ? ir::Value(0) : c.angle, a.pos)});
    }
    case ir::FrameSlot::mirror: {
      std::string axes;
      for (const auto& w : c.words) {
        if (!w.value.literal()) return refuse(no_word, a.pos, "a computed mirror has no counterpart here");
        if (!w.value.is(0)) axes += (axes.empty() ? "" : " ") + std::string(axis_name(w.axis));
      }
      return old_cycle(8, {"MIRROR IMAGE", clear ? std::string{} : axes});
    }
    case ir::FrameSlot::scale:
      if (!clear && !(c.uniform_scale && c.words.size() == 1)) break;
      return scale(a, clear ? ir::Value(1) : c.words[0].value);
    default: break;
  }
  ProgramWriter::frame_op(a, f);
}

}  // namespace cnctrans::backends::heidenhain
