// A tool with its offset at the head of CAM output, the M06 behind it: such files must not need the whole program.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "translator/stream/stream.h"

namespace cnctrans::translator {
namespace {

namespace fs = std::filesystem;

struct Streamed {
  StreamOutcome outcome = StreamOutcome::failed;
  std::string text;
  Diagnostics said;
};

Streamed stream(const std::string& program, const std::string& to = "sinumerik") {
  const fs::path path = fs::temp_directory_path() / ("cnctrans-stream-tool-" + std::to_string(::getpid()) + ".pim");
  std::ofstream(path, std::ios::binary) << program;
  TranslateOptions options;
  options.from = "fagor";
  options.to = to;
  Streamed out;
  const auto take = [&out](std::string_view piece) {
    out.text += piece;
    return true;
  };
  auto result = translate_stream(path.string(), options, take, {});
  out.outcome = result.outcome;
  out.said = std::move(result.diagnostics);
  fs::remove(path);
  return out;
}

const std::string head = "%CAM,MX,\nN5 G17 G40 G71 G90 G94\nN10 G54\n";
const std::string cut = "N25 S5000 M3\nN30 G43 G0 X0 Y0 Z15\nN35 G1 Z-1 F200\nN40 X10\n";

TEST(StreamTool, TheOffsetComesWithTheChange) {
  const auto done = stream(head + "N15 T3 D3\nN20 M6\n" + cut + "M30\n");
  ASSERT_EQ(done.outcome, StreamOutcome::done);
  EXPECT_NE(done.text.find("N15 T3\nN20 D3 M6\n"), std::string::npos) << done.text;
}

/// 8055 M 5.6: without an M06 in the whole program the tools are changed by hand, and D counts at once.
TEST(StreamTool, WithoutAnyChangeTheOffsetCountsAtOnce) {
  for (const std::string end : {"M30\n", ""}) {
    const auto done = stream(head + "N15 T3 D3\n" + cut + "N50 T4 D4\nN55 Z5\n" + end);
    ASSERT_EQ(done.outcome, StreamOutcome::done);
    EXPECT_NE(done.text.find("N15 T3 D3\n"), std::string::npos) << done.text;
    EXPECT_NE(done.text.find("N50 T4 D4\n"), std::string::npos) << done.text;
  }
}

/// It is said once, of the block with the change, wherever the move stands that uses the tool.
TEST(StreamTool, AToolWithoutAnOffsetIsTold) {
  const auto warned = [](const Streamed& s) {
    std::vector<std::uint32_t> lines;
    for (const auto& d : s.said.all()) {
      if (d.code == "TRN-522") lines.push_back(d.span.line);
    }
    return lines;
  };
  const auto at_head = stream(head + "N15 T3\nN20 M6\n" + cut + "N50 T4 M6\nN55 Z5\nM30\n", "num");
  ASSERT_EQ(at_head.outcome, StreamOutcome::done);
  EXPECT_EQ(warned(at_head), std::vector<std::uint32_t>{5});
  const auto behind = stream(head + "N15 T3 D3\nN20 M6\n" + cut + "N50 T4 M6\nN55 Z5\nM30\n", "num");
  ASSERT_EQ(behind.outcome, StreamOutcome::done);
  EXPECT_EQ(warned(behind), std::vector<std::uint32_t>{10});
  const auto given = stream(head + "N15 T3\nN20 M6\nN22 D3\n" + cut + "M30\n", "num");
  ASSERT_EQ(given.outcome, StreamOutcome::done);
  EXPECT_TRUE(warned(given).empty());
}

TEST(StreamTool, AnOffsetThatNoChangeFollowsNeedsTheProgram) {
  EXPECT_EQ(stream(head + "N15 T3 D3\n" + cut + "N60 T4 D4\nN65 M6\nM30\n").outcome, StreamOutcome::needs_program);
  EXPECT_EQ(stream(head + "N15 T3 D3 (M6)\n" + cut).outcome, StreamOutcome::needs_program);
  EXPECT_EQ(stream(head + "N15 T3 D3\nN16 D4\nN20 M6\n" + cut + "M30\n").outcome, StreamOutcome::needs_program);
}

}  // namespace
}  // namespace cnctrans::translator
