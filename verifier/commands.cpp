#include "verifier/commands.h"

#include <fmt/format.h>

#include <cmath>

#include "base/text.h"
#include "verifier/messages.h"

namespace cnctrans::verifier {

using interpreter::Event;
using interpreter::EventKind;

std::string command_difference(const Event& a, const Event& b, const Options& options, ToolNames& tools) {
  const auto& t = options.tolerances;
  switch (a.kind) {
    case EventKind::spindle:
      if (a.number != b.number || a.state != b.state ||
          (a.state != "off" && (a.css != b.css || !close_relative(a.value, b.value, t.speed_relative))) ||
          a.has_limit != b.has_limit || (a.has_limit && !close_relative(a.limit, b.limit, t.speed_relative)) ||
          (a.state == "oriented" && std::fabs(a.angle - b.angle) > t.angle)) {
        return fmt::format("spindle {} {} {} in the source, {} {} {} in the translation", a.number, a.state,
                           shortest(a.value), b.number, b.state, shortest(b.value));
      }
      return {};
    case EventKind::tool:
      if (a.change != b.change || (options.tool_numbers && !tools.same(a, b))) {
        return fmt::format("tool {}{} in the source, {}{} in the translation", a.number, a.change ? " (change)" : "",
                           b.number, b.change ? " (change)" : "");
      }
      return {};
    case EventKind::offset:
      return options.offset_numbers && a.number != b.number
                 ? fmt::format("offset {} in the source, {} in the translation", a.number, b.number)
                 : "";
    case EventKind::comp: return {};  // on both sides; left or right is compared move by move
    case EventKind::coolant:
      return a.state != b.state ? fmt::format("{} {} in the source, {} in the translation", interpreter::name(a.kind),
                                              a.state, b.state)
                                : "";
    case EventKind::m:
      return a.number != b.number ? fmt::format("M{} in the source, M{} in the translation", a.number, b.number) : "";
    case EventKind::message:
      return same_message(a, b.text)
                 ? ""
                 : fmt::format("message \"{}\" in the source, \"{}\" in the translation", a.text, b.text);
    case EventKind::stop: return a.optional_stop != b.optional_stop ? "an optional stop on one side only" : "";
    case EventKind::end:
      return a.reason != b.reason ? fmt::format("the run ends by {} in the source, by {} in the translation",
                                                interpreter::name(a.reason), interpreter::name(b.reason))
                                  : "";
    default: return {};
  }
}

std::string stroke_difference(const Event& a, const Event& b, const Tolerances& tolerances) {
  if (a.number != b.number)
    return fmt::format("a thread by spindle {} in the source, by spindle {} in the translation", a.number, b.number);
  if (a.value == 0 || (a.css == b.css && close_relative(a.value, b.value, tolerances.speed_relative))) return {};
  return fmt::format("a thread at the speed {} in the source, {} in the translation", shortest(a.value),
                     shortest(b.value));
}

}  // namespace cnctrans::verifier
