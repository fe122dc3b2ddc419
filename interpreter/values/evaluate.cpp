// Evaluating compiled expressions: everything is a double, texts apart.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/saturate.h"
#include "base/text.h"
#include "interpreter/trace/run_codes.h"
#include "interpreter/values/expressions.h"
#include "interpreter/values/functions.h"
#include "ir/text/texts.h"

namespace cnctrans::interpreter {

std::string number_text(double value) {
  return ir::number_text(value);
}

bool equal_numbers(double a, double b, ir::Compare how) {
  if (a == b) return true;
  return how == ir::Compare::relative_1e12 && std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b));
}

bool Evaluator::equal(double a, double b, ir::Compare how) {
  if (equal_numbers(a, b, how)) return true;
  if (!(std::abs(a - b) <= equal_within_)) return false;
  const Span& here = failure_.where;
  const auto same = [&here](const Span& s) { return s.file == here.file && s.line == here.line; };
  if (std::none_of(nearly_equal_.begin(), nearly_equal_.end(), same)) nearly_equal_.push_back(here);
  return true;
}

double Evaluator::checked(double value, std::string_view what) {
  if (std::isfinite(value)) return value;
  failure_.fail(code::number_range, "the result of " + std::string(what) + " is out of the range of numbers");
  return 0;
}

double Evaluator::number(ExprId id) {
  const Node& n = nodes_[id];
  switch (n.kind) {
    case Kind::number: return n.value;
    case Kind::global_number: {
      const auto* space = static_cast<const NumberedSpace*>(n.what);
      if (space->set[n.a] == 0) variables_.note_unset(*space, n.a);
      return space->value[n.a];
    }
    case Kind::level_number: {
      const auto* space = static_cast<const NumberedSpace*>(n.what);
      const auto& level = variables_.level();
      if (level.set[space->level_base + n.a] == 0 && level.depth == 0) variables_.note_unset(*space, n.a);
      return level.value[space->level_base + n.a];
    }
    case Kind::computed_number: {
      const double index = number(n.a);
      Place p;
      auto* space = const_cast<NumberedSpace*>(static_cast<const NumberedSpace*>(n.what));
      if (failure_.set || !variables_.place(*space, index, p)) return 0;
      variables_.note_read(p);
      return Variables::number(p);
    }
    case Kind::local:
    case Kind::global_name: {
      Place p;
      if (!node_place(n, p)) return 0;
      variables_.note_read(p);
      if (p.named == nullptr || !p.named->is_text()) return Variables::number(p);
      failure_.fail(code::wrong_type, "variable " + p.named->name + " holds a text where a number is needed");
      return 0;
    }
    case Kind::frame_part: return frame_part(*static_cast<const ir::Call*>(n.what));
    case Kind::system: {
      std::array<double, 20> args{};
      const std::size_t count = std::min<std::size_t>(n.b, args.size());
      const auto& ref = *static_cast<const ir::SystemRef*>(n.what);
      bool named = false;  // an index that is a name: the machine's own
      for (std::size_t i = 0; i < count; ++i) {
        const auto child = children_[n.a + i];
        named = named || nodes_[child].is_text;
        if (!nodes_[child].is_text) args[i] = number(child);
      }
      double value = 0;
      if (named) {
        ir::SystemRef whole;
        whole.text = ref.text + "[";
        for (std::size_t i = 0; i < count; ++i) {
          const auto child = children_[n.a + i];
          whole.text += (i == 0 ? "" : ",") + (nodes_[child].is_text ? text(child) : shortest(args[i]));
        }
        whole.text += "]";
        if (!failure_.set) system_->read(whole, {}, value);
        return value;
      }
      if (!failure_.set) system_->read(ref, std::span<const double>(args.data(), count), value);
      return value;
    }
    case Kind::unary: {
      const double x = number(n.a);
      switch (static_cast<ir::UnaryOp>(n.op)) {
        case ir::UnaryOp::negate: return -x;
        case ir::UnaryOp::logical_not: return x == 0 ? 1 : 0;
        case ir::UnaryOp::bit_not: return static_cast<double>(~to_int32(x, failure_));
      }
      return 0;
    }
    case Kind::binary: return binary(nodes_[id]);
    case Kind::function: return function(nodes_[id]);
    case Kind::text: failure_.fail(code::wrong_type, "a text stands where a number is needed"); return 0;
    case Kind::fault: failure_.fail(code::no_variable, texts_[n.a]); return 0;
  }
  return 0;
}

