// What the parts of the lowering share while one file is read: the machine, the program being built, names,
// diagnostics.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "dialects/sinumerik/cycles.h"
#include "dialects/sinumerik/geometry.h"
#include "dialects/sinumerik/options.h"
#include "dialects/sinumerik/variables.h"
#include "ir/program.h"
#include "machine/profile.h"

namespace cnctrans::sinumerik {

/// The machine as the hot path wants it: one look-up a word.
struct MachineFacts {
  explicit MachineFacts(const machine::Profile& profile);

  static constexpr std::int32_t m_limit = 1000;
  const machine::Profile* profile;
  Options options;
  std::array<ir::AxisId, 26> axis_of{};                  ///< letter -> axis; none: the machine has no such axis
  std::array<const machine::MCode*, m_limit> m_codes{};  ///< null: no meaning known
  std::int32_t r_count = 0;                              ///< parameters from R0 on
  std::array<bool, ir::axis::count_max> rotary{};        ///< axes that turn
  GeometryAxes geometry;                                 ///< order of X, Y and Z

  [[nodiscard]] ir::AxisId axis(char letter) const;            ///< any case; none when it is no letter or no axis
  [[nodiscard]] ir::AxisId axis(std::string_view name) const;  ///< by name in capitals, also "X1" of the profile
};

/// A declared variable or formal parameter.
struct Symbol {
  ir::Type type = ir::Type::real;
  ir::SpaceId space = space::real;
  std::uint8_t dimensions = 0;
  bool character = false;                ///< a CHAR: also set by its code
  std::array<std::uint32_t, 3> sizes{};  ///< of the dimensions; 0: not known
  bool of_machine = false;               ///< a definition file has it: a definition of the program hides it
};

/// A word that stays in force for later blocks, followed in the order of the text. Behind a label, a jump, a structure
/// or a call the text no longer tells what holds, nor does it tell the value of a computed word.
class LastingWord {
 public:
  enum class State : std::uint8_t { none, known, unsure };

  /// The program writes the word. True: a block before this one was taken to have none, and the program may come back
  /// to it.
  bool set(const ir::Value& value) {
    value_ = value.literal() ? value.number : 0;
    state_ = value.literal() ? State::known : State::unsure;
    return missed_;
  }
  /// The word no longer holds.
  void cancel() { state_ = State::none; }
  /// The block that was read last may be left out: what held before it may hold as well.
  void join(const LastingWord& before) {
    if (state_ != before.state_ || (state_ == State::known && value_ != before.value_)) state_ = State::unsure;
  }
  /// The program may come from elsewhere.
  void interrupt() {
    interrupted_ = true;
    if (state_ == State::known) state_ = State::unsure;
  }
  /// What holds in this block.
  State ask() {
    missed_ = missed_ || (state_ == State::none && interrupted_);
    return state_;
  }
  /// The value; `State::known` only.
  [[nodiscard]] double value() const { return value_; }

 private:
  double value_ = 0;
  State state_ = State::none;
  bool interrupted_ = false;
  bool missed_ = false;
};

/// A curve table as the program defines it: straight lines between points (motion reference 15.2).
struct CurveTable {
  ir::AxisId follower = ir::axis::none, leader = ir::axis::none;
  std::vector<std::pair<double, double>> points{};  ///< leader, follower; as programmed
  std::int32_t period = 0;                          ///< 0: none, 1: of the leader, 2: of both
  bool known = true;                                ///< its blocks tell all of it
};

/// Where the tool points, as far as the text tells (motion reference 7.7, 10.2).
struct ToolDirection {
  enum class State : std::uint8_t {
    normal,  ///< along the normal of the plane: no transformation, no carrier
    known,   ///< `vector`, in the coordinates of the workpiece
    unsure
  };
  State state = State::normal;
  std::array<double, 3> vector{0, 0, 1};
  std::array<double, 3> outside{0, 0, 1};  ///< as `vector`, in the coordinates that TOROTOF brings back
  bool has_outside = false;
  bool axes_moved = false;  ///< a rotary axis was programmed

