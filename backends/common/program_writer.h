// Writes a whole program: lines, numbers, labels, comments, joined statements, source map, refusals. A dialect derives
// from it and overrides the statements and actions that its language has; what it does not override is refused.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "backends/common/backend.h"
#include "backends/common/expression_printer.h"
#include "backends/common/labels.h"
#include "backends/common/line.h"
#include "backends/common/motion_tracker.h"
#include "backends/common/style.h"
#include "ir/analysis/dataflow.h"
#include "ir/analysis/hole_points.h"
#include "ir/edit/file_line.h"

namespace cnctrans::backends {

class ProgramWriter {
 public:
  ProgramWriter(const ir::Program& program, const WriteOptions& options, const Style& style, Diagnostics& diagnostics);
  virtual ~ProgramWriter() = default;
  ProgramWriter(const ProgramWriter&) = delete;
  ProgramWriter& operator=(const ProgramWriter&) = delete;

  std::vector<OutputFile> write();

 protected:
  // ---- to be said by every dialect ------------------------------------------------------------------------------
  /// Opens the files and writes the routines: open_file(), then routine lines and body() for each.
  virtual void write_program() = 0;
  virtual ExpressionPrinter& expressions() = 0;
  /// A word with its value: "X10", "X=R1*2", "XP100". `pos`: its place, for refusals.
  virtual std::string word(std::string_view address, const ir::Value& value, WordPos pos) = 0;

  // ---- statements: default refuses ------------------------------------------------------------------------------
  virtual void block(const ir::Block& b);  ///< default: by the word hooks below
  virtual void assign(const ir::Assign& a);
  virtual void if_else(const ir::If& i);
  virtual void while_loop(const ir::While& w);
  virtual void until_loop(const ir::Until& u);
  virtual void for_loop(const ir::For& f);
  virtual void endless_loop(const ir::Loop& l);
  virtual void exit_loop();
  virtual void jump(const ir::Jump& j);
  virtual void switch_jump(const ir::Switch& s);
  virtual void repeat(const ir::Repeat& r);
  virtual void call(const ir::CallRoutine& c);
  virtual void modal_call(const ir::ModalCall& c);
  virtual void return_from(const ir::Return& r);
  virtual void end_program(const ir::End& e);
  virtual void message(const ir::Message& m);
  /// A line for a file of the control, out of another language. Default: refused.
  virtual void file_statement(const ir::Message& m, const ir::FileStatement& f);
  virtual void declare(const ir::Declare& d);
  virtual void label();                      ///< default: the line with its number or labels only
  virtual void opaque(const ir::Opaque& o);  ///< default: own text as it is, else the remark of a refusal
  /// A structure whose condition or end could not be read; `text` is what stands there. Default: refused with its body.
  virtual void unread_structure(const ir::Statement& s, const ir::Opaque& text);

  // ---- actions of a block: each adds pieces to line() -----------------------------------------------------------
  virtual void action(const ir::Action& a);  ///< default: source spelling when it is the target's own, else the hooks
  virtual void modal_set(const ir::Action& a, const ir::ModalSet& m);      // default: Style::modal_codes
  virtual void set_feed(const ir::Action& a, const ir::SetFeed& f);        // default: F
  virtual void set_spindle(const ir::Action& a, const ir::SetSpindle& s);  // default: S of spindle 1
  virtual void spindle_run(const ir::Action& a, const ir::SpindleRun& s);  // default: M3 M4 M5 of spindle 1
  virtual void spindle_orient(const ir::Action& a, const ir::SpindleOrient& s);
  virtual void spindle_limit(const ir::Action& a, const ir::SpindleLimit& s);
  virtual void spindle_gear(const ir::Action& a, const ir::SpindleGear& s);      // default: M40..M45
  virtual void master_spindle(const ir::Action& a, const ir::MasterSpindle& m);  // default: there is spindle 1 only
  virtual void tool_select(const ir::Action& a, const ir::ToolSelect& t);        // default: T by number
  virtual void tool_change(const ir::Action& a);                                 // default: M6
  virtual void tool_offset(const ir::Action& a, const ir::ToolOffset& t);        // default: D
  virtual void work_offset(const ir::Action& a, const ir::WorkOffset& w);
  virtual void frame_op(const ir::Action& a, const ir::FrameOp& f);
  virtual void pole_set(const ir::Action& a, const ir::PoleSet& p);
  virtual void dwell(const ir::Action& a, const ir::Dwell& d);
  virtual void exact_stop(const ir::Action& a);                                      // default: Style::exact_stop_block
  virtual void coolant(const ir::Action& a, const ir::Coolant& c);                   // default: M code of the profile
  virtual void machine_function(const ir::Action& a, const ir::MachineFunction& m);  // default: M, checked
  virtual void stop(const ir::Action& a, const ir::Stop& s);                         // default: M0 M1
  virtual void cycle_define(const ir::Action& a, const ir::CycleDefine& c);
  virtual void cycle_cancel(const ir::Action& a);
  virtual void corner(const ir::Action& a, const ir::Corner& c);
  virtual void tangential_end(const ir::Action& a, const ir::TangentialEnd& t);
  virtual void preparation_stop(const ir::Action& a);  // default: Style::preparation_stop
  virtual void surface_set(const ir::Action& a, const ir::SurfaceSet& s);
  virtual void opaque_word(const ir::Action& a, const ir::OpaqueWord& w);

