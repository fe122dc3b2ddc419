// Everything but the plain word block: assignments, jumps, structures, definitions, calls, cycles -> IR statements.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dialects/sinumerik/beside.h"
#include "frontends/common/structure_builder.h"
#include "frontends/common/syntax.h"
#include "frontends/sinumerik/state/context.h"
#include "frontends/sinumerik/state/expr.h"
#include "frontends/sinumerik/state/prepared_contour.h"
#include "frontends/sinumerik/state/words.h"

namespace cnctrans::sinumerik {

/// Canonical name of a program: capitals, without `_N_` and `_SPF`/`_MPF`; `L0123` has the number 123 too.
ir::RoutineName routine_name(std::string_view text);

class StatementLowering {
 public:
  StatementLowering(FileContext& context, WordLowering& words) : c_(context), words_(words), exprs_(context) {}

  /// A routine begins: its statements go to `body`. Names, labels and structure start afresh.
  void begin_routine(ir::Routine& routine);
  /// The routine ends: the lines of structures that are still open are reported and unread. `source` has the lines.
  void end_routine(const SourceText* source);
  /// The last block so far ends the routine, whatever leads to it (M30, M17, RET outside all structures).
  [[nodiscard]] bool ended() const { return ended_; }

  /// Lowers one block and adds its statements. True when all of it was understood.
  bool lower(const syntax::Block& block, ir::LineInfo info);
  /// Adds a statement (comment lines, blocks of the hot path).
  void add(ir::Statement statement);
  /// The block stands in a curve table or another definition: it belongs to `lower`, also when it has words only.
  [[nodiscard]] bool defines() const { return definition_ != nullptr || returned_ || other_mode_; }
  /// The lines are in another language of the control (G291).
  [[nodiscard]] bool other_mode() const { return other_mode_; }
  /// Adds the block as Opaque text.
  void add_opaque(const syntax::Block& block, ir::LineInfo info, std::string_view feature, bool harmless);
  /// Adds a block that can't be read as Opaque text; when it opens or closes a structure by its first word, the
  /// structure is opened or closed all the same, so that the lines between keep their place.
  void add_unread(const syntax::Block& block, ir::LineInfo info);

 private:
  struct Parts;  ///< what a row of items holds: assignments, words, calls, a count

