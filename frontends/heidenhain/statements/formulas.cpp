// Q parameters, formulas and FN functions (reference 12, 13).
#include <array>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/heidenhain/functions.h"
#include "dialects/heidenhain/variables.h"
#include "frontends/heidenhain/state/datum.h"
#include "frontends/heidenhain/state/lowering.h"
#include "frontends/heidenhain/state/term.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;
using syntax::Expr;
using syntax::ExprKind;

namespace {

std::optional<ir::SpaceId> space_of(std::string_view prefix, std::int64_t number) {
  const auto within = [number](std::int64_t most) { return number >= 0 && number <= most; };
  if (prefix == "Q" && within(facts::q_max)) return facts::space_q;
  if (prefix == "QL" && within(facts::ql_max)) return facts::space_ql;
  if (prefix == "QR" && within(facts::qr_max)) return facts::space_qr;
  if (prefix == "QS" && within(facts::qs_max)) return facts::space_qs;
  return std::nullopt;
}

}  // namespace

ir::ExprPtr Lowering::variable(const Expr& e, bool written) {
  const auto number = saturate<std::int64_t>(e.args.at(0).number);
  const auto space = space_of(e.text, number);
  if (!space) {
    report_.refuse("HEI-012", e.pos, "there is no parameter " + e.text + e.args[0].text);
    return nullptr;
  }
  if (*space == facts::space_q) {
    const auto* system = facts::find_system_q(number);
    if (written && (system != nullptr || facts::is_control_q(number))) {
      report_.refuse("HEI-012", e.pos, "Q" + std::to_string(number) + " is kept by the control; a program can't set it",
                     {}, "language.system_variable");
      return nullptr;
    }
    if (system != nullptr) return ir::at(datum(system->datum, "Q" + std::to_string(number)), e.pos);
    if (number == facts::q_tool_axis) return ir::at(ir::number(tool_called_ ? tool_axis_ : -1), e.pos);
    if (number == facts::q_unit) return ir::at(ir::number(inch_ ? 1 : 0), e.pos);
    if (facts::is_control_q(number)) return ir::at(datum(ir::Datum::other, "Q" + std::to_string(number)), e.pos);
    (written ? writes_ : reads_).insert(number);
  }
  if (*space == facts::space_qs) {  // texts are kept by name
    ir::VarRef ref;
    ref.space = *space;
    ref.name = "QS" + std::to_string(number);
    texts_.insert(ref.name);
    return ir::at(ir::variable(std::move(ref), ir::Type::string), e.pos);
  }
  return ir::at(ir::numbered(*space, number), e.pos);
}

/// `SUBSTR ( SRC_QS10 BEG2 LEN4 )`: the words in the brackets are named.
ir::ExprPtr Lowering::text_function(const Expr& e) {
  const auto* row = facts::find_text_function(e.text);
  const auto word = [&](std::string_view name) -> ir::ExprPtr {
    for (const Expr& a : e.args) {
      if (a.kind == ExprKind::call && a.text == name && a.args.size() == 1) return expression(a.args[0]);
    }
    return nullptr;
  };
  if (row != nullptr) {
    std::vector<ir::ExprPtr> args;
    bool good = true;
    std::string_view rest = row->words;
    while (!rest.empty()) {
      const std::string_view name = rest.substr(0, rest.find(' '));
      args.push_back(word(name));
      good = good && args.back() != nullptr;
      rest.remove_prefix(std::min(name.size() + 1, rest.size()));
    }
    if (!good && !report_.refused())
      report_.refuse("HEI-013", e.pos, "`" + e.text + "` needs the words " + std::string(row->words));
    if (report_.refused()) return nullptr;
    const bool text = row->function == ir::Function::substring || row->function == ir::Function::to_string;
    if (row->function == ir::Function::to_string) {  // DECIMALS
      const auto places = ir::constant_value(args[1]);
      if (!places || *places != 0) {
        report_.keep("HEI-013", e.pos, "TOCHAR with decimals is not carried: how the control writes them is not known",
                     "language.statement");
        return nullptr;
      }
      args = {ir::call(ir::Function::round, {args[0]})};
    }
    ir::ExprPtr value = ir::call(row->function, args);
    if (text) {
      auto typed = std::make_shared<ir::Expr>(*value);
      typed->type = ir::Type::string;
      value = std::move(typed);
    }
    if (row->function == ir::Function::index_of) {  // not found: the length of the text
      const ir::ExprPtr length = ir::call(ir::Function::string_length, {args[0]});
      auto rest_of = std::make_shared<ir::Expr>(*ir::call(ir::Function::substring, {args[0], args[2], length}));
      rest_of->type = ir::Type::string;
      const Term begin{ir::Value(args[2])};
      const auto first = ir::constant_value(args[2]);
      const bool whole = first && *first == 0;
      const ir::ExprPtr place = ir::call(ir::Function::index_of, {whole ? args[0] : rest_of, args[1]});
      const ir::ExprPtr none = ir::binary(ir::BinaryOp::lt, place, ir::number(0));
      const Term from = whole ? Term(0) : begin;
      const Term missing = Term(ir::Value(none)) * (Term(ir::Value(length)) - from + Term(1));
      value = ir::as_expr((Term(ir::Value(place)) + from + missing).value());
    }
    return ir::at(value, e.pos);
  }
  if (e.text == facts::text_order_word) {
    const ir::ExprPtr a = word("SRC_"), b = word("SEA_");
    report_.warn(
        "HEI-034", e.pos,
        "STRCOMP is taken as 0 for equal texts, -1 where the first comes before the second, 1 behind it: which "
        "of the two is which the manuals at hand do not say",
        "compare the result with 0 alone, or try it on the control");
    if (a && b)
      return ir::at(
          ir::binary(ir::BinaryOp::subtract, ir::binary(ir::BinaryOp::gt, a, b), ir::binary(ir::BinaryOp::lt, a, b)),
          e.pos);
  }
  if (report_.refused()) return nullptr;
  report_.keep("HEI-013", e.pos, "`" + e.text + "`: functions of texts are not carried yet", "language.statement");
  return nullptr;
}

