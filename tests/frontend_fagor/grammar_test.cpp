// The Fagor grammar: lexical traps, trees by priority, statement layouts, messages, the corpus.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "base/source.h"
#include "frontends/fagor/syntax/parse.h"

namespace cnctrans::fagor {
namespace {

BlockParser& parser() {
  static BlockParser p;
  return p;
}

std::string tree(const syntax::Expr& e) {
  std::string s;
  for (const auto& a : e.args) s += " " + tree(a);
  switch (e.kind) {
    case syntax::ExprKind::number: return e.text;
    case syntax::ExprKind::string: return "\"" + e.text + "\"";
    case syntax::ExprKind::missing: return "_";
    case syntax::ExprKind::name: return "'" + e.text;
    case syntax::ExprKind::variable: return s.empty() ? e.text : e.text + "[" + s.substr(1) + "]";
    default: return "(" + e.text + s + ")";
  }
}

std::string tree(const syntax::Statement& st) {
  std::string s = "{" + st.keyword;
  for (const auto& a : st.args) s += " " + tree(a);
  for (const auto& c : st.children) s += " " + tree(c);
  if (!st.text.empty()) s += " <" + st.text + ">";
  return s + "}";
}

/// `N10 X1.5 YP[3]`: number, skip marks as `/mask`, words, statements, `;comment`.
std::string read(std::string_view line) {
  syntax::Block b;
  ParseError error;
  if (!parser().parse_block(line, b, error)) return "error " + std::to_string(error.pos.column) + ": " + error.message;
  std::string s;
  const auto add = [&s](const std::string& part) { s += (s.empty() ? "" : " ") + part; };
  if (b.skip_mask) add("/" + std::to_string(b.skip_mask));
  if (!b.number.empty()) add(std::string("#") + std::string(b.number));
  for (const auto& st : b.statements) add(tree(st));
  for (const auto& w : b.words) {
    std::string t(w.address);
    if (w.extension >= 0) t += std::to_string(w.extension);
    if (w.equals) t += "=";
    if (w.is_expression)
      t += tree(b.exprs.at(static_cast<std::size_t>(w.expr)));
    else if (w.has_value)
      t += std::string(w.number_text);
    else
      t += "_";
    add(t);
  }
  for (const auto& c : b.comments) add(";" + std::string(c.text));
  return s;
}
std::string read_expr(const std::string& text) {
  const std::string s = read("(P1=" + text + ")");
  return s.substr(0, 8) == "{= P[1] " ? s.substr(8, s.size() - 9) : s;
}

TEST(FagorGrammar, IsoWords) {
  EXPECT_EQ(read("N120 G1 X10.5 Z-3 F0.2 ;text"), "#120 G1 X10.5 Z-3 F0.2 ;text");
  EXPECT_EQ(read("G 1 X 100"), "G1 X100");            // blanks inside words (ch. 2)
  EXPECT_EQ(read("G X Z-.5 F5."), "G_ X_ Z-.5 F5.");  // the value may be left out (ch. 2)
  EXPECT_EQ(read("G1X0.0Y0.0F360"), "G1 X0.0 Y0.0 F360");
  EXPECT_EQ(read("G74 XYA"), "G74 X_ Y_ A_");
  EXPECT_EQ(read("X Y S800"), "X_ Y_ S800");
  EXPECT_EQ(read("g1 x5"), "g1 x5");
  EXPECT_EQ(read(""), "");
  EXPECT_EQ(read("   \t"), "");
}

TEST(FagorGrammar, ParametersAsValues) {
  EXPECT_EQ(read("GP0 XP1 Z100"), "GP[0] XP[1] Z100");
  EXPECT_EQ(read("X-P1 Z - P2 I-P3"), "X(- P[1]) Z(- P[2]) I(- P[3])");
  EXPECT_EQ(read("X P120 FP115"), "XP[120] FP[115]");
  EXPECT_EQ(read("G60 A30 X1200 I100 P2.003 Q6"), "G60 A30 X1200 I100 P2.003 Q6");  // P as an address (25.4)
  EXPECT_EQ(read("XP2.5"), "error 3: the number of a parameter has no decimals");
  EXPECT_EQ(read("G180 P1=5 A=P3 B4"), "G180 P1=5 A=P[3] B4");
}

TEST(FagorGrammar, HeadOfTheBlock) {
  EXPECT_EQ(read("/N10 X1"), "/1 #10 X1");
  EXPECT_EQ(read("/1 /2 N17 M10"), "/3 #17 M10");
  EXPECT_EQ(read("/3 X1"), "/4 X1");
  EXPECT_EQ(read("/4 X1"), "error 1: a skip mark is /, /1, /2 or /3");
  EXPECT_EQ(read("N10;"), "#10 ;");
  EXPECT_EQ(read("N0010 X1 N3"), "#0010 X1 N3");  // label and repeat count differ by place (2.7)
  EXPECT_EQ(read("X1 NP110"), "X1 NP[110]");
  EXPECT_EQ(read("G41 N20"), "G41 N20");
  EXPECT_EQ(read("N1.5 X1"), "error 1: a block number has no decimals");
}

TEST(FagorGrammar, Comments) {
  EXPECT_EQ(read(";(MSG \"x\")"), ";(MSG \"x\")");
  EXPECT_EQ(read("X1;a;b "), "X1 ;a;b ");
  EXPECT_EQ(read("X1 ; \xe4\xf6 (\""), "X1 ; \xe4\xf6 (\"");
}

TEST(FagorGrammar, Priority) {  // manual 11.5.1
  EXPECT_EQ(read_expr("-2 EXP 2"), "(EXP (- 2) 2)");
  EXPECT_EQ(read_expr("2 EXP 3 EXP 2"), "(EXP (EXP 2 3) 2)");
  EXPECT_EQ(read_expr("7 MOD 4 * 3"), "(* (MOD 7 4) 3)");
  EXPECT_EQ(read_expr("SIN 10+5"), "(+ (SIN 10) 5)");
  EXPECT_EQ(read_expr("SIN P1 * P2"), "(* (SIN P[1]) P[2])");
  EXPECT_EQ(read_expr("ABS ROUND (P1/2)"), "(ABS (ROUND (/ P[1] 2)))");
  EXPECT_EQ(read_expr("NOT P2 OR P3"), "(OR (NOT P[2]) P[3])");
  EXPECT_EQ(read_expr("FIRST AND GS1 EQ 1"), "(AND FIRST (EQ GS[1] 1))");
  EXPECT_EQ(read_expr("1 OR 2 AND 3 XOR 4"), "(OR 1 (XOR (AND 2 3) 4))");
  EXPECT_EQ(read_expr("1-2-3"), "(- (- 1 2) 3)");
  EXPECT_EQ(read_expr("8/4/2"), "(/ (/ 8 4) 2)");
  EXPECT_EQ(read_expr("2 EXP -1"), "(EXP 2 (- 1))");
  EXPECT_EQ(read_expr("1+2*3 GT 4-1"), "(GT (+ 1 (* 2 3)) (- 4 1))");
  EXPECT_EQ(read_expr("ARG(P1, -P2)+PI"), "(+ (ARG P[1] (- P[2])) (PI))");
}

TEST(FagorGrammar, Operands) {
  EXPECT_EQ(read_expr("P(P7+1)"), "P[(+ P[7] 1)]");
  EXPECT_EQ(read_expr("P 100"), "P[100]");
  EXPECT_EQ(read_expr("$FC00"), "$FC00");
  EXPECT_EQ(read_expr("360./.5"), "(/ 360. .5)");
  EXPECT_EQ(read_expr("A+Z"), "(+ A Z)");
  EXPECT_EQ(read_expr("ORGX+ORGX 55+ORGX54+ORGX(12+P9)"), "(+ (+ (+ ORGX ORGX[55]) ORGX[54]) ORGX[(+ 12 P[9])])");
  EXPECT_EQ(read_expr("TOX3+TORP1+TOR(P1)"), "(+ (+ TOX[3] TOR[P[1]]) TOR[P[1]])");
  EXPECT_EQ(read_expr("ASINX+ASIN X"), "(+ ASINX (ASIN X))");  // the variable when the letters touch
  EXPECT_EQ(read_expr("PLCMM 150"), "PLCMM[150]");
  EXPECT_EQ(read_expr("GPOSX N99 P100"), "GPOSX[99 100]");
  EXPECT_EQ(read_expr("ATJSTAT AND $FF"), "(AND ATJSTAT $FF)");  // a name that is in no table
  EXPECT_EQ(read("(P1EQ=3)").substr(0, 5), "error");
}

TEST(FagorGrammar, Assignments) {
  EXPECT_EQ(read("(P1=P1+P2, P1=P1*P4)"), "{= P[1] (+ P[1] P[2]) P[1] (* P[1] P[4])}");
  EXPECT_EQ(read("(A13.7)"), "{= A 13.7}");
  EXPECT_EQ(read("(M30)"), "{= M 30}");  // P12 = 30, no program end (16.2)
  EXPECT_EQ(read("(C-18)"), "{= C -18}");
  EXPECT_EQ(read("(ORGX 54=P268)"), "{= ORGX[54] P[268]}");
  EXPECT_EQ(read("(SK1 =\"A;B)\", SK2=\"\")"), "{= SK[1] \"A;B)\" SK[2] \"\"}");
  EXPECT_EQ(read("(IB1 = INPUT \"Z : \",-5.5)"), "{= IB[1] (INPUT \"Z : \" -5.5)}");
  EXPECT_EQ(read("(P(P3)=$5F)"), "{= P[P[3]] $5F}");
}

TEST(FagorGrammar, Flow) {
  EXPECT_EQ(read("N10(IF ATJACT NE 0 GOTO N10)"), "#10 {IF (NE ATJACT 0) {GOTO 10}}");
  EXPECT_EQ(read("(IFP1EQ5GOTON10)"), "{IF (EQ P[1] 5) {GOTO 10}}");
  EXPECT_EQ(read("(IF (P8 EQ 1) CALL 3 ELSE PCALL 5, A2, B5)"), "{IF (EQ P[8] 1) {CALL 3} {PCALL 5 A 2 B 5}}");
  EXPECT_EQ(read("(IF (E EQ 10) M10)"), "{IF (EQ E 10) {= M 10}}");
  EXPECT_EQ(read("(IF P1 GT ORGX P2=3)"), "{IF (GT P[1] ORGX) {= P[2] 3}}");
  EXPECT_EQ(read("(IF P1 GT ORGX P2 P2=3)"), "{IF (GT P[1] ORGX[P[2]]) {= P[2] 3}}");
  EXPECT_EQ(read("(IF A EQ B C=3)"), "{IF (EQ A B) {= C 3}}");
  EXPECT_EQ(read("(IF P277 EQ 1 P268=P268-(TPOSX)+ORGX)"), "{IF (EQ P[277] 1) {= P[268] (+ (- P[268] TPOSX) ORGX)}}");
  EXPECT_EQ(read("(IF (P1 LE 1) OR (P2 LE 2) GOTO NP100)"), "{IF (OR (LE P[1] 1) (LE P[2] 2)) {GOTO P[100]}}");
  EXPECT_EQ(read("(IF PLCM5512 AND 1 EQ 0 GOTO N1)"), "{IF (AND PLCM[5512] (EQ 1 0)) {GOTO 1}}");
  EXPECT_EQ(read("(RPT N50,N60)N3"), "{RPT 50 60} N3");
  EXPECT_EQ(read("(RPT N1300, N1330, P12) NP118 ;x"), "{RPT 1300 1330 12} NP[118] ;x");
}

TEST(FagorGrammar, Calls) {
  EXPECT_EQ(read("(SUB 9002)"), "{SUB 9002}");
  EXPECT_EQ(read("(LSUB 01)"), "{LSUB 01}");
  EXPECT_EQ(read("(RET )"), "{RET}");
  EXPECT_EQ(read("(CALL P148)"), "{CALL P[148]}");
  EXPECT_EQ(read("(LL9505)"), "{LL 9505}");
  EXPECT_EQ(read("(PCALL 5, A1, P3=2, B=P101/2, SP100, C-18)"), "{PCALL 5 A 1 P[3] 2 B (/ P[101] 2) S P[100] C -18}");
  EXPECT_EQ(read("(EXEC P(009003))"), "{EXEC 009003}");
  EXPECT_EQ(read("(EXEC P12,DNC2)"), "{EXEC 12 'DNC2}");
  EXPECT_EQ(read("(OPEN P880000,A,\"Time logs\")"), "{OPEN 880000 'A \"Time logs\"}");
}

TEST(FagorGrammar, Texts) {
  EXPECT_EQ(read("(MSG\"PUT T?P100 (?P148) ;x\")"), "{MSG \"PUT T?P100 (?P148) ;x\"}");
  EXPECT_EQ(read("(ERROR 5, \"bad\")"), "{ERROR 5 \"bad\"}");
  EXPECT_EQ(read("(WRITE <DESCRI$P>[WARMU$P])"), "{WRITE < <DESCRI$P>[WARMU$P]>}");
  EXPECT_EQ(read("(WRITE (MSG \"a) b\")) ;c"), "{WRITE < (MSG \"a) b\")>} ;c");
  EXPECT_EQ(read("(WRITE )"), "{WRITE < >}");
  EXPECT_EQ(read("(SYMBOL 015,100,240)"), "{SYMBOL 015 100 240}");
  EXPECT_EQ(read("(FOOBAZ 1,\"x\")").substr(0, 8), "{FOOBAZ ");
}

TEST(FagorGrammar, Faults) {
  EXPECT_EQ(read("X1 (P1=2)"), "error 4: a block holds either ISO words or one ( ) statement, not both");
  EXPECT_EQ(read("(P1=2"), "error 6: the closing bracket ) is missing");
  EXPECT_EQ(read("(MSG \"abc)"), "error 6: the text in quotes is not closed");
  EXPECT_EQ(read("(P1=2))"), "error 7: a bracket ) too many");
  EXPECT_EQ(read("X1 0"), "error 4: the number 0 has no letter before it");
  EXPECT_EQ(read("G1 X1 #"), "error 7: the character '#' has no meaning here");
  EXPECT_EQ(read("G1 \x80"), "error 4: a byte with code 128 has no meaning in a block");
  EXPECT_EQ(read("(IF P1 EQ 2)").substr(0, 6), "error ");
  EXPECT_EQ(read("(P1=" + std::string(500, '(') + "1").substr(0, 6), "error ");
  EXPECT_EQ(read("(P1=" + std::string(500, '-') + "1)").substr(0, 6), "error ");
  EXPECT_EQ(read("X1 N3 (RET)").substr(0, 6), "error ");
}

TEST(FagorGrammar, Columns) {
  syntax::Block b;
  ParseError error;
  ASSERT_TRUE(parser().parse_block("/2 N20 G 1 X-P 7", b, error));
  EXPECT_EQ(b.skip_pos, (WordPos{1, 2}));
  EXPECT_EQ(b.number_pos, (WordPos{4, 3}));
  EXPECT_EQ(b.words.at(0).pos, (WordPos{8, 3}));
  EXPECT_EQ(b.words.at(1).pos, (WordPos{12, 5}));
  EXPECT_EQ(b.exprs.at(0).pos, (WordPos{13, 4}));
  EXPECT_EQ(b.words.at(1).address, "X");
}

TEST(FagorGrammar, Corpus) {
  const std::filesystem::path folder = std::filesystem::path(CNCTRANS_SOURCE_DIR) / "../shared/corpus/fagor";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no corpus at " << folder;
  std::map<std::string, int> faults;
  int lines = 0, bad = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::string message;
    const SourcePtr source = SourceText::open(entry.path().string(), &message);
    ASSERT_TRUE(source) << message;
    for (const auto& line : source->lines()) {
      if (line.text.substr(0, 1) == "%") continue;
      syntax::Block b;
      ParseError error;
      ++lines;
      if (parser().parse_block(line.text, b, error)) continue;
      ++bad;
      ++faults[std::string(line.text) + "   <- " + error.message];
    }
  }
  std::cout << lines << " lines, " << bad << " not read\n";
  for (const auto& [text, n] : faults) std::cout << n << " x " << text << "\n";
  EXPECT_GT(lines, 31000);
  EXPECT_LE(bad, 4);
}

}  // namespace
}  // namespace cnctrans::fagor
