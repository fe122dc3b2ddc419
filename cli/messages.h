// What a call says on stderr.
#pragma once

#include <string>
#include <string_view>

#include "base/diagnostics.h"
#include "base/source.h"

namespace cnctrans::cli {

/// As text each message is written at once. As JSON the whole call is one array, written by
/// finish(): diagnostics and the lines of the command itself in their order.
class Messages {
 public:
  explicit Messages(bool json, bool colour = false) : json_(json), colour_(colour) {}
  ~Messages() { finish(); }
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  void add(const Diagnostics& diagnostics, const FileTable& files);
  /// A line of the command itself (no file, no place). `code` is that of docs/diagnostics/translator.md.
  void say(Severity severity, std::string_view code, std::string_view line);
  void finish();

 private:
  void append(const Diagnostics& diagnostics, const FileTable& files);
  bool json_, colour_;
  bool finished_ = false;
  std::string list_;  ///< elements of the array
};

}  // namespace cnctrans::cli
