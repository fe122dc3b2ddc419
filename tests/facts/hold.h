// The facts of the analysis (ir/analysis/dataflow.h) held against what the machine stands in when the run comes to a
// statement.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/splice/programs.h"

namespace cnctrans::facts {

/// How often a fact was asked, was known, and was unknown though every visit of the statement saw the same value.
struct Share {
  std::size_t asked = 0, known = 0, needless = 0;
};
using Shares = std::map<std::string, Share>;

/// A fact that is known and not true.
struct Untrue {
  std::string domain;      ///< "plane", "position X", "feed"
  std::uint32_t line = 0;  ///< of the statement, in the program's text
  std::string said, seen;
};

struct Held {
  bool ran = false;            ///< the program is read without an error and moved
  std::vector<Untrue> untrue;  ///< the first one of each domain
};

/// Reads and runs the program: as written and with every block-skip switch on, from a start that no fact can guess.
Held hold(const splice::Program& program, Shares* shares);

}  // namespace cnctrans::facts
