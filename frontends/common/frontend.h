// What a frontend is to the rest of the house: text in, IR out.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "base/source.h"
#include "frontends/common/syntax.h"
#include "ir/program.h"
#include "machine/profile.h"

namespace cnctrans::frontends {

/// scanner: word scanner first, the grammar for the rest. antlr: the grammar for every block. both: both, and every
/// difference is a diagnostic (error CNC-READERS).
enum class Reader : std::uint8_t { scanner, antlr, both };

/// Looks through a text before it is read as a stream: `holds` gets its windows of whole lines one after the other,
/// until it says true. The answer: `holds` has said so, or the text can't be read.
using TextLook = std::function<bool(const std::function<bool(std::string_view)>& holds)>;

struct ReadOptions {
  Reader reader = Reader::scanner;
  const machine::Profile* profile = nullptr;  ///< never null when called
  /// Files that define names for every program of the machine, read before; null: this file is one of them.
  const std::vector<const ir::Program*>* definitions = nullptr;
  TextLook look = {};  ///< of a stream; empty: there is nothing to look through
  /// The other programs of the run, the main one first, where a file is read for those that call it; may be null.
  const std::vector<const ir::Program*>* callers = {};
  struct Text {
    SourcePtr source;  ///< null: there is none
    FileId file = 0;
  };
  /// The text of a program that can be called; empty: nobody knows.
  std::function<Text(std::string_view name)> called_text = {};
  /// A program of this name (capitals) is there to be called; empty: nobody knows.
  std::function<bool(std::string_view name)> has_program = {};
};

/// Counts for `check` and the corpus table.
struct ReadStats {
  std::uint64_t lines = 0;
  std::uint64_t blocks = 0;       ///< lines that are blocks (not blank, not pure comment)
  std::uint64_t blocks_read = 0;  ///< understood; the rest is Opaque with a diagnostic
  std::uint64_t scanner_blocks = 0;
};

/// How a line of a straight-line stream was taken.
enum class StreamLine : std::uint8_t {
  statement,      ///< `out` is the statement (Block; also empty lines and comments)
  program_end,    ///< `out` is the last block; an End follows it: the program is complete, trailing lines may follow
  no_statement,   ///< the line is no statement (header): what it says is in frame()
  needs_program,  ///< the construct needs the whole program: give up streaming
};

/// How a stream has ended.
enum class StreamEnd : std::uint8_t {
  complete,
  needs_program  ///< something that only the end tells needs the whole program: what was read is void
};

/// Numbers of an address that the reading of a plain line treats alike: same statement, only the value differs, and
/// nothing else depends on it.
struct FreeNumber {
  bool free = false;
  bool minus = false;       ///< also negative ones
  bool zero = false;        ///< also 0
  bool plus = false;        ///< a plus sign may stand before it
  bool sign_told = false;   ///< its sign may be a direction: with another one the line is another one
  bool by_way = false;      ///< what is written goes by the way there: with another direction the line is another one
  std::uint8_t whole = 0;   ///< at most so many digits before the point
  std::uint8_t places = 0;  ///< and behind it
  std::uint32_t most = 0;   ///< of a whole number: the largest; 0: what its digits allow
};
/// R is the radius of an arc; where none is in force it makes the line another one.
using FreeNumbers = std::array<FreeNumber, 26>;  ///< by letter, capitals

/// A line that is nothing but a comment begins with `first`; where `last` is given, it ends with the first of these.
struct CommentLine {
  char first = 0, last = 0;
};

/// A word of such lines that has no number: `L`, `FMAX`, `DR-`.
struct PlainCode {
  std::string_view text;
  std::int8_t motion = -1;  ///< the motion that it says, 0 to 3 as of G0 to G3; -1: none
  char group = 0;           ///< it replaces what a word with this letter said before; 0: it holds for its line
};

/// The words of lines that say nothing but where to go: motion codes, and addresses whose numbers are alike.
struct PlainWords {
  FreeNumbers numbers{};
  std::span<const PlainCode> codes;  ///< of a language without G codes; empty: G0 to G3
  bool bare_block_number = false;    ///< digits at the begin of a line are its N
  std::string_view lead;     ///< a line of this word says the centre of the arc in the line behind it; empty: none
  bool assignments = false;  ///< X=5 is X5, and CR=5 the radius of an arc, alike as long as it is positive
  CommentLine comments{};
  std::string_view increments, places;  ///< words that switch: `G91`, `G90`; empty: none does
  char increment = 0;                   ///< stands before the letter of an axis whose number is an increment: IX
  std::uint32_t other_blocks = 0;       ///< block numbers above it are something else to the target; 0: none is
};

/// Reads a straight-line program line by line. Views in `out` point into the line given.
class StreamReader {
 public:
  virtual ~StreamReader() = default;
  virtual StreamLine read(const SourceLine& line, ir::Statement& out, Diagnostics& diagnostics) = 0;
  /// After program_end: the end word as written.
  [[nodiscard]] virtual std::string_view end_word() const = 0;
  /// After the last line (`lines` of them): what is to be said of the program as a whole.
  [[nodiscard]] virtual StreamEnd end(std::uint32_t lines, Diagnostics& diagnostics) = 0;
  /// The program frame so far: title, name, spaces; valid from the first line on.
  [[nodiscard]] virtual const ir::Program& frame() const = 0;
};

class Frontend {
 public:
  virtual ~Frontend() = default;
  [[nodiscard]] virtual std::string_view dialect() const = 0;
  /// Reads a whole file. Always returns a program; what could not be read is Opaque with a diagnostic.
  virtual ir::Program read(const SourcePtr& source, FileId file, const ReadOptions& options, Diagnostics& diagnostics,
                           ReadStats* stats) const = 0;
  /// What a file means depends on the modes that its callers leave in force: it is read once more with
  /// ReadOptions::callers when they are known.
  [[nodiscard]] virtual bool reads_by_callers() const { return false; }
  /// Words whose lines mean the same with other numbers, whatever stands before them. Default: none.
  [[nodiscard]] virtual PlainWords plain_words() const { return {}; }
  virtual std::unique_ptr<StreamReader> stream(FileId file, const ReadOptions& options,
                                               std::string_view file_name) const = 0;
};

}  // namespace cnctrans::frontends
