// Named hands, and scenes that name one.
#include "app/file/scene/hand_description.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "tests/temporary_folder.h"

namespace hapticwall::file {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

struct Published {
  const char* name;
  std::optional<double> mass_kg;
  double stiffness_n_per_m;
  double damping_n_s_per_m;
  std::optional<double> grip_stiffness_n_per_m;
  std::optional<double> grip_damping_n_s_per_m;
};

// Typed from the sources that the files name, in the order M, k2, b2, k1, b1 of Fu and Cavusoglu.
const std::vector<Published>& published() {
  static const std::vector<Published> kHands{
      {"fu-cavusoglu-x", 0.218, 78.75, 4.645, 379.5, 1.839},
      {"fu-cavusoglu-x-high", 0.57, 151, 10.29, 651, 4.56},
      {"fu-cavusoglu-x-low", 0.14, 63, 3.68, 228, 0.87},
      {"fu-cavusoglu-y", 0.269, 105.3, 6.430, 552.4, 3.609},
      {"fu-cavusoglu-z", 0.204, 271.7, 18.06, 769.9, 0.776},
      {"fu-cavusoglu-z-high", 0.43, 533, 27.6, 1043, 1.42},
      {"fu-cavusoglu-z-low", 0.016, 214, 13.1, 679, std::nullopt},
      {"kuchenbecker-joystick", std::nullopt, 40, 23, std::nullopt, std::nullopt},
      {"van-beek-arm", 0.554, 135, 6.45, std::nullopt, std::nullopt}};
  return kHands;
}

HandSettings numbers_of(const Published& hand) {
  HandSettings numbers;
  numbers.mass_kg = hand.mass_kg;
  numbers.stiffness_n_per_m = hand.stiffness_n_per_m;
  numbers.damping_n_s_per_m = hand.damping_n_s_per_m;
  numbers.grip_stiffness_n_per_m = hand.grip_stiffness_n_per_m;
  numbers.grip_damping_n_s_per_m = hand.grip_damping_n_s_per_m;
  return numbers;
}

TEST(NamedHands, HaveTheNumbersOfTheirSources) {
  ASSERT_EQ(builtin_hands().size(), published().size());
  for (std::size_t i = 0; i < published().size(); ++i) {
    const Published& expected = published()[i];
    EXPECT_EQ(builtin_hands()[i].name, expected.name);
    const auto hand = load_hand_description(expected.name);
    ASSERT_TRUE(hand) << hand.error().message;
    EXPECT_EQ(hand->hand, numbers_of(expected)) << expected.name;
    EXPECT_GT(hand->source.size(), 20U) << expected.name;
  }
}

// A comment on each line of a number says where it is printed.
TEST(NamedHands, SayTheSourceOfEveryNumber) {
  for (const BuiltinHand& hand : builtin_hands()) {
    const std::string text(hand.toml_text);
    std::size_t numbers = 0;
    for (std::size_t at = text.find(" = "); at != std::string::npos;
         at = text.find(" = ", at + 1)) {
      const std::string line = text.substr(at, text.find('\n', at) - at);
      if (line.find('"') != std::string::npos) continue;
      ++numbers;
      EXPECT_THAT(line, ::testing::ContainsRegex("# (Table|Figure) ")) << hand.name;
    }
    EXPECT_GE(numbers, 2U) << hand.name;
  }
}

// The scene keeps its path, and no number of its own hand is left over.
TEST(NamedHands, TakeThePlaceOfASceneHand) {
  const Scene press = load_scene("press")->scene;
  for (const Published& named : published()) {
    const std::vector<std::string> overrides{std::string("hand=") + named.name};
    const auto loaded = load_scene("press", overrides);
    ASSERT_TRUE(loaded) << loaded.error().message;
    HandSettings expected = numbers_of(named);
    expected.path = press.x().hand->path;
    EXPECT_EQ(loaded->scene.x().hand, expected) << named.name;
    EXPECT_EQ(with_hand(press, numbers_of(named)).x().hand, expected) << named.name;
    EXPECT_THAT(loaded->scene.description,
                AllOf(HasSubstr(press.description + "; hand "),
                      EndsWith(load_hand_description(named.name)->source)));
    const auto again = parse_scene(scene_to_toml(loaded->scene), "again");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->scene, loaded->scene) << named.name;
  }
}

