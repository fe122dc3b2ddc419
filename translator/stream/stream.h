// Straight-line programs in flat memory: blocks flow through reader, legality check and writer in windows.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "translator/pipeline.h"

namespace cnctrans::translator {

/// Where the translated text goes, piece by piece. False: stop (write error).
using TextSink = std::function<bool(std::string_view)>;

enum class StreamOutcome : std::uint8_t {
  done,
  needs_program,  ///< something needs the whole program: what went to the sink is void
  failed          ///< input or output error: `error`
};
struct StreamResult {
  StreamOutcome outcome = StreamOutcome::done;
  Diagnostics diagnostics;
  FileTable files;
  std::uint64_t lines = 0;
  std::string error;
};

/// Tries to translate the file as a stream. Diagnostics other than notes end the attempt (the whole-program path
/// reports).
StreamResult translate_stream(const std::string& path, const TranslateOptions& options, const TextSink& sink,
                              const Progress& progress);

/// Tries to run the file as a stream.
struct StreamRun {
  StreamOutcome outcome = StreamOutcome::done;
  interpreter::Result result;
  Diagnostics diagnostics;
};
StreamRun run_stream(const std::string& path, const Dialect& dialect, const machine::Profile& profile,
                     const RunOptions& options, interpreter::TraceSink& sink, FileTable& files);

}  // namespace cnctrans::translator
