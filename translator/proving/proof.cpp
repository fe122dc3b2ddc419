#include "translator/proving/proof.h"

#include <algorithm>

#include "base/saturate.h"
#include "base/text.h"
#include "interpreter/trace/run_codes.h"
#include "legaliser/data/given_data.h"
#include "legaliser/data/missing_offsets.h"
#include "machine/data_at_rest.h"
#include "translator/proving/coverage.h"
#include "translator/proving/explore.h"
#include "translator/proving/said_tools.h"

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

verifier::Verdict judge(const Side& from, const Replayed& source, const Side& to, const Replayed& target,
                        const std::optional<machine::World>& world, verifier::Options options) {
  // Two runs that end in the same error at the same event are compared up to there; one alone is a difference.
  options.source_start = verifier::start_of(from.profile, world ? &*world : nullptr);
  options.target_start = verifier::start_of(to.profile, world ? &*world : nullptr);
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

bool goes_to_fixed_point(const ir::Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&found](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      found = found || (b != nullptr && b->has_motion && b->motion.kind == ir::MotionKind::fixed_point);
    });
  }
  return found;
}

/// Where the translation has taken 0 for a fixed point that the profile does not give (TRN-342), the source goes there.
machine::Profile with_fixed_points(const Side& source, const ProofOptions& options) {
  constexpr std::size_t points = 4;
  machine::Profile there = source.profile;
  if (options.target.motions.count(ir::MotionKind::fixed_point) != 0 || !goes_to_fixed_point(source.program))
    return there;
  for (auto& a : there.axes) {
    if (a.fixed_points.empty()) a.fixed_points.resize(points);
  }
  return there;
}

bool uses_inches(const Side& side) {
  bool found = side.profile.power_on.units == ir::Units::inch;
  for (const auto& r : side.program.routines) {
    ir::for_each_statement(r.body, [&found](const ir::Statement& s) {
      const auto* b = std::get_if<ir::Block>(&s.node);
      if (b == nullptr) return;
      for (const auto& a : b->actions) {
        const auto* m = std::get_if<ir::ModalSet>(&a.data);
        found = found || (m != nullptr && m->setting == ir::Setting::units &&
                          static_cast<ir::Units>(m->value) == ir::Units::inch);
      }
    });
  }
  return found;
}

class Prover {
 public:
  /// `called`: they begin in the state of their caller, its zero point included.
  Prover(const Side& source, const Side& target, const ProofOptions& options, bool called)
      : source_profile_(with_fixed_points(source, options)),
        source_{source.program, source_profile_, source.loader},
        target_(target),
        options_(options) {
    if (uses_inches(source) || uses_inches(target)) compared_.tolerances.length = verifier::length_in_inches;
    compared_.switches_length = options.target.length_comp_switch;
    compared_.stops_by_mode = options.target.exact_stop_modal;
    compared_.stops_in_block = options.target.exact_stop_block;
    compared_.offset_of_start = !options.leaves_offset_of_start;
    compared_.shows_messages = options.target.messages;
    compared_.makes_ready = source.profile.policies.tool_change == machine::ToolChange::by_command &&
                            target.profile.policies.tool_change == machine::ToolChange::by_command;
    const Settings offset = options.target_settings({{std::string(ir::passes::offset_name), "1"}});
    if (!offset.empty())
      only_offset_ = saturate<std::int32_t>(parse_decimal(offset.front().first).value_or(only_offset_));
    if (!called) verifier::compare_zeros(compared_, source.profile, target.profile);
  }

