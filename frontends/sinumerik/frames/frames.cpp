// Frames as values: CTRANS() and its like, chains, frame variables and their components (motion reference 7.2-7.5).
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/saturate.h"
#include "dialects/sinumerik/addresses.h"
#include "dialects/sinumerik/frames.h"
#include "dialects/sinumerik/variables.h"
#include "frontends/sinumerik/state/statements.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

namespace {

struct FrameFunction {
  std::string_view name;
  ir::Function function;
};
constexpr FrameFunction frame_functions[] = {
    {"CTRANS", ir::Function::frame_shift},     {"CFINE", ir::Function::frame_fine},
    {"CROT", ir::Function::frame_turn},        {"CROTS", ir::Function::frame_solid_turn},
    {"CSCALE", ir::Function::frame_stretch},   {"CMIRROR", ir::Function::frame_mirror},
    {"INVFRAME", ir::Function::frame_inverse},
};

struct ComponentRow {
  std::string_view name;
  ir::FramePart part;
};
constexpr ComponentRow components[] = {{"TR", ir::FramePart::shift},
                                       {"FI", ir::FramePart::fine},
                                       {"RT", ir::FramePart::turn},
                                       {"SC", ir::FramePart::scale},
                                       {"MI", ir::FramePart::mirror}};

struct SystemFrame {
  std::string_view name;
  ir::Datum datum;
  std::size_t indices;
};
constexpr SystemFrame system_frames[] = {{"$P_PFRAME", ir::Datum::frame_programmed, 0},
                                         {"$P_IFRAME", ir::Datum::frame_active, 0},
                                         {"$P_ACTFRAME", ir::Datum::frame_total, 0},
                                         {"$P_UIFR", ir::Datum::frame_settable, 1}};

ir::ExprPtr component_number(const Expr& e) {
  for (const auto& row : components) {
    if (row.name == e.text) return ir::number(static_cast<double>(row.part));
  }
  return nullptr;
}

}  // namespace

ir::ExprPtr ExprLowering::axis_operand(const Expr& e) {
  ir::ExprPtr axis = lower(e);
  if (!axis) return nullptr;
  if (axis->type == ir::Type::axis) return axis;
  if (const auto* datum = std::get_if<ir::SystemRef>(&axis->node);
      datum != nullptr && datum->datum == ir::Datum::other) {  // its type is not known
    c_.keep("SIN-006", e.pos, std::string(c_.slice(e.pos)) + " is not defined in this program; an axis is needed here");
    return nullptr;
  }
  c_.error("SIN-012", e.pos, "an axis is needed here");
  return nullptr;
}

std::optional<ExprLowering::FrameName> ExprLowering::frame_name(const Expr& e) {
  std::size_t indices = 0;
  FrameName out;
  if (!e.text.empty() && e.text[0] == '$') {
    if (const RowFrame* known = row_frame(e.text); known != nullptr) {
      indices = known->indexed ? 1 : 0;
      if (e.args.size() != indices && e.args.size() != indices + 2) return std::nullopt;
      std::int32_t n = 0;
      if (known->indexed) {
        const Expr& index = e.args[0];
        if (index.kind != ExprKind::number || index.number < 0 || index.number >= row_frames_each) {
          c_.keep("SIN-008", index.pos, "the number of a base frame must be written as a number, 0 to 7, here");
          return std::nullopt;
        }
        n = saturate<std::int32_t>(index.number);
      }
      ir::SystemRef ref;
      ref.text = e.text;
      ref.datum = ir::Datum::frame_settable;
      ref.args.push_back(ir::number(known->row + n));
      out.whole = make_expr(std::move(ref), ir::Type::frame, e.pos);
      return component(e, indices, std::move(out));
    }
    const SystemFrame* row = nullptr;
    for (const auto& f : system_frames) {
      if (f.name == e.text) row = &f;
    }
    if (row == nullptr || (e.args.size() != row->indices && e.args.size() != row->indices + 2)) return std::nullopt;
    indices = row->indices;
    ir::SystemRef ref;
    ref.text = e.text;
    ref.datum = row->datum;
    for (std::size_t i = 0; i < indices; ++i) {
      ref.args.push_back(lower_as(e.args[i], ir::Type::integer));
      if (!ref.args.back()) return std::nullopt;
    }
    out.whole = make_expr(std::move(ref), ir::Type::frame, e.pos);
  } else {
    const Symbol* symbol = c_.symbol(e.text);
    if (symbol == nullptr || symbol->type != ir::Type::frame) return std::nullopt;
    indices = symbol->dimensions;
    if (e.args.size() != indices && e.args.size() != indices + 2) return std::nullopt;
    ir::VarRef ref;
    ref.space = symbol->space;
    ref.name = e.text;
    for (std::size_t i = 0; i < indices; ++i) {
      ref.indices.push_back(lower_as(e.args[i], ir::Type::integer));
      if (!ref.indices.back()) return std::nullopt;
    }
    out.whole = make_expr(std::move(ref), ir::Type::frame, e.pos);
  }
  return component(e, indices, std::move(out));
}

