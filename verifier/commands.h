// Two events at the same place of the traces that are no moves; and what a spindle does at a thread.
#pragma once

#include <string>

#include "verifier/compare.h"
#include "verifier/tool_names.h"

namespace cnctrans::verifier {

/// Empty: the two command the same. Both are of one kind.
[[nodiscard]] std::string command_difference(const interpreter::Event& a, const interpreter::Event& b,
                                             const Options& options, ToolNames& tools);
/// Empty: both threads are cut at the same speed, by the same spindle. Its sense is left to the path.
[[nodiscard]] std::string stroke_difference(const interpreter::Event& a, const interpreter::Event& b,
                                            const Tolerances& tolerances);

}  // namespace cnctrans::verifier
