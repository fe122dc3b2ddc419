// Whatever the bytes: reading ends, reports instead of crashing, both readers agree, and a run under limits ends.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "dialects/options.h"
#include "interpreter/program/interpreter.h"
#include "ir/text/text.h"
#include "translator/pipeline.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cnctrans;
  static const auto* dialect = translator::find_dialect(FUZZ_DIALECT);
  std::string error;
  static const auto profile = dialects::load_profile(std::string(FUZZ_DIALECT) + "-mill", &error);
  if (dialect == nullptr || !profile) std::abort();
  const auto source = SourceText::from_string("fuzz", std::string(reinterpret_cast<const char*>(data), size));
  FileTable files;
  const FileId file = files.add(source);
  Diagnostics diagnostics;
  const frontends::ReadOptions read{frontends::Reader::both, &*profile};
  ir::Program program = dialect->frontend->read(source, file, read, diagnostics, nullptr);
  ir::number_statements(program);
  for (const auto& d : diagnostics.all()) {
    if (d.code == "CNC-READERS") {
      std::fputs(render_text(d, files).c_str(), stderr);
      std::abort();
    }
  }
  interpreter::Options limits;
  limits.max_events = 1000;
  limits.max_steps = 5000;
  interpreter::TraceCounter sink;
  interpreter::run(program, *profile, limits, sink, diagnostics);
  backends::WriteOptions write;
  write.profile = &*profile;
  write.main_stem = "100";
  write.single_output = true;
  Diagnostics written;
  dialect->backend->write(program, write, written);
  return 0;
}
