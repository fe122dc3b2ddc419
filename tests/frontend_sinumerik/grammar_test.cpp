// The grammar of one Sinumerik block: lexical traps, expression trees, statements. Sections are those of the language
// reference.
#include <gtest/gtest.h>

#include "tests/frontend_sinumerik/show.h"

namespace {

using namespace cnctrans;
using namespace cnctrans::sinumerik;
using cnctrans::sinumerik::testing::parse;

TEST(SinumerikGrammar, WordsNeedNoBlanks) {  // 1.5, 1.8
  EXPECT_EQ(parse("G1X10"), "G1 X10");
  EXPECT_EQ(parse("T1D1M6"), "T1 D1 M6");
  EXPECT_EQ(parse("G4F1"), "G4 F1");
  EXPECT_EQ(parse("N40G4F=R1"), "N40 G4 F=R[1]");
  EXPECT_EQ(parse("g0x1.y-.5z5."), "g0 x1. y-.5 z5.");
  EXPECT_EQ(parse("X 10 Y +3"), "X10 Y+3");
  EXPECT_EQ(parse(""), "");
  EXPECT_EQ(parse("  \t"), "");
}

TEST(SinumerikGrammar, NamesStartWithTwoLetters) {  // 1.7
  EXPECT_EQ(parse("TOOL_CHANGE"), "TOOL_CHANGE");
  EXPECT_EQ(parse("L_TIME(1)"), "()<1'L_TIME'>");
  EXPECT_EQ(parse("_X=5"), "_X=5");
  EXPECT_EQ(parse("ELX=3087.02"), "ELX=3087.02");
  EXPECT_EQ(parse("X1=100"), "X'1=100");
  EXPECT_EQ(parse("X1100"), "X1100");
  EXPECT_EQ(parse("M2=3 S2=1000"), "M'2=3 S'2=1000");
  EXPECT_EQ(parse("T=\"MILL D. 20\""), "T=\"MILL D. 20\"");
}

TEST(SinumerikGrammar, EIsAnAddressAndEXAnExponent) {  // 1.6
  EXPECT_EQ(parse("X1E5"), "X1 E5");
  EXPECT_EQ(parse("R1=8.2EX-3"), "R'1=8.2EX-3");
  EXPECT_EQ(parse("X=1.5ex2"), "X=1.5ex2");
  BlockParser p;
  syntax::Block b;
  ParseError e;
  ASSERT_TRUE(p.parse_block("R1=8.2EX-3", b, e));
  EXPECT_DOUBLE_EQ(b.exprs.at(0).number, 8.2e-3);
}

TEST(SinumerikGrammar, BasedConstants) {  // 1.6
  BlockParser p;
  syntax::Block b;
  ParseError e;
  ASSERT_TRUE(p.parse_block("R1='H1F' R2='B10000'", b, e));
  EXPECT_EQ(b.exprs.at(0).number, 31);
  EXPECT_EQ(b.exprs.at(1).number, 16);
  EXPECT_EQ(parse("R1='HFFFFFFFFF'").substr(0, 2), "!4");
}

TEST(SinumerikGrammar, BlockFrame) {  // 1.4
  EXPECT_EQ(parse("/N10 G1"), "/1 N10 G1");
  EXPECT_EQ(parse("/2 N10 G1"), "/4 N10 G1");
  EXPECT_EQ(parse(":10 G1"), ":10 G1");
  EXPECT_EQ(parse("N1160 _ASUP_NR_12:"), "N1160 _ASUP_NR_12:");
  EXPECT_EQ(parse("N40 HERE: X=R1 ; note"), "N40 HERE: X=R[1] ; note");
  EXPECT_EQ(parse("N10 START :"), "N10 START:");
  EXPECT_EQ(parse("MSG(\"a;b\") ;c"), "()<\"a;b\"'MSG'> ;c");
  EXPECT_EQ(parse("%_N_SHAFT_MPF"), "%<'_N_SHAFT_MPF'>");
  EXPECT_EQ(parse("/10 G1").substr(0, 2), "!1");
}

TEST(SinumerikGrammar, SeveralAssignments) {
  EXPECT_EQ(parse("N200 R01=1 R02=0. L903"), "N200 R'1=1 R'2=0. L903");
  EXPECT_EQ(parse("R1 = 10 ;RAIO"), "R'1=10 ;RAIO");
  EXPECT_EQ(parse("X=R1*2 Y20"), "X=(R[1] * 2) Y20");
  EXPECT_EQ(parse("R[R2]=5 A[1,2]=SET(1,,3)"), "=<R[R[2]], 5> =<A[1,2], SET(1,_,3)>");
  EXPECT_EQ(parse("I=AC(3) J=IC(-R1)"), "I=AC(3) J=IC((- R[1]))");
  EXPECT_EQ(parse("POS[X]=IC(5) FA[X]=100"), "=<POS[X], IC(5)> =<FA[X], 100>");
  EXPECT_EQ(parse("$P_UIFR[1,X,TR]=-5.5"), "=<$P_UIFR[1,X,TR], (- 5.5)>");
  EXPECT_EQ(parse("PO[X]=(0,-10)"), "=<PO[X], (0,(- 10))>");
  EXPECT_EQ(parse("X=-5 Y=+.5"), "X=-5 Y=+.5");
}

TEST(SinumerikGrammar, PrioritiesOfOperators) {  // 4.1
  EXPECT_EQ(parse("R1=1+2*3-4/2"), "R'1=((1 + (2 * 3)) - (4 / 2))");
  EXPECT_EQ(parse("R1=7 MOD 4 DIV 2"), "R'1=((7 MOD 4) DIV 2)");
  EXPECT_EQ(parse("R1=-R2*3"), "R'1=((- R[2]) * 3)");
  EXPECT_EQ(parse("R1=R2 OR R3 AND R4 XOR R5"), "R'1=(R[2] OR ((R[3] AND R[4]) XOR R[5]))");
  EXPECT_EQ(parse("R1=R2 B_OR R3 B_XOR R4 B_AND R5+1"), "R'1=(R[2] B_OR (R[3] B_XOR (R[4] B_AND (R[5] + 1))))");
  // Comparisons bind weakest, and NOT binds only its operand.
  EXPECT_EQ(parse("IF R1==1 AND R2==2 GOTOF LAB"), "IF<((R[1] == (1 AND R[2])) == 2) GOTOF<LAB>>");
  EXPECT_EQ(parse("IF NOT R10==1"), "IF<((NOT R[10]) == 1)>");
  EXPECT_EQ(parse("IF \"I:\"<<R1==TXT"), "IF<((\"I:\" << R[1]) == TXT)>");
  EXPECT_EQ(parse("MSG(<<R1+1<<\" mm\")"), "()<((<< (R[1] + 1)) << \" mm\")'MSG'>");
  EXPECT_EQ(parse("$P_PFRAME=CTRANS(X,1):CROT(Z,45)"), "=<$P_PFRAME, (CTRANS(X,1) : CROT(Z,45))>");
  EXPECT_EQ(parse("X=5 DIV R1"), "X=(5 DIV R[1])");
}

TEST(SinumerikGrammar, ConditionsAndJumps) {  // 6
  EXPECT_EQ(parse("IF R1>0 GOTOB N10"), "IF<(R[1] > 0) GOTOB<N10>>");
  EXPECT_EQ(parse("IF R1>0 GOTOB LA IF R1<0 GOTOF LB"), "IF<(R[1] > 0) GOTOB<LA>> IF<(R[1] < 0) GOTOF<LB>>");
  EXPECT_EQ(parse("IF(R1<0)OR(R2==3)"), "IF<((R[1] < 0) OR (R[2] == 3))>");
  EXPECT_EQ(parse("IF (R1-R2) = 0 GOTOF LBL"), "IF<((R[1] - R[2]) = 0) GOTOF<LBL>>");
  EXPECT_EQ(parse("GOTOF \"N\"<<R10"), "GOTOF<(\"N\" << R[10])>");
  EXPECT_EQ(parse("GOTO 100"), "GOTO<100>");
  EXPECT_EQ(parse("GOTOC :20"), "GOTOC<:20>");
  EXPECT_EQ(parse("CASE(R1+1) OF 7 GOTOF AA -9 GOTOB BB DEFAULT GOTOF CC"),
            "CASE<(R[1] + 1) OF<7 GOTOF<AA>> OF<(- 9) GOTOB<BB>> DEFAULT< GOTOF<CC>>>");
}

TEST(SinumerikGrammar, Structures) {  // 7
  EXPECT_EQ(parse("N10 else"), "N10 ELSE<>");
  EXPECT_EQ(parse("FOR N=1 TO R5*2"), "FOR<N, 1, (R[5] * 2)>");
  EXPECT_EQ(parse("WHILE(R3>=R5)"), "WHILE<(R[3] >= R[5])>");
  EXPECT_EQ(parse("REPEAT"), "REPEAT<>");
  EXPECT_EQ(parse("REPEAT AA BB P=3"), "REPEAT<AA, BB, 3>");
  EXPECT_EQ(parse("REPEAT AA BB P10 ;x"), "REPEAT<AA, BB, 10> ;x");
  EXPECT_EQ(parse("REPEATB LAB P=R5"), "REPEATB<LAB, _, R[5]>");
  EXPECT_EQ(parse("UNTIL R1==5"), "UNTIL<(R[1] == 5)>");
  EXPECT_EQ(parse("ENDLABEL: X10"), "ENDLABEL: X10");
}

TEST(SinumerikGrammar, Definitions) {  // 3.3, 8.2
  EXPECT_EQ(parse("DEF REAL DEPTH=2.5, LIST[3,2]"), "DEF<REAL VAR<_, 2.5'DEPTH'> VAR<(3,2), _'LIST'>>");
  EXPECT_EQ(parse("DEF STRING [30] _A, _B"), "DEF<STRING[30] VAR<_, _'_A'> VAR<_, _'_B'>>");
  EXPECT_EQ(parse("DEF INT VAR1 VAR2"), "DEF<INT VAR<_, _'VAR1'> VAR<_, _'VAR2'>>");
  EXPECT_EQ(parse("DEF NCK APWP 3 STRING[5] NAME=\"x\""),
            "DEF<STRING[5] ATTR<'NCK'> ATTR<3'APWP'> VAR<_, \"x\"'NAME'>>");
  EXPECT_EQ(parse("PROC SUB(INT I, VAR REAL V[ ,5], STRING[10] S=\"a\") SAVE DISPLOF"),
            "PROC<SAVE, DISPLOF'SUB' PARAM<INT, _, _, _'I'> PARAM<REAL, VAR, (_,5), _'V'> "
            "PARAM<STRING[10], _, _, \"a\"'S'>>");
  EXPECT_EQ(parse("EXTERN SUB(REAL, VAR INT)"), "EXTERN<'SUB' PARAM<REAL, _, _, _> PARAM<INT, VAR, _, _>>");
  EXPECT_EQ(parse("DEFINE MX AS $A_MARKER[09];DBX"), "DEFINE<MX'$A_MARKER[09]'> ;DBX");
  EXPECT_EQ(parse("APR 7 APW 11"), "RIGHTS<'APR 7 APW 11'>");
}

TEST(SinumerikGrammar, Calls) {  // 8.4
  EXPECT_EQ(parse("L123 P2"), "L123 P2");
  EXPECT_EQ(parse("L0123"), "L0123");
  EXPECT_EQ(parse("L140(2)"), "()<2'L140'>");
  EXPECT_EQ(parse("SUB(1,,R2) P3"), "()<1, _, R[2]'SUB'> P3");
  EXPECT_EQ(parse("CYCLE800()"), "()<'CYCLE800'>");
  EXPECT_EQ(parse("WORKPIECE(,\"\",,\"BOX\",0)"), "()<_, \"\", _, \"BOX\", 0'WORKPIECE'>");
  EXPECT_EQ(parse("N2 MCALL"), "N2 MCALL<>");
  EXPECT_EQ(parse("MCALL CYCLE82(50,0,2)"), "MCALL<50, 0, 2'CYCLE82'>");
  EXPECT_EQ(parse("CALL\"_N_X_SPF\" BLOCK \"A\" TO \"B\""), "CALL<\"_N_X_SPF\", \"A\", \"B\", _>");
  EXPECT_EQ(parse("PCALL/_N_WKS_DIR/_N_S_WPD/SHAFT(1,2)"), "PCALL<1, 2'/_N_WKS_DIR/_N_S_WPD/SHAFT'>");
  EXPECT_EQ(parse("EXTCALL(\"MAIN\")"), "EXTCALL<\"MAIN\">");
}

TEST(SinumerikGrammar, SynchronisedActionsAreOneText) {  // 12
  EXPECT_EQ(parse("LBL: WHEN ($A_IN[1]==1) DO DELDTG"), "LBL: SYNC<'WHEN ($A_IN[1]==1) DO DELDTG'>");
  EXPECT_EQ(parse("IDS=59 EVERY $AC_TIMER[1]>2 DO M3 S100 R1=R1+1"),
            "SYNC<'IDS=59 EVERY $AC_TIMER[1]>2 DO M3 S100 R1=R1+1'>");
  EXPECT_EQ(parse("ID=1 DO $AA_OVR[X]=0"), "SYNC<'ID=1 DO $AA_OVR[X]=0'>");
}

TEST(SinumerikGrammar, FaultsAreFoundWhereTheyAre) {
  EXPECT_EQ(parse("G1 X-R1"), "!6 `R` is not expected here; a value that is an expression needs `=` after its address");
  EXPECT_EQ(parse("X=(R1+2").substr(0, 3), "!8 ");
  EXPECT_EQ(parse("MSG(\"open)").substr(0, 3), "!5 ");
  EXPECT_EQ(parse("G1 # X1").substr(0, 3), "!4 ");
  EXPECT_EQ(parse("R1=R2)").substr(0, 3), "!6 ");
  EXPECT_EQ(parse("IF R1==1 X5").substr(0, 4), "!10 ");
}

TEST(SinumerikGrammar, HostileLinesAreRefusedNotFatal) {
  EXPECT_EQ(parse("R1=" + std::string(4000, '(')).substr(0, 1), "!");
  EXPECT_EQ(parse("R1=" + std::string(4000, '-') + "1").substr(0, 1), "!");
  EXPECT_EQ(parse(std::string(1 << 20, 'X')).substr(0, 1), "!");
  EXPECT_EQ(parse("G1 ;" + std::string(1 << 20, 'x')).substr(0, 4), "G1 ;");
  std::string sum = "R1=1";
  for (int i = 0; i < 500; ++i) sum += "+1";
  EXPECT_EQ(parse(sum).substr(0, 3), "R'1");
  for (int i = 0; i < 3000; ++i) sum += "+1";
  EXPECT_EQ(parse(sum).substr(0, 1), "!");
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  EXPECT_EQ(parse(bytes).substr(0, 1), "!");
}

TEST(SinumerikGrammar, PlacesAreByteColumns) {
  BlockParser p;
  syntax::Block b;
  ParseError e;
  ASSERT_TRUE(p.parse_block("N10  G1 X=R1*2 ;\xC4", b, e));
  EXPECT_EQ(b.number_pos, (WordPos{1, 3}));
  EXPECT_EQ(b.words.at(0).pos, (WordPos{6, 2}));
  EXPECT_EQ(b.words.at(1).pos, (WordPos{9, 6}));
  EXPECT_EQ(b.exprs.at(0).pos, (WordPos{11, 4}));
  EXPECT_EQ(b.comments.at(0).pos, (WordPos{16, 2}));
  EXPECT_FALSE(b.plain);
}

}  // namespace
