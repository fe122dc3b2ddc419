#include "interpreter/program/flow.h"

#include <algorithm>

#include "base/text.h"

namespace cnctrans::interpreter {

std::string label_key(std::string_view text, bool is_number) {
  if (!is_number) return std::string(text);
  const auto digit = text.find_first_not_of('0');
  return "#" + std::string(digit == std::string_view::npos ? "0" : text.substr(digit));
}

std::string label_key(const ir::LabelRef& label) {
  return label_key(label.text, label.is_number);
}

std::string label_text(std::string_view key) {
  return key.starts_with('#') ? "N" + std::string(key.substr(1)) : std::string(key);
}

std::string routine_text(const ir::RoutineName& name) {
  if (!name.text.empty()) return name.text;
  return name.number < 0 ? "(without name)" : std::to_string(name.number);
}

const LabelPlace* Flow::find(std::string_view key, ir::Search search, std::uint32_t from) const {
  const auto it = labels.find(key);
  if (it == labels.end()) return nullptr;
  const auto& places = it->second;
  const LabelPlace* ahead = nullptr;
  const LabelPlace* behind = nullptr;
  for (const auto& p : places) {
    if (p.begin <= from) {
      behind = &p;
    } else if (ahead == nullptr) {
      ahead = &p;
    }
  }
  switch (search) {
    case ir::Search::forward: return ahead;
    case ir::Search::backward: return behind;
    case ir::Search::forward_then_backward: return ahead != nullptr ? ahead : behind;
    case ir::Search::whole_first:
    case ir::Search::to_start: break;
  }
  return &places.front();
}

const LabelPlace* Flow::find_end(std::string_view key, ir::Search search, const LabelPlace& first) const {
  const auto it = labels.find(key);
  if (it == labels.end()) return nullptr;
  if (search != ir::Search::whole_first) {
    for (const auto& p : it->second) {
      if (p.begin >= first.begin) return &p;
    }
  }
  return &it->second.front();
}

bool Flow::range(std::string_view first, std::string_view last, ir::Search search, bool order_free, std::uint32_t from,
                 std::uint32_t& begin, std::uint32_t& end, std::string& missing) const {
  const auto* a = find(first, search, from);
  if (a == nullptr && search == ir::Search::backward && !last.empty()) a = find(first, ir::Search::forward, from);
  if (a == nullptr) {
    missing = label_text(first);
    return false;
  }
  begin = a->begin;
  if (last.empty()) {
    end = from;
    if (begin > from) missing = label_text(first);
    return begin <= from;
  }
  const auto* b = find_end(last, search, *a);
  if (b == nullptr) {
    missing = label_text(last);
    return false;
  }
  if (b->begin < a->begin && order_free) std::swap(a, b);
  begin = a->begin;
  end = b->end;
  if (b->begin >= a->begin) return true;
  missing = label_text(last) + " behind " + label_text(first);
  return false;
}

namespace {

class Builder {
 public:
  Builder(Flow& flow, const Options& options) : flow_(flow), options_(options), skip_mask_(options.skip_mask) {}

  /// An error of the routine's header, or of the routine as a whole.
  void header(const ir::Routine& routine) {
    if (routine.header.span.known()) return fault_of(routine.header);
    const auto file = routine.file == 0 && !routine.body.empty() ? routine.body.front().line.span.file : routine.file;
    add_fault(file, 0, 0);
  }

  void body(const ir::Body& body) {
    std::vector<Open> open;
    bool skipped = false;
    const ir::Statement* before = nullptr;
    for (const auto& s : body) {
      const bool own_skip = (s.line.skip_mask & skip_mask_) != 0;
      if (!s.line.joined) {
        close(open);
        behind(before);
        skipped = own_skip;
      }
      mark(s.line, open);
      const auto* branch = own_skip ? std::get_if<ir::If>(&s.node) : nullptr;
      if (branch != nullptr && !branch->one_line) {
        without_condition(*branch);
      } else if (skipped || own_skip) {
        add(Op::nothing);
      } else {
        fault_of(s.line, &s);
        statement(s);
      }
      before = &s;
    }
    close(open);
    behind(before);
  }