  Proof run() {
    const auto start = Clock::now();
    runs_.push_back({{options_.run.set, options_.run.skip_mask}, {}, {}});
    Proof proof = *with(runs_.front().inputs, options_.run, true);
    runs_.front().result = proof.source.result;
    runs_.front().of_target = proof.target.result.covered;
    note_first(proof);
    const auto took = Clock::now() - start;
    if (proof.verdict.good()) proof = in_world(std::move(proof));
    if (proof.verdict.good() && options_.further.skips) proof = with_skips(std::move(proof));
    const bool in_time = !options_.further.time || took < *options_.further.time;
    if (proof.verdict.good() && options_.further.explore != 0 && in_time) return explore(std::move(proof));
    proof.verdict.coverage = coverage_of(source_.program, covered_by(runs_), also_);
    note_runs(proof.verdict, explorer());
    return proof;
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// A replay that counts.
  struct Run {
    Inputs inputs;
    interpreter::Result result;   ///< of the source
    std::vector<bool> of_target;  ///< statements that the translation came to
  };
  static void join(std::vector<bool>& sum, const std::vector<bool>& more) {
    if (sum.size() < more.size()) sum.resize(more.size());
    for (std::size_t i = 0; i < more.size(); ++i) sum[i] = sum[i] || more[i];
  }

  static std::vector<bool> covered_by(const std::vector<Run>& runs) {
    std::vector<bool> covered;
    for (const auto& run : runs) join(covered, run.result.covered);
    return covered;
  }

  /// What the first replay shows beside the comparison.
  void note_first(Proof& proof) const {
    auto& v = proof.verdict;
    v.left_out = left_out_of(source_.program, proof.source.result.covered, proof.source.events);
    if (!options_.target.messages) {
      const auto& events = proof.source.events;
      v.left_out.messages = static_cast<std::size_t>(std::count_if(
          events.begin(), events.end(), [](const auto& e) { return e.kind == interpreter::EventKind::message; }));
    }
    v.read_first = proof.source.result.read_first;
    if (proof.target.result.read_first.empty()) return;
    auto held = v.read_first;  // what the source's control holds before the program
    add_zero_points(source_.program, held);
    const auto of_source = options_.target_settings(as_settings(held));
    for (const auto& name : proof.target.result.read_first) {
      const auto same = [&name](const auto& s) { return plain_name(s.first) == plain_name(name); };
      if (std::none_of(of_source.begin(), of_source.end(), same)) v.target_read_first.push_back(name);
    }
  }
  /// Variables in which the control keeps its zero points: a replay has them from its machine.
  static void add_zero_points(const ir::Program& program, std::vector<std::string>& names) {
    for (const auto& space : program.spaces) {
      for (const auto& s : space.segments) {
        for (auto n = s.lo; s.zero_points && n <= s.hi; ++n) names.push_back(space.prefix + std::to_string(n));
      }
    }
  }
  static Settings as_settings(const std::vector<std::string>& names) {
    Settings set;
    for (const auto& name : names) set.emplace_back(name, "0");
    return set;
  }

  /// Of the replays that are always made: lines of the translation, and the ways of the conditions.
  void note_runs(verifier::Verdict& v, const Explorer& explorer) const {
    std::vector<bool> covered;
    for (const auto& run : runs_) join(covered, run.of_target);
    v.target_coverage = coverage_of(target_.program, covered);
    auto& c = v.coverage;
    explorer.report(c);
    if (!c.explored) {
      c.replays = 1;
      c.ways = c.ways_taken = 0;
    }
  }
  [[nodiscard]] Explorer explorer() const {
    Explorer e(source_.program, runs_.front().inputs, [this](const std::string& name) {
      return !options_.target_settings({{name, "0"}}).empty();
    });
    for (const auto& run : runs_) e.note(run.inputs, run.result);
    return e;
  }

  /// The replay fails: neither the same moves nor none.
  static bool fails(const verifier::Verdict& v) {
    return !v.good() && v.status != verifier::Status::nothing_to_compare;
  }
  Proof failed(Proof proof, const Inputs& inputs) const {
    proof.verdict.inputs = described(inputs);
    return proof;
  }

  /// Once more where nothing coincides, with other values in the variables that are read before they are written; the
  /// replays behind it run in the same world. A source that does not run with such values, or only from its zero point
  /// (an arc in the first block), is replayed without; one that does not run there at all proves nothing there.
  Proof in_world(Proof proof) {
    auto& said = proof.verdict;
    const auto& inputs = runs_.front().inputs;
    interpreter::Options run = options_.run;
    run.world = machine::world_for(source_.profile, target_.profile);
    if (only_offset_ != 1 && source_.profile.power_on.work_offset == 0) run.world->start_row = only_offset_;
    run.world->reference_points = says_points(ir::MotionKind::reference_point) &&
                                  (says_points(ir::MotionKind::fixed_point) || !goes_to_fixed_point(source_.program));
    run.world->zeros = !proof.source.result.writes_zeros && !proof.target.result.writes_zeros;
    const Kept kept = kept_values(said, inputs.set);
    for (const bool at_zero : {false, true}) {
      run.world->stands_at_zero = at_zero;
      for (const bool with_kept : {true, false}) {
        if (with_kept && kept.empty()) continue;
        Inputs started = inputs;
        if (with_kept) started.set.insert(started.set.end(), kept.source.begin(), kept.source.end());
        target_kept_ = with_kept ? kept.target : Settings();
        auto other = with(started, with_kept ? in_short(run) : run);
        target_kept_.clear();
        if (!other || (options_.counts_on_start && !at_zero && fails(other->verdict))) continue;
        world_ = run.world;
        if (fails(other->verdict)) return elsewhere(*std::move(other), started, with_kept ? kept.target : Settings());
        verifier::add_distance(said, other->verdict);
        said.kept_values_tried = with_kept;
        said.world = world_;
        return proof;
      }
    }
    said.one_world = true;
    return proof;
  }

  [[nodiscard]] bool says_points(ir::MotionKind kind) const { return options_.target.motions.count(kind) != 0; }
  /// The one work offset of the target has the values of that of the source which it stands for.
  [[nodiscard]] Replayed replay_target(interpreter::Options run) const {
    if (only_offset_ == 1 || !run.world || !run.world->zeros) return replay(target_, run);
    machine::Profile there = target_.profile;
    for (auto& a : there.axes) {
      there.work_offsets[1][a.id] = run.world->work_offset(only_offset_, a.id);
      a.start = run.world->start(a);
    }
    run.world->zeros = false;
    return replay({target_.program, there, target_.loader}, run);
  }

  /// Values that an earlier program may have left in variables: for the source, and for those of the translation that
  /// are no variables of the source.
  struct Kept {
    Settings source, target;
    [[nodiscard]] bool empty() const { return source.empty() && target.empty(); }
  };
  [[nodiscard]] bool begins_with_parameters() const {
    const auto& all = source_.program.routines;
    return source_.program.main() == nullptr && !all.empty() && !all.front().parameters.empty();
  }
  [[nodiscard]] Kept kept_values(const verifier::Verdict& v, const Settings& given) const {
    constexpr int first = 101, step = 6;
    Kept kept;
    int value = first;
    const auto names = [](const Settings& set, const std::string& name) {
      return std::any_of(set.begin(), set.end(),
                         [&name](const auto& s) { return plain_name(s.first) == plain_name(name); });
    };
    bool all_known = true;
    for (const auto& name : v.read_first) {
      const bool known = !options_.target_settings({{name, "0"}}).empty();
      all_known = all_known && known;
      if (known && !names(given, name)) kept.source.emplace_back(name, std::to_string(value));
      value += step;
    }
    // One of the translation may be one of the source under another name: a parameter that no call has set, for one.
    if (!all_known || begins_with_parameters()) return kept;
    const Settings of_source = options_.target_settings(with_shared_data(given));
    for (const auto& name : v.target_read_first) {
      if (!names(of_source, name)) kept.target.emplace_back(name, std::to_string(value));
      value += step;
    }
    return kept;
  }

  /// The translation does otherwise there.
  Proof elsewhere(Proof proof, const Inputs& started, const Settings& of_target) const {
    std::string with = "zero points that differ";
    if (const auto more = described(started); !more.empty()) with += ", " + more;
    for (const auto& [name, value] : of_target)
      with += (&name == &of_target.front().first ? ", in the translation " : " ") + name + "=" + value;
    proof.verdict.inputs = std::move(with);
    return proof;
  }

  /// Some times the work of the first replay, no more: with other values a program may run on and on.
  [[nodiscard]] interpreter::Options in_short(interpreter::Options run) const {
    const auto& first = runs_.front().result;
    run.max_silent_steps = std::min(run.max_silent_steps, explored_silent_steps);
    run.max_events = std::min(run.max_events, std::max(short_events, short_times * first.events));
    run.max_steps = std::min(run.max_steps, std::max(short_steps, short_times * first.steps));
    return run;
  }

  /// Once more with every switch on that the program uses. A source that can't run like that proves nothing.
  Proof with_skips(Proof proof) {
    Inputs inputs = runs_.front().inputs;
    inputs.skip_mask = static_cast<std::uint16_t>(inputs.skip_mask | skip_switches(source_.program));
    if (inputs.skip_mask == options_.run.skip_mask) return proof;
    interpreter::Options run = options_.run;
    run.world = world_;
    auto other = with(inputs, run);
    if (!other) return proof;
    if (fails(other->verdict)) return failed(*std::move(other), inputs);
    if (other->verdict.good()) {
      also_ = skip_option(inputs.skip_mask, options_.first_skip_switch);
      verifier::add_distance(proof.verdict, other->verdict);
    }
    runs_.push_back({std::move(inputs), std::move(other->source.result), std::move(other->target.result.covered)});
    return proof;
  }

  Proof explore(Proof proof) {
    const auto start = Clock::now();
    const auto& further = options_.further;
    Explorer explorer = this->explorer();
    verifier::Coverage always;  // what the replays so far came to, whatever the speed of the computer
    explorer.report(always);
    interpreter::Options run = options_.run;
    run.world = world_;
    run.max_events = std::min(run.max_events, explored_events);
    run.max_silent_steps = std::min(run.max_silent_steps, explored_silent_steps);
    if (further.time) run = in_short(std::move(run));
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
      if (!further.time) runs_.push_back({*inputs, {}, std::move(other->target.result.covered)});
    }
    const auto covered = further.time ? covered_by(runs_) : explorer.covered();
    auto& coverage = proof.verdict.coverage;
    coverage = coverage_of(source_.program, covered, also_);
    coverage.explored = !further.time;
    note_runs(proof.verdict, explorer);
    if (further.time) coverage.open = std::move(always.open);
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
    run.set.insert(run.set.end(), target_kept_.begin(), target_kept_.end());
    const auto& radii = p.source.result.assumed_radii;
    const auto other = [&radii](const auto& a) { return a.second != radii.front().second; };
    if (!radii.empty() && std::none_of(radii.begin(), radii.end(), other))
      run.set.emplace_back(tool_radius, shortest(radii.front().second));
    p.target = replay_target(run);
    p.verdict = judge(source_, p.source, target_, p.target, run.world, compared_);
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
    verifier::add_distance(sum, v);
  }

