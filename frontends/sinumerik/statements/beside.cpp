// What acts beside the programmed path: couplings, tool management, actions in real time, data of the machine. It
// becomes a text of its own next to its block, whose moves stay (dialects/sinumerik/beside.h).
#include <algorithm>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/sinumerik/beside.h"
#include "dialects/sinumerik/feed_words.h"
#include "dialects/sinumerik/g_functions.h"
#include "dialects/sinumerik/variables.h"
#include "frontends/sinumerik/state/statements.h"
#include "frontends/sinumerik/statements/row_parts.h"
#include "ir/check/missing_features.h"

namespace cnctrans::sinumerik {

using syntax::Block;
using syntax::Expr;
using syntax::ExprKind;
using syntax::Statement;
using syntax::Word;

void StatementLowering::put_beside(std::string_view feature, WordPos pos, Parts& parts) {
  if (!parts.beside_text.empty()) parts.beside_text += ' ';
  parts.beside_text += c_.slice(pos);
  if (parts.beside_feature.empty()) parts.beside_feature = feature;
  tell_beside(pos, std::string(c_.slice(pos)), feature);
}

void StatementLowering::tell_beside(WordPos pos, const std::string& what, std::string_view feature) {
  c_.note("SIN-044", pos, what + " acts beside the programmed path: " + std::string(ir::missing_feature(feature).title),
          "kept as text: a run goes past it, and no other control gets it");
}

bool StatementLowering::without_effect(const std::string& name, WordPos pos, Parts& parts) {
  std::string text = kept_text(name);
  if (name == "FGROUP") {
    text +=
        "; in splines and polynomials under SPATH other axes follow the length of the way of X, Y and Z, whatever it "
        "names";
  }
  c_.note("SIN-009", pos, std::move(text));
  if (!change_of_speed(name).empty()) {
    parts.act(ir::OpaqueWord{c_.slice(pos)}, pos, c_.slice(pos)).order = ir::Order::with;
    return true;
  }
  ir::Opaque o;
  o.text = c_.slice(pos);
  o.feature = "language.statement";
  o.harmless = true;
  parts.calls.emplace_back(std::move(o));
  return true;
}

bool StatementLowering::beside_word(const Word& w, Parts& parts) {
  if (w.address.size() < 2) return false;
  const BesideRow* row = nullptr;
  if (w.has_value && w.extension < 0) {
    row = beside(w.address, BesideForm::address);
    const bool none = row != nullptr && row->feature == "beside.compensation" && w.expr < 0 && w.number == 0;
    if (none) return false;  // no allowance: OFFN=0
  } else if (!w.has_value) {
    row = beside(w.address, BesideForm::code);
    if (row == nullptr) row = beside(w.address, BesideForm::procedure);
  }
  if (row == nullptr || c_.symbol(to_upper_ascii(w.address)) != nullptr) return false;
  if (row->name == "TCARR") {
    c_.tool.state = ToolDirection::State::unsure;
    c_.carrier.chosen = w.expr < 0 ? std::optional(saturate<std::int32_t>(w.number)) : std::nullopt;
  }
  const bool none = row->name == "TCARR" && w.expr < 0 && w.number == 0;  // no carrier: the tool as it is
  if (row->idle || none) return without_effect(std::string(row->name), w.pos, parts);
  put_beside(row->feature, w.pos, parts);
  return true;
}

bool StatementLowering::beside_statement(const Statement& s, Parts& parts) {
  if (s.keyword == "()") {
    const BesideRow* row = beside(s.text, BesideForm::procedure);
    if (row == nullptr || c_.symbol(s.text) != nullptr) return false;
    if (file_statement(s, parts)) return true;
    if (row->gives_back && !gives_unknown(s.args)) return false;
    if (s.text == "CTABDEL") {  // which of them are left is not followed
      for (auto& [number, table] : c_.tables) table.known = false;
    }
    if (row->idle) return without_effect(std::string(row->name), s.pos, parts);
    put_beside(row->feature, s.pos, parts);
    return true;
  }
  const Expr& target = s.args[0];
  const BesideRow* row = target.args.empty() ? nullptr : beside(target.text, BesideForm::indexed);
  if (row == nullptr || c_.symbol(target.text) != nullptr) return false;
  if (row->idle) return without_effect(std::string(row->name), s.pos, parts);
  put_beside(row->feature, s.pos, parts);
  return true;
}

/// The variables among the arguments get values that no run knows. False when it can't be made sure that nobody reads
/// them: of the routine's own ones, those it reads later in its text are refused there.
bool StatementLowering::gives_unknown(const std::vector<Expr>& args) {
  std::vector<std::string> names;
  for (const Expr& e : args) {
    const Symbol* symbol = c_.symbol(e.text);
    if (e.kind == ExprKind::variable && symbol == nullptr) return false;  // an R parameter
    if (symbol == nullptr || (e.kind != ExprKind::name && e.kind != ExprKind::variable)) continue;
    const auto own = space_of(symbol->type, false);
    const bool parameter = std::any_of(routine_->parameters.begin(), routine_->parameters.end(),
                                       [&](const ir::Parameter& p) { return p.variable.name == e.text; });
    if (!own || *own != symbol->space || parameter || c_.read_names.contains(e.text)) return false;
    names.push_back(e.text);
  }
  c_.unknown_names.insert(names.begin(), names.end());
  return true;
}

/// SETINT(3) PRIO=1 LIFTZ LIFTFAST: the routine is called by a signal, not by this block.
bool StatementLowering::interrupt_routine(const Block& block, const ir::LineInfo& info) {
  const auto sets = [](const Statement& s) { return s.keyword == "()" && s.text == "SETINT"; };
  if (!std::any_of(block.statements.begin(), block.statements.end(), sets)) return false;
  tell_beside(block.statements.front().pos, "SETINT", "beside.realtime");
  add_opaque(block, info, "beside.realtime", false);
  return true;
}

/// REPOSL RMI DISPR=2: the end of an interrupt routine, which no run calls. It returns like RET; behind it only the end
/// of the routine may stand.
bool StatementLowering::return_move(const Block& block, const ir::LineInfo& info) {
  const auto returns = [](const Word& w) {
    return !w.has_value && w.address.size() > 5 && to_upper_ascii(w.address).starts_with("REPOS") &&
           g_function(w.address) != nullptr;
  };
  const auto word = std::find_if(block.words.begin(), block.words.end(), returns);
  if (word == block.words.end()) return false;
  tell_beside(word->pos, std::string(c_.slice(word->pos)), "beside.realtime");
  add_opaque(block, info, "beside.realtime", false);
  returned_ = true;
  return true;
}

namespace {

bool ends_routine(const Block& block) {
  const bool ret = block.statements.size() == 1 && block.statements.front().text == "RET";
  const bool bare = block.words.size() == 1 && to_upper_ascii(block.words.front().address) == "RET";
  return ret || bare;
}

bool ends_program(const Block& block) {
  return std::any_of(block.words.begin(), block.words.end(), [](const Word& w) {
    const bool m = w.address == "M" || w.address == "m";
    return m && w.has_value && !w.is_expression && (w.number == 2 || w.number == 17 || w.number == 30);
  });
}

}  // namespace

/// What stands behind a return to the contour is reached by jumps only, and a run would come there in sequence.
bool StatementLowering::behind_return(const Block& block, const ir::LineInfo& info) {
  if (!std::exchange(returned_, false) || ends_program(block) || ends_routine(block)) return false;
  c_.keep("SIN-008", WordPos{}, "a block behind a return to the contour (REPOS) is not carried yet");
  add_opaque(block, info, "language.statement", false);
  return true;
}

/// Blocks of a curve table or of the contour of a protection zone: they define, nothing moves.
bool StatementLowering::in_definition(const Block& block, const ir::LineInfo& info) {
  const bool one = block.statements.size() == 1 && block.statements.front().keyword == "()";
  const bool bare = block.statements.empty() && block.words.size() == 1 && !block.words.front().has_value;
  const std::string name = one    ? block.statements.front().text
                           : bare ? to_upper_ascii(block.words.front().address)
                                  : std::string{};
  // Without the one end of a definition its lines would move: the block is kept, whatever its switch says.
  ir::LineInfo always = info;
  always.skip_mask = 0;
  const auto may_be_left_out = [&] {
    if (block.skip_mask == 0) return false;
    c_.keep("SIN-008", block.skip_pos, "a skip mark where a definition begins or ends is not carried");
    add_opaque(block, always, "language.statement", false);
    return true;
  };
  if (definition_ == nullptr) {
    definition_ = one ? sinumerik::definition(name) : nullptr;
    if (definition_ == nullptr) return false;
    if (may_be_left_out()) return true;
    if (definition_->gives_back && !gives_unknown(block.statements.front().args)) {
      definition_ = nullptr;
      return false;
    }
    definition_line_ = c_.line;
    tell_beside(block.statements.front().pos,
                "what stands up to " + std::string(definition_->end) + " defines and moves nothing; it",
                definition_->feature);
    table_block(block, name);
    if (name == "CONTPRON") {
      c_.prepared.erase(block.statements.front().args.empty() ? std::string{} : block.statements.front().args[0].text);
      begin_contour(block.statements.front().args, block.statements.front().pos);
    }
    add_opaque(block, info, definition_->feature, true);
    return true;
  }
  if (ends_program(block)) {
    open_definition();
    return false;
  }
  const bool ends = name == definition_->end;
  if (ends && may_be_left_out()) {
    contour_.reset();
    definition_ = nullptr;
    return true;
  }
  table_block(block, name);
  if (!ends) contour_block(block);
  const bool filled = ends && one && block.statements.front().args.size() == 1 && contour_known();
  const bool known = filled || !ends || !one || gives_unknown(block.statements.front().args);
  add_opaque(block, info, known ? definition_->feature : std::string_view("language.statement"), known);
  if (filled) fill_table(block.statements.front().args[0], block.statements.front().pos, info);
  if (ends) definition_ = nullptr;
  return true;
}

void StatementLowering::open_definition() {
  if (definition_ == nullptr) return;
  c_.diagnostics.error("SIN-010", definition_line_, std::string(definition_->begin) + " has no end in its program",
                       "write " + std::string(definition_->end) + " behind the blocks that define");
  definition_ = nullptr;
}

std::string_view StatementLowering::action_feature(std::string_view text) const {
  return beside_action(text, [this](std::string_view name) { return c_.machine.axis(name) != ir::axis::none; });
}

}  // namespace cnctrans::sinumerik
