// Words of one axis or spindle named by an index: POS[X]=, POSA[X]=, FA[X]=, AX[..]=, IP[..]=, SPOS[2]=, S[2]=, G[8]=
// (reference 1.2.1, 1.2.2; motion reference 2.2, 2.4).
#include <algorithm>
#include <utility>

#include "base/saturate.h"
#include "frontends/sinumerik/state/statements.h"
#include "frontends/sinumerik/statements/row_parts.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

namespace {

/// Mode and direction that a position attribute gives; false when it does not belong to a position.
bool apply_attribute(Attribute attribute, ir::CoordWord& w) {
  switch (attribute) {
    case Attribute::none: return true;
    case Attribute::ac: w.mode = ir::WordMode::absolute; return true;
    case Attribute::ic: w.mode = ir::WordMode::incremental; return true;
    case Attribute::dc: w.direction = ir::RotaryDirection::shortest; break;
    case Attribute::acp: w.direction = ir::RotaryDirection::positive; break;
    case Attribute::acn: w.direction = ir::RotaryDirection::negative; break;
    case Attribute::dac:
    case Attribute::dic:
      w.scale = ir::WordScale::diameter;
      w.mode = attribute == Attribute::dac ? ir::WordMode::absolute : ir::WordMode::incremental;
      return true;
    case Attribute::rac:
    case Attribute::ric:
      w.scale = ir::WordScale::radius;
      w.mode = attribute == Attribute::rac ? ir::WordMode::absolute : ir::WordMode::incremental;
      return true;
    case Attribute::unsupported: return false;
  }
  w.mode = ir::WordMode::absolute;
  return true;
}

}  // namespace

/// `G[8]=ZO`: the settable offset may be computed; of the other groups the code must be known.
bool StatementLowering::indirect_g(const syntax::Statement& s, Parts& parts) {
  const Expr& group = s.args[0].args[0];
  const Expr& value = s.args[1];
  if (group.kind != ExprKind::number)
    return refuse("language.statement", s.pos, "a G group chosen by a variable is not carried yet");
  if (value.kind == ExprKind::number) {
    const GFunction* g = g_function(saturate<std::int32_t>(group.number), saturate<std::int32_t>(value.number));
    if (g == nullptr) {
      c_.error("SIN-002", s.pos, "there is no such G function in this group");
      return false;
    }
    parts.indirect.emplace_back(g, s.pos);
    return true;
  }
  constexpr double offsets = 8;
  if (group.number != offsets) return chosen_g(s, parts);
  auto index = exprs_.lower_as(value, ir::Type::integer);
  if (!index) return false;
  ir::Action a;  // 1 is G500, 2 is G54
  a.data = ir::WorkOffset{ir::Value(ir::binary(ir::BinaryOp::subtract, std::move(index), ir::number(1))), false};
  a.pos = s.pos;
  a.text = c_.slice(s.pos);
  parts.actions.push_back(std::move(a));
  return true;
}

/// `G[6]=R10`: a branch for each code of the group, as far as all of them are settings.
bool StatementLowering::chosen_g(const syntax::Statement& s, Parts& parts) {
  const auto group = saturate<std::int32_t>(s.args[0].args[0].number);
  const auto index = exprs_.lower_as(s.args[1], ir::Type::integer);
  if (!index) return false;
  std::vector<const GFunction*> codes;
  for (const GFunction& g : g_functions()) {
    if (g.group != group || g.index == 0) continue;
    if (g.use != GUse::setting && g.use != GUse::timing && g.use != GUse::compensation)
      return refuse("language.statement", s.pos, "a G function of this group chosen by a variable is not carried yet");
    if (g.use == GUse::setting) codes.push_back(&g);
  }
  if (codes.empty()) {
    c_.error("SIN-002", s.pos, "there is no such G function in this group");
    return false;
  }
  ir::Body rest;
  for (auto g = codes.rbegin(); g != codes.rend(); ++g) {
    ir::Action a;
    a.data = ir::ModalSet{static_cast<ir::Setting>((*g)->a), (*g)->b, true, ir::FeedMemory::shared};
    ir::Block block;
    a.text = (*g)->name;
    block.actions.push_back(std::move(a));
    ir::Statement then;
    then.line.span = c_.line;
    then.node = std::move(block);
    ir::If node;
    node.condition = is_number(index, (*g)->index, s.pos);
    node.then_body.push_back(std::move(then));
    node.has_else = !rest.empty();
    node.else_body = std::move(rest);
    node.else_line.span = node.end_line.span = c_.line;
    ir::Statement branch;
    branch.line.span = c_.line;
    branch.node = std::move(node);
    rest.clear();
    rest.push_back(std::move(branch));
  }
  parts.calls.push_back(std::move(rest.front().node));
  return true;
}

