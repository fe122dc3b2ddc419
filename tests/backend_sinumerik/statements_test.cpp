// Statements and the look of lines (reference-language 3, 6-9).
#include "tests/backend_sinumerik/build.h"

namespace cnctrans::test {
namespace {

using ir::BinaryOp;
using ir::MotionKind;
using ir::Search;
using ir::Value;
namespace axis = ir::axis;

std::string value_of(ir::ExprPtr e) {
  Build b;
  b.add(assign(R(1), std::move(e)));
  const std::string text = b.text();
  EXPECT_TRUE(b.diagnostics.empty()) << b.codes();
  return text.substr(3, text.size() - 4);
}

TEST(SinumerikExpressions, ParenthesesOnlyWhereTheTreeNeedsThem) {
  const auto sum = op(BinaryOp::add, R(2), R(3));
  EXPECT_EQ(value_of(op(BinaryOp::multiply, sum, num(2))), "(R2+R3)*2");
  EXPECT_EQ(value_of(op(BinaryOp::add, op(BinaryOp::multiply, R(2), R(3)), num(2))), "R2*R3+2");
  EXPECT_EQ(value_of(op(BinaryOp::subtract, R(1), sum)), "R1-(R2+R3)");
  EXPECT_EQ(value_of(op(BinaryOp::subtract, op(BinaryOp::subtract, R(1), R(2)), R(3))), "R1-R2-R3");
  EXPECT_EQ(value_of(op(BinaryOp::divide, R(1), op(BinaryOp::divide, R(2), R(3)))), "R1/(R2/R3)");
}

TEST(SinumerikExpressions, ASignInsideAnExpressionStandsInParentheses) {
  EXPECT_EQ(value_of(op(BinaryOp::multiply, R(2), ir::unary(ir::UnaryOp::negate, R(3)))), "R2*(-R3)");
  EXPECT_EQ(value_of(op(BinaryOp::subtract, R(2), num(-5))), "R2-(-5)");
  EXPECT_EQ(value_of(op(BinaryOp::multiply, ir::unary(ir::UnaryOp::negate, R(3)), R(2))), "-R3*R2");
  EXPECT_EQ(value_of(ir::unary(ir::UnaryOp::negate, op(BinaryOp::multiply, R(2), R(3)))), "-(R2*R3)");
}

TEST(SinumerikExpressions, ASignRightOfAComparisonNeedsNone) {
  Build b;
  b.add(jump("10", Search::forward, op(BinaryOp::eq, R(1), num(-1))));
  b.add(jump("10", Search::forward, op(BinaryOp::lt, R(1), ir::unary(ir::UnaryOp::negate, R(2)))));
  EXPECT_EQ(b.text(), "IF R1==-1 GOTOF N10\nIF R1<-R2 GOTOF N10\n");
}

// Comparisons bind weakest of all (4.1): beside AND they need parentheses.
TEST(SinumerikExpressions, ComparisonsBesideLogicStandInParentheses) {
  Build b;
  const auto both = op(BinaryOp::logical_and, op(BinaryOp::eq, R(1), num(1)), op(BinaryOp::gt, R(2), num(0)));
  b.add(jump("10", Search::forward, both));
  b.add(jump("20", Search::backward, ir::unary(ir::UnaryOp::logical_not, op(BinaryOp::le, R(1), num(1)))));
  EXPECT_EQ(b.text(), "IF (R1==1) AND (R2>0) GOTOF N10\nIF NOT (R1<=1) GOTOB N20\n");
}

TEST(SinumerikExpressions, WhatTheControlSaysByOtherFunctions) {
  EXPECT_EQ(value_of(op(BinaryOp::power, R(1), num(2))), "POT(R1)");
  EXPECT_EQ(value_of(op(BinaryOp::power, op(BinaryOp::add, R(1), num(1)), num(3))), "(R1+1)*(R1+1)*(R1+1)");
  EXPECT_EQ(value_of(op(BinaryOp::power, R(1), R(2))), "EXP(R2*LN(R1))");
  EXPECT_EQ(value_of(op(BinaryOp::modulo, R(1), num(3))), "R1-TRUNC(R1/3)*3");  // MOD takes INT only
  EXPECT_EQ(value_of(ir::call(ir::Function::atan, {R(1)})), "ATAN2(R1,1)");
  EXPECT_EQ(value_of(ir::call(ir::Function::atan2, {R(1), R(2)})), "ATAN2(R1,R2)");
  EXPECT_EQ(value_of(ir::call(ir::Function::ceil, {R(1)})), "ROUNDUP(R1)");
  EXPECT_EQ(value_of(ir::call(ir::Function::floor, {R(1)})), "-ROUNDUP(-R1)");
}

TEST(SinumerikExpressions, IntegersUseTheIntegerOperators) {
  const auto n = named("NN", 2, ir::Type::integer);
  const auto two = std::make_shared<const ir::Expr>(ir::Expr{ir::Number{2, "2", true}, ir::Type::integer, {}});
  EXPECT_EQ(value_of(op(BinaryOp::modulo, n, two)), "NN MOD 2");
}

TEST(SinumerikExpressions, AFunctionThatDoesNotExistIsRefused) {
  Build b;
  b.add(assign(R(1), ir::call(ir::Function::to_bcd, {R(2)})));
  b.text();
  EXPECT_EQ(b.codes(), "TRN-203");
}

TEST(SinumerikExpressions, ComputedIndex) {
  ir::VarRef v;
  v.index = op(BinaryOp::add, num(100), named("NN", 2, ir::Type::integer));
  EXPECT_EQ(value_of(ir::variable(v)), "R[100+NN]");
}

TEST(SinumerikStatements, StructuresAreIndentedByTwo) {
  Build b;
  ir::For f;
  f.counter = var(named("NN", 2));
  f.from = num(1);
  f.to = op(BinaryOp::subtract, R(1), num(1));
  ir::If i;
  i.condition = op(BinaryOp::gt, R(2), num(0));
  ir::Statement inner;
  inner.node = assign(R(3), num(1));
  i.then_body.push_back(inner);
  inner.node = assign(R(3), num(2));
  i.else_body.push_back(inner);
  i.has_else = true;
  ir::Statement s;
  s.node = i;
  f.body.push_back(s);
  b.add(f);
  EXPECT_EQ(b.text(), "FOR NN=1 TO R1-1\n  IF R2>0\n    R3=1\n  ELSE\n    R3=2\n  ENDIF\nENDFOR\n");
}

TEST(SinumerikStatements, Loops) {
  Build b;
  ir::Statement inner;
  inner.node = assign(R(1), num(0));
  b.add(ir::While{op(BinaryOp::lt, R(1), num(3)), {inner}, {}});
  b.add(ir::Until{{inner}, op(BinaryOp::ge, R(1), num(3)), {}});
  b.add(ir::Loop{{inner}, {}});
  EXPECT_EQ(b.text(), "WHILE R1<3\n  R1=0\nENDWHILE\nREPEAT\n  R1=0\nUNTIL R1>=3\nLOOP\n  R1=0\nENDLOOP\n");
}

TEST(SinumerikStatements, JumpsSearchInADirection) {  // 6
  Build b;
  b.add(jump("22", Search::forward));
  b.add(jump("LAB_A", Search::backward));
  b.add(jump("22", Search::forward_then_backward));
  auto quiet = jump("22", Search::forward_then_backward);
  quiet.quiet = true;
  b.add(quiet);
  EXPECT_EQ(b.text(), "GOTOF N22\nGOTOB LAB_A\nGOTO N22\nGOTOC N22\n");
}

TEST(SinumerikStatements, AJumpFromTheStartOfTheProgramIsRefused) {
  Build b;
  b.add(jump("22", Search::whole_first));
  b.text();
  EXPECT_EQ(b.codes(), "TRN-206");
}

TEST(SinumerikStatements, ComputedJumpAndCase) {
  Build b;
  ir::Jump j;
  j.target.computed = R(1);
  j.search = Search::forward_then_backward;
  b.add(j);
  ir::Switch s;
  s.value = R(1);
  s.cases.emplace_back(num(10), jump("10", Search::forward));
  s.cases.emplace_back(num(20), jump("20", Search::backward));
  s.fallback.push_back(jump("99", Search::forward));
  b.add(s);
  EXPECT_EQ(b.text(), "GOTO \"N\"<<R1\nCASE(R1) OF 10 GOTOF N10 20 GOTOB N20 DEFAULT GOTOF N99\n");
}

TEST(SinumerikStatements, RepeatedRanges) {  // 7.3
  Build b;
  ir::Repeat r;
  r.first.text = "LA";
  r.last.text = "LB";
  r.count = num(3);
  b.add(r);
  r.last.text = "LA";
  r.count = R(1);
  b.add(r);
  r.last.text = "";
  r.count = nullptr;
  b.add(r);
  EXPECT_EQ(b.text(), "REPEAT LA LB P=3\nREPEATB LA P=R1\nREPEAT LA\n");
}

TEST(SinumerikStatements, CallsWithArgumentsAndCounts) {  // 8.4
  Build b;
  ir::CallRoutine c;
  c.routine = {5, ""};
  c.count = num(3);
  b.add(c);
  c.routine = {-1, "BOSS"};
  c.count = nullptr;
  c.arguments = {{"", R(2), false, {}}, {"", nullptr, false, {}}, {"", num(-15), false, {}}};
  b.add(c);
  ir::ModalCall m;
  m.call = c;
  b.add(m);
  m = {};
  m.off = true;
  b.add(m);
  EXPECT_EQ(b.text(), "L5 P3\nBOSS(R2,,-15)\nMCALL BOSS(R2,,-15)\nMCALL\n");
}

TEST(SinumerikStatements, SubprogramsAreFilesOfTheirOwn) {
  Build b;
  b.program.routines[0].title = "FLANGE 12";
  b.add(ir::End{});
  ir::Routine& r = b.routine("", 20);
  ir::Parameter p;
  p.name = "_P0";
  p.variable = var(named("_P0"));
  r.parameters.push_back(p);
  p.name = p.variable.name = "N";
  p.type = ir::Type::integer;
  p.by_reference = true;
  r.parameters.push_back(p);
  b.add(ir::Return{});
  b.options.main_stem = "flange_12";
  const auto files = b.files();
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].name, "flange_12.MPF");
  EXPECT_TRUE(files[0].main);
  EXPECT_EQ(files[0].text, "; FLANGE 12\nM30\n");
  EXPECT_EQ(files[1].name, "L20.SPF");
  EXPECT_EQ(files[1].text, "PROC L20(REAL _P0,VAR INT N)\nM17\n");
}

