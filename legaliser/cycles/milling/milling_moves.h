// Milling cycles written out move by move.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ir/cycles/milling/milling.h"
#include "ir/cycles/milling/pocket_area.h"
#include "legaliser/cycles/parts/cycle_parts.h"

namespace cnctrans::ir::passes {

struct PocketSource;

/// Where the tool stands behind the motion of the block, in program units; nullopt: not known.
std::optional<double> place_after(const Block& b, const Facts& facts, AxisId axis);

/// The milling cycles of a program: the tool in use at every block, and the radii that profile and program give.
class MillCycles {
 public:
  MillCycles(const Program& program, const Routine& routine, const LegaliseContext& context, const FeedsBefore& feeds);

  /// The moves of one machining as blocks, behind the motion of the block itself; nullopt with a sentence: they can't
  /// be told here. `height`, `defined_at`: of the tool, mm.
  [[nodiscard]] std::optional<Explosion> write_out(const HoleCycle& cycle, const Statement& s, const Block& b,
                                                   const Facts& facts, std::optional<double> height,
                                                   std::optional<double> defined_at, std::optional<SpindleState> sense,
                                                   std::optional<SpindleState> turns, std::string* error) const;
  /// A pocket as a cycle of the target that leaves the same part by other passes, when the options ask for it; nullopt
  /// with a sentence: none. `last_resort`: without being asked for too, unless they forbid the target's cycles.
  struct Similar {
    Body blocks;
    std::optional<double> end_height;  ///< mm
    std::string differs;
  };
  [[nodiscard]] std::optional<Similar> similar(const HoleCycle& cycle, const Statement& s, const Block& b,
                                               const Facts& facts, std::optional<double> defined_at,
                                               std::optional<SpindleState> sense, bool last_resort,
                                               std::string* why) const;
  /// Where a hole cycle that finds its places in a pocket runs, mm; empty with a sentence: they can't be told here.
  [[nodiscard]] std::vector<cycles::PocketPoint> entries(const HoleCycle& cycle, const Block& b, const Facts& facts,
                                                         std::string* error) const;
  /// Ids of the blocks that the contours of cycles which have been read stand in.
  [[nodiscard]] const std::set<std::uint32_t>& contour_blocks() const { return contour_blocks_; }

 private:
  struct Site {
    std::optional<std::int32_t> tool, offset;
    std::uint64_t before = 0, after = 0;  ///< statements so far that may move the tool or its zero
  };
  /// Where the last machining that was written out left the tool, mm.
  struct End {
    double u = 0, v = 0;
    std::uint64_t after = 0;
  };
  /// A machining in numbers, and what holds where it runs.
  struct Reading {
    cycles::MillNumbers words;
    cycles::HoleNumbers levels;
    PlaneAxes axes;
    double unit = 1;  ///< mm
    std::optional<RetractPlane> plane;
    Site site;
    std::vector<cycles::MillContour> contours;
  };
  /// nullopt with a sentence: it can't be told here.
  [[nodiscard]] std::optional<Reading> read(const HoleCycle& cycle, const Statement& s, const Block& b,
                                            const Facts& facts, std::optional<double> defined_at,
                                            std::string* error) const;
  /// Where the tool stands in the plane when it runs. True: nobody knows; its moves are increments from there.
  bool stand(const Reading& r, const Block& b, const Facts& facts, cycles::MillContext& context) const;
  /// Of the tool, mm; 0 where it has no need of one, or (`by_middle`) where its lead is counted from the tool's middle.
  [[nodiscard]] std::optional<double> radius_of(const Reading& r, bool* by_middle, std::string* error) const;
  /// What a pocket is to the target's own cycle; nullopt with a sentence: there can be none.
  [[nodiscard]] std::optional<PocketSource> pocket_source(const HoleCycle& cycle, const Statement& s, const Block& b,
                                                          const Facts& facts, std::optional<SpindleState> sense,
                                                          std::string* why) const;
  /// The block of the cycle; the way to its place stands in it, or before it.
  Block way_to_pocket(Statement&& to, Body& out) const;
  /// `none`: nobody gives one.
  [[nodiscard]] std::optional<double> radius(const Site& site, double length_unit, std::string* error,
                                             bool* none) const;

  const LegaliseContext& context_;
  const FeedsBefore& feeds_;
  bool mirrors_ = false;                        ///< the program, somewhere
  bool radius_written_ = false;                 ///< by the program, under any name
  bool radius_anywhere_ = false;                ///< of a computed offset
  std::map<double, std::string> radius_names_;  ///< by the number of the offset
  mutable std::optional<End> end_;
  void find_contours(const Program& program, const Routine& routine);
  std::set<std::uint32_t> contour_blocks_;
  std::map<std::uint32_t, Site> sites_;                   ///< by id of the block
  std::map<std::string, std::optional<double>> written_;  ///< data the program writes; nullopt: not one fixed number
};

}  // namespace cnctrans::ir::passes
