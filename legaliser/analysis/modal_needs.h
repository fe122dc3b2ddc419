// Whether a modal fact that a called routine may have changed counts for anything behind the call.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "ir/analysis/call_graph.h"

namespace cnctrans::ir::passes {

/// A modal fact: one setting, the motion function, or the work offset.
struct ModalGroup {
  enum class Kind : std::uint8_t { setting, motion, offset } kind = Kind::motion;
  Setting setting = Setting::plane;  ///< Kind::setting only
};

/// Statements must be numbered, and stay as they are while this is asked.
class ModalNeeds {
 public:
  ModalNeeds(const Program& program, const CallGraph& calls);
  /// False: on every way behind the call the program sets the group again before anything depends on it. What is not
  /// followed (texts that are only kept, routines that are not at hand, modal calls) depends on it.
  [[nodiscard]] bool behind(const CallSite& site, const ModalGroup& group);
  /// The same behind a statement of a routine.
  [[nodiscard]] bool behind(std::size_t routine, const Statement& s, const ModalGroup& group);
  /// False: a further pass of the called routine sets the group again before anything depends on it.
  [[nodiscard]] bool again(const CallSite& site, const ModalGroup& group);

 private:
  enum class Effect : std::uint8_t { none, sets, uses };
  struct Search;
  [[nodiscard]] static Effect effect(const Block& block, const ModalGroup& group);
  [[nodiscard]] Effect effect(const Statement& s, const ModalGroup& group) const;
  bool runs_into_use(Search& search);
  void step(std::size_t routine, const Statement& s, Search& search);
  void behind_statement(std::size_t routine, const Statement& s, Search& search);
  void enter(std::size_t routine, Search& search);
  void leave(std::size_t routine, Search& search);
  const ControlFlow& flow(std::size_t routine);

  const Program& program_;
  const CallGraph& calls_;
  std::map<std::size_t, ControlFlow> flows_;
};

}  // namespace cnctrans::ir::passes
