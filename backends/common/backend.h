// What a backend is to the rest of the house: IR in, text out.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/source.h"
#include "base/text.h"
#include "ir/analysis/uncalled.h"
#include "ir/program.h"
#include "legaliser/capabilities.h"
#include "legaliser/legalise.h"
#include "machine/profile.h"

namespace cnctrans::backends {

enum class Unsupported : std::uint8_t { error, warn, comment };
enum class Numbering : std::uint8_t { keep, none, renumber };

/// A line of the source that a draft leaves out: its number in the list of what is to be done, and whether the machine
/// has to stop before it.
struct ToDoLine {
  std::size_t number = 0;
  bool stop = true;
};
using ToDoLines = std::map<std::pair<FileId, std::uint32_t>, ToDoLine>;

struct WriteOptions {
  const machine::Profile* profile = nullptr;  ///< of the target; never null when called
  Unsupported unsupported = Unsupported::error;
  Numbering numbering = Numbering::keep;
  std::int32_t number_step = 10;
  ir::Uncalled uncalled = ir::Uncalled::unknown;  ///< what the program was legalised for
  bool annotate = false;                          ///< the source line as a comment beside its translation
  bool single_output = false;  ///< one file for everything: subprograms in the same file, or an archive
  bool files_apart = false;    ///< programs of other source files (a library) go to files of their own
  bool draft = false;  ///< what is left out is a remark with its number in `to_do`; one stop before a run of such lines
  ToDoLines to_do;
  std::string main_stem;  ///< file stem wanted for the main program (where legal)
  /// Capitals: names of files and programs that other translations of the same job have already. The main program gets
  /// another one, with a note.
  std::set<std::string> taken;
  std::set<std::string> mains;  ///< capitals: files of other main programs, by the map of names; no called file is so
  [[nodiscard]] bool is_taken(std::string_view name) const { return taken.count(to_upper_ascii(name)) != 0; }
};

/// Target line -> source span, for reports and for verification messages. Index 0 is line 1.
struct SourceMap {
  std::vector<Span> lines;
};
struct OutputFile {
  std::string name;     ///< as the target control wants it, with extension
  std::string program;  ///< of a main program: how the control calls it where that is not the file's name ("%12")
  std::string text;     ///< UTF-8 where the program's texts are, LF line ends; the translator encodes
  SourceMap map;
  bool main = false;
  std::vector<Span> left_out;  ///< places of the source in whose stead a remark stands
};

/// The numbers of the blocks of a finished text, given from its first line to its last.
class BlockNumbers {
 public:
  virtual ~BlockNumbers() = default;
  /// Appends the line, without its end; a line that begins a block gets its number.
  virtual void write(std::string_view line, std::string& out) = 0;
};

class Backend {
 public:
  virtual ~Backend() = default;
  [[nodiscard]] virtual std::string_view dialect() const = 0;
  [[nodiscard]] virtual const ir::Capabilities& capabilities() const = 0;
  /// What the language can say on this machine, where lathe and mill differ. Default: capabilities().
  [[nodiscard]] virtual const ir::Capabilities& capabilities_for(const machine::Profile& /*target*/) const {
    return capabilities();
  }
  /// Of a language that numbers all blocks of a file, one behind the other: what does it. Default: null.
  [[nodiscard]] virtual std::unique_ptr<BlockNumbers> block_numbers(const WriteOptions& /*options*/) const {
    return nullptr;
  }
  /// Writes a legal program (one that passed legalisation for `capabilities()`), without `block_numbers`.
  virtual std::vector<OutputFile> write(const ir::Program& program, const WriteOptions& options,
                                        Diagnostics& diagnostics) const = 0;
};

/// The text with its block numbers, where the language has them so (`block_numbers`).
std::string numbered(const Backend& backend, const WriteOptions& options, std::string text);

}  // namespace cnctrans::backends
