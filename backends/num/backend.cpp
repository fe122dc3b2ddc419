#include "backends/num/backend.h"

#include <charconv>

#include "backends/common/comments.h"
#include "backends/num/style.h"
#include "backends/num/writer.h"
#include "dialects/num/limits.h"

namespace cnctrans::backends::num {

namespace {

class NumBackend final : public Backend {
 public:
  [[nodiscard]] std::string_view dialect() const override { return "num"; }
  [[nodiscard]] const ir::Capabilities& capabilities() const override { return num::capabilities(false, true, true); }
  [[nodiscard]] const ir::Capabilities& capabilities_for(const machine::Profile& target) const override {
    const auto options = dialects::num::options_of(target);
    return num::capabilities(target.kind == machine::Kind::lathe, later_family(options), structured(options));
  }
  std::vector<OutputFile> write(const ir::Program& program, const WriteOptions& options,
                                Diagnostics& diagnostics) const override {
    return Writer(program, options, diagnostics).write();
  }
};

}  // namespace

std::shared_ptr<const Backend> make_backend() {
  return std::make_shared<NumBackend>();
}

}  // namespace cnctrans::backends::num
