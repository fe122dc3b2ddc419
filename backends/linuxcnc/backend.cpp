#include "backends/linuxcnc/backend.h"

#include "backends/linuxcnc/capabilities.h"
#include "backends/linuxcnc/tables.h"
#include "backends/linuxcnc/writer.h"

namespace cnctrans::backends::linuxcnc {
namespace {

/// No block is plain enough: every program goes through the whole-program writer.
class NoStream final : public StreamWriter {
 public:
  void begin(const ir::Program& /*frame*/, std::string& /*out*/) override {}
  bool write(const ir::Statement& /*s*/, std::string& /*out*/, Diagnostics& /*d*/) override { return false; }
  void end(std::string& /*out*/) override {}
};

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
  [[nodiscard]] std::unique_ptr<StreamWriter> stream(const WriteOptions& /*options*/) const override {
    return std::make_unique<NoStream>();
  }
};

}  // namespace

std::shared_ptr<const Backend> make_backend() {
  return std::make_shared<LinuxCnc>();
}

}  // namespace cnctrans::backends::linuxcnc
