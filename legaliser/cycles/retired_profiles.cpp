// Profiles that no cycle of the target reads any more.
#include <algorithm>
#include <vector>

#include "base/text.h"
#include "ir/source_line.h"
#include "legaliser/cycles/turning/machining_moves.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::ir::passes {

namespace {

/// The words of a block, for a person to read: the source's own line where it holds nothing else.
std::string shown(const Statement& s, const Program& program) {
  const auto& b = std::get<Block>(s.node);
  if (!s.line.joined && s.line.comments.empty()) {
    const std::string line = source_line(s.line.span, program);
    if (const auto text = trim(line); !text.empty()) return std::string(text);
  }
  std::string out;
  const auto add = [&out](std::string_view text) {
    if (text.empty()) return;
    if (!out.empty()) out += ' ';
    out += text;
  };
  const auto word = [&](std::string_view letter, const Value& v) {
    if (v.literal()) add(std::string(letter) + (v.text.empty() ? shortest(v.number) : std::string(v.text)));
  };
  if (!s.line.number.empty()) add(s.line.number_mark + std::string(s.line.number));
  add(b.motion.code_text);
  for (const auto& c : b.motion.coords) word(fixed_axis_name(c.axis), c.value);
  for (const auto& c : b.motion.centers) word(c.axis == axis::x ? "I" : c.axis == axis::y ? "J" : "K", c.value);
  if (b.motion.radius_given) word("R", b.motion.radius);
  for (const auto& a : b.actions) {
    add(a.text);
    const auto* corner = std::get_if<Corner>(&a.data);
    if (corner != nullptr && a.text.find(corner->value.text) == std::string_view::npos) word("", corner->value);
  }
  return out;
}

/// Some statement runs the routine, or may run any.
bool is_called(const Program& program, const Routine& routine) {
  if (routine.kind == RoutineKind::main) return true;
  bool called = false;
  const auto look = [&](const CallRoutine& c) { called = called || c.computed || c.routine == routine.name; };
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      if (const auto* c = std::get_if<CallRoutine>(&s.node)) look(*c);
      if (const auto* m = std::get_if<ModalCall>(&s.node); m != nullptr && !m->off && !m->cycle) look(m->call);
      if (const auto* again = std::get_if<Repeat>(&s.node))
        called = called || (again->has_program && again->program == routine.name);
    });
  }
  return called;
}

bool only_remarks(const Routine& r) {
  return std::all_of(r.body.begin(), r.body.end(), [](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    return b != nullptr ? b->empty()
                        : std::holds_alternative<Return>(s.node) || std::holds_alternative<End>(s.node) ||
                              std::holds_alternative<Label>(s.node);
  });
}

}  // namespace

void retire_profiles(Program& program, const std::set<std::uint32_t>& blocks, const std::vector<ProfileUse>& uses,
                     const FactsOf& facts) {
  if (blocks.empty()) return;
  std::set<std::uint32_t> copied;
  for (const auto& use : uses) {
    for (const auto& s : use.copy) copied.insert(s.id);
  }
  std::vector<const Routine*> idle;
  std::vector<const Statement*> remarks;
  for (auto& r : program.routines) {
    const bool called = is_called(program, r);
    bool retired = false, told = false;
    std::set<std::uint32_t> own;
    const auto remark = [&program](Statement& s, const std::string& text) {
      CommentText c;
      c.text = program.keep(" " + text);
      c.place = CommentPlace::own_line;
      s.line.comments.insert(s.line.comments.begin(), c);
      s.line.number = {};
      s.line.labels.clear();
      s.node = Block{};
    };
    for_each_statement(r.body, [&](Statement& s) {
      const auto* kept = std::get_if<Opaque>(&s.node);
      if (kept != nullptr && kept->harmless && kept->feature == "cycle.turning")  // a point of the blank
        return remark(s, std::string(trim(kept->text)));
      const auto* block = std::get_if<Block>(&s.node);
      if (blocks.count(s.id) == 0 || block == nullptr || block->empty()) return;
      if (called && facts.before(s).reachable) return;
      remark(s, shown(s, program));
      retired = true;
      own.insert(s.id);
      told = told || copied.count(s.id) != 0;
    });
    if (!retired || called || !only_remarks(r)) continue;
    idle.push_back(&r);
    for (const auto& s : r.body) {
      const bool says = std::holds_alternative<Block>(s.node) && !s.line.comments.empty();
      if (says && !(told && own.count(s.id) != 0)) remarks.push_back(&s);
    }
  }
  if (idle.empty()) return;
  // Nothing runs it and nothing is left in it but the text of the profile, which goes behind the end of the
  // program unless it stands there as a copy.
  auto main = std::find_if(program.routines.begin(), program.routines.end(),
                           [](const Routine& r) { return r.kind == RoutineKind::main; });
  if (main == program.routines.end()) return;
  for (const Statement* s : remarks) main->body.push_back(*s);
  std::erase_if(program.routines, [&](const Routine& r) {
    return std::any_of(idle.begin(), idle.end(), [&](const Routine* i) { return i == &r; });
  });
}

}  // namespace cnctrans::ir::passes
