// A session on a disk that is full, has a quota, is slow or goes away: it is told at once, the loop
// goes on, and what was written is there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

#include "app/file/recording/recording_reader.h"
#include "app/file/recording/recovery.h"
#include "tests/app/file/faulty_disk.h"
#include "tests/app/session/session_support.h"

namespace hapticwall::session {
namespace {

namespace fs = std::filesystem;
using file::test::FaultyDisk;
using test::contact_scene;
using test::eventually;
using test::rows_reach;
using test::started;
using test::TemporaryFolder;
using test::text_of;
using test::ticks_reach;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr std::uint64_t kTicksAfter = 100;

void expect_going_on(LiveSession& session) {
  EXPECT_TRUE(ticks_reach(session, session.snapshot().timing.ticks + kTicksAfter));
}

bool has_failed(const LiveSession& session) {
  return session.recording_status().state == RecordingState::kFailed;
}

// Returns when how the session began is noted: later the note would take of the disk's room.
void start_recording(LiveSession& session, const TemporaryFolder& folder) {
  ASSERT_FALSE(session.start_recording(folder.file("a.csv")));
  ASSERT_TRUE(test::note_says(session, folder.file("a.toml.partial"), "repeatable = true"));
}

TEST(SessionDisk, FullOrOverItsQuotaItIsToldWhileTheLoopGoesOn) {
  constexpr std::size_t kRoomBytes = 20'000;
  for (const int code : {ENOSPC, EDQUOT}) {
    const TemporaryFolder folder;
    const auto session = started(contact_scene());
    start_recording(*session, folder);
    FaultyDisk disk;
    disk.fail_after(kRoomBytes, code);
    ASSERT_TRUE(eventually([&] { return has_failed(*session); }));
    EXPECT_THAT(
        session->recording_status().error,
        AllOf(HasSubstr("a.csv: could not be written: " + std::generic_category().message(code)),
              HasSubstr("(the written part is in ")));
    expect_going_on(*session);
    const Failure failure = session->stop_recording();
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->kind, ErrorKind::kFile);
    EXPECT_FALSE(fs::exists(folder.file("a.csv")) || fs::exists(folder.file("a.toml")));
    EXPECT_EQ(fs::file_size(folder.file("a.csv.partial")), kRoomBytes);
  }
}

TEST(SessionDisk, RowsThatFoundRoomAreRecoveredLater) {
  constexpr std::size_t kRoomBytes = 20'000;
  const TemporaryFolder folder;
  {
    const auto session = started(contact_scene());
    start_recording(*session, folder);
    FaultyDisk disk;
    disk.fail_after(kRoomBytes, ENOSPC);
    ASSERT_TRUE(eventually([&] { return has_failed(*session); }));
  }
  const std::string partial = text_of(folder.file("a.csv.partial"));
  const auto recovered = file::recover_recording(folder.file("a.csv"));
  ASSERT_TRUE(recovered) << recovered.error().message;
  EXPECT_EQ(text_of(folder.file("a.csv")), partial.substr(0, partial.rfind('\n') + 1));
  EXPECT_GE(recovered->rows, 50U);
}

TEST(SessionDisk, SlowItCostsRowsAndNoTicks) {
  const TemporaryFolder folder;
  SessionOptions options;
  options.queues.recorder = 512;
  const auto session = started(contact_scene(), options);
  FaultyDisk disk;
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  disk.hold();
  ASSERT_TRUE(eventually([&] { return disk.holds_somebody(); }));
  ASSERT_TRUE(eventually([&] { return session->recording_status().dropped_rows >= 50; }));
  EXPECT_EQ(session->recording_status().state, RecordingState::kRecording);
  expect_going_on(*session);
  ASSERT_TRUE(disk.holds_somebody()) << "all that was while the disk did nothing";
  disk.release();
  const std::uint64_t written = session->recording_status().rows;
  ASSERT_TRUE(eventually([&] { return session->recording_status().rows > written + 600; }));
  const Failure failure = session->stop_recording();
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, ErrorKind::kFile);
  EXPECT_THAT(failure->message, EndsWith("rows are missing (the disk was too slow); marked as "
                                         "incomplete"));
  const RecordingStatus status = session->recording_status();
  EXPECT_EQ(status.state, RecordingState::kFailed);
  EXPECT_EQ(status.error, failure->message);
  const auto reader = file::RecordingReader::open(folder.file("a.csv"));
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ((*reader)->rows(), status.rows);
  EXPECT_EQ((*reader)->info().scanned.missing_rows, status.dropped_rows);
  EXPECT_THAT(
      text_of(folder.file("a.toml")),
      HasSubstr("dropped_rows = " + std::to_string(status.dropped_rows) + "\ncomplete = false\n"));
}

TEST(SessionDisk, AFolderThatIsRemovedIsToldAtOnce) {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("sub"));
  const auto session = started(contact_scene());
  ASSERT_FALSE(session->start_recording(folder.file("sub/a.csv")));
  ASSERT_TRUE(rows_reach(*session, 10));
  fs::remove_all(folder.file("sub"));
  ASSERT_TRUE(eventually([&] { return has_failed(*session); }));
  EXPECT_THAT(session->recording_status().error,
              HasSubstr("a.csv.partial was removed during the writing"));
  expect_going_on(*session);
  ASSERT_FALSE(session->start_recording(folder.file("b.csv"))) << "the next one, elsewhere";
  ASSERT_TRUE(rows_reach(*session, 10));
  EXPECT_FALSE(session->stop_recording());
}

TEST(SessionDisk, AFolderThatIsMovedKeepsEveryRow) {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("sub"));
  const auto session = started(contact_scene());
  ASSERT_FALSE(session->start_recording(folder.file("sub/a.csv")));
  ASSERT_TRUE(rows_reach(*session, 10));
  fs::rename(folder.file("sub"), folder.file("moved"));
  const std::uint64_t rows = session->recording_status().rows;
  ASSERT_TRUE(eventually([&] { return session->recording_status().rows >= rows + 50; }));
  const Failure failure = session->stop_recording();
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, ErrorKind::kFile);
  EXPECT_THAT(failure->message, HasSubstr("sub/a.csv.partial was moved during the writing"));
  EXPECT_FALSE(fs::exists(folder.file("sub")));
  const auto recovered = file::recover_recording(folder.file("moved/a.csv"));
  ASSERT_TRUE(recovered) << recovered.error().message;
  EXPECT_EQ(recovered->rows, session->recording_status().rows);
}

}  // namespace
}  // namespace hapticwall::session
