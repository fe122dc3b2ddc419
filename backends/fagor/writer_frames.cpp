// Work offsets, the programmable frame and the polar origin (manual 8.3 to 8.6, 11.4, 11.5, 25.1).
#include <algorithm>
#include <cmath>

#include "backends/fagor/tables.h"
#include "backends/fagor/writer.h"
#include "base/saturate.h"

namespace cnctrans::backends::fagor {
namespace {

using dialects::fagor::Use;
using ir::FrameCombine;

}  // namespace

/// Blocks that the target needs one after the other: the place in the source stays that of the first.
void Writer::further_line(WordPos pos) {
  const auto& number = current().line.number;
  if (!number.empty() && labels().delimits_range(routine_index(), number)) {
    return refuse(no_word, pos, "this becomes two blocks on the target, and a repeated range begins or ends here",
                  "put a block with the range's number alone before or after it");
  }
  next_line();
}

void Writer::work_offset(const ir::Action& a, const ir::WorkOffset& w) {
  if (w.off) return add(std::string(g(Use::machine_coordinates)), Rank::setting, a.pos);
  if (w.index.literal()) {
    const auto row = saturate<int>(w.index.number);
    if (row < 1 || row > 20 || w.index.number != row) {
      return refuse(no_word, a.pos, "the control has the zero offsets 1 to 20");
    }
    const std::string_view code = g(Use::work_offset, row);
    if (!code.empty()) return add(std::string(code), Rank::setting, a.pos);
  }
  add(std::string(g(Use::numbered_offset)) + ' ' + word("N", w.index, a.pos), Rank::setting, a.pos);
}

/// The word's value as the mode in force on the target reads it; nullopt: it is not known.
std::optional<ir::Value> Writer::scaled(ir::AxisId axis, ir::WordScale scale, const ir::Value& v) {
  const machine::AxisSpec* spec = profile().axis(axis);
  if (scale == ir::WordScale::modal || spec == nullptr || !spec->diameter) return v;
  const auto mode = known<ir::DiameterMode>(ir::Setting::diameter);
  if (!mode || *mode == ir::DiameterMode::absolute_only) return std::nullopt;
  const bool diameter = *mode == ir::DiameterMode::diameter;
  if (diameter == (scale == ir::WordScale::diameter)) return v;
  if (!v.literal()) return std::nullopt;
  return ir::Value(v.number * (diameter ? 2 : 0.5));
}

/// The word says the place where its axis is known to stand.
bool Writer::stands_still(const ir::CoordWord& w) {
  if (facts() == nullptr || !w.value.literal() || !facts()->position[w.axis]) return false;
  if (w.mode == ir::WordMode::incremental || known<ir::Distance>(ir::Setting::distance) != ir::Distance::absolute)
    return false;
  const machine::AxisSpec* spec = profile().axis(w.axis);
  const auto mode = known<ir::DiameterMode>(ir::Setting::diameter);
  const bool has_diameters = spec != nullptr && spec->diameter;
  if (has_diameters && w.scale == ir::WordScale::modal && !mode) return false;
  const bool diameter =
      w.scale == ir::WordScale::diameter || (w.scale == ir::WordScale::modal && mode != ir::DiameterMode::radius);
  return std::fabs(w.value.number * (has_diameters && diameter ? 0.5 : 1) - *facts()->position[w.axis]) < 1e-9;
}

void Writer::frame_words(const ir::FrameChange& f, WordPos pos) {
  std::vector<ir::FrameWord> words = f.words;
  if (!same_dialect()) {
    std::stable_sort(words.begin(), words.end(), [](const auto& a, const auto& b) { return a.axis < b.axis; });
  }
  for (const ir::FrameWord& w : words) {
    const auto value = f.kind == ir::FrameKind::translate ? scaled(w.axis, w.scale, w.value) : std::optional(w.value);
    if (!value) {
      return refuse(no_word, w.pos.column != 0 ? w.pos : pos,
                    "whether this word is a radius or a diameter is not known here");
    }
    add(word(axis_name(w.axis), *value, w.pos), Rank::coordinate, w.pos);
  }
}

void Writer::frame_op(const ir::Action& a, const ir::FrameOp& op) {
  const ir::FrameChange& f = *op.change;
  const bool axis_factors = same_dialect() && f.slot == ir::FrameSlot::chain && f.kind == ir::FrameKind::scale &&
                            f.combine == FrameCombine::replace_named;
  if (axis_factors) {
    add(std::string(g(Use::scale)), Rank::setting, a.pos);
    return frame_words(f, a.pos);
  }
  if (same_dialect() && f.slot == ir::FrameSlot::chain) return inclined_plane(a, f);
  if (f.combine == FrameCombine::compose || f.slot == ir::FrameSlot::chain) return ProgramWriter::frame_op(a, op);
  switch (f.slot) {
    case ir::FrameSlot::preset:
      if (f.combine != FrameCombine::preset || f.words.empty()) {
        return refuse(no_word, a.pos, "ending a preset (G92) without selecting a zero offset has no counterpart here");
      }
      add(std::string(g(Use::preset)), Rank::setting, a.pos);
      return frame_words(f, a.pos);
    case ir::FrameSlot::shift: return shift(a, f);
    case ir::FrameSlot::rotation: return rotation(a, f);
    case ir::FrameSlot::scale: return scale(a, f);
    case ir::FrameSlot::mirror: return mirror(a, f);
    case ir::FrameSlot::chain: return;
  }
}

/// G49 and its words: the origin, then the turns by their letters; what the block does not say turns by 0.
void Writer::inclined_plane(const ir::Action& a, const ir::FrameChange& f) {
  if (f.kind == ir::FrameKind::translate) {
    const bool by_tool = !a.text.empty() && (a.text.back() == 'T' || a.text.back() == 't');
    add(std::string(g(Use::inclined_plane)) + (by_tool ? " T" : ""), Rank::setting, a.pos);
    return frame_words(f, a.pos);
  }
  constexpr std::string_view letters = "ABCQRS", as_written = "IJK";  // a turn is not the angle of I J K itself
  const bool edge = !a.text.empty() && a.text[0] == 'R' && f.rotation_axis == ir::axis::z;
  if (edge || (!a.text.empty() && as_written.find(a.text[0]) != std::string_view::npos))
    return add(std::string(a.text), Rank::coordinate, a.pos);
  if (!a.text.empty() && letters.find(a.text[0]) != std::string_view::npos)
    return add(word(a.text.substr(0, 1), f.angle, a.pos), Rank::coordinate, a.pos);
  if (!f.angle.is(0)) refuse(no_word, a.pos, "this rotation has no counterpart here");
}

/// G158 replaces on the axes it names; alone it ends the shift of all axes. G58 and G59 have no words.
void Writer::shift(const ir::Action& a, const ir::FrameChange& f) {
  const std::string code(g(Use::shift));
  const bool table_row = same_dialect() && !a.text.empty() && !f.words.empty() && f.words[0].pos.column == 0;
  if (table_row) return add(std::string(a.text), Rank::setting, a.pos);
  FrameCombine combine = f.combine;
  if (f.by_distance_mode) {
    const auto distance = known<ir::Distance>(ir::Setting::distance);
    if (!distance)
      return refuse(no_word, a.pos, "whether this shift replaces or adds depends on the path that leads here");
    combine = *distance == ir::Distance::absolute ? FrameCombine::replace_named : FrameCombine::add;
  }
  if (combine == FrameCombine::add)
    return refuse(no_word, a.pos, "a shift that adds to the one in force has no counterpart here");
  const bool bare_first =
      combine == FrameCombine::replace && !f.words.empty() && f.words.size() < profile().axes.size();
  if (bare_first) {
    add(code, Rank::setting);
    further_line(a.pos);
  }
  add(code, Rank::setting, a.pos);
  if (combine != FrameCombine::clear) frame_words(f, a.pos);
}

/// The words of a plane's point: I abscissa, J ordinate.
void Writer::plane_point(const std::vector<ir::FrameWord>& words, WordPos pos) {
  if (words.empty()) return;
  const auto plane = known<ir::Plane>(ir::Setting::plane);
  const auto word_of = [&](ir::AxisId axis) {
    return std::find_if(words.begin(), words.end(), [axis](const ir::FrameWord& w) { return w.axis == axis; });
  };
  ir::PlaneAxes axes{words[0].axis, words.size() > 1 ? words[1].axis : ir::axis::none, ir::axis::none};
  if (!same_dialect()) {
    if (!plane) return refuse(no_word, pos, "the plane is not known here, and a point in it is given");
    axes = ir::plane_axes(*plane);
  }
  for (const auto& [axis, letter] : {std::pair{axes.u, "I"}, std::pair{axes.v, "J"}}) {
    const auto at = word_of(axis);
    const ir::FrameWord none{axis, ir::Value(0), ir::WordScale::modal, {}};
    const ir::FrameWord& w = at == words.end() ? none : *at;
    const auto value = scaled(axis, w.scale, w.value);
    if (!value) return refuse(no_word, pos, "whether this point is a radius or a diameter is not known here");
    add(word(letter, *value, w.pos), Rank::center, w.pos);
  }
}

/// Successive G73 add up; G73 alone ends them (25.1).
void Writer::rotation(const ir::Action& a, const ir::FrameChange& f) {
  const std::string code(g(Use::rotation));
  if (code.empty()) return refuse(no_word, a.pos, "a rotation has no counterpart on the lathe model");
  if (f.combine == FrameCombine::clear) return add(code, Rank::setting, a.pos);
  if (!f.has_angle || f.by_distance_mode) return refuse(no_word, a.pos, "this rotation has no counterpart here");
  if (f.rotation_axis != ir::axis::none) {
    const auto plane = known<ir::Plane>(ir::Setting::plane);
    if (!plane || ir::plane_axes(*plane).w != f.rotation_axis) {
      return refuse(no_word, a.pos, "a rotation about another axis than the plane's own has no counterpart here");
    }
  }
  if (f.combine == FrameCombine::replace || f.combine == FrameCombine::replace_named) {
    if (f.angle.is(0)) return add(code, Rank::setting, a.pos);
    add(code, Rank::setting);
    further_line(a.pos);
  }
  add(code, Rank::setting, a.pos);
  add(word("Q", f.angle, a.pos), Rank::coordinate);
  plane_point(f.words, a.pos);
}

void Writer::scale(const ir::Action& a, const ir::FrameChange& f) {
  const std::string code(g(Use::scale));
  const bool replaces = f.combine == FrameCombine::replace || f.combine == FrameCombine::replace_named;
  if (f.combine == FrameCombine::clear) {
    add(code, Rank::setting, a.pos);
    return add("S1", Rank::spindle);
  }
  if (!replaces || !f.uniform_scale || f.words.empty()) {
    return refuse(no_word, a.pos,
                  "scale factors of single axes act on the finished path there; this scale has no counterpart");
  }
  add(code, Rank::setting, a.pos);
  add(word("S", f.words[0].value, a.pos), Rank::spindle, f.words[0].pos);
}

/// G11 to G14 add to what is mirrored; G10 ends all (11.4).
void Writer::mirror(const ir::Action& a, const ir::FrameChange& f) {
  const std::string off(g(Use::mirror_off));
  if (f.combine == FrameCombine::clear) return add(off, Rank::setting, a.pos);
  if (f.combine != FrameCombine::replace && f.combine != FrameCombine::replace_named) {
    return refuse(no_word, a.pos, "this change of the mirrored axes has no counterpart here");
  }
  const bool replaces = f.combine == FrameCombine::replace;
  std::vector<ir::AxisId> axes;
  for (const ir::FrameWord& w : f.words) {
    if (!w.value.literal() || (w.value.number == 0 && !replaces)) {
      return refuse(no_word, a.pos, "ending the mirror image of one axis only has no counterpart here",
                    "G10 ends it for all axes");
    }
    if (w.value.number != 0) axes.push_back(w.axis);
  }
  if (replaces) {
    add(off, Rank::setting, axes.empty() ? a.pos : WordPos{});
    if (axes.empty()) return;
    further_line(a.pos);
  }
  std::sort(axes.begin(), axes.end());
  const bool spelled = same_dialect() && !a.text.empty() && !f.words.empty() && f.words[0].pos.column != 0;
  const bool single_codes =
      !spelled && std::all_of(axes.begin(), axes.end(), [](ir::AxisId x) { return x <= ir::axis::z; });
  if (!single_codes) {
    add(std::string(g(Use::mirror_axes)), Rank::setting, a.pos);
    for (const ir::FrameWord& w : f.words) add(std::string(axis_name(w.axis)), Rank::coordinate, w.pos);
    return;
  }
  for (const ir::AxisId x : axes)
    add(std::string(g(Use::mirror_axis, x)), Rank::setting, axes.size() == 1 ? a.pos : WordPos{});
}

void Writer::pole_set(const ir::Action& a, const ir::PoleSet& p) {
  const bool relative = p.at && p.at->combine != ir::FrameCombine::replace;
  if (relative) return refuse("TRN-202", a.pos, "a pole given from another point has no counterpart here");
  add(std::string(g(Use::pole)), Rank::setting, a.pos);
  if (p.at && p.at->words.empty()) return add("I0 J0", Rank::setting);
  if (p.at && p.at->words.size() == 1 && !same_dialect())
    return refuse("TRN-316", a.pos, "along one axis this pole stays where it is, and that is not known here");
  if (p.at) plane_point(p.at->words, a.pos);
}

}  // namespace cnctrans::backends::fagor
