// Runs textual IR and shows its events in short lines, positions only of the axes that changed.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "base/text.h"
#include "interpreter/program/interpreter.h"
#include "ir/text/text.h"
#include "machine/profile.h"

namespace cnctrans::interpreter {

using Lines = std::vector<std::string>;
using ::testing::ElementsAre;

inline machine::Profile mill() {
  machine::Profile p;
  p.name = "test-mill";
  for (const char* n : {"X", "Y", "Z", "A", "B", "C"}) {
    machine::AxisSpec a;
    a.name = n;
    a.id = ir::fixed_axis(n[0]);
    a.rotary = ir::is_rotary_letter(a.id);
    p.axes.push_back(a);
  }
  using S = ir::FrameSlot;
  p.frame_order = {S::preset, S::shift, S::rotation, S::scale, S::mirror, S::chain};
  p.power_on.motion = ir::MotionKind::linear;
  return p;
}

inline machine::Profile lathe() {
  machine::Profile p = mill();
  p.name = "test-lathe";
  p.kind = machine::Kind::lathe;
  p.axes.erase(p.axes.begin() + 1);  // no Y
  p.axes[0].diameter = true;
  p.power_on.plane = ir::Plane::zx;
  p.power_on.diameter = ir::DiameterMode::diameter;
  return p;
}

inline std::string number(double v) {
  return rounded(v, 5);
}

/// One event in short; `last` holds the positions shown before.
inline std::string show(const Event& e, std::map<ir::AxisId, double>& last) {
  std::string s(name(e.kind));
  const auto position = [&] {
    for (ir::AxisId a = 0; a < ir::axis::first_extra; ++a) {
      if (((e.to.known >> a) & 1U) == 0) continue;
      if (number(last[a]) != number(e.to.value[a]))
        s += " " + std::string(ir::fixed_axis_name(a)) + number(e.to.value[a]);
      last[a] = e.to.value[a];
    }
  };
  const auto feed = [&] {
    if (e.feed != 0) s += " F" + number(e.feed);
    if (e.feed_mode != ir::FeedMode::per_minute) s += e.feed_mode == ir::FeedMode::per_rev ? "/rev" : "/inv";
  };
  switch (e.kind) {
    case EventKind::rapid: position(); break;
    case EventKind::linear:
      position();
      feed();
      break;
    case EventKind::arc:
      s = e.cw ? "cw" : "ccw";
      position();
      s += " c(" + number(e.center_u) + "," + number(e.center_v) + ")";
      if (e.plane != ir::Plane::xy) s += e.plane == ir::Plane::zx ? " ZX" : " YZ";
      if (e.turns != 0) s += " turns" + std::to_string(e.turns);
      feed();
      break;
    case EventKind::thread:
      position();
      s += " pitch" + number(e.pitch);
      if (e.pitch_change != 0) s += " change" + number(e.pitch_change);
      if (e.start_angle != 0) s += " at" + number(e.start_angle);
      break;
    case EventKind::probe:
      position();
      feed();
      s += e.change ? " toward" : " away";
      break;
    case EventKind::dwell: s += " " + number(e.amount) + (e.revolutions ? "rev" : "s"); break;
    case EventKind::feed_stop: break;
    case EventKind::spindle:
      s += " " + std::to_string(e.number) + " " + e.state + " " + number(e.value) + (e.css ? "m/min" : "");
      if (e.has_limit) s += " limit" + number(e.limit);
      if (e.state == "oriented") s += " at" + number(e.angle);
      break;
    case EventKind::tool:
      s += " " + (e.text.empty() ? std::to_string(e.number) : e.text) + (e.change ? " change" : "");
      break;
    case EventKind::offset:
    case EventKind::m: s += " " + std::to_string(e.number); break;
    case EventKind::comp:
    case EventKind::coolant: s += " " + e.state; break;
    case EventKind::message: s += " " + e.text; break;
    case EventKind::stop: s += e.optional_stop ? " optional" : ""; break;
    case EventKind::end:
      s += " " + std::string(name(e.reason));
      if (!e.code.empty()) s += " " + e.code;
      break;
  }
  return s;
}

struct Run {
  std::vector<Event> events;
  Result result;
  Diagnostics diagnostics;
  Lines lines;  ///< events in short, without the `end` of a good run
  std::map<std::string, std::string> variables;
};

inline ir::Program program_of(const std::string& text) {
  Diagnostics diagnostics;
  ir::Program p = ir::from_text(text, 1, diagnostics);
  for (const auto& d : diagnostics.all()) ADD_FAILURE() << "line " << d.span.line << ": " << d.message << "\n" << text;
  ir::number_statements(p);
  return p;
}

inline Run run_program(const ir::Program& p, const machine::Profile& profile, const Options& options = {}) {
  Run r;
  TraceRecorder recorder;
  r.result = run(p, profile, options, recorder, r.diagnostics);
  r.events = recorder.events;
  std::map<ir::AxisId, double> last;
  for (const auto& a : profile.axes) last[a.id] = a.start;
  for (const auto& e : r.events) {
    auto line = show(e, last);
    if (line != "end program_end") r.lines.push_back(std::move(line));
  }
  r.variables.insert(r.result.variables.begin(), r.result.variables.end());
  return r;
}

inline constexpr const char* spaces =
    "space R \"R\" segment 0 299\n"
    "space P \"P\" segment 0 25 level segment 100 299\n"
    "space V \"\"\n"
    "space G \"\" scope global\n";

/// Whole programs: routines as they are written.
inline Run run_text(const std::string& routines, const machine::Profile& profile = mill(),
                    const Options& options = {}) {
  return run_program(program_of(std::string(spaces) + routines), profile, options);
}
/// The statements of a main routine.
inline Run run_lines(const std::string& statements, const machine::Profile& profile = mill(),
                     const Options& options = {}) {
  return run_text("routine main 1 {\n" + statements + "\n}\n", profile, options);
}
inline Lines lines_of(const std::string& statements, const machine::Profile& profile = mill()) {
  return run_lines(statements, profile).lines;
}

}  // namespace cnctrans::interpreter
