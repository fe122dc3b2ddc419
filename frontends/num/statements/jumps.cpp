#include "frontends/num/statements/jumps.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "base/text.h"
#include "ir/edit/labels.h"

namespace cnctrans::frontends::num {

namespace {

/// The bodies around a statement, from the outermost one: their lines stand for them.
using Path = std::vector<const ir::Body*>;

struct Place {
  const ir::Statement* statement = nullptr;
  Path around;
};

class Jumps {
 public:
  explicit Jumps(const ir::Routine& routine) { walk(routine.body); }

  void judge(Diagnostics& diagnostics) const {
    for (const Place& p : jumps_) {
      const auto& target = std::get<ir::Jump>(p.statement->node).target;
      if (target.computed) continue;
      const auto at = labels_.find(ir::label_key(target.text, target.is_number));
      if (at == labels_.end()) continue;
      const Path& inside = at->second;
      const bool outside =
          inside.size() > p.around.size() || !std::equal(inside.begin(), inside.end(), p.around.begin());
      if (!outside) continue;
      diagnostics.error("NUM-056", p.statement->line.span,
                        "N" + target.text + " stands inside of a structured statement: no jump leads into one",
                        "jump to the statement, or write its condition again");
    }
  }

 private:
  void walk(const ir::Body& body) {
    if (depth_ != 0) path_.push_back(&body);
    ++depth_;
    for (const auto& s : body) {
      if (!s.line.number.empty()) labels_.emplace(ir::label_key(s.line.number, true), path_);
      if (std::holds_alternative<ir::Jump>(s.node)) jumps_.push_back({&s, path_});
      if (const auto* i = std::get_if<ir::If>(&s.node)) {
        walk(i->then_body);
        walk(i->else_body);
      } else if (const auto* w = std::get_if<ir::While>(&s.node)) {
        walk(w->body);
      } else if (const auto* u = std::get_if<ir::Until>(&s.node)) {
        walk(u->body);
      } else if (const auto* f = std::get_if<ir::For>(&s.node)) {
        walk(f->body);
      } else if (const auto* l = std::get_if<ir::Loop>(&s.node)) {
        walk(l->body);
      }
    }
    --depth_;
    if (depth_ != 0) path_.pop_back();
  }

  std::map<std::string, Path> labels_;  ///< the first one of a number counts
  std::vector<Place> jumps_;
  Path path_;
  int depth_ = 0;
};

}  // namespace

void judge_jumps(const ir::Program& program, Diagnostics& diagnostics) {
  for (const auto& r : program.routines) Jumps(r).judge(diagnostics);
}

}  // namespace cnctrans::frontends::num
