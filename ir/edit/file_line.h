// Files of the control that the program writes: a program opened for writing, a line put into it. Such a statement is a
// message of the run with a `file_line`, the statement as it was written.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "ir/statement.h"

namespace cnctrans::ir {

struct FileStatement {
  FileUse use = FileUse::line;
  std::string text;  ///< the statement as it was written
  ExprPtr name;      ///< null: none
};

inline void mark_file(Message& m, FileUse use, std::string text, ExprPtr name) {
  m.file_use = use;
  m.file_line = std::move(text);
  m.number = std::move(name);
}

/// nullopt: the message is no statement for a file.
inline std::optional<FileStatement> file_statement(const Message& m) {
  if (m.file_line.empty()) return std::nullopt;
  return FileStatement{m.file_use, m.file_line, m.number};
}

}  // namespace cnctrans::ir
