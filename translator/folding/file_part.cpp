#include "translator/folding/file_part.h"

#include <fcntl.h>
#include <unistd.h>

namespace cnctrans::translator {

FilePart::~FilePart() {
  if (fd_ >= 0) ::close(fd_);
}

bool FilePart::open(const std::string& path) {
  if (fd_ >= 0) ::close(fd_);
  fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  return fd_ >= 0;
}

std::string_view FilePart::read(std::uint64_t from, std::uint64_t to) {
  const auto size = static_cast<std::size_t>(to - from);
  if (buffer_.size() < size) buffer_.resize(size);
  std::size_t got = 0;
  while (got < size) {
    const ssize_t n = ::pread(fd_, buffer_.data() + got, size - got, static_cast<off_t>(from + got));
    if (n <= 0) break;
    got += static_cast<std::size_t>(n);
  }
  return {buffer_.data(), got};
}

}  // namespace cnctrans::translator
