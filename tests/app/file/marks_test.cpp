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

using ::testing::HasSubstr;
using ::testing::SizeIs;

std::string sidecar_of(const std::vector<Mark>& marks) {
  RecordingMetadata metadata;
  metadata.marks = marks;
  return sidecar_toml(Scene{}, metadata, {8, 0, 8, "0"});
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

TEST(Marks, TypedTextIsKeptAsFarAsAllowed) {
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
