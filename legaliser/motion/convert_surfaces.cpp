// Work with the C axis on the face and on the cylinder of a turning part (equivalences 25.6): the target's own form.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "base/text.h"
#include "ir/cycles/machining.h"
#include "ir/edit/search.h"
#include "legaliser/analysis/words.h"
#include "legaliser/edit/blocks.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

/// A programmable frame is built up somewhere; ending one does not count.
bool builds_frames(const Program& program) {
  return any_action(program, [](const Action& a) {
    const auto* f = std::get_if<FrameOp>(&a.data);
    return f != nullptr && f->change && f->change->combine != FrameCombine::clear;
  });
}

bool is_plane(const Action& a, Plane p) {
  const auto* m = std::get_if<ModalSet>(&a.data);
  return m != nullptr && m->setting == Setting::plane && m->value == static_cast<std::uint8_t>(p);
}

Plane plane_of(Surface s) {
  return s == Surface::face ? Plane::xy : Plane::yz;
}

class SurfacePass {
 public:
  SurfacePass(Program& program, const LegaliseContext& context)
      : context_(context), facts_(program, context), frames_(builds_frames(program)) {}

  void statement(Statement&& s, Body& out) {
    auto* b = std::get_if<Block>(&s.node);
    SurfaceSet* set = b != nullptr ? action_in<SurfaceSet>(*b) : nullptr;
    if (b != nullptr) resume(s, *b);
    if (b != nullptr) refuse_turning(s, *b);
    if (set == nullptr) {
      if (b != nullptr && target().surfaces == SurfaceForm::c_with_plane) under_plane(s, *b);
      if (b != nullptr && target().surface_needs_radius) keep_radius(s, *b);
      out.push_back(std::move(s));
      return;
    }
    const Facts& facts = facts_.before(s);
    const Surface surface = set->surface;
    if (surface == Surface::none && setting<Surface>(facts, Setting::surface) == Surface::none) {  // it was off
      std::erase_if(b->actions, [](const Action& a) { return std::holds_alternative<SurfaceSet>(a.data); });
      if (!b->empty() || !shows_nothing(s.line)) out.push_back(std::move(s));
      return;
    }
    if (surface == Surface::cylinder && !cylinder(s, *set, facts)) {
      out.push_back(std::move(s));
      return;
    }
    if (target().surfaces == SurfaceForm::c_with_plane) {
      around_plane(s, *b, facts, surface, out);
    } else {
      Body behind;
      after(s, *b, facts, surface, behind);
      out.push_back(std::move(s));
      for (auto& made_here : behind) out.push_back(std::move(made_here));
    }
  }

 private:
  const Capabilities& target() const { return context_.target; }

  void report(const Statement& s, std::string_view code, std::string text, std::string hint = {}) const {
    context_.diagnostics.error(code, s.line.span, std::move(text), std::move(hint));
  }

  /// The diameter as a number where the target needs one. False: refused.
  bool cylinder(const Statement& s, SurfaceSet& set, const Facts& facts) const {
    const auto x = facts.position[axis::x];
    const bool from_x = set.diameter.literal() && set.diameter.number == 0;
    if (target().surfaces == SurfaceForm::y_from_x) {
      if (from_x) return true;
      if (set.diameter.literal() && x && std::fabs(2 * std::fabs(*x) - set.diameter.number) < 1e-6) return true;
      report(s, "TRN-450", "the cylinder of the target is the one on which X stands, and X is not known to stand on it",
             "move X to the diameter of the cylinder in the block before");
      return false;
    }
    if (!from_x) return true;
    if (!x) {
      report(s, "TRN-450", "the cylinder is the one on which X stands, and where it stands is not known here",
             "write an absolute X in the block before");
      return false;
    }
    set.diameter = Value(2 * std::fabs(*x));
    return true;
  }

