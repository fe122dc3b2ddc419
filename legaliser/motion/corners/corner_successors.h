// What follows the corners of a program (RND, CHR, CHF) on the ways that it can take.
#pragma once

#include <map>
#include <vector>

#include "base/source.h"
#include "legaliser/analysis/path_points.h"

namespace cnctrans::ir::passes {

enum class Going : std::uint8_t {
  stands,   ///< surely goes nowhere
  perhaps,  ///< moves in the plane or stands, by values that only the run knows
  along,    ///< moves in the plane
  apart     ///< moves outside of the plane alone
};
Going going_of(const Statement& s, const LegaliseContext& context, const FactsOf& facts, const PathPoints& points);

struct CornerEnds {
  std::vector<Span> behind;  ///< moves that may be the second element
  bool at_arc = false;       ///< one of them is an arc, or may be one
  bool followed = false;     ///< on some way a move in the plane, or something that may make one
  std::vector<Span> alone;   ///< where another move or the end of the program comes first
};

/// By the id of the block that has the corner.
std::map<std::uint32_t, CornerEnds> corner_ends(const Program& program, const LegaliseContext& context,
                                                const FactsOf& facts);

}  // namespace cnctrans::ir::passes
