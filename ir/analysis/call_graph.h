// Who calls whom, and whether a routine may read a variable before it writes it.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "ir/analysis/dataflow.h"
#include "ir/edit/rewrite.h"

namespace cnctrans::ir::passes {

struct CallSite {
  std::size_t caller = 0;
  std::optional<std::size_t> callee;  ///< none: not in the program, or computed
  CallLevel level = CallLevel::shared;
  const Statement* statement = nullptr;
};

class CallGraph {
 public:
  explicit CallGraph(const Program& program);
  [[nodiscard]] const std::vector<CallSite>& sites() const { return sites_; }
  /// What the statement may call.
  [[nodiscard]] std::span<const CallSite> sites_of(const Statement& s) const;
  [[nodiscard]] bool called_with(std::size_t routine, CallLevel level) const;
  [[nodiscard]] bool called(std::size_t routine) const;
  /// The routine, and those that it calls without a level of local parameters of their own.
  [[nodiscard]] std::set<std::size_t> sharing_level(std::size_t routine) const;
  /// A call that closes a ring; nullptr: no recursion.
  [[nodiscard]] const CallSite* recursion() const;
  [[nodiscard]] std::optional<std::size_t> index_of(const RoutineName& name) const;

 private:
  void add(std::size_t caller, const Statement& s, const CallRoutine& call);
  const Program& program_;
  std::vector<CallSite> sites_;                                 ///< those of a statement beside each other
  std::unordered_map<const Statement*, std::size_t> first_of_;  ///< of its sites
};

/// Reading before writing, through calls that share the variable: what a called routine certainly writes is written.
class ReadFirst {
 public:
  /// `follows_new_level`: a call with a level of its own reaches the variable too (true for globals).
  ReadFirst(const Program& program, const CallGraph& calls, bool follows_new_level);
  [[nodiscard]] bool operator()(std::size_t routine, const VarRef& v);

 private:
  struct Seen {
    bool reads = false;  ///< before it writes
    bool passes = true;  ///< it can return without having written
  };
  Seen search(std::size_t routine, const VarRef& v, const std::string& key);
  bool statement_reads(const Statement& s, const VarRef& v, bool& written) const;
  struct OfRoutine {
    ControlFlow flow;
    std::set<std::string>
        names;  ///< of its variables: with each index as a number, "?" for a computed one, and without
  };
  const OfRoutine& of(std::size_t routine);
  const Program& program_;
  const CallGraph& calls_;
  bool follows_new_level_;
  std::map<std::size_t, OfRoutine> routines_;
  std::map<std::pair<std::size_t, std::string>, Seen> memo_;
};

/// The space of variables that passes make for the frames of calls: named, one value each for the whole program. Names
/// are "P3@20": what it was, and in which routine.
inline constexpr std::string_view frame_prefix = "@";
/// The space of variables that become local parameters of the target: named, one set for each level.
inline constexpr std::string_view level_prefix = "@level";
SpaceId frame_space(Program& program);
SpaceId level_space(Program& program);
/// The segment that a numbered variable lies in; nullptr: named, computed or outside.
const SpaceSegment* segment_of(const Program& program, const VarRef& v);
/// "20", "BOSS", "0" for the main program.
std::string routine_tag(const Routine& r);

}  // namespace cnctrans::ir::passes
