// Names that nothing in a file defines.
#include "dialects/sinumerik/addresses.h"
#include "frontends/sinumerik/state/expr.h"

namespace cnctrans::sinumerik {

using syntax::Expr;

/// A name that nothing here defines: a global user variable, a macro or an axis of the machine. It is known by its name
/// only, like a datum of the machine; a run stops where its value is needed, unless --set or the program gave it one.
bool ExprLowering::is_undefined(const Expr& e) const {
  return e.text.size() > 1 && e.text[0] != '$' && c_.symbol(e.text) == nullptr &&
         c_.machine.options.undefined_names != UndefinedNames::global && !is_reserved(e.text);
}

ir::SystemRef ExprLowering::undefined(const Expr& e) {
  if (c_.first_time(e.text)) {
    c_.warning(
        "SIN-006", e.pos, e.text + " is not defined in this program: no DEF, no parameter and no axis has this name",
        "give the file that defines it with --lib (NAME.DEF); or have such names read as global user data (option "
        "sinumerik.undefined_names = global of the machine profile), or give a value for a run: --set " +
            e.text + "=VALUE");
  }
  return system(e);
}

}  // namespace cnctrans::sinumerik
