// The word scanner is a shortcut: on every line it takes it must give what the grammar gives.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "frontends/common/word_scanner.h"
#include "frontends/num/syntax/parse.h"
#include "frontends/num/syntax/reader.h"
#include "frontends/num/syntax/scan_table.h"

namespace {

using namespace cnctrans;
using frontends::num::BlockParser;
using frontends::num::BlockReader;
using frontends::num::ParseError;

TEST(NumReaders, AgreeOnRandomLines) {
  constexpr std::array<std::string_view, 44> pieces{
      "X",  "Y5",  "Z-3.50", "G",  "G1",  "G 01", "G79",   "G77", "G10", "N10", "N",  " ",  "  ", "\t", "(a)",
      "()", "/",   "-",      "+",  "M03", "F.5",  "S100.", "T1",  "D",   "EB2", "L1", "=5", "1",  "0",  ".",
      "O",  "NU1", "E",      "IF", "VAR", "CUT",  "x7",    "$t",  "%",   "[A]", "R+", "I0", "*2", "B-0"};
  std::mt19937 random(20240607);
  std::uniform_int_distribution<std::size_t> piece(0, pieces.size() - 1);
  std::uniform_int_distribution<int> count(0, 9);
  BlockReader reader(frontends::Reader::both, true);
  syntax::Block block;
  ParseError error;
  int taken = 0;
  for (int i = 0; i < 40000; ++i) {
    std::string line;
    for (int n = count(random); n > 0; --n) line += pieces[piece(random)];
    reader.read(line, block, error);
    ASSERT_EQ(reader.difference(), "") << "`" << line << "`";
    taken += reader.scanned() ? 1 : 0;
  }
  EXPECT_GT(taken, 300);
}

TEST(NumReaders, ScannerLeavesKeywordsToTheGrammar) {
  BlockReader reader(frontends::Reader::scanner, true);
  syntax::Block block;
  ParseError error;
  ASSERT_TRUE(reader.read("VAR", block, error));
  EXPECT_FALSE(reader.scanned());
  ASSERT_EQ(block.statements.size(), 1U);
  BlockReader old(frontends::Reader::scanner, false);
  ASSERT_TRUE(old.read("VAR", block, error));
  EXPECT_TRUE(old.scanned());
  EXPECT_EQ(block.words.size(), 3U);
}

}  // namespace
