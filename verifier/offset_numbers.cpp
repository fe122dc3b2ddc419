#include "verifier/offset_numbers.h"

#include <fmt/format.h>

namespace cnctrans::verifier {

using interpreter::EventKind;

OffsetNumbers::Side::Side(const std::vector<Event>& trace) : first(trace.data()) {
  of_event.reserve(trace.size());
  for (const Event& e : trace) {
    const bool changes = e.kind == EventKind::tool && e.change;
    if (changes || e.kind == EventKind::offset) {
      Offset next = offsets.back();
      if (changes) next.tool = std::to_string(e.number) + e.text;
      if (!changes) next.number = e.number;
      offsets.push_back(std::move(next));
    }
    of_event.push_back(static_cast<std::uint32_t>(offsets.size() - 1));
  }
}

std::string OffsetNumbers::difference(const Event& a, const Event& b) {
  if (a.offset.selected == 0 || b.offset.selected == 0) return {};
  const Offset &there = a_.at(a), &here = b_.at(b);
  if (&there == last_a_ && &here == last_b_) return {};
  last_a_ = &there;
  last_b_ = &here;
  if (there.number <= 0 || here.number <= 0) return {};
  const auto before = there_.try_emplace(there, here.number).first->second;
  if (before != here.number)
    return fmt::format("the offset D{} of the source is D{} in the translation here, and D{} before", there.number,
                       here.number, before);
  const auto other = here_.try_emplace(here, there.number).first->second;
  if (other != there.number)
    return fmt::format("D{} of the translation stands for D{} of the source here, and for D{} before", here.number,
                       there.number, other);
  return {};
}

}  // namespace cnctrans::verifier
