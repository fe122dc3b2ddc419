// Cuts a program down to the smallest one that shows the same.
#pragma once

#include <functional>

#include "tests/splice/programs.h"

namespace cnctrans::splice {

/// Leaves out lines, then words, as long as `shows` holds (delta debugging); at most `tries` questions.
Program reduced(Program p, const std::function<bool(const Program&)>& shows, std::size_t tries);

}  // namespace cnctrans::splice
