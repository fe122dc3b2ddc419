// The feed (equivalences 14.1): controls keep F over a change of the feed mode, keep one F for each mode, or forget it.
// The target gets an explicit F before the next cut whenever it would not have the source's feed there.
#include <algorithm>

#include "base/text.h"
#include "ir/analysis/flow_states.h"
#include "legaliser/analysis/feed_state.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

class FeedPass {
 public:
  FeedPass(const LegaliseContext& context, const FactsOf& facts, const FeedDomain& domain,
           const FlowStates<FeedDomain>& states)
      : context_(context), facts_(facts), domain_(domain), states_(states) {}

  void statement(Statement& s) {
    auto* b = std::get_if<Block>(&s.node);
    const auto* before = states_.before(s);
    if (before == nullptr) return;
    const Facts& facts = facts_.before(s);
    if (reads_feed(s) && !same_for_reader(*before, setting<std::uint8_t>(facts, Setting::feed_mode)))
      return context_.diagnostics.error("TRN-158", s.line.span,
                                        "the feed that is asked for here may be another one on the target: no F holds, "
                                        "or the feed mode changed without one",
                                        "write F before this block");
    if (b == nullptr) return;
    const auto point = FeedDomain::cuts(*b, facts) ? FeedPoint::none : domain_.point(*b, facts);
    const bool cuts = point == FeedPoint::none;
    if (cuts && !FeedDomain::cuts(*b, facts)) return;
    FeedState now = *before;
    domain_.settle(*b, facts, now);
    const auto mode = setting_in<std::uint8_t>(*b, facts, Setting::feed_mode);
    if (!mode && gives_feed(*b)) return;  // whatever the mode is, this is the feed of both controls
    bool same = true, none = false, given = false, differs = false;
    std::optional<double> value;
    for (std::size_t i = 0; i < now.slots.size(); ++i) {
      if (mode && *mode != i) continue;
      same = same && now.slots[i].same;
      none = none || now.slots[i].maybe_none;
      given = given || now.slots[i].maybe_given;
      // A hole is drilled on the ways that have an F, whatever the others have.
      const bool none_here = now.slots[i].maybe_none && (cuts || !now.slots[i].maybe_given);
      differs = differs || (!now.slots[i].same && !none_here);
      value = mode ? now.slots[i].value : std::nullopt;
    }
    if (!cuts && !differs) return;
    if (none && !differs) return no_feed(s, given);
    if (same) return;
    if (value) {
      b->actions.insert(b->actions.begin(), action(SetFeed{Value{*value}, false}));
      return;
    }
    if (point == FeedPoint::perhaps && facts.modal_call != 0) return;  // of a subprogram that is not at hand
    context_.diagnostics.error(
        "TRN-158", s.line.span,
        mode == static_cast<std::uint8_t>(FeedMode::inverse_time)
            ? "inverse time without F in this block: the source goes on with a feed that is not known here, the "
              "target wants F in each block"
            : "the feed mode changed before this move and no F follows: the source goes on with a feed it "
              "remembers, which is not known here; the target has none",
        "write F in this block");
  }

 private:
  static bool same_for_reader(const FeedState& now, std::optional<std::uint8_t> mode) {
    bool same = true;
    for (std::size_t i = 0; i < now.slots.size(); ++i) same = same && ((mode && *mode != i) || now.slots[i].same);
    return same;
  }
  static bool gives_feed(const Block& b) {
    return std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
      const auto* f = std::get_if<SetFeed>(&a.data);
      return f != nullptr && !f->block_only;
    });
  }
  void no_feed(const Statement& s, bool sometimes) {
    context_.diagnostics.warning(
        "TRN-159", s.line.span,
        std::string("a cut without a feed: no F holds here") + (sometimes ? " on some way" : "") +
            "; controls move at their highest feed then, or with the feed of power-on, or stop with an alarm",
        "write F before this move");
  }

  const LegaliseContext& context_;
  const FactsOf& facts_;
  const FeedDomain& domain_;
  const FlowStates<FeedDomain>& states_;
};

/// The feed mode that a code of the spindle mode brings along, where it holds already: the target's code for the
/// spindle mode leaves the feed mode alone.
void drop_implied(Block& b, const Facts& before) {
  const bool spindle = std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    const auto* m = std::get_if<ModalSet>(&a.data);
    return m != nullptr && m->setting == Setting::spindle_mode;
  });
  if (!spindle) return;
  const auto mode = setting<std::uint8_t>(before, Setting::feed_mode);
  std::erase_if(b.actions, [mode](const Action& a) {
    const auto* m = std::get_if<ModalSet>(&a.data);
    return m != nullptr && m->setting == Setting::feed_mode && a.text.empty() && mode == m->value;
  });
}

}  // namespace

void convert_feed(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect && !program.dialect.empty()) return;
  const FactsOf facts(program, context);
  const FeedDomain domain(program, context, facts, true);
  const FlowStates<FeedDomain> states(program, domain);
  FeedPass pass(context, facts, domain, states);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&pass](Statement& s) { pass.statement(s); });
  }
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&context, &facts](Statement& s) {
      auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr) return;
      drop_implied(*b, facts.before(s));
      for (auto& a : b->actions) {
        if (auto* m = std::get_if<ModalSet>(&a.data); m != nullptr && m->setting == Setting::feed_mode) {
          m->feed_memory = context.target.feed_memory;
        }
      }
    });
  }
}

}  // namespace cnctrans::ir::passes
