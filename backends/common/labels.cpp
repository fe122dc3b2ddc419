#include "backends/common/labels.h"

#include <charconv>
#include <cmath>

#include "ir/cycles/milling/pocket_call.h"

namespace cnctrans::backends {
namespace {

constexpr char mark_begin = '\x01', mark_middle = '\x02', mark_end = '\x03';

std::size_t routine_index(const ir::Program& program, const ir::RoutineName& name, std::size_t otherwise) {
  for (std::size_t i = 0; i < program.routines.size(); ++i) {
    if (program.routines[i].name == name) return i;
  }
  return otherwise;
}

}  // namespace

std::string_view without_leading_zeros(std::string_view digits) {
  while (digits.size() > 1 && digits.front() == '0') digits.remove_prefix(1);
  return digits;
}

LabelUse::LabelUse(const ir::Program& program) {
  for (std::size_t i = 0; i < program.routines.size(); ++i) use_body(program, i, program.routines[i].body);
  if (certain_) check_targets(program);
}

void LabelUse::use(std::size_t routine, const ir::LabelRef& label, bool range) {
  if (label.computed && label.text.empty()) {
    certain_ = false;
    computed_ = true;
    why_not_ = "a jump computes its target";
    return;
  }
  if (label.text.empty()) return;
  if (!label.is_number) {
    names_.emplace(routine, label.text);
    return;
  }
  const std::string digits(without_leading_zeros(label.text));
  targets_.emplace(routine, digits);
  if (range) ranges_.emplace(routine, digits);
}

/// Profiles and contours that a cycle names by block numbers; a control whose labels are words names them by texts.
void LabelUse::use_cycles(const ir::Statement& s) {
  const auto* block = std::get_if<ir::Block>(&s.node);
  if (block == nullptr) return;
  for (const auto& action : block->actions) {
    const auto* d = std::get_if<ir::CycleDefine>(&action.data);
    const auto* named = d != nullptr && d->cycle ? std::get_if<ir::NamedCycle>(&d->cycle->node) : nullptr;
    if (named == nullptr) continue;
    for (const auto& [word, v] : named->words) {
      if (!ir::cycles::is_label_word(word) || !v.literal()) continue;
      profiles_.insert(std::to_string(std::lround(v.number)));
      if (certain_) why_not_ = "a cycle names its profile by block numbers";
    }
  }
}

void LabelUse::use_body(const ir::Program& program, std::size_t routine, const ir::Body& body) {
  const auto call = [&](const ir::CallRoutine& c) {
    if (!c.has_range) return;
    const std::size_t in = c.routine.empty() ? routine : routine_index(program, c.routine, routine);
    use(in, c.first, true);
    use(in, c.last, true);
  };
  ir::for_each_statement(body, [&](const ir::Statement& s) {
    use_cycles(s);
    if (const auto* j = std::get_if<ir::Jump>(&s.node)) {
      use(routine, j->target, false);
    } else if (const auto* w = std::get_if<ir::Switch>(&s.node)) {
      for (const auto& c : w->cases) use(routine, c.second.target, false);
      for (const auto& f : w->fallback) use(routine, f.target, false);
    } else if (const auto* r = std::get_if<ir::Repeat>(&s.node)) {
      const std::size_t in = r->has_program ? routine_index(program, r->program, routine) : routine;
      use(in, r->first, true);
      use(in, r->last, true);
    } else if (const auto* c = std::get_if<ir::CallRoutine>(&s.node)) {
      call(*c);
    } else if (const auto* m = std::get_if<ir::ModalCall>(&s.node)) {
      call(m->call);
    }
  });
}

void LabelUse::check_targets(const ir::Program& program) {
  std::set<std::pair<std::size_t, std::string>, std::less<>> seen;
  for (std::size_t i = 0; i < program.routines.size(); ++i) {
    const auto line = [&](const ir::LineInfo& info) {
      if (info.number.empty() || info.joined) return;
      const std::string digits(without_leading_zeros(info.number));
      if (!is_target(i, digits) || seen.emplace(i, digits).second) return;
      certain_ = false;
      why_not_ = "block number " + digits + " is a jump target and stands more than once";
    };
    ir::for_each_statement(program.routines[i].body, [&](const ir::Statement& s) {
      line(s.line);
      if (const auto* x = std::get_if<ir::If>(&s.node)) line(x->else_line);
      std::visit(
          [&line](const auto& node) {
            if constexpr (requires { node.end_line; }) line(node.end_line);
          },
          s.node);
    });
  }
  for (const auto& target : targets_) {  // it would keep its number, which another block gets
    if (!certain_ || seen.contains(target)) continue;
    certain_ = false;
    why_not_ = "a jump names block number " + target.second + ", which is not there";
  }
}

bool LabelUse::is_target(std::size_t routine, std::string_view digits) const {
  return targets_.count({routine, std::string(without_leading_zeros(digits))}) != 0;
}
bool LabelUse::must_stay(std::size_t routine, std::string_view digits) const {
  return computed_ || profiles_.count(without_leading_zeros(digits)) != 0 || is_target(routine, digits);
}
bool LabelUse::is_target_name(std::size_t routine, std::string_view name) const {
  return names_.count({routine, std::string(name)}) != 0;
}
bool LabelUse::delimits_range(std::size_t routine, std::string_view digits) const {
  return ranges_.count({routine, std::string(without_leading_zeros(digits))}) != 0;
}

std::string Renumbering::mark(std::size_t routine, std::string_view digits) {
  std::string m(1, mark_begin);
  m += std::to_string(routine);
  m += mark_middle;
  m += without_leading_zeros(digits);
  m += mark_end;
  return m;
}

void Renumbering::set(std::size_t routine, std::string_view digits, std::int64_t number) {
  numbers_[{routine, std::string(without_leading_zeros(digits))}] = number;
}

void Renumbering::resolve(std::string& text) const {
  std::string out;
  std::size_t from = 0;
  for (std::size_t at = text.find(mark_begin); at != std::string::npos; at = text.find(mark_begin, from)) {
    out.append(text, from, at - from);
    const std::size_t middle = text.find(mark_middle, at);
    const std::size_t end = text.find(mark_end, at);
    std::size_t routine = 0;
    std::from_chars(text.data() + at + 1, text.data() + middle, routine);
    const std::string digits = text.substr(middle + 1, end - middle - 1);
    const auto found = numbers_.find({routine, digits});
    out += found == numbers_.end() ? digits : std::to_string(found->second);
    from = end + 1;
  }
  out.append(text, from);
  text = std::move(out);
}

}  // namespace cnctrans::backends
