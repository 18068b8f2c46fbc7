#include "app/session/trial_slots.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "app/file/text/text.h"
#include "app/session/scene_change.h"
#include "core/algorithm/algorithm.h"
#include "core/environment/environment.h"
#include "core/estimator/estimator.h"
#include "core/scene_keys.h"

namespace hapticwall::session {
namespace {

// Why the session that runs `base` cannot run `slot`; empty if it can.
std::string obstacle(const Scene& base, const Scene& slot, bool on_device) {
  if (const auto problem = needs_new_session(base, slot))
    return fmt::format("{}: {}", problem->key, problem->message);
  if (slot.duration_s != base.duration_s || slot.name != base.name ||
      slot.description != base.description)
    return "name, description and duration_s are those of the session";
  if (!on_device) return "";
  for (std::size_t i = 0; i < base.axes.size(); ++i) {
    if (slot.axes[i].hand != base.axes[i].hand) return "a device has no simulated hand";
  }
  return slot.simulator == base.simulator ? "" : "a device has no simulator";
}

// The text that the slot sets the key to, last of all; "" without one.
std::string text_in(const std::string& slot, std::string_view key) {
  std::string value;
  for (const std::string& text : file::slot_overrides(slot)) {
    const std::size_t equals = text.find('=');
    if (equals != std::string::npos && file::override_key(text) == key)
      value = file::trimmed(std::string_view(text).substr(equals + 1));
  }
  return value;
}

std::string value_of(std::string_view key, const std::string& slot, const Scene& scene) {
  if (key == "algorithm.name") return std::string(algorithms()[scene.algorithm.index].name);
  if (key == "environment.name")
    return std::string(environments()[scene.environment.index].description.name);
  if (key == "estimator.name")
    return std::string(estimators()[scene.estimator.index].description.name);
  if (const auto number = find_scene_number(scene, key)) {
    const std::optional<double> value = number->get(scene);
    return value ? file::shortest_number(*value) : "";
  }
  return text_in(slot, key);
}

}  // namespace

Result<SlotScenes> SlotLoader::load(const file::TrialSpec& trial) const {
  SlotScenes scenes{base_, base_};
  for (std::size_t i = 0; i < trial.slots.size(); ++i) {
    Result<Scene> scene = slot_scene(trial.slots.at(i));
    if (!scene)
      return usage_error(fmt::format("{}: {}", i == 0 ? "a" : "b", scene.error().message));
    scenes.at(i) = std::move(*scene);
  }
  return scenes;
}

Result<Scene> SlotLoader::slot_scene(const std::string& slot) const {
  Result<Scene> scene = scene_with_(file::slot_overrides(slot));
  if (!scene) return scene;
  const std::string why = obstacle(base_, *scene, on_device_);
  return why.empty() ? scene : usage_error(fmt::format("{}: {}", file::shown(slot), why));
}

std::vector<std::string> keys_of(std::span<const file::TrialSpec> trials) {
  std::vector<std::string> keys;
  for (const file::TrialSpec& trial : trials) {
    for (const std::string& slot : trial.slots) {
      for (const std::string& text : file::slot_overrides(slot)) {
        std::string key = file::override_key(text);
        if (std::ranges::find(keys, key) == keys.end()) keys.push_back(std::move(key));
      }
    }
  }
  return keys;
}

std::vector<std::string> values_of(std::span<const std::string> keys, const file::TrialSpec& trial,
                                   const SlotScenes& scenes) {
  std::vector<std::string> values;
  for (const std::string& key : keys) {
    for (std::size_t i = 0; i < scenes.size(); ++i)
      values.push_back(value_of(key, trial.slots.at(i), scenes.at(i)));
  }
  return values;
}

}  // namespace hapticwall::session