/// TRANSMIT, TRACYL(40), TRAFOOF: work with the C axis. TRAORI and the others: the programmed positions stay those of
/// the tool in the coordinates of the transformation; no other control gets them. Every frame in force is deselected
/// (motion reference 9.1).
bool StatementLowering::transformation(const std::string& name, const std::vector<Expr>& args, WordPos pos,
                                       Parts& parts) {
  const auto add = [&](ir::ActionData data) { parts.act(std::move(data), pos, c_.slice(pos)); };
  auto clear = std::make_shared<ir::FrameChange>();
  clear->slot = ir::FrameSlot::chain;
  clear->combine = ir::FrameCombine::clear;
  ir::SurfaceSet surface;
  if (name == "TRANSMIT" || name == "TRACYL") {
    const bool face = name == "TRANSMIT";
    surface.surface = face ? ir::Surface::face : ir::Surface::cylinder;
    if (!face && (args.empty() || args[0].kind == ExprKind::missing)) {
      c_.error("SIN-012", pos, "TRACYL() needs the diameter of the cylinder");
      return false;
    }
    if (!face) {
      auto diameter = exprs_.lower_as(args[0], ir::Type::real);
      if (!diameter) return false;
      const auto number = ir::constant_value(diameter);
      surface.diameter = number ? ir::Value(*number) : ir::Value(std::move(diameter));
    }
    auto& y = c_.machine.axis_of['Y' - 'A'];  // a coordinate from here on, also where the machine has no such axis
    if (y == ir::axis::none) y = ir::axis::y;
    add(std::move(surface));
  } else if (name == "TRAFOOF") {
    add(std::move(surface));
  } else {
    add(ir::OpaqueWord{c_.slice(pos)});
    surface.surface = ir::Surface::tool;
    add(std::move(surface));
  }
  add(ir::FrameOp{std::move(clear)});
  add(ir::WorkOffset{ir::Value(0), true});
  c_.inclined.reset();
  if (name == "TRAANG" && !args.empty() && args[0].kind != ExprKind::missing) {
    const auto angle = exprs_.lower_as(args[0], ir::Type::real);
    if (!angle) return false;
    c_.inclined = ir::constant_value(angle);
  }
  c_.tool.transformation(name != "TRAFOOF");
  if (name != "TRAORI" && name != "TRAFOOF") c_.tool.state = ToolDirection::State::unsure;
  c_.framed = c_.tool_frame = false;
  c_.warning("SIN-041", pos,
             name +
                 " switches a transformation: positions are those of the tool in its coordinates, and the frames in "
                 "force, settable and programmable, are deselected",
             name == "TRANSMIT"
                 ? "select the work offset and the frame again behind it; X on the face is a radius: write DIAMOF"
                 : "select the work offset and the frame again behind it");
  return true;
}

/// PRESETON(X,100,Z,0): the machine position of the standing axis gets this value. Moves keep their machine positions
/// in the trace; what is programmed counts from the new value.
bool StatementLowering::preset(const std::string& name, const std::vector<Expr>& args, WordPos pos, Parts& parts) {
  if (args.empty() || args.size() % 2 != 0) {
    c_.error("SIN-012", pos, name + "() takes pairs of an axis and a value");
    return false;
  }
  auto change = std::make_shared<ir::FrameChange>();
  change->slot = ir::FrameSlot::preset;
  change->combine = ir::FrameCombine::replace_named;
  for (std::size_t i = 0; i < args.size(); i += 2) {
    Expr machine_axis = args[i];
    const std::string& own = machine_axis.text;  // A1: the machine axis of A
    if (machine_axis.kind == ExprKind::name && own.size() == 2 && own[1] == '1' && c_.symbol(own) == nullptr &&
        c_.machine.axis(own) == ir::axis::none)
      machine_axis.text.resize(1);
    const auto axis = exprs_.is_undefined(machine_axis) ? nullptr : exprs_.axis_operand(machine_axis);
    const auto* literal = axis ? std::get_if<ir::AxisName>(&axis->node) : nullptr;
    if (literal == nullptr)
      return refuse("language.statement", args[i].pos,
                    name + "() of an axis that the machine " + c_.machine.profile->name + " does not have");
    auto value = exprs_.lower_as(args[i + 1], ir::Type::real);
    if (!value) return false;
    ir::SystemRef here;
    here.datum = ir::Datum::machine_position;
    here.axis = literal->axis;
    here.text = "$AA_IM";
    auto shift = ir::binary(ir::BinaryOp::subtract, make_expr(std::move(here), ir::Type::real, pos), std::move(value));
    change->words.push_back(
        ir::FrameWord{literal->axis, ir::Value(std::move(shift)), ir::WordScale::radius, args[i].pos});
  }
  ir::Action a;
  a.data = ir::FrameOp{std::move(change)};
  a.pos = pos;
  a.text = c_.slice(pos);
  parts.actions.push_back(std::move(a));
  return true;
}