 private:
  /// A label whose line has not ended yet.
  struct Open {
    std::string key;
    std::size_t place;
  };

  std::uint32_t here() const { return static_cast<std::uint32_t>(flow_.code.size()); }

  void behind(const ir::Statement* s) {
    if (s != nullptr && options_.behind != nullptr && options_.behind->any(s->line.span)) add(Op::lines_behind, s);
  }

  void mark(const ir::LineInfo& line, std::vector<Open>& open) {
    const auto label = [&](std::string key) {
      auto& places = flow_.labels[key];
      places.push_back({here(), here() + 1});
      open.push_back({std::move(key), places.size() - 1});
    };
    if (!line.number.empty()) label(label_key(line.number, true));
    for (const auto& l : line.labels) label(to_upper_ascii(l));
  }
  void close(std::vector<Open>& open) {
    for (const auto& o : open)
      flow_.labels[o.key][o.place].end = std::max(here(), flow_.labels[o.key][o.place].begin + 1);
    open.clear();
  }
  /// Labels of a closing or ELSE line: they stand on the instruction that follows.
  void mark_line(const ir::LineInfo& line) {
    std::vector<Open> ignored;
    mark(line, ignored);
    fault_of(line);
  }

  /// Control that comes to a line with an error stops there.
  void fault_of(const ir::LineInfo& line, const ir::Statement* s = nullptr) {
    const auto& at = line.span;
    if (at.known()) add_fault(at.file, at.line, std::max(at.line, at.end_line), s);
  }
  void add_fault(FileId file, std::uint32_t first, std::uint32_t last, const ir::Statement* s = nullptr) {
    const Diagnostic* found = options_.fault ? options_.fault(file, first, last) : nullptr;
    if (found != nullptr) flow_.code[add(Op::fault, s)].fault = found;
  }

  std::uint32_t add(Op op, const ir::Statement* s = nullptr, std::uint32_t target = nowhere) {
    Instruction i;
    i.op = op;
    i.statement = s;
    i.target = target;
    flow_.code.push_back(i);
    return here() - 1;
  }
  void land(std::uint32_t instruction) { flow_.code[instruction].target = here(); }

  void statement(const ir::Statement& s) {
    current_ = &s;
    std::visit([this](const auto& node) { lower(node); }, s.node);
    current_ = &s;
  }

  void lower(const ir::Block& /*n*/) { add(Op::block, current_); }
  void lower(const ir::Assign& /*n*/) { add(Op::assign, current_); }
  void lower(const ir::Repeat& /*n*/) { add(Op::repeat, current_); }
  void lower(const ir::CallRoutine& /*n*/) { add(Op::call, current_); }
  void lower(const ir::ModalCall& /*n*/) { add(Op::modal_call, current_); }
  void lower(const ir::Return& /*n*/) { add(Op::give_back, current_); }
  void lower(const ir::End& /*n*/) { add(Op::end, current_); }
  void lower(const ir::Message& /*n*/) { add(Op::message, current_); }
  void lower(const ir::Declare& /*n*/) { add(Op::declare, current_); }
  void lower(const ir::Opaque& /*n*/) { add(Op::opaque, current_); }
  void lower(const ir::Label& /*n*/) { add(Op::nothing, current_); }
  void lower(const ir::Switch& /*n*/) { add(Op::choose, current_); }
  void lower(const ir::Jump& n) {
    const auto at = add(Op::jump, current_);
    flow_.code[at].jump_node = &n;
  }
  void lower(const ir::Exit& /*n*/) {
    if (loops_.empty()) {
      add(Op::stray_exit, current_);
    } else {
      loops_.back().push_back(add(Op::go, current_));
    }
  }
  void lower(const ir::If& n) {
    const auto branch = add(Op::branch_false, current_);
    body(n.then_body);
    if (!n.has_else && n.else_body.empty()) {
      land(branch);
    } else {
      mark_line(n.else_line);
      const auto out = add(Op::go);
      land(branch);
      body(n.else_body);
      land(out);
    }
    mark_line(n.end_line);
    add(Op::nothing);
  }
  /// The line of an IF is left out, the lines behind it are not: its body is carried out up to ELSE.
  void without_condition(const ir::If& n) {
    add(Op::nothing);
    body(n.then_body);
    if (n.has_else || !n.else_body.empty()) {
      mark_line(n.else_line);
      const bool line_skipped = (n.else_line.skip_mask & skip_mask_) != 0;
      const auto out = line_skipped ? nowhere : add(Op::go);
      body(n.else_body);
      if (!line_skipped) land(out);
    }
    mark_line(n.end_line);
    add(Op::nothing);
  }
  void lower(const ir::While& n) {
    const auto top = add(Op::branch_false, current_);
    loop_body(n.body, n.end_line, top);
    land(top);
    end_loop();
  }
  void lower(const ir::Loop& n) {
    const auto top = add(Op::nothing, current_);
    loop_body(n.body, n.end_line, top);
    end_loop();
  }
  void lower(const ir::Until& n) {
    const auto* s = current_;
    const auto top = add(Op::nothing);
    loops_.emplace_back();
    body(n.body);
    mark_line(n.end_line);
    add(Op::branch_false, s, top);
    end_loop();
  }
  void lower(const ir::For& n) {
    const auto* s = current_;
    add(Op::for_begin, s);
    const auto test = add(Op::for_test, s);
    loops_.emplace_back();
    body(n.body);
    mark_line(n.end_line);
    add(Op::for_step, s, test);
    land(test);
    end_loop();
  }

