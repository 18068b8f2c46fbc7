#include "app/file/text/number_name.h"

#include <gtest/gtest.h>

#include <string>

#include "app/file/scene/scene_file.h"

namespace hapticwall::file {
namespace {

std::string title_of(const Scene& scene, const char* path) {
  return number_name(find_scene_number(scene, path).value()).title();
}

TEST(NumberName, IsTheNameOfTheFieldWithItsSymbolAndUnit) {
  const Scene scene = load_scene("press")->scene;
  EXPECT_EQ(title_of(scene, "wall.stiffness_n_per_m"), "wall stiffness K (kN/m)");
  EXPECT_EQ(title_of(scene, "wall[0].damping_n_s_per_m"), "wall damping B (N·s/m)");
  EXPECT_EQ(title_of(scene, "device.mass_kg"), "handle mass m (g)");
  EXPECT_EQ(title_of(scene, "sampling.lost_ticks"), "lost ticks");
}

TEST(NumberName, OneOfSeveralWallsHasItsNumber) {
  Scene scene = load_scene("press")->scene;
  scene.x().walls.push_back(scene.x().walls.front());
  EXPECT_EQ(title_of(scene, "wall[1].position_m"), "wall position 2 x_w (mm)");
}

// No key has an underscore or a unit in its name.
TEST(NumberName, EveryNumberHasWords) {
  const Scene scene = load_scene("press")->scene;
  for (const SceneNumber& number : scene_numbers(scene)) {
    const NumberName name = number_name(number);
    EXPECT_FALSE(name.name.empty()) << number.path;
    EXPECT_EQ(name.name.find_first_of("_."), std::string::npos) << number.path;
    EXPECT_FALSE(name.name.ends_with(" per m") || name.name.ends_with(" s")) << number.path;
    EXPECT_EQ(name.unit.empty(), number.unit.empty()) << number.path;
  }
}

TEST(NumberName, AShownUnitIsThatOfItsScale) {
  const Scene scene = load_scene("press")->scene;
  const NumberName name = number_name(find_scene_number(scene, "device.encoder_m").value());
  EXPECT_EQ(name.unit, "mm");
  EXPECT_DOUBLE_EQ(name.scale, 1e3);
}

}  // namespace
}  // namespace hapticwall::file
