// Marks of recordings: to the sidecar and back, and refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/file/recording/recording_writer.h"
#include "app/file/recording/sidecar.h"
#include "app/file/scene/scene_file.h"

namespace hapticwall::file {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

std::string sidecar_of(const std::vector<Mark>& marks) {
  RecordingMetadata metadata;
  metadata.marks = marks;
  return sidecar_toml(Scene{}, metadata, {8, 0, 8, "0"});
}

std::string marks_message(const std::string& marks) {
  const std::string text = "[device]\nmass_kg = 0.1\ndamping_n_s_per_m = 1\n[recording]\n" + marks;
  const Result<LoadedScene> loaded = parse_scene(text, "a.toml");
  return loaded ? "none" : loaded.error().message;
}

TEST(Marks, ReadBackTheSame) {
  const std::vector<Mark> marks{
      {0, ""}, {7, "first touch"}, {7, "\"quoted\" \\ and 'so'"}, {123456789, "Größe 力"}};
  const std::string text = sidecar_of(marks);
  EXPECT_THAT(text, HasSubstr("[[recording.mark]]\ntick = 7\ntime_s = 0.007\n"
                              "text = \"first touch\"\n"));
  const Result<LoadedScene> loaded = parse_scene(text, "a.toml");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->marks, marks);
}

TEST(Marks, AFileWithoutThemHasNone) {
  const Result<LoadedScene> loaded = parse_scene(sidecar_of({}), "a.toml");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->marks.empty());
  EXPECT_EQ(sidecar_of({}).find("mark"), std::string::npos);
}

TEST(Marks, AsManyAsThereMayBeFitIntoASidecar) {
  const std::vector<Mark> marks(kMaxMarks, {99, std::string(kMaxMarkBytes, '"')});
  const std::string text = sidecar_of(marks);
  EXPECT_LT(text.size(), std::size_t{1} << 20U) << "more is not read";
  const Result<LoadedScene> loaded = parse_scene(text, "a.toml");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_THAT(loaded->marks, SizeIs(kMaxMarks));
  std::vector<Mark> more = marks;
  more.push_back(more.back());
  EXPECT_FALSE(parse_scene(sidecar_of(more), "a.toml"));
}

TEST(Marks, ASpoiltOneIsFoundWithItsLine) {
  EXPECT_EQ(marks_message("[[recording.mark]]\ntick = 1\n[[recording.mark]]\ntick = 3.5\n"),
            "a.toml:8: recording.mark[1].tick: 3.5 where a whole number from 0 on belongs");
  EXPECT_THAT(marks_message("[[recording.mark]]\ntext = \"a\"\n"),
              AllOf(StartsWith("a.toml:5: recording.mark[0].tick is missing")));
  EXPECT_EQ(marks_message("[[recording.mark]]\ntick = 1\ntext = \"a\\tb\"\n"),
            "a.toml:7: recording.mark[0].text: has a control character");
  EXPECT_EQ(marks_message("[[recording.mark]]\ntick = 1\ntext = \"" +
                          std::string(kMaxMarkBytes + 1, 'x') + "\"\n"),
            "a.toml:7: recording.mark[0].text: longer than 200 bytes");
  EXPECT_EQ(marks_message("[[recording.mark]]\ntick = 2\n[[recording.mark]]\ntick = 1\n"),
            "a.toml:7: recording.mark: the ticks of the marks are not in order");
  EXPECT_THAT(marks_message("[[recording.mark]]\ntick = 1\nnote = \"a\"\n"),
              HasSubstr("a.toml:7: recording.mark[0].note: unknown key"));
  EXPECT_THAT(marks_message("[recording.mark]\ntick = 1\n"),
              EndsWith("a table where an array of tables, [[mark]] belongs"));
}

TEST(Marks, WhatIsTypedIsKeptAsFarAsItMayBe) {
  EXPECT_EQ(mark_text("first touch"), "first touch");
  EXPECT_EQ(mark_text("a\nb\x7f"), "a?b?");
  EXPECT_EQ(mark_text("\xff\xc3"), "??");
  for (const std::string& piece :
       {std::string("x"), std::string("ö"), std::string("力"), std::string("\xf0\x9f\x96\x90")}) {
    std::string typed;
    while (typed.size() < 3 * kMaxMarkBytes) typed += piece;
    for (std::size_t shift = 0; shift < 4; ++shift) {
      const std::string text = mark_text(std::string(shift, ' ') + typed);
      EXPECT_LE(text.size(), kMaxMarkBytes);
      EXPECT_GT(text.size(), kMaxMarkBytes - 10);
      const Result<LoadedScene> loaded = parse_scene(sidecar_of({{1, text}}), "a.toml");
      ASSERT_TRUE(loaded) << loaded.error().message;
      EXPECT_EQ(loaded->marks.at(0).text, text);
    }
  }
}

}  // namespace
}  // namespace hapticwall::file
