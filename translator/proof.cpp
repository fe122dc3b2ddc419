#include "translator/proof.h"

#include <algorithm>

#include "base/text.h"
#include "ir/passes/given_data.h"
#include "machine/data_at_rest.h"
#include "translator/coverage.h"
#include "translator/explore.h"

namespace cnctrans::translator {

namespace {

using interpreter::EndReason;

constexpr std::uint64_t explored_events = 1'000'000;  ///< most of one replay with other inputs
constexpr std::uint64_t explored_silent_steps = 1'000'000;

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
  const bool stopped = verdict.status == verifier::Status::differs && (source_stopped || target_refused);
  if ((verdict.good() || stopped) && (!source_ended || !target_ended)) {
    verdict.status = verifier::Status::not_replayable;
    const auto& bad = source_ended ? target.result : source.result;
    verdict.target_stopped = source_ended && target.events.size() > 1;
    verdict.reason = std::string(source_ended ? "the translation" : "the source") + " stopped before its end (" +
                     std::string(interpreter::name(bad.reason)) +
                     (bad.error_text.empty() ? "" : ": " + bad.error_text) + ")";
  }
  return verdict;
}

/// A number may stand in brackets: PLCM12, PLCM[12].
std::string plain_name(const std::string& name) {
  std::string text = to_upper_ascii(name);
  std::erase_if(text, [](char c) { return c == '[' || c == ']'; });
  return text;
}

constexpr std::string_view tool_radius = "TOOL_RADIUS";  ///< machine datum of a run, no variable of the program

class Prover {
 public:
  Prover(const Side& source, const Side& target, const ProofOptions& options)
      : source_(source), target_(target), options_(options) {}

  Proof run() {
    Proof proof = with({options_.run.set, options_.run.skip_mask}, options_.run);
    if (options_.explore == 0 || !proof.verdict.good()) {
      proof.verdict.coverage = coverage_of(source_.program, proof.source.result.covered);
      return proof;
    }
    Explorer explorer(source_.program, {options_.run.set, options_.run.skip_mask}, [this](const std::string& name) {
      return !options_.target_settings({{name, "0"}}).empty();
    });
    explorer.note({options_.run.set, options_.run.skip_mask}, proof.source.result);
    interpreter::Options run = options_.run;
    run.max_events = std::min(run.max_events, explored_events);
    run.max_silent_steps = std::min(run.max_silent_steps, explored_silent_steps);
    for (std::size_t n = 0; n < options_.explore; ++n) {
      const auto inputs = explorer.next();
      if (!inputs) break;
      Proof other = with(*inputs, run);
      if (other.source.result.reason != EndReason::program_end) continue;
      const auto status = other.verdict.status;
      if (!other.verdict.good() && status != verifier::Status::nothing_to_compare) {
        other.verdict.inputs = described(*inputs);
        proof = std::move(other);
        break;
      }
      add(proof.verdict, other.verdict);
      explorer.note(*inputs, other.source.result);
    }
    proof.verdict.coverage = coverage_of(source_.program, explorer.covered());
    explorer.report(proof.verdict.coverage);
    return proof;
  }

 private:
  Proof with(const Inputs& inputs, interpreter::Options run) const {
    const Settings set = with_shared_data(inputs.set);
    run.set = set;
    run.skip_mask = inputs.skip_mask;
    Proof p;
    p.source = replay(source_, run);
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

  static void add(verifier::Verdict& sum, const verifier::Verdict& v) {
    if (!v.good()) return;  // moved nothing
    sum.events += v.events;
    sum.moves += v.moves;
    sum.unfed_moves += v.unfed_moves;
    sum.similar_cycles += v.similar_cycles;
    sum.max_length = std::max(sum.max_length, v.max_length);
    if (v.status == verifier::Status::within_tolerance) sum.status = v.status;
  }

  [[nodiscard]] std::string described(const Inputs& inputs) const {
    std::string text;
    for (const auto& [name, value] : inputs.set) text += (text.empty() ? "" : " ") + ("--set " + name + "=" + value);
    std::string levels;
    for (int bit = 0; bit < 16; ++bit) {
      if ((inputs.skip_mask >> bit & 1) == 0) continue;
      levels += (levels.empty() ? "" : ",") + std::to_string(bit + options_.first_skip_switch);
    }
    if (!levels.empty()) text += (text.empty() ? "" : " ") + ("--skip " + levels);
    return text;
  }

  const Side& source_;
  const Side& target_;
  const ProofOptions& options_;
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
