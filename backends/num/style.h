// How NUM programs look: code tables of the writer, and what the language can say.
#pragma once

#include "backends/common/expression_printer.h"
#include "backends/common/style.h"
#include "dialects/num/options.h"
#include "legaliser/capabilities.h"
#include "machine/profile.h"

namespace cnctrans::backends::num {

const Style& style();
const ExpressionStyle& expression_style();
/// `later`: of the families 10xx and flx; `structured`: which write IF, WHILE, REPEAT, FOR.
const ir::Capabilities& capabilities(bool lathe, bool later, bool structured);
bool structured(const dialects::num::Options& options);

/// A control with structured words and impact planes (EH): the families 10xx and flx.
bool later_family(const dialects::num::Options& options);
/// A hole cycle that a NUM cycle carries out with the same moves.
bool native_hole(const ir::HoleCycle& cycle);
/// A pocket that G45 says with its own words.
bool native_pocket(const ir::HoleCycle& cycle);

}  // namespace cnctrans::backends::num
