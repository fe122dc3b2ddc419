// Jumps (G79) and calls (G77) (reference 13.1, 13.2).
#include <set>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/num/limits.h"
#include "frontends/num/state/lower.h"

namespace cnctrans::frontends::num {

namespace facts = dialects::num;

bool Lowering::label(const Word& w, ir::LabelRef& out) {
  out.is_number = true;
  if (w.is_expression) {
    out.computed = value(w).expr;
    return out.computed != nullptr;
  }
  const auto n = saturate<std::int64_t>(w.number);
  if (w.number < 0 || static_cast<double>(n) != w.number || n > facts::label_max) {
    report_.refuse("NUM-016", w.pos,
                   "`" + std::string(text_of(w)) + "`: block numbers are whole and go from 0 to 32767");
    return false;
  }
  out.text = std::to_string(n);
  return true;
}

bool Lowering::jump(const Flow& flow, const syntax::Statement* test, ir::Statement& out) {
  if (flow.label_count != 1) {
    report_.refuse("NUM-015", flow.word->pos, "G79 needs one block number to go to");
    return false;
  }
  ir::Jump jump;
  if (test != nullptr) {
    jump.condition = expressions_.lower(test->args.at(0));
    if (!jump.condition) return false;
  }
  if (!label(*flow.labels[0], jump.target)) return false;
  out.node = std::move(jump);
  return true;
}

bool Lowering::call(const Flow& flow, ir::Statement& out) {
  ir::ExprPtr count;
  if (flow.repeat != nullptr) {
    const Word& s = *flow.repeat;
    if (!s.is_expression && (s.number < 1 || s.number > static_cast<double>(facts::call_repeat_max) ||
                             s.number != static_cast<double>(saturate<int>(s.number)))) {
      report_.refuse("NUM-014", s.pos, "G77 repeats 1 to 100 times");
      return false;
    }
    count = ir::as_expr(value(s));
  }
  ir::LabelRef first, last;
  if (flow.label_count > 2 || (flow.label_count == 0 && flow.program == nullptr)) {
    report_.refuse("NUM-014", flow.word->pos, "G77 needs a program (H), or the first and last block of a range (N N)");
    return false;
  }
  if (flow.label_count > 0) {
    if (!label(*flow.labels[0], first)) return false;
    last = first;
    if (flow.label_count == 2 && !label(*flow.labels[1], last)) return false;
  }
  // The control puts the two numbers in order.
  const bool literal = flow.label_count == 2 && !first.computed && !last.computed;
  if (literal && !settings_.range_by_position && flow.labels[0]->number > flow.labels[1]->number)
    std::swap(first, last);
  if (flow.program == nullptr) {
    ir::Repeat repeat;
    repeat.first = std::move(first);
    repeat.last = std::move(last);
    repeat.count = std::move(count);
    repeat.order_free = settings_.range_by_position || (flow.label_count == 2 && !literal);
    out.node = std::move(repeat);
    return true;
  }
  ir::CallRoutine call;
  const Word& h = *flow.program;
  if (h.is_expression) {
    call.computed = value(h).expr;
    if (!call.computed) return false;
  } else {
    call.routine.number = saturate<std::int64_t>(h.number);
    if (h.number != static_cast<double>(call.routine.number)) call.routine.text = std::string(h.number_text);
  }
  call.count = std::move(count);
  call.has_range = flow.label_count > 0;
  call.first = std::move(first);
  call.last = std::move(last);
  out.node = std::move(call);
  return true;
}

bool Lowering::interruption(const Flow& flow, ir::Statement& out) {
  ir::Jump jump;
  if (!label(*flow.interrupted, jump.target)) return false;
  ir::SystemRef contact;
  contact.text = facts::interruption_datum;
  ir::Expr e;
  e.node = std::move(contact);
  jump.condition = ir::binary(ir::BinaryOp::ne, std::make_shared<const ir::Expr>(std::move(e)), ir::number(0));
  out.node = std::move(jump);
  return true;
}

bool Lowering::flow_statement(const Flow& flow, const syntax::Statement* test, ir::Statement& out) {
  const bool ok = flow.code->kind == GKind::jump     ? jump(flow, test, out)
                  : flow.code->kind == GKind::spline ? curve(flow, out)
                                                     : call(flow, out);
  return ok && !report_.refused();
}

namespace {

std::int64_t label_number(std::string_view text) {
  return saturate<std::int64_t>(parse_decimal(text).value_or(-1));
}

/// The greatest label below the missing end of the range, not below its start.
void mend(ir::LabelRef& first, ir::LabelRef& last, const std::set<std::int64_t>& labels, const Span& where,
          Diagnostics& diagnostics) {
  if (first.computed || last.computed || !last.is_number || last.text.empty()) return;
  const std::int64_t wanted = label_number(last.text);
  if (labels.count(wanted) != 0) return;
  auto it = labels.lower_bound(wanted);
  if (it == labels.begin() || *std::prev(it) < label_number(first.text)) return;
  last.text = std::to_string(*std::prev(it));
  diagnostics.warning("NUM-046", where,
                      "there is no block N" + std::to_string(wanted) + ": the range ends with N" + last.text,
                      "num.missing_range_end of the machine profile says so");
}

}  // namespace

void mend_range_ends(ir::Routine& routine, Diagnostics& diagnostics) {
  std::set<std::int64_t> labels;
  ir::for_each_statement(routine.body, [&labels](const ir::Statement& s) {
    if (!s.line.number.empty()) labels.insert(label_number(s.line.number));
  });
  ir::for_each_statement(routine.body, [&](ir::Statement& s) {
    if (auto* r = std::get_if<ir::Repeat>(&s.node); r != nullptr && !r->has_program)
      mend(r->first, r->last, labels, s.line.span, diagnostics);
  });
}

}  // namespace cnctrans::frontends::num
