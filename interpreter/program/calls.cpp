// Calls, repeated parts, returns.
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "interpreter/program/runner.h"
#include "interpreter/trace/run_codes.h"

namespace cnctrans::interpreter {

namespace {
constexpr std::size_t deepest_repeat = 200;
}

void Runner::repeat(const ir::Repeat& r) {
  std::int64_t count = 1;
  if (!whole_number(r.count, 1, count)) return;
  if (!curve_statement(r)) return;
  if (count <= 0 || r.curve_use == ir::CurveUse::define || r.curve_use == ir::CurveUse::remove) {
    go_to(at_ + 1);
    return;
  }
  if (r.has_program && r.curve_use == ir::CurveUse::run) {
    failure_.fail(code::not_carried, "a curve whose points stand in another program is not carried out");
    return;
  }
  if (r.has_program) {
    auto* other = routines_.find(r.program, *flow_);
    if (other == nullptr) {
      failure_.fail(code::routine_missing, "there is no program " + routine_text(r.program));
      return;
    }
    std::uint32_t begin = 0, end = 0;
    if (!range_in(*other, r.first, r.last, r.order_free, begin, end)) return;
    if (!enter(*other, {}, ir::CallLevel::shared, at_ + 1, count)) return;
    auto& a = calls_.back();
    a.entry = begin;
    a.stop = end;
    enter_top();
    at_ = begin;
    return;
  }
  std::string first, last, missing;
  if (!label_of(r.first, first) || !label_of(r.last, last)) return;
  std::uint32_t begin = 0, end = 0;
  if (!flow_->range(first, last, r.search, r.order_free, at_, begin, end, missing)) {
    failure_.fail(code::label_missing, "there is no block labelled " + missing);
    return;
  }
  if (repeats_.size() >= deepest_repeat) {
    failure_.fail(code::repeat_depth, "repeated parts are nested without end");
    return;
  }
  repeats_.push_back(
      {begin, end, at_ + 1, count, false, r.search == ir::Search::whole_first ? std::string{} : last, end});
  repeats_.back().curve = r.curve_use == ir::CurveUse::run;
  if (repeats_.back().curve) machine_.begin_defined_curve();
  repeat_end_ = end;
  at_ = begin;
}

/// Curves with a number: defined, deleted; one that runs must be defined.
bool Runner::curve_statement(const ir::Repeat& r) {
  switch (r.curve_use) {
    case ir::CurveUse::none: return true;
    case ir::CurveUse::define: return curves_.insert(r.curve).second || true;
    case ir::CurveUse::remove: return curves_.erase(r.curve) != 0 || true;
    case ir::CurveUse::run: break;
  }
  if (curves_.contains(r.curve)) return true;
  return failure_.fail(code::curve_data, "there is no curve " + std::to_string(r.curve) + " at this moment");
}

bool Runner::range_in(Flow& flow, const ir::LabelRef& first, const ir::LabelRef& last, bool order_free,
                      std::uint32_t& begin, std::uint32_t& end) {
  std::string a, b, missing;
  if (!label_of(first, a) || !label_of(last, b)) return false;
  if (b.empty()) b = a;
  if (flow.range(a, b, ir::Search::whole_first, order_free, 0, begin, end, missing)) return true;
  return failure_.fail(code::label_missing,
                       "there is no block labelled " + missing + " in program " + routine_text(flow.routine->name));
}

// --- calls -----------------------------------------------------------------------------------------------------

/// `/_N_SPF_DIR/_N_CB_SPF` as the program that it names: CB, by the parts that the machine's names may have.
std::string Runner::bare_name(std::string name) const {
  const std::string& parts = profile_.policies.call_decoration;
  if (parts.empty()) return name;
  const auto folder = name.rfind('/');
  if (folder != std::string::npos) name.erase(0, folder + 1);
  std::string_view rest = parts;
  for (bool prefix = true; !rest.empty(); prefix = false) {
    const std::string_view part = rest.substr(0, rest.find('|'));
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
    if (name.size() <= part.size()) continue;
    if (prefix && name.starts_with(part)) name.erase(0, part.size());
    if (prefix || !name.ends_with(part)) continue;
    name.resize(name.size() - part.size());
    break;
  }
  return name;
}

Flow* Runner::callee_of(const ir::CallRoutine& c) {
  ir::RoutineName name = c.routine;
  if (c.computed) {
    const auto id = evaluator_.id_of(c.computed);
    if (evaluator_.is_text(id)) {
      name = {-1, bare_name(to_upper_ascii(trim(evaluator_.text(id))))};
    } else {
      const double n = std::round(evaluator_.number(id));
      name = {n >= 0 && n < 1e9 ? static_cast<std::int64_t>(n) : -1, {}};
    }
    if (failure_.set) return nullptr;
  }
  Flow* flow = nullptr;
  if (!written_routine(name, flow)) return nullptr;
  if (flow == nullptr) flow = routines_.find(name, *flow_);
  if (flow == nullptr && !c.optional) {
    if (profile_.policies.call_missing == machine::CallMissing::passed_over) {
      if (c.computed)
        diagnostics_.warning(code::passed_over, failure_.where,
                             "there is no subprogram " + routine_text(name) + "; the run goes past the call");
      return nullptr;
    }
    const bool program = !name.text.empty() && name.text.find_first_not_of("0123456789") == std::string::npos;
    failure_.fail(code::routine_missing,
                  (program ? "there is no program " : "there is no subprogram ") + routine_text(name));
  }
  return flow;
}

void Runner::call(const ir::CallRoutine& c) {
  std::int64_t count = 1;
  if (!whole_number(c.count, 1, count)) return;
  auto* callee = callee_of(c);
  if (failure_.set) return;
  if (callee == nullptr || count <= 0) {
    go_to(at_ + 1);
    return;
  }
  std::uint32_t begin = 0, end = nowhere;
  if (c.has_range && !range_in(*callee, c.first, c.last, true, begin, end)) return;
  std::vector<Bound> arguments;
  if (!bind(c, *callee, arguments)) return;
  const auto back = c.tail ? static_cast<std::uint32_t>(flow_->code.size()) : at_ + 1;
  if (!enter(*callee, arguments, c.level, back, count)) return;
  auto& a = calls_.back();
  a.entry = begin;
  a.stop = end;
  enter_top();
  at_ = begin;
}

void Runner::modal_call(const ir::ModalCall& m) {
  modal_ = {};
  if (m.off && m.here) return go_to(at_ + 1);  // a modal cycle stays in force
  if (!machine_.modal_cycle(m.off ? nullptr : m.cycle, ir::CycleTrigger::path_motion, m.here)) return;
  if (!m.off && !m.cycle) {
    auto* callee = callee_of(m.call);
    if (failure_.set) return;
    // A program, not a subprogram, in a program that runs so itself.
    if (callee != nullptr && in_modal_ != 0 && callee->routine->kind == ir::RoutineKind::main &&
        profile_.policies.call_modal_in_modal == machine::CallModalInModal::refused) {
      failure_.fail(code::modal_in_modal, "the program " + routine_text(callee->routine->name) +
                                              " is called modally within a program that is called so itself");
      return;
    }
    if (callee != nullptr) {
      modal_.active = true;
      modal_.call = &m.call;
      modal_.flow = callee;
      if (!bind(m.call, *callee, modal_.arguments)) return;
      if (m.here) {
        run_modal_call(at_ + 1);
        return;
      }
    }
  }
  go_to(at_ + 1);
}

/// `next`: where control goes on behind it.
void Runner::run_modal_call(std::uint32_t next) {
  const bool goes_on = modal_.keeps_locals;
  if (!enter(*modal_.flow, modal_.arguments, modal_.call->level, next, 1)) return;
  if (goes_on && calls_.back().opened_level) {
    auto& level = variables_.level();
    level.value = modal_.left_behind.value;
    level.set = modal_.left_behind.set;
  }
  calls_.back().modal = true;
  ++in_modal_;
  at_ = 0;
}

// --- arguments -------------------------------------------------------------------------------------------------

/// Values of the arguments, in the caller's eyes.
bool Runner::bind(const ir::CallRoutine& c, Flow& callee, std::vector<Bound>& out) {
  const auto& parameters = callee.routine->parameters;
  for (std::size_t i = 0; i < c.arguments.size(); ++i) {
    const auto& a = c.arguments[i];
    Bound b;
    if (!a.value && !a.by_reference) {
      if (a.name.empty() && i >= parameters.size()) {
        return failure_.fail(code::argument, "subprogram " + routine_text(callee.routine->name) + " takes " +
                                                 std::to_string(parameters.size()) + " arguments");
      }
      continue;
    }
    if (!bind_one(a, i, callee, b)) return false;
    out.push_back(std::move(b));
  }
  return true;
}

bool Runner::bind_one(const ir::Argument& a, std::size_t position, Flow& callee, Bound& out) {
  const auto& parameters = callee.routine->parameters;
  const auto& routine = callee.routine->name;
  out.position = static_cast<unsigned>(position);
  if (a.name.empty()) {
    if (position >= parameters.size()) {
      return failure_.fail(code::argument, "subprogram " + routine_text(routine) + " takes " +
                                               std::to_string(parameters.size()) + " arguments");
    }
    out.parameter = &parameters[position];
  } else {
    const auto it = std::find_if(parameters.begin(), parameters.end(), [&](const auto& p) { return p.name == a.name; });
    if (it != parameters.end()) out.parameter = &*it;
  }
  if (out.parameter == nullptr || out.parameter->variable.name.empty()) {
    // A letter stands for the level variable of its place in the alphabet; or the variable itself is named.
    auto* space = variables_.level_space();
    const auto digits = a.name.find_first_of("0123456789");
    double n = -1;
    if (digits != std::string::npos && digits > 0) {
      space = variables_.numbered(a.name.substr(0, digits));
      n = parse_decimal(std::string_view(a.name).substr(digits)).value_or(-1);
    } else if (a.name.size() == 1 && a.name[0] >= 'A' && a.name[0] <= 'Z') {
      n = a.name[0] - 'A';
    }
    if (out.parameter != nullptr && out.parameter->variable.index) {
      n = ir::constant_value(out.parameter->variable.index).value_or(n);
    }
    if (space == nullptr || space->find(n) == nullptr) {
      return failure_.fail(code::argument, "subprogram " + routine_text(routine) + " has no parameter " + a.name);
    }
    out.space = space;
    out.number = static_cast<std::uint32_t>(n);
    out.position = out.number;
  }
  out.given = true;
  if (out.parameter != nullptr && out.parameter->by_reference && out.space == nullptr) {
    // The caller may not know the signature (another file): a plain variable is handed over as such.
    const auto* variable = a.value ? std::get_if<ir::VarRef>(&a.value->node) : nullptr;
    if (a.by_reference) variable = &a.reference;
    if (variable != nullptr) {
      out.by_reference = true;
      return evaluator_.place(*variable, flow_->names, out.reference, true);
    }
  }
  if (a.value) {
    const auto id = evaluator_.id_of(a.value);
    out.is_text = evaluator_.is_text(id);
    if (out.is_text) {
      out.text = evaluator_.text(id);
    } else {
      out.value = evaluator_.number(id);
    }
    return !failure_.set;
  }
  Place p;
  if (!evaluator_.place(a.reference, flow_->names, p)) return false;
  out.is_text = p.named != nullptr && p.named->is_text();
  if (out.is_text) {
    out.text = Variables::text(p);
  } else {
    out.value = Variables::number(p);
  }
  return true;
}

bool Runner::enter(Flow& callee, const std::vector<Bound>& arguments, ir::CallLevel level, std::uint32_t return_to,
                   std::int64_t count) {
  if (calls_.size() > static_cast<std::size_t>(std::max(1, profile_.call_depth))) {
    return failure_.fail(code::call_depth, "more than " + std::to_string(profile_.call_depth) +
                                               " calls are open at once (a subprogram that calls itself without end?)");
  }
  const bool opens = level == ir::CallLevel::new_level;
  if (opens) {
    if (local_levels_ != 0 && variables_.depth() >= local_levels_) {
      return failure_.fail(code::level_depth,
                           "more than " + std::to_string(local_levels_) + " levels of local parameters are open");
    }
    variables_.push_level();
  }
  auto& a = calls_.emplace_back();
  a.flow = &callee;
  a.return_to = return_to;
  a.left = count;
  a.opened_level = opens;
  a.caller_arguments = variables_.level().arguments;
  if (!callee.routine->parameters.empty()) variables_.level().arguments = 0;
  a.repeats = repeats_.size();
  if (callee.routine->saves_modals) a.saved = machine_.modal();
  for (const auto& shape : callee.locals) a.locals.push_back({shape, false, {}});
  enter_top();
  if (count > 1) a.arguments = arguments;
  const bool done = hand_over(arguments);
  machine_.arguments_given = variables_.level().arguments;
  return done;
}

/// The values go to the parameters of the routine just entered; those not given get their defaults.
bool Runner::hand_over(const std::vector<Bound>& arguments, bool again) {
  for (const auto& b : arguments) {
    if (!set_parameter(b)) return false;
    if (b.position < 64) variables_.level().arguments |= std::uint64_t{1} << b.position;
  }
  for (const auto& p : flow_->routine->parameters) {
    const bool given =
        std::any_of(arguments.begin(), arguments.end(), [&](const Bound& b) { return b.parameter == &p; });
    if (given) continue;
    Place place;
    if (p.default_value) {
      if (!evaluator_.place(p.variable, flow_->names, place)) return false;
      if (!evaluator_.assign(place, evaluator_.id_of(p.default_value))) return false;
      continue;
    }
    // Left out without a default: empty again in each repetition, whatever the pass before has written into it.
    if (!again || p.by_reference || !flow_->names.locals.contains(p.variable.name)) continue;
    if (!evaluator_.place(p.variable, flow_->names, place)) return false;
    if (place.named != nullptr && place.named->is_text()) {
      variables_.store(place, std::string{});
    } else if (!variables_.store(place, 0.0)) {
      return false;
    }
  }
  return true;
}

bool Runner::set_parameter(const Bound& b) {
  Place p;
  if (b.space != nullptr) {
    if (!variables_.place(*b.space, b.number, p)) return false;
  } else {
    const auto it = flow_->names.locals.find(b.parameter->variable.name);
    if (b.by_reference && it != flow_->names.locals.end()) {
      auto& local = calls_.back().locals[it->second.index];
      local.reference = true;
      local.target = b.reference;
      return true;
    }
    if (!evaluator_.place(b.parameter->variable, flow_->names, p)) return false;
  }
  const bool to_text = p.named != nullptr && p.named->is_text();
  if (to_text != b.is_text) {
    return failure_.fail(code::wrong_type, "an argument is a " + std::string(b.is_text ? "text" : "number") +
                                               " where the parameter is a " + (to_text ? "text" : "number"));
  }
  if (to_text) {
    variables_.store(p, b.text);
    return true;
  }
  return variables_.store(p, b.value);
}

// --- returns ---------------------------------------------------------------------------------------------------

/// The routine is left, by its end or by a return. A return inside a repeated part ends the repetition only.
void Runner::leave(bool returned) {
  auto& a = calls_.back();
  if (returned && repeats_.size() > a.repeats) {
    const auto back = repeats_.back().return_to;
    repeats_.pop_back();
    enter_top();
    go_to(back);
    return;
  }
  repeats_.resize(a.repeats);
  if (calls_.size() == 1) {
    state_ = State::ended;
    return;
  }
  if (--a.left > 0) {  // what the last pass made of its parameters is gone, and each pass ends the routine (SAVE)
    enter_top();
    if (a.saved) machine_.restore_modal(*a.saved);
    const std::vector<Bound> arguments = a.arguments;
    if (hand_over(arguments, true)) at_ = a.entry;
    return;
  }
  go_to(close_call());
}

/// The call is left for good; where its caller goes on.
std::uint32_t Runner::close_call() {
  auto& a = calls_.back();
  variables_.leave(a.locals, static_cast<std::uint32_t>(calls_.size() - 1));
  if (a.modal && a.opened_level) modal_.left_behind = variables_.level();
  if (a.opened_level)
    variables_.pop_level();
  else
    variables_.level().arguments = a.caller_arguments;
  if (a.modal) --in_modal_;
  if (a.saved) machine_.restore_modal(*a.saved);
  const auto back = a.return_to;
  calls_.pop_back();
  enter_top();
  return back;
}

/// A return with values goes on elsewhere: at a label of the caller (none: behind the call), there or behind its block,
/// so many calls up.
void Runner::give_back(const ir::Return& r) {
  if (r.values.empty()) return leave(true);
  std::int64_t behind = 0, levels = 1;
  const auto target = evaluator_.text(evaluator_.id_of(r.values[0]));
  if (r.values.size() > 1 && !whole_number(r.values[1], 0, behind)) return;
  if (r.values.size() > 2 && !whole_number(r.values[2], 1, levels)) return;
  if (failure_.set) return;
  if (levels < 1 || static_cast<std::size_t>(levels) >= calls_.size()) {
    failure_.fail(code::bad_count, "a return over " + std::to_string(levels) + " levels of calls, and " +
                                       std::to_string(calls_.size() - 1) + " are open");
    return;
  }
  repeats_.resize(calls_[calls_.size() - static_cast<std::size_t>(levels)].repeats);
  std::uint32_t back = 0;
  for (std::int64_t i = 0; i < levels; ++i) back = close_call();
  if (target.empty()) return go_to(back);
  std::string key;
  if (!computed_label(r.values[0], key)) return;
  const auto* place = flow_->find(key, ir::Search::forward_then_backward, back - 1);
  if (place == nullptr) {
    failure_.fail(code::label_missing, "there is no block labelled " + label_text(key) + " in program " +
                                           routine_text(flow_->routine->name));
    return;
  }
  at_ = behind > 0 ? place->end : place->begin;
  left_behind();
}

void Runner::end_program(const ir::End& e) {
  open_file_ = no_file;
  if (e.returns_from_sub && calls_.size() > 1) {
    repeats_.resize(calls_.back().repeats);
    leave(true);
    return;
  }
  state_ = State::ended;
}

}  // namespace cnctrans::interpreter
