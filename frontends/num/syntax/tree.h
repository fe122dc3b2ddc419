// ANTLR's tree of one NUM block -> syntax::Block. Private to this folder's .cpp files: it names ANTLR types.
#pragma once

#include <string_view>

#include "frontends/common/syntax.h"
#include "frontends/num/syntax/parse.h"
#include "num/NumLexer.h"
#include "num/NumParser.h"

namespace cnctrans::frontends::num {

/// False: the tree is well formed but means nothing (a bare word right before an assignment); `error` says why.
bool build_block(cnc_num::NumParser::BlockContext& tree, std::string_view line, syntax::Block& out, ParseError& error);

}  // namespace cnctrans::frontends::num
