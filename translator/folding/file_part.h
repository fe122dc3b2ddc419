// Bytes of a file, from here to there.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/os/os.h"

namespace cnctrans::translator {

class FilePart {
 public:
  /// False: it can't be read.
  bool open(const std::string& path);
  /// The bytes, valid until the next call; fewer where the file ends or can't be read.
  std::string_view read(std::uint64_t from, std::uint64_t to);

 private:
  os::ReadFile file_;
  std::string buffer_;
};

}  // namespace cnctrans::translator
