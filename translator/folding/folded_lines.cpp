#include "translator/folding/folded_lines.h"

#include <algorithm>
#include <filesystem>

#include "ir/edit/search.h"
#include "ir/text/text.h"
#include "translator/files/registry.h"

namespace cnctrans::translator {

namespace {

constexpr std::size_t piece_bytes = 1U << 20U;

double value_of(const PlainNumber& number) {
  return static_cast<double>(signed_value(number)) / place_scale;
}

}  // namespace

std::optional<BlockForm::Slot> BlockForm::slot_of(const PlainNumber& number) const {
  const auto& block = std::get<ir::Block>(statement_.node);
  const auto found = [](Part part, const auto& words, const auto& fits) -> std::optional<Slot> {
    const auto it = std::find_if(words.begin(), words.end(), fits);
    if (it == words.end()) return std::nullopt;
    return Slot{part, static_cast<std::size_t>(it - words.begin())};
  };
  const char letter = number.letter;
  if (letter == 'N') return Slot{};
  if (letter == 'R') return block.motion.radius_given ? std::optional(Slot{Part::radius, 0}) : std::nullopt;
  if (letter == 'F')
    return found(Part::feed, block.actions, [](const auto& a) { return std::holds_alternative<ir::SetFeed>(a.data); });
  const bool centre = letter >= 'I' && letter <= 'K';
  const ir::AxisId axis = ir::fixed_axis(static_cast<char>(centre ? letter - 'I' + 'X' : letter));
  const auto fits = [axis](const auto& w) { return w.axis == axis; };
  return centre ? found(Part::centre, block.motion.centers, fits) : found(Part::axis, block.motion.coords, fits);
}

ir::Value* BlockForm::value_at(const Slot& slot) {
  auto& block = std::get<ir::Block>(statement_.node);
  switch (slot.part) {
    case Part::number: return nullptr;
    case Part::axis: return &block.motion.coords[slot.at].value;
    case Part::centre: return &block.motion.centers[slot.at].value;
    case Part::radius: return &block.motion.radius;
    case Part::feed: return &std::get<ir::SetFeed>(block.actions[slot.at].data).value;
  }
  return nullptr;
}

std::optional<BlockForm> BlockForm::of(const PlainLine& line, std::uint32_t number, const ir::Statement& read) {
  const auto* block = std::get_if<ir::Block>(&read.node);
  if (block == nullptr || block->repeat_given != 0) return std::nullopt;
  BlockForm form;
  form.statement_ = read;
  form.statement_.line.number = {};
  form.begins_ = read.line.span.line - number;
  form.ends_ = read.line.span.end_line - number;
  std::size_t words = 0;
  for (std::size_t i = 0; i < line.count(); ++i) {
    const auto slot = form.slot_of(line.number(i));
    if (!slot) return std::nullopt;
    ir::Value* value = form.value_at(*slot);
    if (value != nullptr && !value->is(value_of(line.number(i)))) return std::nullopt;
    if (value != nullptr) value->text = {};
    if (slot->part == Part::feed) std::get<ir::Block>(form.statement_.node).actions[slot->at].text = {};
    if (slot->part == Part::axis || slot->part == Part::centre) ++words;
    form.slots_.push_back(*slot);
  }
  if (words != block->motion.coords.size() + block->motion.centers.size()) return std::nullopt;
  return form;
}

const ir::Statement& BlockForm::with(const PlainLine& line, std::uint32_t number) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (ir::Value* value = value_at(slots_[i])) value->number = value_of(line.number(i));
  }
  statement_.line.span.line = number + begins_;
  statement_.line.span.end_line = number + ends_;
  return statement_;
}

FoldedLines::FoldedLines(const std::string& path, const frontends::PlainWords& words, const FoldedText& folded,
                         const ir::Program& program)
    : line_(words), folded_(folded), main_(program.files.empty() ? 0 : program.files.front().file) {
  for (std::size_t i = 0; i < folded.shapes().size(); ++i)
    index_.add_key(folded.shapes()[i].key, static_cast<std::uint32_t>(i));
  for (std::size_t i = 0; i < folded.gaps().size(); ++i) gaps_.emplace(folded.gaps()[i].first - 1, i);
  known_ = file_.open(path) && learn(program);
}

