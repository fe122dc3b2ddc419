#include "translator/pipeline.h"

#include <algorithm>
#include <set>

#include "base/saturate.h"
#include "base/text.h"
#include "ir/cycles/mill_contour.h"
#include "ir/text.h"
#include "translator/attempt.h"
#include "translator/contours.h"
#include "translator/definitions.h"
#include "translator/encode.h"
#include "translator/program_axes.h"
#include "translator/proof.h"
#include "translator/readable.h"
#include "translator/stream.h"
#include "translator/written.h"

namespace cnctrans::translator {

namespace {

/// Names of routines that statements of `program` call by a fixed name.
void collect_calls(const ir::Program& program, std::vector<ir::RoutineName>& out) {
  for (const auto& routine : program.routines) {
    ir::for_each_statement(routine.body, [&out](const ir::Statement& s) {
      if (const auto* c = std::get_if<ir::CallRoutine>(&s.node)) {
        if (!c->computed) out.push_back(c->routine);
      } else if (const auto* m = std::get_if<ir::ModalCall>(&s.node)) {
        if (!m->off && !m->cycle && !m->call.computed) out.push_back(m->call.routine);
      } else if (const auto* r = std::get_if<ir::Repeat>(&s.node)) {
        if (r->has_program) out.push_back(r->program);
      } else if (const auto* b = std::get_if<ir::Block>(&s.node)) {
        for (const auto& a : b->actions) {
          const auto* d = std::get_if<ir::CycleDefine>(&a.data);
          if (d == nullptr || !d->cycle) continue;
          for (auto& profile : ir::cycles::contour_routines(*d->cycle)) out.push_back(std::move(profile));
        }
      }
    });
  }
}

/// Variable references of a library program point into its own spaces; the frontends give every program of a dialect
/// the same standard spaces first, so only the tail of named spaces can differ.
bool same_spaces(const ir::Program& a, const ir::Program& b) {
  if (a.spaces.size() != b.spaces.size()) return false;
  for (std::size_t i = 0; i < a.spaces.size(); ++i) {
    if (a.spaces[i].prefix != b.spaces[i].prefix) return false;
  }
  return true;
}

/// Takes the routines of every library file that is reached into `program`, so that they are translated with it.
void join_libraries(ir::Program& program, Loader& loader, Diagnostics& diagnostics) {
  std::vector<ir::RoutineName> wanted;
  collect_calls(program, wanted);
  std::set<const ir::Program*> joined;
  while (!wanted.empty()) {
    const ir::RoutineName name = wanted.back();
    wanted.pop_back();
    if (program.find(name) != nullptr) continue;
    const ir::Program* found = loader.find(name);
    if (found == nullptr || !joined.insert(found).second) continue;
    if (!same_spaces(program, *found)) {
      const Span where = found->routines.empty() ? Span{} : found->routines.front().header.span;
      diagnostics.error("TRN-090", where,
                        "the called program names other axes or variable spaces than the main program");
      continue;
    }
    collect_calls(*found, wanted);
    for (auto routine : found->routines) {
      if (routine.kind == ir::RoutineKind::main) routine.kind = ir::RoutineKind::sub;
      program.routines.push_back(std::move(routine));
    }
    program.files.insert(program.files.end(), found->files.begin(), found->files.end());
    program.texts->share(found->texts);
  }
  ir::number_statements(program);
}

/// Two outputs of one name would overwrite each other. Case does not count: neither on the controls nor on many disks.
bool names_differ(const std::vector<OutputText>& outputs, Diagnostics& diagnostics) {
  std::set<std::string> seen;
  bool good = true;
  for (const auto& out : outputs) {
    if (seen.insert(to_upper_ascii(out.name)).second) continue;
    diagnostics.error("TRN-093", Span{}, "two parts of the translation would have the same name: " + out.name,
                      "give one of the programs another name or number");
    good = false;
  }
  return good;
}

/// A name that two routines of the translation share; empty: none. Only one of them could be reached.
std::string shared_name(const ir::Program& program) {
  for (const auto& r : program.routines) {
    const auto* found = r.kind == ir::RoutineKind::sub && !r.name.empty() ? program.find(r.name) : &r;
    if (found == nullptr || found == &r) continue;
    return r.name.text.empty() ? std::to_string(r.name.number) : r.name.text;
  }
  return {};
}

void verify_outputs(TranslateResult& result, const Dialect& from, const ir::Program& source,
                    const machine::Profile& source_profile, Loader& loader, const Dialect& to,
                    const machine::Profile& target_profile, const TranslateOptions& options,
                    const ir::LegaliseReport& names) {
  result.verified = true;
  if (!readable(to)) {
    result.verdict.status = verifier::Status::not_replayable;
    result.verdict.reason = std::string(to.title) + ": nothing here reads the translation back";
    return;
  }
  Diagnostics target_diagnostics;
  Loader target_loader(to, target_profile, frontends::Reader::scanner, {});
  const bool same_names = source.dialect == to.name;
  if (same_names) target_loader.use_definitions(loader);
  ir::Program target;
  bool first = true;
  for (const auto& out : result.outputs) {
    const auto text = SourceText::from_string(out.name, out.bytes);
    const ir::Program* read = target_loader.read_source(text, target_diagnostics);
    if (first) {
      target = *read;
      first = false;
      continue;
    }
    for (auto routine : read->routines) {
      if (routine.kind == ir::RoutineKind::main) routine.kind = ir::RoutineKind::sub;
      target.routines.push_back(std::move(routine));
    }
    target.texts->share(read->texts);
  }
  if (same_names) {
    Diagnostics said_already;
    declare_names(target, target_loader.definitions(), false, said_already);
  }
  ir::number_statements(target);
  const auto target_settings = [&](const Settings& set) { return same_names ? set : renamed_settings(set, names); };
  Proof proof = prove({source, source_profile, loader}, {target, target_profile, target_loader},
                      {options.run, target_settings, options.explore, from.first_skip_switch});
  result.verdict = std::move(proof.verdict);
  if (const auto twice = shared_name(target); !twice.empty()) {
    result.verdict.status = verifier::Status::not_replayable;
    result.verdict.reason = "two programs of the translation have the same name: " + twice;
  }
  result.target_files = target_loader.files();
  if (options.keep_traces) {
    result.source_trace = std::move(proof.source.events);
    result.target_trace = std::move(proof.target.events);
  }
  if (!result.verdict.good()) {
    for (const auto& d : proof.source.diagnostics.all()) {
      const auto& said = result.diagnostics.all();
      if (std::find(said.begin(), said.end(), d) == said.end()) result.diagnostics.add(d);
    }
    target_diagnostics.append(proof.target.diagnostics);
    if (target_diagnostics.has_errors()) {
      result.verdict.reason += "\n" + render_text(target_diagnostics, result.target_files);
    }
  }
}

/// A program that simply ends with its text gets the end word.
void end_main(ir::Program& program, Diagnostics& diagnostics) {
  for (auto& r : program.routines) {
    if (r.kind != ir::RoutineKind::main) continue;
    const auto only_text = [](const ir::Statement& s) {
      const auto* block = std::get_if<ir::Block>(&s.node);
      return block != nullptr && block->empty() && s.line.number.empty();
    };
    const auto it = std::find_if_not(r.body.rbegin(), r.body.rend(), only_text);
    const ir::Statement* last = it == r.body.rend() ? nullptr : &*it;
    const auto* jump = last != nullptr ? std::get_if<ir::Jump>(&last->node) : nullptr;
    if (last == nullptr || std::holds_alternative<ir::End>(last->node) ||
        std::holds_alternative<ir::Return>(last->node) || (jump != nullptr && !jump->condition)) {
      return;
    }
    ir::Statement end;
    end.line.span = last->line.span;
    end.node = ir::End{};
    diagnostics.note("TRN-092", last->line.span, "the program ends without an end word; one is written");
    r.body.push_back(std::move(end));
    ir::number_statements(program);
    return;
  }
}

/// The name that the map gives the main program. Those of other programs are taken.
void name_program(const ir::NameMap& names, ir::Program& program, backends::WriteOptions& write) {
  for (const auto& [stem, name] : names.programs) {
    if (stem != write.main_stem) write.taken.insert(to_upper_ascii(name));
  }
  for (const auto& [from, name] : names.routines) write.taken.insert('%' + name);
  const auto given = names.programs.find(write.main_stem);
  if (given == names.programs.end()) return;
  const std::string& name = given->second;
  if (name.front() != '%') {
    write.main_stem = name.substr(0, name.rfind('.'));
    return;
  }
  const auto number = parse_decimal(std::string_view(name).substr(1));
  for (auto& r : program.routines) {
    if (r.kind == ir::RoutineKind::main && number) r.name = {saturate<std::int64_t>(*number), {}};
  }
}

/// Errors of reading may be written over only when the user asked for it.
bool refused(const Diagnostics& d, const TranslateOptions& options) {
  return d.has_errors() && options.unsupported == backends::Unsupported::error;
}

}  // namespace

TranslateResult translate(const std::string& path, const TranslateOptions& options) {
  TranslateResult result;
  const Dialect* from = find_readable(options.from, &result.error);
  if (from == nullptr) return result;
  const Dialect* to = find_dialect(options.to);
  if (to == nullptr) {
    result.error = unknown_dialect(options.to);
    return result;
  }
  const SourcePtr source = SourceText::open(path, &result.error);
  if (!source) return result;
  const auto source_profile = choose_profile(*from, options.machine, source.get(), &result.error);
  if (!source_profile) return result;
  const std::string target_name =
      !options.target_machine.empty()
          ? options.target_machine
          : std::string(to->name) + (source_profile->kind == machine::Kind::lathe ? "-lathe" : "-mill");
  auto target_profile = machine::load(target_name, &result.error);
  if (!target_profile) return result;
  if (options.target_machine.empty()) add_axes(*target_profile, added_axes(*source_profile));
  result.source_machine = source_profile->name;
  result.target_machine = target_profile->name;
  result.lathe = source_profile->kind == machine::Kind::lathe;

  Loader loader(*from, *source_profile, options.reader, options.libraries);
  frontends::ReadStats stats;
  const ir::Program* program = loader.read_main(source, result.diagnostics, &stats);
  result.lines = stats.lines;

  ir::Program source_program = *program;
  Diagnostics library_notes;
  join_libraries(source_program, loader, result.diagnostics);
  result.diagnostics.append(loader.library_diagnostics());
  interpreter::Options checks = options.run;
  ir::Program outside;  // stands for a subprogram that only the map of names knows
  outside.routines.emplace_back().kind = ir::RoutineKind::sub;
  checks.library = [&](const ir::RoutineName& name) {
    const ir::Program* found = loader.find(name);
    const bool named = found == nullptr && options.names != nullptr && options.names->given(name) != nullptr;
    return named ? &outside : found;
  };
  if (from == to) {
    // Into its own language a program keeps what can't be run here: only a run would stop there.
    Diagnostics found;
    interpreter::check_program(source_program, checks, found);
    for (Diagnostic d : found.all()) {
      if (d.severity == Severity::error) d.severity = Severity::warning;
      result.diagnostics.add(std::move(d));
    }
  } else {
    interpreter::check_program(source_program, checks, result.diagnostics);
  }
  result.files = loader.files();

  ir::Program work;
  if (from == to) work = source_program;  // in its own language the names are the machine's
  declare_names(source_program, loader.definitions(), false, result.diagnostics);
  if (from != to) {
    work = source_program;
    // The main program comes first, wherever its archive has it.
    std::stable_partition(work.routines.begin(), work.routines.end(),
                          [](const ir::Routine& r) { return r.kind == ir::RoutineKind::main; });
  }
  // In its own language for its own machine a program is legal as it stands.
  const std::string& source_name = options.machine.empty() ? source_profile->name : options.machine;
  const std::string& named_target = options.target_machine.empty() ? target_profile->name : options.target_machine;
  const bool as_it_stands = from == to && source_name == named_target && options.cycles != ir::CycleWriting::explode &&
                            !options.raise_structure;
  if (!as_it_stands) end_main(work, result.diagnostics);
  if (from != to) read_contours(work, *source_profile);
  backends::WriteOptions write;
  write.profile = &*target_profile;
  write.unsupported = options.unsupported;
  write.numbering = options.numbering;
  write.number_step = options.number_step;
  write.annotate = options.annotate;
  write.single_output = options.single_output;
  write.files_apart = options.files_apart;
  write.main_stem = source->stem();
  write.taken = options.taken;
  if (options.names != nullptr) name_program(*options.names, work, write);
  Attempt written =
      attempt_both({*to, *source_profile, *target_profile, options, as_it_stands, refused(result.diagnostics, options)},
                   std::move(work), write);
  result.diagnostics.append(written.said);
  auto& files = written.files;
  const ir::LegaliseReport& names = written.names;
  result.files = loader.files();
  if (refused(result.diagnostics, options)) {
    result.refused = true;
    return result;
  }
  result.names = names.names;
  for (auto& f : files) {
    if (f.main) result.names.programs[source->stem()] = f.program.empty() ? f.name : f.program;
    OutputText out{f.name, f.program, {}, std::move(f.map), f.main};
    out.bytes =
        encode_output(f.text, options.encoding.value_or(source->encoding()), options.eol.value_or(source->main_eol()),
                      source->has_bom() && !options.encoding, result.diagnostics);
    result.outputs.push_back(std::move(out));
  }
  if (from != to && result.diagnostics.error_count() == 0) check_written(result, *to, *target_profile);
  if ((!names_differ(result.outputs, result.diagnostics) || result.diagnostics.has_errors()) &&
      refused(result.diagnostics, options)) {
    result.refused = true;
    result.outputs.clear();
    return result;
  }
  std::stable_partition(result.outputs.begin(), result.outputs.end(), [](const OutputText& o) { return o.main; });
  if (!result.refused) result.diagnostics = as_warnings(result.diagnostics);  // written all the same, as asked
  if (options.verify)
    verify_outputs(result, *from, source_program, *source_profile, loader, *to, *target_profile, options, names);
  return result;
}

VerifyResult verify(const std::string& source, const std::vector<std::string>& targets,
                    const TranslateOptions& options) {
  VerifyResult result;
  const Dialect* from = find_readable(options.from, &result.error);
  const Dialect* to = from == nullptr ? nullptr : find_readable(options.to, &result.error);
  if (to == nullptr) return result;
  /// A file that was read, for a replay.
  struct Opened {
    std::optional<machine::Profile> profile;
    std::optional<Loader> loader;
    const ir::Program* program = nullptr;
    Diagnostics reading;
  };
  const auto open = [&options, &result](Opened& o, const Dialect& dialect, const std::string& machine,
                                        const std::string& path) {
    const SourcePtr text = SourceText::open(path, &result.error);
    if (!text) return false;
    o.profile = choose_profile(dialect, machine, text.get(), &result.error);
    if (!o.profile) return false;
    o.loader.emplace(dialect, *o.profile, options.reader, options.libraries);
    o.program = o.loader->read_main(text, o.reading);
    return true;
  };
  const auto close = [](Opened& o, const Replayed& run, Diagnostics& diagnostics, FileTable& files) {
    diagnostics = std::move(o.reading);
    diagnostics.append(o.loader->library_diagnostics());
    if (run.result.reason != interpreter::EndReason::error) diagnostics = as_warnings(diagnostics);
    diagnostics.append(run.diagnostics);
    files = o.loader->files();
  };
  Opened a, b;
  if (!open(a, *from, options.machine, source) || !open(b, *to, options.target_machine, targets.front())) return result;
  // The names that a translation by anyone gives to the variables are not known.
  const auto target_settings = [&](const Settings& set) { return from == to ? set : Settings(); };
  Proof proof = prove({*a.program, *a.profile, *a.loader}, {*b.program, *b.profile, *b.loader},
                      {options.run, target_settings, options.explore, from->first_skip_switch});
  result.verdict = std::move(proof.verdict);
  close(a, proof.source, result.source_diagnostics, result.source_files);
  close(b, proof.target, result.target_diagnostics, result.target_files);
  return result;
}

namespace {

/// Names of the extra axes: those of the program, else those of the machine.
std::vector<std::string> names_of_axes(const ir::Program& program, const machine::Profile& profile) {
  std::vector<std::string> names = program.axis_names;
  for (const auto& a : profile.axes) {
    if (a.id < ir::axis::first_extra) continue;
    const auto at = static_cast<std::size_t>(a.id - ir::axis::first_extra);
    if (names.size() <= at) names.resize(at + 1);
    if (names[at].empty()) names[at] = a.name;
  }
  return names;
}

}  // namespace

RunResult run(
    const std::string& path, const RunOptions& options,
    const std::function<std::unique_ptr<interpreter::TraceSink>(const FileTable&, const std::vector<std::string>&)>&
        make_sink) {
  RunResult result;
  const Dialect* dialect = find_readable(options.dialect, &result.error);
  if (dialect == nullptr) return result;
  const SourcePtr source = SourceText::open(path, &result.error);
  if (!source) return result;
  const auto profile = choose_profile(*dialect, options.machine, source.get(), &result.error);
  if (!profile) return result;
  if (options.may_stream && added_axes(*profile).empty() && options.run.set.empty() && can_reopen(path)) {
    FileTable files;
    const auto counter = make_sink(files, {});
    StreamRun streamed = run_stream(path, *dialect, *profile, options, *counter, files);
    if (streamed.outcome == StreamOutcome::done) {
      result.result = std::move(streamed.result);
      result.diagnostics = std::move(streamed.diagnostics);
      result.files.add(source);  // the stream kept the name only: the diagnostics show their lines
      return result;
    }
  }
  Loader loader(*dialect, *profile, options.reader, options.libraries);
  Diagnostics running;
  const ir::Program* program = loader.read_main(source, result.diagnostics);
  ir::Program defining;
  if (const auto& definitions = loader.definitions(); !definitions.empty()) {
    defining = *program;
    std::vector<ir::RoutineName> called;
    collect_calls(defining, called);
    declare_names(defining, definitions, !called.empty(), result.diagnostics);
    program = &defining;
  }
  result.axis_names = names_of_axes(*program, *profile);
  const auto sink = make_sink(loader.files(), result.axis_names);
  interpreter::Options run_options = options.run;
  run_options.library = [&loader](const ir::RoutineName& name) { return loader.find(name); };
  run_options.fault = [&loader](FileId f, std::uint32_t from, std::uint32_t to) { return loader.fault(f, from, to); };
  result.result = interpreter::run(*program, *profile, run_options, *sink, running);
  result.diagnostics.append(loader.library_diagnostics());
  // A line that the run has not come to spoils nothing.
  if (result.result.reason != interpreter::EndReason::error) result.diagnostics = as_warnings(result.diagnostics);
  result.diagnostics.append(running);
  result.files = loader.files();
  return result;
}

RewriteResult rewrite(const SourcePtr& source, const std::string& dialect_name, const std::string& machine) {
  RewriteResult result;
  const Dialect* dialect = find_readable(dialect_name, &result.error);
  if (dialect == nullptr) return result;
  const auto profile = choose_profile(*dialect, machine, source.get(), &result.error);
  if (!profile) return result;
  Loader loader(*dialect, *profile, frontends::Reader::scanner, {});
  const ir::Program* program = loader.read_source(source, result.diagnostics);
  result.program = *program;
  backends::WriteOptions write;
  write.profile = &*profile;
  write.main_stem = source->stem();
  write.single_output = true;
  result.files = dialect->backend->write(result.program, write, result.diagnostics);
  return result;
}

CheckResult check(const std::string& path, const RunOptions& options) {
  CheckResult result;
  const Dialect* dialect = find_readable(options.dialect, &result.error);
  if (dialect == nullptr) return result;
  const SourcePtr source = SourceText::open(path, &result.error);
  if (!source) return result;
  const auto profile = choose_profile(*dialect, options.machine, source.get(), &result.error);
  if (!profile) return result;
  Loader loader(*dialect, *profile, options.reader, options.libraries);
  const ir::Program* program = loader.read_main(source, result.diagnostics, &result.stats);
  ir::check_well_formed(*program, result.diagnostics);
  result.files = loader.files();
  return result;
}

}  // namespace cnctrans::translator
