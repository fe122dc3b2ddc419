// The numbers of the blocks of a finished program.
#pragma once

#include "backends/common/backend.h"

namespace cnctrans::backends::heidenhain {

/// Every block gets its number, from 0: `0 BEGIN PGM PART MM`. A line behind one that ends in ~ goes on with its block;
/// the mark of a block that can be left out stands before the number.
class NumberedBlocks final : public BlockNumbers {
 public:
  explicit NumberedBlocks(std::int64_t step) : step_(step) {}
  void write(std::string_view line, std::string& out) override;

 private:
  std::int64_t step_;
  std::int64_t next_ = 0;
  bool goes_on_ = false;
};

}  // namespace cnctrans::backends::heidenhain
