// Tools (equivalences 15): change at T or at M6, tool length compensation that must be switched.
#include <algorithm>

#include "ir/analysis/ready_tools.h"
#include "ir/edit/search.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

template <class T>
bool has(const Block& b) {
  return std::any_of(b.actions.begin(), b.actions.end(),
                     [](const Action& a) { return std::holds_alternative<T>(a.data); });
}

template <class T>
bool program_has(const Program& program) {
  return any_action(program, [](const Action& a) { return std::holds_alternative<T>(a.data); });
}

bool sets(const Action& a, Setting s) {
  const auto* m = std::get_if<ModalSet>(&a.data);
  return m != nullptr && m->setting == s;
}

/// T that changes at once on one machine and waits for M6 on the other.
class ToolChanges {
 public:
  ToolChanges(const Program& program, const LegaliseContext& context, const ReadyTools& ready)
      : program_(program),
        context_(context),
        ready_(ready),
        at_once_(context.target_machine.policies.tool_change == machine::ToolChange::on_select),
        came_with_t_(context.source_machine.policies.tool_change == machine::ToolChange::on_select) {}

  void block(Statement& s) {
    auto& b = std::get<Block>(s.node);
    if (!has<ToolSelect>(b) && !has<ToolChange>(b)) return;
    std::vector<Action> out;
    bool changed = false;
    for (auto& a : b.actions) {
      if (auto* t = std::get_if<ToolSelect>(&a.data)) {
        changed = changed || t->changes != at_once_;
        select(std::move(a), has<ToolChange>(b), out);
      } else if (std::holds_alternative<ToolChange>(a.data) && came_with_t_ && !has<ToolSelect>(b)) {
        done_already(s, a);
      } else if (std::holds_alternative<ToolChange>(a.data) && at_once_) {
        if (!pending_ && !change(s, a)) return;
        if (pending_) write(a, out);
      } else {
        out.push_back(std::move(a));
      }
    }
    b.actions = std::move(out);
    settle(s);
  }

 private:
  void select(Action a, bool change_follows, std::vector<Action>& out) {
    auto& t = std::get<ToolSelect>(a.data);
    const bool did = t.changes;
    came_with_t_ = did && context_.source_machine.policies.tool_change == machine::ToolChange::on_select;
    if (did == at_once_) {
      out.push_back(std::move(a));
      return;
    }
    t.changes = at_once_;
    if (at_once_) {  // the source changes at M6, in this block or later
      if (change_follows) pending_ = std::move(a);
      return;
    }
    const Order order = a.order;
    out.push_back(std::move(a));
    if (!change_follows) out.push_back(action(ToolChange{}, order));  // when the source changes; `order` moves it
  }

  /// M6 where the target changes at T: the T that was waiting is written here. False: refused.
  bool change(Statement& s, const Action& a) {
    const ReadyTool ready = ready_.before(s);
    if (ready.unsure) {
      refuse(s, program_, context_, "TRN-146",
             "which tool this change brings depends on the way that leads here, and the target changes tools at T",
             "write T in the block of the change", a.pos);
      return false;
    }
    if (ready.tool && !ready.changed) {
      pending_ = action(*ready.tool);
      std::get<ToolSelect>(pending_->data).changes = true;
    }
    if (!ready.tool)
      context_.diagnostics.warning(
          "TRN-141", word_span(s.line.span, a.pos),
          "a tool change without a tool number before it in this program: left out, because the "
          "target changes tools at T",
          "write the T word before the change");
    return true;
  }
  void write(const Action& change, std::vector<Action>& out) {
    pending_->order = change.order;
    out.push_back(std::move(*pending_));
    pending_.reset();
  }

  /// M6 behind a T that changed the tool at once: nothing is left to do.
  void done_already(const Statement& s, const Action& a) {
    context_.diagnostics.note("TRN-141", word_span(s.line.span, a.pos),
                              "the tool is changed at T on the source's machine; the tool change after it does nothing "
                              "there and is left out");
  }

  const Program& program_;
  const LegaliseContext& context_;
  const ReadyTools& ready_;
  bool at_once_;
  bool came_with_t_;               ///< the T before M6 has changed the tool: any T does on a machine that changes at T
  std::optional<Action> pending_;  ///< the T of the block at hand
};

/// Length compensation: left out where the target always has it, switched on where the target needs it.
class LengthCompensation {
 public:
  LengthCompensation(Program& program, const LegaliseContext& context) : program_(program), context_(context) {
    source_switches_ = uses_switch();
    add_ = context.target.length_comp_switch && !source_switches_ &&
           context.target_machine.power_on.length_comp == OnOff::off &&
           context.source_machine.power_on.length_comp == OnOff::on;
    drop_ = !context.target.length_comp_switch || context.target_machine.power_on.length_comp == OnOff::on;
  }

  void run() {
    if (drop_ && source_switches_) drop();
    if (drop_ && !source_switches_ && context_.source_machine.power_on.length_comp == OnOff::off) warn_never_on();
    if (add_) add();
  }

