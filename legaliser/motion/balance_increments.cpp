#include "legaliser/motion/balance_increments.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

/// More decimals than any control counts: such targets take every word as it is.
constexpr std::int32_t enough_decimals = 6;

bool off_grid(double value, double place) {
  return std::fabs(value * place - std::round(value * place)) > 1e-6;
}

class Rows {
 public:
  Rows(const LegaliseContext& context, const FactsOf& facts) : context_(context), facts_(facts) {}

  void routine(const Program& program, Routine& r) {
    uses_ = label_uses(program, r);
    clear();
    body(r.body);
    if (r.kind == RoutineKind::main)
      clear();
    else
      end_row();
  }

 private:
  void clear() { rest_.fill(0); }

  /// Whatever comes next, or before it once more, does not take up what is left.
  void end_row() {
    const auto most =
        std::max_element(rest_.begin(), rest_.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); });
    if (std::fabs(*most) > 1e-9 && !said_left_) {
      said_left_ = true;
      context_.diagnostics.warning(
          "TRN-662", last_,
          "increments with more than " + std::to_string(places_) +
              " decimals are rounded for the target, and the row of blocks ends here: " + rounded(*most, 6) +
              " are left over, which adds up each time the blocks run (reported once for the program)",
          "write absolute positions, or increments that the target can write");
    }
    clear();
  }

  void body(Body& statements) {
    for (auto& s : statements) statement(s);
  }

  void statement(Statement& s) {
    const auto labels = labels_on(s.line);
    const auto any = [&labels](const auto& is) { return std::any_of(labels.begin(), labels.end(), is); };
    if (any([this](const LabelRef& l) { return uses_.is_target(l); })) end_row();
    const bool ends = any([this](const LabelRef& l) { return uses_.is_end(l); });
    if (auto* b = std::get_if<Block>(&s.node)) {
      const bool apart = s.line.skip_mask != 0 || b->repeat_given != 0;
      if (apart) end_row();
      block(s, *b);
      if (apart || ends) end_row();
      return;
    }
    const bool passes_by = std::holds_alternative<Assign>(s.node) || std::holds_alternative<Message>(s.node) ||
                           std::holds_alternative<Declare>(s.node) || std::holds_alternative<Label>(s.node);
    if (std::holds_alternative<End>(s.node)) return clear();
    if (!passes_by || ends) end_row();
    each_body(s, [this](Body& inner) {
      body(inner);
      end_row();
    });
  }

  void block(const Statement& s, Block& b) {
    const Facts& facts = facts_.before(s);
    const bool new_units = std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      return m != nullptr && m->setting == Setting::units;
    });
    if (new_units) end_row();
    if (!b.has_motion) return;
    if (b.motion.frame != FrameUse::normal) return clear();
    const auto distance = setting_in<Distance>(b, facts, Setting::distance);
    const bool inch = setting_in<Units>(b, facts, Setting::units) == Units::inch;
    places_ = inch ? context_.target.word_decimals_inch : context_.target.word_decimals;
    const double place = std::pow(10, places_);
    for (auto& c : b.motion.coords) {
      if (c.axis >= rest_.size()) continue;
      const bool incremental =
          c.mode == WordMode::incremental || (c.mode == WordMode::modal && distance == Distance::incremental);
      if (!incremental) {
        rest_[c.axis] = 0;
      } else if (c.value.literal() && (off_grid(c.value.number, place) || off_grid(rest_[c.axis], place))) {
        balance(c, place, s);
      }
    }
  }

  void balance(CoordWord& c, double place, const Statement& s) {
    double& rest = rest_[c.axis];
    const double wanted = c.value.number + rest;
    const double written = parse_decimal(rounded(wanted, places_)).value_or(wanted);
    rest = wanted - written;
    if (off_grid(c.value.number, place)) {
      last_ = s.line.span;
      if (!said_) {
        said_ = true;
        context_.diagnostics.warning("TRN-661", last_,
                                     "increments with more than " + std::to_string(places_) +
                                         " decimals are rounded for the target so that no error adds up in a row of "
                                         "blocks: every point stands at most " +
                                         shortest(0.5 / place) + " beside its place (reported once for the program)");
      }
    }
    if (off_grid(c.value.number, place) || written != c.value.number) c.value = Value{written};
  }

  const LegaliseContext& context_;
  const FactsOf& facts_;
  LabelUses uses_;
  std::array<double, axis::count_max> rest_{};  ///< of each axis: where it should stand, less where it stands
  std::int32_t places_ = 0;
  Span last_;
  bool said_ = false, said_left_ = false;
};

/// Some increment could have too many decimals.
bool has_long_words(const Program& program, std::int32_t places) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || !b->has_motion || found) return;
      found = std::any_of(b->motion.coords.begin(), b->motion.coords.end(), [places](const CoordWord& c) {
        return c.mode != WordMode::absolute && c.value.literal() && off_grid(c.value.number, std::pow(10, places));
      });
    });
  }
  return found;
}

}  // namespace

void balance_rows(Program& program, const LegaliseContext& context) {
  const auto places = std::min(context.target.word_decimals, context.target.word_decimals_inch);
  if (program.dialect == context.target.dialect || places >= enough_decimals || !has_long_words(program, places))
    return;
  const FactsOf facts(program, context);
  Rows rows(context, facts);
  for (auto& r : program.routines) rows.routine(program, r);
}

}  // namespace cnctrans::ir::passes
