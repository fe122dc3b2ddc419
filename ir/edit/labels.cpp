#include "ir/edit/labels.h"

#include <algorithm>

#include "base/text.h"
#include "ir/nesting.h"

namespace cnctrans::ir {

std::string label_key(std::string_view text, bool is_number) {
  if (!is_number) return "." + to_upper_ascii(text);
  const auto digit = text.find_first_not_of('0');
  return "N" + std::string(text.empty() ? text : digit == std::string_view::npos ? "0" : text.substr(digit));
}

LabelTable::LabelTable(const Routine& routine) {
  add_body(routine.body);
}

void LabelTable::add_line(const LineInfo& line, std::uint32_t id, SitePart part) {
  ++order_;
  const LabelSite site{id, part, order_};
  if (!line.number.empty()) by_name_[label_key(line.number, true)].push_back(site);
  for (const auto label : line.labels) by_name_[label_key(label, false)].push_back(site);
  if (!line.number.empty() || !line.labels.empty()) sites_.push_back(site);
}

void LabelTable::add_body(const Body& body) {
  for (const auto& s : body) add_statement(s);
}

void LabelTable::add_statement(const Statement& s) {
  if (orders_.size() <= s.id) orders_.resize(s.id + 1);
  orders_[s.id] = order_ + 1;
  add_line(s.line, s.id, SitePart::statement);
  const auto bodies = detail::bodies_of(s);
  if (bodies[0] != nullptr) add_body(*bodies[0]);
  if (const auto* i = std::get_if<If>(&s.node); i != nullptr && i->has_else) {
    add_line(i->else_line, s.id, SitePart::else_line);
  }
  if (bodies[1] != nullptr) add_body(*bodies[1]);
  if (const auto* line = detail::end_line_of(s)) add_line(*line, s.id, SitePart::end_line);
}

std::uint32_t LabelTable::order(std::uint32_t statement_id) const {
  return statement_id < orders_.size() ? orders_[statement_id] : 0;
}

const std::vector<LabelSite>& LabelTable::all(std::string_view text, bool is_number) const {
  static const std::vector<LabelSite> none;
  const auto it = by_name_.find(label_key(text, is_number));
  return it == by_name_.end() ? none : it->second;
}

std::optional<LabelSite> LabelTable::find(std::string_view text, bool is_number, Search search,
                                          std::uint32_t from) const {
  const auto& found = all(text, is_number);
  if (found.empty() || search == Search::to_start) return std::nullopt;
  if (search == Search::whole_first) return found.front();
  const auto later = std::find_if(found.begin(), found.end(), [from](const LabelSite& s) { return s.order > from; });
  if (search != Search::backward && later != found.end()) return *later;
  if (search == Search::forward || later == found.begin()) return std::nullopt;
  return *std::prev(later);
}

std::optional<std::pair<LabelSite, LabelSite>> LabelTable::range(const Repeat& repeat, std::uint32_t from) const {
  auto first = find(repeat.first, repeat.search, from);
  if (!first && repeat.search == Search::backward) first = find(repeat.first, Search::forward, from);
  const auto& ends = all(repeat.last.text, repeat.last.is_number);
  if (!first || ends.empty()) return std::nullopt;
  auto last = ends.begin();
  if (repeat.search != Search::whole_first) {
    last = std::find_if(ends.begin(), ends.end(), [&](const LabelSite& s) { return s.order >= first->order; });
    if (last == ends.end()) last = ends.begin();
  }
  if (last->order >= first->order) return std::pair{*first, *last};
  return repeat.order_free ? std::optional(std::pair{*last, *first}) : std::nullopt;
}

}  // namespace cnctrans::ir
