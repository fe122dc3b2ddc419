// Files of the control (reference-language 9.2): lines that are put into them, and what only the machine can answer.
#include <algorithm>
#include <utility>

#include "base/text.h"
#include "dialects/sinumerik/asked.h"
#include "dialects/sinumerik/operators.h"
#include "frontends/sinumerik/state/statements.h"
#include "frontends/sinumerik/statements/row_parts.h"
#include "ir/edit/file_line.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

/// A run can put the value into a text.
bool StatementLowering::can_be_shown(const Expr& e) const {
  if (e.kind == ExprKind::missing || c_.unknown_names.contains(e.text)) return false;
  if (e.kind == ExprKind::call && expression_function(e.text) == nullptr && e.text != "AXSTRING") return false;
  return std::all_of(e.args.begin(), e.args.end(), [this](const Expr& a) { return can_be_shown(a); });
}

/// WRITE(ERR,"LOG","T1 "<<R5): the line is a message of the run. DELETE(ERR,"LOG"): nothing is to be seen. Both have
/// gone well, and the variable of the error is 0.
bool StatementLowering::file_statement(const syntax::Statement& s, Parts& parts) {
  constexpr std::size_t with_line = 3;
  const bool line = s.text == "WRITE";
  if ((!line && s.text != "DELETE") || s.args.size() < (line ? with_line : with_line - 1)) return false;
  const Expr& status = s.args[0];
  const Symbol* symbol = c_.symbol(status.text);
  const bool number = symbol != nullptr && symbol->type != ir::Type::string && symbol->type != ir::Type::axis &&
                      symbol->type != ir::Type::frame && symbol->dimensions == status.args.size();
  const bool undefined = exprs_.is_undefined(status) && !reads_like_axis(status.text) && status.args.empty();
  const bool settable = (status.kind == ExprKind::name || status.kind == ExprKind::variable) &&
                        (number || undefined || (status.text == "R" && status.args.size() == 1));
  if (!settable || (line && !can_be_shown(s.args[2]))) return false;
  ir::Message shown;
  const std::uint32_t before = c_.errors;
  if (line) message_parts(s.args[2], shown.parts);
  ir::Assign::Item done;
  done.pos = WordPos{s.pos.column, 0};  // it has no words of its own
  done.value = ir::number(0);
  done.to_system = undefined;
  if (undefined) {
    done.system = exprs_.undefined(status);
  } else {
    ir::Type type = ir::Type::real;
    auto target = exprs_.variable(status, type);
    if (!target) return false;
    done.target = std::move(*target);
  }
  if (c_.errors != before) return true;  // reported; the block is kept
  parts.assign.items.push_back(std::move(done));
  if (!line) {
    put_beside("beside.data", s.pos, parts);
    return true;
  }
  auto name = can_be_shown(s.args[1]) ? exprs_.lower(s.args[1]) : nullptr;
  if (name && name->type != ir::Type::string) name = nullptr;  // a file the run does not know
  ir::mark_file(shown, ir::FileUse::line, std::string(c_.slice(s.pos)), std::move(name));
  c_.note("SIN-072", s.pos,
          "WRITE puts a line into a file of the control: a run shows it as a message, and the variable of the error "
          "becomes 0");
  parts.calls.emplace_back(std::move(shown));
  return true;
}

/// ISFILE(..), GETT(..) and their like; ISVAR() of a name that this program defines is TRUE.
ir::ExprPtr ExprLowering::asked(const Expr& e) {
  const AskedFunction& f = *asked_function(e.text);
  if (e.args.size() < f.arguments_min || e.args.size() > f.arguments_max) {
    c_.error("SIN-012", e.pos, e.text + "() takes another number of values");
    return nullptr;
  }
  if (e.text == "ISVAR" && e.args[0].kind == ExprKind::string && c_.symbol(to_upper_ascii(e.args[0].text)) != nullptr)
    return make_expr(ir::Number{1, {}, true}, ir::Type::boolean, e.pos);
  ir::SystemRef ref;
  ref.text = e.text;
  for (const Expr& a : e.args) {
    auto value = lower(a);
    if (!value) return nullptr;
    ref.args.push_back(std::move(value));
  }
  if (c_.first_time(e.text)) {
    c_.warning("SIN-015", e.pos,
               e.text + "() is answered by the machine: a run takes the profile's value, or stops where it is read",
               "--set \"" + e.text + "[..]=VALUE\" gives it, with the values handed over in the brackets");
  }
  return make_expr(std::move(ref), ir::Type::real, e.pos);
}

}  // namespace cnctrans::sinumerik
