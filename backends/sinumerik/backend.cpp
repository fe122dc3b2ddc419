#include "backends/sinumerik/backend.h"

#include "backends/common/comments.h"
#include "backends/sinumerik/capabilities.h"
#include "backends/sinumerik/tables.h"
#include "backends/sinumerik/writer.h"
#include "base/text.h"
#include "dialects/sinumerik/geometry_axes.h"

namespace cnctrans::backends::sinumerik {
namespace {

std::optional<ir::passes::AxisExchange> exchange(const ir::Program& program, const ir::Statement& s) {
  return cnctrans::sinumerik::geometry_exchange(s, program.axis_names);
}

bool exchanges_axes(const ir::Program& program) {
  bool found = false;
  for (const ir::Routine& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) { found = found || exchange(program, s).has_value(); });
  }
  return found;
}

/// Behind GEOAX the IR names the axes that move; the text names the geometry axes whose place they have.
ir::Program with_written_axes(const ir::Program& program) {
  ir::Program out = program;
  ir::passes::exchange_axes(
      out, [&](const ir::Statement& s) { return exchange(program, s); },
      [](ir::Statement& /*s*/, ir::passes::ExchangeFault /*f*/) {}, [](ir::Statement& /*s*/) {});
  return out;
}

class Sinumerik final : public Backend {
 public:
  [[nodiscard]] std::string_view dialect() const override { return style.dialect; }
  [[nodiscard]] const ir::Capabilities& capabilities() const override { return sinumerik::capabilities(); }
  std::vector<OutputFile> write(const ir::Program& program, const WriteOptions& options,
                                Diagnostics& diagnostics) const override {
    if (program.dialect != style.dialect || !exchanges_axes(program))
      return Writer(program, options, diagnostics).write();
    return Writer(with_written_axes(program), options, diagnostics).write();
  }
};

}  // namespace

std::shared_ptr<const Backend> make_backend() {
  return std::make_shared<Sinumerik>();
}

}  // namespace cnctrans::backends::sinumerik
