// Splices: a program changed at random, most often into another valid one.
#pragma once

#include <vector>

#include "tests/splice/chance.h"
#include "tests/splice/programs.h"

namespace cnctrans::splice {

/// One of `programs` with one to three changes: lines deleted, doubled, swapped or taken from another program of the
/// same kind of machine; block-skip marks; values by variables; parts as subprograms, repeats, loops and branches.
Program spliced(const std::vector<Program>& programs, Chance& chance);

}  // namespace cnctrans::splice
