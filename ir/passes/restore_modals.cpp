// Routines that give their caller its modal state back (equivalences 21.1): on a target without that the state is
// written out before each return.
#include <algorithm>
#include <set>

#include "ir/passes/call_graph.h"
#include "ir/passes/early_passes.h"
#include "ir/passes/editor.h"
#include "ir/passes/facts.h"

namespace cnctrans::ir::passes {

namespace {

class Restore {
 public:
  Restore(Program& program, const LegaliseContext& context)
      : program_(program), context_(context), calls_(program), facts_(program, context) {}

  void run() {
    for (std::size_t i = 0; i < program_.routines.size(); ++i) {
      if (program_.routines[i].saves_modals) routine(i);
    }
    for (auto& r : program_.routines) r.saves_modals = false;
  }

 private:
  /// What the routine and those that it calls set.
  struct Changes {
    std::set<Setting> settings;
    bool motion = false, offset = false;
  };

  Changes changes_of(std::size_t index) const {
    std::set<std::size_t> reached{index};
    for (bool more = true; more;) {
      more = false;
      for (const auto& site : calls_.sites()) {
        if (site.callee && reached.count(site.caller) != 0) more = reached.insert(*site.callee).second || more;
      }
    }
    Changes c;
    for (const auto r : reached) {
      for_each_statement(program_.routines[r].body, [&c](const Statement& s) {
        const auto* b = std::get_if<Block>(&s.node);
        if (b == nullptr) return;
        c.motion = c.motion || (b->has_motion && b->motion.kind != MotionKind::modal && b->motion.keeps_modal);
        for (const auto& a : b->actions) {
          if (const auto* m = std::get_if<ModalSet>(&a.data)) c.settings.insert(m->setting);
          c.offset = c.offset || std::holds_alternative<WorkOffset>(a.data);
        }
      });
    }
    return c;
  }

  void routine(std::size_t index) {
    Routine& r = program_.routines[index];
    if (r.body.empty()) return;
    const Changes changes = changes_of(index);
    const Facts entry = facts_.before(r.body.front());
    if (!known(r, changes, entry)) return;
    Editor editor(program_, r, context_);
    rewrite_body(r.body, [&](Statement&& s, Body& out) {
      const auto* end = std::get_if<End>(&s.node);
      const bool back = std::holds_alternative<Return>(s.node) || (end != nullptr && end->returns_from_sub);
      Body pieces;
      if (back) written_back(s.line, changes, entry, facts_.before(s), pieces);
      editor.put(out, std::move(pieces), std::move(s));
    });
    if (std::holds_alternative<Return>(r.body.back().node) || std::holds_alternative<End>(r.body.back().node)) return;
    Body pieces;
    written_back(r.body.back().line, changes, entry, Facts{}, pieces);
    for (auto& p : pieces) r.body.push_back(std::move(p));
  }

  /// Without what held at the call there is nothing to write back.
  bool known(const Routine& r, const Changes& changes, const Facts& entry) const {
    std::string missing;
    const auto lacks = [&missing](std::string_view what) {
      missing += (missing.empty() ? "" : ", ") + std::string(what);
    };
    for (const auto s : changes.settings) {
      if (!entry.settings[static_cast<std::size_t>(s)] || s == Setting::units) lacks(name(s));
    }
    const bool plain = entry.motion == MotionKind::rapid || entry.motion == MotionKind::linear;
    if (changes.motion && !plain) lacks("motion function");
    if (changes.offset && !entry.work_offset) lacks("work offset");
    if (missing.empty()) return true;
    context_.diagnostics.error(
        "TRN-189", r.header.span,
        "the subprogram gives its caller the modal state back (SAVE), and what holds at its calls "
        "is not known or not the same everywhere: " +
            missing,
        "write the state after each call");
    return false;
  }

  void written_back(const LineInfo& like, const Changes& changes, const Facts& entry, const Facts& now,
                    Body& out) const {
    Block b;
    for (const auto s : changes.settings) {
      const auto index = static_cast<std::size_t>(s);
      if (now.settings[index] == entry.settings[index]) continue;
      ModalSet set;
      set.setting = s;
      set.value = *entry.settings[index];
      set.feed_memory = FeedMemory::per_mode;
      b.actions.push_back(action(set));
    }
    if (changes.offset && now.work_offset != entry.work_offset) {
      b.actions.push_back(action(WorkOffset{Value(static_cast<double>(*entry.work_offset)), *entry.work_offset == 0}));
    }
    if (changes.motion && now.motion != entry.motion) {
      b.has_motion = true;
      b.motion.kind = *entry.motion;
      b.motion.explicit_code = true;
    }
    if (!b.empty()) out.push_back(made(like, std::move(b)));
  }

  Program& program_;
  const LegaliseContext& context_;
  CallGraph calls_;
  FactsOf facts_;
};

}  // namespace

void restore_modals(Program& program, const LegaliseContext& context) {
  const bool saves =
      std::any_of(program.routines.begin(), program.routines.end(), [](const Routine& r) { return r.saves_modals; });
  if (saves && context.target_machine.option("call.saves_modals") != "yes") Restore(program, context).run();
}

}  // namespace cnctrans::ir::passes
