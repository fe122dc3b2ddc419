// APPR and DEP (reference 6): their words.
#include <utility>

#include "base/text.h"
#include "dialects/heidenhain/leads.h"
#include "frontends/heidenhain/state/lowering.h"

namespace cnctrans::frontends::heidenhain {

namespace facts = dialects::heidenhain;

bool Lowering::lead(const syntax::Statement& s, bool departure) {
  const auto& words = block_->words;
  const facts::LeadRow* row = words.empty() ? nullptr : facts::find_lead(to_upper_ascii(words[0].address));
  const bool good = row != nullptr && !words[0].has_value && (!departure || row->departs);
  if (!good) {
    report_.refuse("HEI-028", s.pos, "`" + s.keyword + "` is followed by LT, LN, CT or LCT, or PLT, PLN, PCT or PLCT");
    return false;
  }
  using facts::LeadForm;
  const bool arc = row->form == LeadForm::tangent_arc || row->form == LeadForm::line_arc;
  Lead lead;
  lead.form = row->form;
  lead.departure = departure;
  lead.where = line_.span;
  const Word *size = nullptr, *angle = nullptr, *polar_radius = nullptr, *polar_angle = nullptr;
  for (std::size_t i = 1; i < words.size() && !report_.refused(); ++i) {
    const Word& w = words[i];
    const auto is = [&w](std::string_view a) { return iequals_ascii(w.address, a); };
    const bool incremental = is_incremental(w.address);
    const ir::AxisId axis = axis_of(incremental ? w.address.substr(1) : w.address);
    const bool zero = !w.is_expression && w.number == 0;
    if (axis != ir::axis::none && w.has_value) {
      axis_word(w, axis, incremental);
    } else if (w.has_value && size == nullptr && (arc ? is("R") && !zero : is("LEN"))) {
      size = &w;
    } else if (w.has_value && row->form == LeadForm::tangent_arc && is("CCA")) {
      angle = &w;
    } else if (w.has_value && row->polar && is("PR")) {
      polar_radius = &w;
    } else if (w.has_value && row->polar && is("PA")) {
      polar_angle = &w;
    } else if (w.has_value && is("M")) {
      machine_function(w);
    } else if (!tail(w) && !report_.refused()) {
      report_.refuse("HEI-002", w.pos, "`" + std::string(slice(w)) + "` means nothing beside " + s.keyword, {},
                     "block.word");
    } else if (!departure && (is("RL") || is("RR"))) {
      lead.side = is("RL") ? 1 : -1;
    }
  }
  if (report_.refused()) return false;
  const auto missing = [&](std::string_view what) {
    report_.refuse("HEI-028", s.pos, "`" + s.keyword + "` has no " + std::string(what));
    return false;
  };
  if (size == nullptr) return missing(arc ? "radius R" : "length LEN");
  if (row->form == LeadForm::tangent_arc && angle == nullptr) return missing("angle CCA");
  const bool to_point = !departure || row->form == LeadForm::line_arc;
  if (row->polar && (polar_radius == nullptr || polar_angle == nullptr)) return missing("PR and PA");
  if (to_point && !row->polar && out_.motion.coords.empty()) return missing("point");
  if (rapid_ && arc) {
    report_.refuse("HEI-006", s.pos, "an arc is not run in rapid traverse: its feed is unknown", "write F");
    return false;
  }
  lead.size = value(*size);
  if (angle != nullptr) lead.angle = value(*angle);
  lead.rapid = rapid_;
  if (row->polar) {
    auto extra = std::make_shared<ir::MotionExtra>();
    extra->has_polar_radius = extra->has_polar_angle = true;
    extra->polar_radius = value(*polar_radius);
    extra->polar_angle = value(*polar_angle);
    out_.motion.extra = std::move(extra);
  }
  out_.motion.kind = ir::MotionKind::linear;
  out_.motion.explicit_code = out_.has_motion = true;
  if (report_.refused()) return false;
  flat_.leads.push_back(std::move(lead));
  Item& item = put(ItemKind::plain, std::move(out_));
  item.moves = true;
  item.call = call_;
  item.lead = static_cast<int>(flat_.leads.size()) - 1;
  return true;
}

}  // namespace cnctrans::frontends::heidenhain
