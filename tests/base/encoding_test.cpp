// UTF-8 and Windows-1252.
#include <gtest/gtest.h>

#include "base/source.h"

namespace cnctrans {
namespace {

TEST(Windows1252, AllBytesSurviveTheRoundTrip) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  const std::string utf8 = windows1252_to_utf8(bytes);
  EXPECT_TRUE(valid_utf8(utf8));
  EXPECT_EQ(utf8_to_windows1252(utf8), bytes);
}

TEST(Windows1252, KnownCharacters) {
  EXPECT_EQ(windows1252_to_utf8("\x80"), "\xE2\x82\xAC");  // euro sign
  EXPECT_EQ(windows1252_to_utf8("\xD8"), "\xC3\x98");      // O with stroke, the diameter sign of shop drawings
  EXPECT_EQ(windows1252_to_utf8("\x9F"), "\xC5\xB8");      // Y with diaeresis
  EXPECT_EQ(windows1252_to_utf8("\xFF"), "\xC3\xBF");      // y with diaeresis
}

TEST(Windows1252, WhatDoesNotExistThereIsNamedByItsPlace) {
  std::size_t bad = 99;
  EXPECT_EQ(utf8_to_windows1252("ab\xE4\xB8\xAD", &bad), std::nullopt);  // a Chinese character
  EXPECT_EQ(bad, 2U);
  EXPECT_EQ(utf8_to_windows1252("\xC2\x80", &bad), std::nullopt);  // U+0080: byte 80 is the euro sign
  EXPECT_EQ(bad, 0U);
  EXPECT_EQ(utf8_to_windows1252("abc\xFF", &bad), std::nullopt);  // no UTF-8 at all
  EXPECT_EQ(bad, 3U);
}

TEST(Utf8, FormsThatAreNotWellFormed) {
  EXPECT_TRUE(valid_utf8(""));
  EXPECT_TRUE(valid_utf8("\xC2\x80"));
  EXPECT_TRUE(valid_utf8("\xEF\xBF\xBF"));
  EXPECT_TRUE(valid_utf8("\xF4\x8F\xBF\xBF"));   // U+10FFFF
  EXPECT_FALSE(valid_utf8("\xF4\x90\x80\x80"));  // above it
  EXPECT_FALSE(valid_utf8("\xC0\x80"));          // overlong
  EXPECT_FALSE(valid_utf8("\xC1\xBF"));
  EXPECT_FALSE(valid_utf8("\xE0\x9F\xBF"));
  EXPECT_FALSE(valid_utf8("\xF0\x8F\xBF\xBF"));
  EXPECT_FALSE(valid_utf8("\xED\xA0\x80"));  // surrogate
  EXPECT_FALSE(valid_utf8("\x80"));
  EXPECT_FALSE(valid_utf8("\xE2\x82"));  // cut off
  EXPECT_FALSE(valid_utf8("\xC3("));
  EXPECT_FALSE(valid_utf8("\xF5\x80\x80\x80"));
}

TEST(Utf8, AFaultIsFoundAtEveryOffsetOfTheFastPath) {
  for (std::size_t size = 1; size < 100; ++size) {
    for (std::size_t at = 0; at < size; ++at) {
      std::string s(size, 'x');
      s[at] = '\xE4';
      ASSERT_FALSE(valid_utf8(s)) << size << ' ' << at;
      s.replace(at, 1, "\xC3\xA4");
      ASSERT_TRUE(valid_utf8(s)) << size << ' ' << at;
    }
  }
}

TEST(Utf8, OneCharacterAtATime) {
  char32_t c = 0;
  EXPECT_EQ(utf8_length("G", &c), 1U);
  EXPECT_EQ(utf8_length("\xE2\x82\xAC", &c), 3U);
  EXPECT_EQ(c, U'\u20AC');
  EXPECT_EQ(utf8_length("\xF0\x9F\x94\xA9", &c), 4U);
  EXPECT_EQ(c, U'\U0001F529');
  EXPECT_EQ(utf8_length(""), 0U);
  EXPECT_EQ(to_utf8("\xE4"), "\xC3\xA4");
  EXPECT_EQ(to_utf8("\xC3\xA4"), "\xC3\xA4");
}

}  // namespace
}  // namespace cnctrans
