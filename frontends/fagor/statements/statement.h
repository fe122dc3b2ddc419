// High-level statements, and the blocks that are calls, to IR statements.
#pragma once

#include <string_view>

#include "frontends/common/syntax.h"
#include "frontends/fagor/state/state.h"
#include "ir/statement.h"

namespace cnctrans::fagor {

/// `(...)` other than SUB and LSUB; `text` is the statement as written, for what is kept as text. Fills `out.node`
/// only.
void lower_statement(const syntax::Block& block, std::string_view text, LowerState& state, ir::Statement& out);
/// `G180 A5 P3=2`: a call of the subroutine of that number, with its own level when there are arguments.
void lower_g_call(const syntax::Block& block, const syntax::Word& code, LowerState& state, ir::Statement& out);
/// The number of `(SUB n)`; -1 reported.
std::int64_t subroutine_number(const syntax::Statement& statement, LowerState& state);
/// Text of MSG: `?P100` stands for the value of a parameter.
std::vector<ir::ExprPtr> message_parts(std::string_view text, LowerState& state);

}  // namespace cnctrans::fagor
