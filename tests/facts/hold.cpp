#include "tests/facts/hold.h"

#include <cmath>
#include <set>

#include "base/text.h"
#include "ir/analysis/dataflow.h"
#include "translator/translation/reading.h"

namespace cnctrans::facts {

namespace {

constexpr std::uint64_t most_events = 4000, most_steps = 100'000, most_silent = 10'000;

class NoTrace : public interpreter::TraceSink {
 public:
  void on_event(const interpreter::Event&) override {}
};

/// Start places, feed and offsets that no program of ours writes.
machine::Profile odd(const machine::Profile& usual) {
  machine::Profile p = usual;
  double n = 1.25;
  for (auto& a : p.axes) a.start += 1000.0625 * (n += 1);
  return p;
}

bool near(double a, double b) {
  return std::fabs(a - b) <= 1e-6 * std::max({1.0, std::fabs(a), std::fabs(b)});
}

class Checker {
 public:
  Checker(const ir::Program& program, const machine::Profile& profile)
      : profile_(profile), table_(ir::analyse(program, profile.power_on)) {}

  void visit(const ir::Statement& s, const interpreter::Standing& at) {
    const ir::Facts& f = table_.before(s.id);
    where_ = &s;
    if (s.id >= table_.facts.size() || !table_.facts[s.id].reachable) {
      untrue("reachable", "never comes here", "was here");
      return;
    }
    for (std::size_t i = 0; i < ir::setting_count; ++i) {
      const auto setting = static_cast<ir::Setting>(i);
      const auto text = [&](std::uint8_t v) { return std::string(ir::setting_value_name(setting, v)); };
      one(std::string(ir::name(setting)), f.settings[i], at.modal.get(setting), text,
          [](std::uint8_t a, std::uint8_t b) { return a == b; });
    }
    const auto same = [](auto a, auto b) { return a == b; };
    const auto number = [](auto v) { return shortest(static_cast<double>(v)); };
    one(
        "motion", f.motion, at.modal.motion, [](ir::MotionKind k) { return std::string(ir::name(k)); }, same);
    one("work offset", f.work_offset, at.modal.work_offset, number, same);
    one("master", f.master, at.master, number, same);
    one("feed", f.feed, at.feed, number, near);
    if (f.master == at.master && at.modal.spindle_mode == ir::SpindleMode::rpm)
      one("spindle", f.spindle, at.spindle, number, near);
    const std::optional<bool> active = f.cycle_active_known ? std::optional(f.cycle_active) : std::nullopt;
    one("cycle", active, at.cycle_active, number, same);
    const double unit = at.modal.units == ir::Units::inch ? 25.4 : 1;
    for (const auto& a : profile_.axes) {
      const double seen = at.position[a.id] / (a.rotary ? 1 : unit);
      if (at.position_open) continue;
      one("position " + a.name, f.position[a.id], seen, number, near);
    }
  }

  void count(Shares& shares) const {
    for (const auto& [key, v] : visits_) {
      Share& share = shares[key.first];
      ++share.asked;
      if (v.known)
        ++share.known;
      else if (v.one_value)
        ++share.needless;
    }
  }
  std::vector<Untrue> found;

 private:
  struct Visits {
    bool known = false, one_value = true;
    std::string seen;
  };

  template <class T, class Text, class Same>
  void one(const std::string& domain, const std::optional<T>& said, const T& seen, const Text& text, const Same& same) {
    Visits& v = visits_[{domain, where_->id}];
    v.known = said.has_value();
    const std::string now = text(seen);
    v.one_value = v.one_value && (v.seen.empty() || v.seen == now);
    v.seen = now;
    if (said && !same(*said, seen)) untrue(domain, text(*said), now);
  }

  void untrue(const std::string& domain, const std::string& said, const std::string& seen) {
    if (!told_.insert(domain).second) return;
    found.push_back({domain, where_->line.span.line, said, seen});
  }

  const machine::Profile& profile_;
  const ir::FactTable table_;
  const ir::Statement* where_ = nullptr;
  std::map<std::pair<std::string, std::uint32_t>, Visits> visits_;
  std::set<std::string> told_;
};

}  // namespace

Held hold(const splice::Program& p, Shares* shares) {
  Held held;
  translator::Reading reading;
  translator::InputOptions input;
  input.machine = p.machine();
  std::string error;
  if (!reading.open(translator::Input(SourceText::from_string(p.file_name(), p.text())), p.dialect, input, &error))
    return held;
  Diagnostics said;
  const ir::Program& program = reading.read(said);
  if (said.has_errors()) return held;
  const machine::Profile profile = odd(reading.profile());
  Checker checker(program, profile);
  interpreter::Options run;
  run.max_events = most_events;
  run.max_steps = most_steps;
  run.max_silent_steps = most_silent;
  run.witness = [&](const ir::Statement& s, const interpreter::Standing& at) { checker.visit(s, at); };
  NoTrace sink;
  for (const std::uint16_t skip : {0, 0xffff}) {
    run.skip_mask = skip;
    Diagnostics running;
    const auto result = interpreter::run(program, profile, run, sink, running);
    if (skip == 0 && result.steps == 0) return held;
  }
  held.ran = true;
  held.untrue = std::move(checker.found);
  if (shares != nullptr) checker.count(*shares);
  return held;
}

}  // namespace cnctrans::facts
