// ISO blocks: words to actions and at most one motion. The hot path of a CAM file.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "dialects/fagor/cycles.h"
#include "frontends/common/syntax.h"
#include "frontends/fagor/state/state.h"
#include "ir/block.h"

namespace cnctrans::fagor {

/// What a block is besides its ir::Block.
struct BlockResult {
  const syntax::Word* end = nullptr;   ///< M30 or M02: the program ends after the block
  const syntax::Word* call = nullptr;  ///< G180...: the block is a call of the subroutine of that number
  std::string_view opaque;             ///< not empty: the block is kept as text; key of the missing feature
  bool harmless = false;               ///< with `opaque`: no effect on the path
  bool needs_program = false;          ///< depends on the rest of the file: no streaming
};

class BlockLowerer {
 public:
  explicit BlockLowerer(LowerState& state) : state_(state) {}
  /// `out` is cleared and filled; after an error it is worthless and `result.opaque` says so.
  void lower(const syntax::Block& in, ir::Block& out, BlockResult& result);

 private:
  using GCode = dialects::fagor::GCode;
  using Word = syntax::Word;
  struct GWord {
    const GCode* row;
    const Word* word;
  };
  static constexpr std::size_t max_g = 16, max_m = 16;

  // collecting
  void gather(const syntax::Block& in);
  void gather_g(const Word& w);
  const GCode* fixed_function(const Word& w);
  void gather_m(const Word& w);
  void check_groups();
  [[nodiscard]] const Word* letter(char c) const { return (seen_ & bit(c)) != 0 ? letters_[index(c)] : nullptr; }
  const Word* take(char c);
  static constexpr std::size_t index(char c) { return static_cast<std::size_t>(c - 'A'); }
  static constexpr std::uint32_t bit(char c) { return 1U << index(c); }
  ir::Value value(const Word& w);
  ir::Value value_of(char c);
  template <class Data>
  ir::Action& act(Data data, const Word* word, ir::Order order = ir::Order::before);

  // G functions
  void apply(const GWord& g);
  void apply_offset(const GWord& g);
  void apply_frame(const GWord& g);
  void inclined_plane(const GWord& g);
  void along_the_tool(const GWord& g, bool by_axes);
  void plane_by_angles(const GWord& g);
  void assume_plane(const GWord& g, const ir::Value& i, const ir::Value& j, bool third);
  [[nodiscard]] bool full_retract(int code) const;
  void apply_special(const GWord& g);
  void setting(const GWord& g, ir::Order order);
  void compensation(const GWord& g);
  void plane(const GWord& g, ir::Plane p, bool turned = false);
  void turned_plane(const GWord& g, ir::Plane p);
  [[nodiscard]] ir::PlaneAxes directions();
  void plane_axes(const GWord& g);
  void dwell(const GWord& g);
  void corner(const GWord& g);
  void pole(const GWord& g);
  void rotation(const GWord& g);
  void look_ahead(const GWord& g);
  void hole_cycle(const GWord& g);
  void machining_cycle(const GWord& g);
  void pattern(const GWord& g);
  void pocket_cycle(const GWord& g);
  bool pocket_value(const Word& w, std::string_view parameter);
  void change_cycle(const GWord& g);
  void end_cycle();
  bool change_further(const GWord& g, int code, ir::HoleCycle& c, bool& changed);
  bool change_pecks(ir::HoleCycle& c, bool& changed);
  bool change_equal_pecks(const GWord& g, const Word* i, const Word* j, ir::HoleCycle& c);
  bool cycle_parameters(const GWord& g, const std::array<const Word*, 26>& words, ir::HoleCycle& c);
  bool gather_cycle_word(const Word& w, char c);
  const Word* take_coordinate(ir::AxisId axis);
  const Word* take_cycle_word(char c, const Word& depth);
  bool equal_pecks(const GWord& g, const Word& count, ir::HoleCycle& c);
  void surface_below(const GWord& g, const Word& d, ir::HoleCycle& c);
  bool pocket_letter(const Word& w, char letter, bool zero_refused);
  bool pocket_words(const GWord& g, const std::array<const Word*, 26>& words, ir::HoleCycle& c);
  bool change_pocket(int code, ir::HoleCycle& c, bool& changed);
  bool variable_pecks(const GWord& g, const std::array<const Word*, 26>& words, ir::HoleCycle& c);
  [[nodiscard]] ir::Value one_millimetre() const;
  void home(const GWord& g);
  void compensations_off();
  void longitudinal_axis(const GWord& g);
  void c_axis(const GWord& g);
  bool surface_plane(const GWord& g);
  void leave_surface(ir::Order order = ir::Order::before);
  bool surface_coordinate(ir::CoordWord& c, const Word& w);
  [[nodiscard]] ir::AxisId center_axis(const Word& w);
  void note_surface();
  void choose_spindle(const GWord& g);
  void couple_spindles(const GWord& g);
  void marker(const GWord& g, std::string_view feature);
  static std::string_view spelling(const Word& code, const Word& last);
  void live_tool(const Word& code);
  void give_up(const GWord& g);
  bool ends_nothing(const GWord& g);
  void keep(const GWord& g, std::string_view feature, std::string message);
  std::shared_ptr<const ir::FrameChange> frame_of(ir::FrameSlot slot, ir::FrameKind kind, ir::FrameCombine combine);
  void take_coordinates_into(ir::FrameChange& change);
  const Word* corner_radius(const Word& code);

