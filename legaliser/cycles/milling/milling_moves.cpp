#include "legaliser/cycles/milling/milling_moves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/saturate.h"
#include "base/text.h"
#include "ir/cycles/milling/mill_contour.h"
#include "ir/cycles/milling/pocket_moves.h"
#include "ir/edit/search.h"
#include "ir/known_number.h"
#include "ir/tool_number.h"
#include "legaliser/data/written_data.h"
#include "legaliser/edit/blocks.h"
#include "machine/cycle_context.h"
#include "machine/tool_data.h"

namespace cnctrans::ir::passes {

namespace {

using cycles::MillMove;
using cycles::MillStep;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::optional<std::int32_t> whole(const Value& v) {
  const auto n = known_number(v);
  return n ? std::optional(saturate<std::int32_t>(std::round(*n))) : std::nullopt;
}

bool has_milling(const Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&found](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      if (b == nullptr || found) return;
      for (const auto& a : b->actions) {
        const auto* d = std::get_if<CycleDefine>(&a.data);
        const auto* hole = d != nullptr && d->cycle ? std::get_if<HoleCycle>(&d->cycle->node) : nullptr;
        found = found || (hole != nullptr && (hole->kind == HoleKind::mill || !hole->mill.shape.empty()));
      }
    });
  }
  return found;
}

/// The block leaves tool and zero where they are, but for a milling cycle without a move of its own.
bool stays(const Block& b) {
  if (b.has_motion) return false;
  return std::all_of(b.actions.begin(), b.actions.end(), [](const Action& a) {
    if (const auto* d = std::get_if<CycleDefine>(&a.data)) {
      const auto* hole = d->cycle ? std::get_if<HoleCycle>(&d->cycle->node) : nullptr;
      return hole != nullptr && hole->kind == HoleKind::mill;
    }
    return !std::holds_alternative<FrameOp>(a.data) && !std::holds_alternative<WorkOffset>(a.data) &&
           !std::holds_alternative<ModalSet>(a.data);
  });
}

/// Moves as blocks.
class MillWriter {
 public:
  MillWriter(const LineInfo& like, PlaneAxes axes, double unit, std::optional<double> feed)
      : axes_(axes), unit_(unit), feed_(feed) {
    line_.span = like.span;
    line_.skip_mask = like.skip_mask;
  }
  Body blocks;
  double u = 0, v = 0, w = 0;
  bool incremental = false;           ///< in the plane
  std::optional<SpindleState> sense;  ///< of the spindle before the cycle

  bool add(const MillMove& m, std::optional<double> speed, std::string* error) {
    if (m.step == MillStep::speed || m.step == MillStep::restore_speed) {
      if (m.step == MillStep::restore_speed && !speed)
        return *error = "the speed of the spindle before the cycle is not known here", false;
      const double n = m.step == MillStep::speed ? m.amount : *speed;
      blocks.push_back(make_block(line_, action(SetSpindle{1, Value{n}})));
      return true;
    }
    if (m.step == MillStep::comp_left || m.step == MillStep::comp_right || m.step == MillStep::comp_off) {
      side_ = m.step == MillStep::comp_off    ? CompSide::off
              : m.step == MillStep::comp_left ? CompSide::left
                                              : CompSide::right;
      return true;
    }
    if (m.step == MillStep::orient) return put(SpindleOrient{1, Value{m.angle}});
    if (m.step == MillStep::reverse)
      return *error =
                 "on the way back along the thread a block of its own waits at the bottom for the angle of the "
                 "spindle, and the point cuts beside the groove meanwhile",
             false;
    if (m.step == MillStep::restart) {
      if (!sense || *sense == SpindleState::off)
        return *error = "whether the spindle runs, and in which sense, is not known here", false;
      return put(SpindleRun{1, *sense});
    }
    Block b;
    if (side_) {
      ModalSet set;
      set.setting = Setting::comp;
      set.value = static_cast<std::uint8_t>(*side_);
      b.actions.push_back(action(set));
      side_.reset();
    }
    b.has_motion = true;
    Motion& motion = b.motion;
    motion.explicit_code = true;
    motion.keeps_modal = false;
    motion.kind = m.step == MillStep::rapid    ? MotionKind::rapid
                  : m.step == MillStep::feed   ? MotionKind::linear
                  : m.step == MillStep::thread ? MotionKind::thread
                  : m.ccw                      ? MotionKind::arc_ccw
                                               : MotionKind::arc_cw;
    if (m.step == MillStep::thread)
      lead(m, motion);
    else if (m.step != MillStep::rapid && !feed(m, b, error))
      return false;
    const bool arc = m.step == MillStep::arc;
    coordinate(motion, axes_.u, m.u, u, incremental, arc);
    coordinate(motion, axes_.v, m.v, v, incremental, arc);
    coordinate(motion, axes_.w, m.w, w, false, false);
    if (arc) {
      centre(motion, axes_.u, m.cu - u);
      centre(motion, axes_.v, m.cv - v);
    }
    u = m.u;
    v = m.v;
    w = m.w;
    blocks.push_back(made(line_, std::move(b)));
    return true;
  }
  /// The feed in force goes on behind the cycle.
  bool finish(std::string* error) {
    if (!changed_) return true;
    if (!feed_) return *error = "the feed after the cycle's own one is not known here", false;
    blocks.push_back(make_block(line_, action(SetFeed{Value{*feed_}, false})));
    return true;
  }

