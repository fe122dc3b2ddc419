// Contours of milling cycles as words, and the line at a distance from them.
#include "ir/cycles/milling/mill_contour.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ir/cycles/contour.h"
#include "ir/cycles/words.h"

namespace cnctrans::ir::cycles {

namespace {

constexpr std::string_view data_word = "contour", fault_word = "contour_fault", role_word = "contour_role",
                           surface_word = "contour_surface", height_word = "contour_height";

bool whole_circle(const MillElement& e) {
  return e.arc && std::abs(e.u1 - e.u0) < 1e-9 && std::abs(e.v1 - e.v0) < 1e-9;
}

}  // namespace

bool is_contour_word(std::string_view word) {
  constexpr std::array words = {std::string_view("routine"), std::string_view("first_label"),
                                std::string_view("last_label"), std::string_view("program")};
  return word.starts_with(data_word) || std::find(words.begin(), words.end(), word) != words.end();
}

std::vector<NamedCycle> contours_named(const HoleCycle& cycle) {
  std::vector<NamedCycle> out;
  for (const auto& [word, v] : cycle.mill.words) {
    if (!is_contour_word(word) || word == data_word || word == fault_word || word == surface_word ||
        word == height_word)
      continue;
    if (out.empty() || word == role_word) out.push_back({cycle.mill.shape, {}});
    out.back().words.emplace_back(word, v);
  }
  return out;
}

bool has_contours(const HoleCycle& cycle) {
  const auto& words = cycle.mill.words;
  return std::any_of(words.begin(), words.end(), [](const auto& w) { return is_contour_word(w.first); });
}

std::vector<RoutineName> contour_routines(const Cycle& cycle) {
  std::vector<RoutineName> out;
  const auto add = [&out](const NamedCycle& named) {
    if (auto name = profile_routine(named)) out.push_back(*std::move(name));
  };
  if (const auto* named = std::get_if<NamedCycle>(&cycle.node)) add(*named);
  const auto* hole = std::get_if<HoleCycle>(&cycle.node);
  if (hole == nullptr || hole->kind != HoleKind::mill) return out;
  for (const auto& named : contours_named(*hole)) add(named);
  return out;
}

void put_contours(HoleCycle& cycle, const std::vector<MillContour>& contours) {
  if (!contours.empty() && contours.front().surface)
    cycle.mill.words.emplace_back(std::string(surface_word), Value(*contours.front().surface));
  if (!contours.empty()) {
    for (const double h : contours.front().heights) cycle.mill.words.emplace_back(std::string(height_word), Value(h));
  }
  for (std::size_t i = 0; i < contours.size(); ++i) {
    for (const auto& e : contours[i].elements) {
      const double kind = e.arc ? (e.ccw ? 2 : 1) : 0;
      for (const double n : {static_cast<double>(i), kind, e.u0, e.v0, e.u1, e.v1, e.cu, e.cv})
        cycle.mill.words.emplace_back(std::string(data_word), Value(n));
    }
  }
}

void put_contour_fault(HoleCycle& cycle, const std::string& why) {
  cycle.mill.words.emplace_back(std::string(fault_word), Value(string_literal(why)));
}

std::optional<std::vector<MillContour>> contours_in(const HoleCycle& cycle, std::string* error) {
  std::vector<double> n, heights;
  std::optional<double> surface;
  for (const auto& [name, v] : cycle.mill.words) {
    if (name == data_word && v.literal()) n.push_back(v.number);
    if (name == surface_word && v.literal()) surface = v.number;
    if (name == height_word && v.literal()) heights.push_back(v.number);
    if (const auto* why = text_in(v); why != nullptr && name == fault_word) return *error = *why, std::nullopt;
  }
  if (n.empty()) return *error = "its contour has not been read", std::nullopt;
  std::vector<MillContour> out;
  for (std::size_t i = 0; i + numbers_per_element <= n.size(); i += numbers_per_element) {
    const auto at = static_cast<std::size_t>(n[i]);
    if (out.size() <= at) out.resize(at + 1);
    out[at].elements.push_back(
        {n[i + 2], n[i + 3], n[i + 4], n[i + 5], n[i + 1] != 0, n[i + 1] == 2, n[i + 6], n[i + 7]});
  }
  out.front().surface = surface;
  out.front().heights = std::move(heights);
  return out;
}

Direction direction_at(const MillElement& e, bool at_end) {
  if (e.arc) {
    const double ru = (at_end ? e.u1 : e.u0) - e.cu, rv = (at_end ? e.v1 : e.v0) - e.cv, r = std::hypot(ru, rv);
    const double s = e.ccw ? 1 : -1;
    return {-s * rv / r, s * ru / r};
  }
  const double l = std::hypot(e.u1 - e.u0, e.v1 - e.v0);
  return {(e.u1 - e.u0) / l, (e.v1 - e.v0) / l};
}

std::optional<std::vector<MillElement>> parallel(const std::vector<MillElement>& way, double d, bool left,
                                                 std::string* error) {
  if (d < 1e-9) return way;
  // The chain keeps to the right of its way: the left side is that of the mirror image.
  const double m = left ? -1 : 1;
  const auto role = [m](double u, double v) { return detail::RolePoint{m * v, u}; };
  detail::Chain chain;
  for (const auto& e : way) {
    detail::Piece piece{role(e.u0, e.v0), role(e.u1, e.v1), e.arc, e.ccw != left, role(e.cu, e.cv)};
    if (!whole_circle(e)) {
      chain.push_back(piece);
      continue;
    }
    const detail::RolePoint far{2 * piece.c.p - piece.a.p, 2 * piece.c.q - piece.a.q};
    detail::Piece second = piece;
    piece.b = second.a = far;
    chain.push_back(piece);
    chain.push_back(second);
  }
  const auto moved = detail::offset(chain, d, error);
  if (!moved) return *error = "the allowance does not fit into the contour", std::nullopt;
  if (moved->empty()) return *error = "the allowance leaves nothing of the contour", std::nullopt;
  std::vector<MillElement> out;
  for (const auto& x : *moved)
    out.push_back({x.a.q, m * x.a.p, x.b.q, m * x.b.p, x.arc, x.ccw != left, x.c.q, m * x.c.p});
  return out;
}

}  // namespace cnctrans::ir::cycles
