// Files that are read, and files that one process has at a time.
#ifndef _WIN32
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/os/os.h"

namespace cnctrans::os {

namespace {

/// read(2) that is not put off by a signal.
ssize_t read_on(int fd, char* to, std::size_t most) {
  for (;;) {
    const ssize_t got = ::read(fd, to, most);
    if (got >= 0 || errno != EINTR) return got;
  }
}

}  // namespace

bool is_terminal(std::FILE* stream) {
  return ::isatty(::fileno(stream)) != 0;
}

std::size_t read_what_comes(std::FILE* stream, char* to, std::size_t most) {
  const ssize_t got = read_on(::fileno(stream), to, most);
  return got > 0 ? static_cast<std::size_t>(got) : 0;
}

bool is_quiet(std::FILE* stream) {
  pollfd look{::fileno(stream), POLLIN, 0};
  return ::poll(&look, 1, 0) == 0;
}

ReadFile::~ReadFile() {
  close();
}

void ReadFile::close() {
  if (map_ != nullptr) ::munmap(map_, size_);
  if (fd_ >= 0) ::close(fd_);
  map_ = nullptr;
  fd_ = -1;
}

bool ReadFile::open(const std::string& path, std::string* error) {
  close();
  path_ = path;
  fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat st {};
  if (fd_ < 0 || ::fstat(fd_, &st) != 0 || S_ISDIR(st.st_mode)) {
    cant_be_read(error, path, fd_ < 0 ? errno : EISDIR);
    close();
    return false;
  }
  size_ = S_ISREG(st.st_mode) ? static_cast<std::size_t>(st.st_size) : 0;
  return true;
}

std::ptrdiff_t ReadFile::read(char* to, std::size_t most, std::string* error) const {
  const ssize_t got = read_on(fd_, to, most);
  if (got < 0) cant_be_read(error, path_, errno);
  return got;
}

std::size_t ReadFile::read_at(std::uint64_t from, char* to, std::size_t most) const {
  std::size_t got = 0;
  while (got < most) {
    const ssize_t n = ::pread(fd_, to + got, most - got, static_cast<off_t>(from + got));
    if (n <= 0) break;
    got += static_cast<std::size_t>(n);
  }
  return got;
}

std::string_view ReadFile::map() {
  if (map_ == nullptr && size_ != 0) {
    void* const map = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, fd_, 0);
    if (map != MAP_FAILED) {
      map_ = map;
      ::close(std::exchange(fd_, -1));  // the mapping stays
    }
  }
  return map_ == nullptr ? std::string_view() : std::string_view(static_cast<const char*>(map_), size_);
}

void ReadFile::read_in_order() const {
  ::posix_fadvise(fd_, 0, 0, POSIX_FADV_SEQUENTIAL);
}

LockedFile::~LockedFile() {
  if (fd_ >= 0) ::close(fd_);
}

bool LockedFile::open(const std::string& path) {
  if (fd_ >= 0) ::close(fd_);
  fd_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (fd_ >= 0) ::flock(fd_, LOCK_EX);
  return fd_ >= 0;
}

void LockedFile::replace(std::string_view text) {
  if (fd_ < 0 || ::ftruncate(fd_, 0) != 0 || ::lseek(fd_, 0, SEEK_SET) != 0) return;
  while (!text.empty()) {
    const ssize_t n = ::write(fd_, text.data(), text.size());
    if (n <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

}  // namespace cnctrans::os
#endif
