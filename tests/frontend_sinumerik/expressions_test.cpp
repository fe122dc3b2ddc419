// Expressions, assignments, variables -> IR. Sections are those of the language reference.
#include <gtest/gtest.h>

#include "tests/frontend_sinumerik/show.h"

namespace {

using namespace cnctrans;
using namespace cnctrans::sinumerik;
using cnctrans::sinumerik::testing::body;
using cnctrans::sinumerik::testing::read;

TEST(SinumerikExpressions, ComparisonsAreRelative) {  // 4.3: reals are compared with a tolerance
  auto r = read("DEF INT I\nR1=R2==R3\nR1=I==3\n");
  EXPECT_EQ(r.errors(), "");
  const auto& real = std::get<ir::Assign>(r.program.routines[0].body[1].node).items[0].value;
  EXPECT_EQ(std::get<ir::Binary>(real->node).compare, ir::Compare::relative_1e12);
  EXPECT_EQ(real->type, ir::Type::boolean);
  const auto& whole = std::get<ir::Assign>(r.program.routines[0].body[2].node).items[0].value;
  EXPECT_EQ(std::get<ir::Binary>(whole->node).compare, ir::Compare::exact);
}

TEST(SinumerikExpressions, GreaterAndLessAreExactWhereTheMachineSaysSo) {  // 4.3, MD10280 bit 0
  const auto compares = [](const char* block, const std::string& exact) {
    auto r = read(block, "sinumerik-mill", "TEST.MPF", {{"sinumerik.exact_greater", exact}});
    EXPECT_EQ(r.errors(), "");
    return std::get<ir::Binary>(std::get<ir::Assign>(r.program.routines[0].body[0].node).items[0].value->node).compare;
  };
  EXPECT_EQ(compares("R1=R2>R3\n", "yes"), ir::Compare::exact);
  EXPECT_EQ(compares("R1=R2<R3\n", "yes"), ir::Compare::exact);
  EXPECT_EQ(compares("R1=R2>=R3\n", "yes"), ir::Compare::relative_1e12);
  EXPECT_EQ(compares("R1=R2>R3\n", "no"), ir::Compare::relative_1e12);
}

TEST(SinumerikExpressions, RealIntoIntRounds) {  // 4.4
  auto r = read("DEF INT I=2.5\nDEF BOOL B\nI=R1/2\nI=3\nB=R1\nI=7 DIV 2\n");
  EXPECT_EQ(r.errors(), "");
  const auto value = [&](std::size_t i) {
    return std::get<ir::Assign>(r.program.routines[0].body[i].node).items[0].value;
  };
  const auto* rounded = std::get_if<ir::Call>(&value(2)->node);
  ASSERT_NE(rounded, nullptr);
  EXPECT_EQ(rounded->function, ir::Function::to_integer);
  EXPECT_EQ(rounded->half, ir::RoundHalf::away);
  EXPECT_TRUE(std::holds_alternative<ir::Number>(value(3)->node));
  EXPECT_EQ(std::get<ir::Call>(value(4)->node).function, ir::Function::to_boolean);
  EXPECT_EQ(std::get<ir::Binary>(value(5)->node).op, ir::BinaryOp::int_divide);
  EXPECT_EQ(value(5)->type, ir::Type::integer);
}

TEST(SinumerikExpressions, DivisionIsAlwaysReal) {  // 4.2
  auto r = read("R1=3/4\nR1=3*4\n");
  EXPECT_EQ(std::get<ir::Assign>(r.program.routines[0].body[0].node).items[0].value->type, ir::Type::real);
  EXPECT_EQ(std::get<ir::Assign>(r.program.routines[0].body[1].node).items[0].value->type, ir::Type::integer);
}

TEST(SinumerikExpressions, Functions) {  // 4.2
  auto r = read("R1=ATAN2(R2,R3)+POT(2)+ROUNDUP(3.1)+BOUND(1,5,R4)+MINVAL(R1,2)\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_EQ(read("R1=SINH(3)\n").warnings(), "SIN-007");
  EXPECT_EQ(read("R1=ATAN2(3)\n").errors(), "SIN-012");
  EXPECT_EQ(read("R1=SIN(\"a\")\n").errors(), "SIN-012");
}

TEST(SinumerikExpressions, SingleEqualsAndUnbracketedComparisonsWarn) {  // 4.1, corpus
  EXPECT_EQ(read("X1:\nXX: IF (R1-R2) = 0 GOTOB XX\n").warnings(), "SIN-013");
  EXPECT_EQ(read("XX: IF R1==1 AND R2==2 GOTOB XX\n").warnings(), "SIN-014");
  EXPECT_EQ(read("XX: IF (R1==1) AND (R2==2) GOTOB XX\n").warnings(), "");
  EXPECT_EQ(read("XX: IF NOT R1==1 GOTOB XX\n").warnings(), "SIN-014");
  EXPECT_EQ(read("XX: IF (NOT R1)==1 GOTOB XX\n").warnings(), "");
}

TEST(SinumerikExpressions, Texts) {  // 5, 9.1
  auto r = read("DEF STRING[20] TXT=\"A\"\nTXT=\"N\"<<R1\nMSG(\"x \"<<R1<<\" mm\")\nMSG()\nTXT=TOUPPER(TXT)\n");
  EXPECT_EQ(r.errors(), "");
  const auto& b = r.program.routines[0].body;
  EXPECT_EQ(std::get<ir::Assign>(b[1].node).items[0].value->type, ir::Type::string);
  EXPECT_EQ(std::get<ir::Message>(b[2].node).parts.size(), 3U);
  EXPECT_EQ(std::get<ir::Message>(b[3].node).kind, ir::MessageKind::clear);
  EXPECT_EQ(read("R1=\"a\"\n").errors(), "SIN-012");
  EXPECT_EQ(read("DEF STRING[5] S\nS=5\n").warnings(), "SIN-012");
}

TEST(SinumerikExpressions, RParameters) {  // 3.2: R01 is R1, R[R2] is indirect, $R5 is the same cell
  auto r = read("R01=5 R[R2]=R1 $R5=2\n");
  EXPECT_EQ(r.errors(), "");
  const auto& items = std::get<ir::Assign>(r.program.routines[0].body[0].node).items;
  ASSERT_EQ(items.size(), 3U);
  EXPECT_EQ(std::get<ir::Number>(items[0].target.index->node).value, 1);
  EXPECT_TRUE(std::holds_alternative<ir::Call>(items[1].target.index->node));  // the index rounds
  EXPECT_EQ(std::get<ir::Number>(items[2].target.index->node).value, 5);
  EXPECT_EQ(read("R1=2 R2=R1 X=5\n").errors(), "SIN-011");  // alarm 12080
}

TEST(SinumerikExpressions, NamesThatNothingDefines) {  // 1.8, 3.3
  const auto unknown = read("_SAFE=5\nG0 Z=_SAFE X=_OTHER[2]\nIF _SAFE==\"A\" GOTOF LB1\nLB1: X=ABS(_SAFE)\n");
  EXPECT_EQ(unknown.errors(), "");
  EXPECT_EQ(unknown.warnings(), "SIN-006 SIN-006");  // one for each name
  EXPECT_EQ(read("FOR NN=0 TO 3\nX=NN\nENDFOR\n").warnings(), "SIN-006");
  EXPECT_EQ(read("G1 X1 MYAX=5\n").warnings(), "SIN-006 SIN-011");  // perhaps an axis: kept as text
  const auto global =
      read("_SAFE=5\nG0 Z=_SAFE\n", "sinumerik-mill", "T.MPF", {{"sinumerik.undefined_names", "global"}});
  EXPECT_EQ(global.errors(), "");
  EXPECT_EQ(global.warnings(), "SIN-006");
  EXPECT_EQ(read("DEF INT A_B\nDEF REAL A_B\n").errors(), "SIN-022");
  EXPECT_EQ(read("X10\nDEF INT A_B\n").warnings(), "SIN-018");
  EXPECT_EQ(read("DEF FRAME FR\nFR=CTRANS(X,5):CROT(Z,30)\n$P_PFRAME=FR\n").warnings(), "");
  EXPECT_EQ(read("DEF FRAME FR\nR1=FR\n").errors(), "SIN-012");  // a frame is no number
  EXPECT_EQ(read("DEF REAL LST[3]\nLST[1]=2\nR1=LST[R2]\n").errors(), "");
  EXPECT_EQ(read("DEF REAL LST[3]\nR1=LST\n").warnings(), "SIN-008");
}

TEST(SinumerikExpressions, VariablesWinOverAddresses) {  // 1.5, 1.7: a name in scope wins over the address
  auto r = read("PROC SUB(REAL X)\nX=X+1\nM17\n", "sinumerik-mill", "SUB.SPF");
  EXPECT_EQ(r.errors(), "");
  EXPECT_TRUE(std::holds_alternative<ir::Assign>(r.program.routines[0].body[0].node));
  EXPECT_EQ(r.program.routines[0].parameters.at(0).variable.name, "X");
}

TEST(SinumerikExpressions, SetWritesNeighbours) {  // 3.5: a gap writes 0
  auto r = read("R10=SET(1,,3)\nDEF REAL LST[4]\nLST[1]=SET(5,6)\n");
  EXPECT_EQ(r.errors(), "");
  const auto& items = std::get<ir::Assign>(r.program.routines[0].body[0].node).items;
  ASSERT_EQ(items.size(), 3U);
  EXPECT_EQ(std::get<ir::Number>(items[1].target.index->node).value, 11);
  EXPECT_EQ(std::get<ir::Number>(items[1].value->node).value, 0);
  EXPECT_EQ(std::get<ir::Number>(items[2].value->node).value, 3);
}

TEST(SinumerikExpressions, SystemVariables) {  // motion 24.1
  auto r = read("R1=$AA_IW[X]\nR2=$PI\nIF $P_SEARCH GOTOF LAB\nLAB: R3=$P_TOOLNO\n$P_UIFR[1,X,TR]=5\n");
  EXPECT_EQ(r.errors(), "");
  EXPECT_EQ(r.warnings(), "");
  const auto& b = r.program.routines[0].body;
  const auto& position = std::get<ir::SystemRef>(std::get<ir::Assign>(b[0].node).items[0].value->node);
  EXPECT_EQ(position.datum, ir::Datum::work_position);
  EXPECT_EQ(position.axis, ir::axis::x);
  const auto& offset = std::get<ir::Assign>(b[4].node).items[0];
  EXPECT_TRUE(offset.to_system);
  EXPECT_EQ(offset.system.datum, ir::Datum::work_offset);
  EXPECT_EQ(read("R1=$A_DBB[3]\n").warnings(), "SIN-015");
  EXPECT_EQ(read("$MC_GEOAX[3]=1\n").warnings(), "SIN-008");
  EXPECT_EQ(read("$A_DBB[3]=1\n").warnings(), "");  // beside the path
}

TEST(SinumerikExpressions, MacrosAreWrittenOut) {  // 8.6
  const auto m =
      read("DEFINE CUT AS G1 F100\nDEFINE TENS AS DIV 10 MOD 10\nCUT X5 ; CUT\ncut y=250 tens\nMSG(\"CUT\")\n");
  EXPECT_EQ(m.errors(), "");
  EXPECT_EQ(m.warnings(), "");
  // the same without macros
  const auto plain = read(";\n;\nG1 F100 X5 ; CUT\nG1 F100 y=250 DIV 10 MOD 10\nMSG(\"CUT\")\n");
  ASSERT_EQ(m.program.routines[0].body.size(), plain.program.routines[0].body.size());
  for (std::size_t i = 2; i < plain.program.routines[0].body.size(); ++i) {
    EXPECT_EQ(ir::to_text(m.program.routines[0].body[i], m.program),
              ir::to_text(plain.program.routines[0].body[i], plain.program));
  }
  EXPECT_EQ(read("DEFINE CUT AS G1\nDEFINE CUT AS G0\n").errors(), "SIN-022");
  EXPECT_EQ(read("IF (R1 HUNDREDS)==2\nX1\nENDIF\n").warnings(), "SIN-024");  // defined in another file
  EXPECT_EQ(read("IF (R1 5)==2 GOTOF LB1\nLB1:\n").errors(), "SIN-001");
}

TEST(SinumerikExpressions, PredefinedNamesAreNoVariables) {
  EXPECT_EQ(read("OMA1=2\n").warnings(), "SIN-008");
  EXPECT_EQ(read("SR=2\nOSP1[Z]=10\n").warnings(), "");  // beside the path: a note
  EXPECT_EQ(read("DEF REAL SR\nSR=2\n").program.routines[0].body.size(), 2U);
  EXPECT_EQ(read("DEF AXIS AX1\nAX1=AXNAME(\"X\")\n").warnings(), "");
  EXPECT_EQ(read("DEF REAL TAB1[3]\nSUBB(TAB1)\n").warnings(), "");
  EXPECT_EQ(read("MX1=5\n").warnings(), "SIN-008");  // an axis of the machine builder
}
}  // namespace