ir::ExprPtr Lowering::expression(const Expr& e) {
  switch (e.kind) {
    case ExprKind::number: return ir::at(ir::number(e.number, e.text), e.pos);
    case ExprKind::string: return ir::at(ir::string_literal(e.text), e.pos);
    case ExprKind::variable: return variable(e, false);
    case ExprKind::name:
      if (e.text == facts::pi_word) return ir::at(ir::number(facts::pi), e.pos);
      break;
    case ExprKind::unary: {
      ir::ExprPtr inner = expression(e.args[0]);
      return inner ? ir::at(ir::unary(ir::UnaryOp::negate, std::move(inner)), e.pos) : nullptr;
    }
    case ExprKind::binary: {
      ir::ExprPtr a = expression(e.args[0]), b = expression(e.args[1]);
      if (!a || !b) return nullptr;
      if (e.text == facts::concat_operator) {
        auto joined = std::make_shared<ir::Expr>(*ir::binary(ir::BinaryOp::concat, std::move(a), std::move(b)));
        joined->type = ir::Type::string;
        return ir::at(joined, e.pos);
      }
      const auto* op = facts::find_operator(e.text);
      if (op == nullptr) break;
      return ir::at(ir::binary(op->op, std::move(a), std::move(b)), e.pos);
    }
    case ExprKind::call: {
      if (e.args.size() != 1 || facts::find_text_function(e.text) != nullptr) return text_function(e);
      if (e.text == facts::negate_word || facts::find_function(e.text) != nullptr || e.text == facts::fraction_word ||
          e.text == facts::sign_word) {
        ir::ExprPtr x = expression(e.args[0]);
        if (!x) return nullptr;
        if (e.text == facts::negate_word) return ir::at(ir::unary(ir::UnaryOp::negate, std::move(x)), e.pos);
        if (e.text == facts::fraction_word)
          return ir::at(ir::binary(ir::BinaryOp::subtract, x, ir::call(ir::Function::trunc, {x})), e.pos);
        if (e.text == facts::sign_word) {  // 1 for 0 as well: 2 (x >= 0) - 1
          const ir::ExprPtr not_negative = ir::binary(ir::BinaryOp::ge, x, ir::number(0));
          return ir::at(ir::binary(ir::BinaryOp::subtract,
                                   ir::binary(ir::BinaryOp::multiply, ir::number(2), not_negative), ir::number(1)),
                        e.pos);
        }
        return ir::at(ir::call(facts::find_function(e.text)->function, {std::move(x)}), e.pos);
      }
      return text_function(e);
    }
    case ExprKind::missing: break;
  }
  report_.refuse("HEI-013", e.pos, "`" + e.text + "` means nothing in a formula");
  return nullptr;
}

