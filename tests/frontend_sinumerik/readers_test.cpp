// The word scanner held to the grammar, and the corpus through the grammar.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "frontends/common/word_scanner.h"
#include "frontends/sinumerik/syntax/parse.h"
#include "frontends/sinumerik/syntax/scan_table.h"
#include "tests/frontend_sinumerik/show.h"

namespace {

using namespace cnctrans;
using namespace cnctrans::sinumerik;

/// Empty when the readers agree on the line (the scanner may leave it to the grammar).
std::string difference(BlockParser& parser, std::string_view line) {
  syntax::Block fast;
  syntax::Block slow;
  ParseError error;
  if (!frontends::scan_plain(line, scan_table, fast)) return {};
  if (!parser.parse_block(line, slow, error)) return std::string(line) + ": grammar refuses: " + error.message;
  if (fast == slow) return {};
  return std::string(line) + "\n" + syntax::dump(fast) + "--\n" + syntax::dump(slow);
}

TEST(SinumerikReaders, AgreeOnRandomLines) {
  BlockParser parser;
  std::mt19937 random(840);
  const std::string_view pieces[] = {"N", "10", "G", "1",  "X", "-",  "+",  ".5", "5.", "0.250",
                                     " ", "\t", "Y", "z",  ";", "x1", "/",  "/2", ":",  "=",
                                     "E", "EX", "M", "30", "L", "01", "CR", "R",  "(",  "1234567890123456"};
  std::uniform_int_distribution<std::size_t> pick(0, std::size(pieces) - 1);
  std::uniform_int_distribution<int> length(0, 12);
  for (int i = 0; i < 20000; ++i) {
    std::string line;
    for (int k = length(random); k > 0; --k) line += pieces[pick(random)];
    ASSERT_EQ(difference(parser, line), "");
  }
}

TEST(SinumerikReaders, AgreeOnTrapsOfPlainBlocks) {
  BlockParser parser;
  for (const std::string_view line :
       {"X10", "x-0.", "X +5", "X-.5Y+.5", "N10", "N 10 G 1", "/N10X1", "/ N10", "/3X1", ":5 G1", "X1;", ";", "; ;",
        "X00010", "F.1", "X1E5", "N0010G01", "L0123 P2", "X99999999999999999"}) {
    EXPECT_EQ(difference(parser, line), "");
  }
}

std::filesystem::path corpus() {
  return std::filesystem::path(CNCTRANS_SOURCE_DIR) / "../shared/corpus/sinumerik";
}

TEST(SinumerikReaders, CorpusIsReadByTheGrammar) {
  if (!std::filesystem::exists(corpus())) GTEST_SKIP() << "no corpus beside the source folder";
  BlockParser parser;
  syntax::Block block;
  ParseError error;
  std::size_t lines = 0;
  std::size_t unread = 0;
  for (const auto& entry : std::filesystem::directory_iterator(corpus())) {
    std::string message;
    const SourcePtr source = SourceText::open(entry.path().string(), &message);
    ASSERT_TRUE(source) << message;
    for (const SourceLine& line : source->lines()) {
      ++lines;
      if (!parser.parse_block(line.text, block, error)) ++unread;
      const std::string differs = difference(parser, line.text);
      EXPECT_EQ(differs, "") << entry.path();
      if (!differs.empty()) return;
    }
  }
  EXPECT_GT(lines, 70000U);
  // What is left are log files with a program's extension, control files of a simulator and faulty blocks.
  EXPECT_LT(unread * 100, lines * 2);
}

}  // namespace
