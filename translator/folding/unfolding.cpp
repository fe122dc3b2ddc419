#include "translator/folding/unfolding.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "translator/folding/file_part.h"

namespace cnctrans::translator {

namespace {

constexpr std::size_t piece_size = 1U << 20U, kept_samples = 4;

/// Where the lines of an output are.
struct OutputLines {
  std::vector<std::string_view> lines;  ///< without their ends
  std::vector<std::size_t> ends;        ///< the byte behind each, line end included
  /// Some of them as one text, without the last end.
  [[nodiscard]] std::string_view text(std::size_t first, std::size_t count) const {
    const std::string_view last = lines[first + count - 1];
    return {lines[first].data(), static_cast<std::size_t>(last.data() + last.size() - lines[first].data())};
  }
};

OutputLines output_lines(std::string_view bytes) {
  OutputLines found;
  const char* const begin = bytes.data();
  SourceLine line;
  while (take_line(bytes, line)) {
    found.lines.push_back(line.text);
    found.ends.push_back(static_cast<std::size_t>(bytes.data() - begin));
  }
  return found;
}

std::string_view unit_text(const SourceText& source, std::uint32_t first, std::uint32_t last) {
  const std::string_view from = source.line_text(first), to = source.line_text(last);
  return {from.data(), static_cast<std::size_t>(to.data() + to.size() - from.data())};
}

/// The lines of an output that a line of the source became.
struct Became {
  std::uint32_t output = 0, line = 0, count = 0;
  bool scattered = false;  ///< not one behind the other
};

/// Collects finished lines, with their block numbers where the language has them.
class Lines {
 public:
  Lines(std::unique_ptr<backends::BlockNumbers> numbers, std::string_view eol)
      : numbers_(std::move(numbers)), eol_(eol) {}

  /// Whole lines, with their ends.
  void add(std::string_view lines) {
    if (numbers_ == nullptr) {
      text += lines;
      return;
    }
    SourceLine l;
    while (take_line(lines, l)) number(l.text);
  }
  void add(const LineForm& form, const PlainLine& line, const PlainPlace& before) {
    if (numbers_ == nullptr) {
      form.write(line, before, text);
      text += eol_;
      return;
    }
    written_.clear();
    form.write(line, before, written_);
    add(written_);
  }

  std::string text;

 private:
  void number(std::string_view line) {
    numbers_->write(line, text);
    text += eol_;
  }

