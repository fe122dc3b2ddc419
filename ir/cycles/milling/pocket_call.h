// A pocket whose operations (drilling, roughing, finishing) and contours are blocks of the program that a call names.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ir/cycle.h"
#include "ir/program.h"

namespace cnctrans::ir::cycles {

/// NamedCycles. The call has the words `drill_first_label`, `drill_last_label`, the same with `rough`, `semi` and
/// `finish`, and of the contours `first_label`, `last_label`, `program`. The others stand in the blocks it names.
namespace pocket {
inline constexpr std::string_view call = "pocket.call", rough = "pocket.rough", finish = "pocket.finish";
}
inline bool is_pocket_cycle(std::string_view name) {
  return name == pocket::call || name == pocket::rough || name == pocket::finish;
}
/// Of a call: the words that name blocks, in pairs of first and last one.
bool is_label_word(std::string_view word);

struct PocketOperations {
  /// The blocks in the order in which they run: tools, feeds and functions of the source, each cycle as one that needs
  /// nothing else (shape pocket.contour, or a hole cycle at the places where the roughing enters the material).
  std::vector<Statement> blocks;
  std::vector<const Statement*> originals;  ///< of the blocks, in the program
  bool finish_left_out = false;             ///< finishing without an allowance: only its functions
};
/// nullopt with a sentence: blocks are missing, or are no operation of a pocket, or need one another in vain.
std::optional<PocketOperations> pocket_operations(const Program& program, const Routine& caller, const NamedCycle& call,
                                                  std::string* error);

}  // namespace cnctrans::ir::cycles
