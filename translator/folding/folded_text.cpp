#include "translator/folding/folded_text.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "translator/folding/file_part.h"

namespace cnctrans::translator {

namespace {

constexpr std::size_t window_size = 1U << 20U, most_marks = 4096;
/// Lines of a run before the first one may be left out, and samples of a shape in all.
constexpr std::uint32_t run_head = 4, least_samples = 2;

constexpr bool is_arc(std::int8_t motion) {
  return motion == 2 || motion == 3;
}

/// A bit for each two numbers of the line that differ: what is written for it tells them apart.
std::uint64_t unlike(const PlainLine& line) {
  std::uint64_t pairs = 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < line.count(); ++i) {
    for (std::size_t k = 0; k < i; ++k, ++at) {
      if (line.number(i).text != line.number(k).text) pairs |= std::uint64_t{1} << at;
    }
  }
  return pairs;
}
constexpr std::uint64_t all_pairs(std::size_t numbers) {
  return (std::uint64_t{1} << (numbers * (numbers - 1) / 2)) - 1;
}

constexpr std::uint32_t bit(char letter) {
  return 1U << static_cast<unsigned>(letter - 'A');
}
/// The letters of the axes: those that it moves by increments, those that it moves to places.
constexpr std::uint32_t letters_of_increments(std::uint32_t letters) {
  const std::uint32_t axes = letters >> increment_bits;
  return (axes & 7U) << static_cast<unsigned>('X' - 'A') | axes >> 3U;
}
constexpr std::uint32_t by_place(std::uint32_t letters) {
  return letters & letters_of_increments(all_increments);
}
constexpr std::uint32_t centres = bit('I') | bit('J') | bit('K'), plane_axes = bit('X') | bit('Y');

}  // namespace

std::int32_t ShapeIndex::find(const PlainLine& line, const std::vector<Shape>& shapes) const {
  const std::string_view key = line.key();
  for (std::int32_t at = first_[line.hash() % buckets]; at >= 0; at = next_[static_cast<std::size_t>(at)]) {
    if (shapes[static_cast<std::size_t>(at)].key == key) return at;
  }
  return -1;
}

void ShapeIndex::add(std::uint32_t hash, std::uint32_t shape) {
  next_.resize(shape + 1, -1);
  std::int32_t& first = first_[hash % buckets];
  next_[shape] = std::exchange(first, static_cast<std::int32_t>(shape));
}

/// One pass over the file.
class TextFolder {
 public:
  TextFolder(const frontends::PlainWords& words, const FoldedText::Stays& stays, FoldedText& result)
      : line_(words), stays_(stays), result_(result) {}

  bool run(const std::string& path) {
    LineWindowReader reader(window_size);
    std::string error;
    if (!reader.open(path, &error) || !again_.open(path)) return false;
    SourceLine line;
    PlainUnit unit;
    for (std::string_view window = reader.next(); !window.empty(); window = reader.next()) {
      if (const std::string_view whole = line_.whole_units(window); !whole.empty() && whole.size() != window.size()) {
        reader.give_back(window.size() - whole.size());
        window = whole;
      }
      window_ = window;
      while (line_.take(window, line, unit)) {
        const auto from = base_ + static_cast<std::uint64_t>(unit.text.data() - window_.data());
        const auto to = base_ + (window_.size() - window.size());
        take({unit.first, unit.last, from, to}, unit);
      }
      base_ += window_.size();
      if (lost_ || (text_.size() > base_ / 2 && base_ > 4 * window_size)) return false;
      window_ = {};
    }
    if (!reader.read_error().empty()) return false;
    close_gap();
    result_.last_line_ = line.number;
    if (lost_ || result_.gaps_.empty()) return false;
    result_.text_ = SourceText::from_lines(path, std::move(text_), std::move(numbers_), line.number);
    return true;
  }