TEST(NamedHands, AnotherAxisKeepsItsHand) {
  const Scene corner = load_scene("corner")->scene;
  ASSERT_TRUE(corner.axes[1].hand);
  const std::vector<std::string> of_x{"hand=van-beek-arm"};
  const auto x = load_scene("corner", of_x);
  ASSERT_TRUE(x) << x.error().message;
  EXPECT_EQ(x->scene.x().hand->mass_kg, 0.554);
  EXPECT_EQ(x->scene.axes[1].hand, corner.axes[1].hand);
  const std::vector<std::string> of_y{"hand.y=van-beek-arm"};
  const auto y = load_scene("corner", of_y);
  ASSERT_TRUE(y) << y.error().message;
  EXPECT_EQ(y->scene.x().hand, corner.x().hand);
  EXPECT_EQ(y->scene.axes[1].hand->mass_kg, 0.554);
  EXPECT_EQ(y->scene.axes[1].hand->path, corner.axes[1].hand->path);
}

class SceneHand : public hapticwall::test::FolderTest {
 protected:
  void SetUp() override {
    put("soft.toml", "name = \"Soft\"\nsource = \"a scale\"\n[hand]\nstiffness_n_per_m = 50\n");
  }
  [[nodiscard]] Result<LoadedScene> scene(const std::string& text) {
    put("scene.toml", "duration_s = 1\n[device]\nmass_kg = 0.05\ndamping_n_s_per_m = 1\n" + text);
    return load_scene(path("scene.toml"));
  }
  void expect_refused(const std::string& text, const std::string& message) {
    const auto loaded = scene(text);
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error().message, HasSubstr(message));
  }
};

// Keys beside the name override its numbers.
TEST_F(SceneHand, ItsOwnKeysWin) {
  const auto loaded =
      scene("[hand]\nfile = \"fu-cavusoglu-x\"\nmass_kg = 0.3\npath = [[0, 0.03], [1, 0.06]]\n");
  ASSERT_TRUE(loaded) << loaded.error().message;
  const HandSettings& hand = *loaded->scene.x().hand;
  EXPECT_EQ(hand.mass_kg, 0.3);
  EXPECT_EQ(hand.stiffness_n_per_m, 78.75);
  EXPECT_EQ(hand.grip_damping_n_s_per_m, 1.839);
  EXPECT_EQ(hand.path.size(), 2U);
}

// A file beside the scene, with or without its ending.
TEST_F(SceneHand, MayBeAFile) {
  for (const char* name : {"soft", "soft.toml"}) {
    const auto loaded = scene(std::string("[hand]\nfile = \"") + name + "\"\npath = [[0, 0.03]]\n");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->scene.x().hand->stiffness_n_per_m, 50.0);
    EXPECT_EQ(loaded->scene.description, "hand Soft: a scale");
    EXPECT_THAT(loaded->named_files, ::testing::Contains(path("soft.toml")));
  }
}

TEST_F(SceneHand, AWrongOneIsRefused) {
  expect_refused("[hand]\nfile = \"fu-cavusoglu-q\"\npath = [[0, 0.03]]\n",
                 "hand: 'fu-cavusoglu-q' is neither a file nor a built-in hand; did you mean "
                 "'fu-cavusoglu-x'?");
  expect_refused("[hand]\nfile = 3\npath = [[0, 0.03]]\n", "hand.file: not the name of a hand");
  expect_refused("[hand]\nfile = \"gone.toml\"\npath = [[0, 0.03]]\n", "gone.toml: cannot be read");
  expect_refused("[hand]\nfile = \"van-beek-arm\"\n", "hand.path");
}

TEST(HandDescription, SaysWhatIsWrong) {
  const auto message = [](const std::string& text) {
    const auto hand = parse_hand_description(text, "hand.toml");
    return hand ? std::string("nothing") : hand.error().message;
  };
  const std::string head = "name = \"A\"\nsource = \"b\"\n";
  EXPECT_EQ(message(head + "[hand]\nstiffness_n_per_m = 1\n"), "nothing");
  EXPECT_THAT(message("source = \"b\"\n[hand]\nstiffness_n_per_m = 1\n"), HasSubstr("name"));
  EXPECT_THAT(message("name = \"A\"\n[hand]\nstiffness_n_per_m = 1\n"), HasSubstr("source"));
  EXPECT_THAT(message(head), HasSubstr("hand"));
  EXPECT_THAT(message(head + "[hand]\nmass_kg = 1\n"), HasSubstr("hand.stiffness_n_per_m"));
  EXPECT_THAT(message(head + "[hand]\nstiffness_n_per_m = -1\n"),
              AllOf(HasSubstr("hand.toml:4"), HasSubstr("hand.stiffness_n_per_m: -1 is out of")));
  EXPECT_THAT(message(head + "[hand]\nstiffness_n_per_m = 1\ngrip_stiffness_n_per_m = 1\n"),
              HasSubstr("hand.mass_kg is missing"));
  EXPECT_THAT(message(head + "[hand]\nstiffness_n_per_m = 1\npath = [[0, 0]]\n"),
              HasSubstr("hand.path"));
}

}  // namespace
}  // namespace hapticwall::file
