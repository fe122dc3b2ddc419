#include "ir/check/missing_features.h"

#include <array>
#include <cassert>

namespace cnctrans::ir {

namespace {
// Keys in alphabetical order. A row disappears in the commit that builds the feature.
constexpr std::array features{
    MissingFeature{"beside.compensation", "corrections that the control makes beside the programmed path",
                   "the trace shows programmed positions; the machine adds to them", true},
    MissingFeature{"beside.coupling", "axes and spindles that follow others (coupling, trailing, electronic gear)",
                   "the trace shows programmed positions; the follower moves on the machine only", true},
    MissingFeature{"beside.data", "data of the machine that the program sets and the run does not use",
                   "they change how the machine works, not the programmed positions of this run", true},
    MissingFeature{"beside.machine_errors", "corrections of the machine's own errors (screws, sag, backlash, heat)",
                   "they are measured on one machine; every other one has its own", true, true},
    MissingFeature{"beside.machine_tuning",
                   "settings that the machine's own drives, filters and compressors are tuned by",
                   "they are found on one machine; every other one has its own", true, true},
    MissingFeature{"beside.realtime", "actions in real time (synchronised actions, interrupts, oscillation)",
                   "they depend on the machine's signals and on time", true},
    MissingFeature{"beside.tool_management", "management of tools and magazines",
                   "the magazine is known to the machine only", true},
    MissingFeature{"block.word", "a word whose meaning is not carried", "no IR action for it yet"},
    MissingFeature{"contour.table", "tables of prepared contours (CONTPRON) that the program works on",
                   "contours that the text tells and that have no relief cut are carried"},
    MissingFeature{"cycle.hole", "parameters of hole cycles whose meaning is not sure",
                   "the cycles are carried; these words are not described where the project looks them up"},
    MissingFeature{"cycle.milling", "pockets by words that are not known, depth profiles, engraving",
                   "pockets (with islands too), slots, faces, spigots, milled threads and paths along a contour are "
                   "carried"},
    MissingFeature{"cycle.pattern", "free lists of hole positions by increments",
                   "lines, circles, grids and lists of absolute positions are carried"},
    MissingFeature{"cycle.turning", "turning cycles whose moves are not described (contour turning and grooving)",
                   "read and kept; their sequence is not in the references"},
    MissingFeature{"feed.of_the_tool", "a feed for each tooth, a cutting speed for the diameter of the tool",
                   "carried where the text tells the kind of feed, the kind of speed and the unit"},
    MissingFeature{"frame.measured", "a measured frame put into the chain of frames (ADDFRAME)",
                   "carried but for frames of all channels, of the tool and inside of the programmable one"},
    MissingFeature{"language.computed_block", "a block whose text is computed when the program runs (EXECSTRING)",
                   "written texts, and numbers joined to them as values, are carried"},
    MissingFeature{"language.macro", "macros of the machine builder called by a code", "their text is on the machine"},
    MissingFeature{"language.statement", "a statement of the control that the IR does not carry",
                   "read and kept, not executed"},
    MissingFeature{"language.synchronised", "synchronised actions and couplings", "depends on the machine's real time"},
    MissingFeature{"language.system_variable", "a system variable without a neutral meaning",
                   "its value is known only to the machine"},
    MissingFeature{"language.other_mode", "programs in another language of the control (G291, ISOCALL)",
                   "what the codes mean there is set by machine data"},
    MissingFeature{"machine.axis", "a word of an axis that the machine does not have",
                   "the profile of the machine names its axes"},
    MissingFeature{"machine.geometry_axes", "other axes in the place of X, Y and Z (GEOAX)",
                   "straight moves and shifts are carried; arcs, cycles, compensation and data of the axis are not"},
    MissingFeature{"machine.index_positions", "positions by a computed number of steps in the table (CIC)",
                   "written numbers are carried; their sign is the direction"},
    MissingFeature{"machine.makers_own", "functions that the machine builder defines (OEMIPO, G810 to G829, OMA)",
                   "what they do is in the software of the machine"},
    MissingFeature{"machine.tools", "the tool environment and the numbers of edges, asked or set by the program",
                   "the tools are known to the machine only"},
    MissingFeature{"motion.geometry", "profiles given by angles, tangency and intersections",
                   "the data of such a profile are solved by the control"},
    MissingFeature{"motion.inclined", "oblique plunge grinding (G5, G7)",
                   "carried where the text tells the angle (TRAANG) and positions are absolute"},
    MissingFeature{"motion.involute", "involutes (INVCW, INVCCW)", "no curve of this kind is carried"},
    MissingFeature{"motion.length_axis", "the axis of the tool's length, chosen apart from the plane",
                   "programmed positions are those of the tool's point; other controls tie the length to the plane"},
    MissingFeature{"motion.polynomial", "polynomials of axes that a variable names",
                   "polynomials of the axes of the machine are carried"},
    MissingFeature{"motion.probe", "probing moves and cycles", "executed as moves to the expected contact later"},
    MissingFeature{"motion.spline", "splines with tangents of their own, or whose points stand in another program",
                   "splines through points, by control points and their weights are carried"},
    MissingFeature{"motion.transformation", "kinematic transformations and inclined planes",
                   "needs the machine's kinematics in the profile"},
    MissingFeature{"text.unread", "a block that could not be read", "not a block of this language, or damaged"},
    MissingFeature{"work_zone", "work zones and protection zones", "no effect on the path; kept and reported"},
};
}  // namespace

std::span<const MissingFeature> missing_features() {
  return features;
}

std::string_view not_translated_hint(std::string_view key) {
  if (key == "beside.coupling")
    return "couple the axes by hand with the target's own function and the factor of the follower: the moves of the "
           "program name the leading axis only";
  return "translate the line by hand before the program is run: what follows is written as if it stood there";
}

const MissingFeature* find_missing_feature(std::string_view key) {
  for (const auto& f : features) {
    if (f.key == key) return &f;
  }
  return nullptr;
}

const MissingFeature& missing_feature(std::string_view key) {
  if (const auto* f = find_missing_feature(key)) return *f;
  assert(false && "unknown key of the missing-features registry");
  return features.front();
}

}  // namespace cnctrans::ir
