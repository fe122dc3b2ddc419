// Lines of a file -> statements of its programs: order of action inside a line, headers, structured statements,
// symbols.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "frontends/common/frontend.h"
#include "frontends/common/structure_builder.h"
#include "frontends/num/state/lower.h"
#include "frontends/num/syntax/reader.h"

namespace cnctrans::frontends::num {

/// Number, skip mark and comments of a block into a line; no allocation when `line` has its memory.
void fill_line(const syntax::Block& b, const Span& span, ir::LineInfo& line);
/// The program ends with its text (`end`: its last line).
void note_missing_end(const Span& end, Diagnostics& diagnostics);

/// Name of a program without a header: the number that its file is named by, or the file's name in capitals.
ir::RoutineName name_of_file(std::string_view stem);

class FileReader {
 public:
  FileReader(const SourcePtr& source, FileId file, const ReadOptions& options, Diagnostics& diagnostics,
             ReadStats& stats);

  /// Reads with what the ways of the program bring, as an earlier reading found it.
  void know_arrivals(const Arrivals& arrivals, std::map<std::uint32_t, ActiveCycle> cycles) {
    lower_.know_arrivals(arrivals, std::move(cycles));
  }
  [[nodiscard]] const Lowering& lowering() const { return lower_; }
  /// The whole file; call once.
  ir::Program read();

 private:
  void line(const SourceLine& source_line);
  void header(const syntax::Statement& s, const Span& span);
  void tape_mark(std::string_view raw);
  void begin_routine(ir::RoutineName name, std::string title, ir::LineInfo header);
  void end_routine();
  void close_blank(const Span& next);

  void block(const Span& span, std::string_view text);
  bool structured(const syntax::Statement& s);
  /// Opens a structure; it is told where they are nested too deeply.
  template <typename Node>
  bool open(Node node, WordPos pos);
  bool for_loop(const syntax::Statement& s);
  /// Refuses the end of a structure that was not begun; true.
  bool without(const syntax::Statement& s, std::string_view what);
  bool carried(const syntax::Statement& s);
  bool assignments();
  bool stack(const syntax::Statement& s);
  void check_stack();
  void declare(const syntax::Statement& s);
  void put_shift(std::vector<ir::FrameWord> words);
  void message(const syntax::Statement& s);
  void words(const syntax::Statement* test);
  void macro_call();
  void program_call();
  void find_macros();
  void latch();
  void take_over_preset();
  void split_call(ir::Statement flow);
  void opaque(const Span& span, std::string_view text, std::string_view feature, bool harmless);
  void put(ir::Statement s);
  template <class Node>
  void put_node(Node node) {
    ir::Statement s = with_line();
    s.node = std::move(node);
    put(std::move(s));
  }
  [[nodiscard]] ir::Statement with_line();
  void check_label();

  SourcePtr source_;
  FileId file_;
  Diagnostics& diagnostics_;
  ReadStats& stats_;
  Settings settings_;
  Lowering lower_;
  BlockReader reader_;
  ir::Program program_;
  ir::Routine routine_;
  StructureBuilder builder_{routine_.body};
  bool open_ = false;          ///< a routine is being read
  bool only_comments_ = true;  ///< and holds nothing but blank lines and comments so far
  bool in_var_ = false;
  bool latches_ = false;  ///< the program reads positions that an interruptible block latched
  /// A PUSH that waits for its PULL.
  struct Pushed {
    std::int64_t first = 0, last = 0;  ///< the variables
    std::uint32_t line = 0, number = 0;
  };
  std::vector<Pushed> pushed_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stacked_;  ///< lines of PUSH and PULL of this program
  std::uint32_t push_count_ = 0;
  std::uint16_t blank_ = 0;  ///< blank lines since the last statement
  bool ended_ = false;       ///< the routine has an M02

  // Of the line at hand.
  syntax::Block syntax_;
  ir::LineInfo line_;
  bool first_ = true;  ///< no statement of the line has been put yet
  Span span_;
  std::string_view text_;
  ir::Block scratch_;
  Flow flow_;
};

}  // namespace cnctrans::frontends::num
