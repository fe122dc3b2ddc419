#include "base/text.h"

#include <fast_float/fast_float.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace cnctrans {
namespace {

// The longest fixed text of a double is that of the smallest one: "-0." and 324 decimals.
constexpr std::size_t longest_number = 400;

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// Adds one unit in the last place of the digits in [first, end); true when a one must be put before them.
bool increment_digits(char* first, char* end) {
  for (char* p = end; p != first;) {
    --p;
    if (*p == '.' || *p == '-') continue;
    if (*p != '9') {
      ++*p;
      return false;
    }
    *p = '0';
  }
  return true;
}

}  // namespace

void append_shortest(std::string& out, double value) {
  if (value == 0) {  // also -0
    out += '0';
    return;
  }
  char buffer[longest_number];
  const auto r = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed);
  out.append(buffer, r.ptr);
}

std::string shortest(double value) {
  std::string out;
  append_shortest(out, value);
  return out;
}

void append_rounded(std::string& out, double value, int decimals) {
  if (value == 0 || !std::isfinite(value)) {
    append_shortest(out, value);
    return;
  }
  char buffer[longest_number];
  char* const end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed).ptr;
  char* const point = std::find(buffer, end, '.');
  const std::ptrdiff_t places = std::max(decimals, 0);
  if (point == end || end - point - 1 <= places) {  // already short enough
    out.append(buffer, end);
    return;
  }
  char* cut = point + 1 + places;
  const bool up = *cut >= '5';
  char* const digits = buffer + (*buffer == '-' ? 1 : 0);
  const bool carry = up && increment_digits(digits, cut);
  while (cut[-1] == '0' && cut > point) --cut;
  if (cut[-1] == '.') --cut;
  const bool zero = !carry && std::all_of(digits, cut, [](char c) { return c == '0' || c == '.'; });
  if (zero) {
    out += '0';
    return;
  }
  if (digits != buffer) out += '-';
  if (carry) out += '1';
  out.append(digits, cut);
}

std::string rounded(double value, int decimals) {
  std::string out;
  append_rounded(out, value, decimals);
  return out;
}

std::optional<double> parse_decimal(std::string_view text) {
  const char* p = text.data();
  const char* const end = p + text.size();
  bool negative = false;
  if (p != end && (*p == '+' || *p == '-')) negative = *p++ == '-';
  // fast_float would take "inf", "nan" and a second minus.
  if (p == end || !((*p >= '0' && *p <= '9') || *p == '.')) return std::nullopt;
  double value = 0;
  const auto r = fast_float::from_chars(p, end, value, fast_float::chars_format::fixed);
  if (r.ec != std::errc() || r.ptr != end || !std::isfinite(value)) return std::nullopt;
  return negative ? -value : value;
}

std::string to_upper_ascii(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), upper);
  return out;
}

std::string_view trim(std::string_view text) {
  const std::string_view blanks = " \t\r\n\v\f";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return text.substr(0, 0);
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool iequals_ascii(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return upper(x) == upper(y); });
}

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {}

AtomicFile::~AtomicFile() {
  if (fd_ >= 0) ::close(fd_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

bool AtomicFile::fail(std::string* error, const char* what) {
  if (error != nullptr) *error = fmt::format("{}: {}: {}", path_, what, std::strerror(errno));
  return false;
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

bool AtomicFile::write(std::string_view bytes, std::string* error) {
  constexpr std::size_t buffer_size = 1U << 18U;
  if (fd_ < 0) {
    errno = EBADF;
    return fail(error, "is not open");
  }
  buffer_.append(bytes);
  return buffer_.size() < buffer_size || flush(error);
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
