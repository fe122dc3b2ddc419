// TOOL CALL and TOOL DEF (reference 4).
#include <cmath>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/heidenhain/limits.h"
#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;

/// What stands beside TOOL CALL; DL and DR become kept words. False: refused.
bool Lowering::tool_words(ToolWords& out) {
  const auto& words = block_->words;
  for (std::size_t i = 0; i < words.size(); ++i) {
    Word w = words[i];
    const auto is = [&](std::string_view a) { return iequals_ascii(w.address, a); };
    if (is("DR") && w.number_text == "2" && i + 1 < words.size() && words[i + 1].address.empty()) {
      const WordPos start = w.pos;  // `DR2 +0.1` is read as two words
      w = words[++i];
      w.address = "DR";
      w.pos = {start.column, w.pos.column + w.pos.length - start.column};
    }
    const ir::AxisId letter = w.has_value ? ir::axis::none : axis_of(w.address);
    if (w.address.empty() && out.number == nullptr) {
      out.number = &words[i];
    } else if (letter <= ir::axis::w) {
      out.axis = letter % 3;
    } else if (is("S") && w.has_value) {
      out.speed = &words[i];
    } else if (is("F") && w.has_value) {
      out.feed = &words[i];
    } else if (is("DL") || is("DR")) {
      if (w.has_value && !w.is_expression && w.number == 0) continue;
      out.oversized = out.oversized || is("DR");
      report_.warn("HEI-015", w.pos,
                   "`" + std::string(slice(w)) + "`: the oversize of the tool is kept as text; it is not in the path");
      act(w, ir::OpaqueWord{slice(w)}, ir::Order::with);
    } else if (w.has_value && (is("R") || is("L"))) {
      report_.warn("HEI-015", w.pos, "`" + std::string(slice(w)) + "` means nothing here; it is left out");
    } else {
      report_.refuse("HEI-002", w.pos, "`" + std::string(slice(w)) + "` means nothing beside TOOL CALL", {},
                     "block.word");
      return false;
    }
  }
  return true;
}

/// The tool, its axis (and with it the plane), its speed; F is the feed from here on, and that of FAUTO.
bool Lowering::tool_call(const syntax::Statement& s) {
  ToolWords said;
  if (!tool_words(said)) return false;
  const auto [number, speed, own_feed, axis, oversized] = said;
  if (number != nullptr || !s.args.empty()) {
    const auto known =
        number == nullptr || number->is_expression ? radii_.end() : radii_.find(saturate<std::int64_t>(number->number));
    radius_ = known == radii_.end() ? std::nullopt : std::optional(known->second);
    oversize_ = oversized;
  }
  Word at;
  at.pos = s.pos;
  std::vector<ir::Action> oversize = std::move(out_.actions);
  out_.actions.clear();
  const bool changes = number != nullptr || !s.args.empty();
  if (changes) {
    act(at, tool_of(number, s));
    act(at, ir::ToolChange{});
  }
  if (axis) {
    tool_called_ = true;
    tool_axis_ = *axis;
    act(at, ir::ModalSet{ir::Setting::plane, static_cast<std::uint8_t>(plane_of(tool_axis_))});
  }
  if (own_feed != nullptr) {
    tool_feed_ = value(*own_feed);
    act(*own_feed, ir::SetFeed{*tool_feed_});
  }
  for (auto& a : oversize) out_.actions.push_back(std::move(a));
  // The new speed is that of the new tool: other controls would change it first in one block.
  ir::Block after;
  if (speed != nullptr) {
    ir::Action set;
    speed_ = value(*speed);
    set.data = ir::SetSpindle{1, *speed_};
    set.pos = speed->pos;
    (changes ? after : out_).actions.push_back(std::move(set));
  }
  if (report_.refused()) return false;
  const int state = tool_state();
  if (!out_.empty() || after.empty()) put(std::move(out_)).tool = state;
  if (after.empty()) return true;
  Item& item = put(std::move(after));
  item.tool = state;
  item.statement.line.joined = false;
  return true;
}

/// Index of what holds behind the TOOL CALL at hand.
int Lowering::tool_state() {
  const auto same = [](const std::optional<ir::Value>& a, const std::optional<ir::Value>& b) {
    return a.has_value() == b.has_value() && (!a || ir::equal(*a, *b));
  };
  auto& all = flat_.tools;
  const auto it = std::find_if(all.begin(), all.end(), [&](const ToolState& t) {
    return same(t.feed, tool_feed_) && same(t.speed, speed_) && t.radius == radius_ && t.oversize == oversize_;
  });
  const auto index = static_cast<int>(it - all.begin());
  if (it == all.end()) all.push_back({tool_feed_, speed_, radius_, oversize_});
  return index;
}

/// By its number, or by the name that the sentence gives.
ir::ToolSelect Lowering::tool_of(const Word* number, const syntax::Statement& s) {
  ir::ToolSelect select;
  if (number == nullptr) {
    select.name = program_.keep(s.args[0].text);
    for (const auto& t : profile_.tools) {
      if (t.name == select.name) select.number = ir::Value(t.number);
    }
    return select;
  }
  select.number = value(*number);
  if (number->is_expression) return select;
  if (number->number < 0 || number->number > facts::tool_max) {
    report_.refuse("HEI-015", number->pos, "tool numbers go from 0 to 32767");
  } else if (number->number != std::floor(number->number)) {
    report_.warn("HEI-015", number->pos, "the index of the tool is left out; its number counts");
    select.number = ir::Value(std::floor(number->number));
  }
  return select;
}

/// The next tool is made ready; where the control has no tool table its length and radius stand here.
bool Lowering::tool_def(const syntax::Statement& s) {
  const Word* number = nullptr;
  bool defines = false;
  for (const Word& w : block_->words) {
    if (w.address.empty() && number == nullptr) number = &w;
    defines = defines || ((iequals_ascii(w.address, "L") || iequals_ascii(w.address, "R")) && w.has_value);
  }
  if (defines) {
    for (const Word& w : block_->words) {
      const bool known = number != nullptr && !number->is_expression && !w.is_expression;
      if (known && iequals_ascii(w.address, "R") && w.has_value && w.number > 0)
        radii_[saturate<std::int64_t>(number->number)] = w.number;
    }
    report_.note("HEI-015", s.pos,
                 "the tool's length and radius are kept as text: milling cycles go by the radius, else the tools are "
                 "those of the machine");
    ir::Opaque o;
    o.text = std::string(trim(text_));
    o.feature = "beside.data";
    o.harmless = true;
    put(std::move(o));
    return true;
  }
  if (number == nullptr && s.args.empty()) {
    report_.refuse("HEI-015", s.pos, "TOOL DEF has no tool");
    return false;
  }
  Word at;
  at.pos = s.pos;
  act(at, tool_of(number, s));
  if (report_.refused()) return false;
  put(std::move(out_));
  return true;
}

}  // namespace cnctrans::frontends::heidenhain
