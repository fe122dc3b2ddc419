// Planes of drilling and milling cycles, words of milling cycles (reference-language 18.1, 18.3).
#include <cmath>
#include <string>

#include "base/saturate.h"
#include "base/text.h"
#include "frontends/sinumerik/cycle_arguments.h"

namespace cnctrans::sinumerik {

ir::Level level(ir::Value value, ir::LevelBase base) {
  ir::Level l;
  l.value = std::move(value);
  l.base = base;
  l.given = true;
  return l;
}

ir::Value absolute_value(const ir::Value& v) {
  if (!v.literal()) return v;
  return v.number < 0 ? ir::negate(v) : v;
}

/// Safety plane and depth. `down` is -1 when the retract plane lies above the reference plane, as it should.
void planes(const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  const ir::Value rtp = a.get("RTP");
  const ir::Value rfp = a.get("RFP");
  double down = -1;
  if (rtp.literal() && rfp.literal()) {
    if (rtp.number < rfp.number) down = 1;
    if (rtp.number == rfp.number)
      c.warning("SIN-021", pos, "retract plane and reference plane are the same (alarm 61101 with a relative depth)");
  } else {
    c.note("SIN-021", pos, "the retract plane is taken to lie above the reference plane");
  }
  hole.retract = level(rtp, ir::LevelBase::absolute);
  hole.surface = level(rfp, ir::LevelBase::absolute);
  const ir::Value distance = absolute_value(a.get("SDIS"));
  hole.reference = level(down < 0 ? distance : ir::negate(distance), ir::LevelBase::from_surface);
  if (a.says("DPR")) {
    if (a.says("DP"))
      c.warning("SIN-021", pos,
                "DP and DPR are both given: the depth is DPR below the reference plane, as on the control");
    const ir::Value depth = absolute_value(a.get("DPR"));
    hole.bottom = level(down < 0 ? ir::negate(depth) : depth, ir::LevelBase::from_surface);
  } else {
    hole.bottom = level(a.get("DP"), ir::LevelBase::absolute);
  }
  hole.approach_by_retract = false;
}

namespace {

template <class Each>
void each_name(std::string_view list, Each each) {
  while (!list.empty()) {
    const auto comma = std::min(list.find(','), list.size());
    each(list.substr(0, comma));
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
}

/// The modes behind the newer signatures: only those that mean the same as none, and the sense of the depth.
bool modes(const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  bool good = true;
  each_name(unread_milling_modes, [&](std::string_view mode) {
    if (!a.says(mode)) return;
    c.error("SIN-021", pos, "this value of " + std::string(mode) + " is not carried yet: 0 is");
    good = false;
  });
  if (!good || !a.says("AMODE")) return good;
  const ir::Value mode = a.get("AMODE");
  const int depth = mode.literal() ? saturate<int>(mode.number) % 10 : -1;
  if (depth < 0 || depth > 2 || mode.number >= 10) {
    c.error("SIN-021", pos, "this AMODE is not carried yet: 0, 1 and 2 are");
    return false;
  }
  if (depth == 1 && hole.bottom.base == ir::LevelBase::absolute)
    hole.bottom = level(ir::negate(absolute_value(a.get("DP"))), ir::LevelBase::from_surface);
  return true;
}

/// What the variant says besides roughing and finishing is carried as far as the expansion has it.
bool variant(const MillingCycle& cycle, const Arguments& a, FileContext& c, WordPos pos) {
  const ir::Value v = a.get("VARI");
  if (cycle.variants.empty() || !v.literal()) return true;
  const std::string text = std::to_string(saturate<int>(v.number));
  bool found = false;
  each_name(cycle.variants, [&](std::string_view one) { found = found || one == text; });
  if (found) return true;
  c.error("SIN-021", pos,
          "VARI of " + std::string(cycle.name) + " must be one of " + std::string(cycle.variants) + " (alarm 61002)");
  return false;
}

}  // namespace

bool milling_words(const MillingCycle& cycle, const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  bool good = true;
  each_name(cycle.needs, [&](std::string_view own) {
    if (a.given(own)) return;
    c.error("SIN-021", pos, std::string(cycle.name) + " needs its parameter " + std::string(own));
    good = false;
  });
  each_name(cycle.only_zero, [&](std::string_view own) {
    if (!a.says(own)) return;
    c.error("SIN-021", pos, std::string(cycle.name) + " with " + std::string(own) + " is not carried yet");
    good = false;
  });
  if (!good || !variant(cycle, a, c, pos) || !modes(a, hole, c, pos)) return false;
  hole.kind = ir::HoleKind::mill;
  hole.mill.shape = std::string(cycle.shape);
  if (a.given(mill_contour_parameter)) {
    const ir::Value name = a.get(mill_contour_parameter);
    const auto* text = name.expr ? std::get_if<ir::String>(&name.expr->node) : nullptr;
    if (text == nullptr || trim(text->text).empty()) {
      c.error("SIN-021", pos,
              "the contour of " + std::string(cycle.name) + " is a fixed name, or two labels with a colon");
      return false;
    }
    contour_words(std::string(trim(text->text)), hole.mill.words);
  }
  for (const auto& [own, word] : cycle.parameters) {
    if (!own.empty() && a.given(own)) hole.mill.words.emplace_back(std::string(word), a.get(own));
  }
  return true;
}

}  // namespace cnctrans::sinumerik
