// A scene that is written and read again is the same scene, to the last bit.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cstdint>
#include <optional>
#include <string>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/scene_keys.h"
#include "tests/property/scene_generator.h"

namespace hapticwall::file {
namespace {

template <typename Owner>
double random_value(const NumberKey<Owner>& key) {
  const double low = key.range.minimum < 0.0 ? 0.0 : std::max(key.range.minimum, 1e-6);
  return key.range.minimum < 0.0 ? testing::uniform(key.range.minimum, key.range.maximum)
                                 : testing::log_uniform(low, key.range.maximum);
}

std::string random_text() {
  constexpr const char* kPieces[] = {"a", "\"", "\\", "#", "'", "=", "µ", "[", "]", ",", " ", "€"};
  std::string text = "n";
  const int count = *rc::gen::inRange(0, 12);
  for (int i = 0; i < count; ++i) text += kPieces[*rc::gen::inRange<std::size_t>(0, 12)];
  return text;
}

void randomise_algorithm(AlgorithmSettings& settings) {
  const auto parameters = algorithm_parameters();
  settings.index = *rc::gen::inRange<std::size_t>(0, algorithms().size());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (testing::flip()) continue;
    const ParameterDescription& parameter = parameters[i];
    switch (parameter.kind) {
      case ParameterKind::kNumber:
        settings.values.at(i) = testing::uniform(parameter.minimum, parameter.maximum);
        break;
      case ParameterKind::kBoolean:
        settings.values.at(i) = testing::flip() ? 1.0 : 0.0;
        break;
      case ParameterKind::kChoice:
        settings.values.at(i) =
            static_cast<double>(*rc::gen::inRange<std::size_t>(0, parameter.choices.size()));
        break;
    }
  }
}

Scene unusual_scene() {
  Scene scene = testing::random_scene("none");
  scene.name = random_text();
  scene.description = testing::flip() ? "" : random_text();
  for (const auto& key : number_keys<DeviceSettings>()) {
    if (key.required || testing::flip()) key.set(scene.x().device, random_value(key));
  }
  if (testing::flip()) scene.x().hand.reset();
  if (scene.x().hand && testing::flip()) {
    scene.x().hand->path = {};
    scene.x().hand->follows_mouse = true;
  }
  scene.x().walls.resize(*rc::gen::inRange<std::size_t>(0, kMaxWalls + 1));
  for (WallSettings& wall : scene.x().walls) {
    for (const auto& key : number_keys<WallSettings>()) key.set(wall, random_value(key));
  }
  randomise_algorithm(scene.algorithm);
  // More than b/T is a contradiction, and most draws are.
  auto& storage = scene.algorithm.values.at(*find_algorithm_parameter("storage_stiffness_n_per_m"));
  if (storage) storage = testing::log_uniform(1e-3, 1.0);
  return scene;
}

RC_GTEST_PROP(SceneFileProperty, WrittenAndReadAgainIsTheSame, ()) {
  const Scene scene = unusual_scene();
  RC_PRE(!validate(scene).has_value());
  const std::string text = scene_to_toml(scene);
  const Result<LoadedScene> loaded = parse_scene(text, "x.toml");
  if (!loaded) RC_FAIL(loaded.error().message + "\n" + text);
  RC_ASSERT(loaded->scene == scene);
  RC_ASSERT(scene_to_toml(loaded->scene) == text);  // tells -0 from 0
}

// Whatever the bytes: an answer, and an error is one clean line.
RC_GTEST_PROP(SceneFileProperty, AnyBytesGetAnAnswer, ()) {
  std::string text = scene_to_toml(testing::random_scene("none"));
  const int edits = *rc::gen::inRange(0, 8);
  for (int i = 0; i < edits; ++i) {
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
    const auto length = *rc::gen::inRange<std::size_t>(0, 20);
    text.replace(at, length, *rc::gen::arbitrary<std::string>());
    if (text.empty()) text = "\n";
  }
  const Result<LoadedScene> loaded = parse_scene(text, "x.toml");
  if (loaded) return;
  for (const char c : loaded.error().message) {
    RC_ASSERT(static_cast<unsigned char>(c) >= 0x20U);
  }
}

}  // namespace
}  // namespace hapticwall::file