double Evaluator::binary(const Node& n) {
  const auto op = static_cast<ir::BinaryOp>(n.op);
  const auto how = static_cast<ir::Compare>(n.attribute);
  if (op == ir::BinaryOp::concat || nodes_[n.a].is_text || nodes_[n.b].is_text) return compare_text(n);
  const ExprId right = n.b;  // `n` may move while the operands are evaluated
  const double a = number(n.a);
  const double b = number(right);
  switch (op) {
    case ir::BinaryOp::add: return checked(a + b, "an addition");
    case ir::BinaryOp::subtract: return checked(a - b, "a subtraction");
    case ir::BinaryOp::multiply: return checked(a * b, "a multiplication");
    case ir::BinaryOp::divide:
    case ir::BinaryOp::int_divide:
    case ir::BinaryOp::modulo:
      if (b == 0) {
        failure_.fail(code::division_by_zero, "division by zero");
        return 0;
      }
      if (op == ir::BinaryOp::divide) return checked(a / b, "a division");
      return op == ir::BinaryOp::modulo ? a - std::trunc(a / b) * b : std::trunc(a / b);
    case ir::BinaryOp::power:
      if (a < 0 && b != std::trunc(b)) {
        failure_.fail(code::function_domain, "a negative number to a power that is not whole");
        return 0;
      }
      if (a == 0 && b <= 0) {
        failure_.fail(code::function_domain, "zero to the power zero or to a negative power");
        return 0;
      }
      return checked(std::pow(a, b), "a power");
    case ir::BinaryOp::eq: return equal(a, b, how) ? 1 : 0;
    case ir::BinaryOp::ne: return equal(a, b, how) ? 0 : 1;
    case ir::BinaryOp::lt: return a < b && (how == ir::Compare::exact || !equal_numbers(a, b, how)) ? 1 : 0;
    case ir::BinaryOp::gt: return a > b && (how == ir::Compare::exact || !equal_numbers(a, b, how)) ? 1 : 0;
    case ir::BinaryOp::le: return a < b || equal_numbers(a, b, how) ? 1 : 0;
    case ir::BinaryOp::ge: return a > b || equal_numbers(a, b, how) ? 1 : 0;
    case ir::BinaryOp::logical_and: return a != 0 && b != 0 ? 1 : 0;
    case ir::BinaryOp::logical_or: return a != 0 || b != 0 ? 1 : 0;
    case ir::BinaryOp::logical_xor: return (a != 0) != (b != 0) ? 1 : 0;
    case ir::BinaryOp::bit_and: return static_cast<double>(to_int32(a, failure_) & to_int32(b, failure_));
    case ir::BinaryOp::bit_or: return static_cast<double>(to_int32(a, failure_) | to_int32(b, failure_));
    case ir::BinaryOp::bit_xor: return static_cast<double>(to_int32(a, failure_) ^ to_int32(b, failure_));
    case ir::BinaryOp::concat: break;
  }
  return 0;
}

double Evaluator::compare_text(const Node& n) {
  const auto op = static_cast<ir::BinaryOp>(n.op);
  const bool order = op == ir::BinaryOp::lt || op == ir::BinaryOp::gt;
  if (op != ir::BinaryOp::eq && op != ir::BinaryOp::ne && !order) {
    failure_.fail(code::wrong_type, "a text stands where a number is needed");
    return 0;
  }
  const ExprId right = n.b;
  const auto a = ir::ended_text(text_operand(n.a));
  const auto b = ir::ended_text(text_operand(right));
  if (order) return (op == ir::BinaryOp::lt ? a < b : b < a) ? 1 : 0;
  return (a == b) == (op == ir::BinaryOp::eq) ? 1 : 0;
}

double Evaluator::function(const Node& n) {
  const auto f = static_cast<ir::Function>(n.op);
  const auto half = static_cast<ir::RoundHalf>(n.attribute);
  if (takes_text(f) || n.is_text) return text_function(n);
  std::array<double, 4> args{};
  const std::size_t count = std::min<std::size_t>(n.b, args.size());
  const auto first = n.a;
  for (std::size_t i = 0; i < count; ++i) args[i] = number(children_[first + i]);
  if (failure_.set) return 0;
  return numeric_function(f, half, std::span<const double>(args.data(), count), failure_);
}

double Evaluator::text_function(const Node& n) {
  const auto f = static_cast<ir::Function>(n.op);
  const auto first = n.a;
  const auto count = n.b;
  const auto subject = count > 0 ? text_operand(children_[first]) : std::string{};
  if (const auto value = ir::number_of_text(f, subject, count > 1 ? text_operand(children_[first + 1]) : std::string{}))
    return *value;
  if (f == ir::Function::to_number) {
    failure_.fail(code::wrong_type, "\"" + subject + "\" is not a number");
    return 0;
  }
  failure_.fail(code::wrong_type, "a text stands where a number is needed");
  return 0;
}

std::string Evaluator::text_operand(ExprId id) {
  return nodes_[id].is_text ? text(id) : number_text(number(id));
}

std::string Evaluator::text_result(const Node& n) {
  const auto f = static_cast<ir::Function>(n.op);
  const auto first = n.a;
  const auto count = n.b;
  if (f == ir::Function::axis_text || f == ir::Function::character) {
    const double x = std::round(number(children_[first]));
    if (failure_.set) return {};
    if (f == ir::Function::axis_text) return system_->axis_name(saturate<ir::AxisId>(x));
    auto one = ir::character_text(x);
    if (!one) failure_.fail(code::function_domain, "a character has a code of 0 to 255");
    return one ? std::move(*one) : std::string{};
  }
  auto subject = count > 0 ? text_operand(children_[first]) : std::string{};
  if (f == ir::Function::upper_case) return to_upper_ascii(subject);
  if (f == ir::Function::lower_case) return ir::lower_case_text(std::move(subject));
  if (f != ir::Function::substring) return subject;
  const double start = count > 1 ? std::round(number(children_[first + 1])) : 0;
  const double length = count > 2 ? std::round(number(children_[first + 2])) : 1e9;
  if (start < 0 || length < 0) {
    failure_.fail(code::function_domain, "a part of a text cannot start or end before it");
    return {};
  }
  return ir::part_of_text(subject, start, length);
}

std::string Evaluator::text(ExprId id) {
  const Node n = nodes_[id];
  if (!n.is_text) return number_text(number(id));
  switch (n.kind) {
    case Kind::text: return texts_[n.a];
    case Kind::local:
    case Kind::global_name: {
      Place p;
      if (!node_place(n, p)) return {};
      return p.named != nullptr && p.named->is_text() ? Variables::text(p) : number_text(Variables::number(p));
    }
    case Kind::binary: {
      auto left = text_operand(n.a);
      return ir::joined_text(std::move(left), text_operand(n.b));
    }
    case Kind::function: return text_result(n);
    default: break;
  }
  return {};
}

std::string Evaluator::shown(ExprId id) {
  return nodes_[id].is_text ? text(id) : number_text(number(id));
}

}  // namespace cnctrans::interpreter
