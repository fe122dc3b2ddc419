// The tool of a machine: the one selected, the one in the spindle, and the offset in force.
#pragma once

#include <cstdint>
#include <string>

#include "interpreter/trace/trace.h"
#include "ir/modal.h"
#include "machine/profile.h"

namespace cnctrans::interpreter {

class ToolInUse {
 public:
  explicit ToolInUse(const machine::Profile& profile);

  [[nodiscard]] std::int32_t selected() const { return selected_; }
  [[nodiscard]] std::int32_t in_spindle() const { return in_spindle_; }
  [[nodiscard]] std::int32_t offset() const { return offset_; }
  /// The one in the spindle; before the first change, the one selected.
  [[nodiscard]] std::int32_t number() const { return in_spindle_ != 0 ? in_spindle_ : selected_; }
  [[nodiscard]] bool came_with_t() const { return came_with_t_; }

  /// T. `with_t`: it changes the tool, M6 has nothing left to do. `own_offset`: a D stands beside it.
  void select(std::int32_t number, std::string name, bool with_t);
  void offset_of_selected(bool own_offset) { bare_ = !own_offset; }
  void select_offset(std::int32_t number);
  /// What the change makes of the offset.
  void offset_of_change(bool own_offset);
  /// The event of the selection or of the change.
  void show(Event& e, bool change);
  /// For a question about another tool, whose words a cycle has: the numbers alone.
  void pretend(std::int32_t number, std::int32_t offset);
  void length_compensation_said() { length_said_ = true; }

  /// The axes that move take the offset in force with them, the others stand as they stood. On a mill the length acts
  /// along the tool, and the radius in the plane under compensation; on a lathe both act on all axes.
  /// `moved`: bit n: axis n moves.
  void put_offset(Event& e, std::uint32_t moved, const ir::ModalState& modal) const;

 private:
  /// The offset in force: whether it is one, is none (D0), or that the control's own rule leaves it open.
  enum class OffsetUse : std::uint8_t { open, none, some };

  bool of_table_, of_edge_;  ///< what a tool without a D has; none of them: the offset in force stays
  bool mill_;
  ir::Plane usual_plane_;
  std::int32_t selected_ = 0, in_spindle_ = 0, offset_ = 0;
  std::string name_;
  OffsetUse use_ = OffsetUse::open;
  bool bare_ = false;        ///< no D since its T
  bool of_machine_ = false;  ///< the offset is the one that the machine gives a tool without a D
  bool came_with_t_;
  bool length_said_ = false;  ///< the program has switched the length compensation on or off
};

}  // namespace cnctrans::interpreter