/// With `[axis, component]` behind the indices of the frame.
std::optional<ExprLowering::FrameName> ExprLowering::component(const Expr& e, std::size_t indices, FrameName out) {
  if (e.args.size() == indices) return out;
  out.component = component_number(e.args[indices + 1]);
  if (!out.component) return std::nullopt;
  out.axis = axis_operand(e.args[indices]);
  if (!out.axis) return std::nullopt;
  return out;
}

ir::ExprPtr ExprLowering::frame_function(const Expr& e) {
  if (e.text == "CRPL") return turn_in_plane(e);
  for (const auto& row : frame_functions) {
    if (row.name != e.text) continue;
    ir::Call call;
    call.function = row.function;
    if (row.function == ir::Function::frame_inverse) {
      if (e.args.size() != 1) break;
      call.args.push_back(frame(e.args[0]));
      if (!call.args[0]) return nullptr;
      return make_expr(std::move(call), ir::Type::frame, e.pos);
    }
    const bool pairs = row.function != ir::Function::frame_mirror;
    if (pairs && e.args.size() % 2 != 0) break;
    for (std::size_t i = 0; i < e.args.size(); ++i) {
      const bool axis = !pairs || i % 2 == 0;
      call.args.push_back(axis ? axis_operand(channel_axis(e.args[i])) : lower_as(e.args[i], ir::Type::real));
      if (!call.args.back()) return nullptr;
    }
    return make_expr(std::move(call), ir::Type::frame, e.pos);
  }
  c_.error("SIN-012", e.pos, e.text + "() takes pairs of an axis and a number");
  return nullptr;
}

ir::ExprPtr ExprLowering::frame(const Expr& e) {
  const std::uint32_t before = c_.errors;
  if (e.kind == ExprKind::binary && e.text == ":") {
    auto outer = frame(e.args[0]);
    auto inner = outer ? frame(e.args[1]) : nullptr;
    if (!inner) return nullptr;
    return make_expr(ir::Call{ir::Function::frame_chain, {std::move(outer), std::move(inner)}}, ir::Type::frame, e.pos);
  }
  if (e.kind == ExprKind::call) {
    if (e.text == "MEAFRAME") return measured_frame(e);
    bool known = e.text == "CRPL";
    for (const auto& row : frame_functions) known = known || row.name == e.text;
    if (known) return frame_function(e);
  } else if (auto name = frame_name(e); name && !name->component) {
    return name->whole;
  }
  if (c_.errors == before) c_.keep("SIN-008", e.pos, "this frame is not carried yet");
  return nullptr;
}

// --- assignments ------------------------------------------------------------------------------------------------

