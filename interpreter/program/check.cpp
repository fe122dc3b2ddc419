// Faults that are visible without running: what control can reach is followed from the start of the main program.
#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "interpreter/program/routines.h"
#include "interpreter/trace/run_codes.h"
#include "interpreter/values/expressions.h"
#include "ir/check/missing_features.h"
#include "ir/edit/file_line.h"
#include "ir/edit/limit_words.h"

namespace cnctrans::interpreter {

namespace {

/// Understood when it was read: only a run that comes here stops.
bool is_read(const ir::Opaque& o) {
  const auto* f = ir::find_missing_feature(o.feature);
  return f != nullptr && f->key != "text.unread" && f->key != "machine.axis";
}

class Checker {
 public:
  Checker(const ir::Program& program, const Options& options, Diagnostics& diagnostics, Faults faults)
      : program_(program), routines_(program, options, nullptr), diagnostics_(diagnostics), faults_(faults) {}

  std::vector<ir::RoutineName> run() {
    auto* main = routines_.main();
    if (main == nullptr) {
      diagnostics_.error(code::no_program, {}, "there is no program to run");
      return {};
    }
    reach(*main, 0);
    while (!work_.empty()) {
      const auto [flow, at] = work_.back();
      work_.pop_back();
      visit(*flow, at);
    }
    for (auto* flow : routines_.all_of_main()) unreached(*flow);
    limits();
    return tell_missing();
  }

 private:
  void reach(Flow& flow, std::uint32_t at) {
    auto& seen = seen_[&flow];
    if (seen.empty()) {
      seen.resize(flow.code.size() + 1, false);
      order_.push_back(&flow);
    }
    if (at >= flow.code.size() || seen[at]) return;
    seen[at] = true;
    work_.emplace_back(&flow, at);
  }
  void reach_all_labels(Flow& flow) {
    for (const auto& [key, places] : flow.labels) {
      for (const auto& p : places) reach(flow, p.begin);
    }
  }

  void visit(Flow& flow, std::uint32_t at) {
    const auto& in = flow.code[at];
    switch (in.op) {
      case Op::go: reach(flow, in.target); return;
      case Op::branch_false:
      case Op::for_test: reach(flow, in.target); break;
      case Op::for_step: reach(flow, in.target); return;
      case Op::jump:
        jump(flow, at, *in.jump_node);
        if (!in.jump_node->condition && !in.jump_node->quiet) return;
        break;
      case Op::choose: {
        const auto& s = std::get<ir::Switch>(in.statement->node);
        for (const auto& c : s.cases) jump(flow, at, c.second);
        for (const auto& j : s.fallback) jump(flow, at, j);
        break;
      }
      case Op::repeat: repeat(flow, at, std::get<ir::Repeat>(in.statement->node)); break;
      case Op::call: call(flow, *in.statement, std::get<ir::CallRoutine>(in.statement->node)); break;
      case Op::modal_call: {
        const auto& m = std::get<ir::ModalCall>(in.statement->node);
        if (!m.off && !m.cycle) call(flow, *in.statement, m.call);
        break;
      }
      case Op::give_back:
      case Op::end: return;
      case Op::opaque: {
        const auto& o = std::get<ir::Opaque>(in.statement->node);
        if (o.harmless || told(flow, at)) break;
        if (const auto* f = ir::find_missing_feature(o.feature); f != nullptr && f->beside_path) {
          diagnostics_.warning(code::beside_path, in.statement->line.span,
                               "the run goes past this: " + std::string(f->title), std::string(f->reason));
          break;
        }
        if (is_read(o)) break;
        const bool axis = o.feature == "machine.axis";
        diagnostics_.error(code::opaque, in.statement->line.span,
                           axis ? "this block moves an axis that the machine does not have"
                                : "this statement is not understood and may move the machine or change its state",
                           "the program cannot be run; see the diagnostic of the reader for the same line");
        break;
      }
      case Op::fault:
        if (std::exchange(faults_, Faults::told) == Faults::told) break;
        diagnostics_.error(code::opaque, in.statement != nullptr ? in.statement->line.span : in.fault->span,
                           fault_text(*in.fault), "the program is not run");
        break;
      case Op::stray_exit:
        diagnostics_.error(code::exit_outside, in.statement->line.span, "an exit stands outside of every loop");
        break;
      default: break;
    }
    reach(flow, at + 1);
  }

  /// The reader's error for this statement has been given as the reason already.
  static bool told(const Flow& flow, std::uint32_t at) {
    return at > 0 && flow.code[at - 1].op == Op::fault && flow.code[at - 1].statement == flow.code[at].statement;
  }

  void missing_label(const ir::Statement& s, const std::string& text) {
    diagnostics_.error(code::unknown_label, s.line.span, "there is no block labelled " + text,
                       "the program is not run: the jump or repeat would lead nowhere");
  }

  void jump(Flow& flow, std::uint32_t at, const ir::Jump& j) {
    if (j.target.computed) {
      reach_all_labels(flow);
      return;
    }
    if (j.search == ir::Search::to_start) {
      reach(flow, 0);
      return;
    }
    const auto key = label_key(j.target);
    if (const auto* p = flow.find(key, j.search, at)) {
      reach(flow, p->begin);
    } else if (!j.quiet) {
      missing_label(*flow.code[at].statement, label_text(key));
    }
  }

