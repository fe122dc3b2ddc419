// The blocks of profiles: where the target's own cycle finds them (the labels of the source's blocks, or a
// copy).
#include <algorithm>

#include "base/text.h"
#include "legaliser/cycles/turning/machining_moves.h"
#include "legaliser/cycles/turning/similar_cycles.h"
#include "legaliser/edit/blocks.h"

namespace cnctrans::ir::passes {

std::set<std::int64_t> block_numbers(const Program& program) {
  std::set<std::int64_t> numbers;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      for (const auto& l : labels_on(s.line)) {
        if (l.is_number && l.text.size() < 10) numbers.insert(std::stol(l.text));
      }
    });
  }
  return numbers;
}

void keep_used(const Program& program, const std::vector<ProfileUse>& uses, std::set<std::uint32_t>& blocks) {
  for (const auto& use : uses) {
    if (!use.copy.empty()) continue;
    for (const auto& r : program.routines) {
      bool inside = false;
      for (const auto& s : r.body) {
        inside = inside || s.id == use.first;
        if (inside) blocks.erase(s.id);
        if (s.id == use.last) inside = false;
      }
    }
  }
}

namespace {

Statement straight_to(const LineInfo& like, const std::optional<Value>& x, const std::optional<Value>& z) {
  Block b;
  b.has_motion = true;
  b.motion.kind = MotionKind::linear;
  b.motion.explicit_code = true;
  for (const auto& [axis, v] : {std::pair(axis::x, x), std::pair(axis::z, z)}) {
    if (!v) continue;
    CoordWord w;
    w.axis = axis;
    w.value = *v;
    b.motion.coords.push_back(w);
  }
  return made(like, std::move(b));
}
std::optional<Statement> tail_of(const ProfileUse& use, const LineInfo& like) {
  if (!use.tail) return std::nullopt;
  const auto to = std::optional(Value(*use.tail));
  return use.face ? straight_to(like, {}, to) : straight_to(like, to, {});
}
/// The first block of a range is read without what stands before it.
void say_straight(Statement& s) {
  auto& b = std::get<Block>(s.node);
  if (!b.has_motion || b.motion.kind != MotionKind::modal) return;
  b.motion.kind = MotionKind::linear;
  b.motion.explicit_code = true;
}
LabelRef first_of(const ProfileUse& use) {
  return LabelRef{use.first_label, use.numbers, nullptr};
}
LabelRef last_of(const ProfileUse& use) {
  return LabelRef{use.last_label, use.numbers, nullptr};
}

}  // namespace

void ProfileUse::name(NamedCycle& cycle) const {
  const auto value = [this](const std::string& label) {
    return numbers ? Value(double(std::stol(label))) : Value(string_literal(label));
  };
  for (auto& [w, v] : cycle.words) {
    if (w == "first_label") v = value(first_label);
    if (w == "last_label") v = value(last_label);
  }
}

Body copied_profile(const ProfileUse& use, Program& program) {
  Body out;
  for (const auto& s : use.copy) {
    out.push_back(s);
    out.back().id = 0;
    out.back().line.number = {};
    out.back().line.labels.clear();
    std::erase_if(std::get<Block>(out.back().node).actions,
                  [](const Action& a) { return std::holds_alternative<SetFeed>(a.data); });
  }
  if (use.x && use.z) out.insert(out.begin(), straight_to(out.front().line, use.x, use.z));
  if (auto tail = tail_of(use, out.back().line)) out.push_back(std::move(*tail));
  say_straight(out.front());
  set_label(out.front().line, first_of(use), program);
  set_label(out.back().line, last_of(use), program);
  return out;
}

void label_profiles(Program& program, const std::vector<ProfileUse>& uses) {
  std::vector<ProfileUse> done;
  for (const auto& use : uses) {
    if (!use.copy.empty() || std::find(done.begin(), done.end(), use) != done.end()) continue;
    done.push_back(use);
    for (auto& r : program.routines) {
      for (std::size_t i = 0; i < r.body.size(); ++i) {
        if (r.body[i].id == 0) continue;
        const bool first = r.body[i].id == use.first, last = r.body[i].id == use.last;
        const auto place = [&] { return r.body.begin() + static_cast<std::ptrdiff_t>(i); };
        if (first && use.x && use.z) {
          Statement s = straight_to(r.body[i].line, use.x, use.z);
          set_label(s.line, first_of(use), program);
          r.body.insert(place(), std::move(s));
          ++i;
        } else if (first) {
          say_straight(r.body[i]);
          set_label(r.body[i].line, first_of(use), program);
        }
        if (!last) continue;
        if (auto tail = tail_of(use, r.body[i].line)) {
          set_label(tail->line, last_of(use), program);
          r.body.insert(place() + 1, std::move(*tail));
        } else {
          set_label(r.body[i].line, last_of(use), program);
        }
        break;
      }
    }
  }
}

}  // namespace cnctrans::ir::passes
