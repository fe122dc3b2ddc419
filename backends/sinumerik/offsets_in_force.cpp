#include "backends/sinumerik/offsets_in_force.h"

#include <algorithm>

#include "ir/edit/search.h"

namespace cnctrans::backends::sinumerik {

namespace {

void add_word(OffsetsInForce& state, const ir::Value& word) {
  const auto same = [&word](const ir::Value& v) { return equal(v, word); };
  if (std::none_of(state.words.begin(), state.words.end(), same)) state.words.push_back(word);
}

}  // namespace

OffsetDomain::OffsetDomain(const ir::Program& program) {
  anything_.open = true;
  for (const ir::Routine& r : program.routines) {
    ir::for_each_statement(r.body, [this](const ir::Statement& s) {
      State here;
      transfer(s, here);
      for (const auto& word : here.words) add_word(anything_, word);
      anything_.by_tool = anything_.by_tool || here.by_tool;
    });
  }
}

OffsetsInForce OffsetDomain::start(const ir::Routine& r, bool called) const {
  State state;
  state.at_start = true;
  return r.kind == ir::RoutineKind::main && !called ? state : anything_;
}

void OffsetDomain::transfer(const ir::Statement& s, State& state) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  if (b == nullptr) return;
  for (const ir::Action& a : b->actions) {
    if (const auto* d = std::get_if<ir::ToolOffset>(&a.data)) {
      state = {};
      state.words.push_back(d->number);
    }
    // A tool without its D keeps the offset on one control and selects another on the next one: said where it is.
    if (std::holds_alternative<ir::ToolSelect>(a.data) && state.words.empty()) {
      state = {};
      state.by_tool = true;
    }
  }
}

bool OffsetDomain::join(State& a, const State& b) {
  const std::size_t words = a.words.size();
  for (const auto& word : b.words) add_word(a, word);
  const bool changed =
      a.words.size() != words || (b.at_start && !a.at_start) || (b.by_tool && !a.by_tool) || (b.open && !a.open);
  a.at_start = a.at_start || b.at_start;
  a.by_tool = a.by_tool || b.by_tool;
  a.open = a.open || b.open;
  return changed;
}

}  // namespace cnctrans::backends::sinumerik
