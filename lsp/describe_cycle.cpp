#include "ir/cycles/milling/milling.h"
#include "lsp/describe.h"
#include "lsp/words/parameter_text.h"
#include "lsp/words/words.h"

namespace cnctrans::lsp {

namespace {

class CycleText {
 public:
  explicit CycleText(const DescribeContext& context) : context_(context) {
    using ir::Setting;
    const auto units = context.facts.settings[static_cast<std::size_t>(Setting::units)];
    const auto feed = context.facts.settings[static_cast<std::size_t>(Setting::feed_mode)];
    inch_ = units ? *units == static_cast<std::uint8_t>(ir::Units::inch) : context.program.unit_hint == ir::Units::inch;
    per_rev_ = feed && *feed == static_cast<std::uint8_t>(ir::FeedMode::per_rev);
  }

  std::vector<std::string> hole(const ir::HoleCycle& h) {
    const auto* shape = h.kind == ir::HoleKind::mill ? ir::cycles::find_mill_shape(h.mill.shape) : nullptr;
    out_.push_back("cycle: " + (shape != nullptr ? std::string(shape->title) : spoken(ir::name(h.kind))));
    level("surface", h.surface);
    level("reference plane", h.reference);
    level("bottom", h.bottom);
    level("retract plane", h.retract);
    pecks(h.pecks);
    number("dwell at the bottom", h.dwell_bottom, h.dwell_in_revolutions ? "revolutions" : "s", h.dwell_scale);
    number("dwell at the top", h.dwell_top, "s", h.dwell_scale);
    if (h.has_feed) number("feed into the hole", h.feed, unit(ParameterUnit::feed));
    if (h.has_feed_out) number("feed out of it", h.feed_out, unit(ParameterUnit::feed));
    number("pitch", h.pitch, unit(ParameterUnit::length));
    if (h.has_speed) number("speed", h.speed, "rev/min");
    number("spindle stops at", h.orient_angle, "°");
    number("frees itself by", h.shift_u, unit(ParameterUnit::length));
    if (h.rigid) out_.emplace_back("rigid: the spindle follows the axis");
    words(h.mill.words);
    return std::move(out_);
  }
  std::vector<std::string> named(const ir::NamedCycle& n) {
    out_.push_back("cycle: " + spoken(n.name));
    words(n.words);
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::string unit(ParameterUnit u) const { return std::string(unit_text(u, inch_, per_rev_)); }
  void number(std::string_view name, const ir::Value& v, std::string_view unit, double scale = 1) {
    if (v.is(0)) return;
    const std::string text = v.literal() ? value_text(ir::Value(v.number * scale), context_) : value_text(v, context_);
    out_.push_back(std::string(name) + ": " + text + (unit.empty() ? "" : " " + std::string(unit)));
  }
  void level(std::string_view name, const ir::Level& l) {
    if (!l.given) return;
    std::string from;
    switch (l.base) {
      case ir::LevelBase::absolute: break;
      case ir::LevelBase::from_initial: from = " from where the tool stands"; break;
      case ir::LevelBase::from_reference: from = " from the reference plane"; break;
      case ir::LevelBase::from_surface: from = " from the surface"; break;
      case ir::LevelBase::distance_mode: from = ", absolute or from the level before by G90 or G91"; break;
    }
    out_.push_back(std::string(name) + ": " + value_text(l.value, context_) + " " + unit(ParameterUnit::length) + from);
  }
  void pecks(const ir::Pecks& p) {
    if (p.law == ir::PeckLaw::none) return;
    number("first peck", p.first, unit(ParameterUnit::length));
    number("number of pecks", p.count, "");
    number("each peck smaller by", p.degression,
           p.law == ir::PeckLaw::geometric ? "(factor)" : unit(ParameterUnit::length));
    number("smallest peck", p.minimum, unit(ParameterUnit::length));
    number("lift between pecks", p.lift, unit(ParameterUnit::length));
    number("dwell after a peck", p.dwell, "s");
  }
  void words(const std::vector<std::pair<std::string, ir::Value>>& list) {
    for (const auto& [name, value] : list) {
      if (ir::cycles::is_kept_word(name)) continue;
      const std::string u = unit(unit_of(name));
      out_.push_back(parameter_meaning(name) + ": " + value_text(value, context_) + (u.empty() ? "" : " " + u));
    }
  }

  const DescribeContext& context_;
  std::vector<std::string> out_;
  bool inch_ = false, per_rev_ = false;
};

}  // namespace

std::vector<std::string> describe_cycle(const ir::Cycle& cycle, const DescribeContext& context) {
  CycleText text(context);
  if (const auto* h = std::get_if<ir::HoleCycle>(&cycle.node)) return text.hole(*h);
  return text.named(std::get<ir::NamedCycle>(cycle.node));
}

}  // namespace cnctrans::lsp
