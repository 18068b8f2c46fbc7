// Files get their names only when complete, on any disk, and follow no links.
#include "app/file/disk/atomic_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

#include "app/file/recording/recording_writer.h"
#include "app/file/recording/recovery.h"
#include "app/file/recording/sidecar.h"
#include "tests/app/file/faulty_disk.h"
#include "tests/temporary_folder.h"

namespace hapticwall::file {
namespace {

namespace fs = std::filesystem;
using hapticwall::test::TemporaryFolder;
using test::FaultyDisk;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class AtomicFileTest : public hapticwall::test::FolderTest {
 protected:
  // Why `name` cannot be written, from behind the folder on.
  [[nodiscard]] std::string refusal(const std::string& name) const {
    const Failure failed = write_file(path(name), "new");
    if (!failed) return "";
    EXPECT_EQ(failed->kind, ErrorKind::kFile);
    std::string message = failed->message;
    const std::string folder = path("");
    for (std::size_t at = 0; (at = message.find(folder)) != std::string::npos;) {
      message.erase(at, folder.size());
    }
    return message;
  }

  TemporaryFolder elsewhere_;
};

TEST_F(AtomicFileTest, APlantedLinkIsNotFollowed) {
  elsewhere_.put("victim", "old");
  fs::create_symlink(elsewhere_.file("victim"), path("a.csv.partial"));
  EXPECT_EQ(refusal("a.csv"),
            "a.csv: cannot be written: a.csv.partial is a symbolic link; remove it");
  fs::create_symlink(elsewhere_.file("not there"), path("b.csv.partial"));
  EXPECT_EQ(refusal("b.csv"),
            "b.csv: cannot be written: b.csv.partial is a symbolic link; remove it");
  EXPECT_EQ(elsewhere_.content("victim"), "old");
  EXPECT_FALSE(fs::exists(elsewhere_.file("not there")));
}

TEST_F(AtomicFileTest, AFileWithAnotherNameIsNotWritten) {
  elsewhere_.put("victim", "old");
  fs::create_hard_link(elsewhere_.file("victim"), path("a.csv.partial"));
  EXPECT_EQ(refusal("a.csv"),
            "a.csv: cannot be written: a.csv.partial has a second name; remove it");
  EXPECT_EQ(elsewhere_.content("victim"), "old");
}

TEST_F(AtomicFileTest, APipeOrAFolderIsNotWaitedFor) {
  ASSERT_EQ(mkfifo(path("a.partial").c_str(), 0600), 0);
  EXPECT_EQ(refusal("a"), "a: cannot be written: a.partial is not a regular file; remove it");
  fs::create_directory(path("b.partial"));
  EXPECT_EQ(refusal("b"), "b: cannot be written: b.partial is not a regular file; remove it");
}

// A pipe with a reader would accept writes.
TEST_F(AtomicFileTest, APipeThatSomebodyReadsIsNotWrittenEither) {
  ASSERT_EQ(mkfifo(path("a.partial").c_str(), 0600), 0);
  const int reader = open(path("a.partial").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  EXPECT_EQ(refusal("a"), "a: cannot be written: a.partial is not a regular file; remove it");
  char byte = 0;
  EXPECT_EQ(read(reader, &byte, 1), 0);
  close(reader);
}

TEST_F(AtomicFileTest, ALinkAtTheNameIsReplacedAndNotFollowed) {
  elsewhere_.put("victim", "old");
  fs::create_symlink(elsewhere_.file("victim"), path("a"));
  EXPECT_EQ(refusal("a"), "");
  EXPECT_FALSE(fs::is_symlink(path("a")));
  EXPECT_EQ(content("a"), "new");
  EXPECT_EQ(elsewhere_.content("victim"), "old");
}

TEST_F(AtomicFileTest, ARecordingAndItsSidecarFollowNoLinkEither) {
  elsewhere_.put("victim", "old");
  for (const char* name : {"a.csv.partial", "a.toml.partial.partial"}) {
    fs::create_symlink(elsewhere_.file("victim"), path(name));
    auto writer = RecordingWriter::create(path("a.csv"), csv_columns(true));
    const Failure failed = writer ? (*writer)->note(Scene{}, {}) : Failure(writer.error());
    ASSERT_TRUE(failed) << name;
    EXPECT_THAT(failed->message, HasSubstr("is a symbolic link"));
    fs::remove(path(name));
  }
  EXPECT_EQ(elsewhere_.content("victim"), "old");
}

TEST_F(AtomicFileTest, RecoveryFollowsNoLink) {
  elsewhere_.put("victim", "tick,time_s\nold\n");
  put("a.toml.partial", "[recording]\n");
  fs::create_symlink(elsewhere_.file("victim"), path("a.csv.partial"));
  const auto recovered = recover_recording(path("a.csv"));
  ASSERT_FALSE(recovered);
  EXPECT_EQ(recovered.error().kind, ErrorKind::kFile);
  EXPECT_THAT(recovered.error().message, HasSubstr("a.csv.partial is a symbolic link"));
  EXPECT_EQ(elsewhere_.content("victim"), "tick,time_s\nold\n");
  EXPECT_TRUE(fs::is_symlink(path("a.csv.partial")));
}

// A link to an endless file would be read to the end of memory.
TEST_F(AtomicFileTest, ADeviceOrAFolderIsNoSidecar) {
  fs::create_symlink("/dev/zero", path("a.toml"));
  EXPECT_FALSE(may_replace_sidecar(path("a.toml"), kRecordingTable));
  fs::create_directory(path("b.toml"));
  EXPECT_FALSE(may_replace_sidecar(path("b.toml"), kRecordingTable));
  EXPECT_TRUE(may_replace_sidecar(path("c.toml"), kRecordingTable));
}

TEST_F(AtomicFileTest, AFullDiskAndAQuotaAreNamedAndNothingHasTheName) {
  for (const int code : {ENOSPC, EDQUOT, EIO, EFBIG}) {
    FaultyDisk disk;
    disk.fail_after(2, code);
    EXPECT_EQ(refusal("a"), "a: could not be written: " + std::generic_category().message(code));
    EXPECT_THAT(files(), IsEmpty());
  }
}

TEST_F(AtomicFileTest, AKeptFileIsThereToTheLastByte) {
  auto file = AtomicFile::create(path("a"));
  ASSERT_TRUE(file);
  file->keep_partial();
  ASSERT_FALSE(file->write("0123"));
  FaultyDisk disk;
  disk.fail_after(3, EDQUOT);
  const Failure failed = file->write("456789");
  ASSERT_TRUE(failed);
  EXPECT_THAT(failed->message, HasSubstr("(the written part is in "));
  EXPECT_EQ(content("a.partial"), "0123456");
  EXPECT_THAT(files(), ::testing::ElementsAre("a.partial"));
}

TEST_F(AtomicFileTest, AFileThatIsNotOnTheDiskGetsNoName) {
  FaultyDisk disk;
  disk.fail_sync(EIO);
  EXPECT_EQ(refusal("a"), "a: could not be written: Input/output error");
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(AtomicFileTest, ARemovedFolderIsSeenAtTheNextWrite) {
  fs::create_directory(path("sub"));
  auto file = AtomicFile::create(path("sub/a"));
  ASSERT_TRUE(file);
  file->keep_partial();
  ASSERT_FALSE(file->write("x"));
  fs::remove_all(path("sub"));
  const Failure failed = file->write("y");
  ASSERT_TRUE(failed);
  EXPECT_EQ(failed->kind, ErrorKind::kFile);
  EXPECT_THAT(failed->message, HasSubstr("sub/a.partial was removed during the writing"));
  EXPECT_TRUE(file->commit());
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(AtomicFileTest, AMovedFolderIsWrittenToTheEndAndToldOf) {
  fs::create_directory(path("sub"));
  auto file = AtomicFile::create(path("sub/a"));
  ASSERT_TRUE(file);
  file->keep_partial();
  ASSERT_FALSE(file->write("x"));
  fs::rename(path("sub"), path("moved"));
  ASSERT_FALSE(file->write("y"));
  const Failure failed = file->commit();
  ASSERT_TRUE(failed);
  EXPECT_THAT(failed->message, HasSubstr("sub/a.partial was moved during the writing"));
  EXPECT_EQ(content("moved/a.partial"), "xy");
  EXPECT_FALSE(fs::exists(path("moved/a")));
}

// A new file of this name belongs to another process: it is neither renamed nor removed.
TEST_F(AtomicFileTest, AnotherFileOfTheNameIsLeftAlone) {
  {
    auto file = AtomicFile::create(path("a"));
    ASSERT_TRUE(file);
    fs::remove(path("a.partial"));
    put("a.partial", "theirs");
    EXPECT_TRUE(file->commit());
  }
  EXPECT_FALSE(fs::exists(path("a")));
  EXPECT_EQ(content("a.partial"), "theirs");
}

// As root, drops to another user in a child process, because root ignores permissions.
TEST_F(AtomicFileTest, AFolderThatIsReadOnlyIsToldAtOnce) {
  constexpr uid_t kNobody = 65534;
  fs::permissions(path(""), fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                fs::perms::others_exec);
  const pid_t child = fork();
  if (child == 0) {
    if (geteuid() == 0 && setresuid(kNobody, kNobody, kNobody) != 0) _exit(2);
    const auto writer = RecordingWriter::create(path("a.csv"), csv_columns(true));
    const bool told = !writer && writer.error().kind == ErrorKind::kFile &&
                      writer.error().message.ends_with("cannot be written: Permission denied");
    _exit(told ? 0 : 1);
  }
  int state = -1;
  ASSERT_EQ(waitpid(child, &state, 0), child);
  fs::permissions(path(""), fs::perms::owner_all);
  EXPECT_TRUE(WIFEXITED(state) && WEXITSTATUS(state) == 0) << state;
  EXPECT_THAT(files(), IsEmpty());
}

}  // namespace
}  // namespace hapticwall::file
