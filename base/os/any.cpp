// What is the same for every system.
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/os/os.h"
#include "base/text.h"

namespace cnctrans {

void os::cant_be_read(std::string* error, const std::string& path, int number) {
  if (error != nullptr) *error = fmt::format("{}: can't be read: {}", path, std::strerror(number));
}

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {}

bool AtomicFile::fail(std::string* error, const char* what) {
  if (error != nullptr) *error = fmt::format("{}: {}: {}", path_, what, std::strerror(errno));
  return false;
}

bool AtomicFile::write(std::string_view bytes, std::string* error) {
  constexpr std::size_t buffer_size = 1U << 18U;
  if (fd_ < 0) {
    errno = EBADF;
    return fail(error, "is not open");
  }
  buffer_.append(bytes);
  return buffer_.size() < buffer_size || flush(error);
}

}  // namespace cnctrans