 private:
  template <class Data>
  bool put(Data data) {
    blocks.push_back(make_block(line_, action(std::move(data))));
    return true;
  }
  void lead(const MillMove& m, Motion& motion) const {
    auto extra = std::make_shared<MotionExtra>();
    extra->has_lead = true;
    extra->lead = Value{m.amount / unit_};
    extra->lead_axis = axes_.w;
    if (m.angle != 0) {
      extra->has_start_angle = true;
      extra->start_angle = Value{m.angle};
    }
    motion.extra = std::move(extra);
  }
  bool feed(const MillMove& m, Block& b, std::string* error) {
    const bool own = m.has_feed || m.feed_factor != 1;
    if (!own && !changed_) return true;
    if (!m.has_feed && !feed_) return *error = "the feed in force is not known here", false;
    const double f = tidy((m.has_feed ? m.feed / unit_ : *feed_) * m.feed_factor);
    if (changed_ && last_feed_ == f) return true;
    b.actions.push_back(action(SetFeed{Value{f}, false}));
    changed_ = !feed_ || f != *feed_;
    last_feed_ = f;
    return true;
  }
  /// Without the dust of the last binary places.
  static double tidy(double x) { return std::round(x * 1e9) / 1e9; }

  void coordinate(Motion& m, AxisId axis, double to, double from, bool by, bool always) const {
    if (std::isnan(to)) return;  // where the tool stands is not known, and it stays there
    if (!always && std::abs(to - from) < 1e-9) return;
    CoordWord c;
    c.axis = axis;
    c.mode = by ? WordMode::incremental : WordMode::absolute;
    c.value = Value{tidy((by ? to - from : to) / unit_)};
    m.coords.push_back(c);
  }
  void centre(Motion& m, AxisId axis, double by) const {
    CenterWord c;
    c.axis = axis;
    c.mode = CenterMode::from_start;
    c.scale = WordScale::radius;
    c.value = Value{tidy(by / unit_)};
    m.centers.push_back(c);
  }

  LineInfo line_;
  PlaneAxes axes_;
  double unit_;
  std::optional<double> feed_;
  bool changed_ = false;
  double last_feed_ = 0;
  std::optional<CompSide> side_;  ///< of the next move
};

}  // namespace

std::optional<double> place_after(const Block& b, const Facts& facts, AxisId axis) {
  if (!b.has_motion) return facts.position[axis];
  if (b.motion.extra || b.motion.frame != FrameUse::normal) return std::nullopt;
  for (const auto& c : b.motion.coords) {
    if (c.axis != axis) continue;
    const auto distance = setting_in<Distance>(b, facts, Setting::distance);
    const auto n = known_number(c.value);
    const bool absolute = c.mode == WordMode::absolute || (c.mode == WordMode::modal && distance == Distance::absolute);
    return absolute && c.scale == WordScale::modal ? n : std::nullopt;
  }
  return facts.position[axis];
}