 private:
  /// A unit with its line end.
  struct Raw {
    std::uint32_t first = 0, last = 0;  ///< line numbers
    std::uint64_t from = 0, to = 0;
  };
  /// The last line that says a motion.
  struct Said {
    Raw raw;
    std::int8_t motion = motion_unknown;  ///< before it
  };
  /// A line that is left out for now; where it needs them, with the lines that tell where it begins.
  struct Last {
    Raw raw, begin;
    std::int8_t motion = motion_unknown;  ///< before `begin`
    Said said;                            ///< the motion in force at `begin`
  };

  void take(const Raw& raw, const PlainUnit& unit) {
    const std::string_view text = unit.text;
    std::int8_t before = motion_;
    auto kind = line_.scan(text, before, place_, unit.room);
    if (kind == PlainLine::Kind::other) {
      if (line_.comment()) {  // changes nothing: the lines around it may stay away
        if (open_)
          comments_.push_back({raw, raw, before, {}});
        else
          keep(raw);
        return;
      }
      keep(raw);
      if (in_run_) ++run_;
      in_run_ = false;
      motion_ = motion_unknown;
      forget_place();
      place_.increments = line_.increments_after(text, place_.increments);
      return;
    }
    if (!in_run_) run_begin_ = raw.first;
    in_run_ = true;
    const bool asked_for = kind == PlainLine::Kind::plain && is_asked_for();
    if (asked_for) {
      close_gap();
      forget_place();
      before = motion_unknown;
      kind = line_.scan(text, before, place_, unit.room);
    }
    motion_ = line_.motion_after();
    if (kind == PlainLine::Kind::odd) {
      keep(raw);
      forget_start();
      place_.follow(line_);
      return;
    }
    if ((line_.letters() & bit('G')) != 0) motion_said_ = {raw, before};
    if (!is_arc(motion_) && (line_.letters() & plane_axes) == plane_axes)
      anchor_ = {raw, before, line_.letters(), motion_said_};
    increments_ = increments_ || (line_.letters() & all_increments) != 0;
    Shape* const shape = shape_of();
    const auto index = static_cast<std::uint32_t>(shape - result_.shapes_.data());
    const bool first = shape->run != run_ + 1;
    if (first) {
      shape->run = run_ + 1;
      shape->seen = 0;
      shape->left_out = false;
    }
    ++shape->seen;
    const bool whole = asked_for || (!stays_.runs.empty() && stays_.runs.contains(run_)) ||
                       (!stays_.shapes.empty() && stays_.shapes.contains({run_, index}));
    if (whole) {
      keep(raw);
      place_.follow(line_);
    } else if (first || stays(*shape, raw.first - run_begin_)) {
      const bool tells = !needs_start() || knows_start();  // else its centre may be written from an unknown place
      if (!first && tells) count_spellings(*shape);
      keep(raw);  // before its own: the lines that the place before it comes from
      if (tells) result_.kept_.push_back({raw.first, raw.last, run_, index, first, before, place_});
      place_.follow(line_);
    } else {
      if (!std::exchange(shape->left_out, true)) result_.left_out_shapes_.emplace(run_, index);
      leave_out(raw, before);
    }
  }

  /// Asked once for each line, in order.
  bool stays(Shape& shape, std::uint32_t lines_before) {
    if (lines_before < run_head || shape.shown < least_samples) return true;
    if (shape.told_apart != all_pairs(line_.count()) && (unlike(line_) & ~shape.told_apart) != 0) return true;
    if (shape.seen == 2 && !stays_.more.empty() && stays_.more.contains(run_)) return true;
    if ((needs_start() && !knows_start()) || !keeps_sums()) return true;
    for (std::size_t i = 0; i < line_.count(); ++i) {
      const PlainNumber& n = line_.number(i);
      if (shape.spellings[i][n.form] <= n.places) return true;
    }
    return false;
  }

  /// An arc by its centre: what it means, or how it is written, may go by where it begins. One that does not say its
  /// sense has it from the arc before it.
  [[nodiscard]] bool needs_start() const {
    if ((line_.letters() & all_increments) != 0) return false;
    return is_arc(motion_) && ((line_.letters() & centres) != 0 || (line_.letters() & bit('G')) == 0);
  }

