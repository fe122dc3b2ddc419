// One program, in memory, with what it calls: read, joined, legalised, written, read back, proved.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/saturate.h"
#include "base/text.h"
#include "interpreter/trace/run_codes.h"
#include "ir/analysis/cycle_ends.h"
#include "ir/analysis/dataflow.h"
#include "legaliser/data/given_data.h"
#include "legaliser/names/number_programs.h"
#include "translator/files/called.h"
#include "translator/files/contours.h"
#include "translator/files/definitions.h"
#include "translator/files/given_names.h"
#include "translator/files/readable.h"
#include "translator/folding/fit.h"
#include "translator/output/encode.h"
#include "translator/output/origin.h"
#include "translator/pipeline.h"
#include "translator/proving/proof.h"
#include "translator/translation/attempt.h"
#include "translator/translation/draft.h"
#include "translator/translation/machine_errors.h"
#include "translator/translation/machine_settings.h"
#include "translator/translation/outside_calls.h"
#include "translator/translation/reading.h"
#include "translator/translation/written.h"

namespace cnctrans::translator {

namespace {

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

/// The program can come to the end of its text. A range behind its end that a repeat runs goes back to there.
bool runs_to_its_end(const ir::Program& program, const ir::Routine& routine) {
  const ir::ControlFlow flow = ir::control_flow(program, routine);
  std::vector<bool> seen(flow.successors.size());
  std::vector<std::uint32_t> open{routine.body.front().id};
  while (!open.empty()) {
    const std::uint32_t id = open.back();
    open.pop_back();
    if (seen[id]) continue;
    seen[id] = true;
    const bool ends = std::holds_alternative<ir::End>(flow.statements[id]->node) ||
                      std::holds_alternative<ir::Return>(flow.statements[id]->node);
    for (const auto next : flow.successors[id]) {
      if (next == 0 && !ends) return true;
      if (next != 0) open.push_back(next);
    }
  }
  return false;
}

/// A program that simply ends with its text gets the end word.
void end_main(ir::Program& program, Diagnostics& diagnostics) {
  ir::number_statements(program);
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
        std::holds_alternative<ir::Return>(last->node) || (jump != nullptr && !jump->condition) ||
        !runs_to_its_end(program, r)) {
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
    if (stem == write.main_stem) continue;
    write.taken.insert(to_upper_ascii(name));
    write.mains.insert(to_upper_ascii(name));
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

/// The steps of one translation, in their order. A step that returns false ends it: `result` says why.
class Translation {
 public:
  Translation(const TranslateOptions& options, TranslateResult& result) : options_(options), result_(result) {}

  bool open(const Input& input);
  bool read();
  bool write();
  bool look_back();
  void prove();

 private:
  /// Errors of reading may be written over only when the user asked for it.
  [[nodiscard]] bool refused() const {
    return result_.diagnostics.has_errors() && options_.unsupported == backends::Unsupported::error;
  }
  /// In its own language the names are the machine's, and what can't be run here is kept.
  [[nodiscard]] bool same_language() const { return &reading_.dialect() == to_; }
  /// In its own language for its own machine a program is legal as it stands.
  [[nodiscard]] bool as_it_stands() const;
  void check_calls();
  void settle_calls();
  Attempt draft(const AttemptContext& context, backends::WriteOptions write);
  void end_cycles();

  const TranslateOptions& options_;
  TranslateResult& result_;
  Reading reading_;
  const Dialect* to_ = nullptr;
  std::optional<machine::Profile> target_profile_;
  ir::Program source_;  ///< as the replay of the source runs it
  ir::Program work_;    ///< as the passes get it
  ir::LegaliseReport names_;
  std::optional<ReadBack> back_;
  std::vector<ir::RoutineName> missing_;  ///< routines that are called, that nobody has and the names say nothing of
  std::vector<std::vector<Span>> missing_calls_;  ///< where each of them is called
  std::vector<Outside> outside_;                  ///< those that they say something of
  bool by_number_ = false;                        ///< the target calls by number
  bool left_out_ = false;                         ///< there were errors, written over as asked
};

bool Translation::open(const Input& input) {
  if (find_readable(options_.from, &result_.error) == nullptr) return false;
  to_ = find_dialect(options_.to);
  if (to_ == nullptr) {
    result_.error = unknown_dialect(options_.to);
    return false;
  }
  if (!reading_.open(input, options_.from, options_, &result_.error)) return false;
  const machine::Profile& source_profile = reading_.profile();
  result_.lathe = source_profile.kind == machine::Kind::lathe;
  by_number_ = !to_->backend->capabilities().named_routines;
  target_profile_ = choose_target(*to_, options_.target_machine, source_profile, &result_.error);
  if (!target_profile_) return false;
  for (const auto& [name, value] : options_.run.set) {
    const auto radius = name == tool_radius ? parse_decimal(value) : std::nullopt;
    if (!radius) continue;
    reading_.give(name, *radius);
    target_profile_->data[name] = *radius;
  }
  result_.source_machine = source_profile.name;
  result_.target_machine = target_profile_->name;
  return true;
}

bool Translation::read() {
  frontends::ReadStats stats;
  source_ = reading_.read(result_.diagnostics, &stats);
  result_.lines = stats.lines;
  Loader& loader = reading_.loader();
  result_.files = loader.files();
  if (loader.foreign()) return false;
  join_libraries(source_, loader, result_.diagnostics);
  result_.diagnostics.append(loader.library_diagnostics());
  if (options_.folded != nullptr) {
    result_.lines = options_.folded->last_line();
    result_.unfit = unfit(source_, reading_.profile(), {to_->name, *target_profile_}, *options_.folded);
    if (result_.unfit) return false;
  }
  end_cycles();
  check_calls();
  result_.files = loader.files();
  if (same_language()) {
    work_ = source_;
    ir::passes::number_programs(work_, result_.diagnostics, false);
  }
  if (!same_language()) {
    const auto* placed = options_.names == nullptr ? nullptr : &options_.names->map.data;
    keep_with_the_machine(source_, reading_.dialect());
    settings_as_variables(source_, reading_.dialect(), reading_.profile(), placed, result_.diagnostics);
    define_given_names(source_, reading_.dialect(), placed, result_.diagnostics);
  }
  declare_names(source_, loader.definitions(), false, result_.diagnostics);
  if (!same_language()) {
    work_ = source_;
    // The main program comes first, wherever its archive has it.
    std::stable_partition(work_.routines.begin(), work_.routines.end(),
                          [](const ir::Routine& r) { return r.kind == ir::RoutineKind::main; });
    settle_calls();
  }
  return true;
}

/// Calls of what is not at hand: as the file of names says, or as text.
void Translation::settle_calls() {
  missing_calls_ = mark_missing_calls(work_, missing_);
  if (options_.names == nullptr) return;
  const auto has = [this](const ir::RoutineName& name) { return reading_.loader().find(name) != nullptr; };
  outside_ = outside_calls(source_, *options_.names, by_number_, has);
  settle_outside(work_, outside_, result_.diagnostics);
  pass_over_outside(source_, outside_);
}

/// A subprogram of another file selects another plane while a cycle of its caller is in force.
void Translation::end_cycles() {
  const machine::Profile& profile = reading_.profile();
  if (profile.policies.cycle_plane_function != machine::CyclePlaneFunction::ends || same_language()) return;
  for (const ir::Statement* s : ir::end_cycles_with_plane(source_, profile.power_on)) {
    result_.diagnostics.error("TRN-620", s->line.span,
                              "whether this plane function ends the cycle in force depends on the way that leads here",
                              "end the cycle before it");
  }
}

void Translation::check_calls() {
  Loader& loader = reading_.loader();
  interpreter::Options checks = options_.run;
  ir::Program outside;  // stands for a subprogram that only the map of names knows
  outside.routines.emplace_back().kind = ir::RoutineKind::sub;
  checks.library = [&](const ir::RoutineName& name) {
    const ir::Program* found = loader.find(name);
    const bool named = found == nullptr && options_.names != nullptr && answered(name, *options_.names, by_number_);
    return named ? &outside : found;
  };
  Diagnostics found;
  checks.fault = [&loader](FileId f, std::uint32_t from, std::uint32_t to) { return loader.fault(f, from, to); };
  missing_ = interpreter::check_program(source_, checks, found, interpreter::Faults::told);
  result_.diagnostics.append(same_language() ? as_warnings(found) : found);
}

bool Translation::as_it_stands() const {
  const auto named = [](const std::string& given, const machine::Profile& chosen) {
    return given.empty() ? chosen.name : given;
  };
  return same_language() &&
         named(options_.machine, reading_.profile()) == named(options_.target_machine, *target_profile_) &&
         options_.cycles != ir::CycleWriting::explode && !options_.raise_structure;
}

bool Translation::write() {
  const SourceText& source = *reading_.source();
  if (!as_it_stands()) end_main(work_, result_.diagnostics);
  if (!same_language()) read_contours(work_, reading_.profile());
  if (!same_language()) put_origin(work_, origin_text(options_, source.name()));
  backends::WriteOptions write;
  write.profile = &*target_profile_;
  write.unsupported = options_.unsupported;
  write.numbering = options_.numbering;
  write.number_step = options_.number_step;
  write.annotate = options_.annotate;
  write.single_output = options_.single_output;
  write.files_apart = options_.files_apart;
  write.main_stem = source.stem();
  write.taken = options_.taken;
  if (options_.names != nullptr) name_program(options_.names->map, work_, write);
  if (refused()) pass_over_unread(work_);
  const AttemptContext context{*to_, reading_.profile(), *target_profile_, options_, as_it_stands(), refused()};
  Attempt written =
      options_.draft && !same_language() ? draft(context, write) : attempt_both(context, std::move(work_), write);
  result_.diagnostics.append(written.said);
  result_.files = reading_.loader().files();
  if (refused()) return false;
  names_ = std::move(written.names);
  result_.names = names_.names;
  if (result_.draft)  // what stands for data in a draft is no name that stays
    std::erase_if(result_.names.variables, [](const auto& v) { return v.first.starts_with(placeholder_mark); });
  for (auto& f : written.files) {
    if (options_.folded == nullptr) f.text = backends::numbered(*to_->backend, write, std::move(f.text));
    if (f.main) result_.names.programs[source.stem()] = f.program.empty() ? f.name : f.program;
    OutputText out{result_.draft ? draft_name(f.name) : f.name, f.program, {}, std::move(f.map), f.main};
    out.bytes =
        encode_output(f.text, options_.encoding.value_or(source.encoding()), options_.eol.value_or(source.main_eol()),
                      source.has_bom() && same_language() && !options_.encoding, result_.diagnostics);
    result_.outputs.push_back(std::move(out));
  }
  std::stable_partition(result_.outputs.begin(), result_.outputs.end(), [](const OutputText& o) { return o.main; });
  return true;
}

/// The first attempt tells what is left to do, the second has it at its head.
Attempt Translation::draft(const AttemptContext& context, backends::WriteOptions write) {
  Diagnostics said;
  auto placeholders = put_placeholders(work_, {to_->backend->capabilities_for(*target_profile_),
                                               reading_.profile(),
                                               *target_profile_,
                                               {},
                                               said,
                                               nullptr,
                                               nullptr,
                                               options_.names != nullptr ? &options_.names->map : nullptr});
  result_.diagnostics.append(said);
  write.draft = true;
  Attempt first = attempt_both(context, work_, write);
  std::vector<Span> left_out;
  for (const auto& f : first.files) left_out.insert(left_out.end(), f.left_out.begin(), f.left_out.end());
  result_.untranslated = lines_of(std::move(left_out));
  result_.to_do =
      to_do_of(std::move(placeholders), result_.diagnostics, first.said, missing_calls_, result_.untranslated);
  result_.draft = !result_.to_do.empty();
  if (!result_.draft) return first;
  write.to_do = to_do_lines(result_.to_do, work_);
  put_to_do(work_, result_.to_do, result_.untranslated.size(), reading_.source()->name());
  return attempt_both(context, std::move(work_), write);
}

bool Translation::look_back() {
  const bool look = !same_language() && result_.diagnostics.error_count() == 0;
  if ((look || options_.verify) && readable(*to_)) {
    back_.emplace(read_back(result_.outputs, *to_, *target_profile_, same_language() ? &reading_.loader() : nullptr));
    if (options_.names != nullptr) pass_over_outside(back_->program, outside_, *options_.names);
    if (look) check_written(result_.outputs, *back_, result_.diagnostics);
  }
  (void)names_differ(result_.outputs, result_.diagnostics);
  if (refused()) return false;
  left_out_ = result_.diagnostics.has_errors();
  result_.diagnostics = as_warnings(result_.diagnostics);  // written all the same, as asked
  return true;
}

void Translation::prove() {
  result_.verified = true;
  if (!back_) {
    result_.verdict.status = verifier::Status::not_replayable;
    result_.verdict.reason = std::string(to_->title) + ": nothing here reads the translation back";
    result_.held_back = options_.strict;
    return;
  }
  if (left_out_ && (!options_.strict || result_.draft)) {
    result_.verdict.status = verifier::Status::not_replayable;
    result_.verdict.reason = result_.draft
                                 ? "a draft: " + std::to_string(result_.to_do.size()) +
                                       (result_.to_do.size() == 1 ? " thing is" : " things are") + " to be done"
                                 : "what --unsupported leaves out is missing in the translation";
    return;
  }
  const auto target_settings = [this](const Settings& set) {
    return same_language() ? set : renamed_settings(set, names_);
  };
  const auto given_data = same_language() ? std::vector<std::string>{} : ir::passes::given_data(names_);
  const auto& warned = result_.diagnostics.all();
  const auto has_warned = [&warned](std::string_view code) {
    return std::any_of(warned.begin(), warned.end(), [code](const Diagnostic& d) { return d.code == code; });
  };
  Proof proof = translator::prove(
      {source_, reading_.profile(), reading_.loader()}, {back_->program, *target_profile_, back_->loader},
      {options_.run, target_settings, given_data, options_.further, reading_.dialect().first_skip_switch,
       to_->backend->capabilities_for(*target_profile_), has_warned("TRN-421") || has_warned("TRN-484"),
       has_warned("TRN-218")});
  result_.verdict = std::move(proof.verdict);
  const auto twice = shared_name(back_->program);
  if (!twice.empty()) {
    result_.verdict.status = verifier::Status::not_replayable;
    result_.verdict.reason = "two programs of the translation have the same name: " + twice;
  }
  result_.target_files = back_->loader.files();
  if (options_.keep_traces) {
    result_.source_trace = std::move(proof.source.events);
    result_.target_trace = std::move(proof.target.events);
  }
  if (result_.verdict.good()) return;
  if (const auto& d = result_.verdict.difference; d.target_code == interpreter::code::arc_radii) {
    Span arc;
    arc.file = d.source_file;
    arc.line = arc.end_line = d.source_line;
    arc.column = arc.end_column = 1;
    result_.diagnostics.warning("TRN-317", arc,
                                "the replay stops at this arc on the target, and the source's control takes it: " +
                                    d.what.substr(d.what.find(": ") + 2),
                                "correct its end or its centre, or write the arc by its radius");
  }
  result_.held_back = options_.strict || result_.verdict.differs() || !twice.empty();
  const auto weighed = [this](const Diagnostics& said) { return result_.held_back ? said : as_warnings(said); };
  const Diagnostics running = weighed(proof.source.diagnostics);
  for (const auto& d : running.all()) {
    const auto& said = result_.diagnostics.all();
    if (std::find(said.begin(), said.end(), d) == said.end()) result_.diagnostics.add(d);
  }
  back_->diagnostics.append(proof.target.diagnostics);
  if (back_->diagnostics.has_errors()) result_.target_diagnostics = weighed(back_->diagnostics);
}

}  // namespace

void prove_as_usual(TranslateOptions& options) {
  options.verify = true;
  options.strict = false;
  options.further = usual_replays;
}

std::string proof_text(const TranslateResult& result, const FileTable& targets) {
  if (!result.verified) return "not asked";
  const bool told = result.verdict.good() || result.held_back;
  if (!told) return verifier::not_proved(result.verdict);
  std::string text = verifier::describe(result.verdict, result.files, targets);
  if (result.lines_by_form != 0 && result.verdict.good())
    text += fmt::format("; {} more plain lines are written as those of their form that were replayed",
                        result.lines_by_form);
  return text;
}

TranslateResult translate(const Input& input, const TranslateOptions& options) {
  TranslateResult result;
  Translation steps(options, result);
  if (!steps.open(input)) return result;
  if (!steps.read() || !steps.write() || !steps.look_back()) {
    result.refused = true;
    result.outputs.clear();
    return result;
  }
  if (options.verify) steps.prove();
  return result;
}

}  // namespace cnctrans::translator
