// What stops a run: one coded fault, the first one counts. Inside the interpreter functions answer false and leave the
// fault here; no exceptions.
#pragma once

#include <string>
#include <string_view>

#include "base/span.h"

namespace cnctrans::interpreter {

struct Failure {
  bool set = false;
  std::string code;  ///< RUN-nnn, see run_codes.h
  std::string text;
  Span span;   ///< of the statement being carried out
  Span where;  ///< the statement now carried out; becomes `span`

  /// Always false, so that `return failure.fail(...)` ends a function.
  bool fail(std::string_view code_, std::string text_) {
    if (set) return false;
    set = true;
    code = code_;
    text = std::move(text_);
    span = where;
    return false;
  }
};

}  // namespace cnctrans::interpreter
