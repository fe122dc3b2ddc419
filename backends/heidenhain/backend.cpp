#include "backends/heidenhain/backend.h"

#include "backends/heidenhain/block_numbers.h"
#include "backends/heidenhain/capabilities.h"
#include "backends/heidenhain/tables.h"
#include "backends/heidenhain/writer.h"

namespace cnctrans::backends::heidenhain {
namespace {

class HeidenhainBackend final : public Backend {
 public:
  [[nodiscard]] std::string_view dialect() const override { return dialect_name; }
  [[nodiscard]] const ir::Capabilities& capabilities() const override { return heidenhain::capabilities(); }
  std::vector<OutputFile> write(const ir::Program& program, const WriteOptions& options,
                                Diagnostics& diagnostics) const override {
    auto files = Writer(program, options, diagnostics).write();
    if (options.numbering == Numbering::none) return files;
    const std::int64_t step = options.numbering == Numbering::renumber ? options.number_step : 1;
    for (OutputFile& f : files) f.text = numbered_blocks(f.text, step);
    return files;
  }
};

}  // namespace

std::shared_ptr<const Backend> make_backend() {
  return std::make_shared<const HeidenhainBackend>();
}

}  // namespace cnctrans::backends::heidenhain
