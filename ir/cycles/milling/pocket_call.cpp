#include "ir/cycles/milling/pocket_call.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "ir/cycles/milling/pocket_moves.h"
#include "ir/cycles/profile_blocks.h"
#include "ir/cycles/words.h"
#include "ir/tool_number.h"

namespace cnctrans::ir::cycles {

namespace {

constexpr double called_step = 0.75;  ///< in tool diameters
constexpr double usual_plunge = 0.5;  ///< of the feed

bool says(const NamedCycle& cycle, std::string_view name) {
  const Value* v = find_word(cycle, name);
  return v != nullptr && !v->is(0);
}
Value magnitude(const Value& v) {
  return v.literal() ? Value(std::abs(v.number)) : Value(call(Function::abs, {v.expr}));
}
Level absolute(const Value& v) {
  Level l;
  l.value = v;
  l.base = LevelBase::absolute;
  l.given = true;
  return l;
}

/// One operation: its blocks, and which of them holds the cycle.
struct Operation {
  std::vector<const Statement*> blocks;
  const Statement* at = nullptr;
  const CycleDefine* define = nullptr;
  const NamedCycle* named = nullptr;  ///< of roughing and finishing
};

class Assembly {
 public:
  Assembly(const Program& program, const Routine& caller, const NamedCycle& call, std::string* error)
      : program_(program), caller_(caller), call_(call), error_(error) {}

  bool run() {
    if (find_word(call_, "semi_first_label") != nullptr)
      return no("a pocket with depth profiles (semi-finishing) is not carried out yet");
    if (!find("drill", drill_) || !find("rough", rough_) || !find("finish", finish_)) return false;
    if (drill_.at == nullptr && rough_.at == nullptr && finish_.at == nullptr) return no("the pocket has no operation");
    if (rough_.at != nullptr && !read_rough()) return false;
    if (finish_.at != nullptr && !read_finish()) return false;
    if (drill_.at != nullptr && !read_drill()) return false;
    put(drill_, drill_cycle_);
    put(rough_, rough_cycle_);
    put(finish_, finish_cycle_);
    return true;
  }
  PocketOperations out;

 private:
  bool no(std::string why) {
    *error_ = std::move(why);
    return false;
  }

  bool find(const std::string& name, Operation& op) {
    const Value* first = find_word(call_, name + "_first_label");
    if (first == nullptr) return true;
    const Value* last = find_word(call_, name + "_last_label");
    const NamedCycle range{std::string(pocket::call), {{"first_label", *first}, {"last_label", last ? *last : *first}}};
    op.blocks = profile_blocks(program_, caller_, range, error_);
    if (op.blocks.empty()) return no("the blocks of an operation of the pocket (" + name + ") are not in the program");
    for (const auto* s : op.blocks) {
      const auto& b = std::get<Block>(s->node);
      if (b.has_motion && b.motion.moves()) return no("an operation of the pocket holds a motion of its own");
      for (const auto& a : b.actions) {
        const auto* d = std::get_if<CycleDefine>(&a.data);
        if (d == nullptr || !d->cycle) continue;
        if (op.at != nullptr) return no("an operation of the pocket holds more than one cycle");
        op.at = s;
        op.define = d;
        op.named = std::get_if<NamedCycle>(&d->cycle->node);
      }
    }
    if (op.at == nullptr) return no("an operation of the pocket (" + name + ") holds no cycle");
    const std::string_view wanted = name == "rough" ? pocket::rough : name == "finish" ? pocket::finish : "";
    const bool right = wanted.empty() ? op.named == nullptr : op.named != nullptr && op.named->name == wanted;
    return right || no("the blocks of an operation of the pocket (" + name + ") hold another cycle");
  }

  HoleCycle pocket_cycle(const NamedCycle& from, const char* operation) const {
    HoleCycle c;
    c.kind = HoleKind::mill;
    c.mill.shape = "pocket.contour";
    c.retract.given = true;
    c.retract.base = LevelBase::from_initial;
    auto& words = c.mill.words;
    words.emplace_back("operation", Value(operation == std::string_view("rough") ? 1.0 : 2.0));
    for (const auto* name : {"signed_infeed", "step", "pass_angle", "plunge_angle"}) {
      if (const Value* v = find_word(from, name)) words.emplace_back(name, *v);
    }
    if (const Value* v = find_word(from, "intersection")) words.emplace_back("apart", *v);
    words.emplace_back("step_factor", Value(called_step));
    if (says(from, "plunge_feed"))
      words.emplace_back("plunge_feed", *find_word(from, "plunge_feed"));
    else
      words.emplace_back("plunge_factor", Value(usual_plunge));
    return c;
  }
  void add_contours(HoleCycle& c) const {
    for (const auto* name : {"first_label", "last_label", "program"}) {
      if (const Value* v = find_word(call_, name)) c.mill.words.emplace_back(name, *v);
    }
  }
  /// Depth and reference plane of the finishing are those of the roughing where it names none.
  bool levels(HoleCycle& c, const NamedCycle& own, const NamedCycle* other) {
    for (const auto* name : {"bottom", "reference"}) {
      const Value* v = find_word(own, name);
      if (v == nullptr && other != nullptr) v = find_word(*other, name);
      if (v == nullptr) return no("an operation of the pocket needs its depth and its reference plane");
      (name == std::string_view("bottom") ? c.bottom : c.reference) = absolute(*v);
    }
    return true;
  }

