// A tool with its offset at the head of CAM output, the M06 behind it: such files must not need the whole program.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "translator/stream.h"

namespace cnctrans::translator {
namespace {

namespace fs = std::filesystem;

struct Streamed {
  StreamOutcome outcome;
  std::string text;
};

Streamed stream(const std::string& program) {
  const fs::path path = fs::temp_directory_path() / ("cnctrans-stream-tool-" + std::to_string(::getpid()) + ".pim");
  std::ofstream(path, std::ios::binary) << program;
  TranslateOptions options;
  options.from = "fagor";
  options.to = "sinumerik";
  Streamed out{};
  const auto take = [&out](std::string_view piece) {
    out.text += piece;
    return true;
  };
  out.outcome = translate_stream(path.string(), options, take, {}).outcome;
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

TEST(StreamTool, AnOffsetThatNoChangeFollowsNeedsTheProgram) {
  EXPECT_EQ(stream(head + "N15 T3 D3\n" + cut + "M30\n").outcome, StreamOutcome::needs_program);
  EXPECT_EQ(stream(head + "N15 T3 D3\n" + cut).outcome, StreamOutcome::needs_program);
  EXPECT_EQ(stream(head + "N15 T3 D3\nN16 D4\nN20 M6\n" + cut + "M30\n").outcome, StreamOutcome::needs_program);
}

}  // namespace
}  // namespace cnctrans::translator
