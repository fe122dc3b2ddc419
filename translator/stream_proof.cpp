#include "translator/stream_proof.h"

#include <algorithm>
#include <memory>

#include "machine/data_at_rest.h"
#include "translator/explore.h"
#include "translator/option_words.h"
#include "translator/readable.h"
#include "translator/stream_run.h"
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

/// One of the two texts on its way.
struct Way {
  Way(const std::string& path, const std::string& name, const Dialect& dialect, const machine::Profile& profile,
      const interpreter::Options& options, std::vector<interpreter::Event>& events)
      : sink(events), replay(path, name, dialect, profile, options, sink, files) {}
  FileTable files;
  Sink sink;
  StreamReplay replay;
  bool more = true;
};

struct Paths {
  const std::string &source, &written, &name;
};

StreamVerdict replay_both(const Paths& paths, const StreamEnds& ends, const interpreter::Options& options,
                          std::uint16_t& skips) {
  StreamVerdict result;
  verifier::Options how;
  how.source_start = verifier::start_of(ends.source);
  how.target_start = verifier::start_of(ends.target);
  verifier::PiecewiseComparison comparison(how);
  Way a(paths.source, paths.source, *ends.from, ends.source, options, comparison.source);
  Way b(paths.written, paths.name, *ends.to, ends.target, options, comparison.target);
  while (a.more || b.more) {
    const bool source_turn = a.more && (!b.more || comparison.source.size() <= comparison.target.size());
    Way& turn = source_turn ? a : b;
    turn.more = turn.replay.window();
    if (!turn.replay.good()) return result;
    if (!comparison.advance()) {
      result.proved = StreamProved::no;
      return result;
    }
  }
  skips = a.replay.skips();
  const StreamRun done_a = a.replay.finish(), done_b = b.replay.finish();
  if (done_a.outcome != StreamOutcome::done || done_b.outcome != StreamOutcome::done) return result;
  const bool ended = done_a.result.reason == interpreter::EndReason::program_end &&
                     done_b.result.reason == interpreter::EndReason::program_end;
  const bool same = ended && comparison.finish() && comparison.verdict().good();
  result.proved = same ? StreamProved::yes : StreamProved::no;
  result.verdict = comparison.verdict();
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
  StreamVerdict first = replay_both(paths, *ends, run, skips);
  const auto all = static_cast<std::uint16_t>(run.skip_mask | skips);
  if (first.proved != StreamProved::yes || !options.further.skips || all == run.skip_mask) return first;
  run.skip_mask = all;
  const StreamVerdict second = replay_both(paths, *ends, run, skips);
  if (second.proved != StreamProved::yes) return second;
  first.verdict.max_length = std::max(first.verdict.max_length, second.verdict.max_length);
  if (second.verdict.status == verifier::Status::within_tolerance) first.verdict.status = second.verdict.status;
  first.verdict.coverage.also = skip_option(all, ends->from->first_skip_switch);
  return first;
}

}  // namespace cnctrans::translator
