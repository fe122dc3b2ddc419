#include "cli/stdout_sink.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "cli/common.h"

namespace cnctrans::cli {

StdoutSink::StdoutSink() {
  std::fflush(stdout);
  struct stat st {};
  const int flags = ::fcntl(STDOUT_FILENO, F_GETFL);
  start_ = ::lseek(STDOUT_FILENO, 0, SEEK_CUR);
  direct_ = ::fstat(STDOUT_FILENO, &st) == 0 && S_ISREG(st.st_mode) && flags >= 0 && (flags & O_APPEND) == 0 &&
            start_ == st.st_size;
  if (!direct_) spool_.reset(std::tmpfile());
}

bool StdoutSink::write(std::string_view bytes) {
  if (!direct_) return write_all(spool_.get(), bytes);
  while (!bytes.empty()) {
    const ssize_t n = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

bool StdoutSink::commit() {
  if (direct_) return true;
  std::rewind(spool_.get());
  std::string buffer(1U << 18U, '\0');
  while (true) {
    const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), spool_.get());
    if (n == 0) return std::ferror(spool_.get()) == 0 && std::fflush(stdout) == 0;
    if (!write_all(stdout, std::string_view(buffer).substr(0, n))) return false;
  }
}

bool StdoutSink::discard() {
  if (!direct_) return true;
  return ::ftruncate(STDOUT_FILENO, start_) == 0 && ::lseek(STDOUT_FILENO, start_, SEEK_SET) == start_;
}

}  // namespace cnctrans::cli
