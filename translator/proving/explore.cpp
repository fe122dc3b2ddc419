#include "translator/proving/explore.h"

#include <algorithm>
#include <deque>

#include "base/text.h"
#include "ir/edit/rewrite.h"
#include "legaliser/data/given_data.h"

namespace cnctrans::translator {

namespace {

constexpr std::size_t most_values = 24;  ///< tried of one variable

/// As --set names it; empty: its number is computed.
std::string name_of(const ir::Program& program, const ir::VarRef& v) {
  if (!v.name.empty()) return v.indices.empty() ? to_upper_ascii(v.name) : std::string();
  if (v.space >= program.spaces.size() || !v.index) return {};
  const auto n = ir::constant_value(v.index);
  return n ? program.spaces[v.space].prefix + shortest(*n) : std::string();
}

std::set<std::string> variables_of(const ir::Program& program, const ir::ExprPtr& e) {
  std::set<std::string> names;
  ir::walk(e, [&](const ir::ExprPtr& node) {
    if (const auto* v = std::get_if<ir::VarRef>(&node->node)) {
      if (auto name = name_of(program, *v); !name.empty()) names.insert(std::move(name));
    } else if (const auto* datum = std::get_if<ir::SystemRef>(&node->node); datum != nullptr && !datum->text.empty()) {
      names.insert(ir::passes::name_of_datum(*datum, program));  // tried where the map of names places it
    }
  });
  return names;
}

/// The control itself puts the variable to 0 at the start.
bool zeroed(const std::vector<ir::VariableSpace>& spaces, const std::string& name) {
  for (const auto& space : spaces) {
    if (space.named() || !space.starts_at_zero || name.rfind(space.prefix, 0) != 0) continue;
    const auto n = parse_decimal(std::string_view(name).substr(space.prefix.size()));
    for (const auto& part : space.segments) {
      if (n && *n >= static_cast<double>(part.lo) && *n <= static_cast<double>(part.hi)) return !part.persistent;
    }
  }
  return false;
}

const std::string* text_of(const ir::ExprPtr& e) {
  const auto* s = e ? std::get_if<ir::String>(&e->node) : nullptr;
  return s != nullptr ? &s->text : nullptr;
}

}  // namespace

std::string plain_name(const std::string& name) {
  std::string text = to_upper_ascii(name);
  std::erase_if(text, [](char c) { return c == '[' || c == ']'; });
  return text;
}

std::uint16_t skip_switches(const ir::Program& program) {
  unsigned mask = 0;
  for (const auto& routine : program.routines)
    ir::for_each_statement(routine.body, [&mask](const ir::Statement& s) { mask |= s.line.skip_mask; });
  return static_cast<std::uint16_t>(mask);
}

std::string skip_option(std::uint16_t mask, int first) {
  std::string levels;
  for (int bit = 0; bit < 16; ++bit) {
    if ((mask >> bit & 1) != 0) levels += (levels.empty() ? "" : ",") + std::to_string(bit + first);
  }
  return levels.empty() ? levels : "--skip " + levels;
}

Explorer::Explorer(const ir::Program& program, Inputs start, std::function<bool(const std::string&)> settable)
    : start_(std::move(start)),
      settable_([spaces = program.spaces, known = std::move(settable)](const std::string& name) {
        return !zeroed(spaces, name) && known(name);
      }) {
  skips_ = skip_switches(program);
  for (const auto& routine : program.routines) {
    for (const auto& p : routine.parameters) defined_.insert(name_of(program, p.variable));
    ir::for_each_statement(routine.body, [&](const ir::Statement& s) { collect(program, routine, s); });
  }
  spread_values(program);
}

void Explorer::add_value(const std::string& variable, std::string value) {
  auto& values = known_[variable].values;
  if (values.size() < most_values && std::find(values.begin(), values.end(), value) == values.end())
    values.push_back(std::move(value));
}

void Explorer::add_number(const std::string& variable, double value, bool around) {
  add_value(variable, shortest(value));
  if (!around) return;
  add_value(variable, shortest(value + 1));
  add_value(variable, shortest(value - 1));
}

void Explorer::assigned(const ir::Program& program, const ir::VarRef& target, const ir::ExprPtr& value) {
  const std::string name = name_of(program, target);
  if (name.empty()) return;
  known_[name].set_from.merge(variables_of(program, value));
  if (const auto* b = value ? std::get_if<ir::Binary>(&value->node) : nullptr;
      b != nullptr && (ir::constant_value(b->left) || ir::constant_value(b->right)))
    known_[name].sums.push_back(value);
}

/// What the variable of `sum` (one variable, one number) must be for it to come to `wanted`; nullopt: nothing does.
std::optional<double> Explorer::solved(const ir::Binary& sum, double wanted) {
  const auto left = ir::constant_value(sum.left), right = ir::constant_value(sum.right);
  const double c = left ? *left : *right;
  switch (sum.op) {
    case ir::BinaryOp::add: return wanted - c;
    case ir::BinaryOp::subtract: return left ? c - wanted : wanted + c;
    case ir::BinaryOp::multiply: return c != 0 ? std::optional(wanted / c) : std::nullopt;
    case ir::BinaryOp::divide:
      if (!left) return wanted * c;
      return wanted != 0 ? std::optional(c / wanted) : std::nullopt;
    default: return std::nullopt;
  }
}

/// A statement that goes one way or another by `e`.
void Explorer::branch(const ir::Program& program, const ir::Statement& s, const ir::ExprPtr& e, bool two_ways) {
  Branch b{s.id, s.line.span.file, s.line.span.line, two_ways, variables_of(program, e)};
  for (const auto& v : b.variables) known_[v];
  ir::walk(e, [&](const ir::ExprPtr& node) {
    const auto* relation = std::get_if<ir::Binary>(&node->node);
    if (relation == nullptr || !ir::is_comparison(relation->op)) return;
    for (const auto& [side, other] :
         {std::pair(&relation->left, &relation->right), {&relation->right, &relation->left}}) {
      for (const auto& v : variables_of(program, *side)) {
        if (const auto n = ir::constant_value(*other)) add_number(v, *n, true);
        if (const auto* text = text_of(*other)) add_value(v, *text);
      }
    }
  });
  branches_.push_back(std::move(b));
}

void Explorer::collect(const ir::Program& program, const ir::Routine& routine, const ir::Statement& s) {
  const auto numbers = [&](const ir::ExprPtr& e) {
    for (const auto& v : variables_of(program, e)) {
      ir::for_each_statement(routine.body, [&](const ir::Statement& labelled) {
        if (const auto number = parse_decimal(labelled.line.number)) add_number(v, *number, false);
      });
    }
  };
  if (const auto* a = std::get_if<ir::Assign>(&s.node)) {
    for (const auto& item : a->items) {
      if (!item.to_system) assigned(program, item.target, item.value);
    }
  } else if (const auto* i = std::get_if<ir::If>(&s.node)) {
    branch(program, s, i->condition, true);
  } else if (const auto* w = std::get_if<ir::While>(&s.node)) {
    branch(program, s, w->condition, true);
  } else if (const auto* u = std::get_if<ir::Until>(&s.node)) {
    branch(program, s, u->condition, true);
  } else if (const auto* f = std::get_if<ir::For>(&s.node)) {
    assigned(program, f->counter, f->from);
    branch(program, s, f->to, false);
  } else if (const auto* j = std::get_if<ir::Jump>(&s.node)) {
    if (j->condition) branch(program, s, j->condition, true);
    if (j->target.computed) {
      branch(program, s, j->target.computed, false);
      numbers(j->target.computed);
    }
  } else if (const auto* cases = std::get_if<ir::Switch>(&s.node)) {
    branch(program, s, cases->value, false);
    for (const auto& v : variables_of(program, cases->value)) {
      for (const auto& [value, jump] : cases->cases) {
        if (const auto n = ir::constant_value(value)) add_number(v, *n, false);
      }
    }
  } else if (const auto* d = std::get_if<ir::Declare>(&s.node)) {
    for (const auto& item : d->items) defined_.insert(to_upper_ascii(item.name));
  } else if (const auto* r = std::get_if<ir::Repeat>(&s.node)) {
    if (r->count) branch(program, s, r->count, false);
  } else if (const auto* c = std::get_if<ir::CallRoutine>(&s.node)) {
    if (c->count) branch(program, s, c->count, false);
    if (c->computed) branch(program, s, c->computed, false);
    const auto* callee = c->computed ? nullptr : program.find(c->routine);
    if (callee == nullptr) return;
    for (std::size_t n = 0; n < c->arguments.size(); ++n) {
      const auto& given = c->arguments[n];
      for (std::size_t p = 0; p < callee->parameters.size(); ++p) {
        const auto& formal = callee->parameters[p];
        if (given.name.empty() ? n == p : given.name == formal.name) assigned(program, formal.variable, given.value);
      }
    }
  }
}

/// What is tried of a variable is tried of those it is set from as well; 0, 1 and -1 of all.
void Explorer::spread_values(const ir::Program& program) {
  for (bool more = true; more;) {
    more = false;
    for (const auto& [name, k] : std::map(known_)) {
      for (const auto& sum : k.sums) {
        for (const auto& from : variables_of(program, sum)) {
          const std::size_t before = known_[from].values.size();
          for (const auto& value : k.values) {
            const auto number = parse_decimal(value);
            const auto x = number ? solved(std::get<ir::Binary>(sum->node), *number) : std::nullopt;
            if (x) add_number(from, *x, false);
          }
          more = more || known_[from].values.size() != before;
        }
      }
      for (const auto& from : k.set_from) {
        const std::size_t before = known_[from].values.size();
        for (const auto& value : k.values) add_value(from, value);
        more = more || known_[from].values.size() != before;
      }
    }
  }
  for (auto& [name, k] : known_) {
    for (const char* value : {"1", "0", "-1"}) add_value(name, value);
  }
}

/// Reached, and some way not taken.
bool Explorer::open(const Branch& b) const {
  if (!b.two_ways) return b.id < covered_.size() && covered_[b.id];
  const std::uint8_t o = b.id < outcomes_.size() ? outcomes_[b.id] : 0;
  return o == interpreter::Result::held || o == interpreter::Result::failed;
}

/// Variables that an open branch depends on, those nearest to it first.
std::vector<std::string> Explorer::relevant() const {
  std::vector<std::string> list;
  std::set<std::string> seen;
  std::deque<std::string> waiting;
  for (const bool two_ways : {true, false}) {
    for (const auto& b : branches_) {
      if (b.two_ways == two_ways && open(b)) waiting.insert(waiting.end(), b.variables.begin(), b.variables.end());
    }
  }
  while (!waiting.empty()) {
    const std::string name = std::move(waiting.front());
    waiting.pop_front();
    if (!seen.insert(name).second) continue;
    if (defined_.count(name) == 0 && settable_(name)) list.push_back(name);
    const auto it = known_.find(name);
    if (it != known_.end()) waiting.insert(waiting.end(), it->second.set_from.begin(), it->second.set_from.end());
  }
  return list;
}

std::optional<Inputs> Explorer::next() {
  const auto fresh = [this](const Inputs& in) { return tried_.insert({in.set, in.skip_mask}).second; };
  const auto with_switches = [this](unsigned more) {
    return Inputs{start_.set, static_cast<std::uint16_t>(start_.skip_mask | more)};
  };
  if (const Inputs all = with_switches(skips_); fresh(all)) return all;
  for (unsigned bit = 1; bit <= skips_; bit <<= 1) {
    if ((skips_ & bit) == 0) continue;
    if (const Inputs one = with_switches(bit); fresh(one)) return one;
  }
  const auto variables = relevant();
  for (auto it = kept_.rbegin(); it != kept_.rend(); ++it) {
    for (const auto& name : variables) {
      const auto given = [&name](const auto& s) { return plain_name(s.first) == plain_name(name); };
      if (std::any_of(start_.set.begin(), start_.set.end(), given)) continue;
      for (const auto& value : known_.at(name).values) {
        Inputs in = *it;
        in.set.erase(std::remove_if(in.set.begin(), in.set.end(), given), in.set.end());
        in.set.emplace_back(name, value);
        if (fresh(in)) return in;
      }
    }
  }
  return std::nullopt;
}

void Explorer::note(const Inputs& inputs, const interpreter::Result& result) {
  ++replays_;
  tried_.insert({inputs.set, inputs.skip_mask});
  bool news = kept_.empty();
  const auto size = std::max(result.covered.size(), result.outcomes.size());
  if (covered_.size() < size) covered_.resize(size);
  if (outcomes_.size() < size) outcomes_.resize(size);
  for (std::size_t i = 0; i < result.covered.size(); ++i) {
    news = news || (result.covered[i] && !covered_[i]);
    covered_[i] = covered_[i] || result.covered[i];
  }
  for (std::size_t i = 0; i < result.outcomes.size(); ++i) {
    news = news || (result.outcomes[i] & ~outcomes_[i]) != 0;
    outcomes_[i] = static_cast<std::uint8_t>(outcomes_[i] | result.outcomes[i]);
  }
  if (news) kept_.push_back(inputs);
}

void Explorer::report(verifier::Coverage& c) const {
  c.replays = replays_;
  for (const auto& b : branches_) {
    if (!b.two_ways) continue;
    c.ways += 2;
    const std::uint8_t o = b.id < outcomes_.size() ? outcomes_[b.id] : 0;
    if (o == (interpreter::Result::held | interpreter::Result::failed)) {
      c.ways_taken += 2;
    } else if (o != 0) {
      ++c.ways_taken;
      c.open.push_back({b.file, b.line, o == interpreter::Result::held});
    }
  }
}

}  // namespace cnctrans::translator