MillCycles::MillCycles(const Program& program, const Routine& routine, const LegaliseContext& context,
                       const FeedsBefore& feeds)
    : context_(context), feeds_(feeds) {
  if (!has_milling(program)) return;
  find_contours(program, routine);
  mirrors_ = any_action(program, [](const Action& a) {
    const auto* f = std::get_if<FrameOp>(&a.data);
    return f != nullptr && (!f->change || f->change->kind == FrameKind::mirror);
  });
  written_ = written_data(program, context.source_machine);
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [this](const Statement& s) {
      const auto* assign = std::get_if<Assign>(&s.node);
      if (assign == nullptr) return;
      for (const auto& item : assign->items) {
        if (!item.to_system) continue;
        if (item.system.datum != Datum::tool_radius) continue;
        radius_written_ = true;
        const auto row = item.system.args.size() == 1 ? constant_value(item.system.args[0]) : std::nullopt;
        radius_anywhere_ = radius_anywhere_ || !row;
        if (row) radius_names_[*row] = datum_name(item.system);
      }
    });
  }
  // A tool or offset that is the only one of the program stays what it is, wherever control comes from.
  std::set<std::optional<std::int32_t>> tools, offsets;
  for (const auto& r : program.routines) {
    for_each_statement(r.body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
        if (const auto* t = std::get_if<ToolSelect>(&b->actions[i].data))
          tools.insert(has_number(*t) ? whole(t->number) : std::nullopt);
        if (const auto* d = std::get_if<ToolOffset>(&b->actions[i].data)) offsets.insert(whole(d->number));
      }
    });
  }
  const LabelUses uses = label_uses(program, routine);
  std::set<std::uint32_t> outside;  // of every structure
  for (const auto& s : routine.body) outside.insert(s.id);
  Site site;
  if (routine.kind == RoutineKind::main) site.offset = 0;
  const auto forget = [&] {
    if (tools.size() > 1) site.tool.reset();
    if (!offsets.empty() && !(offsets.size() == 1 && offsets.count(site.offset) != 0)) site.offset.reset();
    ++site.after;
  };
  for_each_statement(routine.body, [&](const Statement& s) {
    for (const auto& l : labels_on(s.line)) {
      if (uses.is_target(l)) forget();
    }
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr) {
      if (!ToolHeight::keeps(s) && !std::holds_alternative<Jump>(s.node)) forget();
      return;
    }
    if (outside.count(s.id) == 0 || s.line.skip_mask != 0) ++site.after;
    site.before = site.after;
    if (!stays(*b) || outside.count(s.id) == 0 || s.line.skip_mask != 0) ++site.after;
    for (const auto& a : b->actions) {
      if (const auto* t = std::get_if<ToolSelect>(&a.data))
        site.tool = has_number(*t) && s.line.skip_mask == 0 ? whole(t->number) : std::nullopt;
      if (const auto* d = std::get_if<ToolOffset>(&a.data)) site.offset = whole(d->number);
    }
    sites_[s.id] = site;
  });
}

void MillCycles::find_contours(const Program& program, const Routine& routine) {
  for_each_statement(routine.body, [&](const Statement& s) {
    const auto* b = std::get_if<Block>(&s.node);
    for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
      const auto* d = std::get_if<CycleDefine>(&b->actions[i].data);
      const auto* hole = d != nullptr && d->cycle ? std::get_if<HoleCycle>(&d->cycle->node) : nullptr;
      if (hole == nullptr) continue;
      std::string error;
      for (const auto& named : cycles::contours_named(*hole)) {
        for (const auto* block : cycles::profile_blocks(program, routine, named, &error))
          contour_blocks_.insert(block->id);
      }
    }
  });
}

std::optional<double> MillCycles::radius(const Site& site, double length_unit, std::string* error, bool* none) const {
  const auto& machine = context_.source_machine;
  auto names = machine::tool_data_names(machine.policies.tool_radius_data, site.tool, site.offset);
  names.emplace_back("TOOL_RADIUS");
  for (const auto& name : names) {
    if (name.find('*') != std::string::npos) {
      const auto stem = name.substr(0, name.find_first_of("[*"));
      const auto like = [&stem](const auto& item) { return item.first.starts_with(stem); };
      if (std::none_of(written_.begin(), written_.end(), like) &&
          std::none_of(machine.data.begin(), machine.data.end(), like))
        continue;
      return *error = "which tool is in use, and its radius, is not known here", std::nullopt;
    }
    const bool in_mm = name == "TOOL_RADIUS" || machine.policies.machine_data_units != machine::MachineDataUnits::modal;
    const double scale = in_mm ? 1 : length_unit;
    if (const auto it = written_.find(name); it != written_.end()) {
      if (!it->second) return *error = "the radius of the tool is computed when the program runs", std::nullopt;
      return *it->second * scale;
    }
    if (const auto it = machine.data.find(name); it != machine.data.end()) return it->second * scale;
  }
  // As the program itself writes it for the offset in force.
  if (const auto own = site.offset ? radius_names_.find(*site.offset) : radius_names_.end();
      own != radius_names_.end() && !radius_anywhere_) {
    if (const auto& value = written_.at(own->second)) return *value;
  }
  if (radius_written_) return *error = "the program writes the radius of its tools", std::nullopt;
  if (!machine.tools.empty()) {
    if (!site.tool) return *error = "which tool is in use, and its radius, is not known here", std::nullopt;
    const auto tool =
        std::find_if(machine.tools.begin(), machine.tools.end(), [&](const auto& t) { return t.number == *site.tool; });
    if (tool != machine.tools.end() && tool->radius > 0) return tool->radius;
  }
  *none = true;
  return *error = "its passes depend on the radius of the tool, which the source's machine profile does not give",
         std::nullopt;
}

