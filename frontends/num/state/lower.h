// One read block (syntax::Block) -> IR. Word blocks first: they are the hot path, filled in place without allocation.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "dialects/num/gcodes.h"
#include "frontends/common/report.h"
#include "frontends/common/syntax.h"
#include "frontends/num/state/arrivals.h"
#include "frontends/num/state/expressions.h"
#include "frontends/num/state/settings.h"
#include "ir/geometry/contour.h"
#include "ir/statement.h"

namespace cnctrans::frontends::num {

/// The hole cycle in force.
struct ActiveCycle {
  std::shared_ptr<const ir::HoleCycle> words;  ///< null: none
  int code = 0;                                ///< its G number
  bool has_impact_plane = false;               ///< EH was given: the plane stays when ER changes (11.1)
  bool inch = false;                           ///< the unit of its words
  std::uint32_t line = 0;                      ///< where it was defined or changed last; 0: none
};

/// State along the text, for what can only be read with it. It follows the order of lines; where the ways of the
/// program bring something else to a line, arrive() puts it right.
struct TextState {
  std::int64_t program = -1;  ///< number of the program at hand
  bool main = true;           ///< it begins in the power-on state
  bool known = true;          ///< false in a called program, unless the ways say what its callers have set
  ir::Distance distance = ir::Distance::absolute;
  ir::Plane plane = ir::Plane::xy;
  ir::MotionKind motion = ir::MotionKind::linear;
  ActiveCycle cycle;
  std::vector<ir::VarRef> cycle_stale;      ///< variables written since its definition
  bool several_cycles = false;              ///< the ways come to this line with different cycles
  ir::AxisId tool_axis = ir::axis::none;    ///< by G16; none: the normal of the plane (Z on a lathe)
  bool spatial = false;                     ///< G29 or G43
  bool contour_open = false;                ///< the last element's end follows from the next one
  bool inch = false;                        ///< G70
  ir::Surface surface = ir::Surface::none;  ///< G21, G22
  bool turning_profile = false;             ///< between G64 and G80: blocks are a contour, not moves
  std::shared_ptr<ir::Cycle> stock;         ///< the G64 whose blank is being read
  std::size_t blank_points = 0;
  std::optional<ir::Value> blank_x, blank_z;  ///< the last point
};

/// What a word block holds besides words of a Block: a jump, a call, the program's end.
struct Flow {
  const dialects::num::GCode* code = nullptr;  ///< G77 or G79
  const syntax::Word* word = nullptr;
  const syntax::Word* program = nullptr;        ///< H
  const syntax::Word* repeat = nullptr;         ///< S of G77
  const syntax::Word* curve = nullptr;          ///< NU of G06, G48, G49
  std::array<const syntax::Word*, 3> labels{};  ///< N words
  std::size_t label_count = 0;
  bool end = false;
  std::string_view end_text;
  bool in_cycle = false;                      ///< a motion function or a depth under the cycle of the text
  bool linear_after = false;                  ///< G23 leaves G01 in force
  bool probes = false;                        ///< a G10 block
  std::vector<ir::AxisId> preset;             ///< axes of a G92, where PREF is kept as a number
  const syntax::Word* interrupted = nullptr;  ///< where G10 goes on after an interruption
  std::int64_t m_program = -1;                ///< an M function of the block calls this program
  bool m_program_after = false;               ///< behind the move of the block
  WordPos m_program_pos;
  std::int64_t macro = 0;  ///< Gxxx of the machine whose program is at hand
  WordPos macro_pos;
  std::vector<std::pair<std::int64_t, ir::Value>> arguments;  ///< of the macro: number of the L variable, value

  void clear() { *this = Flow{}; }
};

class Lowering {
 public:
  Lowering(const Settings& settings, Diagnostics& diagnostics);

  /// A new program: `main` starts in the power-on state, a called one in its caller's.
  void start_program(bool main, std::int64_t number = -1);
  /// Words of `b` into `out` (cleared first) and `flow`. False: the line was refused or is carried as text (see
  /// report()).
  bool words(const syntax::Block& b, const Span& line, std::string_view text, ir::Block& out, Flow& flow);
  /// The flow statement of the block, after words(). False after a refusal. `test` is the block's TEST statement or
  /// null.
  bool flow_statement(const Flow& flow, const syntax::Statement* test, ir::Statement& out);
  /// The jump of a G10 block that was interrupted.
  bool curve(const Flow& flow, ir::Statement& out);
  bool interruption(const Flow& flow, ir::Statement& out);
  /// Value of a word that is no axis word.
  ir::Value value(const syntax::Word& w);

