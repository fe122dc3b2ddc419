// Jumps, structured statements, repeated parts.
#include <algorithm>
#include <array>
#include <utility>

#include "base/text.h"
#include "frontends/common/block_start.h"
#include "frontends/common/nesting.h"
#include "frontends/sinumerik/state/statements.h"
#include "frontends/sinumerik/statements/row_parts.h"

namespace cnctrans::sinumerik {

using frontends::StructureBuilder;
using syntax::Block;
using syntax::Expr;
using syntax::ExprKind;
using syntax::Statement;

namespace {

bool too_deep(const StructureBuilder& structure, const Statement& s, FileContext& c) {
  if (!frontends::nested_too_deep(structure)) return false;
  c.error("SIN-010", s.pos, "structures are nested too deeply: the control takes 16 levels");
  return true;
}

}  // namespace

void StatementLowering::begin_routine(ir::Routine& routine) {
  routine_ = &routine;
  structure_.emplace(routine.body);
  labels_.clear();
  externs_.clear();
  executable_seen_ = ended_ = false;
  definition_ = nullptr;
  returned_ = other_mode_ = false;
  c_.symbols.clear();
  c_.read_names.clear();
  c_.unknown_names.clear();
  c_.macros.clear();
  c_.take_definitions();
  c_.master_spindle = 1;
  c_.thread_start = {};
  c_.corner_feed = {};
  c_.speed_limit = c_.css_limit = {};
  c_.offset_chosen = routine.kind != ir::RoutineKind::main;
  c_.motion = c_.machine.profile->power_on.motion;
  const bool sub = routine.kind == ir::RoutineKind::sub;
  c_.units_by_text = sub ? std::nullopt : std::optional(c_.machine.profile->power_on.units);
  c_.units_called = c_.words_in_inches = false;
  c_.inclined.reset();
  c_.diameter.reset();
  c_.carrier = {};
  c_.real_time = {};
  c_.prepared.clear();
  contour_.reset();
  c_.tool = {};
  if (sub) c_.tool.state = ToolDirection::State::unsure;
  c_.framed = sub;
  c_.tool_frame = c_.other_plane = false;
  c_.plane.reset();
  c_.css.reset();
  if (!sub) c_.plane = c_.machine.profile->power_on.plane;
  if (!sub) c_.css = false;
  c_.per_rev.reset();
  if (!sub) c_.per_rev = c_.machine.profile->power_on.feed_mode == ir::FeedMode::per_rev;
  c_.words_of_tool = false;
}

void StatementLowering::end_routine(const SourceText* source) {
  if (!structure_) return;
  open_definition();
  for (const Span& place : structure_->finish(source)) {
    c_.diagnostics.error("SIN-010", place, "this structure has no end in its program",
                         "write its ENDIF, ENDWHILE, ENDFOR, ENDLOOP or UNTIL");
  }
  structure_.reset();
  if (routine_->has_signature && routine_->kind == ir::RoutineKind::main) {  // a PROC that returns is a subprogram
    ir::for_each_statement(routine_->body, [this](const ir::Statement& s) {
      if (std::holds_alternative<ir::Return>(s.node)) routine_->kind = ir::RoutineKind::sub;
    });
  }
  routine_ = nullptr;
}

void StatementLowering::add(ir::Statement statement) {
  const auto* block = std::get_if<ir::Block>(&statement.node);
  if (block == nullptr || !block->empty()) {
    executable_seen_ = true;
    const bool end =
        std::holds_alternative<ir::End>(statement.node) || std::holds_alternative<ir::Return>(statement.node);
    ended_ = end && structure_->depth() == 0 && statement.line.skip_mask == 0;
  }
  for (const auto& l : statement.line.labels) labels_.push_back(to_upper_ascii(l));
  structure_->add(std::move(statement));
}

/// The code of a block: without skip mark, number, labels and comment.
std::string_view StatementLowering::code_text(std::string_view line, const Block& block) {
  std::size_t from = 0;
  const auto past = [&from](WordPos p) {
    if (p.column != 0) from = std::max<std::size_t>(from, p.column - 1 + p.length);
  };
  past(block.skip_pos);
  past(block.number_pos);
  for (const auto& label : block.labels) {
    const std::size_t end = static_cast<std::size_t>(label.data() - line.data()) + label.size();
    const std::size_t colon = line.find(':', end);
    if (colon != std::string_view::npos) from = std::max(from, colon + 1);
  }
  const std::size_t to = block.comments.empty() ? line.size() : block.comments.back().pos.column - 1;
  return from < to ? trim(line.substr(from, to - from)) : std::string_view{};
}

void StatementLowering::add_opaque(const Block& block, ir::LineInfo info, std::string_view feature, bool harmless) {
  ir::Opaque o;
  const std::string_view code = code_text(c_.text, block);
  const frontends::BlockStart start = frontends::block_start(code);  // of a block that can't be read
  o.text = !info.labels.empty() && start.label == info.labels.back() ? start.rest : code;
  o.feature = feature.empty() ? std::string_view("language.statement") : feature;
  o.harmless = harmless;
  emit(info, std::move(o));
}

void StatementLowering::add_unread(const Block& block, ir::LineInfo info) {
  const std::string text = to_upper_ascii(code_text(c_.text, block));
  const std::size_t end = std::min(text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_"), text.size());
  const std::string_view word = std::string_view(text).substr(0, end);
  const bool jumps = text.find("GOTO") != std::string::npos;
  ir::Statement s;
  s.line = info;
  if (word == "IF" && !jumps) {
    ir::If node;
    node.condition = ir::number(0);
    s.node = std::move(node);
  } else if (word == "WHILE") {
    ir::While node;
    node.condition = ir::number(0);
    s.node = std::move(node);
  } else if (word == "UNTIL") {
    structure_->close_until(ir::number(0), info);
    return add_opaque(block, std::move(info), "text.unread", false);
  } else {
    return add_opaque(block, std::move(info), "text.unread", false);
  }
  executable_seen_ = true;
  if (!frontends::nested_too_deep(*structure_)) structure_->open(std::move(s));
  add_opaque(block, std::move(info), "text.unread", false);
}

bool StatementLowering::lower(const Block& block, ir::LineInfo info) {
  feature_ = {};
  for (const auto& l : block.labels) labels_.push_back(to_upper_ascii(l));
  if (in_other_mode(block, info)) return true;
  if (in_definition(block, info)) {
    executable_seen_ = true;
    return true;
  }
  if (behind_return(block, info)) return false;
  const bool row = std::all_of(block.statements.begin(), block.statements.end(),
                               [](const Statement& s) { return s.keyword == "=" || s.keyword == "()"; });
  if (row) {
    executable_seen_ = true;
    return items(block, std::move(info));
  }
  return flow(block, std::move(info));
}

namespace {

/// Opens, divides or closes a control structure; IF .. GOTOF is a jump.
bool is_structure(const Statement& s) {
  static constexpr std::array<std::string_view, 10> words{"ELSE",   "ENDIF", "LOOP",     "ENDLOOP", "FOR",
                                                          "ENDFOR", "WHILE", "ENDWHILE", "UNTIL",   "IF"};
  if (s.keyword == "REPEAT") return s.args.empty();
  return std::find(words.begin(), words.end(), s.keyword) != words.end() && (s.keyword != "IF" || s.children.empty());
}

}  // namespace

bool StatementLowering::flow(const Block& block, ir::LineInfo info) {
  const auto defines = [](const Statement& s) {
    return s.keyword == "DEF" || s.keyword == "PROC" || s.keyword == "SYNC";
  };
  if (!std::all_of(block.statements.begin(), block.statements.end(), defines)) c_.interrupt_lasting();
  constexpr std::string_view calls[] = {"CALL", "PCALL", "EXTCALL", "MCALL"};
  for (const Statement& s : block.statements) {  // what the other text leaves behind is not known
    if (std::find(std::begin(calls), std::end(calls), s.keyword) != std::end(calls)) {
      c_.css.reset();
      c_.units_called = true;
    }
  }
  bool ok = true;
  for (const Statement& s : block.statements) {
    const std::uint32_t before = c_.errors;
    if (s.keyword != "DEF" && s.keyword != "PROC" && s.keyword != "EXTERN" && s.keyword != "DEFINE" &&
        s.keyword != "REDEF" && s.keyword != "RIGHTS") {
      executable_seen_ = true;
    }
    if (!block.labels.empty() && is_structure(s)) {
      c_.warning("SIN-060", s.pos, "a label may not stand in a block with a control structure; the control stops here",
                 "put the label into a block of its own before this one");
    }
    if (statement(s, block, info) && c_.errors == before) continue;
    ok = false;
    if (c_.errors == before) c_.keep("SIN-008", s.pos, s.keyword + " is not carried yet");
    add_opaque(block, info, feature_, false);
    break;
  }
  return ok;
}

bool StatementLowering::statement(const Statement& s, const Block& block, ir::LineInfo& info) {
  const std::string& k = s.keyword;
  if (k == "IF") return if_statement(s, info);
  if (k == "FOR") return for_statement(s, info);
  if (k == "ELSE" || k == "ENDIF" || k == "LOOP" || k == "ENDLOOP" || k == "ENDFOR" || k == "WHILE" ||
      k == "ENDWHILE" || k == "UNTIL") {
    return structure(s, info);
  }
  if (k == "REPEAT" || k == "REPEATB") return s.args.empty() ? structure(s, info) : repeat(s, info);
  if (k.rfind("GOTO", 0) == 0) {
    ir::Jump j;
    if (!jump(s, j)) return false;
    emit(info, std::move(j));
    return true;
  }
  if (k == "CASE") return switch_statement(s, info);
  if (k == "DEF") return definition(s, info);
  if (k == "PROC") return proc(s, info);
  if (k == "EXTERN") return extern_declaration(s, block, info);
  if (k == "CALL" || k == "EXTCALL") return text_call(s, info);
  if (k == "PCALL") return path_call(s, info);
  if (k == "MCALL") return modal_call(s, info);
  if (k == "REDEF" || k == "RIGHTS") {
    c_.note("SIN-009", s.pos, k + " is kept as text: it changes no value");
    add_opaque(block, info, "language.statement", true);
    return true;
  }
  if (k == "SYNC") {
    const std::string_view feature = action_feature(s.text);
    if (feature.empty() && sets_at_once(s, info)) return true;
    if (feature.empty())
      return refuse("language.synchronised", s.pos,
                    "this synchronised action is not carried: it can move an axis of the machine or set what the "
                    "program reads");
    const std::string action = to_upper_ascii(s.text);
    if (action.find("DELDTG") != std::string::npos || action.find("$AA_OFF") != std::string::npos) {
      c_.warning("SIN-113", s.pos,
                 "this action ends or shifts a move when its condition comes true: a run shows the programmed move",
                 "kept as text: no other control gets it");
    } else {
      tell_beside(s.pos, "this action", feature);
    }
    add_opaque(block, info, feature, false);
    return true;
  }
  if (k == "DEFINE") return macro(s, block, info);
  if (k == "ISOCALL") return refuse("language.other_mode", s.pos, "calling a program in ISO mode is not carried yet");
  return false;
}

// --- jumps ------------------------------------------------------------------------------------------------------

bool StatementLowering::label(const Expr& e, ir::LabelRef& out) {
  const auto number = [&out](std::string_view digits) {
    const std::size_t first = digits.find_first_not_of('0');
    out.text = first == std::string_view::npos ? "0" : digits.substr(first);
    out.is_number = true;
    return true;
  };
  const auto name = [&](const std::string& text) {
    const bool numbered = text.size() > 1 && (text[0] == 'N' || text[0] == ':') &&
                          text.find_first_not_of("0123456789", 1) == std::string::npos;
    if (numbered) return number(std::string_view(text).substr(1));
    out.text = text;
    return true;
  };
  if (e.kind == ExprKind::number) {
    if (e.text.find_first_not_of("0123456789") != std::string::npos) {
      c_.error("SIN-017", e.pos, "a block number has digits only");
      return false;
    }
    return number(e.text);
  }
  if (e.kind == ExprKind::string) return name(to_upper_ascii(e.text));
  const Symbol* symbol = e.kind == ExprKind::name ? c_.symbol(e.text) : nullptr;
  if (e.kind == ExprKind::name && symbol == nullptr) return name(e.text);
  // "N"<<R1: the block number is computed.
  if (e.kind == ExprKind::binary && e.text == "<<" && e.args[0].kind == ExprKind::string &&
      to_upper_ascii(e.args[0].text) == "N" && e.args[1].kind != ExprKind::string) {
    out.computed = exprs_.lower(e.args[1]);
    if (out.computed && out.computed->type != ir::Type::string) {
      out.is_number = true;
      return true;
    }
  }
  out.computed = exprs_.lower(e);
  if (out.computed && out.computed->type != ir::Type::string) {
    c_.error("SIN-012", e.pos, "a jump target is a label, a block number or a text");
    return false;
  }
  return out.computed != nullptr;
}

bool StatementLowering::jump(const Statement& s, ir::Jump& out) {
  if (s.keyword == "GOTOF") out.search = ir::Search::forward;
  if (s.keyword == "GOTOB") out.search = ir::Search::backward;
  if (s.keyword == "GOTO" || s.keyword == "GOTOC") out.search = ir::Search::forward_then_backward;
  out.quiet = s.keyword == "GOTOC";
  return label(s.args[0], out.target);
}

bool StatementLowering::switch_statement(const Statement& s, ir::LineInfo& info) {
  ir::Switch out;
  out.value = exprs_.lower_as(s.args[0], ir::Type::integer);
  if (!out.value) return false;
  for (const Statement& arm : s.children) {
    ir::Jump j;
    if (!jump(arm.children[0], j)) return false;
    if (arm.keyword == "DEFAULT") {
      out.fallback.push_back(std::move(j));
      continue;
    }
    ir::ExprPtr constant = exprs_.lower_as(arm.args[0], ir::Type::integer);
    if (!constant) return false;
    out.cases.emplace_back(std::move(constant), std::move(j));
  }
  emit(info, std::move(out));
  return true;
}

// --- structures -------------------------------------------------------------------------------------------------

bool StatementLowering::unmatched(const Statement& s, std::string_view opener) {
  c_.error("SIN-010", s.pos, s.keyword + " does not close the " + std::string(opener) + " that stands open here");
  return false;
}

bool StatementLowering::if_statement(const Statement& s, ir::LineInfo& info) {
  ir::ExprPtr condition = exprs_.condition(s.args[0]);
  if (!s.children.empty()) {
    ir::Jump j;
    j.condition = std::move(condition);
    if (!j.condition || !jump(s.children[0], j)) return false;
    emit(info, std::move(j));
    return true;
  }
  ir::Statement out;
  out.line = info;
  ir::If node;
  node.condition = condition ? condition : ir::number(0);  // opened all the same, so that its ENDIF is not lost
  out.node = std::move(node);
  if (too_deep(*structure_, s, c_)) return false;
  structure_->open(std::move(out));
  if (info.skip_mask != 0) c_.error("SIN-016", s.pos, "a structured statement can't be skipped with `/`");
  return true;
}

bool StatementLowering::for_statement(const Statement& s, ir::LineInfo& info) {
  ir::For node;
  ir::Type type = ir::Type::real;
  if (exprs_.is_undefined(s.args[0]) && s.args[0].args.empty()) {
    c_.warning(
        "SIN-006", s.args[0].pos,
        s.args[0].text + " is not defined in this program: from here on it is an INT that this loop counts with");
    Symbol symbol;
    symbol.type = ir::Type::integer;
    symbol.space = *space_of(ir::Type::integer, true);
    c_.symbols.emplace(s.args[0].text, symbol);
  }
  auto counter = exprs_.variable(s.args[0], type);
  node.from = exprs_.lower_as(s.args[1], ir::Type::integer);
  node.to = exprs_.lower_as(s.args[2], type == ir::Type::real ? ir::Type::real : ir::Type::integer);
  if (counter) {
    node.counter = std::move(*counter);
  } else {  // kept as text
    node.counter.space = *space_of(ir::Type::integer, true);
    node.counter.name = s.args[0].text;
  }
  ir::Statement out;
  out.line = info;
  if (!node.from) node.from = ir::number(0);
  if (!node.to) node.to = ir::number(0);
  out.node = std::move(node);
  if (too_deep(*structure_, s, c_)) return false;
  structure_->open(std::move(out));
  if (info.skip_mask != 0) c_.error("SIN-016", s.pos, "a structured statement can't be skipped with `/`");
  return true;
}

bool StatementLowering::structure(const Statement& s, ir::LineInfo& info) {
  using Kind = StructureBuilder::Kind;
  const std::string& k = s.keyword;
  const auto open = [&](auto node) {
    if (too_deep(*structure_, s, c_)) return false;
    ir::Statement out;
    out.line = info;
    out.node = std::move(node);
    structure_->open(std::move(out));
    return true;
  };
  if (info.skip_mask != 0) c_.error("SIN-016", s.pos, "a structured statement can't be skipped with `/`");
  if (k == "ELSE") return structure_->else_branch(info) || unmatched(s, "structure");
  if (k == "ENDIF" && !structure_->close(Kind::if_, info)) {  // IF .. GOTOF .. and ENDIF: real programs have it
    c_.warning("SIN-010", s.pos, "this ENDIF closes no IF; the control passes over it");
    ir::Opaque o;
    o.text = c_.slice(s.pos);
    o.feature = "language.statement";
    o.harmless = true;
    emit(info, std::move(o));
    return true;
  }
  if (k == "ENDIF") return true;
  if (k == "ENDLOOP") return structure_->close(Kind::loop, info) || unmatched(s, "structure");
  if (k == "ENDFOR") return structure_->close(Kind::for_, info) || unmatched(s, "structure");
  if (k == "ENDWHILE") return structure_->close(Kind::while_, info) || unmatched(s, "structure");
  if (k == "LOOP") return open(ir::Loop{});
  if (k == "REPEAT") return open(ir::Until{});
  ir::ExprPtr condition = exprs_.condition(s.args[0]);
  if (!condition) condition = ir::number(0);
  if (k == "UNTIL") return structure_->close_until(std::move(condition), info) || unmatched(s, "structure");
  ir::While node;
  node.condition = std::move(condition);
  return open(std::move(node));
}

// --- repeated parts ---------------------------------------------------------------------------------------------

bool StatementLowering::repeat(const Statement& s, ir::LineInfo& info) {
  ir::Repeat out;
  const bool has_count = s.args.size() > 2 && s.args[2].kind != ExprKind::missing;
  if (has_count) {
    out.count = exprs_.lower_as(s.args[2], ir::Type::integer);
    if (!out.count) return false;
  }
  if (s.args[0].kind == ExprKind::missing) {
    c_.error("SIN-004", s.pos, "REPEAT with a count needs the label of the part to repeat");
    return false;
  }
  if (!label(s.args[0], out.first)) return false;
  const std::string first = s.args[0].text;
  const auto seen = std::find(labels_.rbegin(), labels_.rend(), first);
  const bool numbered = out.first.is_number;
  const bool before = numbered || seen != labels_.rend();  // a number may be the first or a later one: taken as before
  out.search = before ? ir::Search::backward : ir::Search::forward;
  if (s.keyword == "REPEATB") {
    out.last = out.first;
  } else if (s.args[1].kind != ExprKind::missing) {
    if (!label(s.args[1], out.last)) return false;
    // Not between the first label and the REPEAT: the part ends here (reference-language 7.3).
    const bool ahead = before && !numbered && !out.last.is_number && !out.last.computed &&
                       std::find(labels_.rbegin(), std::next(seen), s.args[1].text) == std::next(seen);
    if (ahead) {
      c_.warning("SIN-061", s.pos,
                 "the end label " + s.args[1].text + " does not stand between " + first +
                     " and the REPEAT: the part ends at the REPEAT");
      out.last = ir::LabelRef{};
    }
  } else {
    // To the first ENDLABEL after the label; without one before the REPEAT, up to the REPEAT itself.
    const bool end_mark = !before || std::find(labels_.rbegin(), seen, "ENDLABEL") != seen;
    if (end_mark) out.last.text = "ENDLABEL";
  }
  emit(info, std::move(out));
  return true;
}

/// GOTOS goes back to the start of the program as long as the PLC asks for it (reference 6).
bool StatementLowering::program_start(WordPos pos, Parts& parts) {
  if (c_.machine.options.gotos == Gotos::jumps) {
    c_.warning("SIN-020", pos,
               "GOTOS jumps to the program start only when the PLC asks for it; here it always jumps "
               "(sinumerik.gotos of the machine)");
    ir::Jump j;
    j.search = ir::Search::to_start;
    parts.calls.emplace_back(std::move(j));
    return true;
  }
  c_.warning("SIN-020", pos,
             "GOTOS jumps to the program start only when the PLC asks for it; here it is passed over, one pass of the "
             "program is run and translated (sinumerik.gotos of the machine)");
  ir::Action a;
  a.data = ir::OpaqueWord{c_.slice(pos)};
  a.order = ir::Order::with;  // the path is the same without it
  a.pos = pos;
  a.text = c_.slice(pos);
  parts.actions.push_back(std::move(a));
  return true;
}

}  // namespace cnctrans::sinumerik
