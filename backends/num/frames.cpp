// Origin shifts, rotation, scale and mirror image in the words of a NUM.
#include <cmath>

#include "backends/num/style.h"
#include "backends/num/writer.h"

namespace cnctrans::backends::num {

void Writer::work_offset(const ir::Action& a, const ir::WorkOffset& w) {
  if (w.off) return add("G53", Rank::setting, a.pos);
  if (!w.index.is(1))
    return refuse(no_word, a.pos, "this control has one settable offset (G54): another row has no counterpart");
  add("G54", Rank::setting, a.pos);
}

void Writer::shift(const ir::Action& a, const ir::FrameChange& c) {
  if (same_dialect() && a.text.rfind("E6", 0) == 0) return add(std::string(a.text), Rank::head, a.pos);
  const auto mode = setting(ir::Setting::distance);
  const bool add_up = c.combine == ir::FrameCombine::add;
  std::string text = "G59";
  if (same_dialect() && !c.words.empty() && c.words.front().pos.column != 0) {
    // Each word at its place: a G90 or G91 among them stands at its own.
    if (!a.text.empty()) add(std::string(a.text), Rank::setting, a.pos);
    for (const auto& w : c.words) add(word(axis_name(w.axis), w.value, w.pos), Rank::coordinate, w.pos);
    return;
  }
  if (c.combine == ir::FrameCombine::clear || c.combine == ir::FrameCombine::replace) {
    // G59 keeps the axes it does not name: all of them are named.
    if (!mode) return refuse(no_word, a.pos, "the programmed shift is set while G90 or G91 is not known");
    for (const auto& axis : profile().axes) {
      if (axis.rotary) continue;
      ir::Value v(0);
      for (const auto& w : c.words) {
        if (w.axis == axis.id) v = w.value;
      }
      text += ' ' + word(axis_name(axis.id), v, a.pos);
    }
    if (mode != code_value(ir::Distance::absolute)) text = "G90 " + text + " G91";
    return add(text, Rank::setting, a.pos);
  }
  const auto wanted = add_up ? ir::Distance::incremental : ir::Distance::absolute;
  const bool as_is = c.by_distance_mode || mode == code_value(wanted);
  if (!as_is && !mode) return refuse(no_word, a.pos, "the programmed shift is set while G90 or G91 is not known");
  for (const auto& w : c.words) {
    if (w.value.is(0) && profile().axis(w.axis) == nullptr) continue;  // the machine has nothing to put back
    text += ' ' + word(axis_name(w.axis), w.value, w.pos);
  }
  if (!as_is) text = (add_up ? "G91 " : "G90 ") + text + (add_up ? " G90" : " G91");
  add(text, Rank::setting, a.pos);
}

/// G21 the face, G22 the cylinder on which X stands, G20 the axes again (12.6).
void Writer::surface_set(const ir::Action& a, const ir::SurfaceSet& s) {
  if (profile().kind != machine::Kind::lathe) return ProgramWriter::surface_set(a, s);
  const std::string_view code = s.surface == ir::Surface::face       ? "G21"
                                : s.surface == ir::Surface::cylinder ? "G22"
                                                                     : "G20";
  add(std::string(code), Rank::setting, a.pos);
}

void Writer::frame_op(const ir::Action& a, const ir::FrameOp& f) {
  const ir::FrameChange& c = *f.change;
  const bool clear = c.combine == ir::FrameCombine::clear;
  if (c.slot == ir::FrameSlot::shift && c.kind == ir::FrameKind::translate) return shift(a, c);
  if (c.slot == ir::FrameSlot::rotation && (clear || c.combine == ir::FrameCombine::replace)) {
    if (!c.words.empty() && !same_dialect())
      return refuse(no_word, a.pos, "a rotation about a centre has no counterpart here");
    std::string text = word("ED", clear ? ir::Value(0) : c.angle, a.pos);
    for (const auto& w : c.words) text += ' ' + word(std::string(1, "IJK"[w.axis % 3]), w.value, w.pos);
    return add(text, Rank::setting, a.pos);
  }
  if (c.slot == ir::FrameSlot::mirror && (clear || c.combine == ir::FrameCombine::replace_named)) {
    std::string text = "G51";
    if (clear) text += profile().kind == machine::Kind::lathe ? " X+ Z+" : " X+ Y+ Z+";
    for (const auto& w : c.words) {
      if (!w.value.literal()) return refuse(no_word, a.pos, "a computed mirror has no counterpart here");
      text += ' ' + std::string(axis_name(w.axis)) + (w.value.is(0) ? '+' : '-');
    }
    return add(text, Rank::setting, a.pos);
  }
  if (c.slot == ir::FrameSlot::scale && clear) return add("G73", Rank::setting, a.pos);
  if (c.slot == ir::FrameSlot::scale && same_dialect()) return add("G74", Rank::setting, a.pos);
  if (c.slot == ir::FrameSlot::scale && c.uniform_scale && c.words.size() == 1) {  // thousandths in E69000
    const ir::Value& factor = c.words[0].value;
    const double thousandths = std::round(factor.number * 1000);
    if (!factor.literal() || std::fabs(thousandths - factor.number * 1000) > 1e-6 || thousandths < 1 ||
        thousandths > 9999)
      return refuse(no_word, a.pos, "a scale factor that is not a fixed number of thousandths (0.001 to 9.999)");
    add("E69000=" + std::to_string(static_cast<int>(thousandths)), Rank::head, a.pos);
    return add("G74", Rank::setting, a.pos);
  }
  if (c.slot == ir::FrameSlot::preset && clear && same_dialect()) return;  // taken over by PREF
  if (c.slot == ir::FrameSlot::preset && c.combine == ir::FrameCombine::preset) {
    std::string text = "G92";
    for (const auto& w : c.words) text += ' ' + word(axis_name(w.axis), w.value, w.pos);
    return add(text, Rank::setting, a.pos);
  }
  ProgramWriter::frame_op(a, f);
}

}  // namespace cnctrans::backends::num
