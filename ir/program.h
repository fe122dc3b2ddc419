// The program: routines, variable spaces, the files they came from.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/source.h"
#include "ir/expr.h"
#include "ir/statement.h"

namespace cnctrans::ir {

enum class Scope : std::uint8_t {
  global,   ///< one value, all routines; survives calls
  level,    ///< one set for each level of calls with own parameters (CallLevel::new_level)
  routine,  ///< one set for each activation of a routine
  program,  ///< of the main program; seen below only if the space says so
  system
};

/// A part of a numbered space: numbers lo..hi have this scope.
struct SpaceSegment {
  std::int64_t lo = 0, hi = 0;
  Scope scope = Scope::global;
  bool persistent = true;  ///< survives the program end
  bool read_only = false;
  bool stops_preparation = false;
  bool zero_points = false;  ///< the control keeps its zero points in them: they hold values before the program
};
/// A space of variables: numbered ("P", "L", "R") or named (name empty segments).
struct VariableSpace {
  std::string prefix;                  ///< "P" for P100; "" for named variables
  std::vector<SpaceSegment> segments;  ///< empty: named space
  Scope scope = Scope::routine;        ///< of a named space
  Type type = Type::real;
  bool starts_at_zero = false;  ///< reading before writing gives 0; else it gives 0 with a note
  bool named() const { return segments.empty(); }
};

struct Parameter {
  std::string name;  ///< formal name, or letter
  Type type = Type::real;
  std::string type_text;
  bool by_reference = false;
  ExprPtr default_value;
  VarRef variable;  ///< the variable it sets in the callee
};

enum class RoutineKind : std::uint8_t { main, sub };
enum class Locality : std::uint8_t { global, file_local };

struct Routine {
  RoutineKind kind = RoutineKind::main;
  Locality locality = Locality::global;
  RoutineName name;
  std::string title;       ///< program title or comment of its header
  std::string attributes;  ///< header attributes, kept as text
  LineInfo header;         ///< line that opens it (header, SUB, PROC); span unknown when there is none
  std::vector<Parameter> parameters;
  bool has_signature = false;  ///< PROC line present
  bool saves_modals = false;   ///< modal state comes back at return (SAVE)
  std::string header_text;     ///< further attributes of the header as written (DISPLOF...)
  Body body;
  FileId file = 0;
};

/// How a source file looked, so that a translation can look the same.
struct FileLook {
  FileId file = 0;
  std::string name;
  Encoding encoding = Encoding::utf8;
  Eol eol = Eol::lf;
  bool bom = false;
  bool final_eol = true;
  std::vector<std::string> leader;  ///< lines before the program (tape leader), raw
  std::string trailer;              ///< bytes after the program (%, ^Z, EOT), raw
  bool archive = false;             ///< several programs with archive headers
};

/// Text that outlives the source it came from.
class TextKeeper {
 public:
  std::string_view keep(std::string text) {
    kept_.push_back(std::move(text));
    return kept_.back();
  }
  void hold(SourcePtr source) { sources_.push_back(std::move(source)); }
  /// The held source of this name; null when it is not held.
  [[nodiscard]] SourcePtr source(std::string_view name) const {
    for (const SourcePtr& s : sources_) {
      if (s && s->name() == name) return s;
    }
    for (const auto& other : shared_) {
      if (SourcePtr s = other->source(name)) return s;
    }
    return nullptr;
  }
  /// Keeps another program's texts alive as well.
  void share(std::shared_ptr<TextKeeper> other) { shared_.push_back(std::move(other)); }

 private:
  std::deque<std::string> kept_;
  std::vector<std::shared_ptr<TextKeeper>> shared_;
  std::vector<SourcePtr> sources_;
};

struct Program {
  std::string dialect;            ///< registry name of the language it was read from ("" for hand-made IR)
  std::vector<Routine> routines;  ///< [0] is the main program when there is one
  std::vector<VariableSpace> spaces;
  std::vector<std::string> axis_names;  ///< names of axes from axis::first_extra on
  std::vector<FileLook> files;
  Units unit_hint = Units::metric;
  bool lathe = false;
  std::shared_ptr<TextKeeper> texts = std::make_shared<TextKeeper>();

  [[nodiscard]] std::string_view axis_name(AxisId id) const;
  [[nodiscard]] const Routine* main() const;
  [[nodiscard]] const Routine* find(const RoutineName& name) const;
  /// Index of the space with this prefix, or spaces.size().
  [[nodiscard]] SpaceId space(std::string_view prefix) const;
  std::string_view keep(std::string text) { return texts->keep(std::move(text)); }
};

/// Gives every statement an id in text order, from 1; returns the count.
std::uint32_t number_statements(Program& program);

/// Calls `visit(Statement&)` for every statement of the body, nested ones too, in text order.
template <class BodyType, class Visitor>
void for_each_statement(BodyType& body, const Visitor& visit) {
  for (auto& s : body) {
    visit(s);
    if (auto* i = std::get_if<If>(&s.node)) {
      for_each_statement(i->then_body, visit);
      for_each_statement(i->else_body, visit);
    } else if (auto* w = std::get_if<While>(&s.node)) {
      for_each_statement(w->body, visit);
    } else if (auto* u = std::get_if<Until>(&s.node)) {
      for_each_statement(u->body, visit);
    } else if (auto* f = std::get_if<For>(&s.node)) {
      for_each_statement(f->body, visit);
    } else if (auto* l = std::get_if<Loop>(&s.node)) {
      for_each_statement(l->body, visit);
    }
  }
}

}  // namespace cnctrans::ir
