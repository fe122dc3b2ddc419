// Lines -> items. One object reads one file; its parts stand in the rooms above.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "frontends/common/frontend.h"
#include "frontends/common/report.h"
#include "frontends/common/syntax.h"
#include "frontends/heidenhain/state/flat.h"
#include "machine/profile.h"

namespace cnctrans::dialects::heidenhain {
struct FnRow;
struct MRow;
struct TiltRow;
}  // namespace cnctrans::dialects::heidenhain

namespace cnctrans::frontends::heidenhain {

/// The name of a program file: capitals, without folders and without `.H`.
std::string program_name(std::string_view text);

/// Path functions (reference 5): `none` is a block of axis words alone, which is read as L.
enum class PathForm : std::uint8_t {
  none,
  line,
  normal_line,
  arc,
  by_radius,
  tangent,
  polar_line,
  polar_arc,
  polar_tangent
};

/// A block with a path function, and those of its words that make the motion together.
struct PathLine {
  PathForm form = PathForm::none;
  const syntax::Word *radius = nullptr, *polar_radius = nullptr, *polar_angle = nullptr;
  const syntax::Word* retract_feed = nullptr;  ///< F behind M140

  [[nodiscard]] bool straight_in_axes() const { return form == PathForm::none || form == PathForm::line; }
  [[nodiscard]] bool straight() const {
    return straight_in_axes() || form == PathForm::normal_line || form == PathForm::polar_line;
  }
  [[nodiscard]] bool about_pole() const { return form == PathForm::arc || form == PathForm::polar_arc; }
  /// An arc that DR gives its sense.
  [[nodiscard]] bool by_sense() const { return about_pole() || form == PathForm::by_radius; }
  [[nodiscard]] bool polar() const {
    return form == PathForm::polar_line || form == PathForm::polar_arc || form == PathForm::polar_tangent;
  }
};

class Lowering {
 public:
  Lowering(const machine::Profile& profile, ir::Program& program, Diagnostics& diagnostics)
      : profile_(profile), program_(program), report_(diagnostics) {}

  /// Of the program that runs first and reaches this file. `mixed`: some of those between have another one.
  void outer_unit(ir::Units unit, bool mixed) {
    outer_unit_ = unit;
    mixed_units_ = mixed;
  }
  /// One line that is a block, or a comment. `line`: its place and comments. True: it was understood.
  bool line(const syntax::Block& block, const Span& where, std::string_view text, ir::LineInfo line);
  /// A block that can't be read.
  void unread(ir::LineInfo line, std::string_view text);
  /// What waits for further lines is complete.
  void flush();
  /// The lines of a subprogram follow once more: what holds at this call holds in them.
  void read_as_at(const Item& call) { read_as_ = call.held; }
  /// The lines of the program that the item calls follow, until the second of these: they are a subprogram.
  void open_program(const Item& call, const Span& where);
  void close_program() { part_ = false; }

  [[nodiscard]] Flat& flat() { return flat_; }
  [[nodiscard]] const Flat& flat() const { return flat_; }
  [[nodiscard]] Report& report() { return report_; }
  /// Q parameters that the program reads or writes outside of cycle definitions.
  [[nodiscard]] const std::set<std::int64_t>& own_reads() const { return reads_; }
  [[nodiscard]] const std::set<std::int64_t>& own_writes() const { return writes_; }
  /// Values that GLOBAL DEF gives to a parameter, in the order of the text.
  /// Of TOOL DEF, in the unit of the program.
  [[nodiscard]] const std::map<std::int64_t, double>& tool_radii() const { return radii_; }
  [[nodiscard]] const std::map<std::int16_t, std::vector<ir::Value>>& globals() const { return globals_; }
  /// Texts that the file uses: QS10.
  [[nodiscard]] const std::set<std::string>& texts() const { return texts_; }
  std::string_view keep(std::string text) { return program_.keep(std::move(text)); }
  /// What an M function does that a cycle has as a parameter.
  [[nodiscard]] ir::Action function_action(double code) const;
  [[nodiscard]] bool inch() const { return inch_; }
  [[nodiscard]] bool began() const { return began_; }
  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  using Word = syntax::Word;