  [[nodiscard]] std::string described(const Inputs& inputs) const {
    std::string text;
    for (const auto& [name, value] : inputs.set) text += (text.empty() ? "" : " ") + ("--set " + name + "=" + value);
    const std::string skips = skip_option(inputs.skip_mask, options_.first_skip_switch);
    return text.empty() || skips.empty() ? text + skips : text + " " + skips;
  }

  const machine::Profile source_profile_;
  const Side source_;
  const Side& target_;
  const ProofOptions& options_;
  verifier::Options compared_;
  std::int32_t only_offset_ = 1;         ///< the work offset of the source that the one of the target stands for
  std::vector<Run> runs_;                ///< those that are always made: as written, with the switches on
  Settings target_kept_;                 ///< values in variables of the translation alone, in the next replay
  std::optional<machine::World> world_;  ///< of all replays but the first; none: the source can't run there
  std::string also_;                     ///< inputs of the second one that agreed
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
  const bool called = !source.program.routines.empty() && source.program.main() == nullptr;
  const machine::Profile there = with_said_tools(
      source.program,
      called ? called_alike(source.profile, target.profile, !options.target.diameter_switch) : target.profile);
  return Prover(source, {target.program, there, target.loader}, options, called).run();
}

}  // namespace cnctrans::translator
