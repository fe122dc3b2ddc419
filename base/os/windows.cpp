// The same for Windows. Names of files are UTF-8: the program's manifest asks for that code page (Windows 10 and
// later).
#ifdef _WIN32
#include <fcntl.h>
#include <fmt/format.h>
#include <io.h>
#include <share.h>
#include <sys/stat.h>
#include <windows.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "base/os/os.h"
#include "base/text.h"

namespace cnctrans::os {

namespace {

HANDLE handle_of(int fd) {
  return reinterpret_cast<HANDLE>(::_get_osfhandle(fd));
}

}  // namespace

bool is_terminal(std::FILE* stream) {
  return ::_isatty(::_fileno(stream)) != 0;
}

std::size_t read_what_comes(std::FILE* stream, char* to, std::size_t most) {
  const int got = ::_read(::_fileno(stream), to, static_cast<unsigned>(std::min<std::size_t>(most, 1U << 20U)));
  return got > 0 ? static_cast<std::size_t>(got) : 0;
}

bool is_quiet(std::FILE* stream) {
  DWORD there = 0;
  const HANDLE handle = handle_of(::_fileno(stream));
  if (::PeekNamedPipe(handle, nullptr, 0, nullptr, &there, nullptr) != 0) return there == 0;
  return ::WaitForSingleObject(handle, 0) != WAIT_OBJECT_0;
}

ReadFile::~ReadFile() {
  close();
}

void ReadFile::close() {
  if (map_ != nullptr) ::UnmapViewOfFile(map_);
  if (fd_ >= 0) ::_close(fd_);
  map_ = nullptr;
  fd_ = -1;
}

bool ReadFile::open(const std::string& path, std::string* error) {
  close();
  path_ = path;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    cant_be_read(error, path, EISDIR);
    return false;
  }
  fd_ = path == "/dev/stdin" ? ::_dup(0) : ::_open(path.c_str(), _O_RDONLY | _O_BINARY | _O_NOINHERIT);
  if (fd_ < 0) {
    cant_be_read(error, path, errno);
    return false;
  }
  ::_setmode(fd_, _O_BINARY);
  struct _stat64 st {};
  size_ = ::_fstat64(fd_, &st) == 0 && (st.st_mode & _S_IFREG) != 0 ? static_cast<std::size_t>(st.st_size) : 0;
  return true;
}

std::ptrdiff_t ReadFile::read(char* to, std::size_t most, std::string* error) const {
  const int got = ::_read(fd_, to, static_cast<unsigned>(std::min<std::size_t>(most, 1U << 30U)));
  if (got < 0) cant_be_read(error, path_, errno);
  return got;
}

std::size_t ReadFile::read_at(std::uint64_t from, char* to, std::size_t most) const {
  std::size_t got = 0;
  while (got < most) {
    OVERLAPPED place{};
    place.Offset = static_cast<DWORD>((from + got) & 0xFFFFFFFFU);
    place.OffsetHigh = static_cast<DWORD>((from + got) >> 32U);
    DWORD n = 0;
    const auto piece = static_cast<DWORD>(std::min<std::size_t>(most - got, 1U << 30U));
    if (::ReadFile(handle_of(fd_), to + got, piece, &n, &place) == 0 || n == 0) break;
    got += n;
  }
  return got;
}

std::string_view ReadFile::map() {
  if (map_ == nullptr && size_ != 0) {
    const HANDLE mapping = ::CreateFileMappingW(handle_of(fd_), nullptr, PAGE_READONLY, 0, 0, nullptr);
    if (mapping != nullptr) {
      map_ = ::MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, 0);
      ::CloseHandle(mapping);  // the view stays
    }
    if (map_ != nullptr) ::_close(std::exchange(fd_, -1));
  }
  return map_ == nullptr ? std::string_view() : std::string_view(static_cast<const char*>(map_), size_);
}

void ReadFile::read_in_order() const {}

LockedFile::~LockedFile() {
  if (fd_ >= 0) ::_close(fd_);
}