bool Lowering::target(const Expr& e, ir::VarRef& out) {
  const ir::ExprPtr v = variable(e, true);
  const auto* ref = v ? std::get_if<ir::VarRef>(&v->node) : nullptr;
  if (ref == nullptr) return false;
  out = *ref;
  return true;
}

bool Lowering::assignment(const syntax::Statement& s) {
  ir::Assign::Item item;
  item.pos = s.pos;
  item.value = expression(s.args[1]);
  if (!target(s.args[0], item.target) || !item.value) return false;
  if ((s.args[0].text == "QS") != (item.value->type == ir::Type::string)) {
    report_.refuse("HEI-013", s.pos, "a text belongs into a parameter QS, a number into Q, QL or QR");
    return false;
  }
  ir::Assign assign;
  Item& put_item = put(ir::Assign{});
  put_item.writes.push_back(item.target);
  assign.items.push_back(std::move(item));
  put_item.statement.node = std::move(assign);
  return true;
}

bool Lowering::jump(const syntax::Statement& s, ir::BinaryOp op) {
  const Expr& c = s.args[0];
  ir::ExprPtr a = expression(c.args[0]), b = expression(c.args[1]);
  const auto& words = block_->words;
  const Word* name = nullptr;
  const bool labelled = !words.empty() && iequals_ascii(words[0].address, "LBL");
  if (labelled && words[0].has_value) name = words.data();
  if (labelled && words.size() > 1 && words[1].address.empty()) name = &words[1];
  Item probe;
  if (!a || !b || !label_name(s.args.size() > 1 ? &s.args[1] : nullptr, name, probe)) return false;
  ir::Jump jump;
  jump.target.text = probe.label;
  jump.target.is_number = probe.number;
  jump.condition = ir::at(ir::binary(op, std::move(a), std::move(b)), c.pos);
  if (const auto constant = ir::constant_value(jump.condition)) {
    if (*constant == 0) {
      report_.note("HEI-013", s.pos, "the jump is never taken; it is left out");
      put(ir::Block{});
      return true;
    }
    jump.condition = nullptr;
  }
  Item& item = put(ItemKind::jump, std::move(jump));
  item.label_text = probe.label_text;
  item.label = probe.label;
  item.number = probe.number;
  return true;
}

