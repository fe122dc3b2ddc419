#include "translator/translation/attempt.h"

#include <set>
#include <utility>

#include "legaliser/control/copies.h"
#include "legaliser/uncalled.h"
#include "translator/translation/seen.h"

namespace cnctrans::translator {

namespace {

using ir::passes::Copies;

/// Nothing is refused but lines that the reader keeps as text.
bool only_kept_text(const Diagnostics& said) {
  const auto& all = said.all();
  return std::all_of(all.begin(), all.end(),
                     [](const Diagnostic& d) { return d.severity != Severity::error || d.code == "TRN-205"; });
}

/// What the writer can't say beside such lines: the list of errors is whole.
void add_errors_of_other_lines(const Diagnostics& written, Diagnostics& said) {
  std::set<std::pair<FileId, std::uint32_t>> lines;
  for (const auto& d : said.all()) {
    if (d.severity == Severity::error) lines.emplace(d.span.file, d.span.line);
  }
  for (const auto& d : written.all()) {
    if (d.severity == Severity::error && lines.count({d.span.file, d.span.line}) == 0) said.add(d);
  }
}

Attempt attempt(const AttemptContext& c, ir::Program work, backends::WriteOptions write, bool assume,
                const Copies& copies = {}, const ir::passes::SeenFacts* seen = nullptr) {
  Attempt out;
  const auto uncalled = assume ? ir::Uncalled::power_on : ir::Uncalled::unknown;
  const ir::LegaliseContext context{c.to.backend->capabilities_for(c.target_machine),
                                    c.source_machine,
                                    c.target_machine,
                                    {c.options.cycles, c.options.raise_structure,
                                     c.options.unsupported != backends::Unsupported::error && !c.options.draft,
                                     !c.options.annotate, uncalled, c.options.only_pass},
                                    out.said,
                                    &out.names,
                                    nullptr,
                                    c.options.names != nullptr ? &c.options.names->map : nullptr,
                                    c.options.behind_pass,
                                    seen};
  if (assume) ir::passes::tell_assumed_state(work, context);
  ir::passes::write_copies(work, copies, context);
  if (!c.as_it_stands) ir::legalise(work, context);
  const bool refused = out.said.has_errors() && c.options.unsupported == backends::Unsupported::error;
  if (c.refused || (refused && !only_kept_text(out.said))) return out;  // the writer would only say the same again
  write.profile = &c.target_machine;
  write.uncalled = uncalled;
  Diagnostics written;
  auto files = c.to.backend->write(work, write, refused ? written : out.said);
  if (refused)
    add_errors_of_other_lines(written, out.said);
  else
    out.files = std::move(files);
  return out;
}

/// Which repeated parts to write again so that nothing is refused, found by trying: the shortest part around a refused
/// line first. A copy that frees nothing is not kept.
class CopySearch {
 public:
  CopySearch(const AttemptContext& c, const ir::Program& program, const backends::WriteOptions& write, bool assume,
             const ir::passes::SeenFacts* seen = nullptr)
      : c_(c), program_(program), write_(write), assume_(assume), seen_(seen) {}

  /// `best`: as it came out without copies; it stays so where some line is refused whatever is written again.
  void mend(Attempt& best) {
    Attempt now = best;
    while (now.said.has_errors()) {
      if (!step(now)) return;
    }
    drop_needless(now);
    best = std::move(now);
  }

 private:
  using Lines = std::set<std::pair<FileId, std::uint32_t>>;
  static std::vector<Span> refused(const Attempt& a) {
    std::vector<Span> where;
    for (const auto& d : a.said.all()) {
      if (d.severity == Severity::error) where.push_back(d.span);
    }
    return where;
  }
  static Lines lines(const Attempt& a) {
    Lines found;
    for (const auto& s : refused(a)) found.emplace(s.file, s.line);
    return found;
  }

  /// One more part is written again. False: no part is left that helps.
  bool step(Attempt& now) {
    ir::Program copy = program_;
    const auto before = lines(now).size();
    const auto choices = ir::passes::copy_choices(copy, refused(now));
    for (const auto& choice : choices) {
      const auto have = chosen_.find(choice.repeat);
      for (const auto way : choice.ways) {
        if (have != chosen_.end() && have->second >= way) continue;
        if (tries_++ == most_tries) return false;
        Copies with = chosen_;
        with[choice.repeat] = way;
        if (better(std::move(with), before, way == ir::passes::Copying::each, now)) return true;
      }
    }
    return together(choices, before, now);
  }