  void turned_by_axis() {
    axes_moved = true;
    if (state == State::known) state = State::unsure;
  }
  void transformation(bool orients) {
    state = !orients ? State::normal : axes_moved ? State::unsure : State::known;
    vector = {0, 0, 1};
  }
};

/// What holds by the text read so far, in its order. Behind a label, a jump, a structure or a call it tells less.
struct TextState {
  std::optional<ir::Units> units_by_text{};  ///< of the program; none: the caller's
  bool words_in_inches = false;              ///< G70: lengths of words, not those of data
  bool units_called = false;   ///< what is in force may be other than `units_by_text`: a call stands behind, a label
  LastingWord thread_start{};  ///< SF= in force
  LastingWord corner_feed{};   ///< FRCM= in force
  LastingWord speed_limit{};   ///< G26 S of the master spindle
  LastingWord css_limit{};     ///< LIMS= of the master spindle
  /// TRAANG in force: the angle of the inclined axis in degrees; none: it does not tell.
  std::optional<double> inclined{};
  ToolDirection tool{};
  /// Tool carriers (TCARR): their data and which one is chosen.
  struct Carrier {
    std::map<std::int32_t, std::map<int, double>> data{};  ///< $TC_CARRn[m], by m and n
    bool unsure = false;                                   ///< data that the text does not tell
    std::optional<std::int32_t> chosen{};                  ///< 0: none
    bool turned = false;                                   ///< PAROT has turned the coordinates before in the text
  };
  Carrier carrier{};
  std::optional<ir::Plane> plane{};  ///< in force; none: it does not tell
  std::optional<bool> css{};         ///< constant cutting speed in force; none: it does not tell
  std::optional<bool> per_rev{};     ///< feed per revolution in force; none: it does not tell

  /// The block that was read last has a skip mark: what it says holds behind it or not. `before`: this, before it.
  void may_be_left_out(const TextState& before);
};

struct FileContext : TextState {
  MachineFacts& machine;
  FileId file;
  ir::Program& program;
  Diagnostics& diagnostics;
  std::map<std::string, Symbol, std::less<>> symbols;  ///< names in capitals; of the routine being read
  ir::MotionKind motion = ir::MotionKind::linear;      ///< G group 1 as the text has it so far
  Span line;                                           ///< the line being lowered
  std::string_view text;                               ///< its text
  std::uint32_t errors = 0;                            ///< faults of this line so far, kept constructs included
  std::uint32_t kept = 0;                              ///< of those, constructs that are read but not carried
  std::set<std::string, std::less<>> said{};           ///< names of unknown meaning that were reported, capitals

  std::set<std::string, std::less<>> read_names{};     ///< variables of the routine read so far, capitals
  std::set<std::string, std::less<>> unknown_names{};  ///< of those, the ones that the machine has given a value

  bool skippable = false;           ///< the block being read has a skip mark
  bool more_units = false;          ///< the file has codes of other units than those of power-on
  std::uint8_t master_spindle = 1;  ///< SETMS, in the order of the text
  bool offset_chosen = true;        ///< a D was written since the last T, in the order of the text

  /// `own` is set to `value`; what counts is the lower one of it and `other` (14.7).
  ir::Value lower_limit(LastingWord& own, LastingWord& other, const ir::Value& value, WordPos pos);
  /// A label, a jump, a structure or a call: what holds may come from elsewhere.
  void interrupt_lasting() {
    thread_start.interrupt();
    corner_feed.interrupt();
    speed_limit.interrupt();
    css_limit.interrupt();
    if (more_planes) plane.reset();
    units_called = units_called || more_units;
    if (uses_css) css.reset();
    if (more_feeds) per_rev.reset();
    inclined.reset();
    carrier.chosen.reset();
    real_time.locked = !real_time.cells.empty();
    tool.state = ToolDirection::State::unsure;
    contours = {};
  }

  std::optional<ir::DiameterMode> diameter{};  ///< written last, in the order of the text; none: that of power-on
  bool increments = false;                     ///< G91 was written
  [[nodiscard]] std::optional<double> carrier_datum(int number) const;
  [[nodiscard]] std::optional<std::array<double, 3>> table_turn(std::string& why) const;
  bool framed = false;         ///< the program may have put a frame of its own, beside that of the tool
  bool tool_frame = false;     ///< the frame of the tool or of a swivelled plane is in force
  bool other_plane = false;    ///< G18 or G19 was written
  bool more_planes = false;    ///< the file has codes of several planes
  bool uses_css = false;       ///< G96 or G961 stands in the file
  bool more_feeds = false;     ///< the file has codes of feeds per revolution and of others
  bool words_of_tool = false;  ///< FZ= or SVC= is in force: it counts for the tool of its block

