// What cnctrans has written into a folder: a list that is kept there, `.cnctrans-written`, with a sum of each file and
// the programs that it was translated from. A file that does not stand in it, or is not as it was written, belongs to
// somebody else and is neither replaced nor removed; nor is what another program was translated to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/os/os.h"

namespace cnctrans::translator {

/// A file to be written into a folder.
struct FileToWrite {
  std::string name;
  std::string_view bytes{};
  std::string program{};  ///< its name in the control where that is not the file's ("%20"); may be empty
  bool named = false;     ///< somebody asked for this very file: it may take the place of another program's
  std::string sum{};      ///< of its bytes, where they are not at hand
  std::function<bool(std::string* error)> put_in_place{};  ///< then: they are written, and wait for this
};

class WrittenFiles {
 public:
  enum class Use : std::uint8_t { look, write };
  /// Reads the list. `write`: the folder is made when it is not there, and other calls that write into it wait until
  /// this object ends.
  explicit WrittenFiles(std::filesystem::path folder, Use use = Use::write);

  /// Names of the files in the list.
  [[nodiscard]] std::set<std::string> names() const;

  struct Origin {
    std::string source;               ///< path of the program that is translated
    std::vector<std::string> coming;  ///< programs that are translated behind it: what was made of them may change too
    bool force = false;               ///< what belongs to somebody else is replaced as well
  };
  /// Why the files can't be written, each with a sentence; empty: they can.
  [[nodiscard]] std::vector<std::string> conflicts(const std::vector<FileToWrite>& files, const Origin& origin) const;
  /// Puts them into the list. To be called before they are written: a call that is killed between leaves files that
  /// are known. What the list said of them before is kept for that case.
  void add(const std::vector<FileToWrite>& files, const Origin& origin);
  /// Adds and writes all. False, and a reason: one of them can't be written.
  bool write(const std::vector<FileToWrite>& files, const Origin& origin, std::string* error);

  /// Files of the list that are there and not as they were written.
  [[nodiscard]] std::vector<std::string> changed() const;
  /// Removes the files of the list that are as they were written, but for those named.
  void remove_all_but(const std::set<std::string>& names);
  /// Names and program names of what other programs were translated to: see TranslateOptions::taken.
  [[nodiscard]] std::set<std::string> taken(const Origin& origin) const;

 private:
  struct Entry {
    std::vector<std::string> sums;  ///< the last one written, and the one that was there before it
    std::set<std::string> origins;  ///< paths from this folder
    std::string program;
  };
  using Entries = std::map<std::string, Entry>;
  static Entries read(const std::string& text);
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::string from_here(const std::string& source) const;
  [[nodiscard]] std::string as_said(const std::string& origin) const;
  [[nodiscard]] std::set<std::string> replaceable(const Origin& origin) const;
  [[nodiscard]] std::string conflict(const FileToWrite& file, const std::set<std::string>& mine, bool force) const;
  void put(const FileToWrite& file, const std::string& origin);
  void save();

  std::filesystem::path folder_;
  Entries entries_;
  os::LockedFile list_;
};

}  // namespace cnctrans::translator
