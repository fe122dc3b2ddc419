// The textual IR: printed by `cnctrans ir`, read back by tests. Grammar: docs/ir.md.
#pragma once

#include <string>
#include <string_view>

#include "base/diagnostics.h"
#include "ir/program.h"

namespace cnctrans::ir {

struct PrintOptions {
  bool places = false;  ///< with source places
};
std::string to_text(const Program& program, const PrintOptions& options = {});
std::string to_text(const Statement& statement, const Program& program);
std::string to_text(const ExprPtr& expr, const Program& program);
/// Reads what to_text printed. Diagnostics IR-nnn.
Program from_text(std::string_view text, FileId file, Diagnostics& diagnostics);

/// JSON form, for tools.
std::string to_json(const Program& program);

/// Same meaning and same carried texts: routines, statements, labels, comments; places ignored. On a difference `where`
/// (may be null) gets a short description with both sides.
bool same_program(const Program& a, const Program& b, std::string* where);

/// Well-formedness: labels unique where searches need it, spaces exist, expressions typed, bodies nested. IR-nnn.
void check_well_formed(const Program& program, Diagnostics& diagnostics);

}  // namespace cnctrans::ir