  /// Lines that are left out are followed: what others become goes by it.
  [[nodiscard]] bool knows_places() const { return line_.by_way() != 0 || increments_; }

  /// The increments of the gap can go into one of its lines: it is no arc, and says no place of the same axis.
  [[nodiscard]] bool keeps_sums() const {
    const std::uint32_t used = open_ ? used_ : 0, letters = line_.letters();
    if (is_arc(motion_) && (letters & all_increments & ~used) != 0) return false;
    return (by_place(letters) & letters_of_increments(used)) == 0 &&
           (by_place(used) & letters_of_increments(letters)) == 0;
  }

  [[nodiscard]] bool knows_start() const {
    const bool third = (line_.letters() & bit('K')) != 0;
    return anchor_.raw.first != 0 && (!third || (anchor_.letters & bit('Z')) != 0);
  }

  /// A jump leads here, by the number of the block: the place and the motion of the lines before need not hold.
  bool is_asked_for() {
    const auto number = line_.block_number();
    if (!number) return false;
    result_.least_block_ = std::min(result_.least_block_, *number);
    result_.last_block_ = std::max(result_.last_block_, *number);
    return !stays_.numbers.empty() && stays_.numbers.contains(*number);
  }

  void forget_place() {
    place_ = PlainPlace{.increments = place_.increments};
    forget_start();
  }
  void forget_start() {
    anchor_ = {};
    motion_said_ = {};
  }

  void count_spellings(Shape& shape) {
    for (std::size_t i = 0; i < line_.count(); ++i) {
      const PlainNumber& n = line_.number(i);
      std::uint8_t& most = shape.spellings[i][n.form];
      most = std::max(most, static_cast<std::uint8_t>(n.places + 1));
    }
    shape.told_apart |= unlike(line_);
    ++shape.shown;
  }

  Shape* shape_of() {
    const std::int32_t found = index_.find(line_, result_.shapes_);
    if (found >= 0) return &result_.shapes_[static_cast<std::size_t>(found)];
    index_.add(line_, static_cast<std::uint32_t>(result_.shapes_.size()));
    Shape& shape = result_.shapes_.emplace_back();
    shape.key = line_.key();
    shape.spellings.resize(line_.count());
    return &shape;
  }

  void leave_out(const Raw& raw, std::int8_t before) {
    if (!open_) {
      open_ = true;
      gap_ = {.first = raw.first, .run = run_, .from = raw.from, .motion = before, .place = place_};
      used_ = 0;
      sums_ = {};
      follows_ = knows_places();
    } else if (raw.from >= next_mark_) {
      mark(raw.from, before);
    }
    gap_.last = raw.last;
    gap_.to = raw.to;
    if (knows_places()) place_.follow(line_);
    const Last now =
        needs_start() ? Last{raw, anchor_.raw, anchor_.motion, anchor_.said} : Last{raw, raw, before, motion_said_};
    const std::uint32_t letters = (line_.letters() & (is_arc(motion_) ? ~all_increments : ~0U)) | bit('N');
    add_increments(line_, sums_, 1);
    for (std::uint32_t left = letters; left != 0; left &= left - 1)
      last_[static_cast<std::size_t>(std::countr_zero(left))] = now;
    used_ |= letters;
  }

  /// Near each other in a short file, and never very many.
  void mark(std::uint64_t from, std::int8_t before) {
    auto& marks = result_.marks_;
    marks.push_back({from, before, place_, follows_});
    if (marks.size() == most_marks) {
      for (std::size_t i = 0; 2 * i < marks.size(); ++i) marks[i] = marks[2 * i];
      marks.resize(marks.size() / 2);
      between_marks_ *= 2;
    }
    next_mark_ = from + between_marks_;
  }

  static void add_increments(const PlainLine& line, AxisNumbers& sums, int sign) {
    if ((line.letters() & all_increments) == 0) return;
    for (std::size_t i = 0; i < line.count(); ++i) {
      const PlainNumber& n = line.number(i);
      if (n.increment) sums[static_cast<std::size_t>(PlainPlace::index_of(n.letter))] += sign * signed_value(n);
    }
  }