/// `SYSREAD Q1 = ID50 NR1 IDXQ2`: read where the datum has a neutral meaning.
bool Lowering::sysread(const syntax::Statement& rest) {
  const std::string text = to_upper_ascii(rest.text);
  const auto number_behind = [&text](std::string_view word) -> std::optional<std::int64_t> {
    const auto at = text.find(word);
    if (at == std::string::npos) return std::nullopt;
    std::string_view digits = trim(std::string_view(text).substr(at + word.size()));
    digits = digits.substr(0, digits.find_first_not_of("0123456789"));
    const auto n = parse_decimal(digits);
    return n ? std::optional(saturate<std::int64_t>(*n)) : std::nullopt;
  };
  const auto variable_behind = [&text](std::size_t from) -> std::optional<Expr> {
    const auto q = text.find('Q', from);
    if (q == std::string::npos) return std::nullopt;
    const auto digits = text.find_first_of("0123456789", q);
    if (digits == std::string::npos) return std::nullopt;
    Expr e;
    e.kind = ExprKind::variable;
    e.text = text.substr(q, digits - q);
    Expr n;
    n.kind = ExprKind::number;
    n.text = text.substr(digits, text.find_first_not_of("0123456789", digits) - digits);
    n.number = parse_decimal(n.text).value_or(0);
    e.args.push_back(std::move(n));
    return e;
  };
  const auto id = number_behind("ID"), nr = number_behind("NR");
  const auto equals = text.find('=');
  auto target_text = variable_behind(0);
  std::optional<double> told;  // what the text itself says, as Q109 and Q113 do
  if (id && nr && *id == 20 && *nr == 3) told = tool_called_ ? tool_axis_ : -1;
  if (id && nr && *id == 10 && *nr == 1) told = inch_ ? 1 : 0;
  const auto* row = id && nr ? facts::find_system_read(*id, *nr) : nullptr;
  if ((row == nullptr && !told) || equals == std::string::npos || !target_text) {
    report_.keep("HEI-027", rest.pos, "FN 18: this datum of the control has no neutral meaning",
                 "language.system_variable");
    return false;
  }
  target_text->pos = rest.pos;
  const auto idx = number_behind("IDX");
  ir::AxisId axis = ir::axis::none;
  if (row != nullptr && row->axis_index) {
    constexpr std::array<ir::AxisId, 10> order{ir::axis::none, 0, 1, 2, ir::axis::a, ir::axis::b, ir::axis::c, 3, 4, 5};
    if (!idx || *idx < 1 || *idx > 9) {
      report_.keep("HEI-027", rest.pos, "FN 18: IDX must name an axis, 1 for X", "language.system_variable");
      return false;
    }
    axis = order[static_cast<std::size_t>(*idx)];
  }
  const bool of_tool = *id == 50;
  auto value =
      told ? ir::number(*told) : datum(row->datum, "ID" + std::to_string(*id) + " NR" + std::to_string(*nr), axis);
  constexpr double inch = 25.4;
  const bool by_unit = row != nullptr && row->by_unit && !ir::is_rotary_letter(axis);
  if (by_unit && inch_) value = ir::binary(ir::BinaryOp::multiply, std::move(value), ir::number(inch));
  if (of_tool) {  // of a tool that a number or a parameter names
    const auto at = text.find("IDX");
    const auto named = at == std::string::npos ? std::nullopt : variable_behind(at);
    const ir::ExprPtr tool = idx ? ir::number(static_cast<double>(*idx)) : named ? variable(*named, false) : nullptr;
    if (!tool) {
      report_.keep("HEI-027", rest.pos, "FN 18: IDX must name a tool", "machine.tools");
      return false;
    }
    auto row_data = std::make_shared<ir::Expr>(*value);
    std::get<ir::SystemRef>(row_data->node).args = {tool};
    value = std::move(row_data);
  }
  ir::Assign::Item item;
  item.pos = rest.pos;
  item.value = std::move(value);
  if (!target(*target_text, item.target)) return false;
  ir::Assign assign;
  Item& put_item = put(ir::Assign{});
  put_item.writes.push_back(item.target);
  assign.items.push_back(std::move(item));
  put_item.statement.node = std::move(assign);
  return true;
}

/// `Q20 = CDATA Q30`: centre and radius of the circle through the points Q30 Q31, Q32 Q33, Q34 Q35 (and Q36 Q37).
bool Lowering::circle(const syntax::Statement& s, bool four) {
  const bool good = s.args.size() == 2 && s.args[1].kind == ExprKind::call && s.args[1].text == "CDATA" &&
                    s.args[1].args.size() == 1 && s.args[1].args[0].kind == ExprKind::variable;
  if (!good) {
    report_.refuse("HEI-013", s.pos, "FN " + s.text + " has another form", "write FN 23: Q20 = CDATA Q30");
    return false;
  }
  if (four) report_.warn("HEI-013", s.pos, "FN 24: the fourth point is taken to lie on the circle of the other three");
  const auto behind = [](const Expr& e, int k) {
    Expr out = e;
    out.args[0].number += k;
    out.args[0].text.clear();
    return out;
  };
  std::array<Term, 6> q;
  for (std::size_t k = 0; k < q.size(); ++k) {
    const ir::ExprPtr e = variable(behind(s.args[1].args[0], static_cast<int>(k)), false);
    if (!e) return false;
    q[k] = Term(ir::Value(e));
  }
  const Pair p{q[0], q[1]}, a = Pair{q[2], q[3]} - p, b = Pair{q[4], q[5]} - p;
  const Term area = Term(2) * (a.u * b.v - a.v * b.u);
  const Term aa = a.u * a.u + a.v * a.v, bb = b.u * b.u + b.v * b.v;
  const Pair d{(b.v * aa - a.v * bb) / area, (a.u * bb - b.u * aa) / area};
  const std::array<Term, 3> results{p.u + d.u, p.v + d.v, d.length()};
  for (std::size_t k = results.size(); k-- > 0;) {  // the radius first: it is of the points alone
    ir::Assign::Item item;
    item.pos = s.pos;
    item.value = ir::as_expr(results[k].value());
    if (!target(behind(s.args[0], static_cast<int>(k)), item.target)) return false;
    ir::Assign assign;
    Item& put_item = put(ir::Assign{});
    put_item.writes.push_back(item.target);
    assign.items.push_back(std::move(item));
    put_item.statement.node = std::move(assign);
  }
  return true;
}

