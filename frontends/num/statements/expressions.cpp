#include "frontends/num/state/expressions.h"

#include <cmath>
#include <utility>
#include <vector>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/num/functions.h"
#include "dialects/num/gcodes.h"
#include "dialects/num/variables.h"

namespace cnctrans::frontends::num {

namespace facts = dialects::num;
using facts::EMeaning;
using syntax::ExprKind;

namespace {

/// What an E parameter is to the neutral machine; `scale` = system units of one neutral unit.
struct Neutral {
  ir::SystemRef ref;
  double scale = 1;
};

double axis_units(const Settings& settings, ir::AxisId axis) {
  return ir::is_rotary_letter(axis) ? settings.units_per_degree : settings.units_per_mm;
}

ir::SystemRef table_ref(ir::Datum datum, std::int64_t number, std::string text) {
  ir::SystemRef r;
  r.datum = datum;
  r.text = std::move(text);
  r.args.push_back(ir::number(static_cast<double>(number)));
  return r;
}

/// Without PREF and DEC3, DEC1 is the whole offset.
ir::SystemRef offset_ref(ir::AxisId axis, std::string text) {
  ir::SystemRef r = table_ref(ir::Datum::work_offset, facts::offset_row, std::move(text));
  r.axis = axis;
  return r;
}

ir::VarRef e_variable(std::int64_t number) {
  ir::VarRef ref;
  ref.space = facts::space_e;
  ref.index = ir::number(static_cast<double>(number));
  return ref;
}

bool is_offset(const facts::EParameter& row) {
  return row.meaning == EMeaning::pref || row.meaning == EMeaning::dec1 || row.meaning == EMeaning::dec3;
}

/// offset of the axis := (PREF + DEC1 + DEC3) / units. The system's name is empty: no source text says this.
ir::Assign::Item offset_item(const Settings& settings, std::int64_t number, WordPos pos) {
  const std::int64_t base = number / 1000 * 1000;
  const auto axis = static_cast<ir::AxisId>((base - 60000) / 1000);
  const auto part = [base](std::int64_t component) {
    return ir::variable(e_variable(base + component), ir::Type::integer);
  };
  ir::ExprPtr sum = ir::binary(ir::BinaryOp::add, ir::binary(ir::BinaryOp::add, part(0), part(1)), part(4));
  ir::Assign::Item item;
  item.pos = pos;
  item.to_system = true;
  item.system = offset_ref(axis, {});
  item.value = ir::binary(ir::BinaryOp::divide, std::move(sum), ir::number(axis_units(settings, axis)));
  return item;
}

ir::SystemRef axis_ref(ir::Datum datum, ir::AxisId axis, std::string text) {
  ir::SystemRef r;
  r.datum = datum;
  r.axis = axis;
  r.text = std::move(text);
  return r;
}

ir::ExprPtr system(ir::SystemRef ref, WordPos pos) {
  ir::Expr e;
  e.node = std::move(ref);
  e.pos = pos;
  return std::make_shared<const ir::Expr>(std::move(e));
}

/// nullopt: known to the machine only.
std::optional<Neutral> neutral(const facts::EParameter& row, std::int64_t number, const Settings& settings) {
  const bool lathe = settings.lathe;
  const std::int64_t index = facts::e_index(row, number);
  const auto axis = static_cast<ir::AxisId>(index);
  std::string text = "E" + std::to_string(number);
  switch (row.meaning) {
    case EMeaning::dec1: return Neutral{offset_ref(axis, std::move(text)), axis_units(settings, axis)};
    case EMeaning::shift:
      return Neutral{axis_ref(ir::Datum::programmed_shift, axis, std::move(text)), axis_units(settings, axis)};
    case EMeaning::position:
      return Neutral{axis_ref(ir::Datum::machine_position, axis, std::move(text)), axis_units(settings, axis)};
    case EMeaning::tool_radius:
      return Neutral{table_ref(ir::Datum::tool_radius, index, std::move(text)), settings.units_per_mm};
    case EMeaning::tool_length:
    case EMeaning::tool_length_z: {
      if (row.meaning == EMeaning::tool_length_z && !lathe) return std::nullopt;  // tip radius of a mill
      Neutral n{table_ref(ir::Datum::tool_length, index, std::move(text)), settings.units_per_mm};
      if (lathe) n.ref.axis = row.meaning == EMeaning::tool_length ? ir::axis::x : ir::axis::z;
      return n;
    }
    case EMeaning::active_radius: {
      Neutral n{table_ref(ir::Datum::tool_radius, 0, std::move(text)), settings.units_per_mm};
      n.ref.args[0] = system(axis_ref(ir::Datum::offset_number, ir::axis::none, "E50000"), {});
      return n;
    }
    case EMeaning::active_offset:
      return Neutral{axis_ref(ir::Datum::offset_number, ir::axis::none, std::move(text)), 1};
    case EMeaning::feed_override:
      return Neutral{axis_ref(ir::Datum::feed_override, ir::axis::none, std::move(text)), 1};
    case EMeaning::spindle_speed:
      return Neutral{axis_ref(ir::Datum::spindle_speed, ir::axis::none, std::move(text)), 1};
    case EMeaning::slot_switch: {  // see the interpreter's machine data: after the settings come the frame's parts
      Neutral n{table_ref(ir::Datum::active_modal, number, std::move(text)), 1};
      n.ref.args.push_back(ir::number(static_cast<double>(ir::setting_count) + 2 + static_cast<double>(index)));
      n.ref.args.push_back(ir::number(1));
      return n;
    }
    case EMeaning::latched:
    case EMeaning::machine: return Neutral{axis_ref(ir::Datum::other, ir::axis::none, std::move(text)), 1};
    default: return std::nullopt;
  }
}

bool whole(const syntax::Expr& e) {
  return e.kind == ExprKind::number && e.number >= 0 && e.number < 1e9 && e.number == std::floor(e.number) &&
         e.text.find('.') == std::string::npos;
}

/// Bit operations work on the integer parts.
ir::ExprPtr integer_part(ir::ExprPtr e) {
  const auto value = ir::constant_value(e);
  if (value && *value == std::trunc(*value)) return e;
  return ir::call(ir::Function::trunc, {std::move(e)});
}

}  // namespace

std::int64_t variable_number(const syntax::Expr& e) {
  return !e.args.empty() && whole(e.args[0]) ? saturate<std::int64_t>(e.args[0].number) : -1;
}

std::optional<ir::VarRef> Expressions::l_variable(const syntax::Expr& e) {
  const std::int64_t n = variable_number(e);
  if (n < 0 || facts::l_range(n) == nullptr) {
    report_.refuse("NUM-017", e.pos, "there is no variable L" + (e.args.empty() ? "" : e.args[0].text),
                   "variables are L0-L19, L100-L199 and, from 10xx on, L900-L959");
    return std::nullopt;
  }
  ir::VarRef ref;
  ref.space = facts::space_l;
  ref.index = ir::number(static_cast<double>(n));
  return ref;
}

std::optional<ir::VarRef> Expressions::symbol(const syntax::Expr& e) {
  if (const auto n = facts::argument_variable(e.text)) {
    ir::VarRef ref;
    ref.space = facts::space_l;
    ref.index = ir::number(static_cast<double>(*n));
    return ref;
  }
  if (e.text[0] == '\'' || (e.text.size() > 1 && e.text[1] == '.')) {
    report_.keep("NUM-024", e.pos, "`" + e.text + "` reads a state of the control that is not carried",
                 "language.system_variable", "replace it by a variable that the program sets");
    return std::nullopt;
  }
  if (!declared(e.text)) undeclared_.push_back({e.text, word_span(report_.line(), e.pos)});
  ir::VarRef ref;
  ref.space = facts::space_symbol;
  ref.name = e.text;
  for (const auto& i : e.args) {
    ir::ExprPtr index = lower(i);
    if (!index) return std::nullopt;
    ref.indices.push_back(std::move(index));
  }
  return ref;
}

/// An E parameter that no list names is a variable of the program [22].
bool Expressions::user_parameter(const syntax::Expr& e, std::int64_t n) {
  const std::string name = "E" + (e.args.empty() ? std::string() : e.args[0].text);
  if (n < 0 || n > facts::e_parameter_max) {
    report_.refuse("NUM-018", e.pos, "there is no parameter " + name);
    return false;
  }
  if (unlisted_.insert(n).second)
    report_.warn("NUM-018", e.pos,
                 "no list of the control names " + name + "; it is taken for a variable of the program",
                 "use E80000 to E80050, or L variables");
  return true;
}

ir::ExprPtr Expressions::parameter(const syntax::Expr& e) {
  const std::int64_t n = variable_number(e);
  const facts::EParameter* row = facts::e_parameter(n);
  if (row == nullptr) {
    if (!user_parameter(e, n)) return nullptr;
    return ir::at(ir::variable(e_variable(n), ir::Type::integer), e.pos);
  }
  if (offsets_only_read_ && row->meaning == EMeaning::pref)
    presets_read_.insert(static_cast<ir::AxisId>(facts::e_index(*row, n)));
  if (is_memory(*row)) return ir::at(ir::variable(e_variable(n), ir::Type::integer), e.pos);
  auto found = neutral(*row, n, settings_);
  if (!found) {
    report_.refuse("NUM-019", e.pos,
                   "E" + std::to_string(n) + " (" + std::string(row->title) + ") is known to the machine only",
                   "its value can't be had here", "language.system_variable");
    return nullptr;
  }
  ir::ExprPtr value = system(std::move(found->ref), e.pos);
  return found->scale == 1
             ? value
             : ir::at(ir::binary(ir::BinaryOp::multiply, std::move(value), ir::number(found->scale)), e.pos);
}

/// [.BG90], [.RT]: what the control has in force (reference 14.6); nullopt: not one of these.
std::optional<ir::SystemRef> status(const syntax::Expr& e) {
  if (!e.args.empty() || e.text.size() < 4 || e.text[1] != '.') return std::nullopt;
  const std::string_view name = std::string_view(e.text).substr(2, e.text.size() - 3);
  constexpr std::pair<std::string_view, ir::Datum> plain[] = {{"RF", ir::Datum::feed},
                                                              {"RS", ir::Datum::spindle_speed},
                                                              {"RT", ir::Datum::tool_number},
                                                              {"RD", ir::Datum::offset_number},
                                                              {"RED", ir::Datum::rotation_angle}};
  for (const auto& [symbol, datum] : plain) {
    if (name == symbol) return axis_ref(datum, ir::axis::none, e.text);
  }
  const auto code = name.substr(0, 2) == "BG" ? parse_decimal(name.substr(2)) : std::nullopt;
  const facts::GCode* row = code ? facts::g_code(*code) : nullptr;
  if (row == nullptr) return std::nullopt;
  int setting = -1;
  switch (row->kind) {
    case facts::GKind::motion: setting = static_cast<int>(ir::setting_count); break;
    case facts::GKind::plane: setting = static_cast<int>(ir::Setting::plane); break;
    case facts::GKind::comp: setting = static_cast<int>(ir::Setting::comp); break;
    case facts::GKind::units: setting = static_cast<int>(ir::Setting::units); break;
    case facts::GKind::distance: setting = static_cast<int>(ir::Setting::distance); break;
    case facts::GKind::feed_mode: setting = static_cast<int>(ir::Setting::feed_mode); break;
    case facts::GKind::spindle_mode: setting = static_cast<int>(ir::Setting::spindle_mode); break;
    default: return std::nullopt;
  }
  ir::SystemRef ref = table_ref(ir::Datum::active_modal, row->code, e.text);
  ref.args.push_back(ir::number(setting));
  ref.args.push_back(ir::number(row->value));
  return ref;
}

ir::ExprPtr Expressions::variable(const syntax::Expr& e) {
  if (e.text == "E") return parameter(e);
  if (auto known = status(e)) return system(std::move(*known), e.pos);
  auto ref = e.text == "L" ? l_variable(e) : symbol(e);
  return ref ? ir::at(ir::variable(std::move(*ref)), e.pos) : nullptr;
}

ir::ExprPtr Expressions::lower(const syntax::Expr& e) {
  switch (e.kind) {
    case ExprKind::number: return ir::at(ir::number(e.number, e.text), e.pos);
    case ExprKind::variable: return variable(e);
    case ExprKind::unary: {
      ir::ExprPtr inner = lower(e.args.at(0));
      if (!inner || e.text == "+") return inner;
      return ir::at(ir::unary(ir::UnaryOp::negate, std::move(inner)), e.pos);
    }
    case ExprKind::call: {
      ir::ExprPtr inner = lower(e.args.at(0));
      const auto f = facts::function_by_letter(e.text.empty() ? ' ' : e.text[0]);
      return inner && f ? ir::at(ir::call(*f, {std::move(inner)}), e.pos) : nullptr;
    }
    case ExprKind::binary: {
      ir::ExprPtr left = lower(e.args.at(0));
      ir::ExprPtr right = lower(e.args.at(1));
      const auto op = facts::operator_by_text(e.text);
      if (!left || !right || !op) return nullptr;
      if (*op == ir::BinaryOp::bit_and || *op == ir::BinaryOp::bit_or) {
        left = integer_part(std::move(left));
        right = integer_part(std::move(right));
      }
      return ir::at(ir::binary(*op, std::move(left), std::move(right)), e.pos);
    }
    default:
      report_.refuse("NUM-024", e.pos, "`" + e.text + "` is no value", {}, "language.system_variable");
      return nullptr;
  }
}

ir::ExprPtr Expressions::lower_axis_value(const syntax::Expr& e, ir::AxisId axis) {
  const bool sign = e.kind == ExprKind::unary;
  const syntax::Expr& inner = sign ? e.args.at(0) : e;
  ir::ExprPtr value = lower(e);
  if (!value || inner.kind != ExprKind::variable || inner.text != "E") return value;
  // System units: micrometres or 1/10000 degree. A datum is in neutral units already below its scaling.
  const facts::EParameter* row = facts::e_parameter(variable_number(inner));
  if (row == nullptr || row->unit == facts::EUnit::none || is_memory(*row)) {
    if (row != nullptr && row->unit == facts::EUnit::none && row->meaning != EMeaning::user) return value;
    return ir::binary(ir::BinaryOp::divide, std::move(value), ir::number(axis_units(settings_, axis)));
  }
  ir::ExprPtr plain = lower(inner);
  if (const auto* product = std::get_if<ir::Binary>(&plain->node)) plain = product->left;
  return sign && e.text == "-" ? ir::at(ir::unary(ir::UnaryOp::negate, std::move(plain)), e.pos) : plain;
}

ir::Assign::Item Expressions::preset_left(ir::AxisId axis) const {
  const std::int64_t base = 60000 + 1000 * std::int64_t{axis};
  const auto part = [base](std::int64_t component) {
    return ir::variable(e_variable(base + component), ir::Type::integer);
  };
  ir::ExprPtr whole = ir::binary(ir::BinaryOp::multiply, system(axis_ref(ir::Datum::active_shift, axis, {}), {}),
                                 ir::number(axis_units(settings_, axis)));
  whole = ir::binary(ir::BinaryOp::subtract, std::move(whole), part(1));
  ir::Assign::Item item;
  item.target = e_variable(base);
  item.value = ir::binary(ir::BinaryOp::subtract, std::move(whole), part(4));
  return item;
}

void Expressions::take_over_preset(ir::AxisId axis, std::vector<ir::Assign::Item>& items) const {
  ir::Assign::Item item = preset_left(axis);
  item.value = ir::call(ir::Function::round, {std::move(item.value)});
  items.push_back(std::move(item));
  items.push_back(offset_item(settings_, 60000 + 1000 * std::int64_t{axis}, {}));
}

ir::Assign::Item Expressions::latched(ir::AxisId axis) const {
  ir::Assign::Item item;
  item.to_system = true;
  item.system = axis_ref(ir::Datum::other, ir::axis::none, "E" + std::to_string(70001 + 1000 * int{axis}));
  item.value = ir::binary(ir::BinaryOp::multiply, system(axis_ref(ir::Datum::machine_position, axis, {}), {}),
                          ir::number(axis_units(settings_, axis)));
  return item;
}

bool Expressions::is_memory(const facts::EParameter& row) const {
  if (row.meaning == EMeaning::user || row.meaning == EMeaning::scale_factor || row.meaning == EMeaning::tool_note)
    return true;
  if (row.meaning == EMeaning::tool_length_z && !settings_.lathe) return true;  // the tip radius of a mill
  return offsets_apart_ && is_offset(row);
}

bool Expressions::assign_parameter(const syntax::Expr& target, ir::ExprPtr value, std::vector<ir::Assign::Item>& items,
                                   WordPos pos) {
  const std::int64_t n = variable_number(target);
  const facts::EParameter* row = facts::e_parameter(n);
  const std::string name = "E" + (target.args.empty() ? std::string() : target.args[0].text);
  if (row == nullptr) {
    if (!user_parameter(target, n)) return false;
    ir::Assign::Item own;
    own.pos = pos;
    own.target = e_variable(n);
    own.value = integer_part(std::move(value));
    items.push_back(std::move(own));
    return true;
  }
  if (!row->writable) {
    report_.refuse("NUM-020", target.pos, name + " (" + std::string(row->title) + ") can only be read");
    return false;
  }
  if (row->meaning == EMeaning::display) {
    report_.carry("NUM-034", target.pos,
                  name + " (" + std::string(row->title) + ") does not change the path; kept as text",
                  "language.system_variable");
    return false;
  }
  if (row->meaning == EMeaning::tool_note || (row->meaning == EMeaning::tool_length_z && !settings_.lathe)) {
    report_.warn("NUM-041", target.pos,
                 name + " (" + std::string(row->title) +
                     ") does not change the programmed path; it is kept as a number and not written into a tool table",
                 "enter it on the machine");
  }
  value = integer_part(std::move(value));  // E parameters hold integers: a value is truncated
  ir::Assign::Item item;
  item.pos = pos;
  if (is_memory(*row)) {
    item.target = e_variable(n);
    item.value = std::move(value);
    items.push_back(std::move(item));
    if (is_offset(*row)) items.push_back(offset_item(settings_, n, pos));
    return true;
  }
  if (row->meaning == EMeaning::shift) {
    ir::FrameWord word;
    word.axis = static_cast<ir::AxisId>(facts::e_index(*row, n));
    word.scale = ir::WordScale::radius;
    word.value =
        ir::Value(ir::binary(ir::BinaryOp::divide, std::move(value), ir::number(axis_units(settings_, word.axis))));
    if (const auto c = ir::constant_value(word.value.expr)) word.value = ir::Value(*c);
    word.pos = pos;
    shifts_.push_back(std::move(word));
    return true;
  }
  auto found = neutral(*row, n, settings_);
  if (!found) {
    report_.refuse("NUM-019", target.pos, name + " (" + std::string(row->title) + ") is known to the machine only",
                   "what writing it does can't be told here", "language.system_variable");
    return false;
  }
  if (row->meaning == EMeaning::machine) {
    report_.warn("NUM-044", target.pos,
                 name + " (" + std::string(row->title) +
                     ") belongs to the machine: the program finds the value again, "
                     "and nothing else that it does is known here");
  }
  item.to_system = true;
  item.system = std::move(found->ref);
  item.value = found->scale == 1 ? std::move(value)
                                 : ir::binary(ir::BinaryOp::divide, std::move(value), ir::number(found->scale));
  items.push_back(std::move(item));
  return true;
}

bool Expressions::assignment(const syntax::Statement& s, std::vector<ir::Assign::Item>& items) {
  const syntax::Expr& target = s.args.at(0);
  presets_read_.clear();
  ir::ExprPtr value = lower(s.args.at(1));
  if (!value) return false;
  for (const ir::AxisId axis : presets_read_) items.push_back(preset_left(axis));
  if (target.text == "E") return assign_parameter(target, std::move(value), items, s.pos);
  auto ref = target.text == "L" ? l_variable(target) : symbol(target);
  if (!ref) return false;
  ir::Assign::Item item;
  item.pos = s.pos;
  item.target = std::move(*ref);
  item.value = std::move(value);
  items.push_back(std::move(item));
  return true;
}

}  // namespace cnctrans::frontends::num
