// Files: headers, subroutines, statements, what depends on the whole text; the stream reader; tables against grammar.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "dialects/fagor/g_codes.h"
#include "dialects/fagor/operators.h"
#include "dialects/fagor/variables.h"
#include "dialects/fagor/words.h"
#include "dialects/options.h"
#include "frontends/common/word_scanner.h"
#include "frontends/fagor/syntax/parse.h"
#include "frontends/fagor/syntax/scan_table.h"
#include "tests/frontend_fagor/support.h"

namespace cnctrans::fagor {
namespace {

using test::line;
using test::read;

TEST(FagorProgram, Header) {
  const auto r = read("%SHAFT 12 ,MX,\nX1\n");
  EXPECT_EQ(r.program.routines.at(0).title, "SHAFT 12");
  EXPECT_EQ(r.program.routines.at(0).attributes, "MX");
  EXPECT_EQ(r.program.routines.at(0).name.text, "000100");
  EXPECT_EQ(r.codes(), "");
  EXPECT_EQ(read("% ,OMX,\nX1").program.routines.at(0).attributes, "OMX");
  EXPECT_EQ(read("%1001.PIM,M,\r\nX1\r\n").codes(), "");
  EXPECT_EQ(read("%NO COMMAS\nX1").codes(), "FAG-001");
  EXPECT_EQ(read("%THIS COMMENT IS TOO LONG,MX,\nX1").codes(), "FAG-001");
  EXPECT_EQ(read("X1\n%LATE,MX,").codes(), "FAG-032");
}

TEST(FagorProgram, LocalSubroutines) {  // 2.2: before the line that starts the main part
  const auto r = read("%PART ,MX,\n(LSUB 10)\nX1\n(RET)\n%MAIN\n(LL 10)\nM30\n");
  ASSERT_EQ(r.program.routines.size(), 2U);
  EXPECT_EQ(r.codes(), "");
  EXPECT_EQ(r.program.routines[1].name.number, 10);
  EXPECT_EQ(r.program.routines[1].locality, ir::Locality::file_local);
  EXPECT_EQ(r.statements(0), (std::vector<std::string>{"call 10", "end_program returns_from_sub as \"M30\""}));
  EXPECT_EQ(r.statements(1), (std::vector<std::string>{"block modal X 1", "return as \"RET\""}));
  EXPECT_EQ(read("(LSUB 10)\nX1\n(RET)\nX5\n").codes(), "FAG-025 FAG-032");
}

TEST(FagorProgram, Subroutines) {
  const auto r = read("(CALL 5)\nM30\n; about five\n(SUB 5)\nX1\n(IF P1 EQ 0 RET)\nX2\n(RET)\n");
  ASSERT_EQ(r.program.routines.size(), 2U);
  EXPECT_EQ(r.codes(), "");
  EXPECT_EQ(r.statements(0).size(), 3U);  // the comment stays between the two
  EXPECT_EQ(r.statements(1).size(), 4U);
  EXPECT_EQ(read("(SUB 5)\nX1\n").codes(), "FAG-025");
  EXPECT_EQ(read("(SUB 5)\nX1\n(RET)\nX2\nN10 X3\n").codes(), "FAG-025");
  EXPECT_EQ(read("(SUB 5)\nX1\n(RET)\n\nN10 X2\nX3\n").codes(), "");  // a profile, say
  EXPECT_EQ(read("(SUB 5)\n(RET)\n(SUB 5)\n(RET)").codes(), "FAG-025");
  EXPECT_EQ(read("X1\n(RET)").codes(), "FAG-024");
  const auto only = read("%SUBS,MX,\n; text\n(SUB 5)\n(RET)\n");
  ASSERT_EQ(only.program.routines.size(), 1U);
  EXPECT_EQ(only.program.main(), nullptr);
  EXPECT_EQ(only.program.routines[0].title, "SUBS");
  EXPECT_EQ(only.statements(0).size(), 2U);
}

TEST(FagorProgram, SubroutineEndsAtItsFirstReturn) {  // 12.5; what stands behind it is the file's
  const std::string five = "(SUB 5)\nX5\n(RET)\n";
  const auto over = read("(GOTO N100)\n" + five + "N100 X1\n(CALL 5)\nM30\n");
  EXPECT_EQ(over.codes(), "");
  EXPECT_EQ(over.statements(0).size(), 4U);
  EXPECT_EQ(over.statements(1).size(), 2U);
  EXPECT_EQ(read("(CALL 5)\nM30\n" + five + "M30\n").codes(), "") << "nothing leads to the second M30";
  // The subroutine's own jump leads behind its first (RET): it goes on to the next one.
  const auto own = read("(CALL 5)\nM30\n(SUB 5)\n(IF P1 EQ 0 GOTO N10)\n(RET)\nN10 X5\n(RET)\n");
  EXPECT_EQ(own.codes(), "");
  EXPECT_EQ(own.statements(1).size(), 4U);
  // The main part would run on into the (SUB).
  EXPECT_EQ(read("(CALL 5)\n" + five + "X2\nM30\n").codes(), "FAG-025");
  EXPECT_EQ(read("(GOTO N100)\n" + five + "N100 X1\n(RET)\n").codes(), "FAG-024") << "a (RET) of the main part";
  // Modes of the text: G18 stands before the jump.
  const auto plane = read("G18 G0 X0 Z0\n(GOTO N100)\n(SUB 5)\nG17\n(RET)\nN100 G2 X2 Z0 I1 K0 F100\nM30\n");
  EXPECT_EQ(plane.codes(), "");
}

TEST(FagorProgram, Assignments) {
  EXPECT_EQ(line("(P100=P1+2*3)"), "set P[100] = P[1] + (2 * 3)");
  EXPECT_EQ(line("(M30)"), "set P[12] = 30");  // 16.2: a local parameter, not a program end
  EXPECT_EQ(line("(P1=-2 EXP 2)"), "set P[1] = (-2) pow 2") << "unary minus binds stronger";
  EXPECT_EQ(line("(P1=NOT P2 OR P3)"), "set P[1] = (bitnot P[2]) bitor P[3]");
  EXPECT_EQ(line("(P1=P2 GT 3 AND P4 LT 5)"), "set P[1] = (P[2] > 3) and (P[4] < 5)");
  EXPECT_EQ(line("(P(P7)=1)"), "set P[P[7]] = 1");
  EXPECT_EQ(read("(P100=PLCR5)").codes(), "FAG-020");
  EXPECT_EQ(read("(P100=TOOL)").codes(), "");
  EXPECT_EQ(read("(TOOL=5)").codes(), "FAG-021");
  EXPECT_EQ(read("(P100=GAINSET)").codes(), "FAG-019");
  EXPECT_EQ(read("(P99=1)").codes(), "FAG-018");
}

TEST(FagorProgram, Flow) {
  EXPECT_EQ(line("N020 (GOTO N20)"), "N020 jump N20");
  EXPECT_EQ(line("(GOTO NP100)"), "jump at P[100]");
  EXPECT_EQ(line("(RPT N50,N60)N3"), "repeat N50 N60 count 3");
  EXPECT_EQ(line("(PCALL 5, A1, P3=P100, C-18)"), "call 5 (\"A\" = 1, \"D\" = P[100], \"C\" = #-18\"-18\") new_level");
  EXPECT_EQ(line("(CALL P148)"), "call unnamed computed P[148]");
  EXPECT_EQ(line("G180 A5 P1=P100"), "call 180 (\"A\" = 5, \"B\" = P[100]) new_level");
  EXPECT_EQ(line("(MDOFF)"), "modal_call off here");
  EXPECT_EQ(read("(P1=1) N3").codes(), "FAG-016");
  EXPECT_EQ(read("NP1 X5").codes(), "FAG-015") << "a label is no parameter";
  EXPECT_EQ(line("(EXEC P12)"), "call \"12\"");
  EXPECT_EQ(line("(EXEC P(P1+1))"), "call unnamed computed to_string(P[1] + 1)");
  EXPECT_EQ(read("(EXEC P12,HD)").codes(), "FAG-022");
  EXPECT_EQ(read("(EXEC P12)\nM30\n(SUB 12)\n(RET)").codes(), "") << "another program, not the subroutine";
  EXPECT_EQ(read("(WRITE G1 X5)").codes(), "");
  EXPECT_EQ(read("(OPEN P5, A, D)").codes(), "FAG-100");
  EXPECT_EQ(read("(WRITE XP99)").codes(), "FAG-018");
  EXPECT_EQ(read("G72 S2\nX1 B30\nB40").codes(), "FAG-101 FAG-035") << "are degrees multiplied?";
}

TEST(FagorProgram, Messages) {
  EXPECT_EQ(line("(MSG \"T?P100 IN\")"), "message show (\"T\", P[100], \" IN\")");
  EXPECT_EQ(line("(MSG \"  \")"), "message clear (\"  \")");
  EXPECT_EQ(line("(ERROR 5, \"BAD\")"), "message error (\"BAD\") number 5");
}

TEST(FagorProgram, PlaneOfABlockThatNeedsIt) {
  // one plane in the text: sure; two planes and a jump in between: not
  EXPECT_EQ(read("G18\nN10 G81 Z1 X2 Y3 I-5\n(GOTO N20)\nN20 G80").codes(), "");
  EXPECT_EQ(read("G18\nN10 X1\nG81 Z1 X2 Y3 I-5\nG17\n(IF P1 EQ 0 GOTO N10)").codes(), "FAG-026");
  // a subroutine: from its calls; nobody calls it: assumed, with a warning
  EXPECT_EQ(read("G17\n(CALL 1)\nG18\nM30\n(SUB 1)\nG81 X1 Y2 Z3 I-5\n(RET)").codes(), "");
  EXPECT_EQ(read("G17\n(CALL 1)\nG18\n(CALL 1)\nM30\n(SUB 1)\nG81 X1 Y2 Z3 I-5\n(RET)").codes(), "FAG-026");
  EXPECT_EQ(read("M30\n(SUB 1)\nG81 X1 Y2 Z3 I-5\n(RET)").codes(), "FAG-026");
}

TEST(FagorProgram, ControlCharactersAndBlankLines) {
  const auto r = read(std::string("%A,MX,\n\nX1\n\x1a\0", 13));
  EXPECT_EQ(r.codes(), "FAG-031");
  EXPECT_EQ(r.statements(0).size(), 2U);
  EXPECT_EQ(r.stats.blocks, 1U);
}

TEST(FagorProgram, TheCadFileReadsWithoutLoss) {
  const auto path = std::filesystem::path(CNCTRANS_SOURCE_DIR) / "../shared/corpus/fagor/holke-1001.pim";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no corpus at " << path;
  std::string error;
  const auto source = SourceText::open(path.string(), &error);
  ASSERT_TRUE(source) << error;
  const auto r = read(std::string(source->bytes()));
  EXPECT_EQ(r.codes(), "FAG-036");  // blocks lost in an earlier conversion
  EXPECT_EQ(r.stats.lines, source->lines().size());
  EXPECT_EQ(r.stats.blocks_read, r.stats.blocks);
  // every line but the header is a statement; M30 adds none
  std::size_t own = 0;
  for (const auto& s : r.program.routines.at(0).body) own += s.line.joined ? 0 : 1;
  EXPECT_EQ(own + 1, source->lines().size());
}

TEST(FagorStream, SameAsWholeFile) {
  const std::string text =
      "%PART ,MX,\n; c\nN10 G17 G90\n\nG1 X10 Y-5.5 F100\nG3 X0 Y0 I5 J5 ; arc\n/1 M8\nX5 M30\n; end\n";
  const auto whole = read(text, "fagor-mill", frontends::Reader::scanner);
  std::string error;
  const auto machine = dialects::load_profile("fagor-mill", &error);
  ASSERT_TRUE(machine) << error;
  frontends::ReadOptions options;
  options.profile = &*machine;
  const auto stream = frontends::fagor::make_frontend()->stream(1, options, "000100.PIM");
  Diagnostics found;
  std::vector<std::string> got;
  std::string_view rest = text;
  SourceLine l;
  std::uint32_t number = 0;
  ir::Statement s;
  while (take_line(rest, l)) {
    l.number = ++number;
    const auto kind = stream->read(l, s, found);
    ASSERT_NE(kind, frontends::StreamLine::needs_program) << l.text;
    if (kind == frontends::StreamLine::no_statement) continue;
    std::string t = ir::to_text(s, stream->frame());
    while (!t.empty() && t.back() == '\n') t.pop_back();
    got.push_back(t);
    if (kind == frontends::StreamLine::program_end) got.push_back("& end_program returns_from_sub as \"M30\"");
  }
  EXPECT_EQ(got, whole.statements(0));
  EXPECT_EQ(stream->frame().routines.at(0).title, "PART");
  for (const char* each : {"(P1=2)", "XP1 N3", "G92 X0", "X1 #", "G81 X1 Y1 Z1 I-1", "G777", "%", "\x1a"}) {
    SourceLine one;
    one.text = each;
    one.number = 99;
    EXPECT_EQ(stream->read(one, s, found), frontends::StreamLine::needs_program) << each;
  }
}

TEST(FagorTables, EveryMnemonicIsAWordOfTheGrammar) {
  BlockParser parser;
  syntax::Block b;
  ParseError error;
  for (const auto& v : dialects::fagor::variables()) {
    if (v.name == "LUP" || v.name == "GPOS" || v.name == "IB") continue;  // forms of their own
    const std::string name = std::string(v.name) + (v.axis ? "Z" : "");
    const std::string text = "(P1=" + name + (v.index == dialects::fagor::Index::always ? "3" : "") + ")";
    ASSERT_TRUE(parser.parse_block(text, b, error)) << text << error.message;
    ASSERT_EQ(b.statements.at(0).args.size(), 2U) << text;
    EXPECT_EQ(b.statements[0].args[1].text, name);
    EXPECT_EQ(b.statements[0].args[1].args.size(), v.index == dialects::fagor::Index::always ? 1U : 0U) << text;
    EXPECT_EQ(dialects::fagor::find_variable(name).info, &v) << name;
  }
  for (const auto& f : dialects::fagor::functions) {
    const std::string text = "(P1=" + std::string(f.word) + (f.word == "ARG" ? "(1,2))" : "(1))");
    ASSERT_TRUE(parser.parse_block(text, b, error)) << text;
    EXPECT_EQ(b.statements.at(0).args.at(1).text, f.word);
  }
  for (const auto& o : dialects::fagor::operators) {
    ASSERT_TRUE(parser.parse_block("(P1=P2" + std::string(o.word) + "P3)", b, error)) << o.word;
    EXPECT_EQ(b.statements.at(0).args.at(1).text, o.word);
  }
}

// Appendix C: what a program may read and write. Reading one that it may not is a warning, writing one an error (75).
TEST(FagorTables, AccessOfEveryVariable) {
  using dialects::fagor::Access;
  for (const auto& v : dialects::fagor::variables()) {
    std::string name = std::string(v.name) + (v.axis ? "X" : "");
    if (v.index != dialects::fagor::Index::none) name += v.name == "ORG" ? "54" : " 1";
    if (v.name == "GPOS") name = "GPOSX N99 P100";
    if (v.name == "LUP") name = "LUP(1,2)";
    const auto reading = read("%V ,MX,\n(P100=" + name + ")\nM30\n");
    const auto writing = read("%V ,MX,\n(" + name + "=1)\nM30\n");
    const bool reads = v.access == Access::read || v.access == Access::read_write;
    const bool writes = v.access == Access::write || v.access == Access::read_write;
    EXPECT_EQ(reading.codes().find("FAG-021") == std::string::npos, reads) << name;
    EXPECT_FALSE(reading.diagnostics.has_errors()) << name << ": " << reading.codes();
    EXPECT_EQ(writing.codes().find("FAG-021") == std::string::npos, writes) << name;
    EXPECT_EQ(writing.diagnostics.has_errors(), !writes) << name << ": " << writing.codes();
  }
}

TEST(FagorTables, CodesOfBothModels) {
  for (const auto& g : dialects::fagor::g_codes()) {
    const auto model = static_cast<int>(g.model);
    EXPECT_EQ(dialects::fagor::find_g(g.code, true) == &g, (model & 1) != 0) << g.code;
    EXPECT_EQ(dialects::fagor::find_g(g.code, false) == &g, (model & 2) != 0) << g.code;
    EXPECT_FALSE(g.section.empty()) << g.code;
  }
  EXPECT_EQ(dialects::fagor::find_g(43, true), nullptr);
  EXPECT_EQ(dialects::fagor::find_g(151, false), nullptr);
  EXPECT_EQ(dialects::fagor::find_g(400, true), nullptr);
}

/// Random lines of the characters of blocks: where the scanner takes a line, the grammar reads the same.
TEST(FagorReaders, ScannerEqualsGrammarOnRandomLines) {
  std::mt19937 random(8055);
  const std::string alphabet = "GXYZNMFSTDIJKRQLEPA0123456789..--++  \t;/()=,gx\"";
  BlockParser parser;
  syntax::Block a, b;
  ParseError error;
  int scanned = 0;
  for (int i = 0; i < 60000; ++i) {
    std::string text;
    const std::size_t length = random() % 24;
    while (text.size() < length) {
      if (random() % 3 == 0)
        text += alphabet[random() % alphabet.size()];
      else
        text += std::string(1, "GXYZNMFS"[random() % 8]) + std::to_string(random() % 200) + (random() % 2 ? " " : "");
    }
    if (!frontends::scan_plain(text, scan_table, a) || a.skip_mask > 7) continue;
    ++scanned;
    ASSERT_TRUE(parser.parse_block(text, b, error)) << text << ": " << error.message;
    ASSERT_EQ(a, b) << text << "\n" << syntax::dump(a) << syntax::dump(b);
  }
  EXPECT_GT(scanned, 3000);
}

/// Damaged programs: whatever the text, the reader comes back, and no block disappears.
TEST(FagorReaders, DamagedFilesAreReportedNotDropped) {
  const std::vector<std::string> good = {"%A,MX,",
                                         "(LSUB 5)",
                                         "(RET)",
                                         "%MAIN",
                                         "N10 G17 G90",
                                         "G2 X1 Y2 I3 J4 K5",
                                         "G81 G98 X1 Y2 Z3 I-4 K5",
                                         "N20 XP100 YP(3)",
                                         "(IF P1 EQ 2 GOTO N20 ELSE P3=4)",
                                         "(RPT N10,N20) N3",
                                         "(PCALL 7, A1, B=P2)",
                                         "(MSG \"A?P1\")",
                                         "M30",
                                         "(SUB 7)",
                                         "G93 I1 J2",
                                         "G73 Q30",
                                         "G36 R5 X1",
                                         "G158 X1",
                                         "G92 X1 S5",
                                         "G180 A1 P2=3",
                                         "/2 M19 S30",
                                         "G41 N20 X1",
                                         "T1 D2 M6",
                                         "(WRITE G1 (A))",
                                         "G8 X1 Y2",
                                         "(A13.7)",
                                         "(SK1=\"A\",SK2=\"B\")",
                                         "G16 XY",
                                         "G33 Z1 L2 Q3",
                                         "G4",
                                         "G159 N3",
                                         ";c"};
  std::mt19937 random(1055);
  for (int file = 0; file < 150; ++file) {
    std::string text;
    std::size_t lines = 0;
    for (; lines < 40; ++lines) {
      std::string one = good[random() % good.size()];
      for (std::size_t edits = random() % 3; edits > 0 && !one.empty(); --edits) {
        const std::size_t at = random() % one.size();
        if (random() % 2 == 0)
          one.erase(at, 1 + random() % 3);
        else
          one.insert(at, 1, static_cast<char>(random() % 96 + 32));
      }
      text += one + "\n";
    }
    const auto r = read(text, file % 2 == 0 ? "fagor-mill" : "fagor-lathe");
    EXPECT_EQ(r.stats.lines, lines);
    EXPECT_TRUE(r.stats.blocks_read == r.stats.blocks || r.diagnostics.has_errors());
    for (const auto& d : r.diagnostics.all()) EXPECT_NE(d.code, "CNC-READERS") << d.hint;
  }
}

}  // namespace
}  // namespace cnctrans::fagor
