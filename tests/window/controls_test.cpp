// A person uses every control of the window at least once; each row checks the effect.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <span>
#include <string>

#include "app/file/scene/scene_file.h"
#include "app/session/experiment.h"
#include "tests/window/rows.h"
#include "tests/window/window_test.h"

namespace hapticwall::test {
namespace {

class ControlsTest : public WindowTest {
 protected:
  void use_simulator() {
    const std::string scene = home_.write_scene("mine", "tap");
    const std::string two_walls = home_.write_scene_of_two_walls("two-walls");
    const std::string folder = (home_.folder() / "recordings").string();
    use([&](Person& person) {
      use_all(person, "head", head_rows(folder));
      use_all(person, "toolbar", toolbar_rows());
      use_all(person, "scene", scene_rows(scene));
      use_all(person, "algorithm", algorithm_rows());
      use_all(person, "wall", wall_rows(two_walls));
      use_all(person, "hand", hand_rows());
      use_all(person, "device", device_rows());
      use_all(person, "loop", loop_rows());
      use_all(person, "views", view_rows());
      use_all(person, "plot controls", plot_control_rows());
      use_all(person, "plots", plot_rows());
      use_all(person, "status", status_rows());
      use_all(person, "overlays", overlay_rows());
      use_all(person, "pages", page_rows());
      use_all(person, "compare", compare_rows());
      use_all(person, "recordings", recording_rows());
      use_all(person, "corner", corner_rows());
    });
  }

  void use_experiment() {
    const std::string list = home_.folder() / "list.csv";
    const std::string answers = home_.folder() / "answers.csv";
    std::ofstream(list) << "kind,a,b\ntest,,wall.stiffness_n_per_m=1000\nbreak,,\n"
                           "catch,wall.position_m=0.04,wall.position_m=0.04\n"
                           "test,wall.stiffness_n_per_m=2000,\n";
    const auto experiment = session::open_experiment(
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
      device().arming.state = session::ArmingState::kOn;
      person.wait_a_frame();
      person.click("arm");
      EXPECT_EQ(device().arm_requests, (std::vector{true, false}));
    });
  }
};

TEST_F(ControlsTest, EveryOneIsUsed) {
  use_simulator();
  use_experiment();
  use_device();
  // These exist only while a task runs.
  for (const char* passing : {"cancel re-run", "cancel opening"}) log_.used.insert(passing);
  std::set<std::string> forgotten;
  std::set_difference(log_.seen.begin(), log_.seen.end(), log_.used.begin(), log_.used.end(),
                      std::inserter(forgotten, forgotten.end()));
  EXPECT_TRUE(forgotten.empty()) << "no row uses these controls; add rows to tests/window/rows_*: "
                                 << ::testing::PrintToString(forgotten);
}

}  // namespace
}  // namespace hapticwall::test
