// Planes of drilling and milling cycles, words of milling cycles (reference-language 18.1, 18.3).
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "base/saturate.h"
#include "frontends/sinumerik/cycles/cycle_arguments.h"
#include "ir/cycles/milling/milling.h"

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
    const ir::Value dp = a.get("DP");
    const bool same = rtp.number == rfp.number;
    if (rtp.number < rfp.number || (same && !a.says("DPR") && dp.literal() && dp.number > rfp.number)) down = 1;
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

void check_planes(const ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  const bool numbers = hole.retract.value.literal() && hole.surface.value.literal() && hole.bottom.value.literal();
  if (!numbers) return;
  const double rtp = hole.retract.value.number, rfp = hole.surface.value.number;
  const bool relative = hole.bottom.base == ir::LevelBase::from_surface;
  const double depth = hole.bottom.value.number + (relative ? rfp : 0);
  if (relative && rtp == rfp)
    c.warning("SIN-070", pos,
              "retract plane and reference plane are the same, and the depth is relative: the control stops here "
              "(alarm 61101)");
  else if (std::fabs(rtp - depth) < std::fabs(rfp - depth))
    c.warning("SIN-070", pos,
              "the retract plane lies nearer to the depth than the reference plane: the control stops here (alarm "
              "61101)");
  else if ((rtp - rfp) * (depth - rfp) > 0)
    c.warning("SIN-071", pos,
              "the depth lies on the side of the reference plane to which the tool retracts: it works toward the "
              "retract plane");
}

ir::Level depth_by_amount(const Arguments& a) {
  const ir::Value rtp = a.get("RTP"), rfp = a.get("RFP"), depth = absolute_value(a.get("DP"));
  const bool upward = rtp.literal() && rfp.literal() && rtp.number < rfp.number;
  return level(upward ? depth : ir::negate(depth), ir::LevelBase::from_surface);
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

/// A number made of digits; nullopt: it is none, or an expression.
std::optional<long> digits_of(const ir::Value& v) {
  if (!v.literal() || v.number < 0 || v.number > 999999 || v.number != std::floor(v.number)) return std::nullopt;
  return saturate<long>(v.number);
}
long digit(long number, int place) {
  for (; place > 0; --place) number /= 10;
  return number % 10;
}

/// Digits of `mode` from the units on are at most those of `most`; what lies beyond is 0.
bool within(const Arguments& a, std::string_view mode, std::string_view most, FileContext& c, WordPos pos) {
  const auto n = digits_of(a.get(mode));
  bool good = n.has_value();
  for (int place = 0; good && place < 6; ++place) {
    const long limit = static_cast<std::size_t>(place) < most.size() ? most[static_cast<std::size_t>(place)] - '0' : 0;
    good = digit(*n, place) <= limit;
  }
  if (!good) c.error("SIN-021", pos, "this value of " + std::string(mode) + " is not carried yet");
  return good;
}

void keep(std::string_view own, const ir::Value& v, ir::HoleCycle& hole) {
  hole.mill.words.emplace_back(std::string(ir::cycles::kept_word) + std::string(own), v);
}

/// The modes behind the newer signatures: the plane, the sense of the depth, the unit of the step; the others as far as
/// they change nothing.
bool modes(const MillingCycle& cycle, const Arguments& a, ir::HoleCycle& hole, FileContext& c, WordPos pos) {
  const bool step = std::any_of(cycle.parameters.begin(), cycle.parameters.end(),
                                [](const auto& p) { return p.first == step_parameter; });
  const bool chamfers = a.says("FS") || a.says("ZFS");  // the third digit of AMODE is that of ZFS
  if (a.says("UMODE") && !within(a, "UMODE", "", c, pos)) return false;
  if (a.says("GMODE") && !within(a, "GMODE", "00111", c, pos)) return false;
  if (a.says("DMODE") && !within(a, "DMODE", "399999", c, pos)) return false;
  if (a.says("AMODE") && !within(a, "AMODE", chamfers ? (step ? "211" : "201") : step ? "21" : "2", c, pos))
    return false;
  if (a.says("GMODE"))
    c.warning("SIN-021", pos,
              "this value of GMODE is taken as the whole machining, dimensioned from the middle of the shape");
  const auto mode = digits_of(a.get("AMODE")).value_or(0), plane = digits_of(a.get("DMODE")).value_or(0) % 10;
  hole.axis = plane == 0 ? ir::axis::none : c.machine.geometry.of(static_cast<std::size_t>(3 - plane));
  if (mode % 10 == 1 && hole.bottom.base == ir::LevelBase::absolute) hole.bottom = depth_by_amount(a);
  each_name(kept_milling_modes, [&](std::string_view own) {
    if (a.given(own)) keep(own, a.get(own), hole);
  });
  return true;
}

/// The word of the IR and its value. A step in hundredths of the tool's diameter is a factor.
std::pair<std::string_view, ir::Value> word_of(std::string_view own, std::string_view word, const Arguments& a) {
  const bool percent = own == step_parameter && digit(digits_of(a.get("AMODE")).value_or(0), 1) == 1;
  if (percent && a.says(own)) return {"step_factor", ir::scale(a.get(own), 0.01)};
  return {word, a.get(own)};
}

/// Thousands of VARI: the way from one slot to the next. A single slot has none, and the digit is only kept.
ir::Value single_slot(const Arguments& a) {
  const ir::Value v = a.get("VARI");
  const auto n = digits_of(v);
  return n && a.given("NUM") && a.get("NUM").is(1) && *n / 1000 == 1 ? ir::Value(static_cast<double>(*n % 1000)) : v;
}

/// What the variant says besides roughing and finishing is carried as far as the expansion has it.
bool variant(const MillingCycle& cycle, const ir::Value& v, FileContext& c, WordPos pos) {
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
  const ir::Value vari = single_slot(a);
  if (!good || !variant(cycle, vari, c, pos) || !modes(cycle, a, hole, c, pos)) return false;
  hole.kind = ir::HoleKind::mill;
  hole.mill.shape = std::string(cycle.shape);
  if (a.knows(mill_contour_parameter) && !milling_contour(cycle, a, hole, c, pos)) return false;
  for (const auto& [own, word] : cycle.parameters) {
    if (own.empty() || !a.given(own)) continue;
    auto [name, value] = word_of(own, word, a);
    hole.mill.words.emplace_back(std::string(name), own == "VARI" ? vari : value);
  }
  if (a.given("VARI") && !(vari.literal() && a.get("VARI").is(vari.number)) && vari.literal())
    keep("VARI", a.get("VARI"), hole);
  return true;
}

}  // namespace cnctrans::sinumerik