std::optional<MillCycles::Reading> MillCycles::read(const HoleCycle& c, const Statement& s, const Block& b,
                                                    const Facts& facts, std::optional<double> defined_at,
                                                    std::string* error) const {
  const auto units = setting_in<Units>(b, facts, Setting::units);
  const auto distance = setting_in<Distance>(b, facts, Setting::distance);
  const auto in_plane = setting_in<Plane>(b, facts, Setting::plane);
  const auto diameter = setting_in<DiameterMode>(b, facts, Setting::diameter);
  const auto axis_id = cycle_axis(c, b, facts);
  const auto it = sites_.find(s.id);
  if (!axis_id || !units || !distance || !in_plane || it == sites_.end() || *axis_id != plane_axes(*in_plane).w)
    return *error = "plane, units or absolute and incremental are not known here", std::nullopt;
  if (diameter != DiameterMode::radius && *in_plane != Plane::yz)
    return *error = "its places would be diameters", std::nullopt;
  if (setting_in<CompSide>(b, facts, Setting::comp) != CompSide::off)
    return *error = "radius compensation is on, or may be", std::nullopt;
  const double unit = *units == Units::inch ? 25.4 : 1;
  cycles::HoleContext context;
  context.length_unit = context.level_unit = context.feed_unit = unit;
  context.distance = *distance;
  context.height = defined_at.value_or(unknown);
  const auto literal = [](const Value& v) { return known_number(v); };
  auto levels = cycles::resolve(c, context, literal, error);
  auto words = cycles::resolve(c.mill, {unit, unit, unit, unit}, literal, error);
  if (!levels || !words) {
    if (error->empty()) *error = "its words are computed when the program runs";
    return std::nullopt;
  }
  const auto plane = setting_in<RetractPlane>(b, facts, Setting::retract_plane);
  const double leaves = cycles::retract_level(*levels, plane.value_or(RetractPlane::initial));
  const bool by_plane = !levels->has_retract && !plane;
  if (std::isnan(levels->reference + levels->surface + levels->bottom + leaves) || by_plane)
    return *error = "the height of the tool before it, or its retract plane, is not known here", std::nullopt;
  Reading reading{*std::move(words), *std::move(levels), plane_axes(*in_plane), unit, plane, it->second, {}};
  if (!cycles::has_contours(c)) return reading;
  auto contours = cycles::contours_in(c, error);
  if (!contours) return std::nullopt;
  reading.contours = *std::move(contours);
  return reading;
}

bool MillCycles::stand(const Reading& r, const Block& b, const Facts& facts, cycles::MillContext& context) const {
  const bool own_place = !r.contours.empty() || (r.words.words.contains("u") && r.words.words.contains("v"));
  auto u = place_after(b, facts, r.axes.u), v = place_after(b, facts, r.axes.v);
  if (!b.has_motion && end_ && end_->after == r.site.before) {
    u = end_->u / r.unit;
    v = end_->v / r.unit;
  }
  end_.reset();
  const bool incremental = !own_place && (!u || !v);
  context.u = incremental ? 0 : u ? *u * r.unit : unknown;
  context.v = incremental ? 0 : v ? *v * r.unit : unknown;
  return incremental;
}

std::optional<double> MillCycles::radius_of(const Reading& r, bool* by_middle, std::string* error) const {
  const auto need = cycles::needs_radius(r.words);
  if (need == cycles::RadiusNeed::none) return 0;
  if (r.words.tool_radius) return r.words.tool_radius;
  bool none = false;
  const auto known = radius(r.site, r.unit, error, &none);
  if (known) return known;
  *by_middle = none && need == cycles::RadiusNeed::lead;
  if (!*by_middle) return std::nullopt;
  error->clear();
  return 0;
}