  void keep(const Raw& raw) {
    close_gap();
    text_ += bytes(raw.from, raw.to);
    take_numbers(raw.first, raw.last);
  }

  void take_numbers(std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t n = first; n <= last; ++n) numbers_.push_back(n);
  }

  std::string_view bytes(std::uint64_t from, std::uint64_t to) {
    if (from >= base_ && to <= base_ + window_.size()) return window_.substr(from - base_, to - from);
    std::string_view read = again_.read(from, to);
    lost_ = lost_ || read.size() != to - from;
    return read;
  }

  /// Of the lines left out, the last one with each letter stays, and those that tell where it begins: the state behind
  /// them, and behind each of them, is that of the file.
  void close_gap() {
    if (!open_) return;
    open_ = false;
    gap_.letters = used_;
    const bool sums = !stays_.as_read && (used_ & all_increments) != 0;
    const bool by_way = (used_ & line_.by_way()) != 0 || sums;
    std::vector<Last> lines;
    for (std::uint32_t left = used_; left != 0; left &= left - 1) {
      Last last = last_[static_cast<std::size_t>(std::countr_zero(left))];
      if (last.begin.first < gap_.first) {  // from the lines before the gap on
        last.begin = {gap_.first, gap_.first, gap_.from, 0};
        last.motion = gap_.motion;
      }
      const Said& said = last.said;
      if (said.raw.first >= gap_.first && said.raw.first < last.begin.first)
        lines.push_back({said.raw, said.raw, said.motion, {}});
      lines.push_back(last);
    }
    lines.insert(lines.end(), comments_.begin(), comments_.end());
    comments_.clear();
    std::sort(lines.begin(), lines.end(), [](const Last& a, const Last& b) { return a.begin.first < b.begin.first; });
    Gap rest = gap_;
    const std::size_t gaps_before = result_.gaps_.size();
    PlainLine line = line_;
    if (sums) take_kept(lines, line);
    for (const Last& l : lines) {
      if (l.raw.first < rest.first) continue;  // stays already
      if (l.begin.first > rest.first) {
        add_gap(rest, l.begin);
        for (const char letter : {'X', 'Y', 'Z', 'A', 'B', 'C'}) {
          if (((used_ | letters_of_increments(used_)) & bit(letter)) != 0)
            rest.place.known[static_cast<std::size_t>(PlainPlace::index_of(letter))] = false;
        }
        rest.first = l.begin.first;
        rest.from = l.begin.from;
        rest.motion = l.motion;
        rest.goes_on = true;
      }
      const Gap kept = rest;
      const bool stands = by_way && (rest.goes_on || sums);
      const bool comment = keep_part(rest, l.raw, line, !stands);
      if (stands && !comment) stand_in(kept, rest);
      rest.goes_on = result_.gaps_.size() != gaps_before;
    }
    if (!knows_places()) place_ = rest.place;
    lost_ = lost_ || (sums && sums_ != AxisNumbers{});
  }

  /// What the lines that stay move is not lost.
  void take_kept(const std::vector<Last>& lines, PlainLine& line) {
    std::uint64_t from = gap_.from;
    for (const Last& l : lines) {
      if (l.raw.from < from) continue;
      std::string_view text = bytes(std::max(from, l.begin.from), l.raw.to);
      from = l.raw.to;
      SourceLine at;
      PlainUnit unit;
      while (line.take(text, at, unit)) {
        if (line.scan(unit.text, motion_unknown, gap_.place) != PlainLine::Kind::other) add_increments(line, sums_, -1);
      }
    }
  }
  /// Copies from `done` on up to behind the numbers of the unit that take what would be lost.
  void put_sums(const PlainLine& line, const char*& done) {
    if (is_arc(line.motion_after())) return;
    for (std::size_t i = 0; i < line.count(); ++i) {
      const PlainNumber& n = line.number(i);
      if (!n.increment) continue;
      const auto axis = static_cast<std::size_t>(PlainPlace::index_of(n.letter));
      const std::int64_t sum = std::exchange(sums_[axis], 0);
      if (sum == 0) continue;
      const char* begin = n.text.data();
      if (begin[-1] == '-' || begin[-1] == '+') --begin;
      text_.append(done, begin);
      text_ += spelt(signed_value(n) + sum);
      done = n.text.data() + n.text.size();
      lost_ = lost_ || std::abs(signed_value(n) + sum) >= 100'000 * place_scale;
    }
  }
  /// The lines from the rest's first one to this one stay; `shown`: they are written as the others of their shape.
  /// True: nothing but comments.
  bool keep_part(Gap& rest, const Raw& last, PlainLine& line, bool shown) {
    std::string_view text = bytes(rest.from, last.to);
    const char* done = text.data();
    const char* const end = done + text.size();
    SourceLine l;
    PlainUnit unit;
    l.number = rest.first - 1;
    bool comment = true;
    while (line.take(text, l, unit)) {
      take_numbers(unit.first, unit.last);
      const auto kind = line.scan(unit.text, rest.motion, rest.place);
      if (kind == PlainLine::Kind::other && line.comment()) continue;
      comment = false;
      lost_ = lost_ || kind == PlainLine::Kind::other;
      if (shown) {
        const std::int32_t shape = index_.find(line, result_.shapes_);
        lost_ = lost_ || shape < 0;
        result_.kept_.push_back(
            {unit.first, unit.last, run_, static_cast<std::uint32_t>(shape), false, rest.motion, rest.place});
      }
      if (!shown) put_sums(line, done);
      rest.place.follow(line);
      rest.motion = line.motion_after();
    }
    text_.append(done, end);
    rest.first = last.last + 1;
    rest.from = last.to;
    return comment;
  }
  /// The lines that were kept last, up to the rest, are written by their forms.
  void stand_in(Gap kept, const Gap& rest) {
    kept.last = rest.first - 1;
    kept.to = rest.from;
    kept.stands_in = true;
    result_.gaps_.push_back(kept);
  }
  /// The lines up to the unit behind them are left out.
  void add_gap(Gap gap, const Raw& next) {
    gap.last = next.first - 1;
    gap.next = next.last;
    gap.to = next.from;
    result_.left_out_ += gap.last - gap.first + 1;
    result_.gaps_.push_back(gap);
  }

  PlainLine line_;
  const FoldedText::Stays& stays_;
  FoldedText& result_;
  ShapeIndex index_;
  std::string text_;
  std::vector<std::uint32_t> numbers_;
  std::uint32_t run_ = 0, run_begin_ = 0;
  bool in_run_ = false, increments_ = false;
  std::int8_t motion_ = motion_unknown;
  PlainPlace place_;   ///< behind the last line that stays
  bool open_ = false;  ///< lines are being left out
  Gap gap_;
  std::array<Last, 32> last_{};
  AxisNumbers sums_{};          ///< increments of the lines that are being left out
  std::uint32_t used_ = 0;      ///< letters with a line in last_
  std::vector<Last> comments_;  ///< between the lines that are being left out
  Said motion_said_;
  struct Anchor {
    Raw raw;
    std::int8_t motion = motion_unknown;  ///< before it
    std::uint32_t letters = 0;
    Said said;
  };
  Anchor anchor_;  ///< the last line that says by itself where it ends in the plane
  std::string_view window_;
  std::uint64_t base_ = 0;  ///< of the window
  FilePart again_;
  std::uint64_t next_mark_ = 0, between_marks_ = 1024;
  bool follows_ = false;  ///< the place is known in the whole gap
  bool lost_ = false;     ///< the file is not what it was
};

std::optional<FoldedText> FoldedText::of(const std::string& path, const frontends::PlainWords& words,
                                         const Stays& stays) {
  FoldedText result;
  result.numbers_ = stays.numbers;
  result.by_way_ = PlainLine(words).by_way();
  if (!TextFolder(words, stays, result).run(path)) return std::nullopt;
  return result;
}

}  // namespace cnctrans::translator
