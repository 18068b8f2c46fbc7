// Marks that are set while a live session is recorded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "app/file/recording/recording_reader.h"
#include "app/file/recording/recording_writer.h"
#include "tests/app/session/session_support.h"

namespace hapticwall::session {
namespace {

using test::contact_scene;
using test::eventually;
using test::rows_reach;
using test::started;
using test::started_paused;
using test::TemporaryFolder;
using test::ticks_reach;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<file::Mark> marks_in(const std::string& csv_path) {
  const auto reader = file::RecordingReader::open(csv_path);
  if (!reader) throw std::runtime_error(reader.error().message);
  if (!(*reader)->info().has_sidecar) throw std::runtime_error((*reader)->info().notes.front());
  return (*reader)->info().loaded.marks;
}

TEST(SessionMarks, AreAtTheNewestTickAndReadBack) {
  const TemporaryFolder folder;
  const auto session = started_paused(contact_scene());
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  session->step(20);
  ASSERT_TRUE(eventually([&] { return session->snapshot().newest.x().tick == 19; }));
  EXPECT_FALSE(session->mark("here"));
  session->step(30);
  ASSERT_TRUE(eventually([&] { return session->snapshot().newest.x().tick == 49; }));
  EXPECT_FALSE(session->mark("a\nb"));
  EXPECT_THAT(session->marks(), SizeIs(2));
  ASSERT_FALSE(session->stop_recording());
  const std::vector<file::Mark> expected{{19, "here"}, {49, "a?b"}};
  EXPECT_EQ(marks_in(folder.file("a.csv")), expected);
  EXPECT_THAT(session->marks(), SizeIs(2)) << "still to be seen";
}

TEST(SessionMarks, TheNewestIsNamedLater) {
  const TemporaryFolder folder;
  const auto session = started_paused(contact_scene());
  session->name_mark("nothing to name");
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  session->name_mark("nothing to name");
  session->step(20);
  ASSERT_TRUE(eventually([&] { return session->snapshot().newest.x().tick == 19; }));
  ASSERT_FALSE(session->mark("first"));
  ASSERT_FALSE(session->mark(""));
  session->step(10);
  session->name_mark("tap");
  ASSERT_FALSE(session->stop_recording());
  const std::vector<file::Mark> expected{{19, "first"}, {19, "tap"}};
  EXPECT_EQ(marks_in(folder.file("a.csv")), expected);
}

TEST(SessionMarks, NeedARecording) {
  const auto session = started(contact_scene());
  const Failure failure = session->mark("nowhere");
  ASSERT_TRUE(failure);
  EXPECT_THAT(failure->message, HasSubstr("start one first"));
  EXPECT_THAT(session->marks(), IsEmpty());
}

TEST(SessionMarks, EachRecordingHasItsOwnAndAResetForgetsThem) {
  const TemporaryFolder folder;
  const auto session = started(contact_scene());
  for (const char* name : {"a", "b"}) {
    ASSERT_FALSE(session->start_recording(folder.file(std::string(name) + ".csv")));
    ASSERT_TRUE(rows_reach(*session, 11));
    EXPECT_FALSE(session->mark(name));
    ASSERT_FALSE(session->stop_recording());
  }
  EXPECT_THAT(session->marks(), SizeIs(2));
  ASSERT_THAT(marks_in(folder.file("b.csv")), SizeIs(1));
  EXPECT_EQ(marks_in(folder.file("b.csv")).front().text, "b");
  session->reset();
  EXPECT_THAT(session->marks(), IsEmpty());
  // The recording starts at once: the loop may not have gone back yet.
  ASSERT_FALSE(session->start_recording(folder.file("c.csv")));
  EXPECT_FALSE(session->mark("c"));
  ASSERT_TRUE(rows_reach(*session, 11));
  EXPECT_FALSE(session->mark("later"));
  ASSERT_FALSE(session->stop_recording());
  EXPECT_THAT(marks_in(folder.file("c.csv")), SizeIs(2));
}

TEST(SessionMarks, AreAlwaysAtARowHoweverEarly) {
  const TemporaryFolder folder;
  const auto session = started(contact_scene());
  ASSERT_TRUE(ticks_reach(*session, 50));
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  EXPECT_FALSE(session->mark("before the loop has heard of it"));
  ASSERT_TRUE(rows_reach(*session, 11));
  ASSERT_FALSE(session->stop_recording());
  const auto reader = file::RecordingReader::open(folder.file("a.csv"));
  ASSERT_TRUE(reader);
  ASSERT_THAT((*reader)->info().loaded.marks, SizeIs(1));
  const std::uint64_t tick = (*reader)->info().loaded.marks.front().tick;
  EXPECT_GE(tick, (*reader)->info().scanned.first_tick);
  EXPECT_LE(tick, (*reader)->info().scanned.last_tick);
}

TEST(SessionMarks, OneMoreThanThereMayBeIsRefused) {
  const TemporaryFolder folder;
  const auto session = started(contact_scene());
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  ASSERT_TRUE(rows_reach(*session, 1));
  for (std::size_t i = 0; i < file::kMaxMarks; ++i) ASSERT_FALSE(session->mark("again"));
  const Failure failure = session->mark("too many");
  ASSERT_TRUE(failure);
  EXPECT_THAT(failure->message, HasSubstr("at most 1000 marks"));
  ASSERT_FALSE(session->stop_recording());
  EXPECT_THAT(marks_in(folder.file("a.csv")), SizeIs(file::kMaxMarks));
}

}  // namespace
}  // namespace hapticwall::session
