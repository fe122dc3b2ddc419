// Puts a flat sequence of statements into nested bodies: IF ... ELSE ... ENDIF, WHILE, REPEAT ... UNTIL, FOR, LOOP. The
// frontend says what it reads, line by line; wrong nesting is answered with false and leaves everything as it was.
#pragma once

#include <vector>

#include "ir/program.h"

namespace cnctrans::frontends {

class StructureBuilder {
 public:
  enum class Kind : std::uint8_t { if_, while_, until, for_, loop };

  /// Statements of the outermost level go to `root`, which must outlive the builder.
  explicit StructureBuilder(ir::Body& root) : root_(&root) {}

  void add(ir::Statement statement);
  /// `statement.node` is an If (not one-line), While, Until, For or Loop without bodies.
  void open(ir::Statement statement);
  /// ELSE of the innermost construct; false: that is no IF, or it has its ELSE.
  bool else_branch(ir::LineInfo line);
  /// End of the innermost construct; false: it is of another kind.
  bool close(Kind kind, ir::LineInfo line);
  /// UNTIL of the innermost REPEAT.
  bool close_until(ir::ExprPtr condition, ir::LineInfo line);

  [[nodiscard]] std::size_t depth() const { return open_.size(); }
  /// True when a loop is open (for EXIT).
  [[nodiscard]] bool in_loop() const;
  /// Ends of the body being filled (to look at or change the last statement); null when it is empty.
  [[nodiscard]] ir::Statement* last();
  /// What is still open has no end in its program: the lines that open it and divide it stand as unread statements, the
  /// rest between them as it would without. The places where those constructs begin, outermost first. `source` has
  /// the lines.
  std::vector<Span> finish(const SourceText* source);

 private:
  struct Open {
    ir::Statement statement;
    Kind kind;
    bool in_else = false;
  };
  [[nodiscard]] ir::Body& body();
  static ir::Body& body_of(Open& open);

  ir::Body* root_;
  std::vector<Open> open_;
};

}  // namespace cnctrans::frontends