  /// All the Repeats of the same statements at once: a state that one of them leaves is that of the next one.
  bool together(const std::vector<ir::passes::CopyChoice>& choices, std::size_t before, Attempt& now) {
    for (const auto& choice : choices) {
      if (choice.shared.empty() || choice.ways.empty() || choice.ways.back() != ir::passes::Copying::each) continue;
      Copies with = chosen_;
      with[choice.repeat] = ir::passes::Copying::each;
      for (const auto& other : choice.shared) with[other] = ir::passes::Copying::each;
      if (with == chosen_) continue;
      if (tries_++ == most_tries) return false;
      if (better(std::move(with), before, true, now)) return true;
    }
    return false;
  }

  bool better(Copies with, std::size_t before, bool equal_will_do, Attempt& now) {
    Attempt a = attempt(c_, program_, write_, assume_, with, seen_);
    const auto after = lines(a).size();
    if (after > before || (after == before && !equal_will_do)) return false;
    chosen_ = std::move(with);
    now = std::move(a);
    return true;
  }

  void drop_needless(Attempt& now) {
    const Copies all = chosen_;
    for (const auto& one : all) {
      if (chosen_.size() == 1 || tries_++ >= most_tries) return;
      Copies without = chosen_;
      without.erase(one.first);
      Attempt a = attempt(c_, program_, write_, assume_, without, seen_);
      if (a.said.has_errors()) continue;
      chosen_ = std::move(without);
      now = std::move(a);
    }
  }

  static constexpr int most_tries = 40;
  const AttemptContext& c_;
  const ir::Program& program_;
  const backends::WriteOptions& write_;
  bool assume_;
  const ir::passes::SeenFacts* seen_;
  Copies chosen_;
  int tries_ = 0;
};

/// Tries that take the program apart are for programs that a person has written.
bool is_small(const ir::Program& program) {
  constexpr std::size_t most_statements = 5000;
  std::size_t statements = 0;
  for (const auto& r : program.routines)
    ir::for_each_statement(r.body, [&statements](const ir::Statement&) { ++statements; });
  return statements <= most_statements;
}

/// What the text alone does not say, from a replay. `best` stays as it is where that frees not all.
void by_replay(const AttemptContext& c, const ir::Program& program, const backends::WriteOptions& write, bool assume,
               Attempt& best) {
  const auto seen = see(c, program);
  if (!seen) return;
  Attempt now = attempt(c, program, write, assume, {}, &seen->facts);
  if (now.said.has_errors()) CopySearch(c, program, write, assume, &seen->facts).mend(now);
  if (now.said.has_errors()) return;
  if (!seen->lines.empty()) {
    now.said.warning("TRN-711", seen->first,
                     "the translation holds for the values at line" +
                         std::string(seen->lines.find_first_of("-, ") == std::string::npos ? " " : "s ") + seen->lines +
                         ": where the text alone does not say what holds, it was taken from a replay",
                     "translate again after changing one of them");
  }
  best = std::move(now);
}

}  // namespace

Attempt attempt_both(const AttemptContext& c, ir::Program program, const backends::WriteOptions& write) {
  const auto wanted = c.source_machine.policies.call_uncalled_state;
  const bool uncalled = !c.as_it_stands && !ir::passes::uncalled_routines(program).empty();
  const bool assumed = uncalled && wanted == machine::CallUncalledState::power_on;
  const bool once =
      !(uncalled && wanted == machine::CallUncalledState::when_needed) && !ir::passes::repeats_parts(program);
  const bool small = !c.as_it_stands && c.options.unsupported == backends::Unsupported::error && is_small(program);
  if (once && !small) return attempt(c, std::move(program), write, assumed);
  Attempt first = attempt(c, program, write, assumed);
  if (!first.said.has_errors()) return first;
  bool assume = assumed;
  if (uncalled && wanted != machine::CallUncalledState::unknown && !assumed) {
    Attempt second = attempt(c, program, write, true);
    if (second.said.error_count() < first.said.error_count()) {
      first = std::move(second);
      assume = true;
    }
  }
  if (small && first.said.has_errors()) CopySearch(c, program, write, assume).mend(first);
  if (small && first.said.has_errors()) by_replay(c, program, write, assume, first);
  return first;
}

}  // namespace cnctrans::translator