bool FoldedLines::learn(const ir::Program& program) {
  std::unordered_map<std::uint32_t, std::vector<const ir::Statement*>> read;  // by line
  for (const auto& routine : program.routines) {
    ir::for_each_statement(routine.body, [&](const ir::Statement& s) {
      if (s.line.span.file == main_) read[s.line.span.line].push_back(&s);
    });
  }
  const SourceText& text = *folded_.text();
  return std::all_of(folded_.kept().begin(), folded_.kept().end(), [&](const KeptLine& k) {
    const ir::Statement* only = nullptr;
    for (std::uint32_t n = k.begin; n <= k.line; ++n) {
      for (const auto* s : read[n]) {
        if (only != nullptr) return false;
        only = s;
      }
    }
    const std::string_view from = text.line_text(k.begin), to = text.line_text(k.line);
    const std::string_view unit{from.data(), static_cast<std::size_t>(to.data() + to.size() - from.data())};
    if (only == nullptr || line_.scan(unit, k.motion, k.place) != PlainLine::Kind::plain) return false;
    auto form = BlockForm::of(line_, k.begin, *only);
    if (!form) return false;
    const auto [old, first] = forms_.try_emplace({k.run, k.shape}, *form);
    return first || to_text(old->second.with(line_, k.begin), program) == to_text(form->with(line_, k.begin), program);
  });
}

bool FoldedLines::any(const Span& line) const {
  return line.file == main_ && gaps_.contains(std::max(line.line, line.end_line));
}

bool FoldedLines::each(const Span& line, const std::function<bool(const ir::Statement&)>& take) {
  const Gap& gap = folded_.gaps()[gaps_.at(std::max(line.line, line.end_line))];
  std::vector<BlockForm*> forms(folded_.shapes().size());
  for (auto it = forms_.lower_bound({gap.run, 0}); it != forms_.end() && it->first.first == gap.run; ++it)
    forms[it->first.second] = &it->second;
  std::int8_t motion = gap.motion;
  const PlainPlace nowhere{.increments = gap.place.increments};
  SourceLine l;
  l.number = gap.first - 1;
  for (std::uint64_t from = gap.from; from < gap.to;) {
    std::string_view text = file_.read(from, std::min(gap.to, from + piece_bytes));
    if (from + text.size() < gap.to) text = line_.whole_units(text);
    if (text.empty()) return false;
    from += text.size();
    PlainUnit unit;
    while (line_.take(text, l, unit)) {
      if (line_.scan(unit.text, motion, nowhere, unit.room) != PlainLine::Kind::plain) return false;
      motion = line_.motion_after();
      const std::int32_t shape = index_.find(line_, folded_.shapes());
      if (shape < 0 || forms[static_cast<std::size_t>(shape)] == nullptr) return false;
      if (!take(forms[static_cast<std::size_t>(shape)]->with(line_, unit.first))) return true;
    }
  }
  return true;
}

std::optional<RunResult> run_folded(const std::string& path, const Dialect& dialect, const RunOptions& options,
                                    const MakeSink& make_sink, std::uintmax_t least_size) {
  std::error_code ignored;
  if (options.reader != frontends::Reader::scanner || std::filesystem::file_size(path, ignored) < least_size || ignored)
    return std::nullopt;
  FoldedText::Stays stays;
  stays.as_read = true;
  constexpr int most_readings = 3;
  for (int tries = 0; tries < most_readings; ++tries) {
    const auto text = FoldedText::of(path, dialect.frontend->plain_words(), stays);
    if (!text) return std::nullopt;
    RunOptions with = options;
    with.may_stream = false;
    with.folded = &*text;
    RunResult result = run(Input(path, text->text()), with, make_sink);
    if (!result.unfit) return result;
    if (result.unfit->whole) return std::nullopt;
    stays.numbers.insert(result.unfit->numbers.begin(), result.unfit->numbers.end());
    stays.runs.insert(result.unfit->runs.begin(), result.unfit->runs.end());
  }
  return std::nullopt;
}

}  // namespace cnctrans::translator
