// A long text without the plain lines that have their like among the lines that stay.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/source.h"
#include "translator/folding/plain_line.h"

namespace cnctrans::translator {

/// Lines that were left out, one behind the other; the lines before and behind them are there. Or lines that stay to
/// leave the state that the file has there: where they begin is another place, and they are written as left out ones.
struct Gap {
  std::uint32_t first = 0, last = 0;  ///< line numbers
  std::uint32_t next = 0;             ///< last line of the unit behind it
  std::uint32_t run = 0;
  std::uint64_t from = 0, to = 0;  ///< bytes of the file
  std::int8_t motion = motion_unknown;
  PlainPlace place;           ///< before the first
  std::uint32_t letters = 0;  ///< of its words; bit 0 is A
  bool stands_in = false;     ///< the lines are there
  bool goes_on = false;       ///< of the gap before it: nothing but lines of the same kind that stay stand between them
};

/// Lines that are alike.
struct Shape {
  std::string key;
  std::uint32_t run = 0;  ///< the one that seen counts in
  std::uint32_t seen = 0;
  std::uint32_t shown = 0;       ///< lines that stay and are not the first of their run
  bool left_out = false;         ///< one at least, in the run
  std::uint64_t told_apart = 0;  ///< pairs of numbers that differ in one of them
  /// For each number: the spellings that stay, with their most digits behind the point + 1.
  std::vector<std::array<std::uint8_t, number_forms>> spellings;
};

/// A plain unit that stayed.
struct KeptLine {
  std::uint32_t begin = 0, line = 0;  ///< its first and its last line
  std::uint32_t run = 0, shape = 0;
  bool first = false;  ///< of its shape in its run
  std::int8_t motion = motion_unknown;
  PlainPlace place;  ///< before it
};

class FoldedText {
 public:
  /// Lines that must stay besides.
  struct Stays {
    std::set<std::uint64_t> numbers;                           ///< by their block number
    std::set<std::uint32_t> runs;                              ///< all lines of these runs
    std::set<std::pair<std::uint32_t, std::uint32_t>> shapes;  ///< all lines of a shape in a run
    bool as_read = false;          ///< lines stay as they are, also where increments are lost
    std::set<std::uint32_t> more;  ///< runs whose first lines of a shape are special: the second stays as well
  };
  /// nullopt: the file can't be read, or too little can be left out to be worth it.
  static std::optional<FoldedText> of(const std::string& path, const frontends::PlainWords& words, const Stays& stays);

  /// A line that is left out where a new stretch of the file begins: what is written there can be begun here.
  struct Mark {
    std::uint64_t from = 0;
    std::int8_t motion = motion_unknown;
    PlainPlace place;
    bool knows_place = false;
  };

  [[nodiscard]] const std::vector<Mark>& marks() const { return marks_; }
  [[nodiscard]] const SourcePtr& text() const { return text_; }
  [[nodiscard]] const std::vector<Gap>& gaps() const { return gaps_; }
  [[nodiscard]] const std::vector<KeptLine>& kept() const { return kept_; }
  [[nodiscard]] const std::vector<Shape>& shapes() const { return shapes_; }
  [[nodiscard]] std::uint64_t lines_left_out() const { return left_out_; }
  [[nodiscard]] std::uint32_t last_line() const { return last_line_; }
  /// Of axes whose words go by the way there; bit 0 is A.
  [[nodiscard]] std::uint32_t by_way() const { return by_way_; }
  /// A plain line may have this block number, and does not stay because of it.
  [[nodiscard]] bool may_lose(std::uint64_t block) const {
    return block >= least_block_ && block <= last_block_ && !numbers_.contains(block);
  }
  /// Are lines of the shape left out in the run?
  [[nodiscard]] bool leaves_out(std::uint32_t run, std::uint32_t shape) const {
    return left_out_shapes_.contains({run, shape});
  }

 private:
  friend class TextFolder;
  SourcePtr text_;
  std::vector<Gap> gaps_;
  std::vector<Mark> marks_;  ///< in the order of the file
  std::vector<KeptLine> kept_;
  std::vector<Shape> shapes_;
  std::set<std::uint64_t> numbers_;  ///< blocks that stay because of their number
  std::uint64_t least_block_ = UINT64_MAX, last_block_ = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> left_out_shapes_;  ///< run, shape
  std::uint64_t left_out_ = 0;
  std::uint32_t by_way_ = 0;
  std::uint32_t last_line_ = 0;
};

/// Finds the shape of a line by its key. -1: it is new.
class ShapeIndex {
 public:
  [[nodiscard]] std::int32_t find(const PlainLine& line, const std::vector<Shape>& shapes) const;
  void add(const PlainLine& line, std::uint32_t shape) { add(line.hash(), shape); }
  void add_key(std::string_view key, std::uint32_t shape) { add(PlainLine::hash_of(key), shape); }

 private:
  void add(std::uint32_t hash, std::uint32_t shape);
  static constexpr std::size_t buckets = 4096;
  std::vector<std::int32_t> first_ = std::vector<std::int32_t>(buckets, -1);
  std::vector<std::int32_t> next_;
};

}  // namespace cnctrans::translator