  // ---- motion of a block ----------------------------------------------------------------------------------------
  virtual void motion(const ir::Motion& m);                              ///< default: the parts below
  virtual void frame_use(const ir::Motion& m);                           ///< default: refuses all but normal
  virtual void coordinate(const ir::Motion& m, const ir::CoordWord& w);  ///< default: plain words, rest refused
  virtual void center(const ir::Motion& m, const ir::CenterWord& w);     ///< default: I J K from the start
  virtual void radius(const ir::Motion& m);                              ///< default: Style::radius_address
  virtual void motion_extra(const ir::Motion& m, const ir::MotionExtra& e);

  // ---- decisions ------------------------------------------------------------------------------------------------
  /// The statement goes on on the line of the one before it (it stood there in the source).
  /// Called before the line of a statement is begun; a line of its own may be written here.
  virtual void before_statement(const ir::Statement& /*next*/) {}
  virtual bool joins(const ir::Statement& before, const ir::Statement& next);
  /// The action stands on a line of its own. Default: when the target would carry it out on another side of the motion.
  virtual bool own_line(const ir::Action& a, const ir::Block& b);
  /// On which side of the motion the target carries it out: by the target profile's M table.
  [[nodiscard]] virtual ir::Order target_order(const ir::Action& a) const;
  /// The spelling of the source can be used for this kind of action when the source is of the target's language.
  virtual bool spelling_is_whole_word(const ir::Action& a) const;

  // ---- files and lines ------------------------------------------------------------------------------------------
  void open_file(std::string name, bool main, std::string program = {});
  /// `stem`, or `stem_2`, `stem_3`... when `stem` + `extension` is taken; with a note.
  std::string free_stem(const std::string& stem, std::string_view extension);
  void note_taken(const std::string& name, const std::string& instead);
  /// A line of text made here, without number or comment.
  void raw_line(std::string_view text, const Span& span = {});
  /// The same under the skip mark of the line before.
  void raw_line_in_branch(std::string_view text, const Span& span);
  [[nodiscard]] bool in_branch() const { return branch_ != 0; }
  /// The line of a statement has another skip mark than the one before: a branch on a switch begins or ends here.
  [[nodiscard]] bool changes_branch(const ir::Statement& next) const { return next.line.skip_mask != branch_; }
  void start_routine(std::size_t index);
  void body(const ir::Body& statements);
  void nested_body(const ir::Body& statements);  ///< one level deeper
  /// Starts the line of `info`: blank lines, skip mark, number, labels, comments.
  void begin_line(const ir::LineInfo& info);
  /// The rest goes to a further line of the target (same skip mark; no number, labels or comments). Nothing happens
  /// while the line has no pieces.
  void next_line();
  void rest_of_line();  ///< what is written from here on stands in a line of its own
  /// Number, labels and remarks of the source line on a line of their own; what follows stands on the next one. Without
  /// a label: nothing.
  void label_line();
  void finish_line();
  Line& line() { return line_; }
  void add(std::string text, Rank rank, WordPos pos = {}) { line_.add(std::move(text), rank, pos); }
  /// `ELSE`, `ENDIF`: begin_line(info) and its word.
  void keyword_line(const ir::LineInfo& info, std::string_view keyword);
  /// The block number or label as the target of a jump: "N20", or a mark while the file is renumbered.
  [[nodiscard]] std::string number_target(const ir::LabelRef& label) { return number_target(routine_, label); }
  [[nodiscard]] std::string number_target(std::size_t routine, const ir::LabelRef& label);

  // ---- words ----------------------------------------------------------------------------------------------------
  [[nodiscard]] bool same_dialect() const { return same_dialect_; }
  [[nodiscard]] NumberFormat number_format() const;
  /// A literal as text; rounding is reported once.
  [[nodiscard]] std::string number_text(const ir::Value& v);
  /// An expression as text; what can't be said is refused at `pos`.
  [[nodiscard]] std::string expression_text(const ir::ExprPtr& e, WordPos pos = {});
  [[nodiscard]] std::string m_word(std::int32_t code) const;
  /// The M code with this meaning on the target machine; `usual` when several or none has it.
  [[nodiscard]] std::int32_t code_for(machine::MMeaning meaning, std::int32_t usual) const;
  [[nodiscard]] std::string_view axis_name(ir::AxisId axis) const { return program_.axis_name(axis); }

