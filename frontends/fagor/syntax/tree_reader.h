// Parse tree of one block -> syntax model. For parse.cpp only.
#pragma once

#include <string_view>

#include "frontends/common/syntax.h"
#include "frontends/fagor/syntax/parse.h"

namespace antlr4::tree {
class ParseTree;
}

namespace cnctrans::fagor {

/// `tree` is the tree of the rule `block` without faults. False and `error` for what the grammar lets through and the
/// language does not: a label with decimals, a skip mark above 3, a number too large to be one.
[[nodiscard]] bool read_tree(antlr4::tree::ParseTree* tree, std::string_view line, syntax::Block& out,
                             ParseError& error);

}  // namespace cnctrans::fagor
