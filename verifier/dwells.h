// Dwells that follow each other, as one.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "interpreter/trace/trace.h"

namespace cnctrans::verifier {

/// Revolutions per minute of each spindle; 0: not known, or it changes with the diameter.
using SpindleSpeeds = std::map<std::int32_t, double>;

struct Dwells {
  Dwells(const std::vector<const interpreter::Event*>& trace, std::size_t from);
  double seconds = 0;
  SpindleSpeeds turns;                           ///< by the spindle that counts them
  std::vector<const interpreter::Event*> parts;  ///< each by itself

  /// One by one, or all together: turns of one side may be seconds of the other then, at the speed in force.
  [[nodiscard]] bool same(const Dwells& other, const SpindleSpeeds& rpm, double tolerance) const;
  [[nodiscard]] std::string said() const;
};

}  // namespace cnctrans::verifier
