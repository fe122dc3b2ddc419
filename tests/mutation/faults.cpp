#include "tests/mutation/faults.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "tests/mutation/makers.h"

namespace cnctrans::mutation {

namespace {

using Maker = std::function<Maybe(const Place&)>;

const std::vector<std::pair<std::string, Maker>>& makers() {
  static const std::vector<std::pair<std::string, Maker>> table = {
      {"sign", [](const Place& p) { return value(p, geometric, other_sign); }},
      {"value", [](const Place& p) { return value(p, geometric, other_value); }},
      {"zero", [](const Place& p) { return value(p, geometric, [](const std::string&, Chance&) { return "0"; }); }},
      {"missing word", [](const Place& p) { return without_word(p, any_word); }},
      {"order", order},
      {"missing block", missing_block},
      {"doubled block", doubled_block},
      {"inserted way", inserted_way},
      {"feed",
       [](const Place& p) {
         const auto feed = [](const Word& w) { return w.name == "F" || w.name == "EF" || w.name == "P"; };
         return p.chance.one_in(4) ? without_word(p, feed) : value(p, feed, other_value);
       }},
      {"speed",
       [](const Place& p) {
         const auto speed = [](const Word& w) { return w.name == "S" || w.name == "LIMS"; };
         return p.chance.one_in(4) ? without_word(p, speed) : value(p, speed, other_value);
       }},
      {"motion",
       [](const Place& p) {
         return code(p, "G", {0, 1, 2, 3});
       }},
      {"plane",
       [](const Place& p) {
         return code(p, "G", {17, 18, 19});
       }},
      {"distance",
       [](const Place& p) {
         return code(p, "G", {90, 91});
       }},
      {"feed mode",
       [](const Place& p) {
         return code(p, "G", {94, 95, 96, 97});
       }},
      {"unit",
       [](const Place& p) {
         return p.dialect == "sinumerik" ? code(p, "G", {70, 71, 700, 710}) : code(p, "G", {70, 71});
       }},
      {"side",
       [](const Place& p) {
         return code(p, "G", {40, 41, 42});
       }},
      {"tool offset",
       [](const Place& p) {
         if (p.dialect == "fagor" && p.chance.one_in(2)) return code(p, "G", {43, 44});
         const auto offset = [](const Word& w) { return w.name == "D" || w.name == "T"; };
         if (p.chance.one_in(4)) return without_word(p, offset);
         return value(p, offset,
                      [](const std::string& old, Chance& c) { return c.one_in(2) ? "0" : number(number_of(old) + 1); });
       }},
      {"zero point",
       [](const Place& p) {
         return code(p, "G", {53, 54, 55, 56, 500, 52, 92, 59, 158});
       }},
      {"retract",
       [](const Place& p) {
         return p.dialect == "fagor" ? code(p, "G", {98, 99}) : cycle_value(p);
       }},
      {"path mode",
       [](const Place& p) {
         return code(p, "G", {5, 7, 9, 50, 60, 64, 601, 602});
       }},
      {"label", label},
      {"count", count},
      {"cycle value", cycle_value},
      {"cycle without", cycle_without},
      {"cycle with", cycle_with},
      {"M code",
       [](const Place& p) {
         return code(p, "M", {0, 1, 3, 4, 5, 6, 7, 8, 9, 10, 11, 19, 30, 41, 42});
       }},
      {"message", message},
      {"dwell", dwell},
      {"expression", expression},
      {"skip mark", skip_mark},
  };
  return table;
}

}  // namespace

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const auto& [name, maker] : makers()) out.push_back(name);
    return out;
  }();
  return names;
}

std::optional<Fault> fault(const std::string& kind, const Lines& lines, const std::string& dialect, bool lathe,
                           Chance& chance) {
  if (lines.empty()) return std::nullopt;
  for (const auto& [name, maker] : makers()) {
    if (name != kind) continue;
    auto made = maker({lines, dialect, lathe, chance});
    if (made) made->kind = kind;
    return made;
  }
  return std::nullopt;
}

std::optional<Lines> with_fault(const Lines& lines, const Fault& fault) {
  const auto stands_at = [&](std::size_t at) {
    return at + fault.before.size() <= lines.size() &&
           std::equal(fault.before.begin(), fault.before.end(), lines.begin() + static_cast<std::ptrdiff_t>(at));
  };
  std::size_t at = fault.at;
  if (!stands_at(at)) {
    at = 0;
    while (at < lines.size() && !stands_at(at)) ++at;
    if (at == lines.size()) return std::nullopt;
  }
  Lines now = lines;
  const auto from = now.begin() + static_cast<std::ptrdiff_t>(at);
  now.erase(from, from + static_cast<std::ptrdiff_t>(fault.before.size()));
  now.insert(now.begin() + static_cast<std::ptrdiff_t>(at), fault.after.begin(), fault.after.end());
  return now;
}

}  // namespace cnctrans::mutation
