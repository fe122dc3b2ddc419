// PUSH and PULL (reference 14.5): a range of L variables is put aside and taken back. What one PUSH put aside stands in
// symbols of its own; their names hold a blank, which no symbol of a program does.
#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

#include "base/text.h"
#include "dialects/num/variables.h"
#include "frontends/num/program/lines.h"

namespace cnctrans::frontends::num {

namespace facts = dialects::num;

namespace {

/// "PUSH L0 - L5": the two numbers.
bool range_of(std::string_view text, std::int64_t& first, std::int64_t& last) {
  std::string plain;
  for (const char c : to_upper_ascii(text.substr(4))) {
    if (c != ' ' && c != '\t') plain += c;
  }
  const char* end = plain.data() + plain.size();
  if (plain.size() < 2 || plain[0] != 'L') return false;
  auto r = std::from_chars(plain.data() + 1, end, first);
  last = first;
  if (r.ec != std::errc{}) return false;
  if (r.ptr == end) return true;
  if (end - r.ptr < 3 || r.ptr[0] != '-' || r.ptr[1] != 'L') return false;
  r = std::from_chars(r.ptr + 2, end, last);
  return r.ec == std::errc{} && r.ptr == end && first <= last;
}

}  // namespace

bool FileReader::stack(const syntax::Statement& s) {
  Report& report = lower_.report();
  const bool push = iequals_ascii(s.text.substr(0, 4), "PUSH");
  const auto refuse = [&](std::string_view why) {
    report.refuse("NUM-023", s.pos, "`" + s.text + "`: " + std::string(why), {}, "language.statement");
    return true;
  };
  Pushed now;
  if (!range_of(s.text, now.first, now.last)) return refuse("a range of variables follows: PUSH L0 - L5");
  for (std::int64_t n = now.first; n <= now.last; ++n) {
    if (facts::l_range(n) == nullptr) return refuse("the control has no variable L" + std::to_string(n));
  }
  if (!push && (pushed_.empty() || pushed_.back().first != now.first || pushed_.back().last != now.last))
    return refuse("it takes back what the last PUSH of this program put aside, the same variables");
  now.line = span_.line;
  now.number = push ? ++push_count_ : pushed_.back().number;
  ir::Assign assign;
  for (std::int64_t n = now.first; n <= now.last; ++n) {
    ir::VarRef aside;
    aside.space = facts::space_symbol;
    aside.name = "[PUSH " + std::to_string(now.number) + " L" + std::to_string(n) + "]";
    const ir::ExprPtr variable = ir::numbered(facts::space_l, n, ir::Type::real);
    ir::Assign::Item item;
    item.pos = s.pos;
    item.target = push ? aside : std::get<ir::VarRef>(variable->node);
    item.value = push ? variable : ir::variable(aside);
    assign.items.push_back(std::move(item));
  }
  put_node(std::move(assign));
  if (push) {
    pushed_.push_back(now);
  } else {
    stacked_.emplace_back(pushed_.back().line, now.line);
    pushed_.pop_back();
  }
  return true;
}

/// Between a PUSH and its PULL the program runs from the one to the other: nothing jumps in or out.
void FileReader::check_stack() {
  if (push_count_ == 0) return;
  std::map<std::string_view, std::uint32_t> labels;
  ir::for_each_statement(routine_.body, [&](const ir::Statement& s) {
    if (!s.line.number.empty()) labels.emplace(s.line.number, s.line.span.line);
  });
  const auto error = [this](const Span& where) {
    diagnostics_.error("NUM-023", where, "this leaves or enters the blocks between a PUSH and its PULL",
                       "put PUSH and PULL on the same way through the program");
  };
  const auto inside = [](const std::pair<std::uint32_t, std::uint32_t>& r, std::uint32_t line) {
    return line > r.first && line <= r.second;
  };
  for (const auto& p : pushed_) stacked_.emplace_back(p.line, source_->last_line());
  ir::for_each_statement(routine_.body, [&](const ir::Statement& s) {
    const std::uint32_t line = s.line.span.line;
    const auto crosses = [&](std::uint32_t from, std::uint32_t to) {
      return std::any_of(stacked_.begin(), stacked_.end(),
                         [&](const auto& r) { return inside(r, from) != inside(r, to); });
    };
    const auto target = [&](const ir::LabelRef& l, std::uint32_t from) {
      const auto it = labels.find(l.text);
      return l.computed || (it != labels.end() && crosses(from, it->second));
    };
    bool bad = false;
    if (const auto* j = std::get_if<ir::Jump>(&s.node)) bad = target(j->target, line);
    if (const auto* r = std::get_if<ir::Repeat>(&s.node); r != nullptr && !r->has_program) {
      const auto first = labels.find(r->first.text), last = labels.find(r->last.text);
      bad = r->first.computed || r->last.computed ||
            (first != labels.end() && last != labels.end() &&
             std::any_of(stacked_.begin(), stacked_.end(), [&](const auto& x) {
               const bool starts = first->second <= x.first, ends = last->second >= x.second;
               const bool apart = last->second < x.first || first->second > x.second;
               const bool within = first->second > x.first && last->second < x.second;
               return !(starts && ends) && !apart && !within;
             }));
    }
    const auto close = [&](const ir::LineInfo& end) {
      bad = bad || (end.span.known() && crosses(line, end.span.line));
    };
    if (const auto* i = std::get_if<ir::If>(&s.node)) {
      close(i->end_line);
      if (i->has_else) close(i->else_line);
    }
    if (const auto* w = std::get_if<ir::While>(&s.node)) close(w->end_line);
    if (const auto* f = std::get_if<ir::For>(&s.node)) close(f->end_line);
    if (const auto* u = std::get_if<ir::Until>(&s.node)) close(u->end_line);
    if (bad) error(s.line.span);
  });
  pushed_.clear();
  stacked_.clear();
}

}  // namespace cnctrans::frontends::num