/// SETMS(n), SETMS: the spindle that S, M3 and their like mean from here on.
bool StatementLowering::master_spindle(const std::vector<Expr>& args, WordPos pos, Parts& parts) {
  const bool plain = args.empty() || (args.size() == 1 && args[0].kind == ExprKind::number && args[0].number >= 1 &&
                                      args[0].number <= 31);
  if (!plain) return refuse("language.statement", pos, "SETMS() of a computed spindle is not carried yet");
  const auto chosen = args.empty() ? std::uint8_t{1} : static_cast<std::uint8_t>(args[0].number);
  if (c_.skippable && chosen != c_.master_spindle)
    return refuse("language.statement", pos, "SETMS in a block that can be left out is not carried yet");
  c_.master_spindle = chosen;
  c_.warning("SIN-026", pos,
             "the master spindle holds for the words that follow in this program; called programs are read with "
             "spindle 1",
             "write SETMS in the called program too, or the numbers of the spindles (S2=, M2=3)");
  ir::Action a;
  a.data = ir::MasterSpindle{c_.master_spindle};
  a.pos = pos;
  a.text = c_.slice(pos);
  parts.actions.push_back(std::move(a));
  return true;
}

/// DIAMONA[X], DIAMOFA[X], DIAM90A[X], SCC[X]: settings of one axis.
bool StatementLowering::axis_setting(const std::string& name, const std::vector<Expr>& args, WordPos pos,
                                     Parts& parts) {
  const auto axis = args.size() == 1 ? exprs_.axis_operand(args[0]) : nullptr;
  const auto* literal = axis ? std::get_if<ir::AxisName>(&axis->node) : nullptr;
  const auto* spec = literal != nullptr ? c_.machine.profile->axis(literal->axis) : nullptr;
  if (spec == nullptr) return refuse("language.statement", pos, name + " is carried for one axis of the machine only");
  ir::Action a;
  a.pos = pos;
  a.text = c_.slice(pos);
  const bool transverse = literal->axis == ir::axis::x;
  if (name == "SCC") {
    if (!transverse)
      return refuse("language.statement", pos, "constant cutting speed about another axis than X is not carried yet");
    a.data = ir::OpaqueWord{a.text};
    a.order = ir::Order::with;
    c_.note("SIN-009", pos, "SCC is kept as text: X is the axis of the cutting speed already");
  } else if (spec->diameter) {
    const auto mode = name == "DIAMONA"   ? ir::DiameterMode::diameter
                      : name == "DIAM90A" ? ir::DiameterMode::absolute_only
                                          : ir::DiameterMode::radius;
    a.data = ir::ModalSet{ir::Setting::diameter, static_cast<std::uint8_t>(mode), true, ir::FeedMemory::shared};
  } else {
    return refuse("language.statement", pos, "the axis " + spec->name + " has no diameter programming on this machine");
  }
  parts.actions.push_back(std::move(a));
  return true;
}

/// MEASA[X]=(1,1,-1): mode, then the edges of the probe. All axes of the block are measured where the move ends: no
/// probe is modelled (motion reference 6.2).
bool StatementLowering::probe_item(const syntax::Statement& s, Parts& parts) {
  const Expr& job = s.args[1];
  const bool list = job.kind == ExprKind::call && job.text.empty() && !job.args.empty();
  const Expr& mode = list ? job.args[0] : job;
  const bool cancels = mode.kind == ExprKind::number && mode.number == 0;
  if (cancels) {
    put_beside("beside.realtime", s.pos, parts);
    return true;
  }
  if (!list || job.args.size() < 2 || job.args.size() > 5 || mode.kind != ExprKind::number) {
    c_.error("SIN-012", s.pos, s.args[0].text + "[] takes a mode and one to four edges of the probe");
    return false;
  }
  if (!exprs_.axis_operand(s.args[0].args[0])) return false;
  parts.probe_edge = &job.args[1];
  parts.probe_goes_on = s.args[0].text == "MEAWA";
  parts.act(ir::OpaqueWord{c_.slice(s.pos)}, s.pos, c_.slice(s.pos)).order = ir::Order::before;
  return true;
}

