// Source text: line ends, encodings, windows of a file.
#include "base/source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/support/temporary_folder.h"

namespace cnctrans {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> texts(const SourceText& s) {
  std::vector<std::string> out;
  for (const SourceLine& l : s.lines()) out.emplace_back(l.text);
  return out;
}

TEST(SourceText, MixedLineEndsKeepTheirKindAndNumber) {
  const auto s = SourceText::from_string("a.pim", "one\r\ntwo\nthree\rfour\n\r\nsix");
  EXPECT_THAT(texts(*s), ElementsAre("one", "two", "three", "four", "", "six"));
  const auto& lines = s->lines();
  EXPECT_EQ(lines[0].eol, Eol::crlf);
  EXPECT_EQ(lines[1].eol, Eol::lf);
  EXPECT_EQ(lines[2].eol, Eol::cr);
  EXPECT_EQ(lines[3].eol, Eol::lf);
  EXPECT_EQ(lines[4].eol, Eol::crlf);
  EXPECT_TRUE(lines[4].has_eol);
  EXPECT_FALSE(lines[5].has_eol);
  for (std::uint32_t i = 0; i < lines.size(); ++i) EXPECT_EQ(lines[i].number, i + 1);
  EXPECT_EQ(s->main_eol(), Eol::crlf);
  EXPECT_EQ(s->line_text(3), "three");
  EXPECT_EQ(s->line_text(0), "");
  EXPECT_EQ(s->line_text(7), "");
}

TEST(SourceText, LineFeedThenCarriageReturnIsTwoLineEnds) {
  const auto s = SourceText::from_string("a", "a\n\rb\r\rc");
  EXPECT_THAT(texts(*s), ElementsAre("a", "", "b", "", "c"));
}

TEST(SourceText, EmptyAndAlmostEmpty) {
  EXPECT_TRUE(SourceText::from_string("a", "")->lines().empty());
  EXPECT_THAT(texts(*SourceText::from_string("a", "\n")), ElementsAre(""));
  EXPECT_THAT(texts(*SourceText::from_string("a", "x")), ElementsAre("x"));
  EXPECT_EQ(SourceText::from_string("a", "x")->main_eol(), Eol::lf);
}

TEST(SourceText, BomIsKeptInTheBytesAndLeftOutOfTheText) {
  const auto s = SourceText::from_string("a", "\xEF\xBB\xBFG0\n");
  EXPECT_TRUE(s->has_bom());
  EXPECT_EQ(s->bytes().size(), 6U);
  EXPECT_EQ(s->text(), "G0\n");
  EXPECT_EQ(s->line_text(1), "G0");
  EXPECT_EQ(s->encoding(), Encoding::utf8);
  const auto only = SourceText::from_string("a", "\xEF\xBB\xBF");
  EXPECT_TRUE(only->has_bom());
  EXPECT_TRUE(only->lines().empty());
  EXPECT_FALSE(SourceText::from_string("a", "\xEF\xBB")->has_bom());
}

TEST(SourceText, EncodingIsUtf8WhenValidElseWindows1252) {
  EXPECT_EQ(SourceText::from_string("a", "plain")->encoding(), Encoding::utf8);
  EXPECT_EQ(SourceText::from_string("a", "Bohr \xC3\xB8")->encoding(), Encoding::utf8);
  EXPECT_EQ(SourceText::from_string("a", "Bohr \xF8 12")->encoding(), Encoding::windows1252);
}

TEST(SourceText, NameStemAndExtension) {
  const auto s = SourceText::from_string("/some.dir/Flange.V2.PIM", "");
  EXPECT_EQ(s->stem(), "Flange.V2");
  EXPECT_EQ(s->extension(), "pim");
  EXPECT_EQ(SourceText::from_string("a.b/prog", "")->stem(), "prog");
  EXPECT_EQ(SourceText::from_string("a.b/prog", "")->extension(), "");
  EXPECT_EQ(SourceText::from_string(".hidden", "")->stem(), ".hidden");
}

TEST(SourceText, OpensSmallAndMappedFilesAlike) {
  const test::TemporaryFolder folder;
  std::string big;
  while (big.size() < (3U << 20U)) big += "N10 G1 X10.5 Z-3 F0.2\r\n";
  for (const std::string& bytes : {std::string("G0 X0\nM30"), std::string(), big}) {
    std::string error;
    const auto s = SourceText::open(folder.write("a.pim", bytes), &error);
    ASSERT_NE(s, nullptr) << error;
    EXPECT_TRUE(s->bytes() == bytes);
  }
}

TEST(SourceText, ReadsWhatIsNoRegularFile) {
  std::string error;
  const auto s = SourceText::open("/dev/null", &error);
  ASSERT_NE(s, nullptr) << error;
  EXPECT_EQ(s->bytes(), "");
}

TEST(SourceText, SaysWhyItCantOpen) {
  const test::TemporaryFolder folder;
  std::string error;
  EXPECT_EQ(SourceText::open(folder.path("none.pim"), &error), nullptr);
  EXPECT_THAT(error, HasSubstr("none.pim: can't be read: No such file"));
  EXPECT_EQ(SourceText::open(folder.path("."), &error), nullptr);
  EXPECT_THAT(error, HasSubstr("directory"));
}

TEST(TakeLine, AMegabyteOfCarriageReturnsIsNotQuadratic) {
  std::string bytes;
  for (int i = 0; i < 500000; ++i)
    bytes += "G\r";  // no LF anywhere: a search for one must not run to the end each time
  std::string_view rest = bytes;
  SourceLine line;
  while (take_line(rest, line)) ASSERT_EQ(line.text, "G");
  EXPECT_EQ(line.number, 500000U);
  EXPECT_FALSE(take_line(rest, line));
}

TEST(TakeLine, LineEndsAroundTheSearchSteps) {
  for (std::size_t n = 0; n < 700; ++n) {
    for (const std::string_view eol : {"\n", "\r", "\r\n"}) {
      const std::string bytes = std::string(n, 'x') + std::string(eol) + "Y";
      std::string_view rest = bytes;
      SourceLine line;
      ASSERT_TRUE(take_line(rest, line));
      ASSERT_EQ(line.text.size(), n);
      ASSERT_EQ(eol_text(line.eol), eol);
      ASSERT_EQ(rest, "Y");
    }
  }
}

/// All windows of a file; checks that each but the last ends with a whole line end.
std::vector<std::string> windows(const std::string& path, std::size_t size) {
  LineWindowReader reader(size);
  std::string error;
  std::vector<std::string> out;
  if (!reader.open(path, &error)) {
    ADD_FAILURE() << error;
    return out;
  }
  for (std::string_view w = reader.next(); !w.empty(); w = reader.next()) out.emplace_back(w);
  EXPECT_EQ(reader.read_error(), "");
  EXPECT_EQ(reader.bytes_read(), reader.file_size());
  for (std::size_t i = 0; i + 1 < out.size(); ++i) {
    EXPECT_TRUE(out[i].back() == '\n' || out[i].back() == '\r') << i;
    EXPECT_FALSE(out[i].back() == '\r' && out[i + 1].front() == '\n') << "a CRLF was torn at window " << i;
  }
  return out;
}

TEST(LineWindowReader, CrlfAtTheBorderOfTheWindowStaysWhole) {
  const test::TemporaryFolder folder;
  // The CR is the seventh byte, the LF would be the first of the next window.
  EXPECT_THAT(windows(folder.write("a", "aaa\nbb\r\ncccc"), 7), ElementsAre("aaa\n", "bb\r\n", "cccc"));
  EXPECT_THAT(windows(folder.write("b", "aaaaaa\r\nbb\r\ncccccccc"), 7), ElementsAre("aaaaaa\r\nbb\r\n", "cccccccc"));
  EXPECT_THAT(windows(folder.write("c", "aaa\rbb\rcccccc"), 7), ElementsAre("aaa\r", "bb\r", "cccccc"));
  EXPECT_THAT(windows(folder.write("d", "aaaaaa\r"), 7), ElementsAre("aaaaaa\r"));
  EXPECT_THAT(windows(folder.write("e", "\r\n\r\n\r\n\r\n"), 7), ElementsAre("\r\n\r\n\r\n", "\r\n"));
}

TEST(LineWindowReader, ALineLongerThanTheWindowMakesItGrow) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("a", "short\n" + std::string(100, 'x') + "\nend\n");
  const auto w = windows(path, 7);
  ASSERT_GE(w.size(), 2U);
  EXPECT_EQ(w[0], "short\n");
  EXPECT_EQ(w[1].substr(0, 101), std::string(100, 'x') + "\n");
}

