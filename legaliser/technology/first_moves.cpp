// Moves without a code whose motion function differs between the ways that lead to them, for a target that says it in
// every block: the way from the text above gets moves of its own, the jumps lead to the others.
#include <algorithm>

#include "legaliser/analysis/facts.h"
#include "legaliser/analysis/words.h"
#include "legaliser/edit/editor.h"
#include "legaliser/technology/motion_codes.h"

namespace cnctrans::ir::passes {

namespace {

constexpr std::size_t most_statements = 8;  ///< that are written twice

bool undecided(const Statement& s, const Facts& facts) {
  const auto* b = std::get_if<Block>(&s.node);
  return b != nullptr && b->has_motion && b->motion.kind == MotionKind::modal && b->motion.moves() && facts.reachable &&
         !facts.motion;
}
bool goes_straight_on(const Statement& s) {
  return s.line.skip_mask == 0 && !s.line.joined &&
         (std::holds_alternative<Block>(s.node) || std::holds_alternative<Assign>(s.node) ||
          std::holds_alternative<Label>(s.node) || std::holds_alternative<Message>(s.node));
}

class FirstMoves {
 public:
  FirstMoves(Program& program, const LegaliseContext& context) : program_(program), context_(context) {}

  void run() {
    for (std::size_t n = 0; n < program_.routines.size(); ++n) {
      for (std::size_t from = 0; const auto at = next(n, from); from = *at + 1) {
        Program tried = program_;
        const std::size_t before = left(program_, n);
        if (separate(tried, n, *at) && left(tried, n) < before) program_ = std::move(tried);
      }
    }
  }

 private:
  /// Moves whose function is open; each separation leaves fewer, or it would never end.
  std::size_t left(Program& program, std::size_t routine) const {
    const FactsOf facts(program, context_);
    std::size_t open = 0;
    for_each_statement(program.routines[routine].body,
                       [&](const Statement& s) { open += undecided(s, facts.before(s)) ? 1 : 0; });
    return open;
  }
  std::optional<std::size_t> next(std::size_t routine, std::size_t from) {
    const FactsOf facts(program_, context_);
    const Body& body = program_.routines[routine].body;
    for (std::size_t i = from; i < body.size(); ++i) {
      if (undecided(body[i], facts.before(body[i]))) return i;
    }
    return std::nullopt;
  }

  /// False: it does not help.
  bool separate(Program& program, std::size_t routine, std::size_t move) const {
    Routine& r = program.routines[routine];
    const LabelUses uses = label_uses(program, r);
    const auto is_target = [&uses](const Statement& s) {
      const auto labels = labels_on(s.line);
      return std::any_of(labels.begin(), labels.end(), [&uses](const LabelRef& l) { return uses.is_target(l); });
    };
    if (uses.computed || !goes_straight_on(r.body[move])) return false;
    std::size_t head = move;
    while (!is_target(r.body[head])) {
      if (head == 0 || move - head >= most_statements || !goes_straight_on(r.body[head - 1])) return false;
      --head;
    }
    Body body, own;
    {
      Editor editor(program, r, context_);
      const LabelRef behind = editor.fresh_label();
      for (std::size_t i = head; i <= move; ++i) {
        Statement s = r.body[i];
        s.id = 0;
        s.line.number = {};
        s.line.labels.clear();
        own.push_back(std::move(s));
      }
      own.push_back(make_jump(r.body[move].line, behind));
      for (std::size_t i = 0; i < r.body.size(); ++i) {
        if (i == head) body.insert(body.end(), own.begin(), own.end());
        body.push_back(r.body[i]);
        if (i == move) body.push_back(make_label(r.body[move].line, behind, program));
      }
      r.body = std::move(body);
    }
    const FactsOf facts(program, context_);
    const auto decided = [&](std::size_t i) {
      const Facts& f = facts.before(r.body[i]);
      return f.reachable && f.motion;
    };
    return decided(move) && decided(move + own.size());
  }

  Program& program_;
  const LegaliseContext& context_;
};

}  // namespace

void separate_first_moves(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || !context.target.motion_in_each_block) return;
  bool jumps = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&jumps](const Statement& s) { jumps = jumps || std::holds_alternative<Jump>(s.node); });
  }
  if (jumps) FirstMoves(program, context).run();
}

}  // namespace cnctrans::ir::passes
