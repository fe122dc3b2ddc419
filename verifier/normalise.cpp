#include "verifier/normalise.h"

#include <algorithm>
#include <map>
#include <string>

namespace cnctrans::verifier {

using interpreter::Event;
using interpreter::EventKind;

bool is_motion(EventKind k) {
  return k == EventKind::rapid || k == EventKind::linear || k == EventKind::arc || k == EventKind::thread ||
         k == EventKind::probe;
}

bool is_barrier(EventKind k) {
  return is_motion(k) || k == EventKind::dwell || k == EventKind::stop || k == EventKind::end ||
         k == EventKind::message;
}

namespace {

/// The state that commands leave behind, to see which of them change nothing.
class StateFilter {
 public:
  bool changes(const Event& e) {
    switch (e.kind) {
      case EventKind::spindle: {
        Spindle now{e.state, e.css, e.state == "off" ? 0 : e.value, e.has_limit ? e.limit : 0, e.angle};
        auto& known = spindles_[e.number];
        if (known == now) return false;
        known = now;
        return true;
      }
      case EventKind::coolant: return update(coolant_, e.state);
      case EventKind::comp: return update(comp_, e.state);
      case EventKind::offset: return update(offset_, std::to_string(e.number));
      default: return true;
    }
  }

 private:
  struct Spindle {
    std::string state = "off";
    bool css = false;
    double value = 0, limit = 0, angle = 0;
    bool operator==(const Spindle&) const = default;
  };
  static bool update(std::string& known, const std::string& now) {
    if (known == now) return false;
    known = now;
    return true;
  }
  std::map<std::int32_t, Spindle> spindles_;
  std::string coolant_ = "off", comp_ = "off", offset_;
};

}  // namespace

bool has_selections(const std::vector<Event>& events) {
  return std::any_of(events.begin(), events.end(),
                     [](const Event& e) { return e.kind == EventKind::tool && !e.change; });
}

std::vector<OffsetState> offset_states(const std::vector<Event>& events) {
  std::vector<OffsetState> states;
  states.reserve(events.size());
  OffsetState now = OffsetState::unknown;
  bool for_next_tool = false;  // an offset was selected behind the T of the tool that comes
  for (const auto& e : events) {
    if (e.kind == EventKind::tool) {
      if (e.change && !for_next_tool) now = OffsetState::unknown;
      for_next_tool = false;
    }
    if (e.kind == EventKind::offset) {
      now = e.number == 0 ? OffsetState::off : OffsetState::on;
      for_next_tool = e.number != 0;
    }
    states.push_back(now);
  }
  return states;
}

std::vector<const Event*> normalise(const std::vector<Event>& events, bool keep_offsets, bool keep_selections) {
  std::vector<const Event*> out;
  out.reserve(events.size());
  StateFilter filter;
  std::size_t stretch = 0;
  const auto close_stretch = [&out, &stretch] {
    std::stable_sort(out.begin() + static_cast<std::ptrdiff_t>(stretch), out.end(),
                     [](const Event* a, const Event* b) { return a->kind < b->kind; });
    // Of speeds and limits that follow each other with nothing between only the last is ever driven.
    const auto from = out.begin() + static_cast<std::ptrdiff_t>(stretch);
    auto kept = from;
    for (auto at = from; at != out.end(); ++at) {
      const bool replaced = at + 1 != out.end() && (*at)->kind == EventKind::spindle &&
                            (*(at + 1))->kind == EventKind::spindle && (*at)->number == (*(at + 1))->number &&
                            (*at)->state == (*(at + 1))->state;
      if (!replaced) *kept++ = *at;
    }
    out.erase(kept, out.end());
  };
  for (const auto& e : events) {
    if (e.kind == EventKind::feed_stop) continue;  // timing, not path: see docs/verify.md
    if (e.kind == EventKind::offset && !keep_offsets) continue;
    if (e.kind == EventKind::tool && !e.change && !keep_selections) continue;
    if (!filter.changes(e)) continue;
    if (is_barrier(e.kind)) {
      close_stretch();
      out.push_back(&e);
      stretch = out.size();
    } else {
      out.push_back(&e);
    }
  }
  close_stretch();
  return out;
}

}  // namespace cnctrans::verifier
