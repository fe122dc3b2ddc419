// A run of a folded text: the lines that were left out, carried out as the blocks that were read for their like.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "interpreter/program/interpreter.h"
#include "ir/program.h"
#include "translator/folding/file_part.h"
#include "translator/folding/folded_text.h"
#include "translator/pipeline.h"

namespace cnctrans::translator {

/// What reading made of one line, and where its numbers are in it.
class BlockForm {
 public:
  /// nullopt: it is more than a block with these numbers.
  static std::optional<BlockForm> of(const PlainLine& line, std::uint32_t number, const ir::Statement& read);
  /// The block of a line that is alike, until the next call.
  const ir::Statement& with(const PlainLine& line, std::uint32_t number);

 private:
  enum class Part : std::uint8_t { number, axis, centre, radius, feed };
  struct Slot {
    Part part = Part::number;
    std::size_t at = 0;
  };
  [[nodiscard]] std::optional<Slot> slot_of(const PlainNumber& number) const;
  ir::Value* value_at(const Slot& slot);

  ir::Statement statement_;
  std::vector<Slot> slots_;              ///< by number of the line
  std::uint32_t begins_ = 0, ends_ = 0;  ///< lines behind the first one of the unit
};

class FoldedLines final : public interpreter::LinesBehind {
 public:
  FoldedLines(const std::string& path, const frontends::PlainWords& words, const FoldedText& folded,
              const ir::Program& program);
  /// Every line that stayed was read as its like.
  [[nodiscard]] bool known() const { return known_; }

  [[nodiscard]] bool any(const Span& line) const override;
  bool each(const Span& line, const std::function<bool(const ir::Statement&)>& take) override;

 private:
  [[nodiscard]] bool learn(const ir::Program& program);

  PlainLine line_;
  const FoldedText& folded_;
  FilePart file_;
  FileId main_ = 0;
  ShapeIndex index_;
  std::unordered_map<std::uint32_t, std::size_t> gaps_;                 ///< by the line before
  std::map<std::pair<std::uint32_t, std::uint32_t>, BlockForm> forms_;  ///< by run and shape
  bool known_ = false;
};

/// A long file, run by its folded text; nullopt: it takes the whole text.
std::optional<RunResult> run_folded(const std::string& path, const Dialect& dialect, const RunOptions& options,
                                    const MakeSink& make_sink, std::uintmax_t least_size);

}  // namespace cnctrans::translator