namespace {

void flatten(const ir::ExprPtr& e, std::vector<ir::ExprPtr>& out) {
  const auto* c = std::get_if<ir::Call>(&e->node);
  if (c != nullptr && c->function == ir::Function::frame_chain) {
    flatten(c->args[0], out);
    flatten(c->args[1], out);
    return;
  }
  out.push_back(e);
}

ir::Value value_of_expr(const ir::ExprPtr& e) {
  const auto constant = ir::constant_value(e);
  return constant ? ir::Value(*constant) : ir::Value(e);
}

std::optional<ir::FrameKind> kind_of(ir::Function f) {
  switch (f) {
    case ir::Function::frame_shift: return ir::FrameKind::translate;
    case ir::Function::frame_turn: return ir::FrameKind::rotate;
    case ir::Function::frame_stretch: return ir::FrameKind::scale;
    case ir::Function::frame_mirror: return ir::FrameKind::mirror;
    default: return std::nullopt;
  }
}

/// The turns of one CROT: about one axis, or about several in the order Z, the new Y, the new X.
void add_turns(const ir::Call& c, std::vector<ir::FrameChange>& out) {
  if (c.args.empty()) return;
  ir::FrameChange turn;
  turn.kind = ir::FrameKind::rotate;
  if (c.args.size() == 2) {
    turn.has_angle = true;
    turn.angle = value_of_expr(c.args[1]);
    turn.rotation_axis = std::get<ir::AxisName>(c.args[0]->node).axis;
  } else {
    for (std::size_t i = 0; i + 1 < c.args.size(); i += 2) {
      ir::FrameWord word;
      word.axis = std::get<ir::AxisName>(c.args[i]->node).axis;
      word.value = value_of_expr(c.args[i + 1]);
      turn.words.push_back(std::move(word));
    }
  }
  out.push_back(std::move(turn));
}

/// One term of a chain as changes of the programmable frame; false when it is none that a statement could make.
bool add_changes(const ir::Expr& term, std::vector<ir::FrameChange>& out) {
  const auto* c = std::get_if<ir::Call>(&term.node);
  const auto kind = c != nullptr ? kind_of(c->function) : std::nullopt;
  if (!kind) return false;
  const bool pairs = *kind != ir::FrameKind::mirror;
  for (std::size_t i = 0; i < c->args.size(); i += pairs ? 2 : 1) {
    const auto* axis = std::get_if<ir::AxisName>(&c->args[i]->node);
    if (axis == nullptr || (*kind == ir::FrameKind::rotate && axis->axis > ir::axis::z)) return false;
  }
  if (*kind == ir::FrameKind::rotate) {
    add_turns(*c, out);
    return true;
  }
  if (c->args.empty()) return true;
  ir::FrameChange change;
  change.kind = *kind;
  for (std::size_t i = 0; i < c->args.size(); i += pairs ? 2 : 1) {
    ir::FrameWord word;
    word.axis = std::get<ir::AxisName>(c->args[i]->node).axis;
    word.value = pairs ? value_of_expr(c->args[i + 1]) : ir::Value(1);
    if (*kind == ir::FrameKind::scale) word.scale = ir::WordScale::radius;
    change.words.push_back(std::move(word));
  }
  out.push_back(std::move(change));
  return true;
}

}  // namespace

/// $P_PFRAME=CTRANS(X,5):CROT(Z,30) says what TRANS X5 and AROT Z30 say; a frame that only the run knows stays an
/// assignment.
bool StatementLowering::frame_statements(const ir::ExprPtr& value, WordPos pos, std::vector<ir::Action>& out) {
  std::vector<ir::ExprPtr> terms;
  flatten(value, terms);
  const auto* own = std::get_if<ir::SystemRef>(&terms.front()->node);
  const bool adds = own != nullptr && own->datum == ir::Datum::frame_programmed && terms.size() > 1;
  std::vector<ir::FrameChange> changes;
  for (std::size_t i = adds ? 1 : 0; i < terms.size(); ++i) {
    if (!add_changes(*terms[i], changes)) return false;
  }
  if (changes.empty()) {
    if (adds) return false;
    changes.emplace_back();
    changes.front().combine = ir::FrameCombine::clear;
  } else {
    for (auto& c : changes) c.combine = ir::FrameCombine::compose;
    if (!adds) changes.front().combine = ir::FrameCombine::replace;
  }
  for (auto& c : changes) {
    c.slot = ir::FrameSlot::chain;
    ir::Action a;
    a.data = ir::FrameOp{std::make_shared<const ir::FrameChange>(std::move(c))};
    a.pos = pos;
    a.text = c_.slice(pos);
    out.push_back(std::move(a));
  }
  return true;
}

