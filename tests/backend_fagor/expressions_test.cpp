// Expressions as the control reads them: what is written, read back by the language's reader, has the same value.
#include <cmath>
#include <cstdlib>

#include "interpreter/program/interpreter.h"
#include "tests/backend_fagor/build.h"

namespace cnctrans::test {
namespace {

using ir::BinaryOp;
using ir::ExprPtr;
using ir::Function;
using ir::Type;

std::string printed(const ExprPtr& e) {
  Build b;
  b.add(assign(P(1), e));
  const std::string text = b.lines();
  EXPECT_EQ(b.codes(), "") << text;
  return text.size() > 7 ? text.substr(4, text.size() - 6) : text;
}

/// The value of the text on the control.
double read_back(const std::string& text) {
  const machine::Profile profile = profile_of("fagor-mill");
  frontends::ReadOptions read;
  read.profile = &profile;
  Diagnostics diagnostics;
  const auto source = SourceText::from_string("1.PIM", "(P100=" + text + ")\nM30\n");
  const auto program = frontends::fagor::make_frontend()->read(source, 1, read, diagnostics, nullptr);
  interpreter::TraceRecorder trace;
  const auto result = interpreter::run(program, profile, {}, trace, diagnostics);
  EXPECT_EQ(codes_of(diagnostics), "") << text;
  for (const auto& [name, value] : result.variables) {
    if (name == "P100") return std::strtod(value.c_str(), nullptr);
  }
  ADD_FAILURE() << "P100 has no value after " << text;
  return std::nan("");
}

ExprPtr call1(Function f, double x, ir::RoundHalf half = ir::RoundHalf::away) {
  return ir::call(f, {num(x)}, half);
}

TEST(FagorExpressions, ParenthesesWhereTheTableOfPrioritiesNeedsThem) {  // 16.4
  const ExprPtr a = P(1), b = P(2), c = P(3);
  EXPECT_EQ(printed(op(BinaryOp::power, minus(a), b)), "-P1 EXP P2");  // the sign binds tighter
  EXPECT_EQ(printed(minus(op(BinaryOp::power, a, b))), "-(P1 EXP P2)");
  EXPECT_EQ(printed(op(BinaryOp::power, a, op(BinaryOp::power, b, c))), "P1 EXP (P2 EXP P3)");
  EXPECT_EQ(printed(op(BinaryOp::multiply, op(BinaryOp::modulo, a, b), c)), "P1 MOD P2*P3");
  EXPECT_EQ(printed(op(BinaryOp::modulo, op(BinaryOp::multiply, a, b), c)), "(P1*P2) MOD P3");
  EXPECT_EQ(printed(op(BinaryOp::divide, a, op(BinaryOp::multiply, b, c))), "P1/(P2*P3)");
  EXPECT_EQ(printed(op(BinaryOp::multiply, a, minus(b))), "P1*(-P2)");
  EXPECT_EQ(printed(op(BinaryOp::subtract, a, num(-2))), "P1-(-2)");
  EXPECT_EQ(printed(ir::call(Function::sin, {op(BinaryOp::add, a, b)})), "SIN(P1+P2)");
}

TEST(FagorExpressions, RelationsAreValues) {
  EXPECT_EQ(printed(op(BinaryOp::gt, P(2), num(3))), "P2 GT 3");
  EXPECT_EQ(printed(op(BinaryOp::le, op(BinaryOp::add, P(2), num(1)), num(-6))), "P2+1 LE -6");
  EXPECT_EQ(printed(op(BinaryOp::multiply, op(BinaryOp::gt, P(2), num(3)), num(5))), "(P2 GT 3)*5");
}

TEST(FagorExpressions, AndBetweenNumbersIsBitwiseSoTruthValuesBecomeRelations) {  // 16.3
  EXPECT_EQ(printed(op(BinaryOp::logical_and, P(1), op(BinaryOp::eq, P(2), num(1)))), "(P1 NE 0) AND (P2 EQ 1)");
  EXPECT_EQ(printed(op(BinaryOp::bit_and, P(1), P(2))), "P1 AND P2");
  EXPECT_EQ(printed(ir::unary(ir::UnaryOp::logical_not, P(1))), "P1 EQ 0");
  EXPECT_EQ(printed(ir::unary(ir::UnaryOp::bit_not, P(1))), "NOT P1");
  EXPECT_EQ(printed(ir::unary(ir::UnaryOp::logical_not, op(BinaryOp::logical_or, op(BinaryOp::eq, P(2), num(1)),
                                                           op(BinaryOp::lt, P(2), num(0))))),
            "NOT ((P2 EQ 1) OR (P2 LT 0))");
}

TEST(FagorExpressions, FunctionsTheLanguageLacksHaveTheSameValue) {
  const std::vector<double> samples{-2.5, -2, -0.4, 0, 0.4, 1.5, 2.5, 3};
  for (const double x : samples) {
    const std::vector<std::pair<Function, double>> expected{{Function::floor, std::floor(x)},
                                                            {Function::ceil, std::ceil(x)},
                                                            {Function::trunc, std::trunc(x)},
                                                            {Function::sign, x > 0   ? 1
                                                                             : x < 0 ? -1
                                                                                     : 0},
                                                            {Function::square, x * x},
                                                            {Function::abs, std::fabs(x)},
                                                            {Function::to_boolean, x != 0 ? 1 : 0}};
    for (const auto& [f, value] : expected)
      EXPECT_NEAR(read_back(printed(call1(f, x))), value, 1e-12) << printed(call1(f, x));
    const ExprPtr up = call1(Function::round, x, ir::RoundHalf::up);
    EXPECT_NEAR(read_back(printed(up)), std::floor(x + 0.5), 1e-12) << printed(up);
    for (const double y : samples) {
      if (x == 0 && y == 0) continue;
      const ExprPtr angle = ir::call(Function::atan2, {num(y), num(x)});
      EXPECT_NEAR(read_back(printed(angle)), std::atan2(y, x) * 180 / 3.14159265358979323846, 1e-9) << printed(angle);
      EXPECT_NEAR(read_back(printed(ir::call(Function::min, {num(x), num(y)}))), std::min(x, y), 1e-12);
      EXPECT_NEAR(read_back(printed(ir::call(Function::max, {num(x), num(y)}))), std::max(x, y), 1e-12);
      if (y == 0) continue;
      EXPECT_NEAR(read_back(printed(op(BinaryOp::int_divide, num(x), num(y)))), std::trunc(x / y), 1e-12);
    }
  }
  EXPECT_NEAR(read_back(printed(call1(Function::ln, 5))), std::log(5.0), 1e-12);
  EXPECT_NEAR(read_back(printed(call1(Function::exp, 1.5))), std::exp(1.5), 1e-12);
  EXPECT_EQ(read_back(printed(ir::call(Function::bound, {num(1), num(5), num(9)}))), 5);
}

TEST(FagorExpressions, HalvesToTheEvenNumberAreRefused) {
  Build b;
  b.add(assign(P(1), ir::call(Function::round, {P(2)}, ir::RoundHalf::even)));
  (void)b.text();
  EXPECT_EQ(b.codes(), "TRN-203");
}

TEST(FagorExpressions, ConstantsBeyondSixDigitsAndFiveDecimalsAreBuilt) {  // 2.2: +-6.5
  for (const double v : {0.5, 123456.78901, 2.718281828459045, 0.000001234, -2.7182818, 1000000.0, 1234567.5,
                         123456789012.0, 4000000000.25, -0.00000075}) {
    const std::string text = printed(num(v));
    EXPECT_DOUBLE_EQ(read_back(text), v) << text;
    const std::string product = printed(op(BinaryOp::multiply, num(3), num(v)));
    EXPECT_DOUBLE_EQ(read_back(product), 3 * v) << product;
    // no constant in the text is longer than the control takes
    std::size_t whole = 0, decimals = 0;
    bool point = false, hex = false;
    for (const char c : text) {
      if (c == '$') hex = true;
      if (c == '.') {
        point = true;
      } else if (c >= '0' && c <= '9') {
        (point ? decimals : whole) += 1;
      } else if (!(c >= 'A' && c <= 'F')) {
        whole = decimals = 0;
        point = false;
        hex = c == '$';
      }
      EXPECT_TRUE(hex || whole <= 6) << text;
      EXPECT_LE(decimals, 5U) << text;
    }
  }
}

TEST(FagorExpressions, ParametersThatDoNotExistAndTextsAreRefused) {  // 16.2
  for (const ExprPtr& e : {P(26), P(300), ir::string_literal("x")}) {
    Build b;
    b.add(assign(P(1), e));
    (void)b.text();
    EXPECT_EQ(b.codes(), "TRN-203");
  }
}

}  // namespace
}  // namespace cnctrans::test
