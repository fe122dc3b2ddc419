// The stream writes what the whole-program path writes, to the byte, with the same diagnostics; or it says that it
// can't. Random plain programs of every language to every other one, on mills and lathes.
#include <gtest/gtest.h>

#include <array>

#include "tests/support/temporary_folder.h"
#include "tests/translator/plain_program.h"
#include "translator/stream/stream.h"

namespace cnctrans::test {
namespace {

constexpr std::array<std::string_view, 3> languages{"fagor", "num", "sinumerik"};
constexpr std::uint32_t programs = 200;  ///< of each pair and kind of machine

struct Pair {
  std::string from, to;
  bool lathe = false;
};

translator::TranslateOptions options_of(const Pair& pair, std::uint32_t seed) {
  translator::TranslateOptions o;
  o.from = pair.from;
  o.to = pair.to;
  o.machine = pair.from + (pair.lathe ? "-lathe" : "-mill");
  o.target_machine = pair.to + (pair.lathe ? "-lathe" : "-mill");
  o.single_output = true;
  if (seed % 8 == 1) o.numbering = backends::Numbering::none;
  if (seed % 8 == 2) o.numbering = backends::Numbering::renumber;
  if (seed % 16 == 3) o.unsupported = backends::Unsupported::warn;
  if (seed % 16 == 4) o.eol = Eol::crlf;
  return o;
}

/// True when the program was streamed.
bool compare(const Pair& pair, std::uint32_t seed, const TemporaryFolder& folder) {
  const PlainProgram program = plain_program(pair.from, pair.lathe, seed);
  const std::string path = folder.write("PART12.TXT", program.text);
  const auto options = options_of(pair, seed);
  std::string streamed;
  const auto stream = translator::translate_stream(
      path, options, [&streamed](std::string_view text) { return streamed += text, true; }, {});
  EXPECT_NE(stream.outcome, translator::StreamOutcome::failed) << stream.error;
  if (stream.outcome != translator::StreamOutcome::done) return false;
  const auto whole = translator::translate(path, options);
  SCOPED_TRACE(pair.from + " to " + pair.to + (pair.lathe ? " (lathe)" : "") + ", seed " + std::to_string(seed) +
               ", program:\n" + program.text);
  EXPECT_EQ(whole.error, "");
  EXPECT_FALSE(whole.refused);
  EXPECT_EQ(render_json(stream.diagnostics, stream.files), render_json(whole.diagnostics, whole.files));
  EXPECT_EQ(stream.lines, whole.lines);
  EXPECT_EQ(whole.outputs.size(), whole.refused ? 0U : 1U);
  EXPECT_EQ(streamed, whole.outputs.empty() ? "" : whole.outputs[0].bytes);
  return true;
}

/// How many programs were streamed; ends at the first one that differs. --gtest_random_seed=N: other programs.
std::uint32_t compare_all(const Pair& pair) {
  const TemporaryFolder folder;
  const auto first = static_cast<std::uint32_t>(GTEST_FLAG_GET(random_seed)) * 100000U;
  std::uint32_t streamed = 0;
  for (std::uint32_t i = 0; i < programs && !::testing::Test::HasFailure(); ++i) {
    if (compare(pair, first + i, folder)) ++streamed;
  }
  return streamed;
}

void PrintTo(const Pair& p, std::ostream* out) {
  *out << p.from << " to " << p.to << (p.lathe ? ", lathe" : ", mill");
}

class StreamOfPair : public ::testing::TestWithParam<Pair> {};

TEST_P(StreamOfPair, IsTheWholeProgramPath) {
  const Pair& pair = GetParam();
  const std::uint32_t streamed = compare_all(pair);
  // Own language: left to the whole-program path. Fagor lathes: the safe start says the diameter mode, which acts on
  // the blocks behind. Sinumerik lathes start in radius and have their X words rescaled for a control without a switch.
  const bool never = pair.from == pair.to || (pair.lathe && (pair.to == "fagor" || pair.from == "sinumerik"));
  if (never) {
    EXPECT_EQ(streamed, 0U);
  } else {
    EXPECT_GT(streamed, programs / 24);  // the comparison is not an empty one; what gets a warning is not streamed
  }
}

std::vector<Pair> pairs() {
  std::vector<Pair> all;
  for (const auto from : languages) {
    for (const auto to : languages) {
      for (const bool lathe : {false, true}) all.push_back({std::string(from), std::string(to), lathe});
    }
  }
  return all;
}
INSTANTIATE_TEST_SUITE_P(Languages, StreamOfPair, ::testing::ValuesIn(pairs()), [](const auto& p) {
  return p.param.from + "_" + p.param.to + (p.param.lathe ? "_lathe" : "_mill");
});

}  // namespace
}  // namespace cnctrans::test