  // the rest of the block
  void motion();
  void coordinates(ir::Motion& m);
  void rotary(ir::CoordWord& c, const Word& w);
  void centers(ir::Motion& m);
  void radius_and_polar(ir::Motion& m);
  bool in_plane(const ir::Motion& m);
  [[nodiscard]] bool cuts_thread(const ir::Motion& m) const;
  void thread(ir::Motion& m);
  void technology();
  void machine_functions();
  void machine_function(const Word& w);
  void after_motion_last();
  void repeat();
  void leftovers();
  // what stops the control (lower_checks.cpp)
  void check_block();
  [[nodiscard]] const Word* has_use(dialects::fagor::Use use) const;
  void check_compensation(bool arc, bool moves);
  void check_arc_end();
  void check_tangent();
  void check_centre(ir::MotionKind kind);
  void refuse_under_arc(const GWord& g);
  ir::MotionExtra& extra();

  LowerState& state_;
  const syntax::Block* in_ = nullptr;
  ir::Block* out_ = nullptr;
  BlockResult* result_ = nullptr;

  std::array<GWord, max_g> g_{};
  std::size_t g_count_ = 0;
  std::array<const Word*, max_m> m_{};
  std::size_t m_count_ = 0;
  std::array<const Word*, 9> coords_{};
  std::size_t coord_count_ = 0;
  std::array<const Word*, 26> letters_{};
  std::array<const Word*, 2> radii_{};
  std::size_t radius_count_ = 0, radii_taken_ = 0;
  std::uint32_t seen_ = 0, unused_ = 0;
  bool coords_taken_ = false;
  bool surface_ends_ = false;  ///< behind the motion of this block
  bool surface_here_ = false;  ///< the plane code of this block chooses the face or the cylinder

  const GWord* motion_code_ = nullptr;
  const dialects::fagor::CycleRow* cycle_row_ = nullptr;  ///< a machining cycle of the lathe: its letters are its own
  std::array<const Word*, 26> cycle_words_{};             ///< in the written order
  std::size_t cycle_word_count_ = 0;
  const Word* argument_ = nullptr;
  const Word* absolute_centre_ = nullptr;
  const Word* tangent_arc_ = nullptr;
  const Word* three_points_ = nullptr;
  const Word* machine_coords_ = nullptr;
  const Word* home_ = nullptr;
  const GWord* straight_ = nullptr;  ///< G52 G75 G76
  bool cycle_ = false;
  bool has_after_ = false;  ///< an action after the motion was made
  bool has_extra_ = false;
  ir::MotionExtra extra_;
};

template <class Data>
ir::Action& BlockLowerer::act(Data data, const syntax::Word* word, ir::Order order) {
  ir::Action& a = out_->actions.emplace_back();
  a.data = std::move(data);
  a.order = order;
  has_after_ = has_after_ || order == ir::Order::after;
  if (word) {
    a.pos = word->pos;
    a.text = word_text(*word);
  }
  return a;
}

inline ir::AxisId axis_of(const syntax::Word& w) {
  return ir::fixed_axis(word_letter(w));
}
/// As a message names it.
inline std::string the_function(const syntax::Word& w) {
  return "the function " + std::string(word_text(w));
}

}  // namespace cnctrans::fagor
