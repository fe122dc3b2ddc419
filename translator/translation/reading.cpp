#include "translator/translation/reading.h"

#include "translator/files/readable.h"
#include "translator/files/tool_file.h"

namespace cnctrans::translator {

bool Reading::open(const Input& input, const std::string& dialect, const InputOptions& options, std::string* error) {
  dialect_ = find_readable(dialect, error);
  if (dialect_ == nullptr) return false;
  source_ = input.open(error);
  if (!source_) return false;
  in_memory_ = input.in_memory();
  profile_ = choose_profile(*dialect_, options.machine, source_.get(), error);
  if (!profile_) return false;
  if (!options.tools.empty()) {
    const auto file = read_tools(options.tools, profile_->kind == machine::Kind::lathe, error);
    if (!file) return false;
    put_tools(file->tools, *profile_);
  }
  loader_.emplace(*dialect_, *profile_, options.reader, options.libraries, options.texts);
  for (const auto& text : options.definitions) loader_->define(text);
  return true;
}

const ir::Program& Reading::read(Diagnostics& diagnostics, frontends::ReadStats* stats) {
  return in_memory_ ? *loader_->read_source(source_, diagnostics, stats)
                    : *loader_->read_main(source_, diagnostics, stats);
}

}  // namespace cnctrans::translator