bool LockedFile::open(const std::string& path) {
  if (fd_ >= 0) ::_close(fd_);
  fd_ = ::_open(path.c_str(), _O_RDWR | _O_CREAT | _O_BINARY | _O_NOINHERIT, _S_IREAD | _S_IWRITE);
  if (fd_ < 0) return false;
  OVERLAPPED place{};
  place.OffsetHigh = 1;  // behind the text, which others may read meanwhile
  ::LockFileEx(handle_of(fd_), LOCKFILE_EXCLUSIVE_LOCK, 0, 1, 0, &place);
  return true;
}

void LockedFile::replace(std::string_view text) {
  if (fd_ < 0 || ::_lseeki64(fd_, 0, SEEK_SET) != 0 || ::_chsize_s(fd_, 0) != 0) return;
  while (!text.empty()) {
    const int n = ::_write(fd_, text.data(), static_cast<unsigned>(std::min<std::size_t>(text.size(), 1U << 30U)));
    if (n <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

struct Child::State {
  std::FILE* in = nullptr;  ///< what it wrote
  std::optional<End> end;
};

Child::Child() : state_(std::make_unique<State>()) {}
Child::Child(Child&&) noexcept = default;
Child::~Child() {
  if (state_ != nullptr && state_->in != nullptr) std::fclose(state_->in);
}

Child& Child::operator=(Child&& other) noexcept {
  std::swap(state_, other.state_);
  return *this;
}

bool Child::begin(const Work& work, std::optional<std::chrono::seconds> /*most*/) {
  if (state_->in != nullptr) std::fclose(state_->in);
  *state_ = {std::tmpfile(), std::nullopt};
  if (state_->in == nullptr) return false;
  state_->end = End{work(state_->in), 0};
  std::rewind(state_->in);
  return true;
}

bool Child::begun() const {
  return state_->end.has_value();
}

std::FILE* Child::written() const {
  return state_->in;
}

std::optional<Child::End> Child::ended(bool /*wait*/) {
  return state_->end;
}

void Child::kill() {}

}  // namespace cnctrans::os

namespace cnctrans {

AtomicFile::~AtomicFile() {
  if (fd_ >= 0) ::_close(fd_);
  if (!temporary_.empty()) ::_unlink(temporary_.c_str());
}

bool AtomicFile::open(std::string* error) {
  namespace fs = std::filesystem;
  if (path_ == "/dev/stdout" || path_ == "/dev/stderr") {
    fd_ = ::_dup(path_ == "/dev/stdout" ? 1 : 2);
    ::_setmode(fd_, _O_BINARY);
    return fd_ >= 0 || fail(error, "can't be written");
  }
  std::error_code ignored;
  const fs::path real = fs::canonical(path_, ignored);
  target_ = real.empty() ? path_ : real.string();
  if (fs::is_directory(target_, ignored)) {
    errno = EISDIR;
    return fail(error, "can't be written");
  }
  if (!real.empty() && ::_access(target_.c_str(), 2) != 0) return fail(error, "can't be written");
  const std::string folder = fs::path(target_).parent_path().string();
  for (int n = 0; n < 1000 && fd_ < 0; ++n) {
    temporary_ = fmt::format("{}{}.cnctrans-{}-{}.tmp", folder, folder.empty() ? "" : "/", ::GetCurrentProcessId(), n);
    fd_ = ::_open(temporary_.c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT, _S_IREAD | _S_IWRITE);
    if (fd_ < 0 && errno != EEXIST) break;
  }
  if (fd_ >= 0) return true;
  temporary_.clear();
  return fail(error, "can't be written");
}

bool AtomicFile::flush(std::string* error) {
  std::string_view left = buffer_;
  while (!left.empty()) {
    const int n = ::_write(fd_, left.data(), static_cast<unsigned>(left.size()));
    if (n < 0) return fail(error, "can't be written");
    left.remove_prefix(static_cast<std::size_t>(n));
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
  if (::_close(std::exchange(fd_, -1)) != 0) return fail(error, "can't be written");
  if (temporary_.empty()) return true;
  if (::MoveFileExA(temporary_.c_str(), target_.c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) == 0) {
    errno = EACCES;
    return fail(error, "can't be replaced");
  }
  temporary_.clear();
  return true;
}

}  // namespace cnctrans
#endif