  /// A block between G64 and G80: a point of the blank. False after a refusal.
  bool blank_point(const ir::Block& block);
  /// Reads with what the ways of the program bring to lines, and the cycles that an earlier reading found.
  void know_arrivals(const Arrivals& arrivals, std::map<std::uint32_t, ActiveCycle> cycles) {
    arrivals_ = &arrivals;
    earlier_cycles_ = std::move(cycles);
  }
  /// Collects modal_uses(); a program read line by line has one way.
  void collect_uses() { collects_ = true; }
  [[nodiscard]] const std::vector<ModalUse>& modal_uses() const { return uses_; }
  [[nodiscard]] const std::map<std::uint32_t, ActiveCycle>& cycles() const { return cycles_; }
  /// Line of a change of a cycle -> line of the cycle that it was joined with.
  [[nodiscard]] const std::map<std::uint32_t, std::uint32_t>& changed_cycles() const { return changed_cycles_; }
  /// The program of this Gxxx is at hand.
  void add_macro(std::int64_t number) { macros_.insert(number); }

  [[nodiscard]] Report& report() { return report_; }
  [[nodiscard]] Expressions& expressions() { return expressions_; }
  [[nodiscard]] TextState& state() { return state_; }
  /// Variables are written while a hole cycle may be in force.
  void note_assigned(const std::vector<ir::Assign::Item>& items);
  [[nodiscard]] const Settings& settings() const { return settings_; }

 private:
  using Word = syntax::Word;
  using GKind = dialects::num::GKind;
  /// Order in which actions of a block are carried out.
  enum class Step : std::uint8_t { setting, frame, value, machine_before, special, after };

  // words.cpp: the pass over the words
  bool take(const Word& w);
  void code(const Word& w);
  void code_action(const Word& w, const dialects::num::GCode& row);
  void setting_code(const Word& w, const dialects::num::GCode& row);
  void cycle_off(const Word& w);
  void mark_surface(const syntax::Word& w, ir::Surface surface);
  void face_words();
  void motion_code(const Word& w, ir::MotionKind kind);
  void machine_function(const Word& w);
  void coded_function(const Word& w);
  bool calls_program(const Word& w, std::int64_t code, ir::Order order);
  void check_program_call();
  void coordinate(const Word& w, ir::AxisId axis);
  template <class Data>
  ir::Action& act(const Word& w, Step step, Data data, ir::Order order = ir::Order::before);
  template <class E>
  void setting(const Word& w, ir::Setting s, E v);
  [[nodiscard]] std::string_view text_of(const Word& w) const { return text_.substr(w.pos.column - 1, w.pos.length); }
  [[nodiscard]] ir::Value axis_value(const Word& w, ir::AxisId axis);
  [[nodiscard]] bool check_literal(const Word& w, double limit);
  void unknown(const Word& w, std::string_view why);
  /// A word without effect on the path: the block is kept as text when it has only `words` words, else it is left out.
  void only_text(const Word& w, const dialects::num::GCode& row);
  void leave_out(const Word& w, std::string_view code, const std::string& what, std::size_t words);

  // way.cpp: what the lines above and the ways of the program bring to the line
  void arrive(std::uint32_t line);
  void uses(Modal fact);
  [[nodiscard]] ir::Plane plane();

  // resolve.cpp: what the words mean together
  void resolve();
  void resolve_distance();
  /// What a word at this column counts as; nullopt: the state of the caller decides.
  [[nodiscard]] std::optional<ir::Distance> distance_at(std::uint32_t column);
  /// What a G90 or G91 of the block says about a word at this column.
  [[nodiscard]] std::optional<ir::Distance> own_distance(std::uint32_t column) const;
  void resolve_motion();
  void resolve_arc(bool explicit_code);
  void resolve_dwell();
  void resolve_values();
  void resolve_special();
  void frame_shift(const Word& g59);
  void rotation_words(ir::FrameChange& change, const Word& ed);
  void preset(const Word& g92);
  void mirror(const Word& g51);
  void scale(const Word& w, bool on);
  void tool_axis(const Word& g16);
  void other_tool_axis(const Word& g16, const Word& axis, bool natural);
  void spatial_correction();
  void corner(const Word& eb);
  void through_points();

  // geometry.cpp
  void macro_words();
  void line_words();
  void polar_step(const Word& ea, const Word& ex);
  bool contour_end(ir::contour::Marks& marks);
  void thread_segment();
  void interruptible();

  // resolve.cpp
  std::vector<ir::FrameWord> take_frame_words();
  void sort_actions();
  void leftovers();

  // cycles.cpp
  void define_cycle(const Word& g);
  void change_cycle();
  void pocket(const Word& g);  // pockets.cpp
  bool pocket_levels(ir::HoleCycle& cycle);
  [[nodiscard]] bool moves_cycle_axis();
  bool refuses_new_depth();
  bool refuses_stale_words(const ir::HoleCycle& before, const Word& at);
  bool cycle_words(ir::HoleCycle& cycle, int number);
  bool plane_words(ir::HoleCycle& cycle);
  bool equal_pecks(ir::HoleCycle& cycle, const Word& es, const Word* beside);
  void oriented_clearance(ir::HoleCycle& cycle);
  bool cycle_bottom(ir::HoleCycle& cycle, const Word& g);
  void put_cycle(const Word& at, std::shared_ptr<const ir::HoleCycle> cycle, bool here);
  [[nodiscard]] ir::AxisId cycle_axis();

