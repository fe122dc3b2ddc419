// Files are replaced as a whole or not at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/text.h"
#include "tests/support/temporary_folder.h"

namespace cnctrans {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

mode_t mode_of(const std::string& path) {
  struct stat st {};
  return ::stat(path.c_str(), &st) == 0 ? st.st_mode & 0777U : 0;
}

TEST(AtomicFile, WritesANewFile) {
  const test::TemporaryFolder folder;
  std::string error;
  AtomicFile file(folder.path("out.mpf"));
  ASSERT_TRUE(file.open(&error)) << error;
  ASSERT_TRUE(file.write("G0 X0\n", &error));
  ASSERT_TRUE(file.write("M30\n", &error));
  ASSERT_TRUE(file.commit(&error)) << error;
  EXPECT_EQ(folder.read("out.mpf"), "G0 X0\nM30\n");
  EXPECT_THAT(folder.names(), ElementsAre("out.mpf"));
}

TEST(AtomicFile, WithoutCommitTheOldFileStaysAndNothingElse) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("out.mpf", "old");
  {
    std::string error;
    AtomicFile file(path);
    ASSERT_TRUE(file.open(&error)) << error;
    ASSERT_TRUE(file.write(std::string(1U << 20U, 'x'), &error));
    EXPECT_LE(folder.names().size(), 2U);  // a temporary is beside it where a file can't be without name
    EXPECT_EQ(folder.read("out.mpf"), "old");
  }
  EXPECT_EQ(folder.read("out.mpf"), "old");
  EXPECT_THAT(folder.names(), ElementsAre("out.mpf"));
}

TEST(AtomicFile, KeepsThePermissionsOfTheFileItReplaces) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("out.mpf", "old");
  ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
  AtomicFile file(path);
  ASSERT_TRUE(file.open(nullptr));
  ASSERT_TRUE(file.write("new", nullptr));
  ASSERT_TRUE(file.commit(nullptr));
  EXPECT_EQ(folder.read("out.mpf"), "new");
  EXPECT_EQ(mode_of(path), 0640U);
}

TEST(AtomicFile, WritesThroughASymbolicLink) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("real.mpf", "old");
  std::filesystem::create_symlink("real.mpf", folder.path("link.mpf"));
  AtomicFile file(folder.path("link.mpf"));
  ASSERT_TRUE(file.open(nullptr));
  ASSERT_TRUE(file.write("new", nullptr));
  ASSERT_TRUE(file.commit(nullptr));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("link.mpf")));
  EXPECT_EQ(folder.read("real.mpf"), "new");
  EXPECT_THAT(folder.names(), UnorderedElementsAre("real.mpf", "link.mpf"));
}

TEST(AtomicFile, ADeviceIsWrittenAndNotReplaced) {
  AtomicFile file("/dev/null");
  ASSERT_TRUE(file.open(nullptr));
  ASSERT_TRUE(file.write("gone", nullptr));
  ASSERT_TRUE(file.commit(nullptr));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, RefusesAFolderAndAMissingFolder) {
  const test::TemporaryFolder folder;
  std::string error;
  std::filesystem::create_directory(folder.path("sub"));
  EXPECT_FALSE(AtomicFile(folder.path("sub")).open(&error));
  EXPECT_THAT(error, HasSubstr("sub: can't be written"));
  error.clear();
  EXPECT_FALSE(AtomicFile(folder.path("none/out.mpf")).open(&error));
  EXPECT_THAT(error, HasSubstr("none/out.mpf: can't be written"));
  EXPECT_THAT(folder.names(), ElementsAre("sub"));
}

TEST(AtomicFile, WriteWithoutOpenFails) {
  std::string error;
  AtomicFile file("never");
  EXPECT_FALSE(file.write("x", &error));
  EXPECT_FALSE(file.commit(&error));
  EXPECT_THAT(error, Not(IsEmpty()));
}

TEST(AtomicFile, AFullDiskIsReported) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  std::string error;
  AtomicFile file("/dev/full");
  ASSERT_TRUE(file.open(&error));
  EXPECT_FALSE(file.write("x", &error) && file.commit(&error));
  EXPECT_THAT(error, HasSubstr("/dev/full"));
}

}  // namespace
}  // namespace cnctrans
