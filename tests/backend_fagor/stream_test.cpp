// A stream writes the same lines as the writer of whole programs, or says that it can't.
#include "tests/backend_fagor/build.h"

namespace cnctrans::test {
namespace {

using ir::MotionKind;
using ir::Value;
namespace axis = ir::axis;

struct Streamed {
  std::string text;
  bool all = true;  ///< every statement was plain
};
Streamed stream(Build& b) {
  Streamed s;
  b.options.profile = &b.profile;
  const auto writer = backends::fagor::make_backend()->stream(b.options);
  writer->begin(b.program, s.text);
  for (const auto& statement : b.body()) s.all = writer->write(statement, s.text, b.diagnostics) && s.all;
  writer->end(s.text);
  return s;
}

TEST(FagorStream, PlainBlocksAreTheSameText) {
  Build b;
  b.add(actions({set(ir::Setting::plane, ir::Plane::xy), set(ir::Setting::path_mode, ir::PathMode::continuous),
                 set(ir::Setting::distance, ir::Distance::absolute)}));
  b.add(actions({action(ir::WorkOffset{Value(1), false})}));
  b.add(actions(
      {action(ir::ToolSelect{Value(2), {}, false}), action(ir::ToolOffset{Value(2)}), action(ir::ToolChange{})}));
  auto& first =
      b.add(move(MotionKind::rapid, {coord(axis::x, Value(10.5, "10.500")), coord(axis::y, Value(-3, "-3."))}));
  first.line.number = "0100";
  first.line.comments = {{" Anfahren", ir::CommentPlace::end_of_line, {}}};
  std::get<ir::Block>(first.node).actions = {action(ir::SpindleRun{1, ir::SpindleState::cw}),
                                             action(ir::SetSpindle{1, Value(800)})};
  ir::Block arc = move(MotionKind::arc_cw, {coord(axis::x, Value(20)), coord(axis::y, Value(0))});
  arc.motion.centers = {center(axis::x, Value(5)), center(axis::y, Value(0))};
  arc.actions = {action(ir::SetFeed{Value(200), false})};
  b.add(arc).line.skip_mask = 2;
  b.add(actions({action(ir::Dwell{Value(1.5), 1, false})}));
  b.add(ir::End{});
  const std::string whole = b.text();
  const Streamed s = stream(b);
  EXPECT_TRUE(s.all);
  EXPECT_EQ(s.text, whole);
  EXPECT_EQ(s.text,
            "%PART ,MX,\nG17 G05 G90\nG54\nT2 D2 M6\nN0100 G0 X10.500 Y-3. S800 M3 ;Anfahren\n/2 G2 X20 Y0 I5 J0 "
            "F200\nG04 K150\nM30\n");
}

TEST(FagorStream, WhatIsSpecialHereIsNotPlain) {
  const auto plain = [](ir::Block block, const std::string& machine = "fagor-mill") {
    Build b(machine);
    b.add(std::move(block));
    return stream(b).all;
  };
  EXPECT_FALSE(plain(actions({action(ir::SetFeed{Value(0), false})})));  // F0 is the greatest feed
  EXPECT_FALSE(plain(move(MotionKind::linear, {coord(axis::y, Value(1)), coord(axis::x, Value(1))})));  // X before Y
  EXPECT_FALSE(plain(move(MotionKind::linear, {coord(axis::x, Value(P(1)))})));
  EXPECT_FALSE(plain(actions({set(ir::Setting::units, ir::Units::inch)})));
  EXPECT_FALSE(plain(actions({set(ir::Setting::diameter, ir::DiameterMode::radius)}), "fagor-lathe"));
  ir::Block offset = move(MotionKind::rapid, {coord(axis::x, Value(0))});
  offset.actions = {action(ir::WorkOffset{Value(1), false})};
  EXPECT_FALSE(plain(offset));
  EXPECT_FALSE(plain(actions({action(ir::WorkOffset{Value(7), false})})));
}

TEST(FagorStream, TheSameLanguageKeepsItsSpelling) {
  const std::string text = "%PART ,MX,\nN010 G01 Y5. X1.500 F0200 M08\nG54\nG1 X2 ;c\nM30\n";
  const machine::Profile profile = profile_of("fagor-mill");
  frontends::ReadOptions read;
  read.profile = &profile;
  backends::WriteOptions write;
  write.profile = &profile;
  const auto source = SourceText::from_string("000100.PIM", text);
  const auto reader = frontends::fagor::make_frontend()->stream(1, read, "000100.PIM");
  const auto writer = backends::fagor::make_backend()->stream(write);
  std::string out;
  Diagnostics diagnostics;
  ir::Statement s;
  bool begun = false;
  for (const SourceLine& line : source->lines()) {
    const auto kind = reader->read(line, s, diagnostics);
    ASSERT_NE(kind, frontends::StreamLine::needs_program);
    if (kind == frontends::StreamLine::no_statement) continue;
    if (!begun) writer->begin(reader->frame(), out);
    begun = true;
    const auto* block = std::get_if<ir::Block>(&s.node);
    const bool alone = kind == frontends::StreamLine::program_end && block != nullptr && block->empty();
    if (!alone) {
      EXPECT_TRUE(writer->write(s, out, diagnostics)) << line.text;
    }
    if (kind == frontends::StreamLine::program_end) {
      ir::Statement end;
      if (alone) end.line = s.line;
      end.line.joined = !alone;
      end.node = ir::End{};
      EXPECT_TRUE(writer->write(end, out, diagnostics));
    }
  }
  writer->end(out);
  EXPECT_EQ(codes_of(diagnostics), "");
  EXPECT_EQ(out, text);
}

}  // namespace
}  // namespace cnctrans::test