  // statements/
  bool sentence(const syntax::Statement& s);
  bool begin(const syntax::Statement& s);
  bool finish_program(const syntax::Statement& s);
  bool label(const syntax::Statement& s);
  bool call_label(const syntax::Statement& s);
  bool call_program(const syntax::Statement& s);
  bool select_program(const syntax::Statement& s);
  Item& call_routine(const std::string& name);
  void put_unit(ir::Units unit);
  bool stop();
  bool assignment(const syntax::Statement& s);
  ir::ExprPtr function_value(const dialects::heidenhain::FnRow& row, const syntax::Expr& e, bool& fits);
  bool function(const syntax::Statement& s);
  bool jump(const syntax::Statement& s, ir::BinaryOp op);
  bool circle(const syntax::Statement& s, bool four);
  bool sysread(const syntax::Statement& rest);
  /// Number or name of a label in the words of the line; texts: in quotes.
  bool label_name(const syntax::Expr* text, const Word* word, Item& item);
  ir::ExprPtr expression(const syntax::Expr& e);
  ir::ExprPtr text_function(const syntax::Expr& e);
  ir::ExprPtr variable(const syntax::Expr& e, bool written);
  bool target(const syntax::Expr& e, ir::VarRef& out);

  // words/
  bool path();
  bool path_words(PathLine& line);
  bool place_word(PathLine& line, const Word& w);
  std::size_t with_own_words(std::size_t at);
  bool kept_word(const PathLine& line, const Word& w);
  bool path_fits(const PathLine& line);
  bool path_motion(const PathLine& line);
  void put_path(const PathLine& line);
  /// The words of a TOOL CALL.
  struct ToolWords {
    const syntax::Word *number = nullptr, *speed = nullptr, *feed = nullptr;
    std::optional<int> axis;
    bool oversized = false;
  };
  bool tool_words(ToolWords& out);
  bool tool_call(const syntax::Statement& s);
  bool tool_def(const syntax::Statement& s);
  int tool_state();
  int plunge_share(std::optional<ir::Value> share);
  /// The plane that is turned, and the shift behind the turn.
  struct Tilt {
    std::array<ir::Value, 3> angles;
    std::map<ir::AxisId, ir::Value> shift;
    std::vector<ir::FrameChange> inner;  ///< mirror, rotation and scale behind the turn
  };
  /// What holds where a subprogram is called: so is its text read, which stands behind the program end.
  struct Held {
    std::optional<Tilt> tilt;
    std::set<ir::FrameKind> outer;
    std::vector<std::string> contour_labels;
    std::int16_t tilt_id = 0, contours_id = 0;
    int contour_data = -1, train_data = -1, tool_axis = 2;
    bool feed_by_fu = false, per_rev = false, shortest = false;
    std::optional<ir::Value> tool_feed, speed, orient;
    std::optional<double> radius;
  };
  [[nodiscard]] Along along() const;
  void mark_along(Item& item);
  void sets(AlongText k) { sets_[static_cast<std::size_t>(k)] = true; }
  void relies(AlongText k) { relies_[static_cast<std::size_t>(k)] = true; }
  void contours_set();
  void tilt_set();
  int held();
  void hold(const Held& h);
  ir::ToolSelect tool_of(const syntax::Word* number, const syntax::Statement& s);
  bool corner(const Word& w, ir::CornerKind kind);
  bool pole();
  /// `counts`: the line counts from the pole.
  bool polar_in_other_plane(bool straight, bool counts);
  bool free_element(const syntax::Statement& s);
  bool lead(const syntax::Statement& s, bool departure);
  void axis_word(const Word& w, ir::AxisId axis, bool incremental);
  bool tail(const Word& w);
  bool remark(const Word& w);
  void machine_function(const Word& w);
  void machine_code(const Word& w, const dialects::heidenhain::MRow& row, std::int32_t code);
  bool feed(const Word& w);
  void end_motion();
  void retract(const Word* own_feed, bool modal = true);
  ir::Value value(const Word& w);
  ir::Action& act(const Word& w, ir::ActionData data, ir::Order order = ir::Order::before);

