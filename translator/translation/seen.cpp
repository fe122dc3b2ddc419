#include "translator/translation/seen.h"

#include <algorithm>
#include <bitset>
#include <iterator>
#include <set>
#include <utility>

#include "interpreter/program/interpreter.h"
#include "ir/edit/rewrite.h"
#include "ir/motion_kinds.h"

namespace cnctrans::translator {

namespace {

constexpr std::size_t most_skip_levels = 3;  ///< each set of them is a run
constexpr std::uint64_t most_events = 50'000, most_steps = 500'000;

class NoEvents : public interpreter::TraceSink {
 public:
  void on_event(const interpreter::Event&) override {}
};

/// Reads data of the machine or goes to its places, selects work offsets, changes frames on a machine whose increments
/// add to what was programmed before.
struct Inputs {
  bool reads_machine = false, frames = false, offsets = false, inches = false;
  std::uint32_t skips = 0;  ///< bit n: level n
};
Inputs inputs_of(const ir::Program& program) {
  Inputs found;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&found](const ir::Statement& s) {
      ir::passes::each_expression(s, [&found](const ir::ExprPtr& e) {
        ir::walk(e, [&found](const ir::ExprPtr& x) {
          const auto* datum = std::get_if<ir::SystemRef>(&x->node);
          found.reads_machine =
              found.reads_machine || (datum != nullptr && datum->datum != ir::Datum::programmed_position);
        });
      });
      found.skips |= s.line.skip_mask;
      const auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr) return;
      found.reads_machine =
          found.reads_machine ||
          (b->has_motion && (b->motion.frame != ir::FrameUse::normal || ir::ends_at_the_machine(b->motion.kind)));
      for (const auto& a : b->actions) {
        const auto* m = std::get_if<ir::ModalSet>(&a.data);
        found.frames = found.frames || std::holds_alternative<ir::FrameOp>(a.data);
        found.offsets = found.offsets || std::holds_alternative<ir::WorkOffset>(a.data);
        found.inches = found.inches || (m != nullptr && m->setting == ir::Setting::units &&
                                        static_cast<ir::Units>(m->value) == ir::Units::inch);
      }
    });
  }
  return found;
}

std::string listed(const std::set<std::uint32_t>& lines) {
  std::string text;
  for (auto it = lines.begin(); it != lines.end();) {
    auto last = it;
    while (std::next(last) != lines.end() && *std::next(last) == *last + 1) ++last;
    text += (text.empty() ? "" : ", ") + std::to_string(*it) + (last == it ? "" : "-" + std::to_string(*last));
    it = std::next(last);
  }
  return text;
}

/// The numbers that the program gives its variables.
void find_values(const ir::Program& program, Seen& seen) {
  std::set<std::uint32_t> lines;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* a = std::get_if<ir::Assign>(&s.node);
      const bool number = a != nullptr && std::any_of(a->items.begin(), a->items.end(), [](const auto& i) {
                            return !i.to_system && ir::constant_value(i.value);
                          });
      if (!number) return;
      if (lines.empty() || s.line.span.line < seen.first.line) seen.first = s.line.span;
      lines.insert(s.line.span.line);
    });
  }
  seen.lines = listed(lines);
}

}  // namespace

std::optional<Seen> see(const AttemptContext& c, const ir::Program& source) {
  ir::Program program = source;
  ir::number_statements(program);
  const Inputs look = inputs_of(program);
  if (look.reads_machine || std::bitset<16>(look.skips).count() > most_skip_levels) return std::nullopt;
  const bool same_place =
      !look.offsets &&
      (c.source_machine.policies.frame_change_keeps == machine::FrameChangeKeeps::machine || !look.frames);
  Seen seen;
  machine::Profile elsewhere = c.source_machine;  // what depends on where the machine stands first is no fact
  for (auto& a : elsewhere.axes) a.start += 731.0625;
  interpreter::Options run;
  run.max_events = most_events;
  run.max_steps = most_steps;
  run.max_silent_steps = most_steps;
  run.set = c.options.run.set;
  run.witness = [&](const ir::Statement& s, const interpreter::Standing& at) {
    ir::Facts now;
    now.reachable = true;
    for (std::size_t i = 0; i < ir::setting_count; ++i) now.settings[i] = at.modal.get(static_cast<ir::Setting>(i));
    now.motion = at.modal.motion;
    now.work_offset = at.modal.work_offset;
    now.feed = at.feed;
    for (const auto& a : c.source_machine.axes) {
      if (!a.rotary && same_place && !look.inches && !at.position_open && at.modal.units == ir::Units::metric)
        now.position[a.id] = at.position[a.id];
    }
    seen.facts.visit(s.line.span, now);
  };
  NoEvents sink;
  for (const auto* machine : {&c.source_machine, &std::as_const(elsewhere)}) {
    for (std::uint32_t skip = 0; skip <= look.skips; ++skip) {
      if ((skip & ~look.skips) != 0) continue;
      run.skip_mask = static_cast<std::uint16_t>(skip);
      Diagnostics said;
      const auto result = interpreter::run(program, *machine, run, sink, said);
      if (result.reason != interpreter::EndReason::program_end || !result.read_first.empty()) return std::nullopt;
    }
  }
  find_values(program, seen);
  return seen;
}

}  // namespace cnctrans::translator
