// What a block begins with, for one whose rest can't be read: jumps and ranges still find it.
#pragma once

#include <string_view>

namespace cnctrans::frontends {

struct BlockStart {
  std::string_view number;  ///< digits behind N; empty: none
  std::string_view label;   ///< a name with `:` behind it; empty: none
  std::string_view rest;    ///< the text behind both
};
/// Behind marks of block skip, such as `/` and `/2`.
BlockStart block_start(std::string_view text);

}  // namespace cnctrans::frontends
