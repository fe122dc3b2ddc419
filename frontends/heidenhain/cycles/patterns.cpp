// Patterns (reference 15): the figures of PATTERN DEF, and the points that they and cycles 220 and 221 are.
#include <cmath>
#include <numbers>
#include <utility>

#include "base/noise.h"
#include "base/text.h"
#include "dialects/heidenhain/limits.h"
#include "frontends/heidenhain/cycles/build.h"
#include "frontends/heidenhain/state/lowering.h"
#include "frontends/heidenhain/state/term.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;

bool Lowering::pattern_def(const syntax::Statement& s) {
  Pattern& pattern = flat_.patterns.emplace_back();
  pattern.where = line_.span;
  const int index = static_cast<int>(flat_.patterns.size()) - 1;
  if (!figures(pattern)) return false;
  carried(s, true, "beside.data", "the points for CYCL CALL PAT; the sentence is kept as text");
  flat_.items.back().pattern = index;
  pattern_ = index;
  return true;
}

/// `POS1 (X+25 Y+33.5 Z+0)`, one or more.
bool Lowering::figures(Pattern& pattern) {
  Figure* figure = nullptr;
  const auto wrong = [&](WordPos pos, std::string text) {
    report_.refuse("HEI-029", pos, std::move(text), "see the figures POS, ROW, PAT, FRAME, CIRC and PITCHCIRC");
    return false;
  };
  for (const Word& w : block_->words) {
    const std::string address = to_upper_ascii(w.address);
    if (address == "(" || address == ")" || address == ",") continue;
    if (const auto* row = facts::find_figure(address)) {
      if (row->kind == facts::FigureKind::point && pattern.figures.size() >= facts::pattern_points)
        return wrong(w.pos, "PATTERN DEF takes nine points");
      figure = &pattern.figures.emplace_back();
      figure->kind = row->kind;
      continue;
    }
    if (figure == nullptr || !w.has_value)
      return wrong(w.pos, "`" + std::string(slice(w)) + "` means nothing in PATTERN DEF");
    const auto& row = facts::figure_row(figure->kind);
    if (!facts::in_words(row.needed, address) && !facts::in_words(row.allowed, address))
      return wrong(w.pos, std::string(row.word) + " has no word " + address);
    figure->words[address] = value(w);
  }
  for (const Figure& f : pattern.figures) {
    std::string_view rest = facts::figure_row(f.kind).needed;
    while (!rest.empty()) {
      const std::string_view word = rest.substr(0, rest.find(' '));
      if (f.words.count(std::string(word)) == 0)
        return wrong({}, std::string(facts::figure_row(f.kind).word) + " has no word " + std::string(word));
      rest.remove_prefix(std::min(word.size() + 1, rest.size()));
    }
  }
  return !report_.refused();
}

namespace {

double clean(double x) {
  return without_noise(x, 1e10);
}

/// Points of a grid or, `frame`, its outer ones.
std::vector<std::pair<double, double>> cells(double columns, double lines, bool frame) {
  std::vector<std::pair<double, double>> out;
  if (!frame) {
    for (double j = 0; j < lines; ++j) {
      for (double i = 0; i < columns; ++i) out.emplace_back(std::fmod(j, 2) == 0 ? i : columns - 1 - i, j);
    }
    return out;
  }
  for (double i = 0; i < columns; ++i) out.emplace_back(i, 0);
  for (double j = 1; j < lines; ++j) out.emplace_back(columns - 1, j);
  for (double i = columns - 2; i >= 0 && lines > 1; --i) out.emplace_back(i, lines - 1);
  for (double j = lines - 2; j > 0 && columns > 1; --j) out.emplace_back(0, j);
  return out;
}

}  // namespace

