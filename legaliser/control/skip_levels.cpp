#include "legaliser/control/skip_levels.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "ir/edit/rewrite.h"
#include "legaliser/control/skip_groups.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

bool several(const LineInfo& line) {
  return std::popcount(line.skip_mask) > 1;
}

class LevelSplitter {
 public:
  explicit LevelSplitter(Editor& editor) : editor_(editor) {}

  Body run(Body&& body) {
    Body out;
    for (std::size_t i = 0; i < body.size();) {
      std::size_t end = i + 1;
      while (end < body.size() && body[end].line.joined) ++end;
      const auto mask = body[i].line.skip_mask;
      bool good = several(body[i].line) && std::bit_width(mask) <= editor_.target().skip_levels;
      for (std::size_t k = i; k < end; ++k) good = good && !is_structure(body[k]) && body[k].line.skip_mask == mask;
      if (good)
        split(body, i, end, out);
      else
        std::move(body.begin() + static_cast<std::ptrdiff_t>(i), body.begin() + static_cast<std::ptrdiff_t>(end),
                  std::back_inserter(out));
      i = end;
    }
    return out;
  }

 private:
  /// The line keeps its lowest level. For each further one: a jump to the line that this switch leaves out, and the
  /// jump past the line that is left then.
  void split(Body& body, std::size_t begin, std::size_t end, Body& out) {
    const auto mask = body[begin].line.skip_mask;
    const auto lowest = static_cast<std::uint16_t>(mask & -mask);
    LineInfo bare;
    bare.span = body[begin].line.span;
    const LabelRef past = editor_.fresh_label();
    Body before;
    for (std::uint16_t rest = mask & ~lowest; rest != 0; rest &= rest - 1) {
      const LabelRef here = editor_.fresh_label();
      LineInfo under = bare;
      under.skip_mask = static_cast<std::uint16_t>(rest & -rest);
      before.push_back(forward(make_jump(under, here)));
      before.push_back(forward(make_jump(bare, past)));
      before.push_back(make_label(bare, here, editor_.program));
    }
    for (std::size_t k = begin; k < end; ++k) body[k].line.skip_mask = lowest;
    editor_.put(out, std::move(before), std::move(body[begin]));
    std::move(body.begin() + static_cast<std::ptrdiff_t>(begin + 1), body.begin() + static_cast<std::ptrdiff_t>(end),
              std::back_inserter(out));
    out.push_back(make_label(bare, past, editor_.program));
  }
  static Statement forward(Statement s) {
    std::get<Jump>(s.node).search = Search::forward;
    return s;
  }

  Editor& editor_;
};

}  // namespace

void split_skip_levels(Program& program, const LegaliseContext& context) {
  if (context.target.skip_several || context.target.skip_levels < 2) return;
  for (auto& r : program.routines) {
    const bool any = std::any_of(r.body.begin(), r.body.end(), [](const Statement& s) { return several(s.line); });
    if (!any) continue;
    Editor editor(program, r, context);
    r.body = LevelSplitter(editor).run(std::move(r.body));
  }
}

}  // namespace cnctrans::ir::passes
