// The JSON form of every event, key by key, and the stream runner.
#include "interpreter/trace/trace.h"

#include <nlohmann/json.hpp>

#include "tests/interpreter/run_ir.h"

namespace cnctrans::interpreter {
namespace {

class Json : public ::testing::Test {
 protected:
  Json() { files_.add_name("part.pim"); }
  std::string json(const Event& e) const { return to_json(e, files_, {"Q1"}); }
  static Event event(EventKind k) {
    Event e;
    e.kind = k;
    e.file = 1;
    e.line = 12;
    e.to.known = 0b101;
    e.to.value[0] = 1.5;
    e.to.value[2] = -0.0;
    return e;
  }
  FileTable files_;
};

TEST_F(Json, Motion) {
  EXPECT_EQ(json(event(EventKind::rapid)), R"({"event":"rapid","file":"part.pim","line":12,"to":{"X":1.5,"Z":0}})");
  auto e = event(EventKind::linear);
  e.feed = 0.1;
  e.feed_mode = ir::FeedMode::per_rev;
  EXPECT_EQ(
      json(e),
      R"({"event":"linear","file":"part.pim","line":12,"to":{"X":1.5,"Z":0},"feed":{"value":0.1,"mode":"per_rev"}})");
  e = event(EventKind::arc);
  e.plane = ir::Plane::zx;
  e.center_u = 3;
  e.center_v = 4;
  e.cw = true;
  e.turns = 2;
  EXPECT_EQ(
      json(e),
      R"({"event":"arc","file":"part.pim","line":12,"to":{"X":1.5,"Z":0},"plane":"ZX","center":{"X":4,"Z":3},"cw":true,)"
      R"("turns":2,"feed":{"value":0,"mode":"per_minute"}})");
  e = event(EventKind::thread);
  e.pitch = 1.5;
  EXPECT_EQ(
      json(e),
      R"({"event":"thread","file":"part.pim","line":12,"to":{"X":1.5,"Z":0},"pitch":1.5,"pitch_change":0,"start_angle":0})");
  e = event(EventKind::probe);
  e.change = true;
  EXPECT_EQ(
      json(e),
      R"({"event":"probe","file":"part.pim","line":12,"to":{"X":1.5,"Z":0},"feed":{"value":0,"mode":"per_minute"},"toward":true})");
  e = event(EventKind::rapid);
  e.to.known = 1U << ir::axis::first_extra;
  EXPECT_EQ(json(e), R"({"event":"rapid","file":"part.pim","line":12,"to":{"Q1":0}})");
}

TEST_F(Json, Others) {
  auto e = event(EventKind::dwell);
  e.amount = 2.5;
  EXPECT_EQ(json(e), R"({"event":"dwell","file":"part.pim","line":12,"seconds":2.5})");
  e.revolutions = true;
  EXPECT_EQ(json(e), R"({"event":"dwell","file":"part.pim","line":12,"revolutions":2.5})");
  EXPECT_EQ(json(event(EventKind::feed_stop)), R"({"event":"feed_stop","file":"part.pim","line":12})");
  e = event(EventKind::spindle);
  e.number = 1;
  e.state = "cw";
  e.css = true;
  e.value = 180;
  EXPECT_EQ(json(e),
            R"({"event":"spindle","file":"part.pim","line":12,"number":1,"state":"cw","mode":"css","value":180})");
  e.has_limit = true;
  e.limit = 3000;
  e.state = "oriented";
  e.angle = 90;
  EXPECT_EQ(
      json(e),
      R"({"event":"spindle","file":"part.pim","line":12,"number":1,"state":"oriented","mode":"css","value":180,"limit":3000,"angle":90})");
  e = event(EventKind::tool);
  e.number = 4;
  e.change = true;
  EXPECT_EQ(json(e), R"({"event":"tool","file":"part.pim","line":12,"number":4,"change":true})");
  e.text = "MILL";
  EXPECT_EQ(json(e), R"({"event":"tool","file":"part.pim","line":12,"name":"MILL","change":true})");
  e = event(EventKind::offset);
  e.number = 7;
  EXPECT_EQ(json(e), R"({"event":"offset","file":"part.pim","line":12,"number":7})");
  e = event(EventKind::comp);
  e.state = "left";
  EXPECT_EQ(json(e), R"({"event":"comp","file":"part.pim","line":12,"side":"left"})");
  e = event(EventKind::coolant);
  e.state = "flood";
  EXPECT_EQ(json(e), R"({"event":"coolant","file":"part.pim","line":12,"state":"flood"})");
  e = event(EventKind::m);
  e.number = 41;
  EXPECT_EQ(json(e), R"({"event":"m","file":"part.pim","line":12,"code":41})");
  e = event(EventKind::stop);
  e.optional_stop = true;
  EXPECT_EQ(json(e), R"({"event":"stop","file":"part.pim","line":12,"optional":true})");
  e = event(EventKind::end);
  EXPECT_EQ(json(e), R"({"event":"end","file":"part.pim","line":12,"reason":"program_end"})");
  e.reason = EndReason::error;
  e.code = "RUN-001";
  e.text = "division by zero";
  EXPECT_EQ(
      json(e),
      R"({"event":"end","file":"part.pim","line":12,"reason":"error","code":"RUN-001","text":"division by zero"})");
}

TEST_F(Json, TextsAreEscapedAndAlwaysUtf8) {
  auto e = event(EventKind::message);
  e.text = "a\"b\\c\x01\td\xE9";  // Windows-1252
  const auto parsed = nlohmann::json::parse(json(e));
  EXPECT_EQ(parsed["text"], "a\"b\\c\x01\td\u00e9");
  e.text = "caf\u00e9";
  EXPECT_EQ(nlohmann::json::parse(json(e))["text"], "caf\u00e9");
}

TEST_F(Json, NumbersReadBackToTheSameDouble) {
  for (const double x : {0.1, 1e-7, 123456.789, -2.0 / 3, 1e300}) {
    auto e = event(EventKind::dwell);
    e.amount = x;
    EXPECT_EQ(nlohmann::json::parse(json(e))["seconds"].get<double>(), x);
  }
}

// --- streams -------------------------------------------------------------------------------------------------------

TEST(Stream, GivesTheSameEventsAsTheWholeProgram) {
  const std::string text =
      "block units inch, rapid X 1 Y 2\nblock feed 3, linear X incremental 1\nblock corner round 0.1, linear Y "
      "5\nblock linear X 0\n"
      "block arc_cw X 1 Y 5 centre X 0.5\nmessage show (\"hello\")\nblock stop\nend_program";
  const auto p = program_of(std::string(spaces) + "routine main 1 {\n" + text + "\n}\n");
  const auto whole = run_program(p, mill());
  TraceRecorder sink;
  Diagnostics diagnostics;
  const auto profile = mill();
  BlockRunner runner(profile, {}, sink, diagnostics);
  Span last;
  for (const auto& s : p.routines[0].body) {
    last = s.line.span;
    if (!runner.step(s)) break;
  }
  const auto result = runner.finish(last);
  EXPECT_EQ(result.reason, EndReason::program_end);
  FileTable files;
  files.add_name("x");
  ASSERT_EQ(sink.events.size(), whole.events.size());
  for (std::size_t i = 0; i < sink.events.size(); ++i)
    EXPECT_EQ(to_json(sink.events[i], files, {}), to_json(whole.events[i], files, {}));
}

TEST(Stream, EndsAtAnErrorOrALimit) {
  const auto p =
      program_of(std::string(spaces) + "routine main 1 {\nblock rapid X 1\nblock rapid X (R[1])\nblock rapid X 3\n}\n");
  TraceRecorder sink;
  Diagnostics diagnostics;
  const auto profile = mill();
  BlockRunner runner(profile, {}, sink, diagnostics);
  EXPECT_TRUE(runner.step(p.routines[0].body[0]));
  EXPECT_FALSE(runner.step(p.routines[0].body[1]));
  EXPECT_FALSE(runner.step(p.routines[0].body[2]));
  EXPECT_EQ(runner.finish({}).error_code, "RUN-042");
  EXPECT_EQ(sink.events.size(), 2U);
  EXPECT_EQ(diagnostics.error_count(), 1U);
  Options o;
  o.max_events = 1;
  TraceRecorder few;
  BlockRunner limited(profile, o, few, diagnostics);
  EXPECT_TRUE(limited.step(p.routines[0].body[0]));
  EXPECT_FALSE(limited.step(p.routines[0].body[2]));
  EXPECT_EQ(limited.finish({}).reason, EndReason::event_limit);
}

}  // namespace
}  // namespace cnctrans::interpreter