  // rows of items
  bool items(const syntax::Block& block, ir::LineInfo info);
  bool sort_items(const syntax::Block& block, Parts& parts);
  bool sort_word(const syntax::Block& block, const syntax::Word& word, Parts& parts);
  bool sort_assignment(const syntax::Statement& s, Parts& parts);
  bool assign(const syntax::Expr& target, const syntax::Expr& value, WordPos pos, Parts& parts);
  // lists and characters (lower_arrays.cpp)
  bool assign_list(const ir::VarRef& target, ir::Type type, const syntax::Expr& list, const Symbol* symbol, WordPos pos,
                   ir::Assign& out);
  bool assign_character(const syntax::Expr& target, const syntax::Expr& value, WordPos pos, ir::Assign& out);
  static ir::ExprPtr zero_of(ir::Type type);
  // what the reader computes (lower_computed.cpp)
  bool circle_data(const ir::VarRef& target, const syntax::Expr& call, WordPos pos, ir::Assign& out);
  void table_block(const syntax::Block& block, std::string_view name);
  // tables of prepared contours (lower_contour_table.cpp)
  [[nodiscard]] bool is_contour_table(const syntax::Expr& e) const;
  void begin_contour(const std::vector<syntax::Expr>& args, WordPos pos);
  std::optional<double> contour_value(const syntax::Block& block, const syntax::Word& w, Attribute& attribute);
  void contour_block(const syntax::Block& block);
  bool contour_known();
  void fill_table(const syntax::Expr& error, WordPos pos, const ir::LineInfo& info);
  bool run_element(const syntax::Block& block, const ir::LineInfo& info);
  bool crossing(const ir::VarRef& target, const syntax::Expr& call, WordPos pos, ir::Assign& out);
  // frames (lower_frames.cpp); nullopt: the target is no frame
  std::optional<bool> assign_frame(const syntax::Expr& target, const syntax::Expr& value, WordPos pos,
                                   ir::Assign& assign, std::vector<ir::Action>& actions);
  bool frame_statements(const ir::ExprPtr& value, WordPos pos, std::vector<ir::Action>& out);
  bool add_frame(const syntax::Expr& state, const syntax::Expr& call, WordPos pos, Parts& parts);
  [[nodiscard]] bool has_control_frame(std::string_view active) const;
  [[nodiscard]] ir::ExprPtr behind_frames(ir::ExprPtr frame, ir::ExprPtr added, const std::vector<syntax::Expr>& inside,
                                          WordPos pos);
  [[nodiscard]] std::vector<syntax::Expr> frames_inside(std::string_view active, int index, WordPos pos) const;
  bool offset_row(const ir::Expr& target, const ir::ExprPtr& value, WordPos pos, ir::Assign& out);
  // words of one axis (lower_axis_words.cpp)
  bool transformation(const std::string& name, const std::vector<syntax::Expr>& args, WordPos pos, Parts& parts);
  bool swivel(const std::vector<syntax::Expr>& args, WordPos pos, Parts& parts);
  bool swivel_end(WordPos pos, Parts& parts);
  void note_carrier(const syntax::Expr& target, const syntax::Expr& value);
  void turn_with_table(const syntax::Block& block, const ir::LineInfo& info);
  bool exchange_geometry_axes(WordPos pos, Parts& parts);
  bool preset(const std::string& name, const std::vector<syntax::Expr>& args, WordPos pos, Parts& parts);
  bool master_spindle(const std::vector<syntax::Expr>& args, WordPos pos, Parts& parts);
  bool axis_setting(const std::string& name, const std::vector<syntax::Expr>& args, WordPos pos, Parts& parts);
  static bool reads_like_axis(std::string_view name);
  struct ChosenBy {
    enum class Kind : std::uint8_t { spindle, axis, attribute } kind = Kind::spindle;
    std::string address, axis;  ///< of the word
    WordPos pos{};
  };
  syntax::Expr* chosen_part(syntax::Block& block, ChosenBy& by) const;
  void choices_of(const ChosenBy& by, WordPos pos, std::vector<syntax::Expr>& choices,
                  std::vector<ir::ExprPtr>& values) const;
  bool chosen_by_index(const syntax::Block& block, const ir::LineInfo& info);
  // blocks of which one code makes several (lower_fixed_points.cpp)
  bool split_block(const syntax::Block& block, const ir::LineInfo& info);
  bool via_point(const syntax::Block& block, std::size_t code, const ir::LineInfo& info);
  bool block_words(const syntax::Block& block, ir::Block& out);
  bool in_other_mode(const syntax::Block& block, const ir::LineInfo& info);
  bool chosen_g(const syntax::Statement& s, Parts& parts);
  bool indirect_g(const syntax::Statement& s, Parts& parts);
  bool axis_item(const syntax::Statement& s, Parts& parts);
  bool probe_item(const syntax::Statement& s, Parts& parts);
  bool polynomial_item(const syntax::Statement& s, Parts& parts);
  bool denominator(const std::vector<syntax::Expr>& args, WordPos pos, Parts& parts);
  bool spline_axes(const std::vector<syntax::Expr>& args, WordPos pos, Parts& parts);
  bool polynomial_path(const std::vector<syntax::Expr>& args, WordPos pos, Parts& parts);
  bool spindle_item(const syntax::Statement& s, Parts& parts);
  bool spindle_axis(const syntax::Statement& s, Parts& parts);
  bool put_axis_words(Parts& parts, ir::Block& words);
  bool assign_undefined(const syntax::Expr& target, const syntax::Expr& value, WordPos pos, Parts& parts);
  bool assign_system(const syntax::Expr& target, const syntax::Expr& value, WordPos pos, Parts& parts);
  /// A call that changes nothing of the path: kept as text with a note.
  bool without_effect(const std::string& name, WordPos pos, Parts& parts);
  /// A cycle that prepares others: the contour that CYCLE62 names is noted; CYCLE800 without arguments.
  bool moves_nothing(const std::string& name, const std::vector<syntax::Expr>& args, WordPos pos);
  bool sort_call(std::string name, const std::vector<syntax::Expr>& args, WordPos pos, Parts& parts);
  bool program_start(WordPos pos, Parts& parts);
  bool predefined(Procedure use, const std::string& name, const std::vector<syntax::Expr>& args, WordPos pos,
                  Parts& parts);
  bool message(const std::vector<syntax::Expr>& args, WordPos pos, Parts& parts);
  bool alarm(const std::vector<syntax::Expr>& args, WordPos pos, Parts& parts);
  void message_parts(const syntax::Expr& e, std::vector<ir::ExprPtr>& out);
  bool call_arguments(const std::string& name, const std::vector<syntax::Expr>& args, ir::CallRoutine& call);
  bool return_target(const std::vector<syntax::Expr>& args, WordPos pos, ir::Return& out);
  bool refuse(std::string_view feature, WordPos pos, std::string message, std::string hint = {});