  void range(Flow& flow, const ir::Statement& s, const ir::LabelRef& first, const ir::LabelRef& last, ir::Search search,
             bool order_free, std::uint32_t from) {
    if (first.computed || last.computed) {
      reach_all_labels(flow);
      return;
    }
    std::uint32_t begin = 0, end = 0;
    std::string missing;
    const auto last_key = last.text.empty() ? std::string{} : label_key(last);
    if (flow.range(label_key(first), last_key, search, order_free, from, begin, end, missing)) {
      reach(flow, begin);
    } else {
      missing_label(s, missing);
    }
  }

  void repeat(Flow& flow, std::uint32_t at, const ir::Repeat& r) {
    const auto& s = *flow.code[at].statement;
    if (r.curve_use != ir::CurveUse::none && r.first.text.empty()) return;  // a curve that is not defined: see the run
    if (!r.has_program) {
      range(flow, s, r.first, r.last, r.search, r.order_free, at);
    } else if (auto* other = routines_.find(r.program, flow)) {
      range(*other, s, r.first, r.last, ir::Search::whole_first, r.order_free, 0);
    } else {
      missing_routine(s, r.program);
    }
  }

  void missing_routine(const ir::Statement& s, const ir::RoutineName& name) {
    const auto has = [&name](const Missing& m) { return m.name == name; };
    auto it = std::find_if(missing_.begin(), missing_.end(), has);
    if (it == missing_.end()) it = missing_.insert(missing_.end(), {name, s.line.span, 0});
    const auto place = [](const Span& at) { return std::tuple(at.file, at.line, at.column); };
    if (place(s.line.span) < place(it->first)) it->first = s.line.span;
    ++it->calls;
  }

  /// One error for each routine, where it is called first.
  std::vector<ir::RoutineName> tell_missing() const {
    std::vector<ir::RoutineName> names;
    for (const auto& m : missing_) {
      const bool program = !m.name.text.empty() && m.name.text.find_first_not_of("0123456789") == std::string::npos;
      const std::string more = m.calls > 1 ? "; " + std::to_string(m.calls) + " blocks call it" : std::string();
      diagnostics_.error(code::unknown_routine, m.first,
                         (program ? "there is no program " : "there is no subprogram ") + routine_text(m.name) + more,
                         "name the folder it is in with --lib; a translation can do without where a file of names says "
                         "how it is called (--names)");
      names.push_back(m.name);
    }
    return names;
  }

  /// The run may write the program before it calls it.
  bool writes_program(const ir::RoutineName& name) const {
    bool writes = false;
    for (const auto& r : program_.routines) {
      ir::for_each_statement(r.body, [&](const ir::Statement& s) {
        const auto* m = std::get_if<ir::Message>(&s.node);
        const auto file = m != nullptr ? ir::file_statement(*m) : std::nullopt;
        if (!file || !file->name || name.text.empty()) return;
        const auto number = ir::constant_value(file->name);
        const auto* text = std::get_if<ir::String>(&file->name->node);
        writes = writes || (number ? number_text(*number) == name.text : text == nullptr || text->text == name.text);
      });
    }
    return writes;
  }

  void call(Flow& flow, const ir::Statement& s, const ir::CallRoutine& c) {
    if (c.computed) return;
    auto* callee = routines_.find(c.routine, flow);
    if (callee == nullptr) {
      if (!c.optional && !writes_program(c.routine)) missing_routine(s, c.routine);
      return;
    }
    if (c.has_range) {
      range(*callee, s, c.first, c.last.text.empty() && !c.last.computed ? c.first : c.last, ir::Search::whole_first,
            true, 0);
    } else {
      reach(*callee, 0);
    }
  }

  /// Two words that limit the speed of the spindle, in two programs: a run takes the one that comes later.
  void limits() {
    ir::LimitWords words;
    for (const auto* flow : order_) {
      const ir::Statement* s = words.add(*flow->routine);
      if (s == nullptr) continue;
      diagnostics_.warning(code::limit_words, s->line.span,
                           "the speed of the spindle is limited by another word in another program: the lower of both "
                           "limits counts on the control, and in this run the one that comes later",
                           "write both limits in one program, one behind the other");
      return;
    }
  }

  /// What control never reaches cannot stop a run, but is worth a word.
  void unreached(Flow& flow) {
    const auto& seen = seen_[&flow];
    for (std::uint32_t at = 0; at < flow.code.size(); ++at) {
      const auto& in = flow.code[at];
      if (in.op != Op::jump || (!seen.empty() && seen[at])) continue;
      const auto& j = *in.jump_node;
      if (j.target.computed || j.quiet || j.search == ir::Search::to_start) continue;
      const auto key = label_key(j.target);
      if (flow.find(key, j.search, at) != nullptr) continue;
      diagnostics_.warning(code::unknown_label, in.statement->line.span,
                           "there is no block labelled " + label_text(key) + "; the program never comes here");
    }
  }

  const ir::Program& program_;
  Routines routines_;
  Diagnostics& diagnostics_;
  Faults faults_;
  std::map<Flow*, std::vector<bool>> seen_;
  std::vector<const Flow*> order_;  ///< as they are reached first
  struct Missing {
    ir::RoutineName name;
    Span first;
    std::size_t calls = 0;
  };
  std::vector<Missing> missing_;
  std::vector<std::pair<Flow*, std::uint32_t>> work_;
};

}  // namespace

std::vector<ir::RoutineName> check_program(const ir::Program& program, const Options& options, Diagnostics& diagnostics,
                                           Faults faults) {
  return Checker(program, options, diagnostics, faults).run();
}

}  // namespace cnctrans::interpreter