 private:
  bool uses_switch() const {
    bool found = false;
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&found](const Statement& s) {
        const auto* b = std::get_if<Block>(&s.node);
        if (b == nullptr) return;
        for (const auto& a : b->actions) found = found || sets(a, Setting::length_comp);
      });
    }
    return found;
  }

  void drop() {
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [this](Statement& s) {
        auto* b = std::get_if<Block>(&s.node);
        if (b == nullptr) return;
        bool dropped = false;
        std::erase_if(b->actions, [&](const Action& a) {
          if (!sets(a, Setting::length_comp)) return false;
          if (std::get<ModalSet>(a.data).value == static_cast<std::uint8_t>(OnOff::off)) warn_off(s, a);
          dropped = true;
          return true;
        });
        if (dropped) settle(s);
      });
    }
  }
  void warn_off(const Statement& s, const Action& a) {
    context_.diagnostics.warning(
        "TRN-142", word_span(s.line.span, a.pos),
        "tool length compensation is switched off here; the target has it on whenever an offset is "
        "active: the programmed positions are the same, the machine stands off by the tool length",
        "check the moves up to the next tool change, or select offset 0 here");
  }
  void warn_never_on() {
    if (!program_has<ToolOffset>(program_) && !program_has<ToolSelect>(program_)) return;
    const Routine* main = program_.main();
    context_.diagnostics.warning(
        "TRN-143", main != nullptr ? main->header.span : Span{},
        "the program never switches tool length compensation on; the target always applies the "
        "length of the active offset",
        "use offsets with length 0 on the target, or switch the compensation on in the source");
  }

  // Switched on in the first move along the tool axis of every path, and again after each tool change for the reader's
  // sake. Every such move gets the switch first; then those go that find it on in any case.
  void add() {
    const FactsOf facts(program_, context_);
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [&](Statement& s) {
        auto* b = std::get_if<Block>(&s.node);
        if (b == nullptr) return;
        if (goes_to_reference(*b)) b->actions.push_back(made_switch(OnOff::off));
        if (moves_along(*b, facts.before(s))) b->actions.insert(b->actions.begin(), made_switch(OnOff::on));
      });
    }
    ModalState start = context_.source_machine.power_on;
    start.length_comp = OnOff::off;
    const FactTable table = analyse(program_, start);
    for (auto& r : program_.routines) {
      bool new_tool = false;
      for_each_statement(r.body, [&](Statement& s) {
        auto* b = std::get_if<Block>(&s.node);
        if (b == nullptr) return;
        new_tool = new_tool || has<ToolChange>(*b) || has<ToolSelect>(*b);
        std::erase_if(b->actions, [](const Action& a) { return is_switch(a, OnOff::off); });
        if (b->actions.empty() || !is_switch(b->actions.front(), OnOff::on)) return;
        const bool on = setting<OnOff>(table.before(s.id), Setting::length_comp) == OnOff::on;
        if (on && !new_tool) b->actions.erase(b->actions.begin());
        new_tool = false;
      });
    }
  }

  static Action made_switch(OnOff to) {
    return action(ModalSet{Setting::length_comp, static_cast<std::uint8_t>(to), true, {}});
  }
  static bool is_switch(const Action& a, OnOff to) {
    return sets(a, Setting::length_comp) && std::get<ModalSet>(a.data).value == static_cast<std::uint8_t>(to);
  }
  /// The way to the reference point ends the compensation on controls that switch it.
  static bool goes_to_reference(const Block& b) { return b.has_motion && b.motion.kind == MotionKind::reference_point; }
  /// Moves along the tool axis by programmed positions.
  static bool moves_along(const Block& b, const Facts& facts) {
    if (!facts.reachable) return false;
    for (const auto& a : b.actions) {
      const auto* d = std::get_if<CycleDefine>(&a.data);
      if (d != nullptr && d->here) return true;
    }
    if (!b.has_motion || b.motion.frame != FrameUse::normal || goes_to_reference(b)) return false;
    const auto plane = setting_in<Plane>(b, facts, Setting::plane);
    const auto& coords = b.motion.coords;
    return std::any_of(coords.begin(), coords.end(), [plane](const CoordWord& c) {
      return plane ? c.axis == plane_axes(*plane).w : c.axis <= axis::z;
    });
  }

  Program& program_;
  const LegaliseContext& context_;
  bool source_switches_ = false, add_ = false, drop_ = false;
};

}  // namespace

void convert_tools(Program& program, const LegaliseContext& context) {
  const bool as_written = program.dialect == context.target.dialect &&
                          context.source_machine.policies.tool_change == context.target_machine.policies.tool_change;
  const ReadyTools ready(program);
  for (auto& r : program.routines) {
    if (as_written) break;
    ToolChanges changes(program, context, ready);
    for_each_statement(r.body, [&changes](Statement& s) {
      if (std::holds_alternative<Block>(s.node)) changes.block(s);
    });
  }
  LengthCompensation(program, context).run();
}

}  // namespace cnctrans::ir::passes
