#include "translator/proof.h"

#include <algorithm>

#include "base/text.h"
#include "interpreter/run_codes.h"
#include "ir/passes/given_data.h"
#include "machine/data_at_rest.h"
#include "translator/coverage.h"
#include "translator/explore.h"

namespace cnctrans::translator {

namespace {

using interpreter::EndReason;

constexpr std::uint64_t explored_events = 1'000'000;  ///< most of one replay with other inputs
constexpr std::uint64_t explored_silent_steps = 1'000'000;
/// Where the time is short: so many times the work of the first replay, and this much in any case.
constexpr std::uint64_t short_times = 4, short_events = 20'000, short_steps = 100'000;

Replayed replay(const Side& side, interpreter::Options options) {
  Replayed r;
  options.library = [&side](const ir::RoutineName& name) { return side.loader.find(name); };
  options.fault = [&side](FileId f, std::uint32_t from, std::uint32_t to) { return side.loader.fault(f, from, to); };
  options.read_written = [&side](const std::string& name, const std::string& text, std::string& why) {
    return side.loader.read_written(name, text, why);
  };
  interpreter::TraceRecorder recorder;
  options.cycles = &r.cycles;
  machine::Profile profile = side.profile;
  std::erase_if(options.set, [&profile](const auto& s) {  // data that are given are no longer assumed
    const auto value = parse_decimal(s.second);
    if (!value || !machine::data_at_rest(profile, s.first)) return false;
    profile.data[s.first] = *value;
    return true;
  });
  machine::forget_data_at_rest(profile);
  r.result = interpreter::run(side.program, profile, options, recorder, r.diagnostics);
  r.events = std::move(recorder.events);
  return r;
}

verifier::Verdict judge(const Side& from, const Replayed& source, const Side& to, const Replayed& target) {
  // Two runs that end in the same error at the same event are compared up to there; one alone is a difference.
  verifier::Options options;
  options.source_start = verifier::start_of(from.profile);
  options.target_start = verifier::start_of(to.profile);
  options.source_cycles = &source.cycles;
  options.target_cycles = &target.cycles;
  verifier::Verdict verdict = verifier::compare(source.events, target.events, options);
  const bool source_ended = source.result.reason == EndReason::program_end;
  const bool target_ended = target.result.reason == EndReason::program_end;
  // Where a run stopped is no difference of the programs: there is nothing to compare with from there on.
  const auto stops_at = [](const Replayed& run, FileId file, std::uint32_t line) {
    if (run.events.size() < 2) return true;
    return run.events.back().file == file && run.events.back().line == line;
  };
  const auto& d = verdict.difference;
  const auto& radii = source.result.assumed_radii;
  if (!radii.empty()) verdict.assumed_radius = radii.front().second;
  const bool by_radius = std::any_of(radii.begin(), radii.end(), [&](const auto& a) {
    return a.first.file == d.source_file && a.first.line == d.source_line;
  });
  if (verdict.status == verifier::Status::differs && by_radius) {  // a tool of another radius may leave the same part
    verdict.status = verifier::Status::not_replayable;
    verdict.reason =
        "nobody gives the radius of the tool, and with " + shortest(radii.front().second) + " mm " + d.what;
    return verdict;
  }
  const bool source_stopped = !source_ended && stops_at(source, d.source_file, d.source_line);
  const bool target_refused = !target_ended && target.events.size() < 2;
  // A datum of the machine that nobody gives, under the target's name.
  const bool lacks_datum = source_ended && target.result.error_code == interpreter::code::no_datum &&
                           stops_at(target, d.target_file, d.target_line);
  const bool stopped = verdict.status == verifier::Status::differs && (source_stopped || target_refused || lacks_datum);
  if ((verdict.good() || stopped) && (!source_ended || !target_ended)) {
    verdict.status = verifier::Status::not_replayable;
    const auto& bad = source_ended ? target.result : source.result;
    verdict.target_stopped = source_ended && target.events.size() > 1 && !lacks_datum;
    verdict.reason = std::string(source_ended ? "the translation" : "the source") + " stopped before its end (" +
                     std::string(interpreter::name(bad.reason)) +
                     (bad.error_text.empty() ? "" : ": " + bad.error_text) + ")";
  }
  return verdict;
}

constexpr std::string_view tool_radius = "TOOL_RADIUS";  ///< machine datum of a run, no variable of the program

class Prover {
 public:
  Prover(const Side& source, const Side& target, const ProofOptions& options)
      : source_(source), target_(target), options_(options) {}

