// M functions (reference 10).
#include <string>
#include <utility>

#include "base/saturate.h"
#include "dialects/heidenhain/limits.h"
#include "dialects/heidenhain/m_codes.h"
#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;

namespace {

/// What the machine's own table says of the function, else that of the control.
facts::MRow row_of(const machine::Profile& profile, std::int64_t code) {
  facts::MRow row;
  if (const auto* known = facts::m_row(code)) row = *known;
  row.code = static_cast<std::int16_t>(code);
  const auto* own = profile.m_code(static_cast<std::int32_t>(code));
  if (own != nullptr && row.use == facts::MUse::plain) {
    row.meaning = own->meaning;
    row.order = own->order;
  }
  return row;
}

}  // namespace

ir::Action Lowering::function_action(double code) const {
  using machine::MMeaning;
  const facts::MRow row = row_of(profile_, saturate<std::int64_t>(code));
  ir::Action a;
  const auto coolant = row.meaning == MMeaning::coolant_flood    ? ir::CoolantState::flood
                       : row.meaning == MMeaning::coolant_mist   ? ir::CoolantState::mist
                       : row.meaning == MMeaning::coolant_second ? ir::CoolantState::second
                                                                 : ir::CoolantState::off;
  if (coolant != ir::CoolantState::off || row.meaning == MMeaning::coolant_off) {
    a.data = ir::Coolant{coolant};
  } else {
    ir::MachineFunction f;
    f.code = saturate<std::int32_t>(code);
    a.data = std::move(f);
  }
  return a;
}

void Lowering::machine_function(const Word& w) {
  const double n = w.number;
  const auto code = saturate<std::int64_t>(n);
  if (w.is_expression || n < 0 || n != static_cast<double>(code) || code > facts::m_max)
    return report_.refuse("HEI-002", w.pos, "`" + std::string(slice(w)) + "` is no M function", {}, "block.word");
  const facts::MRow row = row_of(profile_, code);
  const auto put_action = [&](ir::ActionData data) { act(w, std::move(data), row.order); };
  const std::string name = "`" + std::string(slice(w)) + "` (" + std::string(row.title) + ")";
  const auto feed_mode = [&](ir::FeedMode mode) {
    per_rev_ = mode == ir::FeedMode::per_rev;
    act(w, ir::ModalSet{ir::Setting::feed_mode, static_cast<std::uint8_t>(mode), true, ir::FeedMemory::cleared});
  };
  using facts::MUse;
  switch (row.use) {
    case MUse::plain:
    case MUse::coolant_too: break;
    case MUse::maker_position: from_maker_point_ = true; [[fallthrough]];
    case MUse::machine_position:
      out_.motion.frame = ir::FrameUse::machine;
      out_.motion.frame_pos = w.pos;
      return;
    case MUse::call_once: call_ = CycleCall::once; return;
    case MUse::call_modal: call_ = CycleCall::modal; return;
    case MUse::per_rev: return feed_mode(ir::FeedMode::per_rev);
    case MUse::per_minute: return feed_mode(ir::FeedMode::per_minute);
    case MUse::contact_feed:
    case MUse::centre_feed:
      act(w, ir::ModalSet{ir::Setting::feed_point,
                          static_cast<std::uint8_t>(row.use == MUse::contact_feed ? ir::FeedPoint::contact
                                                                                  : ir::FeedPoint::centre)});
      return;
    case MUse::retract: return;
    case MUse::untilted: untilted_ = true; return;
    case MUse::plunge_feed: plunge_ = plunge_share(std::nullopt); return;  // it stands behind it
    case MUse::shortest:
      shortest_ = true;
      sets(AlongText::shortest);
      return;
    case MUse::kept:
      if (code == 127) shortest_ = false, sets(AlongText::shortest);
      if (code == 129 || code == 115) act(w, ir::SurfaceSet{ir::Surface::none, {}});
      if (code != 127 && code != 129 && code != 115) {
        report_.note("HEI-021", w.pos, name + " does not change the programmed path; it is left out");
      }
      return;
    case MUse::rotary_feed:
      return report_.warn("HEI-021", w.pos,
                          name +
                              ": F of a rotary axis counts in mm/min where the tool stands, in degrees elsewhere; it "
                              "is left out, the path is the same",
                          "check the feed of the rotary moves up to M117");
    case MUse::compensated:
      return report_.warn("HEI-009", w.pos,
                          name + " acts on what the control makes of the programmed path; it is left out");
    case MUse::frames_off:
      for (const auto slot :
           {ir::FrameSlot::shift, ir::FrameSlot::mirror, ir::FrameSlot::rotation, ir::FrameSlot::scale}) {
        ir::FrameChange c;
        c.slot = slot;
        c.combine = ir::FrameCombine::clear;
        if (slot == ir::FrameSlot::mirror) c.kind = ir::FrameKind::mirror;
        if (slot == ir::FrameSlot::rotation) c.kind = ir::FrameKind::rotate;
        if (slot == ir::FrameSlot::scale) c.kind = ir::FrameKind::scale;
        put_action(ir::FrameOp{std::make_shared<const ir::FrameChange>(std::move(c))});
      }
      return;
    case MUse::tip:
      report_.warn("HEI-009", w.pos,
                   name + ": positions are those of the tool's tip; the machine moves the other axes along");
      act(w, ir::OpaqueWord{slice(w)});
      act(w, ir::SurfaceSet{ir::Surface::tool, {}});
      return;
    case MUse::path:
      return report_.keep("HEI-009", w.pos, name + " changes the path in a way that is not carried", "block.word");
  }
  machine_code(w, row, static_cast<std::int32_t>(code));
}

