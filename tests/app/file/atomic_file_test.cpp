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

TEST_F(AtomicFileTest, ALinkAtTheNameStaysAndItsTargetIsWritten) {
  elsewhere_.put("target", "old");
  fs::create_symlink(elsewhere_.file("target"), path("b"));
  fs::create_symlink("b", path("a"));
  {
    auto file = AtomicFile::create(path("a"));
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_FALSE(file->write("half"));
    EXPECT_EQ(elsewhere_.content("target"), "old");
  }
  EXPECT_EQ(refusal("a"), "");
  EXPECT_TRUE(fs::is_symlink(path("a")) && fs::is_symlink(path("b")));
  EXPECT_EQ(elsewhere_.content("target"), "new");
  EXPECT_THAT(elsewhere_.names(), ::testing::ElementsAre("target"));
}

TEST_F(AtomicFileTest, ALinkToAFileThatIsNotThereYetMakesIt) {
  fs::create_symlink(elsewhere_.file("target"), path("a"));
  EXPECT_EQ(refusal("a"), "");
  EXPECT_TRUE(fs::is_symlink(path("a")));
  EXPECT_EQ(elsewhere_.content("target"), "new");
}

TEST_F(AtomicFileTest, ACircleOfLinksIsRefused) {
  fs::create_symlink("b", path("a"));
  fs::create_symlink("a", path("b"));
  EXPECT_EQ(refusal("a"), "a: cannot be written: its link leads nowhere");
}

TEST_F(AtomicFileTest, ADeviceAPipeOrAnOpenFileIsNeverReplaced) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/null", path("device"));
  fs::create_symlink("/proc/self/fd/1", path("output"));
  for (const char* name : {"pipe", "device", "output"}) {
    EXPECT_EQ(refusal(name),
              std::string(name) + ": cannot be written: it exists and is not a regular file");
  }
  put("open", "old");
  const int descriptor = open(path("open").c_str(), O_WRONLY | O_CLOEXEC);
  const std::string of_process = "/proc/self/fd/" + std::to_string(descriptor);
  fs::create_symlink(of_process, path("a"));
  for (const std::string& named : {path("a"), of_process}) {
    const auto place = output_place(named);
    ASSERT_TRUE(place);
    EXPECT_EQ(place->kind, PlaceKind::kStream);
    EXPECT_EQ(place->descriptor, descriptor);
    EXPECT_TRUE(write_file(named, "new"));
  }
  close(descriptor);
  EXPECT_EQ(content("open"), "old");
}

// Only as root can a test make files of another user.
TEST_F(AtomicFileTest, FilesOfOthersAreRefused) {
  constexpr uid_t kNobody = 65534;
  put("a.partial", "theirs");
  chmod(path("a.partial").c_str(), 0664);
  EXPECT_EQ(refusal("a"), "a: cannot be written: a.partial can be written by others; remove it");
  chmod(path("a.partial").c_str(), 0646);
  EXPECT_EQ(refusal("a"), "a: cannot be written: a.partial can be written by others; remove it");
  EXPECT_EQ(content("a.partial"), "theirs");
  chmod(path("a.partial").c_str(), 0644);
  EXPECT_EQ(refusal("a"), "");
  if (geteuid() != 0) GTEST_SKIP() << "needs root";
  put("b.partial", "theirs");
  ASSERT_EQ(chown(path("b.partial").c_str(), kNobody, kNobody), 0);
  EXPECT_EQ(refusal("b"), "b: cannot be written: b.partial belongs to another user; remove it");
  fs::create_symlink("target", path("c"));
  ASSERT_EQ(lchown(path("c").c_str(), kNobody, kNobody), 0);
  EXPECT_EQ(refusal("c"), "c: cannot be written: it is a symbolic link of another user");
}

TEST_F(AtomicFileTest, AReadOnlyFileIsNotReplacedNotEvenByRoot) {
  for (const char* name : {"a", "a.csv", "b.toml"}) {
    put(name, "[recording]\n");
    chmod(path(name).c_str(), 0444);
  }
  EXPECT_EQ(refusal("a"),
            "a: cannot be written: it is read-only; choose another name, or 'chmod u+w' it");
  fs::create_symlink("a", path("link"));
  EXPECT_THAT(refusal("link"), HasSubstr("it is read-only"));
  for (const char* name : {"a.csv", "b.csv"}) {
    const auto writer = RecordingWriter::create(path(name), csv_columns(true));
    ASSERT_FALSE(writer);
    EXPECT_EQ(writer.error().kind, ErrorKind::kFile);
    EXPECT_THAT(writer.error().message, HasSubstr("read-only"));
  }
  EXPECT_THAT(files(), ::testing::ElementsAre("a", "a.csv", "b.toml", "link"));
}

TEST_F(AtomicFileTest, ANewFileFollowsTheUmaskAndIsResumedWithIt) {
  for (const mode_t mask : {0U, 0002U, 0022U, 0077U}) {
    const mode_t before = umask(mask);
    const std::string name = "a" + std::to_string(mask);
    {
      auto file = AtomicFile::create(path(name));
      ASSERT_TRUE(file);
      file->keep_partial();
    }
    EXPECT_EQ(refusal(name), "");
    umask(before);
    EXPECT_EQ(fs::status(path(name)).permissions(), static_cast<fs::perms>(0666U & ~mask));
  }
}

TEST_F(AtomicFileTest, AnOlderFileHasNoMoreWritersThanANewOne) {
  const mode_t before = umask(0002);
  put("a.partial", "");
  chmod(path("a.partial").c_str(), 0666);
  EXPECT_EQ(refusal("a"), "a: cannot be written: a.partial can be written by others; remove it");
  umask(before);
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
TEST_F(AtomicFileTest, ALinkOrAFolderIsNoSidecar) {
  fs::create_symlink("/dev/zero", path("a.toml"));
  EXPECT_EQ(sidecar_obstacle(path("a.toml"), kRecordingTable), "a link");
  fs::create_directory(path("b.toml"));
  EXPECT_EQ(sidecar_obstacle(path("b.toml"), kRecordingTable), "a file that is not a recording's");
  EXPECT_EQ(sidecar_obstacle(path("c.toml"), kRecordingTable), "");
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

// Root ignores permissions: as root, the test drops to another user in a child process.
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
