// A straight-line program as a run in flat memory, window by window.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "translator/stream/stream.h"
#include "translator/stream/stream_windows.h"

namespace cnctrans::translator {

class StreamReplay {
 public:
  StreamReplay(const std::string& path, const Dialect& dialect, const machine::Profile& profile,
               const interpreter::Options& options, interpreter::TraceSink& sink, FileTable& files);
  /// Runs the next window of lines. False: it was the last one, or the program is none for a stream.
  bool window();
  /// Behind the last window.
  StreamRun finish();

 private:
  Windows windows_;
  std::string_view window_;
  FileId file_;
  Span last_;  ///< of the last statement; an empty program ends on its first line
  Diagnostics diagnostics_;
  interpreter::BlockRunner runner_;
  std::unique_ptr<frontends::StreamReader> reader_;  ///< null: not for a stream
  ir::Statement statement_;
  std::uint32_t number_ = 0;
  bool going_ = true, utf8_ = true;
};

}  // namespace cnctrans::translator
