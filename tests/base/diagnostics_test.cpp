// Diagnostics: counting, text with carets, JSON.
#include "base/diagnostics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/source.h"

namespace cnctrans {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

struct Rendered {
  std::string head, line, carets, rest;
};

/// Renders an error over bytes [column, end_column) of line 1 of a file with these bytes.
Rendered render(const std::string& bytes, std::uint32_t column, std::uint32_t end_column, std::string hint = {}) {
  FileTable files;
  const FileId f = files.add(SourceText::from_string("p.pim", bytes));
  const std::string all =
      render_text(Diagnostic{"FAG-001", Severity::error, {f, 1, column, 1, end_column}, "bad word", hint}, files);
  Rendered r;
  std::vector<std::string> lines;
  std::string_view rest = all;
  SourceLine l;
  while (take_line(rest, l)) lines.emplace_back(l.text);
  if (!lines.empty()) r.head = lines[0];
  if (lines.size() > 1) r.line = lines[1];
  if (lines.size() > 2) r.carets = lines[2];
  for (std::size_t i = 3; i < lines.size(); ++i) r.rest += lines[i] + "\n";
  return r;
}

TEST(RenderText, PlaceLineCaretsAndHint) {
  const auto r = render("N10 G999 X5\n", 5, 9, "leave it out");
  EXPECT_EQ(r.head, "p.pim:1:5: error FAG-001: bad word");
  EXPECT_EQ(r.line, "  N10 G999 X5");
  EXPECT_EQ(r.carets, "      ^~~~");
  EXPECT_EQ(r.rest, "  hint: leave it out\n");
}

TEST(RenderText, TabsStandInBothLines) {
  const auto r = render("N10\tG1\tQ5 X1", 8, 10);
  EXPECT_EQ(r.line, "  N10\tG1\tQ5 X1");
  EXPECT_EQ(r.carets, "     \t  \t^~");
}

TEST(RenderText, MultiByteCharactersAreOneColumn) {
  // "(mäß) Q5": Q is byte 9 of the UTF-8 text, column 7 on the screen.
  const auto utf8 = render("(m\xC3\xA4\xC3\x9F) Q5", 9, 11);
  EXPECT_EQ(utf8.carets, "        ^~");
  // The same in Windows-1252 is shown as UTF-8; Q is byte 7.
  const auto ansi = render("(m\xE4\xDF) Q5", 7, 9);
  EXPECT_EQ(ansi.line, utf8.line);
  EXPECT_EQ(ansi.carets, utf8.carets);
}

TEST(RenderText, WideCharactersAreTwoColumns) {
  const auto r = render("\xE4\xB8\xAD Q", 5, 6);
  EXPECT_EQ(r.carets, "     ^");
}

TEST(RenderText, ControlBytesAreDots) {
  const auto r = render(std::string("G1\0\x1B[2J\x1A X", 10), 10, 11);
  EXPECT_EQ(r.line, "  G1..[2J. X");
  EXPECT_EQ(r.carets, "           ^");
  const auto c1 = render("a\x9Bz", 3, 4);  // U+203A in Windows-1252, no control
  EXPECT_EQ(c1.line, "  a\xE2\x80\xBAz");
  EXPECT_EQ(render("a\x81z", 3, 4).line, "  a.z");
}

TEST(RenderText, EmptyRangeEndOfLineAndPastIt) {
  EXPECT_EQ(render("G1 X", 4, 4).carets, "     ^");
  EXPECT_EQ(render("G1 X", 5, 5).carets, "      ^");
  EXPECT_EQ(render("G1 X", 50, 60).carets, "      ^");
  EXPECT_EQ(render("", 1, 1).head, "p.pim:1:1: error FAG-001: bad word");
  EXPECT_EQ(render("\n", 1, 1).carets, "  ^");
}

TEST(RenderText, ALongLineIsCutAroundThePlace) {
  std::string line;
  for (int i = 0; i < 100; ++i) line += "X" + std::to_string(1000 + i) + " ";
  const auto r = render(line, 301, 306);  // "X1050"
  EXPECT_LE(r.line.size(), 162U);
  EXPECT_EQ(r.line.substr(0, 5), "  ...");
  EXPECT_THAT(r.line, EndsWith("..."));
  ASSERT_NE(r.carets.find('^'), std::string::npos);
  EXPECT_EQ(r.line.substr(r.carets.find('^'), 5), "X1050");
  EXPECT_THAT(r.carets, EndsWith("^~~~~"));

  const auto front = render(line, 1, 6);
  EXPECT_EQ(front.line.substr(0, 8), "  X1000 ");
  EXPECT_THAT(front.line, EndsWith("..."));
  const auto back = render(line, 595, 600);
  EXPECT_EQ(back.line.substr(0, 5), "  ...");
  EXPECT_THAT(back.line, Not(EndsWith("...")));
  EXPECT_EQ(back.line.substr(back.carets.find('^'), 5), "X1099");
}

TEST(RenderText, AMegabyteLineOfMultiByteCharacters) {
  std::string line;
  while (line.size() < (1U << 20U)) line += "\xC3\xA4";
  const std::size_t place = line.size() / 2;  // the start of a character: all have two bytes
  line.replace(place, 2, "QQ");
  const auto r = render(line, static_cast<std::uint32_t>(place + 1), static_cast<std::uint32_t>(place + 3));
  EXPECT_TRUE(valid_utf8(r.line));
  const std::size_t caret = r.carets.find('^');
  ASSERT_NE(caret, std::string::npos);
  // Two columns of indent and three of "..." are one byte each, the rest two bytes.
  EXPECT_EQ(r.line.substr(5 + (caret - 5) * 2, 2), "QQ");
  EXPECT_THAT(r.carets, EndsWith("^~"));
}

TEST(RenderText, ARangeOverSeveralLinesIsMarkedToTheEndOfTheFirst) {
  FileTable files;
  const FileId f = files.add(SourceText::from_string("p.pim", "AB CD\nEF\n"));
  EXPECT_EQ(render_text(Diagnostic{"X-1", Severity::note, {f, 1, 4, 2, 2}, "m", ""}, files),
            "p.pim:1:4: note X-1: m\n  AB CD\n     ^~\n");
}

TEST(RenderText, WithoutAPlace) {
  FileTable files;
  const FileId f = files.add_name("stream.pim");
  EXPECT_EQ(render_text(Diagnostic{"X-1", Severity::warning, {}, "m", ""}, files), "warning X-1: m\n");
  EXPECT_EQ(render_text(Diagnostic{"X-1", Severity::warning, {f, 0, 0, 0, 0}, "m", ""}, files),
            "stream.pim: warning X-1: m\n");
  EXPECT_EQ(render_text(Diagnostic{"X-1", Severity::warning, {f, 7, 3, 7, 4}, "m", ""}, files),
            "stream.pim:7:3: warning X-1: m\n");
}

TEST(RenderText, MessagesCantSteerATerminal) {
  const FileTable files;
  EXPECT_EQ(render_text(Diagnostic{"X-1", Severity::note, {}, "word \x1B[31m \xE4", ""}, files),
            "note X-1: word .[31m \xC3\xA4\n");
}

TEST(RenderText, ColourOnlyWhenAsked) {
  const FileTable files;
  const Diagnostic d{"X-1", Severity::error, {}, "m", ""};
  EXPECT_THAT(render_text(d, files, true), HasSubstr("\x1b["));
  EXPECT_THAT(render_text(d, files, false), Not(HasSubstr("\x1b")));
}

Span at(std::uint32_t line) {
  return {1, line, 1, line, 2};
}

TEST(Diagnostics, CountsBySeverity) {
  Diagnostics ds;
  EXPECT_TRUE(ds.empty());
  ds.note("A-1", at(1), "n");
  ds.warning("A-2", at(2), "w");
  EXPECT_FALSE(ds.has_errors());
  ds.error("A-3", at(3), "e", "h");
  EXPECT_EQ(ds.error_count(), 1U);
  EXPECT_EQ(ds.warning_count(), 1U);
  ASSERT_EQ(ds.all().size(), 3U);
  EXPECT_EQ(ds.all()[2], (Diagnostic{"A-3", Severity::error, at(3), "e", "h"}));
  ds.clear();
  EXPECT_TRUE(ds.empty());
  EXPECT_FALSE(ds.has_errors());
}

TEST(Diagnostics, KeepsTwoHundredOfACodeAndNamesTheLinesOfTheRest) {
  FileTable files;
  files.add_name("p.pim");
  Diagnostics ds;
  for (std::uint32_t i = 1; i <= 260; ++i) ds.error("FAG-001", at(i), "bad");
  ds.error("FAG-001", at(300), "bad");
  ds.warning("FAG-002", at(1), "other");
  EXPECT_EQ(ds.all().size(), 201U);
  EXPECT_EQ(ds.error_count(), 261U);
  EXPECT_THAT(render_text(ds, files), EndsWith("\n... and 61 more FAG-001 (p.pim: lines 201-260, 300)\n"));
  const auto json = nlohmann::json::parse(render_json(ds, files));
  ASSERT_EQ(json.size(), 202U);
  EXPECT_EQ(json.back()["more"], 61);
  EXPECT_EQ(json.back()["code"], "FAG-001");
}

TEST(Diagnostics, AppendAddsCountsAndKeepsTheLimit) {
  Diagnostics a;
  Diagnostics b;
  for (std::uint32_t i = 1; i <= 150; ++i) a.error("X-1", at(i), "m");
  for (std::uint32_t i = 151; i <= 400; ++i) b.error("X-1", at(i), "m");
  a.append(b);
  EXPECT_EQ(a.all().size(), 200U);
  EXPECT_EQ(a.error_count(), 400U);
  EXPECT_EQ(a.more().at("X-1").count, 200U);
  EXPECT_EQ(a.more().at("X-1").lines, (std::vector<MoreDiagnostics::Lines>{{1, 201, 400}}));
  a.append(a);
  EXPECT_EQ(a.error_count(), 800U);
}

TEST(Diagnostics, FarApartLinesBeyondTheLimitAreSaidToBeIncomplete) {
  const FileTable files;
  Diagnostics ds(0);
  for (std::uint32_t i = 1; i <= 150; ++i) ds.error("X-1", at(i * 10), "m");
  EXPECT_EQ(ds.more().at("X-1").count, 150U);
  EXPECT_THAT(render_text(ds, files), HasSubstr("... and 150 more X-1"));
  EXPECT_THAT(render_text(ds, files), EndsWith(" and further lines)\n"));
}

TEST(RenderJson, HasEveryFieldAndIsValidWhateverTheBytes) {
  FileTable files;
  const FileId f = files.add_name("t\xE4st.pim");
  Diagnostics ds;
  ds.warning("NUM-004", {f, 3, 4, 3, 9}, "word \"\xDF\" \x01", "h");
  const auto json = nlohmann::json::parse(render_json(ds, files));
  ASSERT_EQ(json.size(), 1U);
  EXPECT_EQ(json[0], nlohmann::json::parse(
                         R"({"code": "NUM-004", "severity": "warning", "file": "täst.pim", "line": 3, "column": 4,
                                      "end_line": 3, "end_column": 9, "message": "word \"ß\" \u0001", "hint": "h"})"));
}

}  // namespace
}  // namespace cnctrans
