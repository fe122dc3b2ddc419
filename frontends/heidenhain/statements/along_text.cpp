// What holds along the text and decides how a line is read. A subprogram behind the program end is read as at its first
// call; whether the ways bring the same state to each item is checked when they are known (program/ways_of_text.cpp).
#include <string>

#include "base/text.h"
#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

namespace {

std::string key_of(const ir::Value& v) {
  return v.literal() ? shortest(v.number) : std::to_string(reinterpret_cast<std::uintptr_t>(v.expr.get()));
}

std::int16_t number_of(std::map<std::string, std::int16_t>& known, const std::string& key) {
  return known.emplace(key, static_cast<std::int16_t>(known.size() + 1)).first->second;
}

}  // namespace

Along Lowering::along() const {
  const auto per_rev = static_cast<std::int16_t>(!feed_by_fu_ ? 0 : per_rev_ ? 2 : 1);
  return {tilt_id_,
          contours_id_,
          static_cast<std::int16_t>(contour_data_ + 1),
          static_cast<std::int16_t>(train_data_ + 1),
          per_rev,
          static_cast<std::int16_t>(shortest_ ? 1 : 0)};
}

void Lowering::mark_along(Item& item) {
  const Along now = along();
  for (std::size_t k = 0; k < along_text; ++k) {
    const auto kind = static_cast<AlongText>(k);
    const bool whole = kind == AlongText::contours || kind == AlongText::data || kind == AlongText::train;
    if (sets_[k]) item.sets[k] = now[k];
    item.relies[k] = relies_[k] && !(whole && sets_[k]);
  }
  item.before = before_;
  before_ = now;
  sets_.fill(false);
  relies_.fill(false);
}

void Lowering::contours_set() {
  std::string key;
  for (const auto& label : contour_labels_) key += label + ' ';
  contours_id_ = number_of(contours_, key);
  sets(AlongText::contours);
}

void Lowering::tilt_set() {
  sets(AlongText::tilt);
  tilt_id_ = 0;
  if (!tilt_) return;
  std::string key;
  for (const auto& a : tilt_->angles) key += key_of(a) + ' ';
  for (const auto& [axis, v] : tilt_->shift) key += v.is(0) ? "" : std::to_string(axis) + key_of(v) + ' ';
  for (const auto& c : tilt_->inner) {
    key += std::to_string(static_cast<int>(c.kind)) + key_of(c.angle);
    for (const auto& w : c.words) key += ' ' + std::to_string(w.axis) + key_of(w.value);
  }
  tilt_id_ = number_of(tilts_, key);
}

/// Index of what holds here.
int Lowering::held() {
  held_.push_back({tilt_, outer_, contour_labels_, tilt_id_, contours_id_, contour_data_, train_data_, tool_axis_,
                   feed_by_fu_, per_rev_, shortest_, tool_feed_, speed_, orient_, radius_});
  return static_cast<int>(held_.size()) - 1;
}

void Lowering::hold(const Held& h) {
  tilt_ = h.tilt;
  outer_ = h.outer;
  contour_labels_ = h.contour_labels;
  tilt_id_ = h.tilt_id;
  contours_id_ = h.contours_id;
  contour_data_ = h.contour_data;
  train_data_ = h.train_data;
  tool_axis_ = h.tool_axis;
  feed_by_fu_ = h.feed_by_fu;
  per_rev_ = h.per_rev;
  shortest_ = h.shortest;
  tool_feed_ = h.tool_feed;
  speed_ = h.speed;
  orient_ = h.orient;
  radius_ = h.radius;
  before_ = along();
}

void Lowering::open_program(const Item& call, const Span& where) {
  part_ = true;
  line_ = ir::LineInfo{};
  line_.span = where;
  line_.labels.push_back(program_.keep(call.label));
  first_ = true;
  put(ItemKind::label, ir::Label{}).label = call.label;
  hold(held_[static_cast<std::size_t>(call.held)]);
}

/// Index of a share of F (M103).
int Lowering::plunge_share(std::optional<ir::Value> share) {
  auto& all = flat_.plunges;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].has_value() == share.has_value() && (!share || ir::equal(*all[k], *share))) return static_cast<int>(k);
  }
  all.push_back(std::move(share));
  return static_cast<int>(all.size()) - 1;
}

}  // namespace cnctrans::frontends::heidenhain
