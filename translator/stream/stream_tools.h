// Tools by their names in a stream: which numbers they get follows from all the tools of the file.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "frontends/common/frontend.h"
#include "legaliser/legalise.h"

namespace cnctrans::translator {

/// Reads the lines of a file that have the letter (or its small one). True: `holds` has said so of a statement. Lines
/// that the reader leaves to the whole program are passed over.
bool any_line(const frontends::TextLook& look, char letter, frontends::StreamReader& reader,
              const std::function<bool(const ir::Statement&)>& holds);

class StreamTools {
 public:
  /// Looks through the file; what is to be said of the names is said.
  void look(const frontends::Frontend& frontend, FileId file, const std::string& path,
            const frontends::ReadOptions& options, const ir::LegaliseContext& context);
  void apply(ir::Block& block) const;
  /// The table of names and numbers, at the head of the program.
  void put_table(ir::Body& body) const;

 private:
  ir::Program program_;  ///< of the tools alone; holds the texts of the table
  ir::Body table_;
  std::map<std::string, ir::Value, std::less<>> numbers_;
};

}  // namespace cnctrans::translator