  // beside the programmed path (lower_beside.cpp): true when it is, and put into `parts` or added
  bool beside_word(const syntax::Word& word, Parts& parts);
  bool beside_statement(const syntax::Statement& s, Parts& parts);
  void put_beside(std::string_view feature, WordPos pos, Parts& parts);
  void tell_beside(WordPos pos, const std::string& what, std::string_view feature);
  bool sets_at_once(const syntax::Statement& s, ir::LineInfo& info);
  bool call_in_real_time(WordPos pos);
  bool file_statement(const syntax::Statement& s, Parts& parts);
  [[nodiscard]] bool can_be_shown(const syntax::Expr& e) const;
  bool interrupt_routine(const syntax::Block& block, const ir::LineInfo& info);
  bool in_definition(const syntax::Block& block, const ir::LineInfo& info);
  bool gives_unknown(const std::vector<syntax::Expr>& args);
  bool behind_return(const syntax::Block& block, const ir::LineInfo& info);
  bool return_move(const syntax::Block& block, const ir::LineInfo& info);
  void open_definition();
  [[nodiscard]] std::string_view action_feature(std::string_view text) const;

  // cycles (lower_cycles.cpp)
  ir::CyclePtr cycle(const std::string& name, const std::vector<syntax::Expr>& args, WordPos pos);
  ir::CyclePtr turning(const std::string& name, const std::vector<syntax::Expr>& args, WordPos pos);

  // flow (lower_flow.cpp)
  bool flow(const syntax::Block& block, ir::LineInfo info);
  bool statement(const syntax::Statement& s, const syntax::Block& block, ir::LineInfo& info);
  bool if_statement(const syntax::Statement& s, ir::LineInfo& info);
  bool structure(const syntax::Statement& s, ir::LineInfo& info);
  bool for_statement(const syntax::Statement& s, ir::LineInfo& info);
  bool repeat(const syntax::Statement& s, ir::LineInfo& info);
  bool switch_statement(const syntax::Statement& s, ir::LineInfo& info);
  bool jump(const syntax::Statement& s, ir::Jump& out);
  bool label(const syntax::Expr& e, ir::LabelRef& out);
  bool unmatched(const syntax::Statement& s, std::string_view opener);

  // definitions and calls (lower_calls.cpp)
  bool definition(const syntax::Statement& s, ir::LineInfo& info);
  ir::ExprPtr initial_value(const syntax::Expr& e, ir::Type type);
  bool initial_values(const syntax::Expr& e, ir::Type type, std::size_t elements, std::vector<ir::ExprPtr>& out);
  bool proc(const syntax::Statement& s, ir::LineInfo& info);
  bool extern_declaration(const syntax::Statement& s, const syntax::Block& block, ir::LineInfo& info);
  bool macro(const syntax::Statement& s, const syntax::Block& block, ir::LineInfo& info);
  bool text_call(const syntax::Statement& s, ir::LineInfo& info);
  bool path_call(const syntax::Statement& s, ir::LineInfo& info);
  bool modal_call(const syntax::Statement& s, ir::LineInfo& info);
  static std::string_view code_text(std::string_view line, const syntax::Block& block);
  bool program_name(const syntax::Expr& e, ir::CallRoutine& call);
  std::optional<ir::Type> type_of(const syntax::Expr& type);

  void emit(ir::LineInfo& info, ir::StatementNode node);
  /// A line of its own for what else the block in `info` does: at its place, left out with it.
  static ir::LineInfo further_line(const ir::LineInfo& info);

  FileContext& c_;
  WordLowering& words_;
  ExprLowering exprs_;
  ir::Routine* routine_ = nullptr;
  std::optional<frontends::StructureBuilder> structure_;
  std::vector<std::string> labels_;                                ///< of the routine so far, in text order, capitals
  std::map<std::string, std::vector<bool>, std::less<>> externs_;  ///< name -> by reference?
  const Definition* definition_ = nullptr;                         ///< the blocks belong to it
  struct Contour {
    std::string table;
    syntax::Expr count;  ///< the variable for the number of relief cuts
    char type = 'L';
    ir::Plane plane = ir::Plane::xy;
    bool metric = true, other_axis = false;
    ir::MotionKind motion = ir::MotionKind::linear;
    ContourPoint at;
    std::vector<ContourElement> elements{};
  };
  std::optional<Contour> contour_{};  ///< being prepared; none: the text does not tell it
  Span definition_line_;              ///< where it begins
  bool returned_ = false;             ///< the block before returns to the contour, and so from the routine
  bool ended_ = false;
  bool other_mode_ = false;  ///< behind G291
  bool executable_seen_ = false;
  bool defines_characters_ = false;
  std::string_view feature_;  ///< why the block in work could not be carried
};

}  // namespace cnctrans::sinumerik
