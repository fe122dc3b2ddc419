#include "verifier/dwells.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text.h"

namespace cnctrans::verifier {

using interpreter::EventKind;

Dwells::Dwells(const std::vector<const interpreter::Event*>& trace, std::size_t from) {
  for (; from < trace.size() && trace[from]->kind == EventKind::dwell; ++from) {
    const auto& e = *trace[from];
    parts.push_back(&e);
    (e.revolutions ? turns[e.number] : seconds) += e.amount;
  }
}

bool Dwells::same(const Dwells& other, const SpindleSpeeds& rpm, double tolerance) const {
  const auto near = [tolerance](double a, double b) { return std::fabs(a - b) <= tolerance; };
  const auto one_by_one = [&near](const interpreter::Event* a, const interpreter::Event* b) {
    return a->revolutions == b->revolutions && (!a->revolutions || a->number == b->number) &&
           near(a->amount, b->amount);
  };
  if (std::equal(parts.begin(), parts.end(), other.parts.begin(), other.parts.end(), one_by_one)) return true;
  const auto whole = [&rpm](const Dwells& d) -> std::optional<double> {
    double sum = d.seconds;
    for (const auto& [spindle, turned] : d.turns) {
      const auto speed = rpm.find(spindle);
      if (speed == rpm.end() || speed->second <= 0) return std::nullopt;
      sum += turned * 60 / speed->second;
    }
    return sum;
  };
  if (turns.empty() != other.turns.empty()) {
    const auto a = whole(*this), b = whole(other);
    return a && b && near(*a, *b);
  }
  return near(seconds, other.seconds) &&
         std::equal(turns.begin(), turns.end(), other.turns.begin(), other.turns.end(),
                    [&near](const auto& a, const auto& b) { return a.first == b.first && near(a.second, b.second); });
}

std::string Dwells::said() const {
  std::string text;
  for (const auto& [spindle, turned] : turns) {
    text += (text.empty() ? "" : " and ") + shortest(turned) + " revolutions";
    if (spindle > 1) text += " of spindle " + std::to_string(spindle);
  }
  if (seconds != 0 || text.empty()) text += (text.empty() ? "" : " and ") + shortest(seconds) + " s";
  return text;
}

}  // namespace cnctrans::verifier
