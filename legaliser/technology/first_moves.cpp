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

/// Statements from the label that a jump leads to up to the last open move behind it.
struct OpenPart {
  std::size_t head = 0, last = 0;
  std::size_t copy = 0, own = 0;  ///< where its copy and itself begin when it is separated
};

class FirstMoves {
 public:
  FirstMoves(Program& program, const LegaliseContext& context, std::size_t routine)
      : program_(program), context_(context), routine_(routine) {}

  /// Separates what that decides. Each round leaves fewer open moves: one that is decided may decide those behind it.
  void run() {
    for (bool again = true; again;) {
      auto list = parts();
      again = false;
      while (!list.empty() && !again) {
        Program tried = program_;
        separate(tried, list);
        again = keep_decided(tried, list);
        if (again) program_ = std::move(tried);
      }
    }
  }

 private:
  std::vector<OpenPart> parts() {
    const FactsOf facts(program_, context_);
    Routine& r = program_.routines[routine_];
    const LabelUses uses = label_uses(program_, r);
    if (uses.computed) return {};
    const auto is_target = [&](std::size_t i) {
      const auto labels = labels_on(r.body[i].line);
      return std::any_of(labels.begin(), labels.end(), [&uses](const LabelRef& l) { return uses.is_target(l); });
    };
    const auto joined = [&](std::size_t i) { return goes_straight_on(r.body[i]) && !is_target(i); };
    std::vector<OpenPart> out;
    for (std::size_t i = 0; i < r.body.size(); ++i) {
      if (!undecided(r.body[i], facts.before(r.body[i])) || !goes_straight_on(r.body[i])) continue;
      std::size_t head = i;
      while (head > 0 && i - head < most_statements && joined(head)) --head;
      const bool behind = !out.empty() && head <= out.back().last;
      if (behind && i - out.back().head < most_statements) out.back().last = i;
      if (!behind && is_target(head) && goes_straight_on(r.body[head])) out.push_back({head, i, 0, 0});
    }
    return out;
  }

  /// Before each part a copy that only the text above leads to; behind it the way goes past the part.
  void separate(Program& program, std::vector<OpenPart>& parts) const {
    Routine& r = program.routines[routine_];
    Editor editor(program, r, context_);
    Body body;
    auto part = parts.begin();
    LabelRef behind;
    for (std::size_t i = 0; i < r.body.size(); ++i) {
      if (part != parts.end() && i == part->head) {
        behind = editor.fresh_label();
        part->copy = body.size();
        for (std::size_t k = part->head; k <= part->last; ++k) {
          Statement s = r.body[k];
          s.id = 0;
          s.line.number = {};
          s.line.labels.clear();
          body.push_back(std::move(s));
        }
        body.push_back(make_jump(r.body[part->last].line, behind));
        part->own = body.size();
      }
      body.push_back(r.body[i]);
      if (part == parts.end() || i != part->last) continue;
      body.push_back(make_label(r.body[i].line, behind, program));
      ++part;
    }
    r.body = std::move(body);
  }

  /// Takes the parts away in which a move is still open; true: none is.
  bool keep_decided(Program& program, std::vector<OpenPart>& parts) const {
    const FactsOf facts(program, context_);
    const Body& body = program.routines[routine_].body;
    const auto open = [&](const OpenPart& p) {
      for (std::size_t i = 0; i <= p.last - p.head; ++i) {
        const Statement &copy = body[p.copy + i], &own = body[p.own + i];
        if (undecided(copy, facts.before(copy)) || undecided(own, facts.before(own))) return true;
      }
      return false;
    };
    return std::erase_if(parts, open) == 0;
  }

  Program& program_;
  const LegaliseContext& context_;
  std::size_t routine_;
};

}  // namespace

void separate_first_moves(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || !context.target.motion_in_each_block) return;
  for (std::size_t n = 0; n < program.routines.size(); ++n) {
    bool jumps = false;
    for_each_statement(program.routines[n].body,
                       [&jumps](const Statement& s) { jumps = jumps || std::holds_alternative<Jump>(s.node); });
    if (jumps) FirstMoves(program, context, n).run();
  }
}

}  // namespace cnctrans::ir::passes
