// Statements and the frame of the file, for programs of other languages (manual ch. 1, 16 to 18).
#include "tests/backend_fagor/build.h"

namespace cnctrans::test {
namespace {

using ir::BinaryOp;
using ir::Value;
namespace axis = ir::axis;

ir::ExprPtr rel(BinaryOp o, ir::ExprPtr a, ir::ExprPtr b) {
  return op(o, std::move(a), std::move(b));
}

ir::CallRoutine call(std::int64_t number) {
  ir::CallRoutine c;
  c.routine.number = number;
  return c;
}
ir::Argument argument(std::string letter, ir::ExprPtr value) {
  ir::Argument a;
  a.name = std::move(letter);
  a.value = std::move(value);
  return a;
}
ir::Statement statement(ir::StatementNode node) {
  ir::Statement s;
  s.node = std::move(node);
  return s;
}

TEST(FagorStatements, HeaderHasTwentyCharactersWithoutComma) {  // 1.2
  Build b;
  b.program.routines[0].title = "Flansch, groß und rund, Seite 2";
  EXPECT_EQ(b.text(), "%Flansch  gross und r,MX,\nM30\n");
}

TEST(FagorStatements, FileNameIsSixDigits) {  // 1.1
  Build b;
  EXPECT_EQ(b.files()[0].name, "000100.PIM");
  b.options.main_stem = "FLANGE_12";
  EXPECT_EQ(b.files()[0].name, "000012.PIM");
  b.program.routines[0].name.number = 58;
  EXPECT_EQ(b.files()[0].name, "000058.PIM");
  Build lathe("fagor-lathe");
  lathe.options.main_stem = "COVER";
  EXPECT_EQ(lathe.files()[0].name, "000001.PIT");
}

TEST(FagorStatements, SubroutinesFollowTheEndInOrderOfTheirFirstCall) {  // 18.1: never before or inside the main part
  Build b;
  b.add(call(7));
  b.add(call(5));
  b.add(ir::End{"M2"});
  b.routine(5, "FIVE");
  b.add(ir::Return{{}, "M17"});
  b.routine(7);
  b.program.routines.back().title = "seven";
  b.add(move(ir::MotionKind::rapid, {coord(axis::x, Value(P(0)))}));
  EXPECT_EQ(b.text(), "%PART ,MX,\n(CALL 7)\n(CALL 5)\nM30\n(SUB 7) ;seven\nG0 XP0\n(RET)\n(SUB 5) ;FIVE\n(RET)\n");
  EXPECT_EQ(b.codes(), "");
}

TEST(FagorStatements, ASubroutineNeedsANumber) {
  Build b;
  b.add(ir::End{});
  b.routine(-1, "BOSS");
  (void)b.text();
  EXPECT_EQ(b.codes(), "TRN-241");
}

TEST(FagorStatements, AStatementStandsAloneInItsBlock) {  // 2.4
  Build b;
  b.add(assign(P(1), num(5))).line.number = "10";
  auto& second = b.add(move(ir::MotionKind::linear, {coord(axis::x, Value(P(1)))}));
  second.line.joined = true;
  auto& third = b.add(jump("10"));
  third.line.joined = true;
  EXPECT_EQ(b.lines(), "N10 (P1=5)\nG1 XP1\n(GOTO N10)\n");
}

TEST(FagorStatements, ALabelIsSearchedFromTheStartOfTheFile) {  // 2.6: the first one in the program wins
  Build b;
  b.add(move(ir::MotionKind::rapid, {coord(axis::x, Value(0))})).line.number = "10";
  b.add(jump("10"));
  b.add(ir::End{});
  b.routine(5);
  b.add(move(ir::MotionKind::rapid, {coord(axis::x, Value(1))})).line.number = "10";
  b.add(move(ir::MotionKind::rapid, {coord(axis::x, Value(2))})).line.number = "20";
  b.add(jump("10"));
  b.routine(6);
  b.add(move(ir::MotionKind::rapid, {coord(axis::x, Value(3))})).line.number = "10";
  EXPECT_EQ(
      b.lines(),
      "N10 G0 X0\n(GOTO N10)\nM30\n(SUB 5)\nN30 G0 X1\nN20 G0 X2\n(GOTO N30)\n(RET)\n(SUB 6)\nN10 G0 X3\n(RET)\n");
  EXPECT_EQ(b.codes(), "");
  ir::Jump computed;
  computed.target.computed = P(1);
  b.add(computed);
  (void)b.text();
  EXPECT_EQ(b.codes(), "TRN-240");
}

TEST(FagorStatements, EndMayFollowItsBlock) {
  Build b;
  b.add(actions({action(ir::SpindleRun{1, ir::SpindleState::off}, ir::Order::after)}));
  b.add(ir::End{"M02"}).line.joined = true;
  EXPECT_EQ(b.text(), "%PART ,MX,\nM5 M30\n");
}

TEST(FagorStatements, AtMostTwentySixAssignmentsInABlock) {  // 16.7
  Build b;
  ir::Assign many;
  for (int i = 0; i < 27; ++i) many.items.push_back(assign(P(100 + i), num(i)).items[0]);
  b.add(many);
  const std::string text = b.lines();
  EXPECT_NE(text.find(", P125=25)\n(P126=26)\n"), std::string::npos) << text;
}

TEST(FagorStatements, JumpsAndConditions) {  // 17.3
  Build b;
  b.add(jump("10", rel(BinaryOp::ge, P(1), num(3))));
  b.add(jump("10", op(BinaryOp::logical_and, rel(BinaryOp::eq, P(1), num(1)), rel(BinaryOp::gt, P(2), num(0)))));
  b.add(jump("10", P(3)));  // IF needs a relation
  ir::Jump computed;
  computed.target.computed = op(BinaryOp::add, P(1), num(10));
  b.add(computed);
  ir::If one;
  one.one_line = true;
  one.condition = rel(BinaryOp::lt, P(1), num(0));
  one.then_body = {statement(assign(P(1), num(0))), statement(assign(P(2), num(1)))};
  one.else_body = {statement(call(5))};
  b.add(one);
  b.add(move(ir::MotionKind::rapid, {coord(axis::x, Value(0))})).line.number = "10";
  EXPECT_EQ(b.lines(),
            "(IF P1 GE 3 GOTO N10)\n(IF (P1 EQ 1) AND (P2 GT 0) GOTO N10)\n(IF P3 NE 0 GOTO N10)\n(GOTO N(P1+10))\n"
            "(IF P1 LT 0 P1=0, P2=1 ELSE CALL 5)\nN10 G0 X0\n");
  EXPECT_EQ(b.codes(), "");
}

TEST(FagorStatements,
     ASearchInOneDirectionIsRefused) {  // the control takes the first block of that number in the program
  Build b;
  ir::Jump j = jump("10");
  j.search = ir::Search::backward;
  b.add(j);
  (void)b.text();
  EXPECT_EQ(b.codes(), "TRN-206");
}

TEST(FagorStatements, StructuresAreRefused) {
  Build b;
  ir::While w;
  w.condition = rel(BinaryOp::lt, P(1), num(2));
  w.body = {statement(assign(P(1), num(2)))};
  b.add(w);
  (void)b.text();
  EXPECT_EQ(b.codes(), "TRN-201");
}

TEST(FagorStatements, RepeatedRanges) {
  Build b;
  b.add(move(ir::MotionKind::rapid, {coord(axis::x, Value(0))})).line.number = "10";
  ir::Repeat r;
  r.first = r.last = block_number("10");
  b.add(r);
  r.count = num(3);
  b.add(r);
  r.count = P(110);
  b.add(r);
  EXPECT_EQ(b.lines(), "N10 G0 X0\n(RPT N10,N10)\n(RPT N10,N10) N3\n(RPT N10,N10) NP110\n");
  r.count = op(BinaryOp::add, P(1), num(1));
  b.add(r);
  (void)b.text();
  EXPECT_EQ(b.codes(), "TRN-203");
}

TEST(FagorStatements, CallsWithLevelsAndLetters) {  // 18.2
  Build b;
  ir::CallRoutine c = call(5);
  c.level = ir::CallLevel::new_level;
  c.arguments = {argument("A", num(10)), argument("B", P(101)), argument("C", num(-18)), argument("D", minus(P(3))),
                 argument("E", op(BinaryOp::multiply, P(1), num(2)))};
  b.add(c);
  b.add(call(0));
  ir::CallRoutine computed;
  computed.computed = P(3);
  b.add(computed);
  EXPECT_EQ(b.lines(), "(PCALL 5, A10, B=P101, C-18, D=-P3, E=P1*2)\n(CALL 0)\n(CALL P3)\n");
  c.level = ir::CallLevel::shared;
  b.add(c);
  (void)b.text();
  EXPECT_EQ(b.codes(), "TRN-203");
}

TEST(FagorStatements, CallsTheControlDoesNotHave) {
  for (int kind = 0; kind < 4; ++kind) {
    Build b;
    ir::CallRoutine c = call(5);
    if (kind == 0) c.count = num(3);
    if (kind == 1) c.has_range = true;
    if (kind == 2) c.tail = true;
    if (kind == 3) c.routine = {-1, "BOSS"};
    b.add(c);
    (void)b.text();
    EXPECT_TRUE(b.diagnostics.has_errors()) << kind;
  }
  Build modal;
  ir::ModalCall m;
  m.call = call(5);
  modal.add(m);
  (void)modal.text();
  EXPECT_EQ(modal.codes(), "TRN-201");
}

TEST(FagorStatements, Messages) {  // 17.1
  Build b;
  ir::Message m;
  m.parts = {ir::string_literal("Tiefe? \"Z\": "), P(100), ir::string_literal(" mm")};
  b.add(m);
  m.kind = ir::MessageKind::clear;
  m.parts.clear();
  b.add(m);
  m.kind = ir::MessageKind::error;
  m.number = num(12);
  m.parts = {ir::string_literal("stop")};
  b.add(m);
  EXPECT_EQ(b.lines(), "(MSG \"Tiefe? 'Z': ?P100 mm\")\n(MSG \" \")\n(ERROR 12, \"stop\")\n");
  EXPECT_EQ(b.codes(), "");
}

TEST(FagorStatements, AMessageIsCutToWhatTheControlShows) {
  Build b;
  ir::Message m;
  m.parts = {ir::string_literal(std::string(70, 'x'))};
  b.add(m);
  EXPECT_EQ(b.lines(), "(MSG \"" + std::string(59, 'x') + "\")\n");
  EXPECT_EQ(b.codes(), "TRN-213");
}

TEST(FagorStatements, MachineData) {  // 18.5 of the equivalences: PPOS, ORG54 = row 1
  Build b;
  const auto datum = [](ir::Datum d, ir::AxisId x, std::vector<ir::ExprPtr> args) {
    ir::SystemRef s;
    s.datum = d;
    s.axis = x;
    s.text = "$SOMETHING";
    s.args = std::move(args);
    ir::Expr e;
    e.node = s;
    return std::make_shared<const ir::Expr>(e);
  };
  b.add(assign(P(1), datum(ir::Datum::programmed_position, axis::x, {})));
  b.add(assign(P(1), datum(ir::Datum::work_offset, axis::z, {num(1)})));
  b.add(assign(P(1), datum(ir::Datum::tool_length, axis::z, {num(3)})));
  b.add(assign(P(1), datum(ir::Datum::tool_radius, axis::none, {P(2)})));
  EXPECT_EQ(b.lines(), "(P1=PPOSX)\n(P1=ORGZ54)\n(P1=TOL3)\n(P1=TORP2)\n");
  b.add(assign(P(1), datum(ir::Datum::other, axis::none, {})));
  (void)b.text();
  EXPECT_EQ(b.codes(), "TRN-203");
}

TEST(FagorStatements, RefusedLinesStandAsRemarks) {
  Build b;
  b.options.unsupported = backends::Unsupported::warn;
  auto& s = b.add(ir::Opaque{"STOPFIFO", "language.statement", false});
  s.line.number = "30";
  b.add(move(ir::MotionKind::rapid, {coord(axis::x, Value(0))}));
  EXPECT_EQ(b.lines(), "N30 ;!! TRN-205\nG0 X0\n");
  EXPECT_EQ(b.codes(), "TRN-205");
}

TEST(FagorStatements, NumberingAndSourceMap) {
  Build b;
  b.options.numbering = backends::Numbering::renumber;
  b.add(move(ir::MotionKind::rapid, {coord(axis::x, Value(0))})).line.number = "5";
  b.add(jump("5"));
  b.body()[1].line.span = {1, 7, 1, 7, 10};
  EXPECT_EQ(b.lines(), "N10 G0 X0\nN20 (GOTO N10)\n");
  const auto file = b.files()[0];
  EXPECT_EQ(file.map.lines.at(2).line, 7U);
}

}  // namespace
}  // namespace cnctrans::test
