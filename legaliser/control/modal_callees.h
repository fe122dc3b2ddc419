// What the subprogram of a modal call does, with those that it calls.
#pragma once

#include <set>
#include "ir/analysis/call_graph.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

/// Of a statement that says nothing any more its labels and remarks stay.
void leave_line(Statement&& s, Body& out);
/// Some modal call of a subprogram begins.
bool starts_modal_calls(const Program& program);
/// The routine begins or ends a modal call.
bool has_modal_call(const Routine& r);
/// The called routine, or one below it, does so.
bool changes_modal_calls(const Program& program, const CallGraph& calls, const CallRoutine& call);
/// Its arguments are the same wherever it stands.
bool fixed_arguments(const CallRoutine& call);
/// It, or one below it, defines a cycle.
bool defines_cycle(const Program& program, const CallGraph& calls, const CallRoutine& call);
/// It, or one below it, moves, goes to the points of a pattern, or calls what is not at hand.
bool may_move(const Program& program, const CallGraph& calls, const CallRoutine& call);
/// Its increments in the plane do not add up to nothing, or it goes to places there.
bool leaves_its_point(const Program& program, const CallGraph& calls, const CallRoutine& call, const FactsOf& facts);
/// The way from point to point starts elsewhere each time: the axes of the plane are said at all points. `facts`:
/// before the first one.
void say_all_axes(Body& way, const Facts& facts);
/// The way goes along arcs, each of which starts where the subprogram ends: perhaps at another point of the plane than
/// where it was called.
bool arcs_from_elsewhere(const Body& way, const Program& program, const CallGraph& calls, const CallRoutine& call,
                         const FactsOf& facts);
/// The block runs the modal subprogram, on a machine where words alone do so or not. `facts`: before it.
bool runs_modal_call(const Block& b, const Facts& facts, bool by_words);
/// Behind it this feed is in force when it is before it.
bool leaves_feed(const Program& program, const CallGraph& calls, const CallRoutine& call, double feed);
/// What the block does behind its motion, or in blocks of their own on another control, a modal call would come before.
bool acts_behind_motion(const Block& b);
/// The ways from point to point have a feed of their own: the one before comes back behind each of them.
bool goes_at_a_feed(const NamedCycle* pattern);
/// Routines that run outside of modal subprograms: the main program and what it calls.
std::set<std::size_t> called_by_main(const Program& program, const CallGraph& calls);
/// Called with arguments here and on the caller's level elsewhere: its parameters may have to be set before each call.
bool shares_level_too(const CallGraph& calls, const CallRoutine& call);

/// It changes parameters of its own level that it reads first: a further run without the arguments would go on with
/// them.
bool reads_own_locals(const Program& program, const CallGraph& calls, ReadFirst& reads_first, const CallRoutine& call);

/// A domain of FlowStates: the statement that switched the modal call in force on.
struct ModalCallInForce {
  using State = std::uint32_t;                                 ///< its id; 0: none is in force
  static constexpr std::uint32_t several = ~std::uint32_t{0};  ///< the ways that lead here bring different ones

  [[nodiscard]] static State start(const Routine& /*unused*/, bool /*unused*/) { return 0; }
  static void transfer(const Statement& s, State& state) {
    if (const auto* m = std::get_if<ModalCall>(&s.node)) state = m->off || m->cycle ? 0 : s.id;
  }
  [[nodiscard]] static bool touches(const Routine& r) { return has_modal_call(r); }
  static void unknown(State& /*state*/) {}  // what is not at hand is taken to leave the caller's modal call alone
  static bool join(State& a, const State& b) {
    if (a == b || a == several) return false;
    a = several;
    return true;
  }
};

}  // namespace cnctrans::ir::passes
