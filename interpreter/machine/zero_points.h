// The zero points of a machine: the tables of work offsets and base frames, and what of them is in force.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "interpreter/values/frame.h"
#include "ir/axis.h"

namespace cnctrans::interpreter {

/// Rows are numbered as the program counts them (`ir/frame_rows.h`); lengths in mm, angles in degrees.
class ZeroPoints {
 public:
  /// The coarse part of a work offset; an axis that is missing has 0.
  using Row = std::map<ir::AxisId, double>;

  explicit ZeroPoints(std::map<std::int32_t, Row> rows) : coarse_(std::move(rows)) {}

  /// The program selects the row: it comes into force, and so do the base frames as they are stored now.
  void select(std::int32_t row);
  /// The row comes into force as it stands now.
  void load(std::int32_t row);
  /// What the machine has in force before any selection.
  void start_at(Row offset) { active_ = std::move(offset); }

  /// Everything outside of what the program puts with its own statements: base frames, and the settable one in them.
  [[nodiscard]] Frame outside() const { return base_.empty() ? settable() : compose(base(), settable()); }
  /// The base frames in force, from this one of them on.
  [[nodiscard]] Frame base(std::int32_t from = 0) const;
  /// The work offset in force.
  [[nodiscard]] Frame settable() const;
  /// What the tables hold at this row.
  [[nodiscard]] Frame stored(std::int32_t row) const;
  [[nodiscard]] double coarse(std::int32_t row, ir::AxisId axis) const { return value(coarse_, row, axis); }
  [[nodiscard]] double fine(std::int32_t row, ir::AxisId axis) const { return value(fine_, row, axis); }

  void set_coarse(std::int32_t row, ir::AxisId axis, double v);
  void set_fine(std::int32_t row, ir::AxisId axis, double v);
  /// The whole row of the table; its fine part is 0 then.
  void store(std::int32_t row, const Frame& f, const std::vector<ir::AxisId>& axes);
  /// What is in force, not the table.
  void set_settable(const Frame& f, const std::vector<ir::AxisId>& axes);
  void set_base(std::int32_t row, const Frame& f);

  [[nodiscard]] bool open() const { return open_; }        ///< no offset has been selected
  [[nodiscard]] bool written() const { return written_; }  ///< the program has written into the tables

 private:
  using Table = std::map<std::int32_t, Row>;
  static double value(const Table& table, std::int32_t row, ir::AxisId axis);
  static Row row_of(const Frame& f, const std::vector<ir::AxisId>& axes);

  Table coarse_;
  Table fine_;                           ///< added to the coarse part of the same row
  std::map<std::int32_t, Frame> shape_;  ///< turn, scale and mirror of a row; missing: none
  std::map<std::int32_t, Frame> base_;   ///< in force, outside of the settable frame; by row
  Row active_;                           ///< fine part included
  Frame active_shape_;
  bool open_ = true, written_ = false;
};

}  // namespace cnctrans::interpreter
