#include "verifier/normalise.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

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
        Spindle now{e.state, e.css, e.state == "off" ? 0 : e.value, e.has_limit ? e.limit : 0,
                    e.state == "oriented" ? e.angle : 0};
        auto& known = spindles_[e.number];
        if (known == now) return false;
        known = now;
        return true;
      }
      case EventKind::coolant: return update(coolant_, e.state);
      case EventKind::comp: return update(comp_, e.state == "off" ? "off" : "on");
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

/// The strokes of a tap: a thread, and back along it. In between and until the tool cuts again the sense of the spindle
/// follows from the path, so only the sense that stays counts: the command is moved to where it matters. The
/// orientation before the first stroke is part of the tap as well. So is a start of the spindle before it with nothing
/// but rapids in between: some taps turn the spindle by themselves, others take it as it runs.
class Taps {
 public:
  Taps(const std::vector<Event>& events, bool keep_messages) { sort(events, keep_messages); }
  std::vector<const Event*> order;

 private:
  /// Back from where `stroke_` went to, along the same line.
  bool goes_back(const Event& e) const {
    if (stroke_ == nullptr || from_ == nullptr || e.to.known != stroke_->to.known) return false;
    double dot = 0, out = 0, back = 0;
    for (std::size_t i = 0; i < e.to.value.size(); ++i) {
      if ((e.to.known >> i & 1U) == 0) continue;
      const double a = stroke_->to.value[i] - from_->to.value[i], b = e.to.value[i] - stroke_->to.value[i];
      dot += a * b;
      out += a * a;
      back += b * b;
    }
    return out > 0 && back > 0 && dot < 0 && dot * dot > out * back * (1 - 1e-9);
  }
  void flush() {
    if (held_ == nullptr && tap_) held_ = orient_;  // the spindle stands as it stood for the tap
    orient_ = nullptr;
    const bool taps = (held_ != nullptr && tap_) || between_ != nullptr;
    for (const std::size_t i : starts_) order[i] = taps ? nullptr : order[i];
    if (taps) starts_.clear();
    if (between_ != nullptr) order.insert(order.begin() + static_cast<std::ptrdiff_t>(between_at_), between_);
    if (held_ != nullptr) order.push_back(held_);
    held_ = between_ = nullptr;
  }
  void sort(const std::vector<Event>& events, bool keep_messages) {
    order.reserve(events.size());
    for (const auto& e : events) {
      if (e.kind != EventKind::message || keep_messages) one(e);
    }
    flush();
    order.erase(std::remove(order.begin(), order.end(), nullptr), order.end());
  }
  void one(const Event& e) {
    if (e.kind == EventKind::spindle && (stroke_ != nullptr || e.state == "oriented")) {
      if (stroke_ == nullptr) flush();
      held_ = &e;
      return;
    }
    if (e.kind == EventKind::spindle) {
      flush();
      starts_.push_back(order.size());
    }
    if (e.kind == EventKind::tool && e.change) {  // a spindle that still turns there is seen
      flush();
      tap_ = false;
      stroke_ = nullptr;
    }
    if (!is_barrier(e.kind)) {
      order.push_back(&e);
      return;
    }
    const bool thread = e.kind == EventKind::thread;
    if (thread && goes_back(e)) {
      tap_ = true;
      between_ = nullptr;
    } else if (thread && held_ != nullptr && tap_) {  // perhaps the next tap: what stands between them is not seen then
      between_ = std::exchange(held_, nullptr);
      between_at_ = order.size();
      tap_ = false;
    } else if (thread && held_ != nullptr && held_->state == "oriented" && (stroke_ == nullptr || tap_)) {
      orient_ = std::exchange(held_, nullptr);
      tap_ = false;
    } else if (!(e.kind == EventKind::dwell && stroke_ != nullptr) && !(e.kind == EventKind::rapid && tap_)) {
      flush();
      tap_ = false;
      stroke_ = nullptr;
      if (!thread && e.kind != EventKind::rapid) starts_.clear();
    }
    order.push_back(&e);
    if (thread) {
      from_ = last_;
      stroke_ = &e;
    }
    if (is_motion(e.kind)) last_ = &e;
  }

