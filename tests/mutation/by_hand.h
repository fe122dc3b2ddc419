// Faults made by hand, as data: by-hand/*.md.
#pragma once

#include <string>

namespace cnctrans::mutation {

/// Tries all of them whose file name has `only` in it; prints the table. Number of those that are not as expected.
int by_hand(const std::string& root, const std::string& only);

}  // namespace cnctrans::mutation
