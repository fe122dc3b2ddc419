// The textual form: every field of every node survives print -> read. The JSON form, written by other code, is witness.
#include "ir/text/text.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "ir/text/enum_names.h"
#include "tests/support/random_program.h"

namespace cnctrans::ir {
namespace {

Program read_all(const std::string& text) {
  Diagnostics diagnostics;
  Program p = from_text(text, 1, diagnostics);
  for (const auto& d : diagnostics.all()) {
    ADD_FAILURE() << d.span.line << ":" << d.span.column << " " << d.message << "\n";
  }
  return p;
}

/// The first line in which two texts differ, for a readable failure.
std::string first_difference(const std::string& a, const std::string& b) {
  std::size_t at = 0;
  while (at < a.size() && at < b.size() && a[at] == b[at]) ++at;
  const std::size_t from = at > 200 ? at - 200 : 0;
  return a.substr(from, 400) + "\n-----\n" + b.substr(from, 400);
}

class RoundTrip : public ::testing::TestWithParam<bool> {};

TEST_P(RoundTrip, EveryFieldOfRandomPrograms) {
  test::RandomOptions random;
  random.places = GetParam();
  const PrintOptions print{GetParam()};
  for (unsigned seed = 1; seed <= (GetParam() ? 100U : 200U); ++seed) {
    const Program p = test::random_program(seed, random);
    const std::string text = to_text(p, print);
    const Program q = read_all(text);
    ASSERT_EQ(text, to_text(q, print)) << "seed " << seed << "\n" << first_difference(text, to_text(q, print));
    std::string where;
    ASSERT_TRUE(same_program(p, q, &where)) << "seed " << seed << ": " << where;
    if (GetParam() && seed <= 60) {
      ASSERT_EQ(to_json(p), to_json(q)) << "seed " << seed << "\n" << first_difference(to_json(p), to_json(q));
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Places, RoundTrip, ::testing::Bool());

// --- no field may be forgotten in ir/fields.h ---------------------------------------------------------------------

/// Converts to anything: to count how many initialisers an aggregate takes.
struct Anything {
  template <class T>
  operator T() const;  // NOLINT
};
template <class T, class... Args>
constexpr std::size_t member_count() {
  if constexpr (requires { T{Args{}..., Anything{}}; }) {
    return member_count<T, Args..., Anything>();
  } else {
    return sizeof...(Args);
  }
}

/// Counts the members that fields() names.
struct Counter {
  std::size_t n = 0;
  void word(std::string_view) {}
  template <class T>
  void item(std::string_view, T&) {
    ++n;
  }
  template <class T, class D = int>
  void opt(std::string_view, T&, const D& = D{}) {
    ++n;
  }
  template <class E>
  void bare(std::string_view, E&, E) {
    ++n;
  }
  void flag(std::string_view, bool& x) {
    ++n;
    x = true;
  }
  void flag_off(std::string_view, std::string_view, bool&) { ++n; }
  template <class T>
  void given(std::string_view, bool&, T&) {
    n += std::same_as<T, Level> ? 1 : 2;
  }
  void axis(std::string_view, AxisId&) { ++n; }
  void axis_opt(std::string_view, AxisId&) { ++n; }
  void pos(WordPos&) { ++n; }
  void place(std::string_view, WordPos&) { ++n; }
  void quoted(std::string_view, std::string_view&) { ++n; }
  void code(bool&, std::string_view&) { n += 2; }
  template <class T>
  void words(std::string_view, T&) {
    ++n;
  }
  template <class T>
  void each(std::string_view, T&) {
    ++n;
  }
  template <class T>
  void exprs(std::string_view, T&) {
    ++n;
  }
  template <class T>
  void pairs(std::string_view, T&) {
    ++n;
  }
  template <class T>
  void group(std::string_view, T&) {
    ++n;
  }
  template <class T>
  void pointer(std::string_view, T&) {
    ++n;
  }
  template <class T>
  void target(std::string_view, T&) {
    ++n;
  }
  void label(std::string_view, LabelRef&) { ++n; }
  void routine_name(std::string_view, RoutineName&) { ++n; }
  void space(std::string_view, SpaceId&) { ++n; }
  void setting(ModalSet&) { n += 2; }
  template <class T>
  void action(T&) {
    ++n;
  }
  template <class T>
  void cycle(T&) {
    ++n;
  }
  void body(std::string_view, Body&, LineInfo&) { n += 2; }
  void then_else(If&) { n += 5; }
  template <class T>
  void arguments(std::string_view, T&) {
    ++n;
  }
  template <class T>
  void declared(std::string_view, T&) {
    ++n;
  }
  template <class T>
  void cases(std::string_view, T&) {
    ++n;
  }
  template <class T>
  void assignments(std::string_view, T&) {
    ++n;
  }
};

template <class T>
void expect_complete(const char* name, std::size_t left_out = 0) {
  T x{};
  Counter c;
  detail::fields(c, x);
  EXPECT_EQ(c.n + left_out, (member_count<T>())) << name << " has members that ir/fields.h does not name";
}

TEST(Fields, NoMemberIsForgotten) {
  expect_complete<CoordWord>("CoordWord");
  expect_complete<CenterWord>("CenterWord");
  expect_complete<MotionExtra>("MotionExtra");
  expect_complete<Motion>("Motion");
  expect_complete<ModalSet>("ModalSet");
  expect_complete<SetFeed>("SetFeed");
  expect_complete<SetSpindle>("SetSpindle");
  expect_complete<SpindleRun>("SpindleRun");
  expect_complete<SpindleOrient>("SpindleOrient");
  expect_complete<SpindleLimit>("SpindleLimit");
  expect_complete<SpindleGear>("SpindleGear");
  expect_complete<MasterSpindle>("MasterSpindle");
  expect_complete<ToolSelect>("ToolSelect");
  expect_complete<ToolOffset>("ToolOffset");
  expect_complete<WorkOffset>("WorkOffset");
  expect_complete<FrameWord>("FrameWord");
  expect_complete<FrameChange>("FrameChange");
  expect_complete<Dwell>("Dwell");
  expect_complete<Coolant>("Coolant");
  expect_complete<MachineFunction>("MachineFunction");
  expect_complete<Stop>("Stop");
  expect_complete<CycleDefine>("CycleDefine");
  expect_complete<Corner>("Corner");
  expect_complete<TangentialEnd>("TangentialEnd");
  expect_complete<OpaqueWord>("OpaqueWord");
  expect_complete<SplineAxis>("SplineAxis");
  expect_complete<SplineAxes>("SplineAxes");
  expect_complete<SurfaceSet>("SurfaceSet");
  expect_complete<PolynomialWord>("PolynomialWord");
  expect_complete<Action>("Action");
  expect_complete<Level>("Level", 1);
  expect_complete<Pecks>("Pecks");
  expect_complete<HoleCycle>("HoleCycle");
  expect_complete<NamedCycle>("NamedCycle");
  expect_complete<If>("If");
  expect_complete<While>("While");
  expect_complete<Until>("Until");
  expect_complete<For>("For");
  expect_complete<Loop>("Loop");
  expect_complete<Jump>("Jump");
  expect_complete<Switch>("Switch");
  expect_complete<Repeat>("Repeat");
  expect_complete<Argument>("Argument");
  expect_complete<CallRoutine>("CallRoutine");
  expect_complete<ModalCall>("ModalCall");
  expect_complete<Return>("Return");
  expect_complete<End>("End");
  expect_complete<Message>("Message");
  expect_complete<Declare>("Declare");
  expect_complete<Opaque>("Opaque");
  expect_complete<SpaceSegment>("SpaceSegment");
  expect_complete<VariableSpace>("VariableSpace");
  expect_complete<Parameter>("Parameter");
  expect_complete<Routine>("Routine", 2);  // header and body
  expect_complete<FileLook>("FileLook");
  expect_complete<Program>("Program", 5);  // axis names, spaces, files, routines, texts
  // These have a form of their own in the printer; a new member must be added there and here.
  EXPECT_EQ((member_count<Block>()), 5U);
  EXPECT_EQ((member_count<LineInfo>()), 8U);
  EXPECT_EQ((member_count<CommentText>()), 3U);
  EXPECT_EQ((member_count<LabelRef>()), 3U);
  EXPECT_EQ((member_count<RoutineName>()), 2U);
  EXPECT_EQ((member_count<Assign::Item>()), 5U);
  EXPECT_EQ((member_count<Declare::Item>()), 3U);
  EXPECT_EQ((member_count<VarRef>()), 4U);
  EXPECT_EQ((member_count<SystemRef>()), 5U);
  EXPECT_EQ((member_count<Number>()), 3U);
  EXPECT_EQ((member_count<Unary>()), 2U);
  EXPECT_EQ((member_count<Binary>()), 4U);
  EXPECT_EQ((member_count<Call>()), 3U);
  EXPECT_EQ((member_count<Expr>()), 3U);
  EXPECT_EQ((member_count<Statement>()), 3U);
}

TEST(Keywords, OfSettingsActionsAndMotionsDiffer) {
  std::set<std::string_view> seen{"times"};
  for (std::size_t i = 1; i < detail::action_names.size(); ++i) {
    EXPECT_TRUE(seen.insert(detail::action_names[i]).second) << detail::action_names[i];
  }
  for (std::size_t i = 0; i < setting_count; ++i) EXPECT_TRUE(seen.insert(name(static_cast<Setting>(i))).second) << i;
  for (std::size_t i = 0; i < detail::EnumText<MotionKind>::count; ++i) {
    EXPECT_TRUE(seen.insert(name(static_cast<MotionKind>(i))).second) << name(static_cast<MotionKind>(i));
  }
}

// --- the form itself ----------------------------------------------------------------------------------------------

TEST(Text, LooksAsDocumented) {
  const std::string text =
      "program \"x\" lathe\n"
      "space P \"P\" starts_at_zero segment 0 25 level forgotten segment 100 299\n"
      "routine main 10 \"FLANGE\" title \"A flange\" {\n"
      "  N10 block plane xy as \"G17\", feed 200, linear as \"G1\" X absolute 10.500 Y #-3 Z (P[1] * 2), stop after ; "
      "\"cut\"\n"
      "  N20 set P[100] = P[101] + (2 * sin(30))\n"
      "\n"
      "  /1 LOOP: while P[100] < 10 {\n"
      "    block arc_cw X 5 centre X 1 centre Y absolute 2\n"
      "    & jump N20 if P[1] ==~ 0 search backward\n"
      "  }\n"
      "  N30 end_program as \"M30\"\n"
      "}\n";
  EXPECT_EQ(to_text(read_all(text)), text);
}

TEST(Text, TheExampleInTheDocumentationIsAsPrinted) {
  std::ifstream file(CNCTRANS_SOURCE_DIR "/docs/ir.md");
  const std::string doc{std::istreambuf_iterator<char>(file), {}};
  const auto begin = doc.find("```\n") + 4;
  const std::string example = doc.substr(begin, doc.find("```", begin) - begin);
  ASSERT_GT(example.size(), 300U);
  EXPECT_EQ(to_text(read_all(example)), example);
}

TEST(Text, NumberTextsAndPassMadeNumbersDiffer) {
  const Program p = read_all("program \"\"\nroutine main 1 {\n  block linear X 10.500 Y #10.5\n}\n");
  const auto& words = std::get<Block>(p.routines.at(0).body.at(0).node).motion.coords;
  EXPECT_EQ(words.at(0).value.number, 10.5);
  EXPECT_EQ(words.at(0).value.text, "10.500");
  EXPECT_EQ(words.at(1).value.number, 10.5);
  EXPECT_EQ(words.at(1).value.text, "");
}

TEST(Text, PeopleMayLeaveOutParentheses) {
  const std::string body = "program \"\"\nspace R \"R\" segment 0 99\nroutine main 1 {\n  set R[1] = ";
  const auto printed = [&](const std::string& e) { return to_text(read_all(body + e + "\n}\n")); };
  EXPECT_EQ(printed("1 + R[2] * 3"), printed("1 + (R[2] * 3)"));
  EXPECT_EQ(printed("1 - 2 - 3"), printed("(1 - 2) - 3"));
  EXPECT_EQ(printed("-2 pow 2"), printed("(-2) pow 2"));
  EXPECT_NE(printed("-2 pow 2"), printed("-(2 pow 2)"));
  EXPECT_EQ(printed("not R[1] == 2 and R[3] > 4"), printed("((not R[1]) == 2) and (R[3] > 4)"));
}

TEST(Text, FaultsAreReportedAtTheirPlaceAndTheRestIsRead) {
  Diagnostics diagnostics;
  const Program p = from_text(
      "program \"\"\nroutine main 1 {\n  block linear X ]\n  while nonsense( {\n    exit\n  }\n  frobnicate\n  "
      "exit\n}\n",
      3, diagnostics);
  ASSERT_EQ(diagnostics.all().size(), 3U);
  EXPECT_EQ(diagnostics.all()[0].code, "IR-001");
  EXPECT_EQ(diagnostics.all()[0].span, (Span{3, 3, 18, 3, 19}));
  EXPECT_EQ(diagnostics.all()[1].span.line, 4U);
  EXPECT_EQ(diagnostics.all()[2].span.line, 7U);
  const auto& body = p.routines.at(0).body;
  ASSERT_EQ(body.size(), 4U);
  EXPECT_EQ(std::get<Opaque>(body[0].node).text, "block linear X ]");
  EXPECT_EQ(std::get<While>(body[1].node).body.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<Opaque>(body[2].node));
  EXPECT_TRUE(std::holds_alternative<Exit>(body[3].node));
}

TEST(Text, ReaderSurvivesDamagedText) {
  test::RandomOptions options;
  options.statements = 6;
  std::mt19937 random(7);
  for (unsigned seed = 1; seed <= 150; ++seed) {
    std::string text = to_text(test::random_program(seed, options));
    for (int cuts = 0; cuts < 5; ++cuts) {
      const std::size_t at = random() % text.size();
      if (random() % 2 == 0) {
        text.erase(at, random() % 20);
      } else {
        text.insert(at, 1, "{}()\"#;,:N.@-"[random() % 13]);
      }
      if (text.empty()) break;
    }
    Diagnostics diagnostics;
    const Program p = from_text(text, 1, diagnostics);
    const std::string printed = to_text(p);
    const Program q = from_text(printed, 1, diagnostics);
    EXPECT_EQ(to_text(q), printed) << "seed " << seed << first_difference(printed, to_text(q));
  }
}

TEST(Text, DeepNestingIsRefusedNotACrash) {
  Diagnostics diagnostics;
  const std::string deep = "program \"\"\nroutine main 1 {\n  set v = " + std::string(100000, '(') + "\n}\n";
  EXPECT_EQ(from_text(deep, 1, diagnostics).routines.size(), 1U);
  EXPECT_EQ(diagnostics.error_count(), 1U);
}

TEST(SameProgram, TellsTheFirstDifferenceWithBothSides) {
  const std::string head = "program \"\"\nroutine main 7 \"BORE\" {\n  block rapid X 1\n";
  const Program a = read_all(head + "  block linear X 2 ; \"cut\"\n}\n");
  const Program b = read_all(head + "  block linear X 3 ; \"cut\"\n}\n");
  const Program c = read_all(head + "  block linear X 2 ; \"other\"\n}\n");
  std::string where;
  EXPECT_FALSE(same_program(a, b, &where));
  EXPECT_EQ(where, "routine BORE, line 3: block linear X 2 ; \"cut\" | block linear X 3 ; \"cut\"");
  EXPECT_FALSE(same_program(a, c, nullptr));
  EXPECT_TRUE(same_program(a, a, &where));
}

TEST(Json, IsValidAndNamesTheNodes) {
  const Program p = read_all("program \"d\"\nroutine main 1 {\n  N10 block linear X 10.500, feed 2 after\n}\n");
  const std::string json = to_json(p);
  EXPECT_NE(json.find("\"dialect\": \"d\""), std::string::npos);
  EXPECT_NE(json.find("\"text\": \"10.500\""), std::string::npos);
  EXPECT_NE(json.find("\"order\": \"after\""), std::string::npos);
}

}  // namespace
}  // namespace cnctrans::ir