  Proof run() {
    const auto start = Clock::now();
    runs_.push_back({{options_.run.set, options_.run.skip_mask}, {}});
    Proof proof = *with(runs_.front().inputs, options_.run, true);
    runs_.front().result = proof.source.result;
    const auto took = Clock::now() - start;
    if (proof.verdict.good() && options_.further.skips) proof = with_skips(std::move(proof));
    const bool in_time = !options_.further.time || took < *options_.further.time;
    if (proof.verdict.good() && options_.further.explore != 0 && in_time) return explore(std::move(proof));
    proof.verdict.coverage = coverage_of(source_.program, covered_by(runs_), std::move(also_));
    return proof;
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// A replay that counts.
  struct Run {
    Inputs inputs;
    interpreter::Result result;  ///< of the source
  };

  static std::vector<bool> covered_by(const std::vector<Run>& runs) {
    std::vector<bool> covered;
    for (const auto& run : runs) {
      if (covered.size() < run.result.covered.size()) covered.resize(run.result.covered.size());
      for (std::size_t i = 0; i < run.result.covered.size(); ++i) covered[i] = covered[i] || run.result.covered[i];
    }
    return covered;
  }

  /// The replay fails: neither the same moves nor none.
  static bool fails(const verifier::Verdict& v) {
    return !v.good() && v.status != verifier::Status::nothing_to_compare;
  }
  Proof failed(Proof proof, const Inputs& inputs) const {
    proof.verdict.inputs = described(inputs);
    return proof;
  }

  /// Once more with every switch on that the program uses. A source that can't run like that proves nothing.
  Proof with_skips(Proof proof) {
    Inputs inputs = runs_.front().inputs;
    inputs.skip_mask = static_cast<std::uint16_t>(inputs.skip_mask | skip_switches(source_.program));
    if (inputs.skip_mask == options_.run.skip_mask) return proof;
    auto other = with(inputs, options_.run);
    if (!other) return proof;
    if (fails(other->verdict)) return failed(*std::move(other), inputs);
    if (other->verdict.good()) {
      also_ = skip_option(inputs.skip_mask, options_.first_skip_switch);
      add_distance(proof.verdict, other->verdict);
    }
    runs_.push_back({std::move(inputs), std::move(other->source.result)});
    return proof;
  }

  Proof explore(Proof proof) const {
    const auto start = Clock::now();
    const auto& further = options_.further;
    Explorer explorer(source_.program, runs_.front().inputs, [this](const std::string& name) {
      return !options_.target_settings({{name, "0"}}).empty();
    });
    for (const auto& run : runs_) explorer.note(run.inputs, run.result);
    interpreter::Options run = options_.run;
    run.max_events = std::min(run.max_events, explored_events);
    run.max_silent_steps = std::min(run.max_silent_steps, explored_silent_steps);
    if (further.time) {
      const auto& first = runs_.front().result;
      run.max_events = std::min(run.max_events, std::max(short_events, short_times * first.events));
      run.max_steps = std::min(run.max_steps, std::max(short_steps, short_times * first.steps));
    }
    for (std::size_t n = 0; n < further.explore; ++n) {
      if (further.time && Clock::now() - start > *further.time) break;
      const auto inputs = explorer.next();
      if (!inputs) break;
      auto other = with(*inputs, run);
      if (!other) continue;
      const verifier::Verdict& v = other->verdict;
      if (further.time ? v.differs() : fails(v)) {
        proof = failed(*std::move(other), *inputs);
        break;
      }
      if (!further.time) add(proof.verdict, v);
      explorer.note(*inputs, other->source.result);
    }
    const auto covered = further.time ? covered_by(runs_) : explorer.covered();
    proof.verdict.coverage = coverage_of(source_.program, covered, also_);
    if (!further.time) explorer.report(proof.verdict.coverage);
    return proof;
  }

  /// nullopt: the source does not run to its end with these inputs, and `anyway` does not ask what comes of it.
  std::optional<Proof> with(const Inputs& inputs, interpreter::Options run, bool anyway = false) const {
    const Settings set = with_shared_data(inputs.set);
    run.set = set;
    run.skip_mask = inputs.skip_mask;
    Proof p;
    p.source = replay(source_, run);
    if (!anyway && p.source.result.reason != EndReason::program_end) return std::nullopt;
    run.set = options_.target_settings(set);
    for (const auto& [name, value] : inputs.set) {  // a tool belongs to both machines
      const auto same = [&n = name](const auto& s) { return s.first == n; };
      if (name == tool_radius && std::none_of(run.set.begin(), run.set.end(), same)) run.set.emplace_back(name, value);
    }
    const auto& radii = p.source.result.assumed_radii;
    const auto other = [&radii](const auto& a) { return a.second != radii.front().second; };
    if (!radii.empty() && std::none_of(radii.begin(), radii.end(), other))
      run.set.emplace_back(tool_radius, shortest(radii.front().second));
    p.target = replay(target_, run);
    p.verdict = judge(source_, p.source, target_, p.target);
    return p;
  }

  /// What nobody has given is as on a machine at rest, on both sides.
  [[nodiscard]] Settings with_shared_data(Settings set) const {
    for (const auto& name : options_.shared_data) {
      const auto given = [&name](const auto& s) { return plain_name(s.first) == plain_name(name); };
      if (std::any_of(set.begin(), set.end(), given)) continue;
      if (const auto value = machine::value_of_data(source_.profile, name)) set.emplace_back(name, shortest(*value));
    }
    return set;
  }

  static void add_distance(verifier::Verdict& sum, const verifier::Verdict& v) {
    sum.max_length = std::max(sum.max_length, v.max_length);
    if (v.status == verifier::Status::within_tolerance) sum.status = v.status;
  }
  static void add(verifier::Verdict& sum, const verifier::Verdict& v) {
    if (!v.good()) return;  // moved nothing
    sum.events += v.events;
    sum.moves += v.moves;
    sum.unfed_moves += v.unfed_moves;
    sum.similar_cycles += v.similar_cycles;
    add_distance(sum, v);
  }

  [[nodiscard]] std::string described(const Inputs& inputs) const {
    std::string text;
    for (const auto& [name, value] : inputs.set) text += (text.empty() ? "" : " ") + ("--set " + name + "=" + value);
    const std::string skips = skip_option(inputs.skip_mask, options_.first_skip_switch);
    return text.empty() || skips.empty() ? text + skips : text + " " + skips;
  }

  const Side& source_;
  const Side& target_;
  const ProofOptions& options_;
  std::vector<Run> runs_;  ///< those that are always made: as written, with the switches on
  std::string also_;       ///< inputs of the second one that agreed
};

}  // namespace

Settings renamed_settings(const Settings& set, const ir::LegaliseReport& names) {
  Settings out;
  for (const auto& [name, value] : set) {
    for (const auto& r : names.renamed) {
      if (r.kind == ir::Renamed::Kind::variable && (r.routine.empty() || r.routine == ir::passes::given_data_mark) &&
          plain_name(r.from) == plain_name(name))
        out.emplace_back(r.to, value);
    }
  }
  return out;
}

/// A subprogram by itself begins in the state of its caller: that of power-on of the source's machine (TRN-460), on
/// both sides.
static machine::Profile called_alike(const machine::Profile& source, machine::Profile target, bool fixed_diameter) {
  const ir::ModalState own = target.power_on;
  target.power_on = source.power_on;
  target.power_on.work_offset = own.work_offset;
  if (fixed_diameter) target.power_on.diameter = own.diameter;
  target.power_on_feed = source.power_on_feed;
  return target;
}

Proof prove(const Side& source, const Side& target, const ProofOptions& options) {
  if (!source.program.routines.empty() && source.program.main() == nullptr) {
    const machine::Profile called = called_alike(source.profile, target.profile, options.target_fixed_diameter);
    return Prover(source, {target.program, called, target.loader}, options).run();
  }
  return Prover(source, target, options).run();
}

}  // namespace cnctrans::translator
