#include "translator/option_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

namespace cnctrans::translator {

namespace {

struct Word {
  std::string_view option, value;
  void (*set)(TranslateOptions&);
};

using backends::Numbering;
using backends::Unsupported;
using frontends::Reader;
using ir::CycleWriting;

constexpr std::array words{
    Word{"unsupported", "error", [](TranslateOptions& o) { o.unsupported = Unsupported::error; }},
    Word{"unsupported", "warn", [](TranslateOptions& o) { o.unsupported = Unsupported::warn; }},
    Word{"unsupported", "comment", [](TranslateOptions& o) { o.unsupported = Unsupported::comment; }},
    Word{"numbering", "keep", [](TranslateOptions& o) { o.numbering = Numbering::keep; }},
    Word{"numbering", "none", [](TranslateOptions& o) { o.numbering = Numbering::none; }},
    Word{"numbering", "renumber", [](TranslateOptions& o) { o.numbering = Numbering::renumber; }},
    Word{"cycles", "native", [](TranslateOptions& o) { o.cycles = CycleWriting::native; }},
    Word{"cycles", "exact", [](TranslateOptions& o) { o.cycles = CycleWriting::exact; }},
    Word{"cycles", "explode", [](TranslateOptions& o) { o.cycles = CycleWriting::explode; }},
    Word{"structure", "keep", [](TranslateOptions& o) { o.raise_structure = false; }},
    Word{"structure", "raise", [](TranslateOptions& o) { o.raise_structure = true; }},
    Word{"encoding", "", [](TranslateOptions& o) { o.encoding.reset(); }},
    Word{"encoding", "utf-8", [](TranslateOptions& o) { o.encoding = Encoding::utf8; }},
    Word{"encoding", "windows-1252", [](TranslateOptions& o) { o.encoding = Encoding::windows1252; }},
    Word{"eol", "", [](TranslateOptions& o) { o.eol.reset(); }},
    Word{"eol", "lf", [](TranslateOptions& o) { o.eol = Eol::lf; }},
    Word{"eol", "crlf", [](TranslateOptions& o) { o.eol = Eol::crlf; }},
    Word{"eol", "cr", [](TranslateOptions& o) { o.eol = Eol::cr; }},
    Word{"reader", "scanner", [](TranslateOptions& o) { o.reader = Reader::scanner; }},
    Word{"reader", "antlr", [](TranslateOptions& o) { o.reader = Reader::antlr; }},
    Word{"reader", "both", [](TranslateOptions& o) { o.reader = Reader::both; }},
};

}  // namespace

bool set_word(TranslateOptions& options, std::string_view option, std::string_view value) {
  const auto found =
      std::find_if(words.begin(), words.end(), [&](const Word& w) { return w.option == option && w.value == value; });
  if (found == words.end()) return false;
  found->set(options);
  return true;
}

bool add_setting(interpreter::Options& run, std::string_view item) {
  const auto equals = item.find('=');
  if (equals == std::string_view::npos || equals == 0) return false;
  run.set.emplace_back(item.substr(0, equals), item.substr(equals + 1));
  return true;
}

void add_skip(interpreter::Options& run, unsigned level, const Dialect* dialect) {
  const unsigned first = dialect != nullptr ? static_cast<unsigned>(dialect->first_skip_switch) : 0;
  run.skip_mask = static_cast<std::uint16_t>(run.skip_mask | (1U << (level > first ? level - first : 0)));
}

bool add_skips(interpreter::Options& run, std::string_view list, const Dialect* dialect) {
  while (!list.empty()) {
    unsigned level = 0;
    const auto [end, error] = std::from_chars(list.data(), list.data() + list.size(), level);
    if (error != std::errc{} || level > last_skip_level) return false;
    add_skip(run, level, dialect);
    list.remove_prefix(static_cast<std::size_t>(end - list.data()));
    if (!list.empty() && list.front() == ',') list.remove_prefix(1);
  }
  return true;
}

}  // namespace cnctrans::translator
