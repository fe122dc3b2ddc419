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
    return Writer(program, options, diagnostics).write();
  }
  [[nodiscard]] std::unique_ptr<BlockNumbers> block_numbers(const WriteOptions& options) const override {
    if (options.numbering == Numbering::none) return nullptr;
    return std::make_unique<NumberedBlocks>(options.numbering == Numbering::renumber ? options.number_step : 1);
  }
};

}  // namespace

std::shared_ptr<const Backend> make_backend() {
  return std::make_shared<const HeidenhainBackend>();
}

}  // namespace cnctrans::backends::heidenhain
