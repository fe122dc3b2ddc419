// Repeated parts written out again: a part that is carried out in several states (another place, another mirror,
// another motion in force) may have to be said otherwise in each of them.
#pragma once

#include <map>
#include <vector>

#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

enum class Copying : std::uint8_t {
  first,  ///< the first pass of the Repeat once more in the text; the further ones repeat that copy
  each    ///< each pass of the Repeat in the text
};

/// Where the Repeats stand in the source.
struct InSource {
  bool operator()(const Span& a, const Span& b) const;
};
using Copies = std::map<Span, Copying, InSource>;

bool repeats_parts(const Program& program);

/// The Repeats whose part holds a line of `where` and can be written again, the shortest part first.
struct CopyChoice {
  Span repeat;
  std::vector<Copying> ways;  ///< the one with less text first
  std::vector<Span> shared;   ///< other Repeats of the same statements, one not inside of the other
};
std::vector<CopyChoice> copy_choices(Program& program, const std::vector<Span>& where);

/// Writes the parts again as chosen. A remark stands above each copy.
void write_copies(Program& program, const Copies& copies, const LegaliseContext& context);

}  // namespace cnctrans::ir::passes
