// More M functions in a block than the target's control takes (equivalences 4 e), and two commands to one spindle: some
// of them get blocks of their own, before the motion or behind it, in the order in which they act.
#include <algorithm>

#include "base/text.h"
#include "legaliser/early_passes.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

struct Limits {
  std::size_t all = 0;      ///< M functions of a block; 0: no limit
  std::size_t machine = 0;  ///< of these the functions of the machine; 0: no limit
};

bool is_m(const Action& a) {
  const auto* m = std::get_if<MachineFunction>(&a.data);
  return (m != nullptr && !m->auxiliary) || std::holds_alternative<SpindleRun>(a.data) ||
         std::holds_alternative<SpindleOrient>(a.data) || std::holds_alternative<SpindleGear>(a.data) ||
         std::holds_alternative<ToolChange>(a.data) || std::holds_alternative<Coolant>(a.data) ||
         std::holds_alternative<Stop>(a.data);
}

bool crowded(const std::vector<Action>& actions, const Limits& limits) {
  std::size_t all = 0, machine = 0;
  std::uint64_t spindles = 0;
  for (const auto& a : actions) {
    if (!is_m(a)) continue;
    ++all;
    if (std::holds_alternative<MachineFunction>(a.data)) ++machine;
    const auto* run = std::get_if<SpindleRun>(&a.data);
    if (run == nullptr || run->number > 63) continue;
    const std::uint64_t one = std::uint64_t{1} << static_cast<unsigned>(run->number);
    if ((spindles & one) != 0) return true;
    spindles |= one;
  }
  return (limits.all != 0 && all > limits.all) || (limits.machine != 0 && machine > limits.machine);
}

/// The actions as blocks without motion, as many in each as it takes.
void put_chunks(std::vector<Action> actions, const LineInfo& like, const Limits& limits, Body& pieces) {
  std::vector<Action> block;
  const auto cut = [&] {
    if (block.empty()) return;
    Statement s = made(like, Block{});
    std::get<Block>(s.node).actions = std::move(block);
    block.clear();
    pieces.push_back(std::move(s));
  };
  for (auto& a : actions) {
    block.push_back(a);
    if (!crowded(block, limits)) continue;
    block.pop_back();
    cut();
    block.push_back(std::move(a));
  }
  cut();
}

/// What leaves a block that moves goes with the words it may rest on.
bool may_leave(const Action& a) {
  const auto* m = std::get_if<ModalSet>(&a.data);
  return makes_event(a) || std::holds_alternative<SetSpindle>(a.data) ||
         (m != nullptr && m->setting == Setting::spindle_mode);
}

void split(Editor& editor, Statement&& s, const Limits& limits, Body& out) {
  auto& b = std::get<Block>(s.node);
  Body pieces;
  if (!has_motion(b)) {
    put_chunks(std::move(b.actions), s.line, limits, pieces);
    b.actions = std::move(std::get<Block>(pieces.front().node).actions);
    pieces.front() = std::move(s);
    return editor.put_group(out, std::move(pieces), 0);
  }
  std::vector<Action> early, late;
  while (crowded(b.actions, limits)) {
    const auto first = std::find_if(b.actions.begin(), b.actions.end(),
                                    [](const Action& a) { return a.order != Order::after && may_leave(a); });
    if (first != b.actions.end()) {
      early.push_back(std::move(*first));
      b.actions.erase(first);
      continue;
    }
    const auto last = std::find_if(b.actions.rbegin(), b.actions.rend(),
                                   [](const Action& a) { return a.order == Order::after && is_m(a); });
    if (last == b.actions.rend()) break;
    late.insert(late.begin(), std::move(*last));
    b.actions.erase(std::next(last).base());
  }
  const LineInfo like = s.line;
  put_chunks(std::move(early), like, limits, pieces);
  const std::size_t main = pieces.size();
  pieces.push_back(std::move(s));
  put_chunks(std::move(late), like, limits, pieces);
  editor.put_group(out, std::move(pieces), main);
}

}  // namespace

void split_crowded_blocks(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect) return;
  const auto& machine = context.target_machine.policies;
  const auto limit = [](double most) { return static_cast<std::size_t>(std::max(0.0, most)); };
  const Limits limits{limit(machine.block_m_functions), limit(machine.block_machine_functions)};
  edit_blocks(program, context, [&limits](Editor& editor, Statement&& s, Body& out) {
    const auto& b = std::get<Block>(s.node);
    if (b.actions.size() > 1 && b.repeat_given == 0 && crowded(b.actions, limits)) {
      split(editor, std::move(s), limits, out);
    } else {
      out.push_back(std::move(s));
    }
  });
}

}  // namespace cnctrans::ir::passes
