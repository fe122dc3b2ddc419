// Standard output for a stream that may have to be taken back: nothing of it is left when the whole-program path does
// the work in the end.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <memory>
#include <string_view>

namespace cnctrans::cli {

/// A regular file at its end is written directly and cut back if need be; anything else (a pipe, a terminal, a file
/// opened for appending) gets the text from a temporary file when all of it is there.
class StdoutSink {
 public:
  StdoutSink();
  [[nodiscard]] bool good() const { return direct_ || spool_ != nullptr; }
  [[nodiscard]] bool write(std::string_view bytes);
  /// All of it is there. False: it could not be written.
  [[nodiscard]] bool commit();
  /// Takes back what was written. False: it could not be.
  [[nodiscard]] bool discard();

 private:
  bool direct_ = false;
  off_t start_ = 0;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> spool_{nullptr, &std::fclose};
};

}  // namespace cnctrans::cli