  // turning.cpp
  void turning_cycle(const Word& g);
  void chased_thread(const Word& g);
  void stock_removal(const Word& g, bool groove);
  // assumed_cycles.cpp: G63, G66, G31
  void tell_assumed(const Word& g, const dialects::num::CycleHabits& habits);
  bool keeps_open_words(const Word& g, std::initializer_list<int> slots);
  bool profile_labels(const Word& g, ir::NamedCycle& cycle);
  void reentrant_stock(const Word& g);
  void plunged_groove(const Word& g);
  void chased_on_mill(const Word& g);
  std::optional<ir::Value> take_absolute(ir::AxisId axis);
  void put_machining(const Word& g, std::shared_ptr<ir::Cycle> cycle);

  // flow.cpp
  bool jump(const Flow& flow, const syntax::Statement* test, ir::Statement& out);
  bool call(const Flow& flow, ir::Statement& out);
  bool label(const Word& w, ir::LabelRef& out);

  [[nodiscard]] bool has(int slot) const { return (present_ >> slot & 1U) != 0; }
  [[nodiscard]] const Word* use(int slot);

  const Settings& settings_;
  Report report_;
  Expressions expressions_;
  TextState state_;
  std::set<std::int64_t> macros_;
  const Arrivals* arrivals_ = nullptr;
  bool collects_ = false;
  std::vector<ModalUse> uses_;
  std::map<std::uint32_t, ActiveCycle> cycles_, earlier_cycles_;  ///< by the line that defines or changes one
  std::map<std::uint32_t, std::uint32_t> changed_cycles_;

  /// Words of the line at hand that change what others mean; null: not given.
  struct Marks {
    const Word* shift = nullptr;          ///< G59
    const Word* preset = nullptr;         ///< G92
    const Word* mirror = nullptr;         ///< G51
    const Word* tool_axis = nullptr;      ///< G16
    const Word* dwell = nullptr;          ///< G04
    const Word* cycle = nullptr;          ///< G81..G89
    const Word* orient = nullptr;         ///< M19
    const Word* css = nullptr;            ///< G96
    const Word* three_points = nullptr;   ///< G23
    const Word* machine_frame = nullptr;  ///< G52
    const Word* retract = nullptr;        ///< G75
    const Word* interruptible = nullptr;  ///< G10
    const Word* thread = nullptr;         ///< G38
    const Word* turning = nullptr;        ///< G33, G63..G66
    const Word* spatial = nullptr;        ///< G29, G43
    const Word* macro = nullptr;          ///< G100..G255 with its program
    bool any = false;                     ///< one of those above
    bool motion = false;                  ///< a motion code stands in the block
    bool plane = false, unit = false;     ///< a plane function; G70 or G71
    bool cycle_off = false;
    bool distance_after = false;  ///< the mode changes after the move: words stand before its code
    ir::Distance distance_before = ir::Distance::absolute;  ///< in force before the block
    bool unsorted = false;                                  ///< actions don't stand in the order of their steps
    std::uint8_t coded_m = 0, modal_coded_m = 0;            ///< M functions that the machine builder codes
    std::uint8_t distance_count = 0;                        ///< G90 and G91 words
    std::array<const Word*, 4> distances{};
  };

  const syntax::Block* block_ = nullptr;
  std::string_view text_;
  ir::Block* out_ = nullptr;
  Flow* flow_ = nullptr;
  Marks marks_;
  std::uint64_t present_ = 0;                  ///< bit: an address of this slot was given (axes too)
  std::uint64_t used_ = 0;                     ///< and means something
  std::map<std::int32_t, ir::Repeat> curves_;  ///< defined so far in the text
  std::array<const Word*, 64> pending_{};      ///< by slot, valid where present_ and no axis
  std::vector<Step> steps_;                    ///< of out_->actions
};

/// Ranges of G77 whose last block is missing end with the greatest smaller number (num.missing_range_end).
void mend_range_ends(ir::Routine& routine, Diagnostics& diagnostics);

/// Slots: letters 0..25, E-letters 26..51, NU 52, unknown -1.
constexpr int slot_of(std::string_view address) {
  const auto upper = [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; };
  if (address.size() == 1) return upper(address[0]) - 'A';
  const char first = upper(address.front()), last = upper(address.back());
  if (first == 'N' && last == 'U') return 52;
  return first == 'E' && last >= 'A' && last <= 'Z' ? 26 + (last - 'A') : -1;
}
namespace slot {
constexpr int letter(char c) {
  return c - 'A';
}
constexpr int e(char c) {
  return 26 + (c - 'A');
}
inline constexpr int nu = 52;
}  // namespace slot

}  // namespace cnctrans::frontends::num
