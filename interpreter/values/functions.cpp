#include "interpreter/values/functions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/trace/run_codes.h"
#include "interpreter/values/expressions.h"
#include "interpreter/values/frame.h"

namespace cnctrans::interpreter {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

double out_of_domain(Failure& failure, std::string text) {
  failure.fail(code::function_domain, std::move(text));
  return 0;
}

std::size_t arity(ir::Function f) {
  switch (f) {
    case ir::Function::atan2:
    case ir::Function::arg:
    case ir::Function::min:
    case ir::Function::max: return 2;
    case ir::Function::bound: return 3;
    default: return 1;
  }
}

/// Angles of the arc functions, exact where the argument is.
double asin_degrees(double x) {
  if (x == 0.5) return 30;
  if (x == -0.5) return -30;
  return std::asin(x) * degrees;
}
double atan_degrees(double x) {
  return std::abs(x) == 1 ? 45 * x : std::atan(x) * degrees;
}
double atan2_degrees(double y, double x) {
  if (y == 0) return x < 0 ? 180 : 0;
  if (x == 0) return y > 0 ? 90 : -90;
  if (std::abs(x) == std::abs(y)) return (x > 0 ? 45 : 135) * (y > 0 ? 1 : -1);
  return std::atan2(y, x) * degrees;
}

double tangent(double x, Failure& failure) {
  const double c = cos_degrees(x);
  if (c == 0) return out_of_domain(failure, "the tangent of " + number_text(x) + " degrees has no value");
  if (std::fmod(std::abs(x), 90) == 45) return sin_degrees(x) * c > 0 ? 1 : -1;
  return sin_degrees(x) / c;
}

double to_bcd(double x, Failure& failure) {
  auto rest = std::llround(x);
  if (rest < 0 || rest > 99'999'999) return out_of_domain(failure, "BCD takes 0 to 99999999");
  std::int64_t bcd = 0;
  for (unsigned shift = 0; rest > 0; shift += 4, rest /= 10) bcd |= (rest % 10) << shift;
  return static_cast<double>(bcd);
}

/// A number with a digit above 9 is no BCD code: it is binary already: $AB is 171.
double from_bcd(double x) {
  auto rest = std::llround(x);
  std::int64_t value = 0, unit = 1;
  for (; rest > 0; rest >>= 4, unit *= 10) {
    if ((rest & 15) > 9) return x;
    value += (rest & 15) * unit;
  }
  return static_cast<double>(value);
}

double one_argument(ir::Function f, ir::RoundHalf half, double x, Failure& failure) {
  switch (f) {
    case ir::Function::sin: return sin_degrees(x);
    case ir::Function::cos: return cos_degrees(x);
    case ir::Function::tan: return tangent(x, failure);
    case ir::Function::asin:
    case ir::Function::acos:
      if (std::abs(x) > 1 + 1e-12)
        return out_of_domain(failure, "arc sine and cosine take -1 to 1, not " + number_text(x));
      x = std::clamp(x, -1.0, 1.0);
      return f == ir::Function::asin ? asin_degrees(x) : 90 - asin_degrees(x);
    case ir::Function::atan: return atan_degrees(x);
    case ir::Function::sqrt:
      if (x < 0) return out_of_domain(failure, "square root of the negative number " + number_text(x));
      return std::sqrt(x);
    case ir::Function::square: return x * x;
    case ir::Function::exp: return std::exp(x);
    case ir::Function::ln:
    case ir::Function::log10:
      if (x <= 0) return out_of_domain(failure, "logarithm of " + number_text(x));
      return f == ir::Function::ln ? std::log(x) : std::log10(x);
    case ir::Function::abs: return std::abs(x);
    case ir::Function::sign: return x > 0 ? 1 : (x < 0 ? -1 : 0);
    case ir::Function::trunc: return std::trunc(x);
    case ir::Function::ceil: return std::ceil(x);
    case ir::Function::floor: return std::floor(x);
    case ir::Function::round:
    case ir::Function::to_integer: return rounded_half(x, half);
    case ir::Function::to_boolean: return x != 0 ? 1 : 0;
    case ir::Function::to_bcd: return to_bcd(x, failure);
    case ir::Function::from_bcd: return from_bcd(x);
    default: break;
  }
  return x;
}

}  // namespace

double rounded_half(double x, ir::RoundHalf half) {
  switch (half) {
    case ir::RoundHalf::up: return std::floor(x + 0.5);
    case ir::RoundHalf::even: return std::nearbyint(x);
    case ir::RoundHalf::away: break;
  }
  return std::round(x);
}

bool takes_text(ir::Function f) {
  switch (f) {
    case ir::Function::string_length:
    case ir::Function::index_of:
    case ir::Function::last_index_of:
    case ir::Function::index_of_any:
    case ir::Function::character_code:
    case ir::Function::to_number:
    case ir::Function::is_number: return true;
    default: return false;
  }
}

std::int32_t to_int32(double x, Failure& failure) {
  const double t = std::trunc(x);
  if (t >= -2147483648.0 && t <= 2147483647.0) return static_cast<std::int32_t>(t);
  if (t > 0 && t <= 4294967295.0) return static_cast<std::int32_t>(static_cast<std::uint32_t>(t));
  failure.fail(code::number_range, number_text(x) + " does not fit into 32 bits");
  return 0;
}

double numeric_function(ir::Function f, ir::RoundHalf half, std::span<const double> args, Failure& failure) {
  if (args.size() < arity(f)) {
    failure.fail(code::argument, "function " + std::string(ir::name(f)) + " lacks an argument");
    return 0;
  }
  double value = 0;
  switch (f) {
    case ir::Function::atan2: return atan2_degrees(args[0], args[1]);
    case ir::Function::arg: value = atan2_degrees(args[1], args[0]); return value < 0 ? value + 360 : value;
    case ir::Function::min: return std::min(args[0], args[1]);
    case ir::Function::max: return std::max(args[0], args[1]);
    case ir::Function::bound: return std::min(std::max(args[2], args[0]), args[1]);
    default: value = one_argument(f, half, args[0], failure);
  }
  if (std::isfinite(value)) return value;
  failure.fail(code::number_range, "the result of " + std::string(ir::name(f)) + " is out of the range of numbers");
  return 0;
}

}  // namespace cnctrans::interpreter
