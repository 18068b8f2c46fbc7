// Files that are dropped, typed, or opened again.
#include "app/ui/state/recent_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST(RecentFiles, TheNewestComesFirstAndOnlyOnce) {
  std::vector<std::string> recent;
  ui::remember_recent(recent, "/a");
  ui::remember_recent(recent, "/b");
  ui::remember_recent(recent, "/x/../a");
  EXPECT_EQ(recent, (std::vector<std::string>{"/a", "/b"}));
  for (int i = 0; i < 30; ++i) ui::remember_recent(recent, "/" + std::to_string(i));
  EXPECT_EQ(recent.size(), ui::kMaxRecentFiles);
  EXPECT_EQ(recent.front(), "/29");
}

TEST(RecentFiles, AreAbsolutePaths) {
  std::vector<std::string> recent;
  ui::remember_recent(recent, "here.toml");
  EXPECT_EQ(recent.front(), (fs::current_path() / "here.toml").string());
}

class FilesTest : public GuiTest {
 protected:
  void SetUp() override {
    GuiTest::SetUp();
    Scene scene = file::load_scene("press")->scene;
    scene.name = "mine";
    scene.x().walls[0].stiffness_n_per_m = 4321.0;
    put("mine.toml", file::scene_to_toml(scene));
  }
  [[nodiscard]] const std::vector<std::string>& recent() const { return state().scene.recent; }
};

TEST_F(FilesTest, ADroppedSceneStartsFromRest) {
  live(500);
  drop("mine.toml");
  EXPECT_EQ(sessions, 2);
  EXPECT_EQ(scene().name, "mine");
  EXPECT_EQ(wall().stiffness_n_per_m, 4321.0);
  EXPECT_FALSE(sees("reset to scene")) << "the dropped scene is the loaded one";
  EXPECT_EQ(recent(), std::vector<std::string>{path("mine.toml")});
}

TEST_F(FilesTest, ABrokenSceneIsReportedAndTheSessionContinues) {
  put("broken.toml", "[device]\nmass_kg = \"heavy\"\n");
  live(300);
  drop("broken.toml");
  EXPECT_EQ(sessions, 1);
  EXPECT_EQ(message().kind, ui::MessageKind::kProblem);
  EXPECT_THAT(message().text, HasSubstr("broken.toml:2"));
  EXPECT_TRUE(recent().empty());
  drop("nothing.toml");
  EXPECT_THAT(message().text, HasSubstr("nothing.toml"));
  EXPECT_EQ(newest().tick, 299U);
}

TEST_F(FilesTest, ARecordingThatIsNotThereIsNotLookedFor) {
  drop("nothing.csv");
  EXPECT_THAT(message().text, HasSubstr("there is no such recording"));
  EXPECT_FALSE(state().replay.opening.running());
  EXPECT_TRUE(recent().empty());
}

TEST_F(FilesTest, AnOpenedFileIsInTheListOfScenes) {
  drop("mine.toml");
  click("scene");
  click("scene press");
  EXPECT_EQ(scene().name, "press");
  click("scene");
  click("recent 1");
  EXPECT_EQ(scene().name, "mine");
  fs::remove(path("mine.toml"));
  click("scene");
  click("recent 1");
  EXPECT_TRUE(recent().empty()) << "a missing file leaves the list";
}

TEST_F(FilesTest, TheFileOfTheCommandLineIsTheNewest) {
  options.opened_file = path("mine.toml");
  open("press");
  EXPECT_EQ(recent(), std::vector<std::string>{path("mine.toml")});
}

}  // namespace
}  // namespace hapticwall::test