TEST(SinumerikStatements, ANumericStemGetsALegalName) {  // equivalences 2: header title, else PRG and the number
  Build b;
  b.options.main_stem = "001234";
  b.program.routines[0].name = {1234, ""};
  b.add(ir::End{});
  EXPECT_EQ(b.files()[0].name, "PRG001234.MPF");
  EXPECT_EQ(b.codes(), "TRN-213");
  b.program.routines[0].title = "Spindle nut";
  EXPECT_EQ(b.files()[0].name, "SPINDLE_NUT.MPF");
}

TEST(SinumerikStatements, OneFileForAllIsAnArchive) {
  Build b;
  b.options.single_output = true;
  b.add(ir::End{});
  b.routine("", 5);
  b.add(ir::Return{});
  const auto files = b.files();
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].text, "%_N_MAIN_MPF\nM30\n%_N_L5_SPF\nM17\n");
}

// M30 in a called program only returns (8.3): the end of everything can't be said there.
TEST(SinumerikStatements, TheEndOfAllInsideASubprogramIsRefused) {
  Build b;
  b.routine("", 5);
  b.add(ir::End{});
  b.files();
  EXPECT_EQ(b.codes(), "TRN-201");
}

TEST(SinumerikStatements, MessagesAndDefinitions) {
  Build b;
  ir::Message m;
  m.parts = {ir::string_literal("R1 IS "), R(1), ir::string_literal(" mm")};
  b.add(m);
  m.parts.clear();
  m.kind = ir::MessageKind::clear;
  b.add(m);
  m.kind = ir::MessageKind::error;
  m.number = num(12);
  m.parts = {ir::string_literal("too \"deep\"")};
  b.add(m);
  ir::Declare d;
  d.type = ir::Type::integer;
  d.space = 2;
  d.items = {{"NN", {}, {num(3)}}, {"TAB", {num(2), num(3)}, {}}};
  b.add(d);
  EXPECT_EQ(b.text(),
            "MSG(\"R1 IS \"<<R1<<\" mm\")\nMSG()\nSETAL(65012,\"too 'deep'\")\nSTOPRE\nM0\nDEF INT NN=3,TAB[2,3]\n");
}