  std::unique_ptr<backends::BlockNumbers> numbers_;
  std::string_view eol_;
  std::string written_;
};

}  // namespace

Unfolding::Unfolding(std::string path, const frontends::PlainWords& words, const FoldedText& folded,
                     const frontends::PlainWords& target, MakeBlockNumbers numbers)
    : path_(std::move(path)),
      words_(words),
      target_(target),
      folded_(folded),
      numbers_(std::move(numbers)),
      line_(words),
      forms_(folded.shapes().size()) {
  for (std::size_t i = 0; i < folded.shapes().size(); ++i) {
    const std::string& key = folded.shapes()[i].key;
    index_.add_key(key, static_cast<std::uint32_t>(i));
  }
}

bool Unfolding::explains(const LineForm& form, const Sample& sample) {
  std::string again;
  if (line_.scan(sample.text, sample.motion, sample.place) != PlainLine::Kind::plain) return false;
  form.write(line_, sample.place, again);
  return again == sample.written;
}

/// The form of a shape explains every line of it, or there is none.
bool Unfolding::take(Form& form, Sample sample) {
  if (form.form && explains(*form.form, sample)) {
    if (form.samples.size() < kept_samples) form.samples.push_back(std::move(sample));
    return true;
  }
  if (line_.scan(sample.text, sample.motion, sample.place) != PlainLine::Kind::plain) return false;
  auto other = LineForm::of(line_, sample.place, sample.written, target_);
  const auto good = [&](const Sample& s) { return explains(*other, s); };
  if (!other || !good(sample) || !std::all_of(form.samples.begin(), form.samples.end(), good)) return false;
  form.form = other;
  form.samples.push_back(std::move(sample));
  return true;
}

bool Unfolding::learn(const std::vector<OutputText>& outputs, FileId file, FoldedText::Stays& stays) {
  std::unordered_map<std::uint32_t, Became> became;
  std::vector<OutputLines> written;
  for (std::uint32_t o = 0; o < outputs.size(); ++o) {
    written.push_back(output_lines(outputs[o].bytes));
    const auto& map = outputs[o].map.lines;
    for (std::uint32_t i = 0; i < map.size() && i < written[o].lines.size(); ++i) {
      if (map[i].file != file) continue;
      Became& b = became[map[i].line];
      if (b.count == 0) b = {o, i, 0, false};
      b.scattered = b.scattered || b.output != o || b.line + b.count != i;
      ++b.count;
    }
  }
  const auto lines_of = [&](std::uint32_t first, std::uint32_t last) -> std::optional<Became> {
    std::optional<Became> all;
    for (std::uint32_t line = first; line <= last; ++line) {
      const auto it = became.find(line);
      if (it == became.end()) continue;
      const Became& b = it->second;
      if (!all) {
        all = b;
        continue;
      }
      all->scattered = all->scattered || b.scattered || b.output != all->output || b.line != all->line + all->count;
      all->count += b.count;
    }
    return all && !all->scattered ? all : std::nullopt;
  };
  // First those that are never the first of their run; what is special about a first line does not make a form.
  std::set<std::uint32_t> bad, special, partly;
  std::set<std::pair<std::uint32_t, std::uint32_t>> odd, shown;  // run, shape: a later line is (not) as the form says
  const SourceText& source = *folded_.text();
  for (const bool first : {false, true}) {
    for (const KeptLine& k : folded_.kept()) {
      if (k.first != first) continue;
      const auto b = lines_of(k.begin, k.line);
      const bool good =
          b && take(forms_[k.shape], {std::string(unit_text(source, k.begin, k.line)),
                                      std::string(written[b->output].text(b->line, b->count)), k.motion, k.place});
      if (good) {
        if (!first) shown.emplace(k.run, k.shape);
        continue;
      }
      if (!first) {
        odd.emplace(k.run, k.shape);
      } else if (!shown.contains({k.run, k.shape}) && !stays.more.contains(k.run)) {
        special.insert(k.run);
      }
    }
  }
  // One kind of line that is written by more than its numbers stays; where all kinds are, the run does.
  for (const auto& [run, shape] : shown) partly.insert(run);
  for (const auto& [run, shape] : odd) {
    if (!partly.contains(run)) bad.insert(run);
  }
  places_.assign(outputs.size(), {});
  for (std::size_t g = 0; g < folded_.gaps().size(); ++g) {
    const Gap& gap = folded_.gaps()[g];
    if (gap.stands_in) {
      const auto own = lines_of(gap.first, gap.last);
      if (!own) {
        bad.insert(gap.run);
        continue;
      }
      const OutputLines& in = written[own->output];
      const std::size_t at = own->line == 0 ? 0 : in.ends[own->line - 1];
      places_[own->output].push_back({at, in.ends[own->line + own->count - 1] - at, g});
      continue;
    }
    const auto a = lines_of(gap.first - 1, gap.first - 1), b = lines_of(gap.last + 1, gap.next);
    if (!a || !b || a->output != b->output || a->line + a->count != b->line) {
      bad.insert(gap.run);
      continue;
    }
    places_[a->output].push_back({written[a->output].ends[a->line + a->count - 1], 0, g});
  }
  for (auto& p : places_)
    std::sort(p.begin(), p.end(),
              [](const Place& x, const Place& y) { return x.at != y.at ? x.at < y.at : x.gap < y.gap; });
  stays.runs.insert(bad.begin(), bad.end());
  stays.more.insert(special.begin(), special.end());
  stays.shapes.insert(odd.begin(), odd.end());
  return bad.empty() && special.empty() && odd.empty();
}

bool Unfolding::write(std::size_t output, std::string_view bytes, const TextSink& sink) const {
  FilePart file;
  if (!places_[output].empty() && !file.open(path_)) return false;
  const bool crlf = bytes.find("\r\n") != std::string_view::npos;
  const std::string_view eol = crlf ? "\r\n" : "\n";
  PlainLine line(words_);
  const bool places = line.by_way() != 0 || std::any_of(forms_.begin(), forms_.end(),
                                                        [](const Form& f) { return f.form && f.form->uses_place(); });
  Lines out(numbers_(), eol);
  std::size_t done = 0, last = 0;
  std::int8_t motion = motion_unknown;
  PlainPlace at;
  for (const Place& place : places_[output]) {
    const Gap& gap = folded_.gaps()[place.gap];
    out.add(bytes.substr(done, place.at - done));
    done = place.at + place.size;
    // Where it goes on from another one the state is what that one left, and the lines between them.
    std::size_t before = place.gap;
    const bool follows = gap.goes_on && place.at != 0 && last + 1 == place.gap;
    while (!follows && folded_.gaps()[before].goes_on) --before;
    const Gap& start = folded_.gaps()[before];
    std::uint64_t from = follows ? folded_.gaps()[last].to : start.from;
    if (!follows) {
      motion = start.motion;
      at = start.place;
    }
    last = place.gap;
    while (from < gap.to) {
      const bool own = from >= gap.from;
      const std::uint64_t stop = own ? gap.to : gap.from;
      std::string_view text = file.read(from, std::min(stop, from + piece_size));
      if (text.empty()) return false;
      const bool all = from + text.size() >= stop;
      if (!all && (text = line.whole_units(text)).empty()) return false;
      from += text.size();
      SourceLine l;
      PlainUnit unit;
      while (line.take(text, l, unit)) {
        const auto kind = line.scan(unit.text, motion, at);
        if (!own && kind == PlainLine::Kind::other && line.comment()) continue;
        if (kind != PlainLine::Kind::plain) return false;
        if (own) {
          const std::int32_t shape = index_.find(line, folded_.shapes());
          if (shape < 0 || !forms_[static_cast<std::size_t>(shape)].form) return false;
          out.add(*forms_[static_cast<std::size_t>(shape)].form, line, at);
        }
        if (places) at.follow(line);
        motion = line.motion_after();
      }
      if (out.text.size() >= piece_size) {
        if (!sink(out.text)) return false;
        out.text.clear();
      }
    }
  }
  out.add(bytes.substr(done));
  return sink(out.text);
}

}  // namespace cnctrans::translator
