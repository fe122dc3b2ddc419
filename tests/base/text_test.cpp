// Numbers in and out, and small text helpers.
#include "base/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace cnctrans {
namespace {

TEST(Shortest, WritesNoExponentAndNoMinusZero) {
  EXPECT_EQ(shortest(0.0), "0");
  EXPECT_EQ(shortest(-0.0), "0");
  EXPECT_EQ(shortest(1e-7), "0.0000001");
  EXPECT_EQ(shortest(-1e-7), "-0.0000001");
  EXPECT_EQ(shortest(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(shortest(1e15), "1000000000000000");
  EXPECT_EQ(shortest(1e21), "1000000000000000000000");
  EXPECT_EQ(shortest(10.5), "10.5");
  EXPECT_EQ(shortest(-100), "-100");
}

TEST(Shortest, HoldsTheSmallestAndTheLargestNumber) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double huge = std::numeric_limits<double>::max();
  EXPECT_EQ(shortest(tiny), "0." + std::string(323, '0') + "5");
  EXPECT_EQ(shortest(-huge).size(), 310U);
  EXPECT_EQ(parse_decimal(shortest(tiny)), tiny);
  EXPECT_EQ(parse_decimal(shortest(huge)), huge);
}

TEST(Shortest, ReadsBackToTheSameNumber) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-60, 60);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::ldexp(mantissa(random), exponent(random));
    ASSERT_EQ(parse_decimal(shortest(value)), value);
  }
}

TEST(Rounded, CutsPlacesAndTrailingZeros) {
  EXPECT_EQ(rounded(10.5, 3), "10.5");
  EXPECT_EQ(rounded(10.50049, 3), "10.5");
  EXPECT_EQ(rounded(0.1 + 0.2, 5), "0.3");
  EXPECT_EQ(rounded(12.34567, 3), "12.346");
  EXPECT_EQ(rounded(1200, 2), "1200");
  EXPECT_EQ(rounded(1e15, 3), "1000000000000000");
  EXPECT_EQ(rounded(10.4, 0), "10");
}

TEST(Rounded, HalfGoesAwayFromZero) {
  EXPECT_EQ(rounded(0.5, 0), "1");
  EXPECT_EQ(rounded(-0.5, 0), "-1");
  EXPECT_EQ(rounded(2.5, 0), "3");
  EXPECT_EQ(rounded(1.005, 2), "1.01");  // the double is a little below; a person reads 1.005
  EXPECT_EQ(rounded(-1.0005, 3), "-1.001");
  EXPECT_EQ(rounded(2.4999, 0), "2");
}

TEST(Rounded, CarriesThroughNines) {
  EXPECT_EQ(rounded(9.9996, 3), "10");
  EXPECT_EQ(rounded(-99.95, 1), "-100");
  EXPECT_EQ(rounded(0.9999, 3), "1");
  EXPECT_EQ(rounded(19.96, 1), "20");
}

TEST(Rounded, WhatBecomesZeroHasNoSign) {
  EXPECT_EQ(rounded(-0.0, 3), "0");
  EXPECT_EQ(rounded(1e-7, 3), "0");
  EXPECT_EQ(rounded(-1e-7, 3), "0");
  EXPECT_EQ(rounded(-0.0004, 3), "0");
  EXPECT_EQ(rounded(-0.0005, 3), "-0.001");
}

TEST(ParseDecimal, TakesTheFormsOfPartPrograms) {
  EXPECT_EQ(parse_decimal("+5"), 5);
  EXPECT_EQ(parse_decimal(".5"), 0.5);
  EXPECT_EQ(parse_decimal("5."), 5);
  EXPECT_EQ(parse_decimal("-.5"), -0.5);
  EXPECT_EQ(parse_decimal("-0.5"), -0.5);
  EXPECT_EQ(parse_decimal("007"), 7);
  EXPECT_EQ(parse_decimal("0.1"), 0.1);
  EXPECT_EQ(parse_decimal("123456789.123456789"), 123456789.123456789);
}

TEST(ParseDecimal, RefusesEverythingElse) {
  for (const char* bad : {"", "+", "-", ".", "+.", "1e5", "1E5", "1.2.3", "1 ", " 1", "--1", "+-1", "inf", "nan",
                          "0x10", "1,5", "5-", "INFINITY", "e5"}) {
    EXPECT_FALSE(parse_decimal(bad).has_value()) << bad;
  }
  EXPECT_FALSE(parse_decimal(std::string(400, '9')).has_value());  // out of a double's range
}

TEST(Text, Helpers) {
  EXPECT_EQ(to_upper_ascii("g1 x\xE4z"), "G1 X\xE4Z");
  EXPECT_EQ(trim(" \t a b \r\n"), "a b");
  EXPECT_EQ(trim("   "), "");
  EXPECT_TRUE(iequals_ascii("Goto", "gOTO"));
  EXPECT_FALSE(iequals_ascii("GOTO", "GOTOB"));
  EXPECT_FALSE(iequals_ascii("[", "{"));
}

}  // namespace
}  // namespace cnctrans