  void loop_body(const ir::Body& b, const ir::LineInfo& end_line, std::uint32_t top) {
    loops_.emplace_back();
    body(b);
    mark_line(end_line);
    add(Op::go, nullptr, top);
  }
  void end_loop() {
    for (const auto exit : loops_.back()) land(exit);
    loops_.pop_back();
    add(Op::nothing);
  }

  Flow& flow_;
  const Options& options_;
  std::uint16_t skip_mask_;
  const ir::Statement* current_ = nullptr;
  std::vector<std::vector<std::uint32_t>> loops_;  ///< exits of the open loops
};

void collect_locals(const ir::Program& program, const ir::Routine& routine, Flow& flow) {
  const auto add = [&flow](const std::string& name, ir::Type type, std::string_view spelt = {}) {
    if (name.empty() || flow.names.locals.contains(name)) return;
    flow.names.locals[name] = {static_cast<std::uint32_t>(flow.locals.size()), type == ir::Type::string};
    auto& v = flow.locals.emplace_back();
    v.name = name;
    v.declared = true;
    if (!spelt.empty()) v.limits = ir::declared_limits(spelt);
    v.shape(type, {});
  };
  const auto is_routine = [&program](ir::SpaceId id) {
    return id >= program.spaces.size() ||
           (program.spaces[id].named() && program.spaces[id].scope == ir::Scope::routine);
  };
  for (const auto& p : routine.parameters) {
    if (!p.variable.name.empty() && is_routine(p.variable.space)) add(p.variable.name, p.type, p.type_text);
  }
  ir::for_each_statement(routine.body, [&](const ir::Statement& s) {
    const auto* d = std::get_if<ir::Declare>(&s.node);
    if (d == nullptr || !is_routine(d->space)) return;
    for (const auto& item : d->items) add(item.name, d->type);
  });
}

}  // namespace

std::string fault_text(const Diagnostic& fault) {
  return "this line has an error and is not carried out (" + fault.code + ": " + fault.message + ")";
}

Flow build_flow(const ir::Program& program, const ir::Routine& routine, const Options& options) {
  Flow flow;
  flow.routine = &routine;
  flow.program = &program;
  flow.names.program = &program;
  collect_locals(program, routine, flow);
  Builder builder(flow, options);
  builder.header(routine);
  builder.body(routine.body);
  for (auto& [key, places] : flow.labels) {
    std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  }
  return flow;
}

}  // namespace cnctrans::interpreter
