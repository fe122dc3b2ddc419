// Where the tool is along the text, and in which direction the path leads, as far as the text alone says it.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "frontends/heidenhain/state/flat.h"
#include "frontends/heidenhain/state/term.h"

namespace cnctrans::frontends::heidenhain {

class Way {
 public:
  explicit Way(const Flat& flat);
  /// Where the items stand while those of the program are rewritten.
  void read_ahead_in(const std::vector<Item>& items) { ahead_ = &items; }

  /// Before the next item: where lines before it that may be skipped lead is not known.
  void comes_to(const Item& item);
  /// Over the next item.
  void step(const Item& item);

  [[nodiscard]] ir::PlaneAxes plane() const { return ir::plane_axes(plane_); }
  /// In the plane; nullopt: not known here.
  [[nodiscard]] std::optional<Pair> point() const;
  [[nodiscard]] std::optional<Term> coordinate(ir::AxisId axis) const { return at_[axis]; }
  [[nodiscard]] const std::optional<Pair>& pole() const { return pole_; }
  /// Of the last element at its end, of length 1.
  [[nodiscard]] const std::optional<Pair>& direction() const { return direction_; }
  /// Of an element that begins here, of length 1. It does not move in the plane: nullopt.
  [[nodiscard]] std::optional<Pair> start_direction(const Item& element) const;
  /// The end of the block's motion in the plane.
  [[nodiscard]] std::optional<Pair> end_of(const ir::Motion& motion) const;
  /// RL 1, RR -1, R0 0; nullopt: not known here.
  [[nodiscard]] std::optional<int> side() const { return side_; }
  /// The last positioning block was FMAX; nullopt: not known here.
  [[nodiscard]] std::optional<bool> rapid() const { return rapid_; }
  /// F in force; nullopt: not known here by a number.
  [[nodiscard]] std::optional<double> feed() const { return feed_; }

 private:
  void forget();
  void move(const Item& item);
  void call(const Item& item);
  void set_pole(const Pole& pole);
  void note_call(const Item& item);
  bool enter(const Item& label);
  bool stay_in_loop(const Item& label);
  void leave_open(const Item& item);
  bool join(const Way& other);
  [[nodiscard]] std::optional<Pair> centre_of(const Item& item, const std::optional<Pair>& end) const;
  [[nodiscard]] std::optional<Pair> chord(const ir::Motion& m) const;

  const Flat& flat_;
  const std::vector<Item>* ahead_;
  std::set<std::string> targets_;  ///< labels to which something leads
  using Place = std::array<std::optional<Term>, 9>;
  Place at_;
  /// What the calls of a label agree on.
  struct Calls {
    int left = 0;         ///< calls that stand further on in the text
    bool jumped = false;  ///< a jump or a repeat leads here, too
    bool some = false;
    bool before = false;              ///< something leads here that stands before the label
    std::size_t first = 0, last = 0;  ///< the items of the label, and of the last jump or repeat that leads back here
    std::optional<bool> rapid;
    std::optional<double> feed;
    Place at;
    std::optional<int> side;
  };
  std::map<std::string, Calls> calls_;
  std::uint16_t skip_mask_ = 0;  ///< of the line before: what it may leave out is not known behind it
  bool dead_ = false;            ///< behind a program end: nothing comes here but to a label
  bool sub_dead_ = false;        ///< the same at the label of the subprogram at hand
  std::optional<Pair> pole_, direction_;
  ir::Plane plane_ = ir::Plane::xy;
  std::optional<int> side_ = 0;
  std::optional<bool> rapid_ = false;
  std::optional<double> feed_;
  int cycle_ = -1;  ///< the definition of the text above
};

/// A number of a label and a name are different.
std::string label_key(const Item& item);

}  // namespace cnctrans::frontends::heidenhain
