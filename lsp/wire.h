// Messages of the protocol on a pair of streams: a header with the length, then that many bytes.
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

namespace cnctrans::lsp {

class Wire {
 public:
  Wire(std::FILE* in, std::FILE* out) : in_(in), out_(out) {}
  /// The next message; nullopt at the end of the input.
  std::optional<std::string> read();
  void write(std::string_view message);
  /// Nothing has come in yet that is still to be read.
  [[nodiscard]] bool idle() const;

 private:
  bool fill();
  std::FILE* in_;
  std::FILE* out_;
  std::string buffer_;
};

}  // namespace cnctrans::lsp
