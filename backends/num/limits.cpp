// G92 S limits the spindle under constant cutting speed only (reference 7); elsewhere the limit counts for S, too.
#include "backends/num/writer.h"
#include "base/text.h"

namespace cnctrans::backends::num {

/// A speed that the source's control holds back and this one does not.
void Writer::tell_limit(const ir::Action& a, const ir::SpindleLimit& s) {
  if (same_dialect() || s.value.is(0)) return;
  bool css = false;
  std::string faster;
  for (const auto& r : program().routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& other) {
      const auto* b = std::get_if<ir::Block>(&other.node);
      if (b == nullptr) return;
      for (const auto& x : b->actions) {
        const auto* mode = std::get_if<ir::ModalSet>(&x.data);
        if (mode != nullptr && mode->setting == ir::Setting::spindle_mode)
          css = mode->value != static_cast<std::uint8_t>(ir::SpindleMode::rpm);
      }
      for (const auto& x : b->actions) {
        const auto* speed = std::get_if<ir::SetSpindle>(&x.data);
        if (speed == nullptr || css || speed->number != s.number || !faster.empty()) continue;
        const bool known = speed->value.literal() && s.value.literal();
        if (known && speed->value.number <= s.value.number) continue;
        faster = known ? "S" + shortest(speed->value.number) : "a computed S";
      }
    });
  }
  if (faster.empty()) return;
  diagnostics().warning("TRN-630", span_of(a.pos),
                        "this limit counts under G96 only here, in the source for a speed under G97 too: " + faster +
                            " of this program may turn faster than it did",
                        "write the smaller speed");
}

}  // namespace cnctrans::backends::num
