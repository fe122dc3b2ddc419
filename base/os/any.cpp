// What is the same for every system.
#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/os/os.h"
#include "base/text.h"

namespace cnctrans {

void os::cant_be_read(std::string* error, const std::string& path, int number) {
  if (error != nullptr) *error = fmt::format("{}: can't be read: {}", path, std::strerror(number));
}

bool os::Child::read_line(std::string& line) {
  std::FILE* const in = written();
  if (in == nullptr) return false;
  for (int c = std::fgetc(in); c != EOF; c = std::fgetc(in)) {
    if (c == '\n') return true;
    line += static_cast<char>(c);
  }
  return false;
}

std::string os::Child::read_all() {
  std::string text;
  std::array<char, 4096> piece;  // NOLINT(cppcoreguidelines-pro-type-member-init): it is written first
  while (written() != nullptr) {
    const std::size_t n = std::fread(piece.data(), 1, piece.size(), written());
    if (n == 0) break;
    text.append(piece.data(), n);
  }
  return text;
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
