// A live recording that is cut off: what the session noted of it by then is enough to finish it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "app/file/recording/recording_reader.h"
#include "app/file/recording/recovery.h"
#include "app/file/scene/scene_file.h"
#include "tests/app/session/session_support.h"

namespace hapticwall::session {
namespace {

using test::algorithm;
using test::contact_scene;
using test::eventually;
using test::generation_is;
using test::lines_of;
using test::note_says;
using test::repeated_rows;
using test::rows_reach;
using test::started;
using test::started_paused;
using test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

// The lines below the header.
std::vector<std::string> rows_of(const std::string& path) {
  std::vector<std::string> lines = lines_of(path);
  if (!lines.empty()) lines.erase(lines.begin());
  return lines;
}

// Copies the files as they are at this moment to the name b, like the files after a kill.
void keep_what_is_there(const TemporaryFolder& folder) {
  for (const char* ending : {".csv.partial", ".toml.partial"}) {
    std::filesystem::copy_file(folder.file(std::string("a") + ending),
                               folder.file(std::string("b") + ending),
                               std::filesystem::copy_options::overwrite_existing);
  }
}

// The notes of the recovery of b.
std::vector<std::string> notes_of_recovery(const TemporaryFolder& folder) {
  const auto recovered = file::recover_recording(folder.file("b.csv"));
  EXPECT_TRUE(recovered.ok()) << recovered.error().message;
  return recovered.ok() ? recovered->notes : std::vector<std::string>{"not recovered"};
}

// The note of a says that the rows can be repeated, with the fourth algorithm from the start.
void expect_noted_from_the_start(LiveSession& session, const TemporaryFolder& folder) {
  ASSERT_TRUE(note_says(session, folder.file("a.toml.partial"), "repeatable = true"));
  const auto noted = file::parse_scene(folder.content("a.toml.partial"), "noted");
  ASSERT_TRUE(noted.ok()) << noted.error().message;
  EXPECT_EQ(noted->scene.algorithm.index, 3U);
  EXPECT_THAT(noted->changes, SizeIs(0));
}

TEST(SessionRecovery, ChangesAndMarksAreThereAndTheRowsRepeat) {
  const TemporaryFolder folder;
  const auto session = started(contact_scene());
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  EXPECT_THAT(folder.content("a.toml.partial"), HasSubstr("[recording]"));
  ASSERT_TRUE(rows_reach(*session, 11));
  ASSERT_FALSE(session->set_algorithm(algorithm(3)));
  ASSERT_TRUE(note_says(*session, folder.file("a.toml.partial"), "[[recording.change]]"));
  ASSERT_FALSE(session->mark("here"));
  ASSERT_TRUE(note_says(*session, folder.file("a.toml.partial"), "text = \"here\""));
  keep_what_is_there(folder);
  ASSERT_FALSE(session->stop_recording());
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.toml.partial")));

  EXPECT_THAT(notes_of_recovery(folder), SizeIs(0));
  const auto reader = file::RecordingReader::open(folder.file("b.csv"));
  ASSERT_TRUE(reader.ok()) << reader.error().message;
  EXPECT_THAT((*reader)->info().notes, SizeIs(0)) << "its SHA-256 is right";
  EXPECT_THAT((*reader)->info().loaded.changes, SizeIs(1));
  EXPECT_THAT((*reader)->info().loaded.marks, SizeIs(1));
  EXPECT_EQ(repeated_rows(folder.file("b.toml")), rows_of(folder.file("b.csv")));
}

TEST(SessionRecovery, APointerThatLedTheHandIsNotForgotten) {
  const TemporaryFolder folder;
  const auto session = started(contact_scene());
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  session->move_hand(test::hand_to(0.04));
  ASSERT_TRUE(note_says(*session, folder.file("a.toml.partial"), "the pointer led"));
  ASSERT_TRUE(rows_reach(*session, 11));
  ASSERT_TRUE(eventually([&] { return rows_of(folder.file("a.csv.partial")).size() > 1; }));
  keep_what_is_there(folder);
  EXPECT_THAT(notes_of_recovery(folder), ElementsAre(HasSubstr("the pointer led the hand")));
}

// The note of it had not reached the disk: the rows themselves tell.
TEST(SessionRecovery, AHandThatHasLeftItsPathIsNotTakenForItsScript) {
  const TemporaryFolder folder;
  const auto session = started(contact_scene());
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  ASSERT_TRUE(note_says(*session, folder.file("a.toml.partial"), "repeatable = true"));
  keep_what_is_there(folder);
  session->move_hand(test::hand_to(0.04));
  ASSERT_TRUE(eventually([&] {
    const double intended_m = session->snapshot().newest.x().truth.hand_path_m;
    return intended_m < 0.045;
  }));
  const std::size_t before = rows_of(folder.file("a.csv.partial")).size();
  ASSERT_TRUE(
      eventually([&] { return rows_of(folder.file("a.csv.partial")).size() > before + 300; }));
  std::filesystem::copy_file(folder.file("a.csv.partial"), folder.file("b.csv.partial"),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT(notes_of_recovery(folder), ElementsAre(HasSubstr("something else led it")));
}

// Nothing counts as a change before the first tick, and yet the scene is another one.
TEST(SessionRecovery, AChangeBeforeTheFirstTickIsNotForgotten) {
  const TemporaryFolder folder;
  const auto session = started_paused(contact_scene());
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  EXPECT_THAT(folder.content("a.toml.partial"), HasSubstr("before it was known how it began"));
  ASSERT_FALSE(session->set_algorithm(algorithm(3)));
  session->pause(false);
  expect_noted_from_the_start(*session, folder);
}

// ... also where the session has been changed and reset before.
TEST(SessionRecovery, AnEarlierRunsChangesAreNotTakenForThisOnes) {
  const TemporaryFolder folder;
  const auto session = started(contact_scene());
  ASSERT_TRUE(eventually([&] { return session->snapshot().newest.x().tick > 10; }));
  ASSERT_FALSE(session->set_algorithm(algorithm(3)));
  ASSERT_TRUE(generation_is(*session, 2));
  session->pause(true);
  ASSERT_TRUE(eventually([&] { return session->snapshot().paused; }));
  session->reset();
  ASSERT_FALSE(session->start_recording(folder.file("a.csv")));
  EXPECT_THAT(folder.content("a.toml.partial"), HasSubstr("repeatable = false"));
  session->pause(false);
  expect_noted_from_the_start(*session, folder);
}

}  // namespace
}  // namespace hapticwall::session
