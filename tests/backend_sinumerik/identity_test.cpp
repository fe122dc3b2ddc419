// Text in the control's own language, read and written again, is the same text when it is canonical (README of the
// writer).
#include "dialects/options.h"
#include "frontends/sinumerik/program/frontend.h"
#include "tests/backend_sinumerik/build.h"

namespace cnctrans::test {
namespace {

struct Rewritten {
  std::vector<backends::OutputFile> files;
  Diagnostics diagnostics;
  machine::Profile profile;
};

Rewritten rewrite(const std::string& text, const std::string& machine = "sinumerik-mill",
                  const std::string& name = "PART.MPF") {
  Rewritten r;
  std::string error;
  r.profile = *dialects::load_profile(machine, &error);
  frontends::ReadOptions read;
  read.profile = &r.profile;
  const auto source = SourceText::from_string(name, text);
  const ir::Program program = frontends::sinumerik::make_frontend()->read(source, 1, read, r.diagnostics, nullptr);
  backends::WriteOptions write;
  write.profile = &r.profile;
  write.main_stem = source->stem();
  r.files = backends::sinumerik::make_backend()->write(program, write, r.diagnostics);
  return r;
}

void expect_same(const std::string& text, const std::string& machine = "sinumerik-mill") {
  const Rewritten r = rewrite(text, machine);
  ASSERT_EQ(r.files.size(), 1U);
  EXPECT_EQ(r.files[0].text, text);
  for (const Diagnostic& d : r.diagnostics.all()) EXPECT_NE(d.severity, Severity::error) << d.code << " " << d.message;
}

TEST(SinumerikIdentity, PlainWords) {
  expect_same(
      "; PLATE\n"
      "G17 G40 G64 G710 G90 G94\n"
      "G54\n"
      "T4\n"
      "M6\n"
      "D1 S1800 M03 F220.50\n"
      "\n"
      "N10 G00 X10.500 Y-.5  ; start\n"
      "/1 N20 G1 Z-3 F150\n"
      "X20 G2 I5 J0\n"
      "G3 X30 CR=-7.25\n"
      "G2 X10 Y10 I=AC(5) J=AC(R1) TURN=2\n"
      "X=IC(5) Y=AC(R2*3)\n"
      "B=ACP(90) G0\n"
      "SUPA G0 Z0 D0\n"
      "G53 X0\n"
      "G9 G1 X5 RND=2\n"
      "G4 F2.5\n"
      "G4 S3\n"
      "M5 M9\n"
      "M77 H5=3\n"
      "M30\n");
}

TEST(SinumerikIdentity, Lathe) {
  expect_same(
      "G18 G40 G64 G710 G90 G95 DIAMON\n"
      "LIMS=2500\n"
      "T1 D1\n"
      "G96 S180 F0.25 M3\n"
      "G0 X90 Z5\n"
      "G42 G1 X40 Z0\n"
      "G33 Z-30 K1.5 SF=90\n"
      "G97 S800\n"
      "G40 G0 X=DIC(10)\n"
      "M30\n",
      "sinumerik-lathe");
}

TEST(SinumerikIdentity, StatementsAndStructures) {
  expect_same(
      "DEF INT NN=3,MM\n"
      "DEF REAL ALPHA\n"
      "DEF STRING[20] TEXT\n"
      "R1=0 R2=-R1*2\n"
      "ALPHA=(R1+R2)*SIN(30)/2.50\n"
      "R[NN+1]=POT(R1)-ATAN2(R1,R2)\n"
      "FOR NN=1 TO R1-1\n"
      "  IF (R1==1) AND (R2>0)\n"
      "    G1 X=NN*20\n"
      "  ELSE\n"
      "    MSG(\"R1 = \"<<R1<<\" mm\")\n"
      "  ENDIF\n"
      "ENDFOR\n"
      "WHILE R1<3\n"
      "  R1=R1+1\n"
      "ENDWHILE\n"
      "REPEAT\n"
      "  R1=R1-1\n"
      "UNTIL R1<=0\n"
      "LAB_A: R3=NN MOD 2\n"
      "IF R3==1 GOTOF N100\n"
      "LAB_B: G1 X5\n"
      "REPEAT LAB_A LAB_B P=3\n"
      "REPEATB LAB_B\n"
      "CASE(NN) OF 1 GOTOF N100 2 GOTOB LAB_A DEFAULT GOTOF N100\n"
      "GOTO \"N\"<<NN\n"
      "N100 MSG()\n"
      "L5 P3\n"
      "BOSS(R2,,-15)\n"
      "TRANS X100 Y=R1\n"
      "AROT RPL=45\n"
      "ASCALE X2 Y2\n"
      "AMIRROR X0\n"
      "ROT\n"
      "STOPRE\n"
      "CYCLE81(50,0,2,-20)\n"
      "MCALL CYCLE82(50,0,2,-20,,0.5)\n"
      "X10\n"
      "MCALL\n"
      "CYCLE83(20,0,2,-15,,-5,,0,0,0,1,1)\n"
      "SETAL(65010,\"STOP\")\n"
      "M30\n");
}

TEST(SinumerikIdentity, ASubprogram) {
  const std::string text =
      "PROC BOSS(REAL RAD,VAR INT N) SAVE DISPLOF\n"
      "DEF REAL ZD=0\n"
      "G0 X=RAD\n"
      "IF N>3\n"
      "  RET\n"
      "ENDIF\n"
      "N=N+1\n"
      "M17\n";
  const Rewritten r = rewrite(text, "sinumerik-mill", "BOSS.SPF");
  ASSERT_EQ(r.files.size(), 1U);
  EXPECT_EQ(r.files[0].name, "BOSS.SPF");
  EXPECT_EQ(r.files[0].text, text);
}

TEST(SinumerikIdentity, WhatIsKeptAsTextStays) {
  expect_same(
      "G601 SOFT\n"
      "G1 X10 ADIS=0.5 F100\n"
      "WORKPIECE(,\"\",,\"BOX\",0,10,-10,-80,0,0,100,100)\n"
      "M30\n");
}

}  // namespace
}  // namespace cnctrans::test
