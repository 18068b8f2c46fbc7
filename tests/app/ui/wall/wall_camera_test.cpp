#include "app/ui/wall/wall_camera.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "app/file/scene/scene_file.h"

namespace hapticwall::ui {
namespace {

constexpr AxisExtent kCameraExtent{0.02, 0.08};
const WallSpace kCameraLine{kCameraExtent, std::nullopt};
const WallSpace kCameraPlane{kCameraExtent, AxisExtent{-0.03, 0.05}};

// Any camera state that the mouse can reach, and some that it cannot.
class RandomViews {
 public:
  WallOrbit orbit() {
    WallOrbit orbit{between(-7.0, 7.0), between(-7.0, 7.0), between(0.1, 30.0), {}};
    orbit.shift = {between(-40.0, 40.0), between(-40.0, 40.0)};
    return orbit;
  }
  double between(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(engine_);
  }
  float size() { return static_cast<float>(between(150.0, 3000.0)); }

 private:
  std::mt19937 engine_{20240607};
};

TEST(WallCamera, PickingUndoesDrawingFromEveryView) {
  RandomViews views;
  for (int i = 0; i < 3000; ++i) {
    const WallCamera camera(kCameraLine, views.orbit(), views.size(), views.size());
    const double position_m = views.between(kCameraExtent.from_m, kCameraExtent.to_m);
    const glm::vec2 pixel = camera.pixel_of({camera.x_of(position_m), 0.0F, 0.0F});
    EXPECT_NEAR(camera.position_at(pixel), position_m, 2e-6) << i;
  }
}

TEST(WallCamera, APointerBesideTheAxisCountsAsTheNearestPointOfIt) {
  RandomViews views;
  for (int i = 0; i < 300; ++i) {
    const WallCamera camera(kCameraLine, views.orbit(), 800.0F, 400.0F);
    const double position_m = views.between(kCameraExtent.from_m, kCameraExtent.to_m);
    const glm::vec2 foot = camera.pixel_of({camera.x_of(position_m), 0.0F, 0.0F});
    const glm::vec2 along =
        glm::normalize(camera.pixel_of({5.0F, 0.0F, 0.0F}) - camera.pixel_of({-5.0F, 0.0F, 0.0F}));
    const glm::vec2 beside = foot + 60.0F * glm::vec2(-along.y, along.x);
    EXPECT_NEAR(camera.position_at(beside), position_m, 5e-6) << i;
  }
}

TEST(WallCamera, PickingUndoesDrawingOnTwoAxes) {
  RandomViews views;
  int seen = 0;
  for (int i = 0; i < 12000; ++i) {
    const float width = views.size();
    const float height = views.size();
    const WallCamera camera(kCameraPlane, views.orbit(), width, height);
    const glm::dvec2 place_m(views.between(kCameraPlane.x.from_m, kCameraPlane.x.to_m),
                             views.between(kCameraPlane.y->from_m, kCameraPlane.y->to_m));
    const glm::vec2 pixel = camera.pixel_of(camera.point_of(place_m));
    // Outside of the picture, its edge counts.
    if (pixel.x < 0.0F || pixel.y < 0.0F || pixel.x > width || pixel.y > height) continue;
    ++seen;
    const glm::dvec2 found_m = camera.place_at(pixel);
    EXPECT_NEAR(found_m.x, place_m.x, 1e-5) << i;
    EXPECT_NEAR(found_m.y, place_m.y, 1e-5) << i;
  }
  EXPECT_GT(seen, 300);
}

TEST(WallCamera, APickedPlaceLiesWithinTheExtents) {
  RandomViews views;
  for (int i = 0; i < 1000; ++i) {
    const glm::vec2 pixel(views.between(-5000.0, 9000.0), views.between(-5000.0, 9000.0));
    const WallOrbit orbit = views.orbit();
    const double position_m = WallCamera(kCameraLine, orbit, 800.0F, 390.0F).position_at(pixel);
    EXPECT_GE(position_m, kCameraExtent.from_m);
    EXPECT_LE(position_m, kCameraExtent.to_m);
    const glm::dvec2 place_m = WallCamera(kCameraPlane, orbit, 800.0F, 390.0F).place_at(pixel);
    EXPECT_GE(place_m.x, kCameraPlane.x.from_m);
    EXPECT_LE(place_m.x, kCameraPlane.x.to_m);
    EXPECT_GE(place_m.y, kCameraPlane.y->from_m);
    EXPECT_LE(place_m.y, kCameraPlane.y->to_m);
  }
}

TEST(WallCamera, ASceneIsSeenWholeAtFirst) {
  for (const float width : {400.0F, 900.0F}) {
    for (const WallSpace& space : {kCameraLine, kCameraPlane}) {
      const WallCamera camera(space, {}, width, 390.0F);
      const double margin_m =
          0.05 * space.x.length_m();  // free space around the walls and paths of a scene
      for (const double x_m : {space.x.from_m + margin_m, space.x.to_m - margin_m}) {
        const double y_m = space.y ? space.y->middle_m() : 0.0;
        const glm::vec2 pixel = camera.pixel_of(camera.point_of({x_m, y_m}));
        EXPECT_GT(pixel.x, 0.0F);
        EXPECT_LT(pixel.x, width);
        EXPECT_GT(pixel.y, 0.0F);
        EXPECT_LT(pixel.y, 390.0F);
      }
    }
  }
}

TEST(WallCamera, ZoomingKeepsWhatIsUnderThePointer) {
  WallOrbit orbit;
  orbit.yaw_rad = 0.4;
  const glm::dvec2 pointer(0.3, -0.2);
  const auto position_m = [&] {
    const WallCamera camera(kCameraLine, orbit, 800.0F, 400.0F);
    return camera.position_at({400.0 * (1.0 + pointer.x), 200.0 * (1.0 - pointer.y)});
  };
  const double before_m = position_m();
  for (int i = 0; i < 8; ++i) {
    orbit = limited(zoomed(orbit, 1.2, pointer), false);
    EXPECT_NEAR(position_m(), before_m, 1e-9) << i;
  }
  EXPECT_GT(orbit.zoom, 4.0);
}

TEST(WallCamera, LimitsKeepTheWallInThePicture) {
  RandomViews views;
  for (int i = 0; i < 2000; ++i) {
    for (const bool two_axes : {false, true}) {
      const WallOrbit orbit = limited(views.orbit(), two_axes);
      const WallCamera camera(two_axes ? kCameraPlane : kCameraLine, orbit, 800.0F, 400.0F);
      EXPECT_GT(camera.eye().y, 0.0F) << "from above";
      // The middle of the picture was within the picture before the zoom.
      EXPECT_LE(std::abs(orbit.shift.x / orbit.zoom), 0.9) << i;
      EXPECT_LE(std::abs(orbit.shift.y / orbit.zoom), 0.9) << i;
      EXPECT_EQ(limited(orbit, two_axes), orbit) << "a view within the limits stays";
    }
  }
}

TEST(WallCamera, AStateThatIsNoNumberIsTheFirstView) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(limited({nan, infinity, -infinity, {nan, nan}}, false), WallOrbit{});
}

TEST(WallCamera, YIsAwayFromTheViewer) {
  const WallCamera camera(kCameraPlane, {}, 800.0F, 400.0F);
  const glm::vec2 near = camera.pixel_of(camera.point_of({0.05, 0.0}));
  const glm::vec2 far = camera.pixel_of(camera.point_of({0.05, 0.03}));
  const glm::vec2 right = camera.pixel_of(camera.point_of({0.06, 0.0}));
  EXPECT_LT(far.y, near.y);
  EXPECT_GT(right.x, near.x);
}

TEST(AxisExtent, HoldsEverythingThatEveryBuiltinSceneNames) {
  for (const file::BuiltinScene& builtin : file::builtin_scenes()) {
    const Scene scene = file::load_scene(builtin.name)->scene;
    const AxisExtent extent = axis_extent(scene.x());
    EXPECT_LT(extent.from_m, scene.x().device.start_m) << builtin.name;
    for (const WallSettings& wall : scene.x().walls) {
      EXPECT_LT(extent.from_m, wall.position_m);
      EXPECT_GT(extent.to_m, wall.position_m);
    }
    if (!scene.x().hand) continue;
    for (const PathPoint& point : scene.x().hand->path) EXPECT_GT(extent.to_m, point.position_m);
  }
}

}  // namespace
}  // namespace hapticwall::ui
