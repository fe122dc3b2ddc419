// What the operating system gives: files, processes of their own, the terminal. The only place that asks it:
// posix_*.cpp for Linux and its relatives, windows.cpp for Windows (through MinGW).
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace cnctrans::os {

/// "part.pim: can't be read: No such file or directory", by a number of errno.
void cant_be_read(std::string* error, const std::string& path, int number);

bool is_terminal(std::FILE* stream);
/// Bytes that are there already, or, when there are none, the next that come; 0 at the end.
std::size_t read_what_comes(std::FILE* stream, char* to, std::size_t most);
/// Nothing could be read from `stream` without waiting.
bool is_quiet(std::FILE* stream);

/// A file that is read; folders are refused.
class ReadFile {
 public:
  ReadFile() = default;
  ~ReadFile();
  ReadFile(const ReadFile&) = delete;
  ReadFile& operator=(const ReadFile&) = delete;

  /// False, and why in `error` ("part.pim: can't be read: No such file or directory").
  [[nodiscard]] bool open(const std::string& path, std::string* error);
  [[nodiscard]] std::size_t size() const { return size_; }  ///< 0: no regular file, such as a pipe
  /// The next bytes: how many, 0 at the end, less than 0 (and why in `error`) when they can't be read.
  [[nodiscard]] std::ptrdiff_t read(char* to, std::size_t most, std::string* error) const;
  /// Bytes from a place on; fewer where the file ends or can't be read.
  [[nodiscard]] std::size_t read_at(std::uint64_t from, char* to, std::size_t most) const;
  /// The whole file without a copy, as long as this object lives; empty where that can't be had.
  [[nodiscard]] std::string_view map();
  /// It will be read from its beginning to its end.
  void read_in_order() const;

 private:
  void close();
  std::string path_;
  int fd_ = -1;
  std::size_t size_ = 0;
  void* map_ = nullptr;
};

/// A small file that one process has at a time: who opens it waits until the others have closed it.
class LockedFile {
 public:
  LockedFile() = default;
  ~LockedFile();
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  /// Makes the file where there is none. False: it can't be written.
  bool open(const std::string& path);
  /// In place: a rename would leave those who wait with the old file.
  void replace(std::string_view text);

 private:
  int fd_ = -1;
};

/// Work done in a process of its own, so that what ends it ends nothing else. What it writes to its stream can be read
/// here. Where the system can't do that (Windows) it is done at once, in this process.
class Child {
 public:
  using Work = std::function<bool(std::FILE* out)>;  ///< false: it failed
  /// What became of it. `signal`: of the system, that ended it; 0: none.
  struct End {
    bool good = false;
    int signal = 0;
  };

  Child();
  ~Child();  ///< waits for its end
  Child(Child&&) noexcept;
  Child& operator=(Child&&) noexcept;

  /// False: no process could be started. `most`: a signal ends it after this time.
  bool begin(const Work& work, std::optional<std::chrono::seconds> most = std::nullopt);
  [[nodiscard]] bool begun() const;  ///< a process was started
  /// The next line, without its end. False: there is none, and nothing is left in `line` but the last piece of one.
  bool read_line(std::string& line);
  /// All that it still writes, to its end.
  std::string read_all();
  /// What became of it; nothing yet where it still works. `wait`: until it has ended.
  std::optional<End> ended(bool wait);
  /// Ends it now.
  void kill();

 private:
  struct State;
  [[nodiscard]] std::FILE* written() const;  ///< null: nothing more can be read of it
  std::unique_ptr<State> state_;
};

}  // namespace cnctrans::os
