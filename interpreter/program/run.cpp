// The loop over instructions, limits, the end of a run.
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "interpreter/program/runner.h"
#include "interpreter/trace/run_codes.h"
#include "ir/check/missing_features.h"
#include "machine/data_at_rest.h"

namespace cnctrans::interpreter {

namespace {
constexpr std::uint64_t check_every = 65'536;

/// Where an event belongs that no statement has caused: the first line of the main program.
Span start_of(const ir::Program& program) {
  FileId file = program.files.empty() ? 0 : program.files.front().file;
  if (const auto* main = program.main(); main != nullptr && main->file != 0) file = main->file;
  return {file, 1, 1, 1, 1};
}

/// As the options say: calls of subprograms that are nowhere are told only, for the run goes past them; other faults
/// too where the run stops only when it comes to one.
Diagnostics as_options_say(const machine::Profile& profile, const Diagnostics& found) {
  const bool passes_over = profile.policies.call_missing == machine::CallMissing::passed_over;
  const bool when_reached = profile.policies.run_faults == machine::RunFaults::when_reached;
  Diagnostics out;
  const auto add = [&](Diagnostic d) {
    const bool missing = passes_over && d.code == code::unknown_routine;
    if (missing) d.code = code::passed_over;
    if (d.severity == Severity::error && (missing || when_reached)) {
      d.severity = Severity::warning;
      if (!d.message.empty())
        d.message += missing ? "; the run goes past the call" : "; the run stops where it comes to it";
      if (!missing) d.hint.clear();
    }
    out.add(std::move(d));
  };
  for (const auto& d : found.all()) add(d);
  for (const auto& [code, more] : found.more()) {
    for (const auto& range : more.lines) {
      for (auto line = range.first; line <= range.last; ++line)
        add({code, more.severity, {range.file, line, 1, line, 1}, {}, {}});
    }
  }
  return out;
}
}  // namespace

Runner::Runner(const ir::Program& program, const machine::Profile& profile, const Options& options, TraceSink& sink,
               Diagnostics& diagnostics)
    : program_(program),
      profile_(profile),
      options_(options),
      diagnostics_(diagnostics),
      variables_(failure_),
      evaluator_(variables_, failure_),
      emitter_(sink, options.max_events),
      machine_(profile, emitter_, failure_, &evaluator_, options.world ? &*options.world : nullptr),
      routines_(program, options, &variables_) {
  evaluator_.set_system(&machine_);
  evaluator_.set_equal_within(profile.policies.compare_equal_within);
  machine_.keep_cycles(options.cycles);
  machine_.find_programs(&options_.library);
  machine_.belongs_to(&program, nullptr);
  local_levels_ = static_cast<std::size_t>(profile.policies.calls_local_levels);
}

Result Runner::run() {
  const auto before = diagnostics_.error_count();
  Diagnostics found;
  check_program(program_, options_, found);
  found = as_options_say(profile_, found);
  for (const auto& d : found.all()) {
    if (d.severity == Severity::error && !failure_.set) {
      failure_.where = d.span;
      failure_.fail(d.code, d.message);
    }
  }
  diagnostics_.append(found);
  if (diagnostics_.error_count() != before) return refuse();
  auto* main = routines_.main();
  last_ = failure_.where = start_of(program_);
  Activation& a = calls_.emplace_back();
  a.flow = main;
  for (const auto& shape : main->locals) a.locals.push_back({shape, false, {}});
  enter_top();
  if (!apply_settings()) return refuse();
  for (const auto& p : main->routine->parameters) {
    for (auto& v : a.locals) {
      if (v.own.name == p.variable.name) variables_.apply_presets(v.own);
    }
  }
  loop();
  for (const Span& s : evaluator_.nearly_equal()) {
    diagnostics_.warning(code::nearly_equal, s,
                         "two computed numbers are equal here but for rounding, and are taken for equal",
                         "count with whole numbers where you can, or ask for < and >");
  }
  machine_.tell_path(diagnostics_);
  for (const auto& datum : machine_.given_data().assumed()) {
    diagnostics_.warning(code::data_at_rest, datum.where,
                         "the value of " + datum.name + " is known to the machine only; " + shortest(datum.value) +
                             " was taken, as of a machine at rest",
                         datum.hint);
  }
  for (const auto& cut : variables_.cuts()) {
    diagnostics_.warning(code::text_cut, cut.where,
                         "the text is cut: " + cut.name + " takes " + std::to_string(cut.length) + " characters",
                         "define it longer");
  }
  switch (state_) {
    case State::event_limit: return finish(EndReason::event_limit, last_);
    case State::step_limit: return finish(EndReason::step_limit, last_);
    case State::failed: return finish(EndReason::error, failure_.span);
    case State::running:
    case State::ended: break;
  }
  if (machine_.finish()) return finish(EndReason::program_end, last_);
  return finish(EndReason::error, failure_.span);
}

/// Nothing has moved: the diagnostics say why, the trace has its end only.
Result Runner::refuse() {
  keep_locals();
  Result r;
  r.reason = EndReason::error;
  r.error_code = failure_.code;
  r.error_text = failure_.text;
  r.error_span = failure_.span;
  machine_.end_event(EndReason::error, failure_, failure_.span);
  r.events = emitter_.count();
  return r;
}

Result Runner::finish(EndReason reason, const Span& where) {
  keep_locals();
  Result r;
  r.reason = reason;
  if (reason == EndReason::error) {
    r.error_code = failure_.code;
    r.error_text = failure_.text;
    r.error_span = failure_.span;
    diagnostics_.error(failure_.code, failure_.span, failure_.text);
  }
  report_settings();
  machine_.end_event(reason, failure_, where);
  r.steps = steps_;
  r.blocks = blocks_;
  r.events = emitter_.count();
  r.variables = variables_.report();
  r.covered.assign(covered_.begin(), covered_.end());
  r.outcomes = outcomes_;
  r.written = std::move(written_);
  r.read_first = variables_.read_first();
  r.writes_zeros = machine_.writes_zeros();
  for (const auto& a : machine_.assumed_radii()) r.assumed_radii.emplace_back(a.where, a.radius);
  return r;
}

void Runner::keep_locals() {
  for (std::size_t i = calls_.size(); i-- > 0;) variables_.leave(calls_[i].locals, static_cast<std::uint32_t>(i));
}

// --- settings of the command line ------------------------------------------------------------------------------

bool Runner::apply_settings() {
  for (const auto& [name, value] : options_.set) {
    if (!apply_setting(name, value)) return false;
  }
  return true;
}

/// What --set gave and the run had no use for: most often a name with a typing error.
void Runner::report_settings() {
  for (const auto& p : variables_.presets()) {
    const std::string text = "--set " + p.name + "=" + p.value;
    if (p.found && !p.fits) {
      diagnostics_.warning(code::unused_set, {}, text + ": the value is no number; the variable keeps its own");
    } else if (!p.found && (!preset_number(p.value) || machine_.given_data().preset_unread(p.name))) {
      diagnostics_.warning(code::unused_set, {}, text + ": this run has no variable of that name; nothing is set",
                           "names are written as in the program: P100, L1, R5, DEPTH");
    }
  }
}

namespace {

/// The number of R2 and of R[2], from its first digit on.
std::string_view inside_brackets(std::string_view name, std::size_t digit) {
  const bool closed = digit > 0 && name[digit - 1] == '[' && name.ends_with(']');
  return name.substr(digit, closed ? name.size() - digit - 1 : std::string_view::npos);
}

}  // namespace

bool Runner::apply_setting(const std::string& name, const std::string& value) {
  const auto digit = name.find_first_of("0123456789");
  const auto letters = digit == std::string::npos || digit == 0 || name[digit - 1] != '[' ? digit : digit - 1;
  auto* space = digit == std::string::npos ? nullptr : variables_.numbered(to_upper_ascii(name.substr(0, letters)));
  const auto index = space == nullptr ? std::nullopt : parse_decimal(inside_brackets(name, digit));
  const auto x = preset_number(value);
  // A number that no variable has may be that of a machine datum: E10007.
  const bool datum = index && space->find(*index) == nullptr && machine::data_at_rest(profile_, to_upper_ascii(name));
  if (!index || datum) {
    variables_.preset(name, value);
    if (x) machine_.preset_datum(name, *x);
    return true;
  }
  Place p;
  if (!x) {
    failure_.fail(code::bad_set, "--set " + name + "=" + value + ": this is not a number");
  } else if (variables_.place(*space, *index, p)) {
    Variables::assign(p, *x);
  }
  if (!failure_.set) return true;
  failure_.code = code::bad_set;
  diagnostics_.error(code::bad_set, {}, failure_.text);
  return false;
}

// --- the loop --------------------------------------------------------------------------------------------------

void Runner::loop() {
  while (state_ == State::running) {
    if (at_ >= flow_->code.size()) {
      leave(false);
      continue;
    }
    auto& in = flow_->code[at_];
    if (in.statement != nullptr) {
      last_ = in.statement->line.span;
      failure_.where = last_;
      if (steps_ >= next_check_ && over_limits()) return;
      ++steps_;
      const auto id = in.statement->id;
      if (id != 0 && flow_->program == &program_) {
        if (id >= covered_.size()) covered_.resize(id + std::size_t{1} + covered_.size(), 0);
        covered_[id] = 1;
        if (options_.witness && begins(in)) options_.witness(*in.statement, machine_.standing());
      }
    }
    const auto* statement = in.statement;
    step(in);
    if (statement != nullptr && !statement->line.number.empty()) machine_.last_label = statement->line.number;
    if (failure_.set) fail_state();
  }
}

/// A statement begins here: it is no further pass of a repeated block, and no block that goes on behind a modal
/// subprogram.
bool Runner::begins(const Instruction& in) const {
  const bool again = !repeats_.empty() && repeats_.size() > calls_.back().repeats && repeats_.back().block &&
                     repeats_.back().begin == at_;
  return !again && !(in_modal_ == 0 && machine_.points_left()) && in.op != Op::go && in.op != Op::nothing &&
         in.op != Op::lines_behind;
}

bool Runner::over_limits() {
  if (steps_ >= options_.max_steps) {
    state_ = State::step_limit;
    return true;
  }
  if (emitter_.count() != seen_events_) {
    seen_events_ = emitter_.count();
    silent_since_ = steps_;
  } else if (steps_ - silent_since_ > options_.max_silent_steps) {
    state_ = State::step_limit;
    return true;
  }
  next_check_ = std::min({steps_ + check_every, silent_since_ + options_.max_silent_steps + 1, options_.max_steps});
  return false;
}

void Runner::step(Instruction& in) {
  switch (in.op) {
    case Op::nothing: go_to(at_ + 1); return;
    case Op::block: block(in); return;
    case Op::lines_behind: lines_behind(in.statement->line.span); return;
    case Op::assign:
      assign(*in.statement);
      go_to(at_ + 1);
      return;
    case Op::branch_false: go_to(condition(in) ? at_ + 1 : in.target); return;
    case Op::go: go_to(in.target); return;
    case Op::jump: jump(in); return;
    case Op::choose: choose(std::get<ir::Switch>(in.statement->node)); return;
    case Op::for_begin:
      for_begin(std::get<ir::For>(in.statement->node));
      go_to(at_ + 1);
      return;
    case Op::for_test: go_to(for_test(std::get<ir::For>(in.statement->node)) ? at_ + 1 : in.target); return;
    case Op::for_step:
      for_step(std::get<ir::For>(in.statement->node));
      go_to(in.target);
      return;
    case Op::repeat: repeat(std::get<ir::Repeat>(in.statement->node)); return;
    case Op::call: call(std::get<ir::CallRoutine>(in.statement->node)); return;
    case Op::modal_call: modal_call(std::get<ir::ModalCall>(in.statement->node)); return;
    case Op::give_back: give_back(std::get<ir::Return>(in.statement->node)); return;
    case Op::end: end_program(std::get<ir::End>(in.statement->node)); return;
    case Op::message:
      message(std::get<ir::Message>(in.statement->node), in.statement->line.span);
      go_to(at_ + 1);
      return;
    case Op::declare:
      declare(std::get<ir::Declare>(in.statement->node));
      go_to(at_ + 1);
      return;
    case Op::opaque:
      if (!std::get<ir::Opaque>(in.statement->node).harmless) {
        const auto& o = std::get<ir::Opaque>(in.statement->node);
        const auto* f = ir::find_missing_feature(o.feature);
        if (f == nullptr || !f->beside_path) {
          failure_.fail(code::not_carried, "this block is kept as text and not carried out" +
                                               (f != nullptr ? " (" + std::string(f->title) + ")" : std::string{}));
        }
      }
      go_to(at_ + 1);
      return;
    case Op::fault: failure_.fail(code::opaque, fault_text(*in.fault)); return;
    case Op::stray_exit: failure_.fail(code::exit_outside, "an exit stands outside of every loop"); return;
  }
}

void Runner::lines_behind(const Span& line) {
  if (modal_.active) return fail_whole();
  machine_.belongs_to(flow_->program, flow_->routine);
  --steps_;  // of the instruction, which is no statement
  const bool had = options_.behind->each(line, [this](const ir::Statement& s) {
    last_ = failure_.where = s.line.span;
    if (steps_ >= next_check_ && over_limits()) return false;
    ++steps_;
    ++blocks_;
    if (!machine_.block(std::get<ir::Block>(s.node), s.line.span)) fail_state();
    if (emitter_.limit_reached()) state_ = State::event_limit;
    return state_ == State::running;
  });
  if (!had) return fail_whole();
  go_to(at_ + 1);
}

void Runner::fail_whole() {
  failure_.fail(code::needs_whole_program, "these blocks need the whole program");
}

/// Control comes to `next` in sequence (a programmed jump sets at_ itself): ends of repeated parts and ranges count
/// here.
void Runner::go_to(std::uint32_t next) {
  at_ = next;
  if (next == repeat_end_ || next == stop_) arrived();
}

/// A jump has left a repeated part past its end: the next label of that name ends the pass.
void Runner::left_behind() {
  if (repeats_.size() <= calls_.back().repeats) return;
  auto& r = repeats_.back();
  if (r.last.empty() || at_ < r.end) return;
  const auto it = flow_->labels.find(r.last);
  if (it == flow_->labels.end()) return;
  for (const auto& place : it->second) {
    if (place.begin < at_) continue;
    repeat_end_ = r.end = place.end;
    return;
  }
}

void Runner::arrived() {
  while (at_ == repeat_end_) {
    auto& r = repeats_.back();
    if (--r.left > 0) {
      at_ = r.begin;
      if (!r.last.empty()) repeat_end_ = r.end = r.first_end;
      return;
    }
    at_ = r.return_to;
    if (r.curve && !machine_.end_defined_curve()) fail_state();
    repeats_.pop_back();
    repeat_end_ = repeats_.size() > calls_.back().repeats ? repeats_.back().end : nowhere;
  }
  if (at_ == stop_) leave(false);
}

/// The registers of the innermost activation.
void Runner::enter_top() {
  auto& a = calls_.back();
  flow_ = a.flow;
  stop_ = a.stop;
  repeat_end_ = repeats_.size() > a.repeats ? repeats_.back().end : nowhere;
  evaluator_.enter(&flow_->names, &a.locals);
  machine_.arguments_given = variables_.level().arguments;
  machine_.calls_open = calls_.size() - 1;
}

Result run(const ir::Program& program, const machine::Profile& profile, const Options& options, TraceSink& sink,
           Diagnostics& diagnostics) {
  if (!options.world) return Runner(program, profile, options, sink, diagnostics).run();
  const machine::Profile there = machine::put_into(*options.world, profile);
  return Runner(program, there, options, sink, diagnostics).run();
}

}  // namespace cnctrans::interpreter
