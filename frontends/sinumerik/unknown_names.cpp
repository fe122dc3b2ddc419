// Names that nothing in a file defines.
#include "dialects/sinumerik/addresses.h"
#include "frontends/sinumerik/lower_expr.h"

namespace cnctrans::sinumerik {

using syntax::Expr;

/// A name that nothing here defines: a global user variable, a macro or an axis of the machine. It is known by its name
/// only, like a datum of the machine; a run stops where its value is needed, unless --set or the program gave it one.
bool ExprLowering::is_undefined(const Expr& e) const {
  return e.text.size() > 1 && e.text[0] != '$' && c_.symbol(e.text) == nullptr &&
         !c_.machine.undefined_names_are_global && !is_reserved(e.text);
}

ir::SystemRef ExprLowering::undefined(const Expr& e) {
  if (c_.first_time(e.text)) {
    c_.warning("SIN-006", e.pos,
               e.text + " is not defined in this program: no DEF, no parameter and no axis has this name",
               "its value is not known; --set " + e.text + "=VALUE gives it one for a run");
  }
  return system(e);
}

}  // namespace cnctrans::sinumerik
