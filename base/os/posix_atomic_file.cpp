// Files that are written beside their place and then put there.
#ifndef _WIN32
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "base/text.h"

namespace cnctrans {

AtomicFile::~AtomicFile() {
  if (fd_ >= 0) ::close(fd_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

namespace {

/// The number in a name of an open file: 1 in /dev/stdout and /dev/fd/1; -1: the path is none.
int descriptor_in(std::string_view path) {
  if (path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    int n = -1;
    if (path.starts_with(folder)) std::from_chars(path.data() + folder.size(), path.data() + path.size(), n);
    if (n >= 0) return n;
  }
  return -1;
}

/// A file without a name in this folder: nothing of it is left when the process is killed. -1: not to be had here.
int open_unnamed(const std::string& folder) {
  if (::access("/proc/self/fd", X_OK) != 0) return -1;  // it gets its name from there
  return ::open(folder.empty() ? "." : folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
}

/// Gives an unnamed file its name.
bool give_name(int fd, const std::string& name) {
  const std::string own = fmt::format("/proc/self/fd/{}", fd);
  return ::linkat(AT_FDCWD, own.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

}  // namespace

bool AtomicFile::open(std::string* error) {
  target_ = path_;
  if (const int number = descriptor_in(path_); number >= 0) {
    fd_ = ::fcntl(number, F_DUPFD_CLOEXEC, 0);
    return fd_ >= 0 || fail(error, "can't be written");
  }
  struct stat st {};
  const bool exists = ::stat(path_.c_str(), &st) == 0;
  if (exists && S_ISDIR(st.st_mode)) {
    errno = EISDIR;
    return fail(error, "can't be written");
  }
  if (exists && !S_ISREG(st.st_mode)) {
    fd_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    return fd_ >= 0 || fail(error, "can't be written");
  }
  if (exists) {
    if (::access(path_.c_str(), W_OK) != 0) return fail(error, "can't be written");
    if (char* real = ::realpath(path_.c_str(), nullptr)) {
      target_ = real;
      std::free(real);  // realpath allocates with malloc
    }
  }
  const auto slash = target_.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : target_.substr(0, slash + 1);
  for (int n = 0; n < 1000 && fd_ < 0; ++n) {
    temporary_ = fmt::format("{}.cnctrans-{}-{}.tmp", folder, ::getpid(), n);
    if (n == 0) fd_ = open_unnamed(folder);
    if (fd_ >= 0) break;
    fd_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd_ < 0 && errno != EEXIST) break;
  }
  if (fd_ < 0) {
    temporary_.clear();
    return fail(error, "can't be written");
  }
  if (exists && ::fchmod(fd_, st.st_mode & 0777U) != 0) return fail(error, "its permissions can't be kept");
  return true;
}

bool AtomicFile::flush(std::string* error) {
  const char* p = buffer_.data();
  std::size_t left = buffer_.size();
  while (left != 0) {
    const ssize_t n = ::write(fd_, p, left);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return fail(error, "can't be written");
    p += n;
    left -= static_cast<std::size_t>(n);
  }
  buffer_.clear();
  return true;
}

bool AtomicFile::commit(std::string* error) {
  if (fd_ < 0) {
    errno = EBADF;
    return fail(error, "is not open");
  }
  if (!flush(error)) return false;
  struct stat st {};
  const bool unnamed = !temporary_.empty() && ::fstat(fd_, &st) == 0 && st.st_nlink == 0;
  if (unnamed && !give_name(fd_, temporary_)) return fail(error, "can't be written");
  const int fd = std::exchange(fd_, -1);
  if (::close(fd) != 0) return fail(error, "can't be written");
  if (temporary_.empty()) return true;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) return fail(error, "can't be replaced");
  temporary_.clear();
  return true;
}

}  // namespace cnctrans
#endif
