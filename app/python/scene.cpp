#include "app/python/scene.h"

#include <nanobind/nanobind.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/file/text/text.h"
#include "app/python/interruptible.h"
#include "core/scene_keys.h"

namespace hapticwall::python {
namespace {

constexpr std::string_view kUnknownKey = ": unknown key";

// "wall[0].KEY" also names the only wall.
std::string usual_name(const Scene& scene, std::string key) {
  constexpr std::string_view kFirst = "wall[0].";
  std::size_t walls = 0;
  for (const AxisSettings& axis : scene.axes) walls += axis.walls.size();
  if (walls == 1 && key.starts_with(kFirst)) key.replace(0, kFirst.size(), "wall.");
  return key;
}

// False if the scene has no such number, or the number is of another kind.
bool set_number(Scene& scene, const std::string& key, const SettingValue& value) {
  const double* const number = std::get_if<double>(&value);
  const std::string name = usual_name(scene, key);
  bool done = false;
  if (number == nullptr || !std::isfinite(*number)) return false;
  visit_scene_numbers(scene, [&](const NumberPath& path, const auto& number_key, auto& owner) {
    if (done || !(path == name)) return;
    if (number_key.whole() && *number != std::round(*number)) return;
    // set() clamps a whole number, which validate() would then take.
    if (number_key.whole() && !number_key.range.contains(*number)) {
      raise(usage_error(path.text() + ": " +
                        out_of_range_text(*number, number_key.range, number_key.unit)));
    }
    number_key.set(owner, *number);
    done = true;
  });
  return done;
}

std::string override_text(const std::pair<std::string, SettingValue>& setting) {
  const auto* const number = std::get_if<double>(&setting.second);
  return setting.first + "=" +
         (number != nullptr ? file::shortest_number(*number)
                            : std::get<std::string>(setting.second));
}

[[noreturn]] void raise_setting(Error error, const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) {
    const std::string option = "--set " + file::shown(text) + ": ";
    if (error.message.starts_with(option)) error.message.erase(0, option.size());
  }
  if (error.message.find(kUnknownKey) == std::string::npos) raise(error);
  PyErr_SetString(PyExc_KeyError, error.message.c_str());
  throw nanobind::python_error();
}

void refuse_recorded_hand(const Scene& scene) {
  for (const AxisSettings& axis : scene.axes) {
    if (!axis.hand || !axis.hand->path.recorded) continue;
    raise(usage_error("the scene of a recording takes numbers that it has already"));
  }
}

// Applies the settings to the scene's text, as --set does it.
Scene reread(const Scene& scene, const Settings& settings) {
  refuse_recorded_hand(scene);
  std::vector<std::string> overrides;
  overrides.reserve(settings.size());
  std::ranges::transform(settings, std::back_inserter(overrides), override_text);
  const Result<file::LoadedScene> read =
      file::parse_scene(file::scene_to_toml(scene), scene.name, overrides);
  if (!read) raise_setting(read.error(), overrides);
  return read->scene;
}

}  // namespace

SceneBox SceneBox::load(const std::string& name_or_path) {
  return SceneBox(value_or_raise(file::load_scene(name_or_path)));
}

std::vector<std::string> SceneBox::number_keys() const {
  std::vector<std::string> keys;
  visit_scene_numbers(loaded_.scene, [&](const NumberPath& path, const auto&, const auto&) {
    keys.push_back(path.text());
  });
  return keys;
}

std::optional<std::optional<double>> SceneBox::number(const std::string& key) const {
  const std::string name = usual_name(loaded_.scene, key);
  std::optional<std::optional<double>> found;
  visit_scene_numbers(loaded_.scene,
                      [&](const NumberPath& path, const auto& number_key, const auto& owner) {
                        if (!found && path == name) found = number_key.get(owner);
                      });
  return found;
}

void SceneBox::check_key(const std::string& key) const {
  const std::vector<std::string> setting{key + "=0"};
  const Scene scene = without_paths(loaded_.scene);
  const auto read = file::parse_scene(file::scene_to_toml(scene), scene.name, setting);
  if (!read && read.error().message.find(kUnknownKey) != std::string::npos)
    raise_setting(read.error(), setting);
}

SceneBox SceneBox::with(const Settings& settings) const {
  if (!loaded_.changes.empty()) {
    raise(usage_error("parameters change in this session; its scene takes no other values"));
  }
  SceneBox changed = *this;
  Scene& scene = changed.loaded_.scene;
  const bool numbers_alone = std::ranges::all_of(settings, [&](const auto& setting) {
    return set_number(scene, setting.first, setting.second);
  });
  if (!numbers_alone) scene = reread(loaded_.scene, settings);
  if (const auto problem = validate(scene))
    raise(usage_error(problem->key + ": " + problem->message));
  return changed;
}

SceneBox SceneBox::under(std::size_t algorithm) const {
  SceneBox changed = *this;
  changed.loaded_.scene.algorithm.index = algorithm;
  for (ScheduledChange& change : changed.loaded_.changes) change.scene.algorithm.index = algorithm;
  return changed;
}

SceneBox SceneBox::with_algorithm(std::size_t algorithm, const Settings& settings) const {
  SceneBox changed = *this;
  changed.loaded_.scene.algorithm = {.index = algorithm};
  return changed.with(settings);
}

const Scene& scene_of_study(const SceneBox& scene) {
  const file::LoadedScene& loaded = scene.loaded();
  if (!loaded.changes.empty()) raise(usage_error("parameters change in this session: run() it"));
  if (!loaded.not_repeatable_because.empty()) {
    raise(usage_error("the session cannot be repeated: " + loaded.not_repeatable_because +
                      "; the scene of its recording, read(\"NAME.csv\").scene, can"));
  }
  return loaded.scene;
}

}  // namespace hapticwall::python
