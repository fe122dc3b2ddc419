// What docs/verify.md says is not compared: of a difference of two traces, what is left without it.
#pragma once

#include <string>
#include <vector>

#include "tests/mutation/trial.h"

namespace cnctrans::mutation {

struct Documented {
  bool equal = false;                ///< exactly the same
  std::string what;                  ///< the first difference that is left; empty: all of them are documented
  std::vector<std::string> aspects;  ///< that had to be forgotten
};
/// The translation without and with the fault.
Documented documented(const Translated& t, const Trace& with_fault);

/// Sentences of the table that docs/verify.md does not have.
std::vector<std::string> missing_sentences(const std::string& page);

}  // namespace cnctrans::mutation
