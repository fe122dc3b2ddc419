// A line that the program puts into a file of the control: a message of the run whose `number` is the statement as it
// was written, a text.
#pragma once

#include "ir/statement.h"

namespace cnctrans::ir {

/// The statement as it was written; null for every other message.
inline const String* file_line(const Message& m) {
  return m.kind == MessageKind::show && m.number ? std::get_if<String>(&m.number->node) : nullptr;
}

}  // namespace cnctrans::ir
