// A folder gets its name only when complete, and never replaces the files of somebody.
#include "app/file/disk/atomic_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "tests/temporary_folder.h"

namespace hapticwall::file {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class AtomicFolderTest : public hapticwall::test::FolderTest {
 protected:
  [[nodiscard]] std::string refusal(const std::string& name) const {
    const Result<AtomicFolder> folder = AtomicFolder::create(path(name));
    if (folder) return "";
    EXPECT_EQ(folder.error().kind, ErrorKind::kFile);
    return folder.error().message;
  }
};

TEST_F(AtomicFolderTest, GetsItsNameAtTheEnd) {
  Result<AtomicFolder> folder = AtomicFolder::create(path("a"));
  ASSERT_TRUE(folder);
  EXPECT_FALSE(folder->write("0.png", "first"));
  EXPECT_THAT(folder_.names(), ElementsAre("a.partial"));
  EXPECT_FALSE(folder->commit());
  EXPECT_THAT(folder_.names(), ElementsAre("a"));
  EXPECT_EQ(content("a/0.png"), "first");
}

TEST_F(AtomicFolderTest, LeavesNothingIfItIsNotCommitted) {
  {
    Result<AtomicFolder> folder = AtomicFolder::create(path("a"));
    ASSERT_TRUE(folder);
    EXPECT_FALSE(folder->write("0.png", "first"));
    AtomicFolder moved(std::move(*folder));
    EXPECT_FALSE(moved.write("1.png", "second"));
  }
  EXPECT_THAT(folder_.names(), IsEmpty());
}

TEST_F(AtomicFolderTest, KeepsTheFilesOfOthers) {
  {
    Result<AtomicFolder> folder = AtomicFolder::create(path("a"));
    ASSERT_TRUE(folder);
    put("a.partial/theirs", "kept");
    const Failure failed = folder->write("theirs", "new");
    ASSERT_TRUE(failed);
    EXPECT_THAT(failed->message, HasSubstr("theirs cannot be made: File exists"));
  }
  EXPECT_EQ(content("a.partial/theirs"), "kept");
}

TEST_F(AtomicFolderTest, TakesThePlaceOfAnEmptyFolderOnly) {
  fs::create_directory(path("empty"));
  fs::create_directory_symlink(path("empty"), path("link"));
  Result<AtomicFolder> folder = AtomicFolder::create(path("link/"));
  ASSERT_TRUE(folder);
  EXPECT_FALSE(folder->write("0.png", "first"));
  EXPECT_FALSE(folder->commit());
  EXPECT_EQ(content("empty/0.png"), "first");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_THAT(refusal("empty"), HasSubstr("the folder is not empty; choose another name"));
  put("file", "a file");
  EXPECT_THAT(refusal("file"), HasSubstr("it exists and is not a folder"));
}

TEST_F(AtomicFolderTest, FailsIfTheNameIsTakenMeanwhile) {
  {
    Result<AtomicFolder> folder = AtomicFolder::create(path("a"));
    ASSERT_TRUE(folder);
    fs::create_directory(path("a"));
    put("a/theirs", "kept");
    EXPECT_TRUE(folder->commit());
  }
  EXPECT_THAT(folder_.names(), ElementsAre("a"));
  EXPECT_EQ(content("a/theirs"), "kept");
}

TEST_F(AtomicFolderTest, RefusesWhatAnotherRunWrites) {
  const Result<AtomicFolder> folder = AtomicFolder::create(path("a"));
  ASSERT_TRUE(folder);
  EXPECT_THAT(refusal("a"), HasSubstr("exists: another run writes it, or one was killed"));
  EXPECT_THAT(refusal("none/b"), HasSubstr("cannot be made: No such file or directory"));
}

}  // namespace
}  // namespace hapticwall::file