  // cycles/
  bool cycle_def(const syntax::Statement& s);
  bool cycle_word(const syntax::Statement& s);
  void global_word(const syntax::Statement& s);
  void each_parameter(const std::function<void(std::int16_t q, const Word& name, const Word& number, bool bare)>& take);
  bool feed_name(std::string_view name, const ir::Value* amount, WordPos pos, QValue& v);
  bool old_part(const syntax::Statement& s, std::int64_t number, int part);
  bool cycle_call(const syntax::Statement& s);
  bool pattern_def(const syntax::Statement& s);
  bool figures(Pattern& pattern);
  using FrameChanges = std::optional<std::vector<ir::FrameChange>>;  ///< nullopt: refused, and said
  void frame_cycle(const CycleDefinition& cycle);
  FrameChanges datum_shift(const CycleDefinition& cycle);
  FrameChanges mirror(const CycleDefinition& cycle);
  FrameChanges rotation(const CycleDefinition& cycle);
  FrameChanges scale(const CycleDefinition& cycle);
  FrameChanges axis_scale(const CycleDefinition& cycle);
  FrameChanges wrong_frame(std::string message);
  void change_frame(ir::FrameChange c, ir::Block& b);
  void row_effect(const CycleDefinition& cycle);
  void working_plane(const CycleDefinition& cycle);
  void contour_of_labels(const CycleDefinition& cycle);
  void effect(const CycleDefinition& cycle);
  bool pattern_cycle(const CycleDefinition& cycle);
  /// The words of a PLANE.
  struct TiltWords {
    std::map<std::string, ir::Value> given;
    bool literal = true;                ///< all of them are numbers
    bool stays = false, turns = false;  ///< what the rotary axes do
    bool fast = false, far = false;     ///< in rapid; the tool goes back up to the end of travel
    bool other = false;                 ///< SEQ-
    const syntax::Word *back = nullptr, *feed = nullptr;
  };
  bool tilt_words(const dialects::heidenhain::TiltRow& row, TiltWords& out);
  std::optional<std::array<ir::Value, 3>> tilt_angles(const dialects::heidenhain::TiltRow& row, const TiltWords& words,
                                                      std::string* why);
  bool plane(const syntax::Statement& s);
  bool tilt(std::array<ir::Value, 3> angles, bool named = true);
  bool turn_axes(const std::array<ir::Value, 3>& angles, bool rapid, const Word* own_feed);
  bool in_tilt(ir::FrameChange c);
  void put_tilt();
  bool shift_in_tilt(ir::AxisId axis, const ir::Value& v, bool adds);
  void trans_datum(const syntax::Statement& s);

  // Items
  Item& put(ItemKind kind, ir::StatementNode node);
  Item& put(ir::StatementNode node) { return put(ItemKind::plain, std::move(node)); }
  bool carried(const syntax::Statement& s, bool harmless, std::string_view feature, std::string message);
  [[nodiscard]] std::string_view slice(WordPos p) const { return text_.substr(p.column - 1, p.length); }
  [[nodiscard]] std::string_view slice(const Word& w) const { return slice(w.pos); }
  [[nodiscard]] bool has_axis(ir::AxisId axis) const { return profile_.axis(axis) != nullptr; }

  const machine::Profile& profile_;
  ir::Program& program_;
  Report report_;
  Flat flat_;
  std::set<std::int64_t> reads_, writes_;
  std::set<std::string> texts_;
  std::map<std::int16_t, std::vector<ir::Value>> globals_;
  bool global_ = false;  ///< lines of a GLOBAL DEF are being read
  std::string name_;
  bool inch_ = false, began_ = false, ended_ = false;
  int read_as_ = -1;                     ///< index of what holds at the label of the next line
  bool part_ = false;                    ///< the line is one of a called program that is read as a subprogram
  std::optional<ir::Units> outer_unit_;  ///< where the unit changes with the file
  bool mixed_units_ = false;