  /// Tables of contours that the text tells, and as bits the columns of them that no text tells.
  std::map<std::string, unsigned, std::less<>> prepared{};
  /// R parameters that an action in real time sets with the next move: until the control has waited for it (STOPRE)
  /// the program does not tell what they hold.
  struct RealTimeCells {
    std::set<std::int32_t> cells;
    bool moved = false;   ///< the next move stands behind the action
    bool locked = false;  ///< the program may go round the STOPRE
  };
  RealTimeCells real_time{};

  std::map<std::int32_t, CurveTable> tables{};          ///< CTABDEF, by number
  CurveTable* table = nullptr;                          ///< the one being defined
  std::vector<ir::Assign::Item>* given_back = nullptr;  ///< where functions put the values of their VAR arguments

  /// Contours that CYCLE62 names, as words of a milling cycle (ir/cycles/milling/mill_contour), in the order of the
  /// text.
  struct Contours {
    std::vector<std::vector<std::pair<std::string, ir::Value>>> list;
    bool used = false;  ///< by a cycle: the next CYCLE62 begins a new list
  };
  Contours contours{};

  std::map<std::string, std::string, std::less<>> macros{};  ///< DEFINE: name in capitals -> text, of this routine
  /// Definition files of the machine: global user data and macros. May be null.
  const std::vector<const ir::Program*>* definitions = nullptr;
  std::function<bool(std::string_view name)> has_program{};  ///< see ReadOptions
  /// A cycle of the control, and no program of its name takes its place; nullptr: it is none.
  const CycleRow* cycle_called(std::string_view capitals, WordPos pos);
  /// A length in millimetres in the unit in force; where the text does not tell it, `what` and the word to write
  /// instead are said.
  ir::Value millimetres(const ir::Value& mm, std::string_view what, std::string_view word, WordPos pos);
  /// Puts what they define among the names of the routine that begins.
  void take_definitions();

  /// All that is the matter with the line is that something is not carried: it is read and kept as text.
  [[nodiscard]] bool only_kept() const { return errors != 0 && errors == kept; }
  /// A construct of the language that is read but not carried: the block stays as text, a run or a translation that
  /// comes there is refused. A warning here.
  void keep(std::string_view code, WordPos pos, std::string message, std::string hint = {});
  /// The machine has fewer R parameters: warned about once a file.
  void beyond_r_parameters(WordPos pos);
  /// True the first time this is asked for a name of the file.
  [[nodiscard]] bool first_time(std::string_view name) { return said.emplace(name).second; }

  [[nodiscard]] const Symbol* symbol(std::string_view capitals) const {
    const auto it = symbols.find(capitals);
    return it == symbols.end() ? nullptr : &it->second;
  }
  void error(std::string_view code, WordPos pos, std::string message, std::string hint = {});
  void warning(std::string_view code, WordPos pos, std::string message, std::string hint = {});
  void note(std::string_view code, WordPos pos, std::string message, std::string hint = {});
  /// The text of a place of the line.
  [[nodiscard]] std::string_view slice(WordPos pos) const;
};

/// While it stands, functions may give values back in their arguments: they are assigned before what the statement
/// does.
class GivenBack {
 public:
  GivenBack(FileContext& context, ir::Assign& out, WordPos pos)
      : context_(context), out_(out), pos_(pos), at_(out.items.size()) {
    context_.given_back = &items_;
  }
  GivenBack(const GivenBack&) = delete;
  GivenBack& operator=(const GivenBack&) = delete;
  ~GivenBack() {
    context_.given_back = nullptr;
    for (auto& item : items_) {
      item.pos = pos_;
    }
    out_.items.insert(out_.items.begin() + static_cast<std::ptrdiff_t>(at_), items_.begin(), items_.end());
  }

 private:
  FileContext& context_;
  ir::Assign& out_;
  WordPos pos_;
  std::vector<ir::Assign::Item> items_;
  std::size_t at_;
};

}  // namespace cnctrans::sinumerik
