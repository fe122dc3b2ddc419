// A straight-line program as a run in flat memory, window by window.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "translator/stream/stream.h"
#include "translator/stream/stream_windows.h"

namespace cnctrans::translator {

class StreamReplay {
 public:
  /// `name`: of the file for the reader and in messages; `path`: where its text is.
  StreamReplay(const std::string& path, const std::string& name, const Dialect& dialect,
               const machine::Profile& profile, const interpreter::Options& options, interpreter::TraceSink& sink,
               FileTable& files);
  /// The same lines run with these options too. Before the first window.
  void also(const machine::Profile& profile, const interpreter::Options& options, interpreter::TraceSink& sink) {
    other_.emplace(profile, options, sink, other_said_);
  }
  /// Runs the next window of lines. False: it was the last one, or the program is none for a stream.
  bool window();
  /// So far it is a program for a stream.
  [[nodiscard]] bool good() const { return reader_ != nullptr; }
  /// Behind the last window; `other`: gets the result with the other options.
  StreamRun finish(interpreter::Result* other = nullptr);
  /// Block-skip switches that the lines so far ask.
  [[nodiscard]] std::uint16_t skips() const { return skips_; }

 private:
  Windows windows_;
  std::string_view window_;
  FileId file_;
  Span last_;  ///< of the last statement; an empty program ends on its first line
  Diagnostics diagnostics_;
  interpreter::BlockRunner runner_;
  Diagnostics other_said_;
  std::optional<interpreter::BlockRunner> other_;
  std::unique_ptr<frontends::StreamReader> reader_;  ///< null: not for a stream
  ir::Statement statement_;
  std::uint32_t number_ = 0;
  std::uint16_t skips_ = 0;
  bool going_ = true, utf8_ = true;
};

}  // namespace cnctrans::translator
