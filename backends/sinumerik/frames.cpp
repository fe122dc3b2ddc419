// Frame statements and poles (reference-language 14.5; motion reference 7.5).
#include "backends/sinumerik/tables.h"
#include "backends/sinumerik/writer.h"

namespace cnctrans::backends::sinumerik {

/// The words at this place of the source line stand there already: they were written for the statement before, which
/// was made of the same words.
bool Writer::stands_already(WordPos pos) {
  const Span& line = current().line.span;
  const bool same = written_column_ != 0 && pos.column == written_column_ && line.file == written_line_.file &&
                    line.line == written_line_.line;
  if (!same) {
    written_column_ = pos.column;
    written_line_ = line;
  }
  return same;
}

/// Under TRANSMIT the words of X are radii by themselves.
bool Writer::radius_on_face(ir::AxisId axis) {
  return axis == ir::axis::x && setting(ir::Setting::surface) == code_value(ir::Surface::face);
}

/// A word without an attribute is a radius, or the axis knows no diameters.
bool Writer::plain_is_radius(ir::AxisId axis) {
  const auto* spec = profile().axis(axis);
  return spec == nullptr || !spec->diameter || radius_on_face(axis);
}

void Writer::surface_set(const ir::Action& a, const ir::SurfaceSet& s) {
  switch (s.surface) {
    case ir::Surface::none: return add("TRAFOOF", Rank::setting, a.pos);
    case ir::Surface::face: return add("TRANSMIT", Rank::setting, a.pos);
    case ir::Surface::tool: return;  // the word that switches the transformation stands there
    case ir::Surface::cylinder: break;
  }
  add("TRACYL(" + (s.diameter.literal() ? number_text(s.diameter) : expression_text(s.diameter.expr)) + ')',
      Rank::setting, a.pos);
}

void Writer::frame_op(const ir::Action& a, const ir::FrameOp& f) {
  // $P_PFRAME=CTRANS(X,5):CROT(Z,30), ROTS X10 Y20: several changes, or angles that were computed, in the words of the
  // source
  const bool whole = a.text.find_first_of("=(") != std::string_view::npos ||
                     a.text.find("ROTS ") != std::string_view::npos || a.text.find("rots ") != std::string_view::npos;
  if (same_dialect() && whole) {
    if (!stands_already(a.pos)) add(std::string(a.text), Rank::head, a.pos);
    return;
  }
  const ir::FrameChange& c = *f.change;
  if (same_dialect() && c.slot != ir::FrameSlot::chain && !a.text.empty()) {  // TOFRAME, CYCLE800(..)
    if (!stands_already(a.pos)) add(std::string(a.text), Rank::head, a.pos);
    return;
  }
  if (c.slot == ir::FrameSlot::chain && c.combine == ir::FrameCombine::replace_named &&
      c.kind == ir::FrameKind::translate) {
    std::string text = same_dialect() && !a.text.empty() ? std::string(a.text) : c.fine ? "G59" : "G58";
    for (const ir::FrameWord& w : c.words) text += ' ' + word(axis_name(w.axis), w.value, w.pos);
    return add(std::move(text), Rank::head, a.pos);
  }
  const bool composes = c.combine == ir::FrameCombine::compose;
  if (c.slot != ir::FrameSlot::chain || c.by_distance_mode ||
      (!composes && c.combine != ir::FrameCombine::replace && c.combine != ir::FrameCombine::clear)) {
    return refuse("TRN-202", a.pos, "this shift, rotation, scale or mirror has no counterpart here");
  }
  std::string_view verb = "TRANS";
  if (c.kind == ir::FrameKind::rotate) verb = "ROT";
  if (c.kind == ir::FrameKind::scale) verb = "SCALE";
  if (c.kind == ir::FrameKind::mirror) verb = "MIRROR";
  if (c.combine == ir::FrameCombine::clear) {
    return add(std::string(same_dialect() && !a.text.empty() ? a.text : std::string_view("TRANS")), Rank::head, a.pos);
  }
  std::string text = (composes ? "A" : "") + std::string(verb);
  if (same_dialect() && !a.text.empty()) text = a.text;
  if (c.has_angle) {
    if (!c.words.empty()) return refuse("TRN-202", a.pos, "a rotation about a given centre has no counterpart here");
    const bool by_axis = c.rotation_axis != ir::axis::none;
    text += ' ' + word(by_axis ? axis_name(c.rotation_axis) : std::string_view("RPL"), c.angle, a.pos);
  }
  const auto one = [&](std::string_view address, const ir::Value& v, WordPos pos) {
    text += ' ' + word(address, v, pos);
  };
  for (const ir::FrameWord& w : c.words) {
    const bool scaled = w.scale == ir::WordScale::modal || radius_on_face(w.axis) || c.kind == ir::FrameKind::scale ||
                        c.kind == ir::FrameKind::mirror;
    if (!scaled && program().lathe && w.axis == ir::axis::x) {
      return refuse("TRN-202", w.pos, "a shift of X that is not in the diameter mode in force has no counterpart here");
    }
    if (c.kind == ir::FrameKind::scale && c.uniform_scale) {
      for (const ir::AxisId axis : {ir::axis::x, ir::axis::y, ir::axis::z}) {
        if (profile().axis(axis) != nullptr) one(axis_name(axis), w.value, w.pos);
      }
      break;
    }
    if (c.kind == ir::FrameKind::mirror) {
      if (!w.value.is(0)) one(axis_name(w.axis), ir::Value(0), w.pos);
      continue;
    }
    one(axis_name(w.axis), w.value, w.pos);
  }
  add(std::move(text), Rank::head, a.pos);
}

/// G111 from the zero point, G110 from the present point, G112 from the last pole.
void Writer::pole_set(const ir::Action& a, const ir::PoleSet& p) {
  std::string text = "G110";
  const bool own = same_dialect() && !a.text.empty();
  if (p.at) {
    if (p.at->combine == ir::FrameCombine::add) text = "G112";
    if (p.at->combine == ir::FrameCombine::replace) text = "G111";
    if (own) text = a.text;
    for (const ir::FrameWord& w : p.at->words) text += ' ' + word(axis_name(w.axis), w.value, w.pos);
  } else {
    const auto plane = setting(Setting::plane);
    if (!plane) return refuse("TRN-202", a.pos, "the plane in force is not known, and the polar origin needs it");
    const ir::PlaneAxes axes = ir::plane_axes(static_cast<ir::Plane>(*plane));
    text += ' ' + std::string(axis_name(axes.u)) + "0 " + std::string(axis_name(axes.v)) + '0';
  }
  add(std::move(text), Rank::head, a.pos);
}

/// AP or RP: absolute or an increment as the block is; AC() and IC() stand where that is another mode.
void Writer::polar_word(ir::WordMode mode, std::string_view address, const ir::Value& v) {
  const bool absolute = mode == ir::WordMode::absolute;
  const auto same = code_value(absolute ? ir::Distance::absolute : ir::Distance::incremental);
  const bool plain = mode == ir::WordMode::modal || setting(Setting::distance) == same;
  add(plain ? word(address, v, {}) : attribute_word(address, absolute ? "AC" : "IC", v, {}), Rank::motion_extra);
}

}  // namespace cnctrans::backends::sinumerik
