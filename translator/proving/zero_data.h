// Variables in which a control keeps its zero points.
#pragma once

#include <set>
#include <string>

#include "ir/program.h"

namespace cnctrans::translator {

/// Variables that the program counts into a work offset, or beside a place of the machine (plain names): what they hold
/// before the program belongs to the zero points, which a replay has from its machine.
std::set<std::string> zero_data(const ir::Program& program);

}  // namespace cnctrans::translator
