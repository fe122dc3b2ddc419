#include "interpreter/machine/zero_points.h"

#include "ir/frame_rows.h"

namespace cnctrans::interpreter {

namespace rows = ir::frame_rows;

void ZeroPoints::select(std::int32_t row) {
  open_ = false;
  load(row);
  for (auto it = shape_.lower_bound(rows::stored_base); it != shape_.end() && it->first < rows::active_base; ++it) {
    Frame f = it->second;
    for (const auto& [axis, v] : coarse_[it->first]) f.t[axis] += v;
    base_[it->first - rows::stored_base + rows::active_base] = f;
  }
}

void ZeroPoints::load(std::int32_t row) {
  active_.clear();
  active_shape_ = Frame{};
  if (const auto it = coarse_.find(row); it != coarse_.end()) active_ = it->second;
  if (const auto it = fine_.find(row); it != fine_.end()) {
    for (const auto& [axis, v] : it->second) active_[axis] += v;
  }
  if (const auto it = shape_.find(row); it != shape_.end()) active_shape_ = it->second;
}

Frame ZeroPoints::base(std::int32_t from) const {
  Frame f;
  for (const auto& [row, part] : base_) {
    if (row >= rows::active_base + from) f = compose(f, part);
  }
  return f;
}

Frame ZeroPoints::settable() const {
  Frame f = active_shape_;
  f.t = {};
  for (const auto& [axis, v] : active_) f.t[axis] = v;
  return f;
}

Frame ZeroPoints::stored(std::int32_t row) const {
  if (row == rows::total_base) return base(rows::own_base);
  if (const auto it = base_.find(row); it != base_.end()) return it->second;
  Frame out;
  if (const auto it = shape_.find(row); it != shape_.end()) out = it->second;
  for (const auto* table : {&coarse_, &fine_}) {
    const auto it = table->find(row);
    if (it == table->end()) continue;
    for (const auto& [axis, v] : it->second) out.t[axis] += v;
  }
  return out;
}

double ZeroPoints::value(const Table& table, std::int32_t row, ir::AxisId axis) {
  const auto it = table.find(row);
  if (it == table.end()) return 0;
  const auto at = it->second.find(axis);
  return at == it->second.end() ? 0 : at->second;
}

ZeroPoints::Row ZeroPoints::row_of(const Frame& f, const std::vector<ir::AxisId>& axes) {
  Row row;
  for (const auto a : axes) {
    if (f.t[a] != 0) row[a] = f.t[a];
  }
  return row;
}

void ZeroPoints::set_coarse(std::int32_t row, ir::AxisId axis, double v) {
  written_ = true;
  coarse_[row][axis] = v;
}

void ZeroPoints::set_fine(std::int32_t row, ir::AxisId axis, double v) {
  written_ = true;
  fine_[row][axis] = v;
}

void ZeroPoints::store(std::int32_t row, const Frame& f, const std::vector<ir::AxisId>& axes) {
  written_ = true;
  coarse_[row] = row_of(f, axes);
  fine_.erase(row);
  shape_[row] = f.linear_part();
}

void ZeroPoints::set_settable(const Frame& f, const std::vector<ir::AxisId>& axes) {
  written_ = true;
  active_ = row_of(f, axes);
  active_shape_ = f.linear_part();
}

void ZeroPoints::set_base(std::int32_t row, const Frame& f) {
  written_ = true;
  base_[row] = f;
}

}  // namespace cnctrans::interpreter
