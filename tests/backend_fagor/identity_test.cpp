// Fagor text read and written again is the same text.
#include "tests/backend_fagor/build.h"

namespace cnctrans::test {
namespace {

void same(const std::string& text, const std::string& machine = "fagor-mill") {
  const Rewrite r = rewrite(text, machine, machine == "fagor-mill" ? "000100.PIM" : "000100.PIT");
  EXPECT_EQ(r.text, text);
  EXPECT_EQ(r.codes, "");
}

TEST(FagorIdentity, FrameOfTheFile) {
  same("%BRACKET 7 ,MX,\n;first side\nG17 G40 G05 G71 G90 G94\nG0 X0 Y0\nM30\n");
  same("G0 X1\nM02\n");  // a program without header
  same("% ,OMX,\nM30\n");
  EXPECT_EQ(rewrite("G0 X1\nM30\n").file, "000100.PIM");
  EXPECT_EQ(rewrite("G0 X1\nM30\n", "fagor-lathe", "7.PIT").file, "000007.PIT");
}

TEST(FagorIdentity, SpellingOfWords) {
  same("N0010 G01 X10.500 Y-.5 F0200 S0800 T05 D05 M06\n/2 N20 G1 X.0 M03\nX20. Y5 M8\n/N30 G0 Z100 M30\n");
  same("G02 X10 Y10 I5 J0\nG3 X0 Y0 R10\nG6 G2 X1 Y2 I3 J4\nG2 X10 Y0 R-25\n");
  same("G90 G1 XP100 Y-P3 FP7\n");
}

TEST(FagorIdentity, CommentsLabelsAndEmptyLines) {
  same(";\n; two blanks  inside \nN5 ;only a label\nN6 ;\nG1 X5 ;end\n");
  EXPECT_EQ(rewrite("G1 X5\n\nM30\n").text, "G1 X5\n;\nM30\n");  // an empty block is an error of the control (2.3)
}

TEST(FagorIdentity, Mill) {
  same("G43 G0 Z50\nG44\nG91 G81 G99 X10 Y5 Z-48 I-12 K30\nX10 N3\nG80\nG98 G83 X1 Y1 Z2 I-5 J4\nG80\n");
  same(
      "G54\nG158 X10 Y20\nG158\nG73 Q30\nG73 Q30 I5 J5\nG73\nG11 G12\nG10\nG14 X A\nG72 S2\nG159 N7\nG53\nG53 G0 Z0\n");
  same("G92 X5 Y6\nG54\nG93 I10 J20\nG1 R20 Q45\nG93\nG2 Q90\nG18\nG17\n");
  same("G4 K50\nG04\nG07 G1 X1\nG32 F4\nG1 G36 R5 X10\nG39 R2 Y20\nX30\nG2 X0 Y0 I5 J5 Z-10 K5\n");
  same("G1 X100 Y50 N0\n");
}

TEST(FagorIdentity, Lathe) {
  same(
      "G18 G40 G05 G71 G90 G95 G151\nG92 S2500\nT1 D1\nG96 F0.25 S180 M3\nG1 X90 Z5\nG2 X40 Z-5 I0 K-5\nG33 Z-20 "
      "L1.5\nG152\nS90 M19\nM30\n",
      "fagor-lathe");
}

TEST(FagorIdentity, Statements) {
  same(
      "(P100=P100+1)\n(P1=5, P2=P1*2)\n(P(P7)=3)\nN10 (IF P1 GE 3 GOTO N20)\n(GOTO NP100)\n(GOTO N(P1+10))\nN20 "
      ";\n(RPT N10,N20) N3\n"
      "(RPT N10,N20)\n(RPT N10,N20) NP5\n(CALL 5)\n(PCALL 5, A10, B=P101, C-18)\n(CALL P3)\nM30\n(SUB 5)\nG1 "
      "XP0\n(RET)\n");
  same(
      "(IF (P1 EQ 1) AND (P2 GT 0) P3=4, P4=5 ELSE CALL 7)\n(MSG \"depth ?P100 mm\")\n(ERROR 5, \"stop\")\n(ERROR "
      "7)\n(MSG \" \")\nM30\n(SUB 7)\n(RET)\n");
  same("(PCALL 5)\n(MCALL 5, A1)\nX5\n(MDOFF)\nM30\n;of the sub\n(SUB 5) ;name\n;inside\n(RET)\n");
}

TEST(FagorIdentity, ExpressionsWithFewestParentheses) {  // 16.4
  same(
      "(P1=-2 EXP 2)\n(P1=2 EXP 3 EXP 2)\n(P1=2 EXP (3 EXP 2))\n(P1=7 MOD "
      "4*3)\n(P1=SIN(P2)+COS(P3)*2)\n(P1=(P2+P3)*P4)\n(P1=P2-(P3-P4))\n"
      "(P1=P2*(-P3))\n(P1=ARG(P2,P3))\n(P1=P2 AND 15)\n(P1=NOT P2)\n(P1=P2 GT 3)\n(P1=-(P2+P3))\n");
}

TEST(FagorIdentity, LettersOfLocalParametersStay) {  // A = P0 (16.2)
  same(
      "(D=360/B, P4=1)\n(K=A*COS(F), L=P0*SIN(P5))\nN10 (IF E GE P1 GOTO N20)\n(PCALL 5, A=B, C=P3)\nN20 ;\nM30\n(SUB "
      "5)\n"
      "(RET)\n");
}

TEST(FagorIdentity, BlocksWithoutACodeGetNone) {
  same("N5 G81 G98 X1 Y1 Z2 I-5\nN10 X10\nG80\nN20 X5\n(IF P1 GT -20 GOTO N20)\n(GOTO N10)\n");
}

TEST(FagorIdentity, FilesOfSubroutines) {
  same("%SUBS ,MX,\n;first\n(SUB 5)\nG1 XP0\n(RET)\n;second\n(SUB 6) ;six\n(RET)\n");
  same("%PART ,MX,\n(LSUB 10)\nG1 X1\n(RET)\n%MAIN\n(CALL 10)\nM30\n");
}

}  // namespace
}  // namespace cnctrans::test