/// What the way of the moves rests on.
static void tell_way(const cycles::MillNumbers& words, bool by_middle, const LineInfo& where, Diagnostics& told) {
  if (words.shape->kind == cycles::MillKind::contour_pocket)
    told.warning("TRN-511", where.span,
                 "the way in this pocket with islands is this program's own: the source's control may "
                 "go otherwise and clears the same volume",
                 "compare with the control where the way matters (RUN-090)");
  if (by_middle)
    told.warning("TRN-420", where.span,
                 "the way onto the contour and off it is counted from the tool's middle, not from its edge: the "
                 "source's machine profile does not give the radius of the tool",
                 "give it with --tools FILE, in the profile's \"tools\" or by --set TOOL_RADIUS=5; the tool plunges "
                 "nearer to the contour by its radius");
}

std::optional<Explosion> MillCycles::write_out(const HoleCycle& c, const Statement& s, const Block& b,
                                               const Facts& facts, std::optional<double> height,
                                               std::optional<double> defined_at, std::optional<SpindleState> sense,
                                               std::optional<SpindleState> turns, std::string* error) const {
  const auto read_words = read(c, s, b, facts, defined_at, error);
  if (!read_words) return std::nullopt;
  const Reading& r = *read_words;
  cycles::MillContext context;
  bool by_middle = false;
  const auto tool_radius = radius_of(r, &by_middle, error);
  if (!tool_radius) return std::nullopt;
  context.tool_radius = *tool_radius;
  machine::tell_pocket(context_.source_machine.policies, context);
  if (!r.contours.empty()) context.contours = &r.contours;
  const bool incremental = stand(r, b, facts, context);
  context.w = height.value_or(unknown);
  context.plane = r.plane.value_or(RetractPlane::initial);
  const auto& words = r.words.words;
  const double way = words.contains("sense") ? words.at("sense") : 0;
  const bool by_spindle = !words.contains("half_length") && !words.contains("signed_radius") && way < 2;
  if (by_spindle && cycles::has_sense(r.words) && !sense)
    return *error = "climb milling depends on the sense of the spindle, which is not known here", std::nullopt;
  context.spindle_ccw = sense == SpindleState::ccw;
  if (r.words.shape->kind == cycles::MillKind::chased && turns == SpindleState::off)
    return *error = "the spindle stands before it, and its passes follow a spindle that turns", std::nullopt;
  const auto moves = cycles::expand(r.words, r.levels, context, error);
  if (!moves) return std::nullopt;
  const FeedBefore feed = feeds_.at(s, b, facts);
  MillWriter writer(s.line, r.axes, r.unit, feed.value);
  writer.u = context.u;
  writer.v = context.v;
  writer.w = context.w;
  writer.incremental = incremental;
  writer.sense = turns;
  for (const auto& m : *moves) {
    if (!writer.add(m, facts.spindle, error)) return std::nullopt;
  }
  if (!feed.none && !writer.finish(error)) return std::nullopt;
  tell_way(r.words, by_middle, s.line, context_.diagnostics);
  if (!incremental) end_ = End{writer.u, writer.v, r.site.after};
  return Explosion{std::move(writer.blocks), writer.w};
}

std::vector<cycles::PocketPoint> MillCycles::entries(const HoleCycle& c, const Block& b, const Facts& facts,
                                                     std::string* error) const {
  const auto units = setting_in<Units>(b, facts, Setting::units);
  if (!units) return *error = "the units are not known here", std::vector<cycles::PocketPoint>{};
  const double unit = *units == Units::inch ? 25.4 : 1;
  const auto words = cycles::resolve(
      c.mill, {unit, unit, unit, unit}, [](const Value& v) { return known_number(v); }, error);
  if (!words) {
    if (error->empty()) *error = "its words are computed when the program runs";
    return {};
  }
  Site site;
  const auto number = [&words](std::string_view name) -> std::optional<std::int32_t> {
    const auto it = words->words.find(name);
    return it == words->words.end() ? std::nullopt : std::optional(saturate<std::int32_t>(it->second));
  };
  site.tool = number("tool");
  site.offset = number("offset");
  bool none = false;
  const auto r = words->tool_radius ? words->tool_radius : radius(site, unit, error, &none);
  const auto contours = r ? cycles::contours_in(c, error) : std::nullopt;
  if (!contours) return {};
  cycles::MillContext context;
  context.tool_radius = *r;
  context.contours = &*contours;
  machine::tell_pocket(context_.source_machine.policies, context);
  return cycles::pocket_entries(*words, context, error);
}

}  // namespace cnctrans::ir::passes