  // Along the text
  bool tool_called_ = false;
  int tool_axis_ = 2;                                   ///< X 0, Y 1, Z 2: of the last TOOL CALL
  std::optional<ir::Value> tool_feed_;                  ///< F of the last TOOL CALL
  bool feed_of_tool_ = false;                           ///< F AUTO in the line at hand
  std::optional<ir::Value> speed_;                      ///< S of the last TOOL CALL
  std::optional<ir::Value> orient_;                     ///< cycle 13
  std::optional<std::pair<double, double>> free_pole_;  ///< FPOL
  std::vector<std::string> contour_labels_;             ///< cycle 14
  int contour_data_ = -1;                               ///< the definition of cycle 20
  int train_data_ = -1;                                 ///< of cycle 270
  std::optional<Tilt> tilt_;
  /// The state of each AlongText, with a number for each that has been there; what the line at hand sets of it, and on
  /// what it relies.
  std::array<bool, along_text> sets_{}, relies_{};
  std::array<std::int16_t, along_text> before_{};
  std::map<std::string, std::int16_t> tilts_, contours_;
  std::int16_t tilt_id_ = 0, contours_id_ = 0;
  std::vector<Held> held_;                ///< at each call
  std::map<std::string, int> called_;     ///< by the label: index of what holds at its first call
  std::set<ir::AxisId> rotary_moved_;     ///< rotary axes in the blocks above
  std::set<ir::FrameKind> outer_;         ///< mirror, rotation and scale that were programmed outside of a tilt
  std::map<std::int64_t, double> radii_;  ///< TOOL DEF n R
  std::optional<double> radius_;          ///< of the tool of the last TOOL CALL, as TOOL DEF says it
  bool oversize_ = false;                 ///< that TOOL CALL has DR
  bool scaled_about_ = false;             ///< cycle 26 has a centre
  int other_pole_ = -1;                   ///< the last CC, where it lies in another plane than that of the tool
  bool shortest_ = false;                 ///< M126
  int plunge_ = -1;                       ///< M103 in the line at hand: index of its share
  bool feed_by_fu_ = false;               ///< the last F was FU
  bool per_rev_ = false;                  ///< M136
  int waiting_ = -1;                      ///< the cycle definition that further lines complete
  bool waits_more_ = false;               ///< its last line ended with ~
  ir::LineInfo waiting_line_;
  int pattern_ = -1;      ///< the PATTERN DEF that further lines complete
  bool swallow_ = false;  ///< further lines belong to a sentence that is kept as text

  // Of the line at hand
  const syntax::Block* block_ = nullptr;
  std::string_view text_;
  ir::LineInfo line_;
  bool first_ = true;  ///< no statement of the line has been put yet
  ir::Block out_;
  std::vector<ir::Action> around_;  ///< actions in the order of the words
  CycleCall call_ = CycleCall::none;
  std::string_view end_text_;
  bool rapid_ = false;
  std::optional<ir::Value> angle_;  ///< PA or IPA
  bool angle_incremental_ = false;
  int sense_ = 0;                  ///< DR: 1 or -1
  std::optional<Word> retract_;    ///< M140
  bool retract_far_ = false;       ///< MB MAX
  bool untilted_ = false;          ///< M130
  bool from_maker_point_ = false;  ///< M92
};

/// X 0 ... C of the axis letters; none: no axis.
constexpr ir::AxisId axis_of(std::string_view address) {
  if (address.size() != 1) return ir::axis::none;
  const char c = address[0] >= 'a' ? static_cast<char>(address[0] - 'a' + 'A') : address[0];
  return ir::fixed_axis(c);
}
/// `IX` of the words IX and X.
constexpr bool is_incremental(std::string_view address) {
  return address.size() == 2 && (address[0] == 'I' || address[0] == 'i');
}
constexpr ir::Plane plane_of(int tool_axis) {
  return tool_axis == 0 ? ir::Plane::yz : tool_axis == 1 ? ir::Plane::zx : ir::Plane::xy;
}

}  // namespace cnctrans::frontends::heidenhain
