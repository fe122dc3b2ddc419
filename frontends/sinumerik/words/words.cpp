// Word blocks: the dispatch by word. What closes a block (frames, poles, dwells, the motion) is in lower_finish.cpp.
#include "frontends/sinumerik/state/words.h"

#include <cmath>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/sinumerik/beside.h"

namespace cnctrans::sinumerik {

using syntax::Word;

namespace {

char capital(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
template <class Enum>
std::uint8_t u(Enum e) {
  return static_cast<std::uint8_t>(e);
}

}  // namespace

bool WordLowering::is_motion_block(const syntax::Block& block) {
  for (const Word& w : block.words) {
    if (w.address.size() > 1 && beside(w.address, w.has_value ? BesideForm::address : BesideForm::code) != nullptr)
      return false;
    if (w.address.size() > 5 && !w.has_value && (w.address[0] == 'R' || w.address[0] == 'r')) return false;  // REPOSL
    if ((w.address[0] == 'G' || w.address[0] == 'g') && (w.number == 751 || w.number == 291)) return false;
    switch (w.address[0]) {
      case 'L':
      case 'l':
      case 'P':
      case 'p':
      case 'R':
      case 'r':
      case 'N':
      case 'n':
      case 'O':
      case 'o': return false;
      default: break;
    }
  }
  return true;
}

void WordLowering::begin(ir::Block& out) {
  out.clear();
  out_ = &out;
  ranks_.clear();
  groups_ = 0;
  special_ = Special::none;
  special_g_ = nullptr;
  failed_ = false;
  sorted_ = true;
  decreasing_lead_ = false;
  tail_ = Tail::none;
  feature_ = {};
  if (has_extra_) extra_ = ir::MotionExtra{};
  vector_ = {};
  has_vector_ = other_orientation_ = false;
  has_extra_ = has_dwell_ = has_rpl_ = has_corner_feed_ = false;
  corner_ = -1;
}

void WordLowering::sort_actions() {
  if (sorted_) return;
  auto& actions = out_->actions;
  for (std::size_t i = 1; i < actions.size(); ++i) {
    for (std::size_t k = i; k > 0 && ranks_[k] < ranks_[k - 1]; --k) {
      std::swap(ranks_[k], ranks_[k - 1]);
      std::swap(actions[k], actions[k - 1]);
    }
  }
}

void WordLowering::refuse(std::string_view feature, WordPos pos, std::string message, std::string hint) {
  failed_ = true;
  feature_ = feature;
  c_.keep("SIN-008", pos, std::move(message), std::move(hint));
}

bool WordLowering::lower(const syntax::Block& block, ir::Block& out) {
  static const std::vector<std::pair<const GFunction*, WordPos>> none;
  return lower(block, none, out);
}

bool WordLowering::lower(const syntax::Block& block, const std::vector<std::pair<const GFunction*, WordPos>>& indirect,
                         ir::Block& out) {
  begin(out);
  const std::uint32_t before = c_.errors;
  g_words(block);
  for (const auto& [g, pos] : indirect) g_function(*g, pos);
  words(block);
  if (c_.errors != before && c_.only_kept()) return false;  // what else fits or not can't be told
  return finish() && !failed_ && c_.errors == before;
}

// --- G functions ------------------------------------------------------------------------------------------------

void WordLowering::g_words(const syntax::Block& block) {
  for (const Word& w : block.words) {
    if (w.address.size() != 1) {
      if (w.has_value) continue;
      if (const GFunction* g = sinumerik::g_function(w.address); g != nullptr) g_function(*g, w.pos);
      continue;
    }
    if (w.address[0] != 'G' && w.address[0] != 'g') continue;
    const GFunction* g = nullptr;
    const bool whole =
        w.has_value && !w.is_expression && !w.equals && w.extension < 0 && w.number == std::floor(w.number);
    if (whole && w.number >= 0 && w.number < 1000) g = sinumerik::g_function(saturate<std::int32_t>(w.number));
    if (g == nullptr) {
      failed_ = true;
      c_.error("SIN-002", w.pos, std::string(c_.slice(w.pos)) + " is no G function of this control");
      continue;
    }
    g_function(*g, w.pos);
  }
}

void WordLowering::g_function(const GFunction& g, WordPos pos) {
  const std::uint64_t bit = std::uint64_t{1} << g.group;
  if ((groups_ & bit) != 0) {
    failed_ = true;
    c_.error("SIN-005", pos,
             "two G functions of group " + std::to_string(g.group) + " stand in one block (alarm 12070)",
             "write them in two blocks");
  }
  groups_ |= bit;
  const auto special = [&](Special s) {
    if (special_ != Special::none) {
      failed_ = true;
      c_.error("SIN-005", pos, std::string(g.name) + " and " + std::string(special_g_->name) + " can't share a block");
    }
    special_ = s;
    special_g_ = &g;
    special_pos_ = pos;
  };
  ir::Motion& m = out_->motion;
  switch (g.use) {
    case GUse::motion:
      m.kind = static_cast<ir::MotionKind>(g.a);
      m.explicit_code = true;
      m.code_pos = pos;
      m.code_text = c_.slice(pos);
      decreasing_lead_ = g.b != 0;
      c_.motion = m.kind;
      break;
    case GUse::setting: setting(static_cast<ir::Setting>(g.a), g.b, pos); break;
    case GUse::units:
      c_.units_by_text = static_cast<ir::Units>(g.a);
      c_.words_in_inches = c_.units_by_text == ir::Units::inch && g.b == 0;
      c_.units_called = false;
      push(ir::ModalSet{ir::Setting::units, g.a, g.b != 0, ir::FeedMemory::shared}, Rank::setting, ir::Order::before,
           pos);
      break;
    case GUse::feed: feed_mode(g, pos); break;
    case GUse::path:
      push(ir::ModalSet{ir::Setting::path_mode, g.a, true, ir::FeedMemory::shared}, Rank::setting, ir::Order::before,
           pos);
      if (g.b != 0)
        c_.note("SIN-019", pos,
                std::string(g.name) + " is carried as continuous path: how much it rounds the corners is not");
      break;
    case GUse::dwell: special(Special::dwell); break;
    case GUse::exact_stop_block: push(ir::ExactStopBlock{}, Rank::setting, ir::Order::before, pos); break;
    case GUse::frame: special(Special::frame); break;
    case GUse::work_offset:
      push(ir::WorkOffset{ir::Value(static_cast<double>(g.a)), g.a == 0}, Rank::setting, ir::Order::before, pos);
      break;
    case GUse::suppress:
      m.frame = ir::FrameUse::machine_with_length;
      m.frame_pos = pos;
      break;
    case GUse::pole: special(Special::pole); break;
    case GUse::limit: special(Special::limit); break;
    case GUse::approach: special(Special::approach); break;
    case GUse::inclined: special(Special::inclined); break;
    case GUse::timing:
    case GUse::compensation:
      push(ir::OpaqueWord{c_.slice(pos)}, Rank::setting, ir::Order::with, pos);
      c_.note("SIN-009", pos, std::string(g.name) + " is kept as text: it does not change the programmed path");
      break;
    case GUse::joint:
      push(ir::OpaqueWord{c_.slice(pos)}, Rank::setting, ir::Order::before, pos);
      c_.warning("SIN-045", pos,
                 std::string(g.name) +
                     (g.number < 0 ? ": the axes of the machine move together to the programmed end; the way between "
                                     "the ends is shown as a straight line"
                                   : ": the soft approach or retraction depends on the tool's radius; the move is "
                                     "shown as a straight line to its programmed end"));
      break;
    case GUse::tool_frame: tool_frame(g, pos); break;
    case GUse::table_frame: table_frame(pos); break;
    case GUse::own_block:
    case GUse::unsupported: refuse(missing_feature(g), pos, std::string(g.name) + " is not carried yet"); break;
  }
}

void WordLowering::setting(ir::Setting which, std::uint8_t value, WordPos pos) {
  if (which == ir::Setting::plane) {
    const ir::Plane plane = c_.machine.geometry.plane(static_cast<ir::Plane>(value));
    if (plane != ir::Plane::xy) c_.other_plane = true;
    c_.plane = plane;
    value = u(plane);
  }
  if (which == ir::Setting::diameter) c_.diameter = static_cast<ir::DiameterMode>(value);
  if (which == ir::Setting::distance && value != 0) c_.increments = true;
  push(ir::ModalSet{which, value, true, ir::FeedMemory::shared}, Rank::setting, ir::Order::before, pos);
}

void WordLowering::feed_mode(const GFunction& g, WordPos pos) {
  c_.per_rev = static_cast<ir::FeedMode>(g.a) == ir::FeedMode::per_rev;
  const bool ends_css = g.b == 0 && c_.css.value_or(true);  // one group: G94 takes the place of G96
  if (g.b != 2) c_.css = false;
  if (g.b == 2) c_.css = c_.uses_css = true;
  if (ends_css) {
    push(ir::ModalSet{ir::Setting::spindle_mode, u(ir::SpindleMode::rpm), true, ir::FeedMemory::shared}, Rank::setting,
         ir::Order::before, pos, false);
  }
  if (g.b != 0) {
    const auto mode = g.b == 2 ? ir::SpindleMode::css : ir::SpindleMode::rpm;
    push(ir::ModalSet{ir::Setting::spindle_mode, u(mode), true, ir::FeedMemory::shared}, Rank::setting,
         ir::Order::before, pos);
  }
  // A change of the feed mode clears F; with G96 and G97 the mode is the word's second meaning and has no text of its
  // own.
  push(ir::ModalSet{ir::Setting::feed_mode, g.a, true, ir::FeedMemory::cleared}, Rank::setting, ir::Order::before, pos,
       g.b == 0);
}

// --- words ------------------------------------------------------------------------------------------------------

void WordLowering::words(const syntax::Block& block) {
  for (const Word& w : block.words) {
    if (w.address.size() != 1) {
      named(block, w);
      continue;
    }
    const char address = capital(w.address[0]);
    if (address == 'G') continue;
    if (!w.has_value) {
      failed_ = true;
      c_.error("SIN-004", w.pos, std::string(w.address) + " has no value");
      continue;
    }
    letter(block, w, address);
  }
  // SUPA G0 Z0 D0: with the offset switched off in the block the tool length does not count.
  auto& m = out_->motion;
  if (m.frame != ir::FrameUse::machine_with_length) return;
  for (const auto& a : out_->actions) {
    const auto* d = std::get_if<ir::ToolOffset>(&a.data);
    if (d != nullptr && d->number.is(0)) m.frame = ir::FrameUse::machine;
  }
}

void WordLowering::letter(const syntax::Block& block, const Word& w, char address) {
  if (address == 'M') return m_word(block, w);
  if (address == 'T') return t_word(block, w);
  if (const ir::AxisId named = c_.machine.axis(address);
      named != ir::axis::none && w.extension < 0 && polynomial(block, w, named))
    return;
  if (address == 'F' && w.is_expression && feed_polynomial(block.exprs[static_cast<std::size_t>(w.expr)], w)) return;
  Attribute attribute = Attribute::none;
  ir::Value value = exprs_.value(block, w, attribute);
  const bool centre_letter = address == 'I' || address == 'J' || address == 'K';
  const ir::AxisId axis =
      centre_letter ? c_.machine.geometry.of(static_cast<std::size_t>(address - 'I')) : c_.machine.axis(address);
  if (centre_letter) return center(axis, w, std::move(value), attribute);
  const bool vector = w.extension >= 2 && w.extension <= 8 && address >= 'A' && address <= 'C';
  if (vector && w.equals) return orientation(w);
  const bool machine_axis = special_ == Special::approach && w.extension == 1;  // G74 X1=0: the machine's own name
  if (axis != ir::axis::none && (w.extension < 0 || machine_axis))
    return coordinate(axis, w, std::move(value), attribute);
  if (attribute == Attribute::unsupported) {  // said already
    failed_ = true;
    return;
  }
  const bool function = address == 'F' || address == 'S' || address == 'D' || address == 'H';
  if (attribute != Attribute::none && function) {
    failed_ = true;
    c_.error("SIN-012", w.pos, "AC(), IC() and their like belong to axes and arc centres");
    return;
  }
  switch (address) {
    case 'F': return f_word(w, std::move(value));
    case 'S': return s_word(w, std::move(value));
    case 'D': return push(ir::ToolOffset{std::move(value)}, Rank::offset, ir::Order::before, w.pos);
    case 'H': {
      ir::MachineFunction h;
      h.auxiliary = true;
      h.extension = w.extension;
      h.value = std::move(value);
      return push(std::move(h), Rank::before, ir::Order::before, w.pos);
    }
    default: break;
  }
  failed_ = true;
  if (address == 'R' || address == 'N' || address == 'L' || address == 'P') {
    c_.error("SIN-003", w.pos, std::string(c_.slice(w.pos)) + " can't stand here",
             address == 'R' ? "an R parameter is set with `=`: R1=5" : "");
    return;
  }
  std::string name(1, address);
  if (w.extension >= 0) name += std::to_string(w.extension);
  feature_ = "machine.axis";
  c_.keep("SIN-003", w.pos, "the machine " + c_.machine.profile->name + " has no axis or function " + name,
          "choose the machine with --machine, or add the axis to its profile; the block is kept as text");
}

void WordLowering::coordinate(ir::AxisId axis, const Word& w, ir::Value value, Attribute attribute) {
  for (const auto& other : out_->motion.coords) {
    if (other.axis != axis) continue;
    failed_ = true;
    c_.error("SIN-005", w.pos, std::string(w.address) + " is written twice in this block");
  }
  if (c_.machine.rotary[axis]) c_.tool.turned_by_axis();
  auto& coord = out_->motion.coords.emplace_back();
  coord.axis = axis;
  exprs_.of_axis(value, axis, attribute);
  coord.value = std::move(value);
  coord.pos = w.pos;
  switch (attribute) {
    case Attribute::none:
    case Attribute::unsupported: break;
    case Attribute::dac:
      coord.scale = ir::WordScale::diameter;
      coord.mode = ir::WordMode::absolute;
      break;
    case Attribute::rac:
      coord.scale = ir::WordScale::radius;
      coord.mode = ir::WordMode::absolute;
      break;
    case Attribute::dic:
      coord.scale = ir::WordScale::diameter;
      coord.mode = ir::WordMode::incremental;
      break;
    case Attribute::ric:
      coord.scale = ir::WordScale::radius;
      coord.mode = ir::WordMode::incremental;
      break;
    case Attribute::ic: coord.mode = ir::WordMode::incremental; break;
    case Attribute::ac: coord.mode = ir::WordMode::absolute; break;
    case Attribute::dc:
      coord.mode = ir::WordMode::absolute;
      coord.direction = ir::RotaryDirection::shortest;
      break;
    case Attribute::acp:
      coord.mode = ir::WordMode::absolute;
      coord.direction = ir::RotaryDirection::positive;
      break;
    case Attribute::acn:
      coord.mode = ir::WordMode::absolute;
      coord.direction = ir::RotaryDirection::negative;
      break;
  }
}

void WordLowering::center(ir::AxisId axis, const Word& w, ir::Value value, Attribute attribute) {
  if (is_thread() && w.extension < 0) {
    auto& e = extra();
    e.has_lead = true;
    e.lead = std::move(value);
    e.lead_axis = axis;
    return;
  }
  if (w.extension > 1 || w.extension == 0) {
    failed_ = true;
    c_.error("SIN-003", w.pos, std::string(c_.slice(w.pos)) + " is no word of this control");
    return;
  }
  ir::CenterWord word;
  word.axis = axis;
  word.value = std::move(value);
  word.pos = w.pos;
  const bool through = w.extension == 1;
  if (through) {
    word.mode = ir::CenterMode::follows_distance;
    word.scale = ir::WordScale::modal;
  }
  if (attribute == Attribute::ac) {
    word.mode = ir::CenterMode::absolute;
    word.scale = ir::WordScale::modal;
  } else if (attribute == Attribute::ic) {
    word.mode = ir::CenterMode::from_start;
  } else if (attribute != Attribute::none) {
    failed_ = true;
    c_.error("SIN-012", w.pos, "an arc centre takes AC() or IC() only");
  }
  if (through) {
    extra().through.push_back(std::move(word));
  } else {
    out_->motion.centers.push_back(std::move(word));
  }
}

void WordLowering::f_word(const Word& w, ir::Value value) {
  if (special_ == Special::dwell) {
    has_dwell_ = true;
    dwell_.value = std::move(value);
    dwell_.revolutions = false;
    return;
  }
  if (motion_kind() == ir::MotionKind::thread_variable) {  // change of the lead per revolution; unsigned, G35 decreases
    extra().lead_change = decreasing_lead_ ? ir::negate(value) : std::move(value);
    return;
  }
  c_.words_of_tool = false;
  push(ir::SetFeed{std::move(value), false}, Rank::feed, ir::Order::before, w.pos);
}

/// F=FPO(end,quadratic,cubic): the feed goes to its end value within the block (motion reference 14.2).
bool WordLowering::feed_polynomial(const syntax::Expr& e, const Word& w) {
  if (e.kind != syntax::ExprKind::call || e.text != "FPO" || e.args.empty()) return false;
  Attribute attribute = Attribute::none;
  const std::uint32_t before = c_.errors;
  ir::Value end = exprs_.value_of(e.args[0], attribute);
  if (c_.errors != before) return true;
  push(ir::SetFeed{std::move(end), false}, Rank::feed, ir::Order::before, w.pos);
  c_.warning("SIN-051", w.pos, "the feed changes along this block; the whole of it is taken with the feed at its end");
  return true;
}

void WordLowering::s_word(const Word& w, ir::Value value) {
  const auto number = w.extension < 0 ? c_.master_spindle : static_cast<std::uint8_t>(w.extension);
  if (w.extension == 0 || w.extension > 31) {
    failed_ = true;
    c_.error("SIN-017", w.pos, "there is no spindle with this number");
    return;
  }
  if (special_ == Special::dwell) {
    has_dwell_ = true;
    dwell_.value = std::move(value);
    dwell_.revolutions = true;
    return;
  }
  if (special_ == Special::limit) {
    if (special_g_->a != 0 && number == c_.master_spindle)
      value = c_.lower_limit(c_.speed_limit, c_.css_limit, value, w.pos);
    return push(ir::SpindleLimit{number, std::move(value), special_g_->a == 0}, Rank::limit, ir::Order::before, w.pos);
  }
  push(ir::SetSpindle{number, std::move(value)}, Rank::speed, ir::Order::before, w.pos);
}

void WordLowering::t_word(const syntax::Block& block, const Word& w) {
  ir::ToolSelect tool;
  tool.changes = c_.machine.profile->policies.tool_change == machine::ToolChange::on_select;
  if (w.is_expression && block.exprs[static_cast<std::size_t>(w.expr)].kind == syntax::ExprKind::string) {
    const WordPos place = block.exprs[static_cast<std::size_t>(w.expr)].pos;
    tool.name = c_.slice(WordPos{place.column + 1, place.length - 2});
    for (const auto& t : c_.machine.profile->tools) {
      if (t.name == tool.name) tool.number = ir::Value(t.number);
    }
  } else {
    const syntax::Expr* name = w.is_expression ? &block.exprs[static_cast<std::size_t>(w.expr)] : nullptr;
    const Symbol* symbol = name != nullptr && name->kind == syntax::ExprKind::name ? c_.symbol(name->text) : nullptr;
    if (symbol != nullptr && symbol->type == ir::Type::string)
      return refuse("language.statement", w.pos, "a tool whose name is in a variable is not carried yet");
    Attribute attribute = Attribute::none;
    tool.number = exprs_.value(block, w, attribute);
  }
  if (w.extension > 1) {
    refuse("language.statement", w.pos, "a tool for spindle " + std::to_string(w.extension) + " is not carried yet");
    return;
  }
  push(std::move(tool), Rank::tool, ir::Order::before, w.pos);
}

}  // namespace cnctrans::sinumerik