  const Event* last_ = nullptr;      ///< the last motion
  const Event* from_ = nullptr;      ///< the motion before the stroke
  const Event* stroke_ = nullptr;    ///< the last thread
  const Event* held_ = nullptr;      ///< a command of the spindle that waits
  const Event* orient_ = nullptr;    ///< the orientation before the first stroke
  const Event* between_ = nullptr;   ///< one that waits for the thread behind it to be run back
  std::size_t between_at_ = 0;       ///< its place in `order`
  bool tap_ = false;                 ///< the thread was run back
  std::vector<std::size_t> starts_;  ///< in `order`: the commands of the spindle before it
};

}  // namespace

std::vector<const Event*> normalise(const std::vector<Event>& events, bool keep_offsets, bool keep_selections,
                                    bool keep_messages) {
  std::vector<const Event*> out;
  out.reserve(events.size());
  StateFilter filter;
  std::size_t stretch = 0;
  std::map<std::int64_t, std::string> senses;  // of the spindles, so far
  StateFilter driven;
  const auto close_stretch = [&out, &stretch, &senses, &driven] {
    // By kind; but how the spindle turns at the change of a tool, and behind it, are two things. A speed alone is not:
    // `S1200 T2 M6` with the spindle running takes it before the change or behind it.
    std::vector<std::pair<int, const Event*>> ranked;
    const auto from = out.begin() + static_cast<std::ptrdiff_t>(stretch);
    bool changed = false;
    for (auto at = from; at != out.end(); ++at) {
      const Event& e = **at;
      changed = changed || (e.kind == EventKind::tool && e.change);
      bool behind = false;
      if (e.kind == EventKind::spindle) {
        const std::string before = std::exchange(senses[e.number], std::string(e.state));
        behind = changed && before != e.state;
      }
      ranked.emplace_back(2 * static_cast<int>(behind ? EventKind::tool : e.kind) + (behind ? 1 : 0), &e);
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::transform(ranked.begin(), ranked.end(), from, [](const auto& r) { return r.second; });
    // Of speeds, limits and senses that follow each other with nothing between only the last is ever driven.
    const auto turns = [](const Event& e) { return e.state == "cw" || e.state == "ccw"; };
    auto kept = from;
    for (auto at = from; at != out.end(); ++at) {
      const bool replaced = at + 1 != out.end() && (*at)->kind == EventKind::spindle &&
                            (*(at + 1))->kind == EventKind::spindle && (*at)->number == (*(at + 1))->number &&
                            ((*at)->state == (*(at + 1))->state || (turns(**at) && turns(**(at + 1))));
      if (!replaced && ((*at)->kind != EventKind::spindle || driven.changes(**at))) *kept++ = *at;
    }
    out.erase(kept, out.end());
  };
  const Taps taps(events, keep_messages);
  // Made ready and changed with nothing between is one command in two words.
  const auto changed_at_once = [&order = taps.order](std::size_t k) {
    for (std::size_t n = k + 1; n < order.size(); ++n) {
      if (is_barrier(order[n]->kind)) return false;
      if (order[n]->kind != EventKind::tool) continue;
      if (order[n]->number != order[k]->number) return false;
      if (order[n]->change) return true;  // chosen again before it changes nothing
    }
    return false;
  };
  // Radius compensation that ends before anything moves never began.
  const auto never_used = [&order = taps.order](std::size_t k) {
    const auto next = std::find_if(order.begin() + static_cast<std::ptrdiff_t>(k) + 1, order.end(),
                                   [](const Event* n) { return is_motion(n->kind) || n->kind == EventKind::comp; });
    return next != order.end() && (*next)->kind == EventKind::comp && (*next)->state == "off";
  };
  for (std::size_t k = 0; k < taps.order.size(); ++k) {
    const Event& e = *taps.order[k];
    if (e.kind == EventKind::feed_stop) continue;  // timing, not path: see docs/verify.md
    if (e.kind == EventKind::offset && !keep_offsets) continue;
    if (e.kind == EventKind::tool && !e.change && (!keep_selections || changed_at_once(k))) continue;
    if (e.kind == EventKind::comp && e.state != "off" && never_used(k)) continue;
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
