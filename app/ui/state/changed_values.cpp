#include "app/ui/state/changed_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/file/text/number_name.h"
#include "app/file/text/text.h"
#include "core/algorithm/algorithm.h"
#include "core/environment/environment.h"
#include "core/estimator/estimator.h"
#include "core/scene_keys.h"

namespace hapticwall::ui {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;  // key, value as shown

// All values that may change during a session, except the names of environment, estimator and
// integrator, in a
// fixed order.
Values values_of(const Scene& scene) {
  Values values;
  visit_scene_numbers(
      scene,
      [&](const NumberPath& path, const auto& key, const auto& owner) {
        for (const std::string_view other : {"", "algorithm."}) {
          if (path.table == other) return;
        }
        values.emplace_back(path.text(), shown_value(key.get(owner)));
      },
      1);
  const auto parameters = algorithm_parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::optional<double>& value = scene.algorithm.values.at(i);
    values.emplace_back("algorithm." + std::string(parameters[i].key),
                        value ? value_text(parameters[i], *value) : kAbsent);
  }
  return values;
}

std::string_view environment_name(const Scene& scene) {
  return environments()[scene.environment.index].description.name;
}
std::string_view estimator_name(const Scene& scene) {
  return estimators()[scene.estimator.index].description.name;
}

// "wall stiffness"; the key where the field has no name for it.
std::string field_name(const Scene& scene, const std::string& key) {
  const std::optional<SceneNumber> number = find_scene_number(scene, key);
  return number ? file::number_name(*number).name : key;
}

// In the unit that figures show; `text` for a word, and for a part that is absent.
std::string field_value(const Scene& scene, const std::string& key, const std::string& text) {
  const std::optional<SceneNumber> number = find_scene_number(scene, key);
  const std::optional<double> value = number ? number->get(scene) : std::nullopt;
  if (!value || text != rounded_number(*value)) return text;
  const file::NumberName name = file::number_name(*number);
  return rounded_number(*value * name.scale) + (name.unit.empty() ? "" : " " + name.unit);
}

// A comma before three digits may separate thousands.
bool is_ambiguous(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return false;
  const std::string_view before = text.substr(text.starts_with('-') ? 1 : 0, comma);
  const std::string_view after = text.substr(comma + 1);
  const auto digits = std::ranges::find_if_not(after, [](char c) { return c >= '0' && c <= '9'; });
  return digits - after.begin() == 3 && !before.starts_with('0') && !before.starts_with(',');
}

}  // namespace

std::vector<std::string> changed_values(const Scene& running, const Scene& loaded) {
  std::vector<std::string> lines;
  const Scene back = with_loaded_values(running, loaded);
  const Values now = values_of(running);
  const Values then = values_of(back);
  for (const auto& [key, value] : now) {
    // Another environment has no walls.
    const auto same = std::ranges::find(then, key, &Values::value_type::first);
    if (same == then.end() || same->second == value) continue;
    lines.push_back(fmt::format("{}: {}, in the scene {}", field_name(running, key),
                                field_value(running, key, value),
                                field_value(back, key, same->second)));
  }
  if (running.environment.index != back.environment.index)
    lines.push_back(fmt::format("environment: {}, in the scene {}", environment_name(running),
                                environment_name(back)));
  if (running.estimator.index != back.estimator.index)
    lines.push_back(fmt::format("estimator: {}, in the scene {}", estimator_name(running),
                                estimator_name(back)));
  if (running.simulator != back.simulator) {
    const auto words = [](const SimulatorSettings& simulator) {
      return fmt::format("{} × {}", simulator.integrator_name(), simulator.substeps);
    };
    lines.push_back(fmt::format("simulator: {}, in the scene {}", words(running.simulator),
                                words(back.simulator)));
  }
  return lines;
}

Scene with_loaded_values(const Scene& running, const Scene& loaded) {
  Scene scene = running;
  scene.x().device = loaded.x().device;
  scene.x().device.start_m = running.x().device.start_m;
  if (scene.x().hand && loaded.x().hand) {
    scene.x().hand = loaded.x().hand;
    scene.x().hand->path = running.x().hand->path;
    scene.x().hand->follows_mouse = running.x().hand->follows_mouse;
  }
  if (loaded.environment.index != running.environment.index) {
    for (std::size_t i = 0; i < scene.axes.size(); ++i)
      scene.axes[i].walls = loaded.axes.at(i).walls;
  } else if (loaded.x().walls.size() == running.x().walls.size()) {
    scene.x().walls = loaded.x().walls;
  }
  scene.environment = loaded.environment;
  scene.algorithm.values = loaded.algorithm.values;
  scene.estimator = loaded.estimator;
  scene.sampling = loaded.sampling.with_clock_of(running.sampling);
  scene.simulator = loaded.simulator;
  return scene;
}

std::optional<double> parse_number(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  if (is_ambiguous(text)) return std::nullopt;
  std::string plain(text);
  if (const std::size_t comma = plain.find(','); comma != std::string::npos) plain[comma] = '.';
  if (plain.ends_with('k') || plain.ends_with('M')) {
    const char* power = plain.ends_with('k') ? "e3" : "e6";
    plain.pop_back();
    while (!plain.empty() && is_space(plain.back())) plain.pop_back();
    plain += power;
  }
  return file::parsed<double>(plain);
}

std::string no_number(std::string_view text) {
  if (is_ambiguous(text)) return fmt::format("'{}': write no thousands separator", text);
  return fmt::format("'{}' is not a number, as 35000, 35k or 0,5", text);
}

std::string rounded_number(double value) { return fmt::format("{:.10g}", value); }

std::string shown_value(const std::optional<double>& value) {
  return value ? rounded_number(*value) : std::string(kAbsent);
}

}  // namespace hapticwall::ui