bool StatementLowering::spindle_item(const syntax::Statement& s, Parts& parts) {
  const Expr& target = s.args[0];
  if (target.args.size() != 1 || target.args[0].kind != ExprKind::number || target.args[0].number < 0 ||
      target.args[0].number > 31) {
    return refuse("language.statement", s.pos,
                  target.text + "[...]: the number of the spindle must be written as a number here");
  }
  Attribute attribute = Attribute::none;
  const std::uint32_t before = c_.errors;
  ir::Value v = exprs_.value_of(s.args[1], attribute);
  if (c_.errors != before) return false;
  const auto number = static_cast<std::uint8_t>(target.args[0].number);
  ir::Action a;
  a.pos = s.pos;
  a.text = c_.slice(s.pos);
  if (c_.slice(target.args[0].pos) != target.args[0].text)  // a variable that a branch has chosen
    a.text = c_.program.keep(target.text + '[' + target.args[0].text + "]=" + std::string(c_.slice(s.args[1].pos)));
  if (target.text == "LIMS") {
    if (number == c_.master_spindle) v = c_.lower_limit(c_.css_limit, c_.speed_limit, v, s.pos);
    a.data = ir::SpindleLimit{number, std::move(v), false};
  } else if (target.text == "S") {
    a.data = ir::SetSpindle{number, std::move(v)};
  } else {
    a.data = ir::SpindleOrient{number, std::move(v), attribute == Attribute::ic};
  }
  parts.actions.push_back(std::move(a));
  return true;
}

/// POS[SPI(2)]=90: the spindle is positioned as SPOS[2]=90 does it (9.6); FA[SPI(2)] says how fast.
bool StatementLowering::spindle_axis(const syntax::Statement& s, Parts& parts) {
  syntax::Statement own = s;
  Expr& target = own.args[0];
  if (target.text == "FA") {
    parts.act(ir::OpaqueWord{c_.slice(s.pos)}, s.pos, c_.slice(s.pos)).order = ir::Order::with;
    c_.note("SIN-009", s.pos, "FA[SPI()] is kept as text: it says how fast the spindle is positioned");
    return true;
  }
  if (target.text == "IP") return refuse("block.word", s.pos, "IP[] of a spindle is not carried");
  target.text = target.text == "POSA" ? "SPOSA" : "SPOS";
  const Expr number = target.args[0].args[0];
  target.args[0] = number;
  if (!spindle_item(own, parts)) return false;
  parts.actions.back().text = c_.slice(s.pos);
  return true;
}

