// The writer skeleton with the smallest language there is: words, G0 G1, a comment mark; everything else is refused.
#include <gtest/gtest.h>

#include "backends/common/program_writer.h"

namespace cnctrans::backends {
namespace {

using ir::Value;

constexpr std::array codes{MotionCode{ir::MotionKind::rapid, "G0"}, MotionCode{ir::MotionKind::linear, "G1"},
                           MotionCode{ir::MotionKind::arc_cw, "G2"}};
constexpr std::array settings{ModalCode{ir::Setting::distance, code_value(ir::Distance::incremental), "G91"}};
constexpr std::array<std::string_view, 1> marks{"/"};
constexpr Style small{.dialect = "small",
                      .comment = {.open = "(", .close = ")", .ascii = true, .forbidden = ")", .instead = "]"},
                      .modal_codes = settings,
                      .motion_codes = codes,
                      .kept_decimals = 3,
                      .made_decimals = 3,
                      .two_digit_m = true,
                      .only_label = ";",
                      .skip_marks = marks};

class NoExpressions final : public ExpressionPrinter {
 public:
  explicit NoExpressions(const ir::Program& p) : ExpressionPrinter(p, style(), {}) {}
  static const ExpressionStyle& style() {
    static const ExpressionStyle s;
    return s;
  }

 protected:
  std::string variable(const ir::ExprPtr& e, const ir::VarRef& /*v*/) override {
    problem(e, "no variables");
    return {};
  }
};

class SmallWriter final : public ProgramWriter {
 public:
  SmallWriter(const ir::Program& p, const WriteOptions& o, Diagnostics& d)
      : ProgramWriter(p, o, small, d), printer_(p) {}

 protected:
  void write_program() override {
    open_file("small", true);
    start_routine(0);
    body(routine().body);
  }
  ExpressionPrinter& expressions() override { return printer_; }
  std::string word(std::string_view address, const Value& v, WordPos pos) override {
    return std::string(address) + (v.literal() ? number_text(v) : expression_text(v.expr, pos));
  }