ir::Statement labelled(ir::Block block, std::string_view number) {
  ir::Statement s;
  s.node = std::move(block);
  s.line.number = number;
  return s;
}

TEST(SinumerikLines, NumbersKeptDroppedOrMadeAnew) {
  const auto make = [](backends::Numbering numbering) {
    Build b;
    b.options.numbering = numbering;
    b.body().push_back(labelled(move(MotionKind::rapid, {coord(axis::x, Value(0))}), "0010"));
    b.body().push_back(labelled(move(MotionKind::rapid, {coord(axis::x, Value(1))}), "0020"));
    b.add(jump("20", Search::backward, op(BinaryOp::lt, R(1), num(3))));
    b.add(jump("5", Search::backward));
    b.body().push_back(labelled(move(MotionKind::rapid, {coord(axis::x, Value(2))}), "5"));
    return b.text();
  };
  EXPECT_EQ(make(backends::Numbering::keep), "N0010 G0 X0\nN0020 G0 X1\nIF R1<3 GOTOB N20\nGOTOB N5\nN5 G0 X2\n");
  EXPECT_EQ(make(backends::Numbering::none), "G0 X0\nN0020 G0 X1\nIF R1<3 GOTOB N20\nGOTOB N5\nN5 G0 X2\n");
  EXPECT_EQ(make(backends::Numbering::renumber),
            "N10 G0 X0\nN20 G0 X1\nN30 IF R1<3 GOTOB N20\nN40 GOTOB N50\nN50 G0 X2\n");
}

