// Straight-line execution for streams.
#include "base/text.h"
#include "interpreter/machine/block_machine.h"
#include "interpreter/program/interpreter.h"
#include "interpreter/trace/run_codes.h"

namespace cnctrans::interpreter {

struct BlockRunner::State {
  State(const machine::Profile& profile, const Options& o, TraceSink& sink, Diagnostics& d)
      : options(o),
        there(o.world ? machine::put_into(*o.world, profile) : profile),
        diagnostics(d),
        emitter(sink, o.max_events),
        machine(there, emitter, failure, nullptr, options.world ? &*options.world : nullptr) {}

  Options options;
  machine::Profile there;
  Diagnostics& diagnostics;
  Failure failure;
  Emitter emitter;
  BlockMachine machine;
  Result result;
  bool ended = false;
  bool skipping = false;

  void end(EndReason reason, const Span& where) {
    if (ended) return;
    ended = true;
    if (reason == EndReason::program_end && !machine.finish()) reason = EndReason::error;
    machine.tell_path(diagnostics);
    result.reason = reason;
    if (reason == EndReason::error) {
      result.error_code = failure.code;
      result.error_text = failure.text;
      result.error_span = failure.span;
      diagnostics.error(failure.code, failure.span, failure.text);
    }
    machine.end_event(reason, failure, reason == EndReason::error ? failure.span : where);
    result.events = emitter.count();
  }

  bool other(const ir::Statement& s);
};

BlockRunner::BlockRunner(const machine::Profile& profile, const Options& options, TraceSink& sink,
                         Diagnostics& diagnostics)
    : state_(std::make_unique<State>(profile, options, sink, diagnostics)) {}
BlockRunner::~BlockRunner() = default;

bool BlockRunner::step(const ir::Statement& s) {
  auto& st = *state_;
  if (st.ended) return false;
  if (!s.line.joined) st.skipping = false;
  if ((s.line.skip_mask & st.options.skip_mask) != 0) st.skipping = true;
  if (st.skipping) return true;
  ++st.result.steps;
  if (const auto* b = std::get_if<ir::Block>(&s.node)) {
    ++st.result.blocks;
    if (b->repeat_given != 0) {
      st.failure.where = s.line.span;
      st.failure.fail(code::needs_whole_program, "a repeated block cannot be carried out in a stream");
    } else {
      st.machine.block(*b, s.line.span);
    }
  } else if (!st.other(s)) {
    return false;
  }
  if (st.failure.set) {
    st.end(EndReason::error, s.line.span);
  } else if (st.emitter.limit_reached()) {
    st.end(EndReason::event_limit, s.line.span);
  } else if (st.result.steps >= st.options.max_steps) {
    st.end(EndReason::step_limit, s.line.span);
  }
  return !st.ended;
}

/// Statements without control flow; false when the run has ended.
bool BlockRunner::State::other(const ir::Statement& s) {
  failure.where = s.line.span;
  if (std::holds_alternative<ir::Label>(s.node)) return true;
  if (std::holds_alternative<ir::End>(s.node) || std::holds_alternative<ir::Return>(s.node)) {
    end(EndReason::program_end, s.line.span);
    return false;
  }
  if (const auto* m = std::get_if<ir::Message>(&s.node); m != nullptr && m->kind != ir::MessageKind::error) {
    std::string text;
    for (const auto& part : m->parts) {
      const auto* literal = part ? std::get_if<ir::String>(&part->node) : nullptr;
      if (literal == nullptr) return failure.fail(code::needs_whole_program, "a computed message in a stream") || true;
      text += literal->text;
    }
    if (m->kind == ir::MessageKind::show) machine.message(text, s.line.span);
    return true;
  }
  if (const auto* o = std::get_if<ir::Opaque>(&s.node); o != nullptr && o->harmless) return true;
  failure.fail(code::needs_whole_program, "this statement needs the whole program");
  return true;
}

Result BlockRunner::finish(const Span& where) {
  state_->end(EndReason::program_end, where);
  return state_->result;
}

}  // namespace cnctrans::interpreter
