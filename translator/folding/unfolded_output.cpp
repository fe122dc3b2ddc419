// An output with all its lines: parts of it are written side by side, from places where the state of the file is known.
#include <algorithm>

#include "base/in_order.h"
#include "translator/folding/file_part.h"
#include "translator/folding/unfolding.h"

namespace cnctrans::translator {

namespace {

constexpr std::size_t piece_size = 1U << 19U;

}  // namespace

/// Of the output: what stands before the lines of some gaps, and these. The first or the last gap may be cut.
struct Unfolding::Part {
  std::size_t first = 0, last = 0;  ///< of the places; last: behind them
  const FoldedText::Mark* begin = nullptr;
  const FoldedText::Mark* end = nullptr;
};

std::vector<Unfolding::Part> Unfolding::parts_of(std::size_t output, std::size_t least) const {
  const auto& places = places_[output];
  const auto& marks = folded_.marks();
  std::vector<Part> parts;
  Part now;
  std::uint64_t size = 0;
  const auto close = [&](const Part& next) {
    parts.push_back(now);
    now = next;
    size = 0;
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Gap& gap = folded_.gaps()[places[i].gap];
    now.last = i;
    if (size >= least && !gap.goes_on) close({i, i});
    now.last = i + 1;
    std::uint64_t from = gap.from;
    const auto later = [](std::uint64_t at, const FoldedText::Mark& m) { return at < m.from; };
    for (auto mark = std::upper_bound(marks.begin(), marks.end(), from, later);
         mark != marks.end() && mark->from < gap.to; ++mark) {
      if (size + (mark->from - from) < least || (uses_places_ && !mark->knows_place)) continue;
      now.end = &*mark;
      close({i, i + 1, &*mark});
      from = mark->from;
    }
    size += gap.to - from;
  }
  now.last = places.size() + 1;  // with what stands behind them
  parts.push_back(now);
  return parts;
}

/// nullopt: the file is not what it was.
std::optional<std::string> Unfolding::lines_of(std::size_t output, std::string_view bytes, const Part& part) const {
  const auto& places = places_[output];
  const std::string_view eol = bytes.find("\r\n") != std::string_view::npos ? "\r\n" : "\n";
  std::string out;
  FilePart file;
  PlainLine line(words_);
  std::int8_t motion = motion_unknown;
  PlainPlace at;
  std::optional<std::size_t> last;  // the gap before
  std::size_t done = part.first == 0 ? 0 : places[part.first - 1].at + places[part.first - 1].size;
  if (part.first < places.size() && !file.open(path_)) return std::nullopt;
  for (std::size_t i = part.first; i < std::min(part.last, places.size()); ++i) {
    const Place& place = places[i];
    const Gap& gap = folded_.gaps()[place.gap];
    const bool cut = part.begin != nullptr && i == part.first;
    if (!cut) out += bytes.substr(done, place.at - done);
    done = place.at + place.size;
    // Where it goes on from another one the state is what that one left, and the lines between them.
    std::size_t before = place.gap;
    const bool follows = !cut && gap.goes_on && last && *last + 1 == place.gap;
    while (!follows && folded_.gaps()[before].goes_on) --before;
    const Gap& start = folded_.gaps()[before];
    std::uint64_t from = cut ? part.begin->from : follows ? folded_.gaps()[*last].to : start.from;
    if (!follows) {
      motion = cut ? part.begin->motion : start.motion;
      at = cut ? part.begin->place : start.place;
    }
    last = place.gap;
    const std::uint64_t to = part.end != nullptr && i + 1 == part.last ? part.end->from : gap.to;
    while (from < to) {
      const bool own = from >= gap.from;
      const std::uint64_t stop = own ? to : gap.from;
      std::string_view text = file.read(from, std::min(stop, from + piece_size));
      if (text.empty()) return std::nullopt;
      const bool all = from + text.size() >= stop;
      if (!all && (text = line.whole_units(text)).empty()) return std::nullopt;
      from += text.size();
      SourceLine l;
      PlainUnit unit;
      while (line.take(text, l, unit)) {
        const auto kind = line.scan(unit.text, motion, at, unit.room);
        if (!own && kind == PlainLine::Kind::other && line.comment()) continue;
        if (kind != PlainLine::Kind::plain) return std::nullopt;
        if (own) {
          const std::int32_t shape = index_.find(line, folded_.shapes());
          if (shape < 0 || !forms_[static_cast<std::size_t>(shape)].form) return std::nullopt;
          forms_[static_cast<std::size_t>(shape)].form->write(line, at, out);
          out += eol;
        }
        if (uses_places_) at.follow(line);
        motion = line.motion_after();
      }
    }
  }
  if (part.last > places.size()) out += bytes.substr(done);
  return out;
}

bool Unfolding::write(std::size_t output, std::string_view bytes, const TextSink& sink, std::size_t part) const {
  const std::vector<Part> parts = parts_of(output, part);
  const auto numbers = numbers_();
  const std::string_view eol = bytes.find("\r\n") != std::string_view::npos ? "\r\n" : "\n";
  std::string numbered;
  const auto make = [&](std::size_t i) { return lines_of(output, bytes, parts[i]); };
  return in_order(parts.size(), make, [&](const std::optional<std::string>& text) {
    if (!text) return false;
    if (numbers == nullptr) return sink(*text);
    numbered.clear();
    std::string_view rest = *text;
    SourceLine l;
    while (take_line(rest, l)) {
      numbers->write(l.text, numbered);
      numbered += eol;
    }
    return sink(numbered);
  });
}

}  // namespace cnctrans::translator
