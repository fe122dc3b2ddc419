#include "frontends/common/word_scanner.h"

#include <gtest/gtest.h>

#include <string>

#include "base/text.h"

namespace cnctrans::frontends {
namespace {

ScanTable plain_table() {
  ScanTable t;
  for (char c : std::string_view("GXYZIJKFSTDMR")) t.letters[static_cast<unsigned char>(c)] = LetterClass::word;
  t.letters['N'] = LetterClass::number;
  t.skip_digits = true;
  t.skip_digit_offset = 1;
  return t;
}

TEST(WordScanner, ReadsAPlainBlockWithPlaces) {
  syntax::Block b;
  ASSERT_TRUE(scan_plain("/2N0120 G1X10.500 Z-.5F0.2 ;to the face", plain_table(), b));
  EXPECT_EQ(b.skip_mask, 2);
  EXPECT_EQ(b.number, "0120");
  ASSERT_EQ(b.words.size(), 4U);
  EXPECT_EQ(b.words[1].address, "X");
  EXPECT_EQ(b.words[1].number, 10.5);
  EXPECT_EQ(b.words[1].number_text, "10.500");
  EXPECT_EQ(b.words[1].pos, (WordPos{11, 7}));
  EXPECT_EQ(b.words[2].number, -0.5);
  ASSERT_EQ(b.comments.size(), 1U);
  EXPECT_EQ(b.comments[0].text, "to the face");
  EXPECT_TRUE(b.plain);
}

TEST(WordScanner, LeavesEverythingElseToTheGrammar) {
  syntax::Block b;
  const auto t = plain_table();
  for (const char* line : {"(P1=2)", "XP100", "X=10", "G1 X", "X-", "X1.2.3", "X1E5", "N10.5", "N", "G1 x5", "%5",
                           "X10 N5", "X 10", "X12345678901234567890", "/G1 /X2", "X1,5", "\xff", "X1\x1a"}) {
    EXPECT_FALSE(scan_plain(line, t, b)) << line;
  }
}

TEST(WordScanner, BlanksAndEmptyLinesAreEmptyPlainBlocks) {
  syntax::Block b;
  for (const char* line : {"", "   ", "\t "}) {
    EXPECT_TRUE(scan_plain(line, plain_table(), b)) << line;
    EXPECT_TRUE(b.words.empty());
  }
}

TEST(WordScanner, ClosedCommentsEndAtTheFirstMark) {
  auto t = plain_table();
  t.comment_open = '(';
  t.comment_close = ')';
  syntax::Block b;
  ASSERT_TRUE(scan_plain("G1 X5 (A) (B)", t, b));
  ASSERT_EQ(b.comments.size(), 2U);
  EXPECT_EQ(b.comments[1].text, "B");
  EXPECT_FALSE(scan_plain("G1 (A) X5", t, b)) << "a comment between words goes to the grammar";
  EXPECT_FALSE(scan_plain("G1 (A", t, b)) << "an open comment goes to the grammar";
}

TEST(WordScanner, BareWordsAndBlanksWhereTheLanguageHasThem) {
  auto t = plain_table();
  t.bare_words = true;
  t.blank_before_value = true;
  syntax::Block b;
  ASSERT_TRUE(scan_plain("N 10 G X 5 Z", t, b));
  EXPECT_EQ(b.number, "10");
  ASSERT_EQ(b.words.size(), 3U);
  EXPECT_FALSE(b.words[0].has_value);
  EXPECT_EQ(b.words[0].pos, (WordPos{6, 1}));
  EXPECT_EQ(b.words[1].number, 5);
  EXPECT_FALSE(scan_plain("X P100", t, b)) << "a variable as value goes to the grammar";
}

// The scanner's own number reading against the library's, on every digit count it takes.
TEST(WordScanner, NumbersAreCorrectlyRounded) {
  syntax::Block b;
  std::uint64_t seed = 12345;
  for (int i = 0; i < 20000; ++i) {
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    std::string digits = std::to_string(seed >> (seed % 50));
    if (digits.size() > 17) digits.resize(17);
    const std::size_t point = (seed >> 7) % (digits.size() + 1);
    std::string number = (seed & 1U) != 0 ? "-" : "";
    number += digits.substr(0, point) + "." + digits.substr(point);
    const std::string line = "X" + number;
    ASSERT_TRUE(scan_plain(line, plain_table(), b)) << line;
    EXPECT_EQ(b.words[0].number, parse_decimal(number)) << line;
  }
}

}  // namespace
}  // namespace cnctrans::frontends