  bool read_rough() {
    const Value* pass = find_word(*rough_.named, "signed_infeed");
    if (pass == nullptr || pass->is(0)) return no("the roughing of the pocket needs its axial pass");
    rough_cycle_ = pocket_cycle(*rough_.named, "rough");
    rough_cycle_->mill.words.emplace_back("along", Value(1.0));
    if (finish_.named != nullptr && says(*finish_.named, "wall_stock"))
      rough_cycle_->mill.words.emplace_back("wall_stock", magnitude(*find_word(*finish_.named, "wall_stock")));
    if (!levels(*rough_cycle_, *rough_.named, nullptr)) return false;
    add_contours(*rough_cycle_);
    return true;
  }

  bool read_finish() {
    const Value* way = find_word(*finish_.named, "direction");
    if (way != nullptr && !way->is(0) && !way->is(1))
      return no("this direction of the finishing of the pocket is not carried out yet");
    if (!says(*finish_.named, "wall_stock")) {
      out.finish_left_out = true;
      return true;
    }
    finish_cycle_ = pocket_cycle(*finish_.named, "finish");
    finish_cycle_->mill.words.emplace_back("along", Value(way != nullptr && way->is(1) ? -1.0 : 1.0));
    if (!levels(*finish_cycle_, *finish_.named, rough_.named)) return false;
    add_contours(*finish_cycle_);
    return true;
  }

  /// The places depend on the tool of the roughing.
  bool read_drill() {
    const auto* hole = std::get_if<HoleCycle>(&drill_.define->cycle->node);
    constexpr std::array kinds = {HoleKind::drill, HoleKind::peck_full, HoleKind::peck_break};
    if (hole == nullptr || std::find(kinds.begin(), kinds.end(), hole->kind) == kinds.end())
      return no("the drilling of the pocket holds another cycle than one of drilling");
    if (!rough_cycle_) return no("the drilling of the pocket needs the roughing: it says where");
    drill_cycle_ = *hole;
    drill_cycle_->mill = rough_cycle_->mill;
    drill_cycle_->mill.shape = std::string(pocket_entries_shape);
    for (const auto* s : rough_.blocks) {
      for (const auto& a : std::get<Block>(s->node).actions) {
        if (const auto* t = std::get_if<ToolSelect>(&a.data); t != nullptr && has_number(*t))
          drill_cycle_->mill.words.emplace_back("tool", t->number);
        if (const auto* d = std::get_if<ToolOffset>(&a.data))
          drill_cycle_->mill.words.emplace_back("offset", d->number);
      }
    }
    return true;
  }

  void put(const Operation& op, const std::optional<HoleCycle>& cycle) {
    for (const auto* s : op.blocks) {
      Statement copy = *s;
      if (s == op.at) {
        auto& actions = std::get<Block>(copy.node).actions;
        const auto at = std::find_if(actions.begin(), actions.end(),
                                     [](const Action& a) { return std::holds_alternative<CycleDefine>(a.data); });
        if (cycle) {
          CycleDefine define;
          define.modal = false;
          define.cycle = std::make_shared<const Cycle>(Cycle{*cycle});
          at->data = std::move(define);
          at->text = {};
        } else {
          actions.erase(at);
        }
      }
      out.blocks.push_back(std::move(copy));
      out.originals.push_back(s);
    }
  }

  const Program& program_;
  const Routine& caller_;
  const NamedCycle& call_;
  std::string* error_;
  Operation drill_, rough_, finish_;
  std::optional<HoleCycle> drill_cycle_, rough_cycle_, finish_cycle_;
};

}  // namespace

bool is_label_word(std::string_view word) {
  return word.ends_with("_label");
}

std::optional<PocketOperations> pocket_operations(const Program& program, const Routine& caller, const NamedCycle& call,
                                                  std::string* error) {
  error->clear();
  Assembly assembly(program, caller, call, error);
  if (!assembly.run()) return std::nullopt;
  return std::move(assembly.out);
}

}  // namespace cnctrans::ir::cycles
