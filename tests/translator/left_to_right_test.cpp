// Random expressions of a control without precedence, against an evaluator written from its rule: one operand after the
// other from the left, a function binds the next operand only. The translations must keep the value.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "base/text.h"
#include "translator/pipeline.h"

namespace cnctrans {
namespace {

struct Term {
  std::string text;
  double value = 0;
};

/// Writes assignments to L1..L9 and keeps what the rule makes of them.
class Maker {
 public:
  explicit Maker(std::uint32_t seed) : random_(seed) {}

  /// `L1=2+3*5`, with its value; the variables before it may occur.
  std::string assignment(int target) {
    for (;;) {
      std::string text;
      double v = 0;
      if (!chain(text, v)) continue;
      values_[target] = v;
      known_ = std::max(known_, target);
      return "L" + std::to_string(target) + "=" + text;
    }
  }
  [[nodiscard]] double value(int n) const { return values_[n]; }

 private:
  int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  Term operand() {
    if (known_ > 0 && pick(3) == 0) {
      const int n = 1 + pick(known_);
      return {"L" + std::to_string(n), values_[n]};
    }
    const double v = (1 + pick(400)) / 8.0;
    return {shortest(v), v};
  }
  /// `&` and `!` work on the whole part of both sides (19.3).
  static double bits(double a, double b, char op) {
    const auto x = static_cast<std::int64_t>(a), y = static_cast<std::int64_t>(b);
    return static_cast<double>(op == '&' ? x & y : x | y);
  }
  Term primary() {
    const Term t = operand();
    constexpr double degree = std::numbers::pi / 180;
    switch (pick(9)) {
      case 0: return {"S " + t.text, std::sin(t.value * degree)};
      case 1: return {"C " + t.text, std::cos(t.value * degree)};
      case 2: return {"A " + t.text, std::atan(t.value) / degree};
      case 3: return t.value >= 0 ? Term{"R " + t.text, std::sqrt(t.value)} : t;
      case 4: return {"T " + t.text, std::trunc(t.value)};
      default: return t;
    }
  }
  /// Rounding in the last digits must not decide about the whole part.
  static bool whole_part_is_clear(double v) { return std::fabs(v - std::round(v)) > 1e-6 || v == std::round(v); }
  bool chain(std::string& text, double& v) {
    const Term first = primary();
    const bool minus = pick(4) == 0;
    text = (minus ? "-" : "") + first.text;
    v = minus ? -first.value : first.value;
    for (int n = pick(6); n > 0; --n) {
      const Term t = primary();
      const char op = "+-*/+-*/&!"[pick(10)];
      if ((op == '&' || op == '!') && !(whole_part_is_clear(v) && whole_part_is_clear(t.value))) return false;
      text += op + t.text;
      switch (op) {
        case '+': v += t.value; break;
        case '-': v -= t.value; break;
        case '*': v *= t.value; break;
        case '&':
        case '!': v = bits(v, t.value, op); break;
        default:
          if (std::fabs(t.value) < 0.05) return false;
          v /= t.value;
      }
      if (std::fabs(v) > 5000) return false;
    }
    return std::fabs(v) > 0.01;
  }

  std::mt19937 random_;
  std::array<double, 10> values_{};
  int known_ = 0;
};

class LeftToRight : public ::testing::TestWithParam<const char*> {};

TEST_P(LeftToRight, KeepsTheValueOfEveryChain) {
  const std::string to = GetParam();
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    Maker maker(seed);
    std::string text = "%7\n";
    std::vector<double> wanted;
    for (int i = 1; i <= 9; ++i) {
      const std::string n = std::to_string(i);
      text += maker.assignment(i) + "\nG0 X L" + n + " Y" + n + "\n";
      wanted.push_back(maker.value(i));
    }
    text += "M02\n";
    const auto path = std::filesystem::path(::testing::TempDir()) / ("chains-" + to + std::to_string(seed) + ".xpi");
    std::ofstream(path) << text;
    translator::TranslateOptions options;
    options.from = "num";
    options.to = to;
    options.verify = options.keep_traces = true;
    const auto result = translator::translate(path.string(), options);
    ASSERT_FALSE(result.refused) << text << render_text(result.diagnostics, result.files);
    EXPECT_TRUE(result.verdict.good()) << text << result.outputs.front().bytes;
    std::size_t i = 0;
    for (const auto& e : result.source_trace) {
      if (e.kind != interpreter::EventKind::rapid) continue;
      ASSERT_LT(i, wanted.size());
      EXPECT_NEAR(e.to.value[ir::axis::x], wanted[i], 1e-7) << "L" << i + 1 << " in\n" << text;
      ++i;
    }
    EXPECT_EQ(i, wanted.size()) << text;
    std::filesystem::remove(path);
  }
}

INSTANTIATE_TEST_SUITE_P(To, LeftToRight, ::testing::Values("fagor", "sinumerik"));

}  // namespace
}  // namespace cnctrans