  /// What a target whose surfaces deselect frames, or want radii, is told again.
  void after(const Statement& s, const Block& b, const Facts& facts, Surface surface, Body& behind) const {
    const bool said = std::any_of(b.actions.begin(), b.actions.end(),
                                  [](const Action& a) { return std::holds_alternative<WorkOffset>(a.data); });
    if (target().surface_clears_frames && !said) {
      const bool perhaps = !setting<Surface>(facts, Setting::surface) && facts.work_offset == 0;  // it may be on
      if (!facts.work_offset || frames_ || perhaps) {
        report(s, "TRN-451",
               frames_ ? "the target deselects the programmable frame here, and the program builds one"
                       : "the target deselects the work offset here, and the one in force is not known",
               "write the work offset behind this block");
      } else if (*facts.work_offset > 0) {
        behind.push_back(make_block(s.line, action(WorkOffset{Value(static_cast<double>(*facts.work_offset)), false})));
      }
    }
    const auto before = setting<Surface>(facts, Setting::surface);
    if (!target().surface_needs_radius || (surface != Surface::face && before != Surface::face)) return;
    const auto mode = setting<DiameterMode>(facts, Setting::diameter);
    if (!mode) {
      report(s, "TRN-173", "whether X is a radius or a diameter here depends on the path that leads to the block");
    } else if (*mode != DiameterMode::radius) {
      const auto now = surface == Surface::face ? DiameterMode::radius : *mode;
      behind.push_back(make_block(s.line, action(ModalSet{Setting::diameter, static_cast<std::uint8_t>(now)})));
    }
  }

  /// X of the face stays a radius: a diameter mode that is chosen there is said where the face ends.
  void keep_radius(Statement& s, Block& b) const {
    if (setting<Surface>(facts_.before(s), Setting::surface) != Surface::face) return;
    const auto mode = [](const Action& a) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      return m != nullptr && m->setting == Setting::diameter;
    };
    if (std::erase_if(b.actions, mode) != 0) settle(s);
  }

  /// The target chooses the surface with its plane.
  void around_plane(Statement& s, Block& b, const Facts& facts, Surface surface, Body& out) {
    const LineInfo line = s.line;
    if (surface == Surface::none) {
      const auto plane = setting_in<Plane>(b, facts, Setting::plane);
      if (!plane) report(s, "TRN-452", "the plane in force behind this block is not known");
      const bool said = plane && std::any_of(b.actions.begin(), b.actions.end(),
                                             [&plane](const Action& a) { return is_plane(a, *plane); });
      if (setting<Surface>(facts, Setting::surface) != Surface::none) straight(s, facts, out);
      if (plane && !said && setting<Surface>(facts, Setting::surface) != Surface::none)
        b.actions.push_back(action(ModalSet{Setting::plane, static_cast<std::uint8_t>(*plane)}));
      out.push_back(std::move(s));
      return;
    }
    if (surface == Surface::cylinder) drop_plane(b);
    out.push_back(std::move(s));
    if (surface == Surface::face) return;
    out.push_back(
        make_block(line, action(ModalSet{Setting::plane, static_cast<std::uint8_t>(plane_of(Surface::cylinder))})));
  }

  /// It stands behind the choice of the cylinder already. The writer passes over that of the face.
  static void drop_plane(Block& b) {
    std::erase_if(b.actions, [](const Action& a) { return is_plane(a, plane_of(Surface::cylinder)); });
  }

  static bool no_line(MotionKind k) { return k != MotionKind::rapid && k != MotionKind::linear; }

  /// The target's senses of turning change with the plane: no arc stays in force over its end.
  void straight(const Statement& s, const Facts& facts, Body& out) {
    if (const auto comp = setting<CompSide>(facts, Setting::comp); comp && *comp != CompSide::off)
      report(s, "TRN-452", "radius compensation over the end of work on the face or the cylinder",
             "write G40 and a move before");
    if (facts.motion && !no_line(*facts.motion)) return;
    straightened_ = true;
    Block line;
    line.has_motion = true;
    line.motion.kind = MotionKind::linear;
    out.push_back(made(s.line, std::move(line)));
  }

  /// Where the source goes on with the arc in force that `straight` has ended.
  void resume(const Statement& s, Block& b) const {
    if (!straightened_ || !b.has_motion || b.motion.kind != MotionKind::modal || !b.motion.moves()) return;
    const auto kind = motion_in(b, facts_.before(s));
    if (!kind)
      report(s, "TRN-452", "which motion is in force here depends on the path", "write G1 or G0 in the block");
    else if (no_line(*kind))
      b.motion.kind = *kind;
  }

  /// The spindle is the C axis there.
  void refuse_turning(const Statement& s, const Block& b) const {
    const auto* define = action_in<CycleDefine>(b);
    const auto* turned = define != nullptr && define->cycle ? std::get_if<NamedCycle>(&define->cycle->node) : nullptr;
    if (turned != nullptr && cycles::find_machining(turned->name) != nullptr &&
        setting<Surface>(facts_.before(s), Setting::surface) != Surface::none)
      report(s, "TRN-452", "a turning or threading cycle while the face or the cylinder is in force",
             "end the work with the C axis before it");
  }

  /// Senses of turning under a surface: only in its own plane.
  void under_plane(Statement& s, Block& b) {
    const Facts& facts = facts_.before(s);
    const auto surface = setting<Surface>(facts, Setting::surface);
    if (surface == Surface::none) return;
    if (!surface) {
      if (b.has_motion && facts.reachable)
        report(s, "TRN-452", "whether this block counts on the face, the cylinder or neither depends on the path");
      return;
    }
    const auto plane = setting_in<Plane>(b, facts, Setting::plane);
    const auto kind = motion_in(b, facts);
    const bool arc = b.has_motion && b.motion.moves() && (!kind || no_line(*kind));
    const bool turns = arc || std::any_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
                         const auto* m = std::get_if<ModalSet>(&a.data);
                         const bool comp = m != nullptr && m->setting == Setting::comp && m->value != 0;
                         return comp || std::holds_alternative<Corner>(a.data);
                       });
    if (turns && plane != plane_of(*surface))
      report(s, "TRN-452", "an arc, a corner or radius compensation outside of the plane of the face or the cylinder");
    const auto* spindle = action_in<SpindleRun>(b);
    if (spindle != nullptr && spindle->number == 1)
      report(s, "TRN-452", "M3, M4 and M5 end the work with the C axis on the target",
             "write the command of the spindle before or behind it");
    if (arc && *surface == Surface::cylinder && (!b.motion.centers.empty() || b.motion.extra))
      report(s, "TRN-452", "an arc by its centre on the cylinder: the letter of the centre is that of both axes there",
             "write the arc by its radius");
    const auto other = std::find_if(b.actions.begin(), b.actions.end(), [&surface](const Action& a) {
      const auto* m = std::get_if<ModalSet>(&a.data);
      return m != nullptr && m->setting == Setting::plane && !is_plane(a, plane_of(*surface));
    });
    if (other != b.actions.end())
      report(s, "TRN-452", "another plane than that of the face or the cylinder while it is in force");
    if (*surface == Surface::cylinder) drop_plane(b);
  }

  const LegaliseContext& context_;
  FactsOf facts_;
  bool frames_;
  bool straightened_ = false;
};

}  // namespace

