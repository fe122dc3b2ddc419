#include "translator/stream/stream_proof.h"

#include <optional>

#include "machine/data_at_rest.h"
#include "translator/files/readable.h"
#include "translator/option_words.h"
#include "translator/proving/explore.h"
#include "translator/stream/stream_run.h"
#include "verifier/piecewise.h"

namespace cnctrans::translator {

namespace {

class Sink : public interpreter::TraceSink {
 public:
  explicit Sink(std::vector<interpreter::Event>& events) : events_(events) {}
  void on_event(const interpreter::Event& e) override { events_.push_back(e); }

 private:
  std::vector<interpreter::Event>& events_;
};

/// The runs that go side by side: the machines as their profiles are, and put into a world.
struct Runs {
  interpreter::Options as_they_are;
  std::optional<interpreter::Options> in_world{};
};

/// One of the two texts on its way.
struct Way {
  Way(const std::string& path, const std::string& name, const Dialect& dialect, const machine::Profile& profile,
      const Runs& runs, std::vector<interpreter::Event>& events, std::vector<interpreter::Event>& in_world)
      : sink(events), other_sink(in_world), replay(path, name, dialect, profile, runs.as_they_are, sink, files) {
    if (runs.in_world) replay.also(profile, *runs.in_world, other_sink);
  }
  FileTable files;
  Sink sink, other_sink;
  StreamReplay replay;
  bool more = true;
};

struct Paths {
  const std::string &source, &written, &name;
};

verifier::PiecewiseComparison comparison_of(const StreamEnds& ends, const interpreter::Options& run) {
  const machine::World* world = run.world ? &*run.world : nullptr;
  verifier::Options how;
  verifier::compare_zeros(how, ends.source, ends.target);
  how.source_start = verifier::start_of(ends.source, world);
  how.target_start = verifier::start_of(ends.target, world);
  return verifier::PiecewiseComparison(how);
}

/// `cut`: the source does not run to its end in the world.
StreamVerdict replay_both(const Paths& paths, const StreamEnds& ends, const Runs& runs, std::uint16_t& skips,
                          bool& cut) {
  using interpreter::EndReason;
  StreamVerdict result;
  auto comparison = comparison_of(ends, runs.as_they_are);
  auto other = comparison_of(ends, runs.in_world ? *runs.in_world : runs.as_they_are);
  Way a(paths.source, paths.source, *ends.from, ends.source, runs, comparison.source, other.source);
  Way b(paths.written, paths.name, *ends.to, ends.target, runs, comparison.target, other.target);
  bool same_there = true;
  while (a.more || b.more) {
    const bool source_turn = a.more && (!b.more || comparison.source.size() <= comparison.target.size());
    Way& turn = source_turn ? a : b;
    turn.more = turn.replay.window();
    if (!turn.replay.good()) return result;
    if (!comparison.advance()) {
      result.proved = StreamProved::no;
      return result;
    }
    same_there = same_there && other.advance();
    if (!same_there) {  // perhaps the source stops there
      other.source.clear();
      other.target.clear();
    }
  }
  skips = a.replay.skips();
  interpreter::Result a_there, b_there;
  const StreamRun done_a = a.replay.finish(&a_there), done_b = b.replay.finish(&b_there);
  if (done_a.outcome != StreamOutcome::done || done_b.outcome != StreamOutcome::done) return result;
  const bool ended = done_a.result.reason == EndReason::program_end && done_b.result.reason == EndReason::program_end;
  bool same = ended && comparison.finish() && comparison.verdict().good();
  result.verdict = comparison.verdict();
  cut = a_there.reason != EndReason::program_end;
  if (runs.in_world && !cut) {
    same = same && same_there && b_there.reason == EndReason::program_end && other.finish() && other.verdict().good();
    verifier::add_distance(result.verdict, other.verdict());
  }
  result.proved = same ? StreamProved::yes : StreamProved::no;
  return result;
}

}  // namespace

StreamVerdict prove_stream(const std::string& source, const std::string& written, const TranslateOptions& options) {
  std::string error;
  auto ends = stream_ends(source, options, &error);
  if (!ends || !readable(*ends->to) || !options.run.set.empty()) return {};
  machine::forget_data_at_rest(ends->source);
  machine::forget_data_at_rest(ends->target);
  interpreter::Options run = options.run;
  if (run.max_events == kept_events) run.max_events = interpreter::Options().max_events;  // none is kept
  const auto& extensions = ends->to->mill_extensions.empty() ? ends->to->other_extensions : ends->to->mill_extensions;
  const std::string name = "translation" + (extensions.empty() ? "" : "." + std::string(extensions.front()));
  const Paths paths{source, written, name};
  std::uint16_t skips = 0;
  bool cut = false;
  Runs runs{run, run};
  runs.in_world->world = machine::world_for(ends->source, ends->target);
  runs.in_world->world->reference_points =
      ends->to->backend->capabilities_for(ends->target).motions.count(ir::MotionKind::reference_point) != 0;
  StreamVerdict first = replay_both(paths, *ends, runs, skips, cut);
  if (first.proved == StreamProved::yes && cut) {
    runs.in_world->world->stands_at_zero = true;
    first = replay_both(paths, *ends, runs, skips, cut);
    first.verdict.one_world = cut;
  }
  if (!cut) first.verdict.world = runs.in_world->world;
  const auto all = static_cast<std::uint16_t>(run.skip_mask | skips);
  if (first.proved != StreamProved::yes || !options.further.skips || all == run.skip_mask) return first;
  runs = {cut ? run : *runs.in_world, {}};
  runs.as_they_are.skip_mask = all;
  const StreamVerdict second = replay_both(paths, *ends, runs, skips, cut);
  if (second.proved != StreamProved::yes) return second;
  verifier::add_distance(first.verdict, second.verdict);
  first.verdict.coverage.also = skip_option(all, ends->from->first_skip_switch);
  return first;
}

}  // namespace cnctrans::translator
