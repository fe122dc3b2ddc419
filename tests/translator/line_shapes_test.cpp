// A shape is learned from one line and written for the others; what is not the same shape is refused.
#include "translator/stream/line_shapes.h"

#include <gtest/gtest.h>

namespace cnctrans::test {
namespace {

using translator::LineShapes;

frontends::FreeNumbers rules() {
  frontends::FreeNumbers free;
  free['X' - 'A'] = free['Y' - 'A'] = {true, true, true, 5, 4};
  free['F' - 'A'] = {true, false, false, 5, 4};
  free['N' - 'A'] = {true, false, true, 8, 0};
  return free;
}

/// A stream that writes G1 for G01 and puts F in front.
std::optional<std::string> stream(std::string_view line) {
  std::string text(line);
  const auto g = text.find("G01");
  if (g != std::string::npos) text.erase(g + 1, 1);
  const auto f = text.find(" F");
  return f == std::string::npos ? text + '\n' : text.substr(f + 1) + ' ' + text.substr(0, f) + '\n';
}

class Shapes : public ::testing::Test {
 protected:
  LineShapes shapes{rules(), 3};
  /// Writes the line, after `first` has been learned.
  std::string write(std::string_view first, std::string_view line, std::uint32_t state = 0) {
    std::string out;
    EXPECT_FALSE(shapes.write(first, 0, out));
    EXPECT_EQ(out, "");
    shapes.learn(first, 0, *stream(first), stream);
    return shapes.write(line, state, out) ? out : "refused" + out;
  }
};

TEST_F(Shapes, NumbersFillTheGaps) {
  EXPECT_EQ(write("N10 G01 X1.5 Y2 F100", "N20 G01  X-12345.123 Y.5 F1"), "F1 N20 G1 X-12345.123 Y.5\n");
}
TEST_F(Shapes, AnotherCodeIsAnotherShape) {
  EXPECT_EQ(write("G01 X1", "G02 X1"), "refused");
}
TEST_F(Shapes, AnotherStateIsAnotherShape) {
  EXPECT_EQ(write("G01 X1", "G01 X2", 1), "refused");
}
TEST_F(Shapes, AnotherOrderIsAnotherShape) {
  EXPECT_EQ(write("X1 Y1", "Y1 X1"), "refused");
}
TEST_F(Shapes, TooManyPlaces) {
  EXPECT_EQ(write("X1", "X1.2345"), "refused");
}
TEST_F(Shapes, TooManyDigits) {
  EXPECT_EQ(write("X1", "X123456"), "refused");
}
TEST_F(Shapes, PlusSign) {
  EXPECT_EQ(write("X1", "X+1"), "refused");
}
TEST_F(Shapes, NoNumber) {
  EXPECT_EQ(write("X1", "X"), "refused");
}
TEST_F(Shapes, PointOnly) {
  EXPECT_EQ(write("X1", "X."), "refused");
}
TEST_F(Shapes, ZeroWithAMeaningOfItsOwn) {
  EXPECT_EQ(write("X1 F1", "X1 F0.00"), "refused");
}
TEST_F(Shapes, MinusWithAMeaningOfItsOwn) {
  EXPECT_EQ(write("X1 F1", "X1 F-1"), "refused");
}
TEST_F(Shapes, Comment) {
  EXPECT_EQ(write("X1", "X1 ;a"), "refused");
}
TEST_F(Shapes, Skip) {
  EXPECT_EQ(write("X1", "/X1"), "refused");
}

TEST_F(Shapes, ATextThatChangesTheNumberIsNotLearned) {
  std::string out;
  EXPECT_FALSE(shapes.write("X1.5", 0, out));
  shapes.learn("X1.5", 0, "X2\n", [](std::string_view) { return std::optional<std::string>("X21380\n"); });
  EXPECT_FALSE(shapes.write("X2.5", 0, out));
}
TEST_F(Shapes, ATextThatHappensToFitOnceIsNotLearned) {
  std::string out;
  EXPECT_FALSE(shapes.write("X1.5", 0, out));
  shapes.learn("X1.5", 0, "X1.5 M8\n", [](std::string_view line) { return std::optional(std::string(line) + "\n"); });
  EXPECT_FALSE(shapes.write("X2.5", 0, out));
}

}  // namespace
}  // namespace cnctrans::test
