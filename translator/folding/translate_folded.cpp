#include <bit>
#include <filesystem>

#include "machine/profile.h"
#include "translator/files/loader.h"
#include "translator/files/registry.h"
#include "translator/folding/unfolding.h"

namespace cnctrans::translator {

namespace {

constexpr int most_tries = 5;

bool may_fold(const std::string& path, const TranslateOptions& options, std::uintmax_t least_size) {
  std::error_code ignored;
  return can_reopen(path) && std::filesystem::file_size(path, ignored) >= least_size && !ignored &&
         options.reader == frontends::Reader::scanner && !options.annotate && !options.keep_traces && !options.draft &&
         options.numbering != backends::Numbering::renumber && options.eol != Eol::cr;
}

}  // namespace

std::unique_ptr<FoldedTranslation> translate_folded(const std::string& path, const TranslateOptions& options,
                                                    std::uintmax_t least_size) {
  const Dialect* from = find_dialect(options.from);
  const Dialect* to = find_dialect(options.to);
  if (from == nullptr || from->frontend == nullptr || to == nullptr || !may_fold(path, options, least_size))
    return nullptr;
  frontends::PlainWords words = from->frontend->plain_words();
  const frontends::PlainWords target = to->frontend != nullptr ? to->frontend->plain_words() : frontends::PlainWords{};
  words.other_blocks = target.numbers['N' - 'A'].most;
  backends::WriteOptions write;
  write.numbering = options.numbering;
  const auto numbers = [to, write] { return to->backend->block_numbers(write); };
  FoldedText::Stays stays;
  for (int tries = 0; tries < most_tries; ++tries) {
    auto text = FoldedText::of(path, words, stays);
    if (!text) return nullptr;
    auto done = std::make_unique<FoldedTranslation>();
    done->text = *std::move(text);
    TranslateOptions with = options;
    with.folded = &done->text;
    done->result = translate(Input(path, done->text.text()), with);
    TranslateResult& result = done->result;
    if (result.unfit) {
      if (result.unfit->whole) return nullptr;
      stays.numbers.insert(result.unfit->numbers.begin(), result.unfit->numbers.end());
      stays.runs.insert(result.unfit->runs.begin(), result.unfit->runs.end());
      for (std::uint32_t left = result.unfit->letters; left != 0; left &= left - 1)
        words.numbers[static_cast<std::size_t>(std::countr_zero(left))] = {};
      for (std::uint32_t left = result.unfit->by_way; left != 0; left &= left - 1) {
        auto& rule = words.numbers[static_cast<std::size_t>(std::countr_zero(left))];
        rule.by_way = rule.sign_told = true;
        rule.most = 359;
      }
      continue;
    }
    done->unfolding = std::make_unique<Unfolding>(path, words, done->text, target, numbers);
    if (result.refused || !result.error.empty()) return done;
    constexpr FileId main_file = 1;
    result.lines_by_form = done->text.lines_left_out();
    if (done->unfolding->learn(result.outputs, main_file, stays)) return done;
  }
  return nullptr;
}

TranslateResult translate_file(const std::string& path, const TranslateOptions& options) {
  auto folded = translate_folded(path, options);
  if (!folded) return translate(path, options);
  TranslateResult result = std::move(folded->result);
  for (std::size_t i = 0; i < result.outputs.size(); ++i) {
    OutputText& out = result.outputs[i];
    std::string whole;
    const auto add = [&whole](std::string_view piece) {
      whole += piece;
      return true;
    };
    if (!folded->unfolding->write(i, out.bytes, add)) result.error = path + " was changed while it was translated";
    out.bytes = std::move(whole);
    out.map = {};
  }
  return result;
}

}  // namespace cnctrans::translator
