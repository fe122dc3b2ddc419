// Straight-line programs run in flat memory: blocks flow through the reader and the machine in windows.
#pragma once

#include <string>

#include "translator/pipeline.h"

namespace cnctrans::translator {

enum class StreamOutcome : std::uint8_t {
  done,
  needs_program,  ///< something needs the whole program: what went to the sink is void
  failed          ///< input or output error: `error`
};
/// Tries to run the file as a stream.
struct StreamRun {
  StreamOutcome outcome = StreamOutcome::done;
  interpreter::Result result;
  Diagnostics diagnostics;
};
StreamRun run_stream(const std::string& path, const Dialect& dialect, const machine::Profile& profile,
                     const RunOptions& options, interpreter::TraceSink& sink, FileTable& files);

}  // namespace cnctrans::translator