std::vector<Place> figure_places(const Pattern& pattern, Report& report) {
  std::vector<Place> places;
  const auto wrong = [&](const char* text) {
    report.keep("HEI-029", {}, text, "cycle.pattern");
    return std::vector<Place>{};
  };
  constexpr double most = 10'000, full = 360;
  for (const Figure& f : pattern.figures) {
    const auto word = [&f](const char* name) {
      const auto it = f.words.find(name);
      return it == f.words.end() ? Term(0) : Term(it->second);
    };
    const ir::Value height = word("Z").value();
    const Pair origin{word("X"), word("Y")};
    const auto add = [&](const Pair& at) { places.push_back({at.u.value(), at.v.value(), height}); };
    if (f.kind == facts::FigureKind::point) {
      add(origin);
      continue;
    }
    const bool grid = f.kind == facts::FigureKind::grid || f.kind == facts::FigureKind::frame;
    const Term columns = word(grid ? "NUMX" : "NUM"), lines = grid ? word("NUMY") : Term(1);
    for (const Term* n : {&columns, &lines}) {
      const bool good = n->literal() && n->number() >= 1 && n->number() == std::floor(n->number());
      if (!good || columns.number() * lines.number() > most)
        return wrong("the number of points of a figure must be a number, 1 or more");
    }
    const double count = columns.number();
    if (grid) {
      const Term along = word("ROT") + word("ROTX"), across = word("ROT") + word("ROTY");
      const Pair du = word("DX") * Pair{along.cosine(), along.sine()};
      const Pair dv = word("DY") * Pair{Term(0) - across.sine(), across.cosine()};
      for (const auto& [i, j] : cells(count, lines.number(), f.kind == facts::FigureKind::frame))
        add(origin + Term(i) * du + Term(j) * dv);
    } else if (f.kind == facts::FigureKind::row) {
      const Pair step = word("D") * Pair{word("ROT").cosine(), word("ROT").sine()};
      for (double i = 0; i < count; ++i) add(origin + Term(i) * step);
    } else {
      Term step = full / count;
      if (f.kind == facts::FigureKind::segment && f.words.count("STEP") != 0) step = word("STEP");
      if (f.kind == facts::FigureKind::segment && f.words.count("END") != 0)
        step = count > 1 ? (word("END") - word("START")) / Term(count - 1) : Term(0);
      for (double i = 0; i < count; ++i) {
        const Term angle = word("START") + Term(i) * step;
        add(origin + word("D") / Term(2) * Pair{angle.cosine(), angle.sine()});
      }
    }
  }
  return places;
}

std::vector<PatternPoint> pattern_points(const CycleDefinition& cycle, Report& report) {
  std::map<std::int16_t, double> n;
  for (const auto& [number, v] : cycle.values) {
    if (v.kind != QValue::Kind::value || !v.value.literal()) {
      report.keep("HEI-018", {}, "cycle " + std::to_string(cycle.number) + ": its parameters must be numbers",
                  "cycle.pattern");
      return {};
    }
    n[number] = v.value.number;
  }
  constexpr double most = 10'000;
  const double degrees = std::numbers::pi / 180;
  std::vector<PatternPoint> points;
  if (cycle.number == 220) {
    const double count = n[241], full = 360;
    if (!(count >= 1) || count > most || count != std::floor(count)) {
      report.refuse("HEI-018", {}, "cycle 220: Q241 is the number of machinings, 1 or more");
      return {};
    }
    if (n[365] != 0)
      report.warn("HEI-019", {}, "cycle 220: from point to point the tool goes straight, not along the circle (Q365=1)",
                  "see that nothing stands inside of the circle at this height");
    double step = n[247];
    const double span = n[246] - n[245];
    if (step == 0) {
      const bool round = std::abs(std::abs(span) - full) < 1e-9;
      step = round ? std::copysign(full / count, span) : count > 1 ? span / (count - 1) : 0;
    }
    for (double k = 0; k < count; ++k) {
      const double a = (n[245] + k * step) * degrees;
      points.push_back({clean(n[216] + n[244] / 2 * std::cos(a)), clean(n[217] + n[244] / 2 * std::sin(a))});
    }
    return points;
  }
  const double columns = n[242], lines = n[243];
  if (!(columns >= 1) || !(lines >= 1) || columns * lines > most || columns != std::floor(columns) ||
      lines != std::floor(lines)) {
    report.refuse("HEI-018", {}, "cycle 221: Q242 and Q243 are numbers of columns and lines, 1 or more");
    return {};
  }
  const double c = std::cos(n[224] * degrees), s = std::sin(n[224] * degrees);
  for (double j = 0; j < lines; ++j) {
    for (double i = 0; i < columns; ++i) {
      const double k = std::fmod(j, 2) == 0 ? i : columns - 1 - i;  // every other line backwards
      const double x = k * n[237], y = j * n[238];
      points.push_back({clean(n[225] + x * c - y * s), clean(n[226] + x * s + y * c)});
    }
  }
  return points;
}

}  // namespace cnctrans::frontends::heidenhain
