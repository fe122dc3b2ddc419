// The numbers of the blocks of a finished program.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cnctrans::backends::heidenhain {

/// Every block gets its number, from 0: `0 BEGIN PGM PART MM`. A line behind one that ends in ~ goes on with its block;
/// the mark of a block that can be left out stands before the number.
std::string numbered_blocks(std::string_view text, std::int64_t step);

}  // namespace cnctrans::backends::heidenhain
