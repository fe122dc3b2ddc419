// The grammar of one NUM block: the lexical traps, expressions, statements. Sections are the reference's.
#include "frontends/num/syntax/parse.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/frontend_num/show.h"

namespace {

using namespace cnctrans;
using frontends::num::BlockParser;
using frontends::num::ParseError;
using frontends::num::testing::parse;

TEST(NumParse, WordsWithAndWithoutBlanks) {  // 2.1
  EXPECT_EQ(parse("N10G1X10.5Y-3F200"), "N10 G=1 X=10.5 Y=-3 F=200");
  EXPECT_EQ(parse("N 10 G 1 X 25 F 150"), "N10 G=1 X=25 F=150");
  EXPECT_EQ(parse("M6T1D1"), "M=6 T=1 D=1");
  EXPECT_EQ(parse("g1 x5 eb-2"), "g=1 x=5 eb=-2");
  EXPECT_EQ(parse("X+012 Y-.5 Z100. W.25"), "X=+012 Y=-.5 Z=100. W=.25");
  EXPECT_EQ(parse(""), "");
  EXPECT_EQ(parse("   \t "), "");
}

TEST(NumParse, DigitsAreJoinedAcrossBlanks) {  // 2.1, policy digits_joined
  BlockParser p;
  syntax::Block b;
  ParseError e;
  ASSERT_TRUE(p.parse("X1 0 Y- 5 .5", b, e));
  EXPECT_EQ(b.words[0].number, 10);
  EXPECT_EQ(b.words[0].number_text, "1 0");
  EXPECT_EQ(b.words[1].number, -5.5);
}

TEST(NumParse, AddressWithoutValue) {  // 2.2
  EXPECT_EQ(parse("G G90 G40"), "G=? G=90 G=40");
  EXPECT_EQ(parse("G52 XZ"), "G=52 X=? Z=?");
  EXPECT_EQ(parse("G40 Z M5"), "G=40 Z=? M=5");
  EXPECT_EQ(parse("EB D"), "EB=? D=?");
}

TEST(NumParse, PositionsAreBytesOfTheLine) {
  BlockParser p;
  syntax::Block b;
  ParseError e;
  const std::string line = "/N12 (\xE9) G 01 X- 5 (end)";
  ASSERT_TRUE(p.parse(line, b, e)) << e.message;
  EXPECT_TRUE(b.plain);
  EXPECT_EQ(b.skip_mask, 1);
  EXPECT_EQ(b.skip_pos, (WordPos{1, 1}));
  EXPECT_EQ(b.number_pos, (WordPos{2, 3}));
  ASSERT_EQ(b.words.size(), 2U);
  EXPECT_EQ(b.words[0].pos, (WordPos{10, 4}));
  EXPECT_EQ(b.words[0].number_text, "01");
  EXPECT_EQ(b.words[1].pos, (WordPos{15, 4}));
  EXPECT_EQ(b.words[1].number, -5);
  ASSERT_EQ(b.comments.size(), 2U);
  EXPECT_EQ(b.comments[0].text, "\xE9");
  EXPECT_EQ(b.comments[1].pos, (WordPos{20, 5}));
}

TEST(NumParse, Comments) {  // 2.3: anywhere, never group, end at the first )
  EXPECT_EQ(parse("     (X)E60001= 0"), "ASSIGN<E60001,0> (X)");
  EXPECT_EQ(parse("L0= 80(m/mn) L1= 6"), "ASSIGN<L0,80> ASSIGN<L1,6> (m/mn)");
  EXPECT_EQ(parse("X(to)5"), "X=5 (to)");
  EXPECT_EQ(parse("N2 (only)"), "N2 (only)");
  EXPECT_EQ(parse("(a (b) c)"), "error 9: `)` means nothing here");
  EXPECT_EQ(parse("G1 (open X5"), "error 4: the comment that begins here is not closed by `)`");
  EXPECT_EQ(parse("L1=2*(3+4)"), "error 10: the block ends too early");
}

TEST(NumParse, MessageTakesTheRestOfTheLine) {  // 2.3, 18
  EXPECT_EQ(parse("N9980 $ TOOL-1 (T1) SHORT !!"), "N9980 MSG<' TOOL-1 (T1) SHORT !!'>");
  EXPECT_EQ(parse("$"), "MSG<>");
  EXPECT_EQ(parse("M0 $LOAD"), "M=0 MSG<'LOAD'>");
  EXPECT_EQ(parse("(no $ message)"), "(no $ message)");
  EXPECT_EQ(parse("L10=$0 PARTS"), "INPUT<L10'0 PARTS'>");
}

TEST(NumParse, ProgramHeader) {  // 2.3, 2.5
  EXPECT_EQ(parse("%28(pgm.txt)"), "%<28> (pgm.txt)");
  EXPECT_EQ(parse("%99 (a) (b)"), "%<99> (a) (b)");
  EXPECT_EQ(parse("%12.2"), "%<12.2>");
  EXPECT_EQ(parse("%"), "%<>");
  EXPECT_EQ(parse("N10 %5"), "error 5: a program header stands alone in its line");
}

TEST(NumParse, TwoLetterAddressesAndParameters) {  // 2.2
  EXPECT_EQ(parse("G151 EA0 EC0 EU0"), "G=151 EA=0 EC=0 EU=0");
  EXPECT_EQ(parse("G6 NU1"), "G=6 NU=1");
  EXPECT_EQ(parse("G0 G52 ZE72003"), "G=0 G=52 Z=E72003");
  EXPECT_EQ(parse("E80000=5"), "ASSIGN<E80000,5>");
  EXPECT_EQ(parse("E+"), "E=+?");
  EXPECT_EQ(parse("X L1 EA5"), "X=L1 EA=5");
}

TEST(NumParse, SignsWithoutValue) {  // 8.5, 9.2, 13.4
  EXPECT_EQ(parse("G16 P+"), "G=16 P=+?");
  EXPECT_EQ(parse("G51 X- Y+"), "G=51 X=-? Y=+?");
  EXPECT_EQ(parse("G76+ H12"), "G=76+? H=12");
  EXPECT_EQ(parse("EM- X-50 EM+ X50"), "EM=-? X=-50 EM=+? X=50");
}

TEST(NumParse, LetterOForZero) {  // section 1, num_lenient_letter_O
  EXPECT_EQ(parse("GO Z 1"), "G=O Z=1");
  EXPECT_EQ(parse("XO"), "error 2: `O` is a letter and no address; was the digit 0 meant?");
}

TEST(NumParse, ExpressionsRunLeftToRight) {  // 15
  EXPECT_EQ(parse("L1=2+3*5"), "ASSIGN<L1,((2+3)*5)>");
  EXPECT_EQ(parse("L1=L11+L14*C L10"), "ASSIGN<L1,((L11+L14)*C{L10})>");
  EXPECT_EQ(parse("L16=-L13-L15*S L10+L16-L14"), "ASSIGN<L16,(((((-L13)-L15)*S{L10})+L16)-L14)>");
  EXPECT_EQ(parse("L4=T L4"), "ASSIGN<L4,T{L4}>");
  EXPECT_EQ(parse("L1=Sl2"), "ASSIGN<L1,S{L2}>");
  EXPECT_EQ(parse("L1=T S L2"), "ASSIGN<L1,T{S{L2}}>");
  EXPECT_EQ(parse("L1=L2&255!3"), "ASSIGN<L1,((L2&255)!3)>");
  EXPECT_EQ(parse("[LEN]=E50001/1000"), "ASSIGN<[LEN],(E50001/1000)>");
  EXPECT_EQ(parse("L1=2*-3").substr(0, 5), "error");
}

TEST(NumParse, FunctionLetterAfterAPrimaryIsAWord) {  // 15
  EXPECT_EQ(parse("L5=L2*S L3 S L4"), "ASSIGN<L5,(L2*S{L3})> S=L4");
  EXPECT_EQ(parse("L1=5 S1000 T2"), "ASSIGN<L1,5> S=1000 T=2");
  EXPECT_EQ(parse("S L5 F L6"), "S=L5 F=L6");
  EXPECT_EQ(parse("X S500"), "X=? S=500");
  EXPECT_EQ(parse("A30 C-40 R5"), "A=30 C=-40 R=5");
}

TEST(NumParse, ComputedWords) {  // 14.2
  EXPECT_EQ(parse("XL1 Y-L10 Z+[H]"), "X=L1 Y=(-L10) Z=(+[H])");
  EXPECT_EQ(parse("X L16 Y L12"), "X=L16 Y=L12");
  EXPECT_EQ(parse("X10+5*L1"), "X=((10+5)*L1)");
  EXPECT_EQ(parse("X--5").substr(0, 5), "error");
}

TEST(NumParse, SeveralAssignmentsInABlock) {  // 4.1
  EXPECT_EQ(parse("N2 L0=80 L1=30 L2=0.1 L3=5 G0 X L0"),
            "N2 ASSIGN<L0,80> ASSIGN<L1,30> ASSIGN<L2,0.1> ASSIGN<L3,5> G=0 X=L0");
  EXPECT_EQ(parse("G0 X5 L1=L1+1"), "G=0 X=5 ASSIGN<L1,(L1+1)>");
}

TEST(NumParse, BareWordBeforeAnAssignmentIsRefused) {
  EXPECT_EQ(parse("G52 Z L1=5"),
            "error 5: `Z` has no value and an assignment follows it: whether `L1=5` is its value or a statement can't "
            "be told");
  EXPECT_EQ(parse("G L1=5").substr(0, 7), "error 1");
  EXPECT_EQ(parse("L5").substr(0, 5), "error");
}

TEST(NumParse, Jumps) {  // 13.1
  EXPECT_EQ(parse("G79 N100"), "G=79 N=100");
  EXPECT_EQ(parse("G79 L1<5 N100"), "G=79 TEST<(L1<5)> N=100");
  EXPECT_EQ(parse("G79 L1< >5 N100"), "G=79 TEST<(L1<>5)> N=100");
  EXPECT_EQ(parse("G79L1=2N10"), "G=79 TEST<(L1=2)> N=10");
  EXPECT_EQ(parse("G79 [TOOL_L]< 30 N9980 (SHORT)"), "G=79 TEST<([TOOL_L]<30)> N=9980 (SHORT)");
  EXPECT_EQ(parse("G79 L4=10*L3/6>4 N210"), "G=79 TEST<ASSIGN<L4,((10*L3)/6)>;(L4>4)> N=210");
  EXPECT_EQ(parse("L1=L1+1 G79 L1+2<=L2 N L5"), "ASSIGN<L1,(L1+1)> G=79 TEST<((L1+2)<=L2)> N=L5");
  EXPECT_EQ(parse("G1 X50 G10 E10000=1 N30"), "G=1 X=50 G=10 TEST<(E10000=1)> N=30");
  EXPECT_EQ(parse("G1 X50 G10 N30"), "G=1 X=50 G=10 N=30");
}

TEST(NumParse, Calls) {  // 13.2
  EXPECT_EQ(parse("G77 H9003 N1 N9999"), "G=77 H=9003 N=1 N=9999");
  EXPECT_EQ(parse("N5 G77 N2 N3 S4"), "N5 G=77 N=2 N=3 S=4");
  EXPECT_EQ(parse("G64 N900 N800 I0.8 P2"), "G=64 N=900 N=800 I=0.8 P=2");
}

TEST(NumParse, Symbols) {  // 14.4
  EXPECT_EQ(parse("[TAB(3,L2+1)]=5"), "ASSIGN<[TAB](3,(L2+1)),5>");
  EXPECT_EQ(parse("[TAB(10)]"), "DECL<[TAB](10)>");
  EXPECT_EQ(parse("L1=[.IRX(1)]"), "ASSIGN<L1,[.IRX](1)>");
  EXPECT_EQ(parse("[A]=1 [b]=[A]"), "ASSIGN<[A],1> ASSIGN<[B],[A]>");
  EXPECT_EQ(parse("L1='EA"), "ASSIGN<L1,'EA>");
}

TEST(NumParse, StructuredStatements) {  // 13.9
  EXPECT_EQ(parse("IF L1=5 THEN"), "IF<(L1=5)>");
  EXPECT_EQ(parse("N5 IFL1>2ANDL2<=3ORL3=1THEN"), "N5 IF<(((L1>2)AND(L2<=3))OR(L3=1))>");
  EXPECT_EQ(parse("while [I]<10 do"), "WHILE<([I]<10)>");
  EXPECT_EQ(parse("FOR L1=1 TO L2*2 DO"), "FOR<L1,1,(L2*2),_'TO'>");
  EXPECT_EQ(parse("FOR L1=10 DOWNTO 1 BY 3 DO"), "FOR<L1,10,1,3'DOWNTO'>");
  EXPECT_EQ(parse("UNTIL L1>=4"), "UNTIL<(L1>=4)>");
  for (const char* k : {"ELSE", "ENDI", "ENDW", "REPEAT", "ENDF", "EXIT", "VAR", "ENDV", "THEN", "DO"}) {
    EXPECT_EQ(parse(std::string("N7 ") + k + " (x)"), std::string("N7 ") + k + "<> (x)");
  }
  EXPECT_EQ(parse("PUSH L1 - L5"), "CARRIED<'PUSH L1 - L5'>");
}

TEST(NumParse, KeywordsAreWordsOnA7xx) {  // 1, 13.9
  EXPECT_EQ(parse("IF", false), "I=? F=?");
  EXPECT_EQ(parse("IF100", true), "I=? F=100");
  EXPECT_EQ(parse("G2 X5 IF100", true), "G=2 X=5 I=? F=100");
  EXPECT_EQ(parse("B Y5", true), "B=? Y=5");
  EXPECT_EQ(parse("BY5", true), "B=? Y=5");
  EXPECT_EQ(parse("SI", true), "S=? I=?");
}

TEST(NumParse, GarbageIsReportedAndTheParserGoesOn) {
  BlockParser p;
  syntax::Block b;
  ParseError e;
  EXPECT_FALSE(p.parse("G1 X5 #Y3", b, e));
  EXPECT_EQ(e.pos.column, 7U);
  EXPECT_FALSE(p.parse(std::string_view("G1 \0X", 5), b, e));
  EXPECT_EQ(e.pos.column, 4U);
  EXPECT_FALSE(p.parse("5 X3", b, e));
  EXPECT_EQ(e.message, "the number `5` has no address before it");
  EXPECT_TRUE(p.parse("G1 X5", b, e));
  EXPECT_EQ(b.words.size(), 2U);
  EXPECT_FALSE(p.parse(std::string(300000, '('), b, e));
  EXPECT_EQ(e.pos.column, 1025U);
  std::string nested = "L1=";
  for (int i = 0; i < 500; ++i) nested += "S ";
  EXPECT_TRUE(p.parse(nested + "1", b, e)) << e.message;
  EXPECT_FALSE(p.parse(std::string(1000, '['), b, e));
}

TEST(NumParse, CorpusLines) {
  const std::filesystem::path root = std::filesystem::path(CNCTRANS_SOURCE_DIR) / "../shared/corpus/num";
  if (!std::filesystem::exists(root)) GTEST_SKIP() << "no corpus beside the sources";
  BlockParser p;
  for (const auto& entry : std::filesystem::directory_iterator(root)) {
    std::ifstream in(entry.path(), std::ios::binary);
    std::string line;
    int number = 0;
    while (std::getline(in, line)) {
      ++number;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      syntax::Block b;
      ParseError e;
      EXPECT_TRUE(p.parse(line, b, e)) << entry.path() << ":" << number << ":" << e.pos.column << ": " << e.message
                                       << "\n"
                                       << line;
    }
    EXPECT_GT(number, 100);
  }
}

}  // namespace
