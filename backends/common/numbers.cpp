#include "backends/common/numbers.h"

#include <cmath>

#include "base/text.h"

namespace cnctrans::backends {

bool plain_number(std::string_view text) {
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
  bool digit = false;
  bool point = false;
  for (const char c : text) {
    if (c >= '0' && c <= '9') {
      digit = true;
    } else if (c == '.' && !point) {
      point = true;
    } else {
      return false;
    }
  }
  return digit;
}

int decimals_of(std::string_view text) {
  const auto point = text.find('.');
  return point == std::string_view::npos ? 0 : static_cast<int>(text.size() - point - 1);
}

double append_number(std::string& out, double number, std::string_view text, const NumberFormat& format) {
  if (!text.empty() && format.verbatim) {
    out += text;
    return 0;
  }
  int decimals = format.made_decimals;
  if (plain_number(text)) {
    if (decimals_of(text) <= format.kept_decimals) {
      if (text.front() == '+') text.remove_prefix(1);
      out += text;
      return 0;
    }
    decimals = format.kept_decimals;
  }
  const std::string written = rounded(number, decimals);
  out += written;
  const auto value = parse_decimal(written);
  const double change = value ? std::abs(*value - number) : 0;
  return change > 1e-12 * std::abs(number) ? change : 0;
}

}  // namespace cnctrans::backends