/// A row of the table of settable frames that only shifts: one value an axis, so that every control can have it.
bool StatementLowering::offset_row(const ir::Expr& target, const ir::ExprPtr& value, WordPos pos, ir::Assign& out) {
  const auto& row = std::get<ir::SystemRef>(target.node);
  const auto* c = std::get_if<ir::Call>(&value->node);
  if (row.datum != ir::Datum::frame_settable || c == nullptr || c->function != ir::Function::frame_shift) return false;
  if (row_frame(row.text) != nullptr) return false;
  for (std::size_t i = 0; i < c->args.size(); i += 2) {
    if (!std::holds_alternative<ir::AxisName>(c->args[i]->node)) return false;
  }
  if (c_.machine.profile->kind == machine::Kind::lathe) return false;  // a diameter axis: the mode in force decides
  for (const auto& spec : c_.machine.profile->axes) {
    ir::Assign::Item item;
    item.pos = pos;
    item.to_system = true;
    item.system.text = row.text;
    item.system.datum = ir::Datum::work_offset;
    item.system.axis = spec.id;
    item.system.args = row.args;
    item.value = ir::number(0);
    for (std::size_t i = 0; i < c->args.size(); i += 2) {
      if (std::get<ir::AxisName>(c->args[i]->node).axis == spec.id) item.value = c->args[i + 1];
    }
    out.items.push_back(std::move(item));
  }
  return true;
}

std::optional<bool> StatementLowering::assign_frame(const Expr& target, const Expr& value, WordPos pos,
                                                    ir::Assign& assign, std::vector<ir::Action>& actions) {
  const bool shift = target.text == "$P_UIFR" && target.args.size() == 3 &&
                     (target.args[2].text == "TR" || target.args[2].text == "FI");
  if (shift) return std::nullopt;  // a value of the table of offsets
  const std::uint32_t before = c_.errors;
  if (target.text.starts_with("$P_")) c_.framed = true;
  auto name = exprs_.frame_name(target);
  if (c_.errors != before) return false;
  if (!name) return std::nullopt;
  ir::ExprPtr right;
  if (name->component) {
    ir::Call with;
    with.function = ir::Function::frame_with;
    auto number = exprs_.lower_as(value, ir::Type::real);
    if (!number) return false;
    with.args = {name->whole, name->axis, name->component, std::move(number)};
    right = make_expr(std::move(with), ir::Type::frame, pos);
  } else {
    GivenBack given(c_, assign, pos);
    right = exprs_.frame(value);
    if (!right) return false;
  }
  ir::Assign::Item item;
  item.pos = pos;
  if (const auto* ref = std::get_if<ir::SystemRef>(&name->whole->node)) {
    if (ref->datum == ir::Datum::frame_total)
      return refuse("language.system_variable", pos, "$P_ACTFRAME can only be read");
    if (const RowFrame* known = row_frame(ref->text); known != nullptr) {
      const bool of_control = std::any_of(std::begin(control_frames), std::end(control_frames), [&](const auto& f) {
        return (f.active == ref->text || f.stored == ref->text) && !has_control_frame(f.active);
      });
      if (known->row >= ir::frame_rows::neutral || of_control)
        return refuse("language.system_variable", pos, ref->text + " is set by the control only");
      if (c_.said.contains("$P_CHBFRMASK"))
        return refuse("language.system_variable", pos, "base frames that a mask has chosen are not carried yet");
      c_.said.emplace("$P_BFRAME");
    }
    if (ref->datum == ir::Datum::frame_programmed && frame_statements(right, pos, actions)) return true;
    if (!name->component && offset_row(*name->whole, right, pos, assign)) return true;
    item.system = *ref;
    item.to_system = true;
  } else {
    item.target = std::get<ir::VarRef>(name->whole->node);
  }
  item.value = std::move(right);
  assign.items.push_back(std::move(item));
  return true;
}

}  // namespace cnctrans::sinumerik
