// Jumps, structures, repeated parts, calls, cycles, files -> IR. Sections are those of the language reference.
#include <gtest/gtest.h>

#include "dialects/options.h"
#include "tests/frontend_sinumerik/show.h"

namespace {

using namespace cnctrans;
using namespace cnctrans::sinumerik;
using cnctrans::sinumerik::testing::body;
using cnctrans::sinumerik::testing::read;

template <class Node>
const Node& at(const ir::Program& p, std::size_t i, std::size_t routine = 0) {
  return std::get<Node>(p.routines.at(routine).body.at(i).node);
}

TEST(SinumerikFlow, JumpsSearchInTheirDirection) {  // 6
  auto r = read("GOTOF AA\nGOTOB N0100\nGOTO BB\nGOTOC 20\nIF R1>0 GOTOF AA IF R1<0 GOTOB BB\nGOTOF \"N\"<<R1\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_EQ(at<ir::Jump>(r.program, 0).search, ir::Search::forward);
  EXPECT_EQ(at<ir::Jump>(r.program, 0).target.text, "AA");
  EXPECT_EQ(at<ir::Jump>(r.program, 1).search, ir::Search::backward);
  EXPECT_EQ(at<ir::Jump>(r.program, 1).target.text, "100");
  EXPECT_TRUE(at<ir::Jump>(r.program, 1).target.is_number);
  EXPECT_EQ(at<ir::Jump>(r.program, 2).search, ir::Search::forward_then_backward);
  EXPECT_TRUE(at<ir::Jump>(r.program, 3).quiet);
  EXPECT_NE(at<ir::Jump>(r.program, 4).condition, nullptr);
  EXPECT_TRUE(r.program.routines[0].body[5].line.joined);
  EXPECT_NE(at<ir::Jump>(r.program, 6).target.computed, nullptr);
}

TEST(SinumerikFlow, StringVariablesAreComputedTargets) {  // 6
  auto r = read("DEF STRING[10] WHERE=\"AA\"\nGOTOF WHERE\nAA: M30\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_NE(at<ir::Jump>(r.program, 1).target.computed, nullptr);
}

TEST(SinumerikFlow, Case) {  // 6
  auto r = read("CASE(R1) OF 7 GOTOF AA 9 GOTOB BB DEFAULT GOTOF CC\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_EQ(at<ir::Switch>(r.program, 0).cases.size(), 2U);
  EXPECT_EQ(at<ir::Switch>(r.program, 0).fallback.at(0).target.text, "CC");
}

TEST(SinumerikFlow, StructuresNest) {  // 7
  auto r = read(
      "WHILE R1<5\n IF R1==2\n  R2=1\n ELSE\n  R2=2\n ENDIF\nENDWHILE\nFOR R3=1 TO "
      "4\nX1\nENDFOR\nREPEAT\nR1=R1-1\nUNTIL R1==0\n"
      "LOOP\nGOTOF OUT\nENDLOOP\nOUT: M30\n");
  EXPECT_EQ(r.errors(), "");
  const auto& inner = std::get<ir::If>(at<ir::While>(r.program, 0).body.at(0).node);
  EXPECT_TRUE(inner.has_else);
  EXPECT_EQ(inner.else_body.size(), 1U);
  EXPECT_EQ(at<ir::For>(r.program, 1).step, nullptr);
  EXPECT_NE(at<ir::Until>(r.program, 2).condition, nullptr);
  EXPECT_EQ(at<ir::Loop>(r.program, 3).body.size(), 1U);
}

TEST(SinumerikFlow, BadNestingIsReported) {
  EXPECT_EQ(read("ENDIF\n").errors(), "");
  EXPECT_EQ(read("ENDIF\n").warnings(), "SIN-010");
  EXPECT_EQ(read("WHILE R1<5\nENDFOR\nENDWHILE\n").errors(), "SIN-010");
  EXPECT_EQ(read("IF R1<5\n").errors(), "SIN-010");
  EXPECT_EQ(read("/IF R1<5\nENDIF\n").errors(), "SIN-016");  // 1.4: structures can't be skipped
  EXPECT_EQ(read("UNTIL R1<5\n").errors(), "SIN-010");
}

TEST(SinumerikFlow, RepeatedParts) {  // 7.3
  auto r = read("AA: X1\nBB: X2\nREPEAT AA BB P=3\nREPEATB AA\nREPEAT BB\nENDLABEL: X5\nREPEAT BB P=R1\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_EQ(at<ir::Repeat>(r.program, 2).last.text, "BB");
  EXPECT_EQ(at<ir::Repeat>(r.program, 2).search, ir::Search::backward);
  EXPECT_EQ(at<ir::Repeat>(r.program, 3).last.text, "AA");
  EXPECT_EQ(at<ir::Repeat>(r.program, 3).count, nullptr);  // once more
  EXPECT_EQ(at<ir::Repeat>(r.program, 4).last.text, "");   // no end mark: up to the REPEAT itself
  EXPECT_EQ(at<ir::Repeat>(r.program, 6).last.text, "ENDLABEL");
}

TEST(SinumerikFlow, Calls) {  // 8.4
  auto r = read(
      "L0123 P2\nSUB(1,,R2)\nTOOL_X\nCALL \"/_N_WKS_DIR/_N_PART_SPF\"\nCALL \"L\"<<R10\nEXTCALL(\"OUTER.MPF\")\nMCALL "
      "SUB(5)\nMCALL\nR1=2 L5\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_EQ(at<ir::CallRoutine>(r.program, 0).routine.text, "L0123");  // leading zeros make another program
  EXPECT_EQ(at<ir::CallRoutine>(r.program, 0).routine.number, 123);
  EXPECT_NE(at<ir::CallRoutine>(r.program, 0).count, nullptr);
  EXPECT_EQ(at<ir::CallRoutine>(r.program, 1).arguments.size(), 3U);
  EXPECT_EQ(at<ir::CallRoutine>(r.program, 1).arguments[1].value, nullptr);
  EXPECT_EQ(at<ir::CallRoutine>(r.program, 2).routine.text, "TOOL_X");
  EXPECT_EQ(at<ir::CallRoutine>(r.program, 3).routine.text, "PART");
  EXPECT_NE(at<ir::CallRoutine>(r.program, 4).computed, nullptr);
  EXPECT_EQ(at<ir::CallRoutine>(r.program, 5).routine.text, "OUTER");
  EXPECT_EQ(at<ir::ModalCall>(r.program, 6).call.routine.text, "SUB");
  EXPECT_TRUE(at<ir::ModalCall>(r.program, 7).off);
  EXPECT_TRUE(std::holds_alternative<ir::CallRoutine>(r.program.routines[0].body[9].node));
  EXPECT_EQ(read("X10 P2\n").errors(), "SIN-003");
}

TEST(SinumerikFlow, Procedures) {  // 8.2
  auto r = read("PROC SUB(INT N_R, VAR REAL RES, REAL K_F=1.5) SAVE DISPLOF\nRES=N_R*K_F\nM17\n", "sinumerik-mill",
                "SUB.SPF");
  EXPECT_EQ(r.errors(), "");
  const auto& routine = r.program.routines.at(0);
  EXPECT_EQ(routine.kind, ir::RoutineKind::sub);
  EXPECT_TRUE(routine.saves_modals);
  EXPECT_EQ(routine.header_text, "DISPLOF");
  EXPECT_TRUE(routine.parameters.at(1).by_reference);
  EXPECT_NE(routine.parameters.at(2).default_value, nullptr);
  EXPECT_EQ(routine.parameters.at(0).type, ir::Type::integer);
}

TEST(SinumerikFlow, ArchivesHoldSeveralPrograms) {  // 1.2
  auto r = read("%_N_MAIN_MPF\n;$PATH=/_N_MPF_DIR\nL7\nM30\n%_N_L7_SPF\nX10\nM17\n");
  EXPECT_EQ(r.errors(), "");
  ASSERT_EQ(r.program.routines.size(), 2U);
  EXPECT_EQ(r.program.routines[0].name.text, "MAIN");
  EXPECT_EQ(r.program.routines[0].kind, ir::RoutineKind::main);
  EXPECT_EQ(r.program.routines[1].name.text, "L7");
  EXPECT_EQ(r.program.routines[1].name.number, 7);
  EXPECT_EQ(r.program.routines[1].kind, ir::RoutineKind::sub);
  EXPECT_TRUE(r.program.files.at(0).archive);
}

const ir::HoleCycle& hole(const ir::Program& p, std::size_t i) {
  return std::get<ir::HoleCycle>(std::get<ir::CycleDefine>(at<ir::Block>(p, i).actions.at(0).data).cycle->node);
}

TEST(SinumerikCycles, Levels) {  // 18, 18.1
  auto r = read(
      "CYCLE81(50,0,2,-20)\nCYCLE82(50,5,2,,15,1.5)\nCYCLE81(-50,0,2,20)\nCYCLE82(50,0,2,-20,,-3)\nCYCLE81(50,0,2,-20,"
      "15)\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_EQ(hole(r.program, 0).retract.value.number, 50);
  EXPECT_EQ(hole(r.program, 0).surface.value.number, 0);
  EXPECT_EQ(hole(r.program, 0).reference.base, ir::LevelBase::from_surface);
  EXPECT_EQ(hole(r.program, 0).reference.value.number, 2);
  EXPECT_EQ(hole(r.program, 0).bottom.value.number, -20);
  EXPECT_EQ(hole(r.program, 1).bottom.value.number, -15);  // relative to the reference plane, toward the material
  EXPECT_EQ(hole(r.program, 1).bottom.base, ir::LevelBase::from_surface);
  EXPECT_EQ(hole(r.program, 1).dwell_bottom.number, 1.5);
  EXPECT_EQ(hole(r.program, 2).reference.value.number, -2);  // retract plane below: everything the other way round
  EXPECT_TRUE(hole(r.program, 3).dwell_in_revolutions);      // a negative dwell is revolutions
  EXPECT_EQ(hole(r.program, 3).dwell_bottom.number, 3);
  EXPECT_EQ(hole(r.program, 4).bottom.value.number, -15);  // both given: DPR wins, with a warning
  EXPECT_EQ(r.warnings(), "SIN-021");
}

TEST(SinumerikCycles, Pecks) {  // 18.1.1
  auto r = read(
      "CYCLE83(50,0,2,-30,,-10,,2,0.5,0.2,0.8,1)\nCYCLE83(50,0,2,-30,,,8,0,0,0,1,0,3,,0.5)\nCYCLE83(50,0,2,-30,,,8,-0."
      "8,0,0,1,0)\n");
  EXPECT_EQ(r.errors(), "");
  const auto& full = hole(r.program, 0);
  EXPECT_EQ(full.kind, ir::HoleKind::peck_full);
  EXPECT_EQ(full.pecks.first_to.value.number, -10);
  EXPECT_TRUE(full.pecks.first_from_surface);
  EXPECT_EQ(full.pecks.law, ir::PeckLaw::arithmetic);
  EXPECT_EQ(full.pecks.degression.number, 2);
  EXPECT_EQ(full.pecks.first_feed_factor.number, 0.8);
  EXPECT_EQ(full.dwell_top.number, 0.2);
  EXPECT_TRUE(full.pecks.reapproach_automatic);
  const auto& broken = hole(r.program, 1);
  EXPECT_EQ(broken.kind, ir::HoleKind::peck_break);
  EXPECT_EQ(broken.pecks.law, ir::PeckLaw::balanced);
  EXPECT_EQ(broken.pecks.first.number, 8);
  EXPECT_EQ(broken.pecks.lift.number, 0.5);
  EXPECT_EQ(broken.axis, ir::axis::z);
  EXPECT_EQ(hole(r.program, 2).pecks.law, ir::PeckLaw::geometric);
  EXPECT_EQ(hole(r.program, 2).pecks.degression.number, 0.8);
  EXPECT_EQ(hole(r.program, 2).pecks.lift.number, 1);  // VRT omitted: 1 mm
}

TEST(SinumerikCycles, WhatIsNotCarriedIsRefused) {
  EXPECT_EQ(read("CYCLE84(50,0,2,-20,,,3,,1.25,0,500)\n").warnings(), "");
  EXPECT_EQ(read("MCALL POCKET3(50,0,1,-5,60,40,8,0,0,0,2,0,0,300,100,2,11)\n").warnings(), "SIN-008");
  EXPECT_EQ(read("CYCLE83(50,0,2,-30,,,8,0,0,0,1,7)\n").errors(), "SIN-021");
  EXPECT_EQ(read("CYCLE81()\n").errors(), "SIN-021");
  EXPECT_EQ(read("ID=1 DO R1=8\n").warnings(), "SIN-008");
  EXPECT_EQ(read("TRAORI\n").warnings(), "SIN-041");
}

TEST(SinumerikFiles, NothingOfALineIsLost) {
  auto r = read("; head\n\n\nN10 G0 X1 ; first\n/2 N20 LAB: Y2\n\n\x1A\n");
  EXPECT_EQ(r.errors(), "");
  const auto& b = r.program.routines[0].body;
  ASSERT_EQ(b.size(), 4U);
  EXPECT_EQ(b[0].line.comments.at(0).text, " head");
  EXPECT_EQ(b[0].line.comments.at(0).place, ir::CommentPlace::own_line);
  EXPECT_EQ(b[1].line.blank_lines_before, 2);
  EXPECT_EQ(b[1].line.number, "10");
  EXPECT_EQ(b[1].line.comments.at(0).place, ir::CommentPlace::end_of_line);
  EXPECT_EQ(b[2].line.skip_mask, 4);
  EXPECT_EQ(b[2].line.labels.at(0), "LAB");
  EXPECT_EQ(r.program.files[0].trailer, "\x1A");
}

TEST(SinumerikFiles, AFaultyBlockDoesNotStopTheReading) {
  auto r = read("G0 X1\nN20 G1 X-R1 ; oops\nG0 X2\n");
  EXPECT_EQ(r.errors(), "SIN-001");
  const auto& b = r.program.routines[0].body;
  ASSERT_EQ(b.size(), 3U);
  EXPECT_EQ(std::get<ir::Opaque>(b[1].node).text, "G1 X-R1");
  EXPECT_EQ(std::get<ir::Opaque>(b[1].node).feature, "text.unread");
  EXPECT_EQ(b[1].line.number, "20");
  EXPECT_EQ(b[1].line.comments.at(0).text, " oops");
  EXPECT_EQ(r.diagnostics.all()[0].span.line, 2U);
  EXPECT_EQ(r.diagnostics.all()[0].span.column, 10U);
}

TEST(SinumerikStreams, PlainBlocksFlowAndTheRestAsksForTheProgram) {
  std::string error;
  const auto profile = dialects::load_profile("sinumerik-mill", &error);
  const frontends::ReadOptions options{frontends::Reader::scanner, &*profile};
  const auto stream = frontends::sinumerik::make_frontend()->stream(1, options, "dir/PART.MPF");
  EXPECT_EQ(stream->frame().routines.at(0).name.text, "PART");
  ir::Statement out;
  Diagnostics diagnostics;
  const auto take = [&](std::string_view text) { return stream->read(SourceLine{text, 1}, out, diagnostics); };
  using frontends::StreamLine;
  EXPECT_EQ(take("N10 G1 X1 Y2 F100 ;c"), StreamLine::statement);
  EXPECT_EQ(std::get<ir::Block>(out.node).motion.coords.size(), 2U);
  EXPECT_EQ(take(""), StreamLine::statement);
  EXPECT_TRUE(std::get<ir::Block>(out.node).empty());
  EXPECT_EQ(take("G2 X5 CR=3"), StreamLine::statement);
  EXPECT_EQ(take("X=R1"), StreamLine::needs_program);
  EXPECT_EQ(take("R1=5"), StreamLine::needs_program);
  EXPECT_EQ(take("IF R1"), StreamLine::needs_program);
  EXPECT_EQ(take("L5"), StreamLine::needs_program);
  EXPECT_EQ(take("SUB1_X"), StreamLine::needs_program);
  EXPECT_EQ(take("M30"), StreamLine::program_end);
}

}  // namespace
