// Statements that stay within one routine.
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "interpreter/program/runner.h"
#include "interpreter/trace/message_form.h"
#include "interpreter/trace/run_codes.h"
#include "ir/cycles/milling/mill_contour.h"
#include "ir/cycles/milling/pocket_call.h"

namespace cnctrans::interpreter {

void Runner::block(Instruction& in) {
  const auto& b = std::get<ir::Block>(in.statement->node);
  const auto& where = in.statement->line.span;
  ++blocks_;
  bool cycle = true, again = false;
  if (b.repeat_given != 0) {
    again = !repeats_.empty() && repeats_.size() > calls_.back().repeats && repeats_.back().block &&
            repeats_.back().begin == at_;
    if (!again) {
      const double n = std::round(b.repeat.expr ? evaluator_.number_of(b.repeat.expr) : b.repeat.number);
      if (failure_.set) return;
      if (!(n >= 0) || n > 1e9) {
        failure_.fail(code::bad_count, "a block cannot be repeated " + number_text(n) + " times");
        return;
      }
      cycle = n > 0;
      if (n > 1) {
        repeats_.push_back({at_, at_ + 1, at_ + 1, static_cast<std::int64_t>(n), true, {}, 0});
        repeat_end_ = at_ + 1;
      }
    }
  }
  const Flow* home = flow_;
  for (const auto& a : b.actions) {  // a cycle whose profile is a program of its own
    const auto* d = std::get_if<ir::CycleDefine>(&a.data);
    if (d == nullptr || !d->cycle) continue;
    const auto* named = std::get_if<ir::NamedCycle>(&d->cycle->node);
    BlockMachine::ContourHomes homes;
    for (auto& profile : ir::cycles::contour_routines(*d->cycle)) {
      const Flow* other = routines_.find(profile, *flow_);
      if (other == nullptr) continue;
      if (named != nullptr && !ir::cycles::is_pocket_cycle(named->name)) home = other;
      homes.emplace_back(std::move(profile), other->program);
    }
    machine_.contour_homes(std::move(homes));
  }
  machine_.belongs_to(home->program, home->routine);
  machine_.block_again = again;
  machine_.single_points = modal_.active && in_modal_ == 0;
  if (!machine_.block(b, where, cycle)) {
    fail_state();
    return;
  }
  if (emitter_.limit_reached()) {
    state_ = State::event_limit;
    return;
  }
  if (modal_.active && cycle && in_modal_ == 0 && machine_.runs_modal_call(b)) {
    modal_.keeps_locals = again;
    run_modal_call(machine_.points_left() ? at_ : at_ + 1);
    return;
  }
  go_to(at_ + 1);
}

void Runner::assign(const ir::Statement& s) {
  for (const auto& item : std::get<ir::Assign>(s.node).items) {
    if (item.value && item.value->type == ir::Type::frame) {
      const Frame f = evaluator_.frame(*item.value);
      if (failure_.set) return;
      if (item.to_system) {
        const auto args = evaluator_.arguments(item.system);
        if (failure_.set || !machine_.write_frame(item.system, args, f)) return;
        continue;
      }
      Place p;
      if (!evaluator_.place(item.target, flow_->names, p)) return;
      if (p.named == nullptr || !p.named->is_frame()) {
        failure_.fail(code::wrong_type, "a frame goes to a variable of type frame only");
        return;
      }
      p.named->frame[p.index] = f;
      continue;
    }
    if (item.to_system) {
      const double x = evaluator_.number_of(item.value);
      const auto args = evaluator_.arguments(item.system);
      if (failure_.set || !machine_.write(item.system, args, x)) return;
      continue;
    }
    const auto value = evaluator_.id_of(item.value);
    Place p;
    if (!evaluator_.place(item.target, flow_->names, p) || !evaluator_.assign(p, value)) return;
  }
}

bool Runner::condition(Instruction& in) {
  if (in.expr == no_expr) {
    const ir::ExprPtr* e = nullptr;
    if (const auto* i = std::get_if<ir::If>(&in.statement->node)) e = &i->condition;
    if (const auto* w = std::get_if<ir::While>(&in.statement->node)) e = &w->condition;
    if (const auto* u = std::get_if<ir::Until>(&in.statement->node)) e = &u->condition;
    in.expr = evaluator_.id_of(*e);
  }
  return note_outcome(in, evaluator_.number(in.expr) != 0);
}

/// For the coverage of branches.
bool Runner::note_outcome(const Instruction& in, bool holds) {
  const auto id = in.statement->id;
  if (failure_.set || id == 0 || flow_->program != &program_) return holds;
  if (id >= outcomes_.size()) outcomes_.resize(id + std::size_t{1} + outcomes_.size(), 0);
  outcomes_[id] |= holds ? Result::held : Result::failed;
  return holds;
}

void Runner::for_begin(const ir::For& f) {
  Place p;
  const double x = evaluator_.number_of(f.from);
  if (!failure_.set && evaluator_.place(f.counter, flow_->names, p)) Variables::assign(p, x);
}

bool Runner::for_test(const ir::For& f) {
  Place p;
  if (!evaluator_.place(f.counter, flow_->names, p)) return false;
  const double to = evaluator_.number_of(f.to);
  const double step = f.step ? evaluator_.number_of(f.step) : 1;
  variables_.note_read(p);  // a jump may have gone round the start of the loop
  const double x = Variables::number(p);
  return step >= 0 ? x <= to : x >= to;
}

void Runner::for_step(const ir::For& f) {
  Place p;
  if (!evaluator_.place(f.counter, flow_->names, p)) return;
  const double step = f.step ? evaluator_.number_of(f.step) : 1;
  variables_.note_read(p);
  Variables::assign(p, Variables::number(p) + step);
}

// --- jumps -----------------------------------------------------------------------------------------------------

/// A label found at run time: a number is a block number; a text is an identifier, or a block number with or without N.
bool Runner::computed_label(const ir::ExprPtr& e, std::string& key) {
  const auto id = evaluator_.id_of(e);
  if (!evaluator_.is_text(id)) {
    const double n = evaluator_.number(id);
    if (failure_.set) return false;
    if (n < 0 || n != std::floor(n)) return failure_.fail(code::label_missing, "there is no block N" + number_text(n));
    key = "#" + number_text(n);
    return true;
  }
  key = to_upper_ascii(trim(evaluator_.text(id)));
  if (failure_.set) return false;
  if (flow_->labels.contains(key)) return true;
  std::string_view digits = key;
  if (!digits.empty() && (digits[0] == 'N' || digits[0] == ':')) digits.remove_prefix(1);
  if (!digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos)
    key = label_key(digits, true);
  return true;
}

bool Runner::label_of(const ir::LabelRef& l, std::string& key) {
  if (l.computed) return computed_label(l.computed, key);
  key = l.text.empty() ? std::string{} : label_key(l);
  return true;
}

void Runner::jump(Instruction& in) {
  const auto& j = *in.jump_node;
  if (j.condition) {
    if (in.expr == no_expr) in.expr = evaluator_.id_of(j.condition);
    const bool taken = note_outcome(in, evaluator_.number(in.expr) != 0);
    if (failure_.set) return;
    if (!taken) {
      go_to(at_ + 1);
      return;
    }
  }
  if (in.target != nowhere) {
    at_ = in.target;
    return left_behind();
  }
  take(j, j.target.computed ? nullptr : &in.target);
}

/// Goes to the label; a fixed target is remembered in `known`.
void Runner::take(const ir::Jump& j, std::uint32_t* known) {
  if (j.search == ir::Search::to_start) {
    at_ = 0;
    return;
  }
  std::string key;
  if (!label_of(j.target, key)) return;
  const auto* p = flow_->find(key, j.search, at_);
  if (p != nullptr) {
    at_ = p->begin;
    if (known != nullptr) *known = p->begin;
    left_behind();
  } else if (j.quiet) {
    go_to(at_ + 1);
  } else {
    failure_.fail(code::label_missing, "there is no block labelled " + label_text(key));
  }
}

void Runner::choose(const ir::Switch& s) {
  const double x = evaluator_.number_of(s.value);
  for (const auto& [value, target] : s.cases) {
    const double y = evaluator_.number_of(value);
    if (failure_.set) return;
    if (x == y) {
      take(target, nullptr);
      return;
    }
  }
  if (!s.fallback.empty()) {
    take(s.fallback.front(), nullptr);
  } else {
    go_to(at_ + 1);
  }
}

/// A count rounded to a whole number; `otherwise` when it is not given.
bool Runner::whole_number(const ir::ExprPtr& e, std::int64_t otherwise, std::int64_t& out) {
  out = otherwise;
  if (!e) return true;
  const double n = std::round(evaluator_.number_of(e));
  if (failure_.set) return false;
  if (!(std::abs(n) < 1e12)) return failure_.fail(code::bad_count, "a count of " + number_text(n));
  out = static_cast<std::int64_t>(n);
  return true;
}

// --- texts and declarations ------------------------------------------------------------------------------------

void Runner::message(const ir::Message& m, const Span& where) {
  if (m.kind == ir::MessageKind::clear) return;
  std::string text, marked;
  const auto file = ir::file_statement(m);
  const bool into_file = file.has_value();
  for (const auto& part : m.parts) {
    if (!part) continue;
    std::string shown = evaluator_.shown(evaluator_.id_of(part));
    if (into_file && failure_.set && failure_.code == code::no_datum) {  // the way does not depend on it
      failure_.set = false;
      shown = "?";
    }
    text += shown;
    marked += std::holds_alternative<ir::String>(part->node) ? shown : marked_value(shown);
  }
  if (failure_.set || (file && !write_file(*file, text))) return;
  if (file && file->use != ir::FileUse::line) return;
  machine_.message(marked, where);
  if (emitter_.limit_reached()) state_ = State::event_limit;
  if (m.kind != ir::MessageKind::error) return;
  std::string number;
  if (m.number) number = " " + number_text(evaluator_.number_of(m.number));
  const auto shown = std::string(trim(text));
  failure_.fail(code::program_error, "the program stops with error" + number + (shown.empty() ? "" : ": " + shown));
}

void Runner::declare(const ir::Declare& d) {
  for (const auto& item : d.items) {
    declare_one(d, item);
    if (failure_.set) return;
  }
}

void Runner::declare_one(const ir::Declare& d, const ir::Declare::Item& item) {
  NamedVariable* v = nullptr;
  if (const auto it = flow_->names.locals.find(item.name); it != flow_->names.locals.end()) {
    auto& local = calls_.back().locals[it->second.index];
    if (local.reference) return;
    v = &local.own;
  } else {
    v = &variables_.global(item.name);
  }
  std::vector<std::uint32_t> dimensions;
  std::size_t count = 1;
  for (const auto& e : item.dimensions) {
    std::int64_t n = 0;
    if (!whole_number(e, 0, n)) return;
    if (n < 1 || n > 1'000'000 || count * static_cast<std::size_t>(n) > 1'000'000) {
      failure_.fail(code::array_index, "array " + item.name + " cannot have " + std::to_string(n) + " elements");
      return;
    }
    dimensions.push_back(static_cast<std::uint32_t>(n));
    count *= static_cast<std::size_t>(n);
  }
  v->declared = true;
  v->limits = ir::declared_limits(d.type_text);
  v->shape(d.type, std::move(dimensions));
  if (const double start = v->limits.start(); start != 0) v->number.assign(v->number.size(), start);
  Place p;
  p.named = v;
  for (std::size_t i = 0; i < count && i < item.initial.size(); ++i) {  // elements without a value stay 0
    const auto& e = item.initial[i];
    p.index = static_cast<std::uint32_t>(i);
    if (e && !evaluator_.assign(p, evaluator_.id_of(e))) return;
  }
  const bool deeper = calls_.size() > 1 && flow_->names.locals.contains(item.name);
  if (!deeper) variables_.apply_presets(*v);
}

}  // namespace cnctrans::interpreter