/// The value that a function gives its parameter; `fits`: the formula has the form of the function.
ir::ExprPtr Lowering::function_value(const facts::FnRow& row, const Expr& e, bool& fits) {
  using facts::FnUse;
  const bool prefix = row.use == FnUse::prefix;
  if (row.use == FnUse::assign) {
    fits = e.kind != ExprKind::binary && e.kind != ExprKind::call;
    return fits ? expression(e) : nullptr;
  }
  fits = e.kind == (prefix ? ExprKind::call : ExprKind::binary) && e.text == row.word;
  if (!fits) return nullptr;
  ir::ExprPtr a = expression(e.args[0]), b = prefix ? nullptr : expression(e.args[1]);
  if (!a || (!prefix && !b)) return nullptr;
  switch (row.use) {
    case FnUse::prefix: return ir::call(row.function, {std::move(a)});
    case FnUse::length:
      return ir::call(ir::Function::sqrt, {ir::binary(ir::BinaryOp::add, ir::call(ir::Function::square, {std::move(a)}),
                                                      ir::call(ir::Function::square, {std::move(b)}))});
    case FnUse::angle: return ir::call(ir::Function::arg, {std::move(b), std::move(a)});  // arg(adjacent, opposite)
    default: return ir::binary(row.op, std::move(a), std::move(b));
  }
}

bool Lowering::function(const syntax::Statement& s) {
  const auto* row = facts::fn_row(saturate<std::int64_t>(parse_decimal(s.text).value_or(-1)));
  const auto wrong = [&] {
    report_.refuse("HEI-013", s.pos, "FN " + s.text + " has another form", "see the list of FN functions");
    return false;
  };
  if (row == nullptr) return wrong();
  using facts::FnUse;
  switch (row->use) {
    case FnUse::assign:
    case FnUse::binary:
    case FnUse::prefix:
    case FnUse::length:
    case FnUse::angle: break;
    case FnUse::jump:
      if (s.args.empty() || s.args[0].kind != ExprKind::binary || s.args[0].text != row->word) return wrong();
      return jump(s, row->op);
    case FnUse::error: {
      if (s.children.empty()) return wrong();
      ir::Message m;
      m.kind = ir::MessageKind::error;
      const auto digits = s.children[0].text.find_first_of("0123456789");
      const auto n =
          digits == std::string::npos ? std::nullopt : parse_decimal(trim(s.children[0].text.substr(digits)));
      if (!n) return wrong();
      m.number = ir::number(*n);
      m.parts.push_back(ir::string_literal("error " + std::to_string(saturate<std::int64_t>(*n))));
      put(std::move(m));
      return true;
    }
    case FnUse::sysread:
      if (s.children.empty()) return wrong();
      return sysread(s.children[0]);
    case FnUse::wait: {
      ir::Block b;
      b.actions.emplace_back().data = ir::PreparationStop{};
      const bool sync = !s.children.empty() && to_upper_ascii(s.children[0].text).find("SYNC") != std::string::npos;
      if (!sync) {
        report_.keep("HEI-013", s.pos, "FN 20 waits for a signal of the machine", "language.synchronised");
        return false;
      }
      put(std::move(b));
      return true;
    }
    case FnUse::circle: return circle(s, row->number == 24);
    case FnUse::kept: {
      if (row->number == 25) {
        report_.keep("HEI-013", s.pos, "FN 25 sets the datum: preset tables are known to the machine only",
                     "motion.transformation");
        return false;
      }
      if (row->number != 28)
        return carried(s, true, "beside.data", "FN " + s.text + " does not change the path; it is kept as text");
      report_.keep("HEI-013", s.pos, "FN " + s.text + " reads tables that the control keeps", "language.statement");
      return false;
    }
  }
  bool fits = s.args.size() == 2 && s.args[0].kind == ExprKind::variable;
  ir::ExprPtr value = fits ? function_value(*row, s.args[1], fits) : nullptr;
  if (!fits) return wrong();
  ir::Assign::Item item;
  item.pos = s.pos;
  if (!value || !target(s.args[0], item.target)) return false;
  item.value = std::move(value);
  ir::Assign assign;
  Item& put_item = put(ir::Assign{});
  put_item.writes.push_back(item.target);
  assign.items.push_back(std::move(item));
  put_item.statement.node = std::move(assign);
  return true;
}

}  // namespace cnctrans::frontends::heidenhain
