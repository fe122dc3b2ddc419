// What a pass needs while it edits one routine: fresh labels, temporaries, and putting statements before another
// without losing jumps and repeated ranges that lead to it.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ir/analysis/label_uses.h"
#include "legaliser/edit/refuse.h"

namespace cnctrans::ir::passes {

/// Numbers of the target's variables that the program uses.
class UsedVariables {
 public:
  UsedVariables(const Program& program, const Routine& routine) { add(program, routine); }
  void add(const Program& program, const Routine& routine);
  [[nodiscard]] bool has(std::string_view prefix, std::int64_t n) const;
  [[nodiscard]] bool has_name(const std::string& name) const { return names_.count(name) != 0; }
  void add(const std::string& prefix, std::int64_t n) { numbers_[prefix].insert(n); }
  void add_name(const std::string& name) { names_.insert(name); }

 private:
  std::map<std::string, std::set<std::int64_t>, std::less<>> numbers_;
  std::set<std::string> names_;
};

class Editor {
 public:
  Editor(Program& program, Routine& routine, const LegaliseContext& context);
  ~Editor();  ///< declares named temporaries, renames range ends
  Editor(const Editor&) = delete;
  Editor& operator=(const Editor&) = delete;

  Program& program;
  Routine& routine;
  const LegaliseContext& context;
  [[nodiscard]] const Capabilities& target() const { return context.target; }

  /// A label that the routine does not have: an identifier where the target has them, else a number.
  LabelRef fresh_label();
  /// A variable that nothing else uses until it is released; nullopt: the pool is empty (reported once).
  std::optional<VarRef> take(const LineInfo& where);
  void release(const VarRef& v);
  /// Appends `pre` and then `s`; what leads to `s` leads to `pre` now, except the ends of ranges.
  void put(Body& out, Body&& pre, Statement&& s);
  /// Appends the pieces that a statement was split into; `main` carries its line.
  void put_group(Body& out, Body&& pieces, std::size_t main);

 private:
  VarRef variable_number(const std::string& prefix, std::int64_t n);
  LabelUses uses_;
  UsedVariables& used();
  UsedVariables used_;                 ///< of the routine, before a pass takes it apart
  bool used_whole_ = false;            ///< of the other routines as well, from the first temporary on
  std::vector<std::int64_t> numbers_;  ///< of labels, as they stand; asked only when the numbers above are used up
  std::set<std::string> identifiers_;
  std::int64_t next_number_ = 0;
  std::int64_t next_identifier_ = 0;
  std::vector<VarRef> free_;
  std::vector<std::string> declared_;
  std::vector<std::pair<LabelRef, LabelRef>> renamed_ends_;
  bool reported_ = false;
};

/// Loops and branches that a pass has made, as the target has them: jumps where it lacks the structure.
void lower_structures(Editor& editor, Body& body);

}  // namespace cnctrans::ir::passes
