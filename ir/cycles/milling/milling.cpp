#include "ir/cycles/milling/milling.h"

#include <algorithm>
#include <array>

#include "ir/cycles/milling/mill_contour.h"
#include "ir/cycles/milling/mill_moves.h"

namespace cnctrans::ir::cycles {

namespace {

using enum MillQuantity;

constexpr std::array milling_parameters = {
    MillParameter{"u", place_u, "place in the plane, first axis; left out: where the tool stands"},
    MillParameter{"v", place_v, "place in the plane, second axis"},
    MillParameter{"length", length, "size along the first axis, over all"},
    MillParameter{"width", length, "size along the second axis, over all"},
    MillParameter{"half_length", length, "half the size along the first axis; + is clockwise, - counter-clockwise"},
    MillParameter{"half_width", length, "half the size along the second axis"},
    MillParameter{"corner", length, "radius of the corners; 0: that of the tool"},
    MillParameter{"radius", length, "of a circle; of the circle on which slots lie"},
    MillParameter{"signed_radius", length, "of a circle; + is clockwise, - counter-clockwise"},
    MillParameter{"angle", plain, "of the first axis of the shape to the plane's, degrees"},
    MillParameter{"angle_step", plain, "from one slot to the next, degrees; 0: evenly round"},
    MillParameter{"opening", plain, "angle that a slot on a circle spans between the middles of its ends, degrees"},
    MillParameter{"count", plain, "number of slots"},
    MillParameter{"infeed", length, "largest infeed; levels are equal; 0: in one"},
    MillParameter{"signed_infeed", length,
                  "+ equal infeeds not above it, - infeeds of its size and a smaller last one"},
    MillParameter{"step", length, "largest step in the plane; 0: by step_factor"},
    MillParameter{"step_factor", plain, "step in tool diameters where none is given"},
    MillParameter{"wall_stock", length, "left at the wall by roughing"},
    MillParameter{"floor_stock", length, "left at the floor by roughing"},
    MillParameter{"wall_pass", length,
                  "left by roughing at the wall and taken by a last pass on every level; unsigned"},
    MillParameter{"mill_feed", feed, "in the plane; left out or 0: the feed in force"},
    MillParameter{"plunge_feed", feed, "into the material; left out or 0: plunge_factor times the feed in force"},
    MillParameter{"plunge_factor", plain, "see plunge_feed; 1 where left out"},
    MillParameter{"finish_feed", feed, "of finishing; left out or 0: mill_feed"},
    MillParameter{"finish_plunge_feed", feed, "of finishing, into the material; left out or 0: plunge_feed"},
    MillParameter{"finish_infeed", length, "of finishing the wall; 0: in one"},
    MillParameter{"finish_speed", plain, "rev/min of finishing; left out or 0: as before"},
    MillParameter{"sense", plain, "0 climb, 1 conventional milling, 2 clockwise, 3 counter-clockwise"},
    MillParameter{"operation", plain, "0 roughing and finishing, 1 roughing, 2 finishing"},
    MillParameter{"variant", plain, "units 1 roughing, 2 finishing; tens: the way in, or the way of the passes"},
    MillParameter{"plunge_radius", length, "of the helix (way in 2); of a ramp (3) its angle is in degrees"},
    MillParameter{"plunge_pitch", length, "of the helix"},
    MillParameter{"blank_length", length, "of a blank that is there already"},
    MillParameter{"blank_width", length, "of a blank that is there already"},
    MillParameter{"blank_depth", length, "of a blank that is there already"},
    MillParameter{"blank_radius", length, "of a round blank"},
    MillParameter{"blank_diameter", length, "of a round blank"},
    MillParameter{"diameter", length, "of a circle; the larger one of a thread"},
    MillParameter{"core", length, "the smaller diameter of a thread"},
    MillParameter{"pitch", length, "of a thread"},
    MillParameter{"per_step", plain,
                  "of a thread: 0 one turn, 1 turns over the whole depth, more: a turn every so many pitches"},
    MillParameter{"lead_feed", feed, "onto the helix of a thread; left out or 0: mill_feed"},
    MillParameter{"external", plain, "1: the thread lies outside"},
    MillParameter{"side", plain, "of the contour: 40 the tool goes on it, 41 left, 42 right"},
    MillParameter{"approach", plain, "units 1 line, 2 quadrant, 3 semicircle; tens 1: in space"},
    MillParameter{"approach_length", length,
                  "of the line from the tool's edge; radius of the way of the tool's middle"},
    MillParameter{"leave", plain, "as approach"},
    MillParameter{"leave_length", length, "as approach_length"},
    MillParameter{"link_feed", feed, "between the end of the contour and its start; left out: mill_feed"},
    MillParameter{"overrun", length, "of a face pass beyond the part, along the pass"},
    MillParameter{"overrun_across", length, "of the last face pass beyond the part, across"},
    MillParameter{"from_dimension", plain,
                  "1: a face begins at the corner that is dimensioned, wherever the tool stands"},
    MillParameter{"pass_angle", plain, "of parallel passes, degrees; left out: rings along the contour"},
    MillParameter{"plunge_angle", plain, "of the ramp into the material, degrees; left out, 0 or 90: straight down"},
    MillParameter{"along", plain, "1 in the sense in which the outer contour is programmed, -1 in the opposite one"},
    MillParameter{"outside", plain, "of several contours: 0 the largest one, 1 the first one"},
    MillParameter{"tool", plain, "number of the tool that mills"},
    MillParameter{"offset", plain, "number of its offset"},
    MillParameter{"depth", length, "of a thread, from the hole's wall"},
    MillParameter{"last_pass", length, "depth of the last pass of a thread"},
    MillParameter{"passes", plain, "of a thread; left out: 1"},
    MillParameter{"starts", plain, "of a thread; left out: 1"},
    MillParameter{
        "radial", plain,
        "what takes the point to its depth: 0 the tool itself, 1 2 the plane's first axis upward and downward, "
        "3 4 its second"},
    MillParameter{
        "back", plain,
        "out of a thread: 0 spindle stopped at `angle` and 2 mm aside that way, 1 back to the middle, 2 along "
        "the thread with the spindle reversed"},
    MillParameter{"apart", plain, "1: contours that cross each other are refused"},
};

constexpr std::array shapes = {
    MillShape{"pocket.rect", MillKind::rectangle,
              "u,v,length,width,half_length,half_width,corner,angle,infeed,signed_infeed,step,step_factor,wall_stock,"
              "floor_stock,wall_pass,mill_feed,plunge_feed,plunge_factor,finish_feed,finish_plunge_feed,finish_infeed,"
              "finish_speed,sense,"
              "operation,variant,plunge_radius,plunge_pitch,blank_length,blank_width,blank_depth",
              "rectangular pocket"},
    MillShape{
        "pocket.circle", MillKind::circle,
        "u,v,radius,signed_radius,infeed,signed_infeed,step,step_factor,wall_stock,floor_stock,wall_pass,"
        "mill_feed,plunge_feed,plunge_factor,finish_feed,finish_plunge_feed,finish_infeed,finish_speed,sense,operation,"
        "variant,plunge_radius,plunge_pitch,blank_length,blank_depth",
        "circular pocket"},
    MillShape{"slot.radial", MillKind::slot,
              "u,v,count,length,width,radius,angle,angle_step,infeed,step,step_factor,wall_stock,floor_stock,mill_feed,"
              "plunge_feed,finish_feed,finish_infeed,finish_speed,sense,operation",
              "slots that point to the middle of a circle"},
    MillShape{"slot.long", MillKind::long_hole, "u,v,count,length,radius,angle,angle_step,infeed,mill_feed,plunge_feed",
              "long holes of the tool's width that point to the middle of a circle"},
    MillShape{"slot.ring", MillKind::ring_slot,
              "u,v,count,opening,width,radius,angle,angle_step,infeed,step,step_factor,wall_stock,mill_feed,"
              "plunge_feed,finish_feed,finish_infeed,finish_speed,sense,operation",
              "slots along a circle"},
    MillShape{"face", MillKind::face,
              "u,v,length,width,angle,infeed,step,step_factor,floor_stock,mill_feed,overrun,overrun_across,variant,"
              "from_dimension",
              "face of a rectangle"},
    MillShape{"boss.rect", MillKind::boss,
              "u,v,length,width,corner,angle,infeed,wall_stock,floor_stock,mill_feed,plunge_feed,sense,variant,"
              "blank_length,blank_width",
              "rectangular spigot"},
    MillShape{"boss.circle", MillKind::round_boss,
              "u,v,radius,diameter,infeed,wall_stock,floor_stock,mill_feed,plunge_feed,sense,variant,blank_radius,"
              "blank_diameter",
              "circular spigot"},
    MillShape{
        "path", MillKind::path,
        "infeed,wall_stock,floor_stock,mill_feed,plunge_feed,variant,side,approach,approach_length,link_feed,leave,"
        "leave_length",
        "path along a contour"},
    MillShape{"pocket.contour", MillKind::contour_pocket,
              "infeed,signed_infeed,step,step_factor,wall_stock,floor_stock,mill_feed,plunge_feed,plunge_factor,"
              "sense,operation,pass_angle,plunge_angle,along,outside,apart",
              "pocket along contours, with islands"},
    MillShape{"pocket.entries", MillKind::contour_pocket,
              "infeed,signed_infeed,step,step_factor,wall_stock,floor_stock,mill_feed,plunge_feed,plunge_factor,"
              "sense,operation,pass_angle,plunge_angle,along,outside,apart,tool,offset",
              "holes where the roughing of such a pocket begins"},
    MillShape{"thread.mill", MillKind::thread, "u,v,diameter,core,pitch,mill_feed,sense,external",
              "thread milled on a helix"},
    MillShape{"bore.helix", MillKind::helix_bore, "u,v,diameter,pitch,mill_feed,plunge_feed,sense",
              "bore milled on a helix"},
    MillShape{"thread.helix", MillKind::helix_thread,
              "u,v,diameter,pitch,per_step,mill_feed,plunge_feed,lead_feed,sense,external",
              "thread milled in turns of its pitch, led in and out from the middle"},
    MillShape{"thread.chased", MillKind::chased, "pitch,depth,last_pass,passes,starts,angle,radial,back",
              "thread by a single point along the tool axis"},
};

bool in_list(std::string_view rest, std::string_view name) {
  while (!rest.empty()) {
    const auto comma = std::min(rest.find(','), rest.size());
    if (rest.substr(0, comma) == name) return true;
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return false;
}
double factor_of(MillQuantity q, const MillUnits& units) {
  switch (q) {
    case place_u: return units.u;
    case place_v: return units.v;
    case length: return units.length;
    case feed: return units.feed;
    case plain: break;
  }
  return 1;
}

}  // namespace

std::span<const MillParameter> mill_parameters() {
  return milling_parameters;
}
const MillParameter* find_mill_parameter(std::string_view name) {
  const auto it = std::find_if(milling_parameters.begin(), milling_parameters.end(),
                               [name](const auto& p) { return p.name == name; });
  return it == milling_parameters.end() ? nullptr : &*it;
}
std::span<const MillShape> mill_shapes() {
  return shapes;
}
const MillShape* find_mill_shape(std::string_view name) {
  const auto it = std::find_if(shapes.begin(), shapes.end(), [name](const auto& s) { return s.name == name; });
  return it == shapes.end() ? nullptr : &*it;
}

bool has_sense(const MillNumbers& mill) {
  return mill.shape != nullptr && in_list(mill.shape->parameters, "sense") && !mill.words.contains("along");
}

RadiusNeed needs_radius(const MillNumbers& mill) {
  if (mill.shape != nullptr && mill.shape->kind == MillKind::chased) return RadiusNeed::none;
  if (mill.shape == nullptr || mill.shape->kind != MillKind::path) return RadiusNeed::moves;
  const auto side = mill.words.find("side");
  return side != mill.words.end() && side->second == 40 ? RadiusNeed::none : RadiusNeed::lead;
}

std::optional<MillNumbers> resolve(const MillWords& words, const MillUnits& units, const Evaluate& evaluate,
                                   std::string* error) {
  error->clear();
  MillNumbers out;
  out.shape = find_mill_shape(words.shape);
  if (out.shape == nullptr) {
    *error = "there is no milling cycle of the shape " + words.shape;
    return std::nullopt;
  }
  for (const auto& [word, v] : words.words) {
    if (word == tool_radius_word && v.literal()) out.tool_radius = v.number;
    if (is_contour_word(word) || is_kept_word(word)) continue;
    const auto* p = find_mill_parameter(word);
    if (p == nullptr || !in_list(out.shape->parameters, word)) {
      *error = "the milling cycle " + words.shape + " has no parameter " + word;
      return std::nullopt;
    }
    const auto x = evaluate(v);
    if (!x) return std::nullopt;
    // A ramp's angle stands where a helix has its radius.
    const bool angle = p->name == "plunge_radius" && detail::plunge_of(out) == detail::Plunge::ramp;
    out.words[p->name] = *x * (angle ? 1 : factor_of(p->quantity, units));
  }
  return out;
}

std::optional<std::vector<MillMove>> expand(const MillNumbers& mill, const HoleNumbers& levels,
                                            const MillContext& context, std::string* error) {
  error->clear();
  if (context.tool_radius <= 0 && needs_radius(mill) == RadiusNeed::moves) {
    *error = "a milling cycle needs the radius of the tool";
    return std::nullopt;
  }
  detail::MillPath path(mill, levels, context);
  bool done = false;
  switch (mill.shape->kind) {
    case MillKind::rectangle:
    case MillKind::circle: done = detail::pocket(path, mill.shape->kind == MillKind::circle, error); break;
    case MillKind::slot: done = detail::slots(path, error); break;
    case MillKind::long_hole: done = detail::long_holes(path, error); break;
    case MillKind::ring_slot: done = detail::ring_slots(path, error); break;
    case MillKind::boss:
    case MillKind::round_boss: done = detail::boss(path, mill.shape->kind == MillKind::round_boss, error); break;
    case MillKind::thread: done = detail::milled_thread(path, error); break;
    case MillKind::helix_bore: done = detail::helix_bore(path, error); break;
    case MillKind::helix_thread: done = detail::helix_thread(path, error); break;
    case MillKind::chased: done = detail::chased_thread(path, error); break;
    case MillKind::face: done = detail::face(path, error); break;
    case MillKind::path: done = detail::contour_path(path, context.contours, error); break;
    case MillKind::contour_pocket: done = detail::contour_pocket(path, context, error); break;
  }
  if (done && path.too_many()) {
    *error = "the cycle has too many passes";
    done = false;
  }
  if (done && path.lost()) {
    *error = "the place of the tool before it is not known here";
    done = false;
  }
  if (!done) return std::nullopt;
  return path.take();
}

}  // namespace cnctrans::ir::cycles