 private:
  NoExpressions printer_;
};

struct Fixture {
  ir::Program program;
  WriteOptions options;
  machine::Profile profile;
  Diagnostics diagnostics;
  Fixture() {
    program.dialect = "elsewhere";
    program.routines.emplace_back();
    profile.m_codes.push_back({5, machine::MMeaning::spindle_stop, ir::Order::after, 0, "stop"});
    options.profile = &profile;
  }
  ir::Statement& add(ir::StatementNode node) {
    ir::Statement s;
    s.node = std::move(node);
    program.routines[0].body.push_back(std::move(s));
    return program.routines[0].body.back();
  }
  std::string text() { return SmallWriter(program, options, diagnostics).write().front().text; }
};

ir::Block line(ir::MotionKind kind, double x, std::string_view text = {}) {
  ir::Block b;
  b.has_motion = true;
  b.motion.kind = kind;
  b.motion.explicit_code = true;
  ir::CoordWord w;
  w.value = Value(x, text);
  b.motion.coords.push_back(w);
  return b;
}
template <class Data>
ir::Action action(Data d, ir::Order order = ir::Order::before) {
  ir::Action a;
  a.data = std::move(d);
  a.order = order;
  return a;
}

TEST(ProgramWriter, WhatADialectDoesNotOverrideIsRefused) {
  const std::vector<ir::StatementNode> all{ir::Assign{}, ir::If{},     ir::While{},       ir::Until{},
                                           ir::For{},    ir::Loop{},   ir::Exit{},        ir::Jump{},
                                           ir::Switch{}, ir::Repeat{}, ir::CallRoutine{}, ir::ModalCall{},
                                           ir::Return{}, ir::End{},    ir::Message{},     ir::Declare{}};
  for (const auto& node : all) {
    Fixture f;
    f.add(node);
    f.text();
    EXPECT_EQ(f.diagnostics.error_count(), 1U) << node.index();
  }
}

TEST(ProgramWriter, ActionsWithoutCounterpartAreRefused) {
  const std::vector<ir::ActionData> all{ir::SpindleOrient{},
                                        ir::SpindleLimit{},
                                        ir::WorkOffset{},
                                        ir::FrameOp{},
                                        ir::PoleSet{},
                                        ir::Dwell{},
                                        ir::ExactStopBlock{},
                                        ir::CycleDefine{},
                                        ir::CycleCancel{},
                                        ir::Corner{},
                                        ir::TangentialEnd{},
                                        ir::OpaqueWord{},
                                        ir::SurfaceSet{ir::Surface::face, {}},
                                        ir::SplineAxes{},
                                        ir::SetSpindle{2, {}},
                                        ir::SpindleRun{2, {}},
                                        ir::ModalSet{ir::Setting::plane, 0, true, {}}};
  for (const auto& data : all) {
    Fixture f;
    ir::Block b;
    b.actions.push_back(action(data));
    f.add(b);
    f.text();
    EXPECT_EQ(f.diagnostics.error_count(), 1U) << data.index();
  }
}

TEST(ProgramWriter, FeedZeroThatMeansTheGreatestFeedIsRefused) {
  Fixture f;
  ir::Block b = line(ir::MotionKind::linear, 1);
  b.actions.push_back(action(ir::SetFeed{Value(0), true}));
  f.add(b);
  f.text();
  EXPECT_TRUE(f.diagnostics.has_errors());
}

TEST(ProgramWriter, RoundingIsReportedOnceWithItsSize) {
  Fixture f;
  f.add(line(ir::MotionKind::linear, 1.23456, "1.23456"));
  f.add(line(ir::MotionKind::linear, 2.00051, "2.00051"));
  EXPECT_EQ(f.text(), "G1 X1.235\nG1 X2.001\n");
  ASSERT_EQ(f.diagnostics.all().size(), 1U);
  EXPECT_EQ(f.diagnostics.all()[0].code, "TRN-210");
  EXPECT_NE(f.diagnostics.all()[0].message.find("0.0005"), std::string::npos);
}

TEST(ProgramWriter, AnMCodeOfTheOtherSideOfTheMotionStandsAlone) {
  Fixture f;
  ir::Block b = line(ir::MotionKind::linear, 1);
  b.actions.push_back(action(ir::SpindleRun{1, ir::SpindleState::off}, ir::Order::before));  // after the motion here
  auto& s = f.add(b);
  s.line.number = "10";
  s.line.skip_mask = 1;
  EXPECT_EQ(f.text(), "/N10 M05\n/G1 X1\n");
}

TEST(ProgramWriter, ALabelAloneGetsItsMark) {
  Fixture f;
  f.add(ir::Label{}).line.number = "20";
  EXPECT_EQ(f.text(), "N20 ;\n");
}

TEST(ProgramWriter, ASkipLevelThatDoesNotExistIsRefused) {
  Fixture f;
  f.add(line(ir::MotionKind::rapid, 1)).line.skip_mask = 4;
  f.text();
  EXPECT_TRUE(f.diagnostics.has_errors());
}

TEST(ProgramWriter, OwnSpellingIsKept) {
  Fixture f;
  f.program.dialect = "small";
  ir::Block b = line(ir::MotionKind::linear, 10.5, "+10.50000");
  b.motion.code_text = "G01";
  b.actions.push_back(action(ir::SpindleRun{1, ir::SpindleState::cw}));
  b.actions.back().text = "M03";
  auto& s = f.add(b);
  s.line.comments.push_back({" Fr\xC3\xA4sen", ir::CommentPlace::end_of_line, {}});
  EXPECT_EQ(f.text(), "G01 X+10.50000 M03 ( Fr\xC3\xA4sen)\n");
}

TEST(ProgramWriter, AWordWithSeveralMeaningsIsWrittenOnce) {
  Fixture f;
  f.program.dialect = "small";
  ir::Block b;
  for (int i = 0; i < 2; ++i) {
    b.actions.push_back(action(ir::MachineFunction{}));
    b.actions.back().text = "M13";
    b.actions.back().pos = {4, 3};
  }
  f.add(b);
  EXPECT_EQ(f.text(), "M13\n");
}

TEST(ProgramWriter, SourceLinesBesideTheTranslation) {
  Fixture f;
  f.options.annotate = true;
  f.program.texts->hold(SourceText::from_string("in", "first\nL X+5 R0 F (A)\n"));
  ir::FileLook look;
  look.file = 3;
  look.name = "in";
  f.program.files.push_back(look);
  f.add(line(ir::MotionKind::linear, 5)).line.span = {3, 2, 1, 2, 10};
  EXPECT_EQ(f.text(), "(< L X+5 R0 F (A])\nG1 X5\n");
}

// --- lines ------------------------------------------------------------------------------------------------------

TEST(Lines, HaveTheirWordsInTheOrderOfTheSource) {
  Fixture f;
  ir::Block b = line(ir::MotionKind::linear, 10.5, "+10.50");
  b.motion.code_pos = {5, 2};
  b.motion.coords[0].pos = {8, 6};
  b.actions.push_back(action(ir::SetFeed{Value(200, "200"), false}));
  b.actions.back().pos = {1, 4};
  b.actions.push_back(action(ir::MachineFunction{}));
  std::get<ir::MachineFunction>(b.actions.back().data).code = 77;
  b.actions.back().pos = {20, 3};
  auto& s = f.add(b);
  s.line.number = "0010";
  s.line.comments.push_back({"a) b", ir::CommentPlace::end_of_line, {}});
  s.line.blank_lines_before = 1;
  f.add(line(ir::MotionKind::modal, -3, "-3."));
  f.add(ir::Block{}).line.comments.push_back({"alone", ir::CommentPlace::own_line, {}});
  EXPECT_EQ(f.text(), "\nN0010 F200 G1 X10.50 M77 (a] b)\nX-3.\n(alone)\n");
}

TEST(Lines, RoundWithAWarning) {
  Fixture f;
  f.add(line(ir::MotionKind::linear, 1.23456, "1.23456"));
  f.add(line(ir::MotionKind::linear, 0.1234567));
  EXPECT_EQ(f.text(), "G1 X1.235\nG1 X0.123\n");
  EXPECT_EQ(f.diagnostics.warning_count(), 1U);
}

TEST(Lines, NumberTextsOfAllLengths) {
  for (const std::string text :
       {"1",     "-1",    "12",     "1.",    ".5",      "-.5",      "123",      "1.5",       "1234",
        "12.5",  "-12.5", "1234.",  "12.34", "123.456", "-123.456", "1234.567", "12345.678", "123456789.125",
        "+7.25", "00012", "1.50000"}) {
    Fixture f;
    f.add(line(ir::MotionKind::linear, std::stod(text), text));
    EXPECT_EQ(f.text(), "G1 X" + (text == "1.50000" ? "1.5" : text.substr(text[0] == '+' ? 1 : 0)) + "\n");
  }
  for (const std::string text :
       {"1.2.3", "12-3", "$1F", "1EX2", "--12", "1 23"}) {  // no plain numbers: made from the value
    Fixture f;
    f.add(line(ir::MotionKind::linear, 42, text));
    EXPECT_EQ(f.text(), "G1 X42\n") << text;
  }
}

TEST(Lines, NumbersMadeAnew) {
  Fixture f;
  f.options.numbering = Numbering::renumber;
  f.options.number_step = 5;
  f.add(line(ir::MotionKind::linear, 1)).line.number = "100";
  f.add(line(ir::MotionKind::linear, 2));
  EXPECT_EQ(f.text(), "N5 G1 X1\nN10 G1 X2\n");
}

}  // namespace
}  // namespace cnctrans::backends