  // ---- what is known --------------------------------------------------------------------------------------------
  /// Facts before the statement being written (an analysis of the whole program, made when first asked).
  [[nodiscard]] const ir::Facts* facts();
  [[nodiscard]] const ir::Facts* facts_before(const ir::Statement& s);
  /// The present block where the target goes to holes in rapid by itself.
  [[nodiscard]] ir::HolePoint point_in_rapid();
  /// A modal setting before the motion of the statement being written, when it is known.
  [[nodiscard]] std::optional<std::uint8_t> setting(ir::Setting s);
  void note_setting(ir::Setting s, std::uint8_t value);
  MotionTracker& motion_tracker() { return tracker_; }

  // ---- refusals -------------------------------------------------------------------------------------------------
  /// The line being written cannot be said: reported at `pos` (or the line), and the line becomes a remark with the
  /// source text. By the option: error, warning, or a remark followed by a stop when the construct could move.
  void refuse(std::string_view code, WordPos pos, std::string what, std::string hint = {});
  [[nodiscard]] bool refused() const { return !refusal_code_.empty(); }
  /// The statements of a refused structure: each line becomes a remark.
  void remark_body(const ir::Body& statements);
  void remark_line(const ir::LineInfo& info);
  void refuse_structure(std::string what);
  [[nodiscard]] Span span_of(WordPos pos) const;
  [[nodiscard]] std::string source_line(const Span& span) const;
  Diagnostics& diagnostics() { return diagnostics_; }

  const ir::Program& program() const { return program_; }
  const WriteOptions& options() const { return options_; }
  const Style& style() const { return style_; }
  const machine::Profile& profile() const { return *options_.profile; }
  const LabelUse& labels() const { return labels_; }
  [[nodiscard]] std::size_t routine_index() const { return routine_; }
  [[nodiscard]] const ir::Routine& routine() const { return program_.routines[routine_]; }
  [[nodiscard]] const ir::Statement& current() const { return *current_; }

  /// Extra labels of the line being begun (identifiers), in front of the words: "LN50:".
  virtual std::string label_text(const ir::LineInfo& info);

  std::uint8_t words_of_spindle_ = 1;  ///< the spindle that S, M3 and their like mean at this place of the text

 private:
  void statement(const ir::Statement& s, const ir::Statement* before, const ir::Statement* after);
  void dispatch(const ir::Statement& s);
  void emit(std::string_view text, const Span& span);
  /// A line that ends in comments, which begin at `comments`: several lines where they make it too long.
  void emit_remark(std::string_view text, std::size_t comments, const Span& span);
  void emit_comments_before();
  [[nodiscard]] std::string line_head(bool numbered);
  [[nodiscard]] std::string line_comments();
  void emit_refusal();
  void stop_before(bool wanted);
  /// The statement comes of a source block of which something has been left out.
  [[nodiscard]] bool part_of_refused(const ir::Statement& s) const;
  void refuse_rest();
  void annotate();
  [[nodiscard]] bool is_blank_line() const;
  [[nodiscard]] bool is_join(const ir::LineInfo& info) const;
  void resolve_numbers();
  void follow_branch(const ir::LineInfo& line);
  [[nodiscard]] std::string skip_marks(std::uint16_t mask);
  void note_rounding(double change, int decimals);

  ir::Program numbered_;  ///< a copy with statement ids, when the analysis is needed and the program has none
  const ir::Program& program_;
  const WriteOptions& options_;
  const Style& style_;
  Diagnostics& diagnostics_;
  bool same_dialect_;
  LabelUse labels_;
  Renumbering renumbering_;
  std::vector<OutputFile> files_;

  // the line being written
  Line line_;
  const ir::LineInfo* info_ = nullptr;
  bool line_open_ = false, first_of_source_line_ = true;
  bool blank_line_ = false;  ///< the line at hand is an empty line of the source
  std::size_t depth_ = 0;
  std::int64_t next_number_ = 0;
  Span annotated_;
  std::string refusal_code_;
  std::optional<Span> refused_block_;  ///< the source block that was left out last
  bool refusal_moves_ = true;
  bool stopped_ = false;  ///< a draft: the machine stands since the last line that is translated
  bool rounding_noted_ = false;

  // place and state
  std::size_t routine_ = 0;
  const ir::Statement* current_ = nullptr;
  MotionTracker tracker_;
  std::uint16_t branch_ = 0;     ///< the skip mark of the lines being written
  MotionTracker before_branch_;  ///< where the first of them begins
  std::array<std::optional<std::uint8_t>, ir::setting_count> settings_{};
  std::optional<ir::FactTable> facts_;
  std::set<std::int32_t> noted_functions_;
  std::set<std::string> left_out_;  ///< words without effect on the path that were reported
};

}  // namespace cnctrans::backends
