#include "translator/folding/unfolding.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace cnctrans::translator {

namespace {

constexpr std::size_t kept_samples = 4;

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

}  // namespace

/// What the lines of the source became in all outputs.
class WrittenLines {
 public:
  WrittenLines(const std::vector<OutputText>& outputs, FileId file) {
    for (std::uint32_t o = 0; o < outputs.size(); ++o) {
      written_.push_back(output_lines(outputs[o].bytes));
      const auto& map = outputs[o].map.lines;
      for (std::uint32_t i = 0; i < map.size() && i < written_[o].lines.size(); ++i) {
        if (map[i].file != file) continue;
        Became& b = became_[map[i].line];
        if (b.count == 0) b = {o, i, 0, false};
        b.scattered = b.scattered || b.output != o || b.line + b.count != i;
        ++b.count;
      }
    }
  }
  /// nullopt: nothing, or lines that are not one behind the other.
  [[nodiscard]] std::optional<Became> of(std::uint32_t first, std::uint32_t last) const {
    std::optional<Became> all;
    for (std::uint32_t line = first; line <= last; ++line) {
      const auto it = became_.find(line);
      if (it == became_.end()) continue;
      const Became& b = it->second;
      if (!all) {
        all = b;
        continue;
      }
      all->scattered = all->scattered || b.scattered || b.output != all->output || b.line != all->line + all->count;
      all->count += b.count;
    }
    return all && !all->scattered ? all : std::nullopt;
  }
  [[nodiscard]] std::string_view text(const Became& b) const { return written_[b.output].text(b.line, b.count); }
  /// Bytes of the output: where the first of them begins, and the one behind the last.
  [[nodiscard]] std::size_t begin(const Became& b) const {
    return b.line == 0 ? 0 : written_[b.output].ends[b.line - 1];
  }
  [[nodiscard]] std::size_t end(const Became& b) const { return written_[b.output].ends[b.line + b.count - 1]; }

 private:
  std::vector<OutputLines> written_;
  std::unordered_map<std::uint32_t, Became> became_;  ///< by line of the source
};

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
  const WrittenLines written(outputs, file);
  const auto become = [&](const KeptLine& k) {
    const auto b = written.of(k.begin, k.line);
    return b && take(forms_[k.shape], {std::string(unit_text(*folded_.text(), k.begin, k.line)),
                                       std::string(written.text(*b)), k.motion, k.place});
  };
  // First those that are never the first of their run; what is special about a first line does not make a form.
  std::set<std::uint32_t> bad, special, partly;
  std::set<std::pair<std::uint32_t, std::uint32_t>> odd, shown;  // run, shape: a later line is (not) as the form says
  for (const bool first : {false, true}) {
    for (const KeptLine& k : folded_.kept()) {
      if (k.first != first) continue;
      if (become(k)) {
        if (!first) shown.emplace(k.run, k.shape);
        continue;
      }
      if (!folded_.leaves_out(k.run, k.shape)) continue;  // no other line is written like this one
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
    const auto found = place_of(g, written);
    if (found)
      places_[found->first].push_back(found->second);
    else
      bad.insert(folded_.gaps()[g].run);
  }
  for (auto& p : places_)
    std::sort(p.begin(), p.end(),
              [](const Place& x, const Place& y) { return x.at != y.at ? x.at < y.at : x.gap < y.gap; });
  uses_places_ = line_.by_way() != 0 || std::any_of(forms_.begin(), forms_.end(),
                                                    [](const Form& f) { return f.form && f.form->uses_place(); });
  stays.runs.insert(bad.begin(), bad.end());
  stays.more.insert(special.begin(), special.end());
  stays.shapes.insert(odd.begin(), odd.end());
  return bad.empty() && special.empty() && odd.empty();
}

std::optional<std::pair<std::uint32_t, Unfolding::Place>> Unfolding::place_of(std::size_t gap,
                                                                              const WrittenLines& written) const {
  const Gap& g = folded_.gaps()[gap];
  if (g.stands_in) {
    const auto own = written.of(g.first, g.last);
    if (!own) return std::nullopt;
    const std::size_t at = written.begin(*own);
    return std::pair(own->output, Place{at, written.end(*own) - at, gap});
  }
  const auto a = written.of(g.first - 1, g.first - 1), b = written.of(g.last + 1, g.next);
  if (!a || !b || a->output != b->output || a->line + a->count != b->line) return std::nullopt;
  return std::pair(a->output, Place{written.end(*a), 0, gap});
}

}  // namespace cnctrans::translator