TEST(SinumerikLines, AComputedTargetForbidsRenumbering) {
  Build b;
  b.options.numbering = backends::Numbering::renumber;
  ir::Jump j;
  j.target.computed = R(1);
  j.search = Search::forward_then_backward;
  b.body().push_back(labelled(move(MotionKind::rapid, {coord(axis::x, Value(0))}), "7"));
  b.add(j);
  EXPECT_EQ(b.text(), "N7 G0 X0\nGOTO \"N\"<<R1\n");
  EXPECT_EQ(b.codes(), "TRN-212");
}

TEST(SinumerikLines, SkipMarksLabelsCommentsBlankLines) {
  Build b;
  auto& s = b.add(move(MotionKind::rapid, {coord(axis::x, Value(0))}));
  s.line.skip_mask = 2;
  s.line.number = "10";
  s.line.labels = {"LAB_A"};
  s.line.comments.push_back({"text", ir::CommentPlace::end_of_line, {}});
  s.line.blank_lines_before = 1;
  auto& c = b.add(ir::Block{});
  c.line.comments.push_back({" own line", ir::CommentPlace::own_line, {}});
  EXPECT_EQ(b.text(), "\n/1 N10 LAB_A: G0 X0  ; text\n; own line\n");
  EXPECT_EQ(b.files()[0].map.lines.size(), 3U);
}

TEST(SinumerikLines, StatementsOfOneSourceLineShareOneWhereTheControlAllows) {
  Build b;
  b.add(move(MotionKind::rapid, {coord(axis::z, Value(50))}));
  b.add(ir::End{}).line.joined = true;
  b.add(assign(R(1), num(1)));
  b.add(assign(R(2), num(2))).line.joined = true;
  b.add(move(MotionKind::rapid, {coord(axis::x, Value(0))})).line.joined = true;  // alarm 12080 in one block
  EXPECT_EQ(b.text(), "G0 Z50 M30\nR1=1 R2=2\nG0 X0\n");
}

// --- what can't be said -----------------------------------------------------------------------------------------

TEST(SinumerikRefusals, ByDefaultAnErrorAtTheLine) {
  Build b;
  auto& s = b.add(ir::Exit{});
  s.line.span = {1, 7, 1, 7, 5};
  b.text();
  ASSERT_EQ(b.diagnostics.all().size(), 1U);
  EXPECT_EQ(b.diagnostics.all()[0].severity, Severity::error);
  EXPECT_EQ(b.diagnostics.all()[0].span.line, 7U);
}

TEST(SinumerikRefusals, AsARemarkWithAStop) {
  Build b;
  b.options.unsupported = backends::Unsupported::comment;
  const auto source = SourceText::from_string("part.x", "\nG45 X5 (ROUGH)\n");
  b.program.texts->hold(source);
  ir::FileLook look;
  look.file = 1;
  look.name = "part.x";
  b.program.files.push_back(look);
  ir::Opaque o;
  o.text = "G45 X5";
  auto& s = b.add(o);
  s.line.span = {1, 2, 1, 2, 7};
  s.line.number = "40";
  b.add(assign(R(1), num(1)));
  EXPECT_EQ(b.text(), "N40 ;!! TRN-205 G45 X5 (ROUGH)\nM0\nR1=1\n");
  EXPECT_FALSE(b.diagnostics.has_errors());
}

TEST(SinumerikRefusals, ARefusedConditionTakesItsBodyAlong) {
  Build b;
  b.options.unsupported = backends::Unsupported::comment;
  ir::Statement inner;
  inner.node = move(MotionKind::rapid, {coord(axis::x, Value(0))});
  b.add(ir::While{ir::call(ir::Function::to_bcd, {R(2)}), {inner}, {}});
  b.add(assign(R(1), num(1)));
  const std::string text = b.text();
  EXPECT_EQ(text.find("G0"), std::string::npos) << text;
  EXPECT_EQ(text.find("ENDWHILE"), std::string::npos) << text;
  EXPECT_NE(text.find("M0\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace cnctrans::test
