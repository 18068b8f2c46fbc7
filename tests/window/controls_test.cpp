// Every control of the window has a test: a row here, or one in tests/app/ui that names it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <span>
#include <string>

#include "app/file/scene/scene_file.h"
#include "app/runtime/session/experiment.h"
#include "tests/paths.h"
#include "tests/temporary_folder.h"
#include "tests/window/rows.h"
#include "tests/window/window_test.h"

namespace hapticwall::test {
namespace {

class ControlsTest : public WindowTest {
 protected:
  void use_simulator() {
    const std::string scene = home_.write_scene("mine", "tap");
    use([&](Person& person) {
      use_all(person, "head", head_rows());
      use_all(person, "toolbar", toolbar_rows());
      use_all(person, "scene", scene_rows(scene));
      use_all(person, "algorithm", algorithm_rows());
      use_all(person, "wall", wall_rows());
      use_all(person, "hand", hand_rows());
      use_all(person, "device", device_rows());
      use_all(person, "loop", loop_rows());
      use_all(person, "views", view_rows());
      use_all(person, "plot controls", plot_control_rows());
      use_all(person, "plots", plot_rows());
      use_all(person, "overlays", overlay_rows());
      use_all(person, "pages", page_rows());
      use_all(person, "recordings", recording_rows());
      use_all(person, "corner", corner_rows());
    });
  }

  void use_experiment() {
    const std::string list = home_.folder() / "list.csv";
    const std::string answers = home_.folder() / "answers.csv";
    std::ofstream(list) << "kind,a,b\ntest,,wall.stiffness_n_per_m=1000\nbreak,,\n"
                           "catch,wall.position_m=0.04,wall.position_m=0.04\ntest,,\n";
    const auto experiment = runtime::open_experiment(
        {list, "P1", "1", answers}, [](std::span<const std::string> overrides) -> Result<Scene> {
          return file::load_scene("press", overrides)->scene;
        });
    ASSERT_TRUE(experiment.ok()) << experiment.error().message;
    options_.experiment = *experiment;
    use([&](Person& person) { use_all(person, "experiment", experiment_rows()); });
    EXPECT_EQ(lines_of(answers).size(), 3U);
    options_.experiment.reset();
  }

  void use_device() {
    connect_device();
    use([&](Person& person) {
      use_all(person, "link", link_rows());
      person.click("step");
      EXPECT_EQ(device().steps, 0) << "it is not paused";
      person.click("arm");
      EXPECT_EQ(device().arm_requests, std::vector{true});
      device().arming.state = runtime::ArmingState::kOn;
      person.wait_a_frame();
      person.click("arm");
      EXPECT_EQ(device().arm_requests, (std::vector{true, false}));
    });
  }
};

// The words between quotes in the tests of the panels.
std::set<std::string> words_of_panel_tests() {
  std::set<std::string> words;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(data_folder() + "/app/ui")) {
    if (!entry.is_regular_file()) continue;
    const std::string text = text_of(entry.path());
    for (std::size_t begin = text.find('"'); begin != std::string::npos;) {
      const std::size_t end = text.find_first_of("\"\n", begin + 1);
      if (end == std::string::npos) break;
      if (text[end] == '"') words.insert(text.substr(begin + 1, end - begin - 1));
      begin = text.find('"', end + 1);
    }
  }
  return words;
}

// By its name, or by the beginning of several names: "legend ".
bool is_named(const std::set<std::string>& words, const std::string& item) {
  return std::ranges::any_of(words, [&](const std::string& word) {
    return item == word || (word.ends_with(' ') && item.starts_with(word));
  });
}

TEST_P(ControlsTest, EachIsUsedHereOrNamedByATestOfItsPanel) {
  use_simulator();
  use_experiment();
  use_device();
  // These exist only while a task runs.
  for (const char* passing : {"cancel re-run", "cancel opening"}) log_.used.insert(passing);
  const std::set<std::string> words = words_of_panel_tests();
  std::set<std::string> forgotten;
  for (const std::string& item : log_.seen) {
    if (!log_.used.contains(item) && !is_named(words, item)) forgotten.insert(item);
  }
  EXPECT_TRUE(forgotten.empty()) << "no test names these controls; add tests to tests/app/ui, or "
                                    "rows to tests/window/rows_*: "
                                 << ::testing::PrintToString(forgotten);
}

HAPTICWALL_ON_BOTH_SCREENS(ControlsTest);

}  // namespace
}  // namespace hapticwall::test
