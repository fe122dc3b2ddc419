#include "backends/fagor/backend.h"

#include "backends/fagor/capabilities.h"
#include "backends/fagor/file_labels.h"
#include "backends/fagor/tables.h"
#include "backends/fagor/writer.h"
#include "dialects/fagor/axis_exchange.h"
#include "dialects/fagor/options.h"
#include "ir/analysis/domains/mirrored_presets.h"
#include "ir/edit/search.h"

namespace cnctrans::backends::fagor {
namespace {

bool is_lathe(const machine::Profile& profile) {
  return profile.kind == machine::Kind::lathe;
}

/// Inches anywhere in the program: length words have five decimals.
bool uses_inches(const ir::Program& program) {
  bool found = program.unit_hint == ir::Units::inch;
  for (const ir::Routine& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr) return;
      for (const ir::Action& a : b->actions) {
        const auto* m = std::get_if<ir::ModalSet>(&a.data);
        found = found || (m != nullptr && m->setting == ir::Setting::units && m->value == code_value(ir::Units::inch));
      }
    });
  }
  return found;
}

bool exchanges_axes(const ir::Program& program) {
  bool found = false;
  for (const ir::Routine& r : program.routines) {
    ir::for_each_statement(
        r.body, [&](const ir::Statement& s) { found = found || dialects::fagor::axis_exchange(s).has_value(); });
  }
  return found;
}

/// Behind G28 the IR names the axes that move; the text names the ones that were exchanged for them.
ir::Program with_written_axes(const ir::Program& program) {
  ir::Program out = program;
  ir::passes::exchange_axes(
      out, dialects::fagor::axis_exchange, [](ir::Statement& /*s*/, ir::passes::ExchangeFault /*f*/) {},
      [](ir::Statement& /*s*/) {});
  return out;
}

/// A preset says the mirrored coordinate in the IR; G92 takes the one that counts without the mirror image (7.5).
std::optional<ir::Program> with_plain_presets(const ir::Program& program, const machine::Profile& profile,
                                              Diagnostics& diagnostics) {
  if (dialects::fagor::options_of(profile).g92_mirror == dialects::fagor::PresetOfMirror::through) return std::nullopt;
  ir::Program out = program;
  const bool any = ir::passes::presets_past_mirrors(
      out,
      [&](const ir::Statement& s) {
        diagnostics.error("TRN-680", s.line.span,
                          "whether an axis of this preset is mirrored depends on the way that leads here",
                          "end the mirror image before the preset, and begin it again behind it");
      },
      [](const ir::Statement& /*s*/) {});
  return any ? std::optional(std::move(out)) : std::nullopt;
}

bool has_presets(const ir::Program& program) {
  return ir::any_action(program, [](const ir::Action& a) {
    const auto* f = std::get_if<ir::FrameOp>(&a.data);
    return f != nullptr && f->change && f->change->combine == ir::FrameCombine::preset;
  });
}

class FagorBackend : public Backend {
 public:
  [[nodiscard]] std::string_view dialect() const override { return dialect_name; }
  [[nodiscard]] const ir::Capabilities& capabilities() const override { return fagor::capabilities(false); }
  [[nodiscard]] const ir::Capabilities& capabilities_for(const machine::Profile& target) const override {
    return fagor::capabilities(is_lathe(target));
  }
  std::vector<OutputFile> write(const ir::Program& program, const WriteOptions& options,
                                Diagnostics& diagnostics) const override {
    const bool foreign = program.dialect != dialect_name;
    const Style style = make_style(is_lathe(*options.profile), uses_inches(program), foreign);
    std::optional<ir::Program> relabelled;
    if (!foreign && exchanges_axes(program)) relabelled = with_written_axes(program);
    if (foreign)
      relabelled = with_file_labels(program, file_groups(program, file_order(program, false), options), diagnostics);
    if (has_presets(program)) {
      if (auto plain = with_plain_presets(relabelled ? *relabelled : program, *options.profile, diagnostics))
        relabelled = std::move(plain);
    }
    return Writer(relabelled ? *relabelled : program, options, style, diagnostics).write();
  }
};

}  // namespace

std::shared_ptr<const Backend> make_backend() {
  return std::make_shared<const FagorBackend>();
}

}  // namespace cnctrans::backends::fagor