TEST(LineWindowReader, AMegabyteLineAndNoLineEndAtTheEnd) {
  const test::TemporaryFolder folder;
  const std::string bytes = std::string(1U << 20U, 'x') + "\nlast";
  std::string joined;
  for (const auto& w : windows(folder.write("a", bytes), 4096)) joined += w;
  EXPECT_TRUE(joined == bytes);
}

TEST(LineWindowReader, EmptyAndMissingFile) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(windows(folder.write("a", ""), 7).empty());
  LineWindowReader reader;
  std::string error;
  EXPECT_FALSE(reader.open(folder.path("none"), &error));
  EXPECT_THAT(error, HasSubstr("No such file"));
  EXPECT_EQ(reader.next(), "");
}

TEST(LineWindowReader, LinesAreThoseOfTheWholeFileWhateverTheWindow) {
  const test::TemporaryFolder folder;
  std::mt19937 random(7);
  for (int round = 0; round < 60; ++round) {
    std::string bytes;
    for (int i = 0; i < 200; ++i) bytes += "ab\n\r\n\r"[random() % 6];
    const auto whole = SourceText::from_string("a", bytes);
    std::vector<std::string> lines;
    SourceLine line;
    for (const auto& w : windows(folder.write("a", bytes), 2 + random() % 20)) {
      std::string_view rest = w;
      while (take_line(rest, line)) lines.push_back(std::string(line.text) + std::string(eol_text(line.eol)));
    }
    std::vector<std::string> expected;
    for (const auto& l : whole->lines()) expected.push_back(std::string(l.text) + std::string(eol_text(l.eol)));
    ASSERT_EQ(lines, expected);
    ASSERT_EQ(line.number, expected.size());
  }
}

TEST(FileTable, IndexZeroIsNoFile) {
  FileTable files;
  EXPECT_EQ(files.name(0), "");
  EXPECT_EQ(files.source(0), nullptr);
  const FileId a = files.add(SourceText::from_string("a.pim", "G0"));
  const FileId b = files.add_name("b.pim");
  EXPECT_EQ(files.name(a), "a.pim");
  EXPECT_EQ(files.source(a)->text(), "G0");
  EXPECT_EQ(files.name(b), "b.pim");
  EXPECT_EQ(files.source(b), nullptr);
  files.attach(b, SourceText::from_string("b.pim", "G1"));
  EXPECT_EQ(files.source(b)->text(), "G1");
  EXPECT_EQ(files.name(99), "");
}

}  // namespace
}  // namespace cnctrans
