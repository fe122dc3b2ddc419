// GEOAX(3,W): Z is the axis W of the channel from here on (language reference 14.2). Every frame is deleted; nothing
// moves.
#include <algorithm>
#include <utility>

#include "base/text.h"
#include "dialects/sinumerik/geometry_axes.h"
#include "frontends/sinumerik/frames/geometry_axes.h"
#include "frontends/sinumerik/state/statements.h"
#include "frontends/sinumerik/statements/row_parts.h"
#include "ir/analysis/domains/axis_exchange.h"

namespace cnctrans::sinumerik {

bool StatementLowering::exchange_geometry_axes(WordPos pos, Parts& parts) {
  const auto pairs = geometry_axes(c_.slice(pos));
  if (!pairs)
    return refuse("machine.geometry_axes", pos, "GEOAX() is carried with written numbers and names of axes only");
  std::string said;
  for (const auto& p : *pairs) {
    if (p.number == 0)
      return refuse("machine.geometry_axes", pos, "GEOAX(0,..): a geometry axis without an axis is not carried");
    if (is_own_axis(p)) continue;
    const ir::AxisId axis = c_.machine.axis(p.channel_axis);
    if (axis == ir::axis::none)
      return refuse("machine.axis", pos,
                    "GEOAX(): the machine " + c_.machine.profile->name + " has no axis " + p.channel_axis,
                    "add the axis to the profile of the machine");
    if (axis <= ir::axis::z || c_.machine.rotary[axis])
      return refuse("machine.geometry_axes", pos, p.channel_axis + " can't take the place of a geometry axis");
    said += (said.empty() ? "" : ", ") + std::string(1, "XYZ"[p.number - 1]) + " is " + p.channel_axis;
  }
  c_.warning(
      "SIN-104", pos,
      "GEOAX: " + (said.empty() ? std::string("the geometry axes are those of the machine again") : said) +
          " from here on, and every frame is deselected; the length of the tool acts along the axis that took the "
          "place",
      "select the work offset and the frame again behind it; other controls do not get it");
  const auto add = [&](ir::ActionData data) { parts.act(std::move(data), pos, c_.slice(pos)); };
  add(ir::OpaqueWord{c_.slice(pos)});
  auto clear = std::make_shared<ir::FrameChange>();
  clear->slot = ir::FrameSlot::chain;
  clear->combine = ir::FrameCombine::clear;
  add(ir::FrameOp{std::move(clear)});
  add(ir::WorkOffset{ir::Value(0), true});
  c_.framed = c_.tool_frame = false;
  c_.said.emplace("GEOAX()");
  return true;
}

}  // namespace cnctrans::sinumerik

namespace cnctrans::frontends::sinumerik {

namespace {

using ir::passes::ExchangeFault;

class Resolving {
 public:
  Resolving(ir::Program& program, Diagnostics& diagnostics) : program_(program), diagnostics_(diagnostics) {}

  void refuse(ir::Statement& s, ExchangeFault fault) {
    switch (fault) {
      case ExchangeFault::unsure:
        return keep(s, "which axis takes the place of a geometry axis (GEOAX) depends on the way that leads here");
      case ExchangeFault::not_said:
        return keep(s, "arcs, cycles, compensation, turned frames and data of an axis under GEOAX() are not carried");
      case ExchangeFault::twice: return keep(s, "GEOAX() of an axis that has taken another place already");
      case ExchangeFault::outside:
        return keep(
            s,
            "a program of another file is called while GEOAX() is in force: its words would be read as those of "
            "the machine's own axes");
    }
  }
  /// Which geometry axes are exchanged anywhere in the program.
  void note(const ir::passes::AxisExchange& exchange) {
    for (const auto& [axis, other] : exchange.pairs) exchanged_ |= 1U << axis;
  }
  /// A word of the axis that has taken the place: it has no name of its own there.
  void look(ir::Statement& s) {
    const auto* b = std::get_if<ir::Block>(&s.node);
    if (b == nullptr) return;
    const bool own = std::any_of(b->motion.coords.begin(), b->motion.coords.end(), [this](const ir::CoordWord& w) {
      return w.axis <= ir::axis::z && (exchanged_ >> w.axis & 1U) != 0;
    });
    if (own) keep(s, "an axis that has the place of a geometry axis (GEOAX) is moved by the name of that one only");
  }

 private:
  void keep(ir::Statement& s, std::string_view why) {
    diagnostics_.warning("SIN-008", s.line.span, std::string(why),
                         "the block is kept as text; a run or a translation that comes here stops");
    s.node = ir::Opaque{words_of(s.line), "machine.geometry_axes", false};
  }
  /// The words of the line as written, without number, skip mark, labels and comment.
  [[nodiscard]] std::string words_of(const ir::LineInfo& line) const {
    SourcePtr source;
    for (const auto& f : program_.files) {
      if (f.file == line.span.file) source = program_.texts->source(f.name);
    }
    if (!source) return {};
    std::string_view text = source->line_text(line.span.line);
    text = trim(text.substr(0, text.find(';')));
    const auto skip_number = [&text] {
      text.remove_prefix(1);
      text = trim(text.substr(std::min(text.find_first_not_of("0123456789"), text.size())));
    };
    if (!text.empty() && text.front() == '/') skip_number();
    if (!line.number.empty() && !text.empty()) skip_number();
    for (const auto label : line.labels) {
      const auto colon = text.find(':');
      if (!label.empty() && colon != std::string_view::npos) text = trim(text.substr(colon + 1));
    }
    return std::string(text);
  }

  ir::Program& program_;
  Diagnostics& diagnostics_;
  std::uint32_t exchanged_ = 0;
};

}  // namespace

void resolve_geometry_axes(ir::Program& program, Diagnostics& diagnostics) {
  Resolving resolving(program, diagnostics);
  ir::passes::exchange_axes(
      program, [&](const ir::Statement& s) { return cnctrans::sinumerik::geometry_exchange(s, program.axis_names); },
      [&](ir::Statement& s, ExchangeFault fault) { resolving.refuse(s, fault); },
      [&](ir::Statement& s) { resolving.look(s); });
}

}  // namespace cnctrans::frontends::sinumerik
