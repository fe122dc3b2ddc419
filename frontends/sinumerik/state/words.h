// Word blocks: addresses and G functions -> one ir::Block. The plain path (numbers only) is the hot path of the reader:
// no allocation a block, one look-up a word.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "dialects/sinumerik/g_functions.h"
#include "frontends/common/syntax.h"
#include "frontends/sinumerik/state/context.h"
#include "frontends/sinumerik/state/expr.h"

namespace cnctrans::sinumerik {

/// A word that ends the routine; it becomes a statement of its own after the block.
enum class Tail : std::uint8_t { none, program_end, subprogram_end };

class WordLowering {
 public:
  explicit WordLowering(FileContext& context) : c_(context), exprs_(context) {}

  /// True when every word is one of the hot path's letters: no L, P, R, N, O (calls, counts, variables, labels).
  [[nodiscard]] static bool is_motion_block(const syntax::Block& block);

  /// Lowers all words of `block` into `out` (cleared first). False: an error was reported, or the block does something
  /// that is not carried; `feature` then names the missing feature and `out` must not be used.
  bool lower(const syntax::Block& block, ir::Block& out);
  /// As above, with G functions programmed indirectly (`G[8]=2`).
  bool lower(const syntax::Block& block, const std::vector<std::pair<const GFunction*, WordPos>>& indirect,
             ir::Block& out);

  [[nodiscard]] Tail tail() const { return tail_; }
  [[nodiscard]] WordPos tail_pos() const { return tail_pos_; }
  [[nodiscard]] std::string_view feature() const { return feature_; }

 private:
  enum class Special : std::uint8_t { none, dwell, frame, pole, limit, approach, inclined };
  // Order in which actions are carried out, whatever their place in the block.
  enum class Rank : std::uint8_t {
    setting,
    corner,
    feed,
    limit,
    speed,
    tool,
    change,
    offset,
    orient,
    before,
    with,
    dwell,
    after,
    stop
  };

  void begin(ir::Block& out);
  void g_words(const syntax::Block& block);
  void g_function(const GFunction& g, WordPos pos);
  void setting(ir::Setting which, std::uint8_t value, WordPos pos);
  void feed_mode(const GFunction& g, WordPos pos);
  void words(const syntax::Block& block);
  void letter(const syntax::Block& block, const syntax::Word& w, char address);
  void m_word(const syntax::Block& block, const syntax::Word& w);
  void m_code(std::int32_t code, const syntax::Word& w);
  void machine_meaning(const machine::MCode& m, std::uint8_t spindle, const syntax::Word& w);
  void t_word(const syntax::Block& block, const syntax::Word& w);
  void s_word(const syntax::Word& w, ir::Value value);
  bool feed_polynomial(const syntax::Expr& e, const syntax::Word& w);
  void f_word(const syntax::Word& w, ir::Value value);
  void tooth_feed(const syntax::Word& w, const ir::Value& value);
  void cutting_speed(const syntax::Word& w, const ir::Value& value);
  void words_of_tool();
  void named(const syntax::Block& block, const syntax::Word& w);
  void known_word(NamedWord use, const std::string& name, const syntax::Word& w, ir::Value value, Attribute attribute);
  void value_of_move(NamedWord use, const syntax::Word& w, ir::Value value, Attribute attribute);
  void corner(ir::CornerKind kind, bool modal, const std::string& name, ir::Value size, WordPos pos);
  void coordinate(ir::AxisId axis, const syntax::Word& w, ir::Value value, Attribute attribute);
  bool polynomial(const syntax::Block& block, const syntax::Word& w, ir::AxisId axis);
  void center(ir::AxisId axis, const syntax::Word& w, ir::Value value, Attribute attribute);
  void spindle_position(const syntax::Word& w, ir::Value value, Attribute attribute);
  bool finish();
  void finish_frame();
  void finish_rotation(ir::FrameChange& change);
  void finish_solid_angles(ir::FrameChange& change);
  void default_offset();
  [[nodiscard]] WordPos statement_pos() const;
  void finish_pole();
  void finish_inclined();
  void polar_pole(ir::FrameChange& at);
  void open_line();
  void finish_dwell();
  void finish_motion();
  void start_angle();
  void finish_corner();
  void lasting_missed(WordPos pos);
  void orientation(const syntax::Word& w);
  void finish_orientation();
  void tool_frame(const GFunction& g, WordPos pos);
  void table_frame(WordPos pos);
  void check_words(bool arc);
  [[nodiscard]] ir::Plane plane_of_centres() const;
  void reject_axis_words(std::string_view why);

  template <class Data>
  void push(Data data, Rank rank, ir::Order order, WordPos pos, bool with_text = true);
  void sort_actions();
  void refuse(std::string_view feature, WordPos pos, std::string message, std::string hint = {});
  ir::MotionExtra& extra() {
    has_extra_ = true;
    return extra_;
  }
  [[nodiscard]] ir::MotionKind motion_kind() const {
    return out_->motion.kind == ir::MotionKind::modal ? c_.motion : out_->motion.kind;
  }
  [[nodiscard]] bool is_thread() const {
    const ir::MotionKind k = motion_kind();
    return k == ir::MotionKind::thread || k == ir::MotionKind::thread_variable || k == ir::MotionKind::tap_rigid ||
           k == ir::MotionKind::tap_rigid_out;
  }

  FileContext& c_;
  ExprLowering exprs_;
  ir::Block* out_ = nullptr;
  std::vector<std::uint8_t> ranks_;
  std::uint64_t groups_ = 0;
  Special special_ = Special::none;
  const GFunction* special_g_ = nullptr;
  WordPos special_pos_;
  bool failed_ = false;
  bool sorted_ = true;
  bool decreasing_lead_ = false;
  Tail tail_ = Tail::none;
  WordPos tail_pos_;
  std::string_view feature_;
  std::array<double, 3> vector_{};  ///< A3= B3= C3= of the block
  bool has_vector_ = false, other_orientation_ = false;
  bool has_extra_ = false;
  ir::MotionExtra extra_;
  bool has_dwell_ = false;
  ir::Dwell dwell_;
  bool has_rpl_ = false;
  ir::Value rpl_;
  std::int32_t corner_ = -1;  ///< index of the Corner action, for FRC
  bool has_corner_feed_ = false;
  ir::Value corner_feed_;
};

template <class Data>
void WordLowering::push(Data data, Rank rank, ir::Order order, WordPos pos, bool with_text) {
  auto& a = out_->actions.emplace_back();
  a.data = std::move(data);
  a.order = order;
  a.pos = pos;
  if (with_text) a.text = c_.slice(pos);
  sorted_ = sorted_ && (ranks_.empty() || ranks_.back() <= static_cast<std::uint8_t>(rank));
  ranks_.push_back(static_cast<std::uint8_t>(rank));
}

}  // namespace cnctrans::sinumerik
