// ANTLR's tree of one line -> syntax::Block. Private to this folder's .cpp files: it names ANTLR types.
#pragma once

#include <string_view>

#include "frontends/common/syntax.h"
#include "frontends/heidenhain/syntax/parse.h"
#include "heidenhain/HeidenhainLexer.h"
#include "heidenhain/HeidenhainParser.h"

namespace cnctrans::frontends::heidenhain {

/// False: the tree is well formed but means nothing; `error` says why.
bool build_block(cnc_heidenhain::HeidenhainParser::BlockContext& tree, std::string_view line, syntax::Block& out,
                 ParseError& error);

}  // namespace cnctrans::frontends::heidenhain
