// Default words of actions and motions: what ISO-like languages have in common; the rest is refused.
#include <algorithm>

#include "backends/common/program_writer.h"
#include "base/text.h"
#include "ir/edit/search.h"
#include "ir/opaque_words.h"

namespace cnctrans::backends {
namespace {

constexpr std::string_view no_word = "TRN-202";

}  // namespace

void ProgramWriter::modal_set(const ir::Action& a, const ir::ModalSet& m) {
  const std::string_view code = modal_code(style_, m.setting, m.value);
  if (code.empty()) {
    return refuse(no_word, a.pos,
                  "the setting '" + std::string(ir::name(m.setting)) + ' ' +
                      std::string(ir::setting_value_name(m.setting, m.value)) + "' has no counterpart here");
  }
  add(std::string(code), Rank::setting, a.pos);
}

void ProgramWriter::set_feed(const ir::Action& a, const ir::SetFeed& f) {
  if (f.zero_is_maximum && f.value.is(0)) {
    return refuse(no_word, a.pos, "F0 means the greatest feed of the source machine, which is not known here",
                  "write the feed as a number");
  }
  add(word("F", f.value, a.pos), Rank::feed, a.pos);
}

void ProgramWriter::set_spindle(const ir::Action& a, const ir::SetSpindle& s) {
  if (s.number != words_of_spindle_) return refuse(no_word, a.pos, "a second spindle has no counterpart here");
  add(word("S", s.value, a.pos), Rank::spindle, a.pos);
}

void ProgramWriter::tool_select(const ir::Action& a, const ir::ToolSelect& t) {
  if (!t.name.empty()) return refuse(no_word, a.pos, "a tool called by its name has no counterpart here");
  add(word("T", t.number, a.pos), Rank::tool, a.pos);
}

void ProgramWriter::tool_offset(const ir::Action& a, const ir::ToolOffset& t) {
  add(word("D", t.number, a.pos), Rank::offset, a.pos);
}

void ProgramWriter::exact_stop(const ir::Action& a) {
  if (style_.exact_stop_block.empty()) return refuse(no_word, a.pos, "exact stop in one block has no counterpart here");
  add(std::string(style_.exact_stop_block), Rank::setting, a.pos);
}

void ProgramWriter::preparation_stop(const ir::Action& a) {
  if (style_.preparation_stop.empty()) {
    diagnostics_.note("TRN-211", span_of(a.pos),
                      "the stop of the block preparation has no counterpart and is left out");
    return;
  }
  add(std::string(style_.preparation_stop), Rank::setting, a.pos);
}

void ProgramWriter::spindle_orient(const ir::Action& a, const ir::SpindleOrient& /*s*/) {
  refuse(no_word, a.pos, "orienting the spindle has no counterpart here");
}
void ProgramWriter::spindle_limit(const ir::Action& a, const ir::SpindleLimit& /*s*/) {
  refuse(no_word, a.pos, "a spindle speed limit has no counterpart here");
}
void ProgramWriter::work_offset(const ir::Action& a, const ir::WorkOffset& /*w*/) {
  refuse(no_word, a.pos, "this work offset has no counterpart here");
}
void ProgramWriter::frame_op(const ir::Action& a, const ir::FrameOp& /*f*/) {
  refuse(no_word, a.pos, "this shift, rotation, scale or mirror has no counterpart here");
}
void ProgramWriter::pole_set(const ir::Action& a, const ir::PoleSet& /*p*/) {
  refuse(no_word, a.pos, "a polar origin has no counterpart here");
}
void ProgramWriter::dwell(const ir::Action& a, const ir::Dwell& /*d*/) {
  refuse(no_word, a.pos, "this dwell has no counterpart here");
}
void ProgramWriter::cycle_define(const ir::Action& a, const ir::CycleDefine& /*c*/) {
  refuse("TRN-214", a.pos, "this cycle has no counterpart here");
}
void ProgramWriter::cycle_cancel(const ir::Action& a) {
  refuse("TRN-214", a.pos, "ending a cycle has no counterpart here");
}
void ProgramWriter::corner(const ir::Action& a, const ir::Corner& /*c*/) {
  refuse(no_word, a.pos, "a rounded or chamfered corner has no counterpart here");
}
void ProgramWriter::tangential_end(const ir::Action& a, const ir::TangentialEnd& /*t*/) {
  refuse(no_word, a.pos, "a tangential entry or exit has no counterpart here");
}
/// Its end alone, where none is on: nothing to say.
void ProgramWriter::surface_set(const ir::Action& a, const ir::SurfaceSet& s) {
  if (s.surface == ir::Surface::none) return;
  refuse(no_word, a.pos, "work with the C axis on the face or the cylinder has no counterpart here");
}
void ProgramWriter::opaque_word(const ir::Action& a, const ir::OpaqueWord& w) {
  if (same_dialect_) return add(std::string(w.word), Rank::motion_extra, a.pos);
  if (ir::leaves_path_alone(a)) {
    if (!left_out_.insert(to_upper_ascii(w.word)).second) return;
    return diagnostics_.warning(
        "TRN-205", span_of(a.pos),
        "'" + std::string(w.word) +
            "' is left out: the programmed path is the same without it; the feed, accuracy, timing or the "
            "corners of a compensated path may differ (said once for each such word)");
  }
  refuse("TRN-205", a.pos, "the word '" + std::string(w.word) + "' is not translated");
}

// ---- motion --------------------------------------------------------------------------------------------------------

namespace {

/// What only the control that has it can say; empty: nothing of the kind.
std::string_view own_motion(const ir::Motion& m) {
  for (const ir::CoordWord& w : m.coords) {
    if (w.positioning != ir::Positioning::with_path) return "an axis that moves by itself";
  }
  if (!m.extra) return {};
  if (!m.extra->computed.empty()) return "an axis named by a variable";
  if (m.extra->has_probe_edge) return "a move that measures";
  return m.extra->has_fixed_point ? "a fixed point of the machine" : "";
}

/// The code of a move; a thread whose lead falls may have one of its own.
std::string_view code_of(const Style& style, const ir::Motion& m) {
  const bool falls = m.kind == ir::MotionKind::thread_variable && m.extra && m.extra->lead_change.literal() &&
                     m.extra->lead_change.number < 0;
  return falls && !style.falling_thread.empty() ? style.falling_thread : motion_code(style, m.kind);
}
bool unknown_fall(const Style& style, const ir::Motion& m) {
  return m.kind == ir::MotionKind::thread_variable && !style.falling_thread.empty() && m.extra &&
         !m.extra->lead_change.literal();
}

}  // namespace

ir::HolePoint ProgramWriter::point_in_rapid() {
  const auto* block = current_ != nullptr ? std::get_if<ir::Block>(&current_->node) : nullptr;
  if (block == nullptr || profile().policies.cycle_positioning != machine::CyclePositioning::rapid)
    return ir::HolePoint::no;
  const ir::Facts* f = facts();
  return f != nullptr ? ir::hole_point(*block, *f) : ir::HolePoint::no;
}

void ProgramWriter::motion(const ir::Motion& m) {
  if (const std::string_view what = own_motion(m); !same_dialect_ && !what.empty()) {
    return refuse(no_word, m.coords.empty() ? m.code_pos : m.coords.front().pos,
                  std::string(what) + " has no counterpart here");
  }
  frame_use(m);
  if (style_.code_waits_for_move && is_code_alone(m)) {
    tracker_.keeps_on(ir::left_in_force(m.kind));
  } else if (m.kind != ir::MotionKind::modal) {
    const bool known_already = !m.explicit_code && tracker_.text() == m.kind;
    const std::string_view own = same_dialect_ ? m.code_text : std::string_view{};
    const std::string_view code = own.empty() ? code_of(style_, m) : own;
    if (unknown_fall(style_, m) && own.empty()) {
      return refuse(no_word, m.code_pos,
                    "a thread whose lead changes by a computed value: whether it rises or falls is another code here",
                    "write the change as a number");
    }
    if (code.empty() && m.kind == ir::MotionKind::to_stop) {
      return refuse(
          no_word, m.code_pos, "a move until the axis meets an obstacle has no counterpart here",
          "write the target's own travel to a fixed stop by hand, with its force and its window, or a move to "
          "a place that is known");
    }
    if (code.empty()) {
      return refuse(no_word, m.code_pos, "a motion '" + std::string(ir::name(m.kind)) + "' has no counterpart here");
    }
    if (!known_already) add(std::string(code), Rank::motion_code, m.code_pos);
    tracker_.wrote(m.kind, m.keeps_modal);
  } else if (m.moves()) {
    const MotionTracker seen = tracker_;
    auto kind = tracker_.needed(std::nullopt);
    // A control that goes to its holes in rapid needs no code there: not the one, either, that comes back behind a code
    // that was written for a single move.
    const auto point = kind && !same_dialect_ ? point_in_rapid() : ir::HolePoint::no;
    if (point == ir::HolePoint::yes) {
      tracker_ = seen;
      kind.reset();
    }
    if (kind == ir::MotionKind::modal) {
      const ir::Facts* f = facts();
      if (f != nullptr && !f->reachable)
        kind.reset();  // never carried out: as it stands
      else if (f != nullptr)
        kind = tracker_.needed(f->motion);
    }
    if (kind == ir::MotionKind::modal) {
      return refuse("TRN-216", {}, "the motion code in force here is not known, and the target needs one",
                    "write G0, G1, G2 or G3 in this block");
    }
    if (point == ir::HolePoint::perhaps && kind && kind != ir::MotionKind::rapid) {
      return refuse(
          "TRN-216", {},
          "the target needs the motion code again here, which no hole of a cycle takes, and whether a cycle is "
          "active depends on the path that leads here",
          "write G0 or G1 in this block, or cancel the cycle on every path");
    }
    if (kind) add(std::string(motion_code(style_, *kind)), Rank::motion_code);
  }
  for (const ir::CoordWord& w : m.coords) coordinate(m, w);
  for (const ir::CenterWord& w : m.centers) center(m, w);
  if (m.radius_given) radius(m);
  if (m.extra) motion_extra(m, *m.extra);
}

void ProgramWriter::frame_use(const ir::Motion& m) {
  if (m.frame == ir::FrameUse::normal) return;
  refuse(no_word, m.frame_pos, "a move in machine coordinates has no counterpart here");
}

void ProgramWriter::coordinate(const ir::Motion& /*m*/, const ir::CoordWord& w) {
  if (w.mode != ir::WordMode::modal || w.scale != ir::WordScale::modal) {
    return refuse(no_word, w.pos,
                  "a coordinate that is absolute, incremental, radius or diameter by itself has no counterpart here");
  }
  if (w.direction != ir::RotaryDirection::as_value) {
    return refuse(no_word, w.pos, "the direction of this rotary move has no counterpart here");
  }
  add(word(axis_name(w.axis), w.value, w.pos), Rank::coordinate, w.pos);
}

void ProgramWriter::center(const ir::Motion& /*m*/, const ir::CenterWord& w) {
  if (w.mode != ir::CenterMode::from_start || w.scale == ir::WordScale::diameter) {
    return refuse(no_word, w.pos, "this form of an arc's centre has no counterpart here");
  }
  constexpr std::string_view letters = "IJK";
  if (w.axis > ir::axis::z) return refuse(no_word, w.pos, "the centre of an arc on this axis has no counterpart here");
  add(word(letters.substr(w.axis, 1), w.value, w.pos), Rank::center, w.pos);
}

void ProgramWriter::radius(const ir::Motion& m) {
  add(word(style_.radius_address, m.radius, m.radius_pos), Rank::radius, m.radius_pos);
}

void ProgramWriter::motion_extra(const ir::Motion& m, const ir::MotionExtra& /*e*/) {
  refuse(no_word, m.code_pos, "this form of a motion has no counterpart here");
}

}  // namespace cnctrans::backends