bool StatementLowering::axis_item(const syntax::Statement& s, Parts& parts) {
  const Expr& target = s.args[0];
  if (target.args.size() != 1) {
    c_.error("SIN-012", s.pos, target.text + "[] takes one axis");
    return false;
  }
  const Expr& index = target.args[0];
  const std::uint32_t before = c_.errors;
  const std::string& word = target.text;
  if (index.kind == ExprKind::call && index.text == "SPI" && index.args.size() == 1) return spindle_axis(s, parts);
  if (exprs_.is_undefined(index))
    return refuse("machine.axis", s.pos,
                  word + "[" + std::string(c_.slice(index.pos)) + "]: this axis is not one of the machine " +
                      c_.machine.profile->name);
  const ir::ExprPtr axis = exprs_.axis_operand(index);
  if (!axis) return false;
  const auto* literal = std::get_if<ir::AxisName>(&axis->node);
  if (word == "FA") {
    if (literal == nullptr) return refuse("block.word", s.pos, "FA[] of an axis in a variable is not carried yet");
    ir::Assign::Item item;
    item.pos = s.pos;
    item.to_system = true;
    item.system.text = word;
    item.system.datum = ir::Datum::axis_feed;
    item.system.axis = literal->axis;
    item.value = exprs_.lower_as(s.args[1], ir::Type::real);
    if (!item.value) return false;
    parts.assign.items.push_back(std::move(item));
    return true;
  }
  Attribute attribute = Attribute::none;
  ir::Value value = exprs_.value_of(s.args[1], attribute);
  if (attribute == Attribute::unsupported) feature_ = "machine.index_positions";
  if (c_.errors != before) return false;
  if (literal != nullptr) exprs_.of_axis(value, literal->axis, attribute);
  ir::CoordWord coord;
  if (!apply_attribute(attribute, coord))
    return refuse("machine.index_positions", s.pos, "this way to give a position is not carried yet");
  coord.value = std::move(value);
  coord.pos = s.pos;
  if (word == "IP") {
    if (literal == nullptr || literal->axis > ir::axis::z)
      return refuse("block.word", s.pos, "IP[] of an axis in a variable is not carried yet");
    ir::CenterWord centre;
    centre.axis = literal->axis;
    centre.mode = attribute == Attribute::ac ? ir::CenterMode::absolute : ir::CenterMode::from_start;
    if (attribute == Attribute::ac) centre.scale = ir::WordScale::modal;
    centre.value = std::move(coord.value);
    centre.pos = s.pos;
    parts.centers.push_back(std::move(centre));
    return true;
  }
  if (word == "POS") coord.positioning = ir::Positioning::alone;
  if (word == "POSA") {
    coord.positioning = ir::Positioning::alone_not_awaited;
    c_.note("SIN-025", s.pos, "POSA: the axis moves beside the blocks that follow; its move is shown here");
  }
  if (literal != nullptr) {
    coord.axis = literal->axis;
    parts.coords.push_back(std::move(coord));
    return true;
  }
  if (word != "AX" || coord.scale != ir::WordScale::modal || coord.direction != ir::RotaryDirection::as_value)
    return refuse("block.word", s.pos, word + "[] of an axis in a variable is not carried this way yet");
  parts.computed.push_back(ir::ComputedWord{axis, coord.mode, std::move(coord.value), s.pos});
  return true;
}

/// The words of single axes join the motion of the block.
bool StatementLowering::put_axis_words(Parts& parts, ir::Block& words) {
  if (parts.probe_edge != nullptr) {
    Attribute none = Attribute::none;
    const std::uint32_t before = c_.errors;
    ir::MotionExtra extra;
    if (words.motion.extra) extra = *words.motion.extra;
    extra.has_probe_edge = true;
    extra.probe_edge = exprs_.value_of(*parts.probe_edge, none);
    extra.probe_goes_on = parts.probe_goes_on;
    words.motion.extra = std::make_shared<const ir::MotionExtra>(std::move(extra));
    if (c_.errors != before) return false;
  }
  if (parts.coords.empty() && parts.computed.empty() && parts.centers.empty() && parts.polynomials.empty()) return true;
  for (const auto& a : words.actions) {
    if (!std::holds_alternative<ir::FrameOp>(a.data) && !std::holds_alternative<ir::PoleSet>(a.data) &&
        !std::holds_alternative<ir::Dwell>(a.data))
      continue;
    return refuse("block.word", a.pos, "axes named by an index can't stand in this block");
  }
  ir::Motion& m = words.motion;
  for (auto& c : parts.coords) {
    for (const auto& other : m.coords) {
      if (other.axis != c.axis) continue;
      c_.error("SIN-005", c.pos, "this axis is written twice in this block");
      return false;
    }
    m.coords.push_back(std::move(c));
  }
  for (auto& c : parts.centers) m.centers.push_back(std::move(c));
  if (!parts.computed.empty() || !parts.polynomials.empty()) {
    ir::MotionExtra extra;
    if (m.extra) extra = *m.extra;
    for (auto& p : parts.polynomials) extra.polynomials.push_back(std::move(p));
    for (auto& c : parts.computed) extra.computed.push_back(std::move(c));
    m.extra = std::make_shared<const ir::MotionExtra>(std::move(extra));
  }
  const auto alone = [](const ir::CoordWord& c) { return c.positioning != ir::Positioning::with_path; };
  const auto by_itself = std::find_if(m.coords.begin(), m.coords.end(), alone);
  if (by_itself != m.coords.end() && !std::all_of(m.coords.begin(), m.coords.end(), alone)) {
    c_.warning(
        "SIN-106", by_itself->pos,
        "this axis moves by itself beside the axes of the path, at its own feed: the run shows one straight move of "
        "all of them, at the feed of the path",
        "write it in a block of its own");
  }
  words.has_motion = true;
  return true;
}

}  // namespace cnctrans::sinumerik
