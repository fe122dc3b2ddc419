#include "backends/linuxcnc/backend.h"

#include "backends/linuxcnc/capabilities.h"
#include "backends/linuxcnc/tables.h"
#include "backends/linuxcnc/writer.h"

namespace cnctrans::backends::linuxcnc {
namespace {

class LinuxCnc final : public Backend {
 public:
  [[nodiscard]] std::string_view dialect() const override { return style.dialect; }
  [[nodiscard]] const ir::Capabilities& capabilities() const override { return linuxcnc::capabilities(false); }
  [[nodiscard]] const ir::Capabilities& capabilities_for(const machine::Profile& target) const override {
    return linuxcnc::capabilities(target.kind == machine::Kind::lathe);
  }
  std::vector<OutputFile> write(const ir::Program& program, const WriteOptions& options,
                                Diagnostics& diagnostics) const override {
    return Writer(program, options, diagnostics).write();
  }
};

}  // namespace

std::shared_ptr<const Backend> make_backend() {
  return std::make_shared<LinuxCnc>();
}

}  // namespace cnctrans::backends::linuxcnc
