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

/// The line of an output that a line of the source became.
struct Became {
  std::uint32_t output = 0, line = 0, times = 0;
};

}  // namespace

Unfolding::Unfolding(std::string path, const frontends::PlainWords& words, const FoldedText& folded)
    : path_(std::move(path)), words_(words), folded_(folded), line_(words), forms_(folded.shapes().size()) {
  for (std::size_t i = 0; i < folded.shapes().size(); ++i) {
    const std::string& key = folded.shapes()[i].key;
    index_.add_key(key, static_cast<std::uint32_t>(i));
  }
}

bool Unfolding::explains(const LineForm& form, const Sample& sample) {
  std::string again;
  if (line_.scan(sample.text, sample.motion) != PlainLine::Kind::plain) return false;
  form.write(line_, sample.place, again);
  return again == sample.written;
}

/// The form of a shape explains every line of it, or there is none.
bool Unfolding::take(Form& form, Sample sample) {
  if (form.form && explains(*form.form, sample)) {
    if (form.samples.size() < kept_samples) form.samples.push_back(std::move(sample));
    return true;
  }
  if (line_.scan(sample.text, sample.motion) != PlainLine::Kind::plain) return false;
  const auto other = LineForm::of(line_, sample.place, sample.written);
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
      b = {o, i, b.times + 1};
    }
  }
  const auto line_of = [&](std::uint32_t line) -> const Became* {
    const auto it = became.find(line);
    return it != became.end() && it->second.times == 1 ? &it->second : nullptr;
  };
  // First those that are never the first of their run; what is special about a first line does not make a form.
  std::set<std::uint32_t> bad, special;
  std::set<std::pair<std::uint32_t, std::uint32_t>> shown;  // run, shape: a later line is as the form says
  const SourceText& source = *folded_.text();
  for (const bool first : {false, true}) {
    for (const KeptLine& k : folded_.kept()) {
      if (k.first != first) continue;
      const Became* b = line_of(k.line);
      const bool good =
          b != nullptr && take(forms_[k.shape], {std::string(source.line_text(k.line)),
                                                 std::string(written[b->output].lines[b->line]), k.motion, k.place});
      if (good) {
        if (!first) shown.emplace(k.run, k.shape);
        continue;
      }
      if (!first) {
        bad.insert(k.run);
      } else if (!shown.contains({k.run, k.shape}) && !stays.more.contains(k.run)) {
        special.insert(k.run);
      }
    }
  }
  places_.assign(outputs.size(), {});
  for (std::size_t g = 0; g < folded_.gaps().size(); ++g) {
    const Gap& gap = folded_.gaps()[g];
    const Became *a = line_of(gap.first - 1), *b = line_of(gap.last + 1);
    if (a == nullptr || b == nullptr || a->output != b->output || a->line + 1 != b->line) {
      bad.insert(gap.run);
      continue;
    }
    places_[a->output].push_back({written[a->output].ends[a->line], g});
  }
  for (auto& p : places_) std::sort(p.begin(), p.end(), [](const Place& x, const Place& y) { return x.at < y.at; });
  stays.runs.insert(bad.begin(), bad.end());
  stays.more.insert(special.begin(), special.end());
  return bad.empty() && special.empty();
}

bool Unfolding::write(std::size_t output, std::string_view bytes, const TextSink& sink) const {
  FilePart file;
  if (!places_[output].empty() && !file.open(path_)) return false;
  const bool crlf = bytes.find("\r\n") != std::string_view::npos;
  const std::string_view eol = crlf ? "\r\n" : "\n";
  PlainLine line(words_);
  const bool places =
      std::any_of(forms_.begin(), forms_.end(), [](const Form& f) { return f.form && f.form->uses_place(); });
  std::string out;
  std::size_t done = 0, last = 0;
  std::int8_t motion = motion_unknown;
  PlainPlace at;
  for (const Place& place : places_[output]) {
    const Gap& gap = folded_.gaps()[place.gap];
    out += bytes.substr(done, place.at - done);
    done = place.at;
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
      if (!all) {
        const auto end = text.rfind('\n');
        if (end == std::string_view::npos) return false;
        text = text.substr(0, end + 1);
      }
      from += text.size();
      SourceLine l;
      while (take_line(text, l)) {
        if (line.scan(l.text, motion) != PlainLine::Kind::plain) return false;
        if (own) {
          const std::int32_t shape = index_.find(line, folded_.shapes());
          if (shape < 0 || !forms_[static_cast<std::size_t>(shape)].form) return false;
          const LineForm& form = *forms_[static_cast<std::size_t>(shape)].form;
          form.write(line, at, out);
          out += eol;
        }
        if (places) at.follow(line);
        motion = line.motion_after();
      }
      if (out.size() >= piece_size) {
        if (!sink(out)) return false;
        out.clear();
      }
    }
  }
  out += bytes.substr(done);
  return sink(out);
}

}  // namespace cnctrans::translator
