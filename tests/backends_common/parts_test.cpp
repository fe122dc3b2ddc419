// The small parts that all writers share.
#include <gtest/gtest.h>

#include "backends/common/comments.h"
#include "backends/common/labels.h"
#include "backends/common/line.h"
#include "backends/common/motion_tracker.h"
#include "backends/common/numbers.h"

namespace cnctrans::backends {
namespace {

std::string number(double value, std::string_view text, const NumberFormat& format) {
  std::string out;
  append_number(out, value, text, format);
  return out;
}

TEST(Numbers, TextOfTheSourceIsKeptWhenTheTargetCanReadIt) {
  const NumberFormat three{3, 3, false};
  EXPECT_EQ(number(10.5, "10.500", three), "10.500");
  EXPECT_EQ(number(5, "+5", three), "5");
  EXPECT_EQ(number(-0.5, "-.5", three), "-.5");
  EXPECT_EQ(number(5, "5.", three), "5.");
}

TEST(Numbers, TooManyPlacesAreRoundedAndTheChangeIsKnown) {
  std::string out;
  EXPECT_NEAR(append_number(out, 1.23456, "1.23456", {3, 3, false}), 0.00044, 1e-12);
  EXPECT_EQ(out, "1.235");
  out.clear();
  EXPECT_EQ(append_number(out, 1.5, "1.50000", {3, 3, false}), 0);  // only zeros were cut off
  EXPECT_EQ(out, "1.5");
}

TEST(Numbers, OtherFormsOfNumbersAreNotCopied) {
  EXPECT_FALSE(plain_number("8.2EX-3"));
  EXPECT_FALSE(plain_number("$1F"));
  EXPECT_FALSE(plain_number("1.2.3"));
  EXPECT_FALSE(plain_number("-"));
  EXPECT_EQ(number(0.0082, "8.2EX-3", {4, 4, false}), "0.0082");
  EXPECT_EQ(number(0.0082, "8.2EX-3", {4, 4, true}), "8.2EX-3");  // the target's own language
}

TEST(Comments, LettersWithMarksBecomeAscii) {
  bool lossy = false;
  EXPECT_EQ(to_ascii("Fr\xC3\xA4sen \xC3\x98 \xC3\xA9", &lossy), "Fraesen OE e");
  EXPECT_FALSE(lossy);
  EXPECT_EQ(to_ascii("\xE2\x98\x83", &lossy), "?");
  EXPECT_TRUE(lossy);
  EXPECT_EQ(to_ascii("\xE4", nullptr), "ae");  // Windows-1252
}

TEST(Comments, ForbiddenCharactersAreReplaced) {
  const CommentStyle round{
      .open = "(", .close = ")", .trim = true, .ascii = true, .upper = true, .forbidden = "()", .instead = "[]"};
  EXPECT_EQ(comment(" Tool (new) ", round, false, nullptr), "(TOOL [NEW])");
  EXPECT_EQ(comment(" As it is", round, true, nullptr), "( As it is)");
}

TEST(Lines, PiecesWithoutAPlaceGoBeforeTheFirstOfAHigherRank) {
  Line line;
  line.add("X1", Rank::coordinate, {5, 2});
  line.add("G1", Rank::motion_code, {1, 2});
  line.add("F2", Rank::feed, {9, 2});
  line.add("Z3", Rank::coordinate);
  line.add("G90", Rank::setting);
  line.add("M3", Rank::machine);
  EXPECT_EQ(line.text(false), "G90 G1 X1 Z3 F2 M3");
}

TEST(Lines, ColumnsWinOverRanksUnlessTheStyleSaysSo) {
  Line line;
  line.add("F2", Rank::feed, {1, 2});
  line.add("G1", Rank::motion_code, {4, 2});
  EXPECT_EQ(line.text(false), "F2 G1");
  EXPECT_EQ(line.text(true), "G1 F2");
  EXPECT_TRUE(line.has_column(4));
  EXPECT_FALSE(line.has_column(0));
}

TEST(Labels, LeadingZerosDoNotCount) {
  EXPECT_EQ(without_leading_zeros("0020"), "20");
  EXPECT_EQ(without_leading_zeros("000"), "0");
}

TEST(Labels, MarksAreReplacedByTheNewNumbers) {
  Renumbering r;
  r.set(0, "20", 110);
  r.set(1, "20", 250);
  std::string text = "GOTO N" + Renumbering::mark(0, "020") + " N" + Renumbering::mark(1, "20") + " N" +
                     Renumbering::mark(0, "7") + ";";
  r.resolve(text);
  EXPECT_EQ(text, "GOTO N110 N250 N7;");
}

TEST(MotionTracker, NothingIsNeededWhileTextAndMeaningGoTogether) {
  MotionTracker t(true);
  EXPECT_FALSE(t.needed(std::nullopt));
  t.wrote(ir::MotionKind::linear, true);
  EXPECT_FALSE(t.needed(std::nullopt));
}

TEST(MotionTracker, AfterAOneShotTheFormerCodeIsNeededOnce) {
  MotionTracker t(true);
  t.wrote(ir::MotionKind::linear, true);
  t.wrote(ir::MotionKind::rapid, false);
  EXPECT_EQ(t.needed(std::nullopt), ir::MotionKind::linear);
  EXPECT_FALSE(t.needed(std::nullopt));
}

TEST(MotionTracker, BehindALabelOnlyAnAnalysisKnows) {
  MotionTracker t(true);
  t.wrote(ir::MotionKind::linear, true);
  t.join();
  EXPECT_EQ(t.needed(std::nullopt), ir::MotionKind::modal);  // not known
  EXPECT_EQ(t.needed(ir::MotionKind::rapid), ir::MotionKind::rapid);
  MotionTracker plain(false);  // no one-shots in the program: labels change nothing
  plain.join();
  EXPECT_FALSE(plain.needed(std::nullopt));
}

}  // namespace
}  // namespace cnctrans::backends