/// What the machine does at the code.
void Lowering::machine_code(const Word& w, const dialects::heidenhain::MRow& row, std::int32_t code) {
  using facts::MUse;
  using machine::MMeaning;
  const auto put_action = [&](ir::ActionData data) { act(w, std::move(data), row.order); };
  const std::string name = "`" + std::string(slice(w)) + "` (" + std::string(row.title) + ")";
  switch (row.meaning) {
    case MMeaning::stop:
      put_action(ir::SpindleRun{1, ir::SpindleState::off});
      put_action(ir::Coolant{ir::CoolantState::off});
      return put_action(ir::Stop{false});
    case MMeaning::optional_stop: return put_action(ir::Stop{true});
    case MMeaning::program_end:
    case MMeaning::subprogram_end: end_text_ = slice(w); return;
    case MMeaning::spindle_cw:
    case MMeaning::spindle_ccw:
      put_action(ir::SpindleRun{1, row.meaning == MMeaning::spindle_cw ? ir::SpindleState::cw : ir::SpindleState::ccw});
      if (row.use == MUse::coolant_too) put_action(ir::Coolant{ir::CoolantState::flood});
      return;
    case MMeaning::spindle_stop: return put_action(ir::SpindleRun{1, ir::SpindleState::off});
    case MMeaning::spindle_orient:
      if (!orient_) report_.warn("HEI-009", w.pos, name + ": no cycle 13 says the angle; it is read as 0");
      return put_action(ir::SpindleOrient{1, orient_.value_or(ir::Value(0))});
    case MMeaning::tool_change:
      return report_.note("HEI-021", w.pos, name + ": TOOL CALL changes the tool; nothing is left to do");
    case MMeaning::coolant_off: return put_action(ir::Coolant{ir::CoolantState::off});
    case MMeaning::coolant_flood: return put_action(ir::Coolant{ir::CoolantState::flood});
    case MMeaning::coolant_mist: return put_action(ir::Coolant{ir::CoolantState::mist});
    case MMeaning::coolant_second: return put_action(ir::Coolant{ir::CoolantState::second});
    case MMeaning::gear:
    case MMeaning::none: return;
    case MMeaning::machine_function: break;
  }
  ir::MachineFunction f;
  f.code = code;
  put_action(std::move(f));
}

}  // namespace cnctrans::frontends::heidenhain