/// A move in the block that chooses the surface counts on it already: it goes into a block behind the choice.
static void separate_moves(Program& program) {
  for (auto& r : program.routines) {
    rewrite_body(r.body, [](Statement&& s, Body& out) {
      auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || !b->has_motion || !b->motion.moves() || action_in<SurfaceSet>(*b) == nullptr) {
        out.push_back(std::move(s));
        return;
      }
      const auto chooses = [](const Action& a) {
        return std::holds_alternative<SurfaceSet>(a.data) ||
               (std::holds_alternative<ModalSet>(a.data) && a.order == Order::before);
      };
      Block choice, move = std::move(*b);
      std::copy_if(move.actions.begin(), move.actions.end(), std::back_inserter(choice.actions), chooses);
      std::erase_if(move.actions, chooses);
      const LineInfo line = s.line;
      s.node = std::move(choice);
      out.push_back(std::move(s));
      out.push_back(made(line, std::move(move)));
    });
  }
  number_statements(program);
}

void convert_surfaces(Program& program, const LegaliseContext& context) {
  if (program.dialect == context.target.dialect || context.target.surfaces == SurfaceForm::none) return;
  if (!any_action(program, [](const Action& a) { return std::holds_alternative<SurfaceSet>(a.data); })) return;
  separate_moves(program);
  SurfacePass pass(program, context);
  for (auto& r : program.routines)
    rewrite_body(r.body, [&pass](Statement&& s, Body& out) { pass.statement(std::move(s), out); });
}

}  // namespace cnctrans::ir::passes
