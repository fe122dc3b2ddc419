// A whole file to a program: header, local subroutines, main part, subroutines.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "frontends/common/frontend.h"
#include "frontends/fagor/state/state.h"
#include "frontends/fagor/syntax/line_reader.h"
#include "frontends/fagor/words/block.h"

namespace cnctrans::fagor {

class ProgramReader {
 public:
  ProgramReader(const frontends::ReadOptions& options, FileId file, Diagnostics& diagnostics);
  ir::Program read(const SourcePtr& source, frontends::ReadStats* stats);
  /// Planes to read the file once more with, by line: the flow of the program brings another one to some block than the
  /// text before it says. Empty: it was read right.
  [[nodiscard]] std::map<std::uint32_t, ir::Plane> planes_by_flow() const;
  void know_planes(std::map<std::uint32_t, ir::Plane> by_line) { state_.know_planes(std::move(by_line)); }
  /// Lines at which the main part goes on behind a subroutine (subroutine_ends.h); the file is read once more with
  /// them.
  [[nodiscard]] const std::set<std::uint32_t>& lines_of_main() const { return found_lines_of_main_; }
  void know_lines_of_main(std::set<std::uint32_t> lines) { lines_of_main_ = std::move(lines); }

 private:
  void line(const SourceLine& source_line);
  void percent(std::string_view text);
  void block(std::string_view text);
  void open_subroutine(const syntax::Statement& statement);
  void close_subroutine();
  void go_on_with_main();
  void iso_block(std::string_view text);
  void add(ir::Statement statement);
  void add_trivia();
  void look_for_lost_blocks();
  void unread(std::string_view text, const ParseError& error);
  void describe_file(const SourceText& source);
  void settle_main();
  [[nodiscard]] ir::Routine& current() { return program_.routines[current_]; }
  [[nodiscard]] ir::Statement fresh() const;

  FileId file_;
  LowerState state_;
  LineReader reader_;
  BlockLowerer lowerer_{state_};
  syntax::Block block_;
  ir::Program program_;
  std::size_t current_ = 0;
  std::set<std::uint32_t> lines_of_main_, found_lines_of_main_;
  std::optional<LowerState> main_state_;  ///< at the (SUB) that stands behind blocks of the main part
  bool main_has_code_ = false;
  bool header_allowed_ = true;
  bool local_group_ = false;  ///< LSUB groups were read and the start mark was not
  bool ended_ = false;        ///< a lone % after code: only blank lines may follow
  bool control_noted_ = false;
  ir::Body pending_;  ///< comments and blank lines that wait for the block they belong to
  std::set<std::pair<bool, std::int64_t>> numbers_;
  frontends::ReadStats stats_;
  std::size_t lost_blocks_ = 0;  ///< comments of an earlier conversion
  Span first_lost_block_;
};

/// Completes what depends on the whole file: pole and frame resets, planes, units of machine moves.
void finish_program(ir::Program& program, LowerState& state);

}  // namespace cnctrans::fagor
