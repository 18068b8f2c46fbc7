#include "app/file/scene/toml_text.h"

#include <fmt/format.h>

#include "app/file/plugin/plugin_file.h"
#include "app/file/scene/scene_file.h"
#include "app/file/text/text.h"
#include "core/algorithm/algorithm.h"
#include "core/environment/environment.h"
#include "core/estimator/estimator.h"

namespace hapticwall::file {
namespace {

// TOML reads a number without point and exponent as an integer.
std::string toml_number(double value) {
  std::string text = shortest_number(value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string toml_string(std::string_view value) {
  std::string text = "\"";
  for (const char c : value) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      text += '\\';
      text += c;
    } else if (code < 0x20U || code == 0x7fU) {
      text += fmt::format("\\u{:04X}", code);
    } else {
      text += c;
    }
  }
  return text + '"';
}

void write_path(TomlText& out, const HandSettings& hand) {
  if (hand.follows_mouse) {
    out.string("path", "mouse");
  } else if (!hand.path.file.empty()) {
    out.string("path_file", hand.path.file);
    out.string("path_sha256", hand.path.sha256);
  } else {
    out.path("path", hand.path.points());
  }
}

void write_parameters(TomlText& out, std::span<const ParameterDescription> parameters,
                      std::span<const std::optional<double>> values) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::optional<double>& value = values[i];
    if (!value) continue;
    switch (parameters[i].kind) {
      case ParameterKind::kNumber:
        out.number(parameters[i].key, *value);
        break;
      case ParameterKind::kBoolean:
        out.boolean(parameters[i].key, *value != 0.0);
        break;
      case ParameterKind::kChoice:
        out.string(parameters[i].key, parameters[i].choices[static_cast<std::size_t>(*value)]);
        break;
    }
  }
}

}  // namespace

void TomlText::comment(std::string_view text) { text_ += fmt::format("# {}\n", text); }
void TomlText::table(std::string_view name) { text_ += fmt::format("\n[{}]\n", name); }
void TomlText::table_of_array(std::string_view name) { text_ += fmt::format("\n[[{}]]\n", name); }
void TomlText::assign(std::string_view key, std::string_view value) {
  text_ += fmt::format("{} = {}\n", key, value);
}
void TomlText::number(std::string_view key, double value) { assign(key, toml_number(value)); }
void TomlText::integer(std::string_view key, std::uint64_t value) {
  assign(key, fmt::format("{}", value));
}
void TomlText::boolean(std::string_view key, bool value) { assign(key, value ? "true" : "false"); }
void TomlText::string(std::string_view key, std::string_view value) {
  assign(key, toml_string(value));
}
void TomlText::path(std::string_view key, const std::vector<PathPoint>& points) {
  std::string value;
  for (const PathPoint& point : points) {
    value += fmt::format("{}[{}, {}]", value.empty() ? "" : ", ", toml_number(point.time_s),
                         toml_number(point.position_m));
  }
  assign(key, "[" + value + "]");
}

void write_algorithm(TomlText& out, std::string_view prefix, const AlgorithmSettings& algorithm) {
  out.table(fmt::format("{}algorithm", prefix));
  out.string("name", algorithms()[algorithm.index].name);
  if (const PluginFile* plugin = plugin_file(algorithm.index, algorithm.revision)) {
    out.string("plugin_file", plugin->path);
    out.string("plugin_sha256", plugin->sha256);
  }
  write_parameters(out, algorithm_parameters(), algorithm.values);
}

void write_environment(TomlText& out, std::string_view prefix,
                       const EnvironmentSettings& environment) {
  out.table(fmt::format("{}environment", prefix));
  out.string("name", environments()[environment.index].description.name);
  if (const PluginFile* plugin = environment_file(environment.index)) {
    out.string("plugin_file", plugin->path);
    out.string("plugin_sha256", plugin->sha256);
  }
  write_parameters(out, environment_parameters(), environment.values);
}

void write_estimator(TomlText& out, std::string_view prefix, const EstimatorSettings& estimator) {
  out.table(fmt::format("{}estimator", prefix));
  out.string("name", estimators()[estimator.index].description.name);
  write_parameters(out, estimator_parameters(), estimator.values);
}
void write_simulator(TomlText& out, std::string_view prefix, const SimulatorSettings& simulator) {
  out.table(fmt::format("{}simulator", prefix));
  out.string("integrator", simulator.integrator_name());
  out.integer("substeps", static_cast<std::uint64_t>(simulator.substeps));
}

void write_walls(TomlText& out, std::string_view prefix, const Scene& scene) {
  for (std::size_t i = 0; i < scene.axes.size(); ++i) {
    for (const WallSettings& wall : scene.axes[i].walls) {
      out.table_of_array(fmt::format("{}wall", prefix));
      if (scene.two_axes()) out.string("axis", i == 0 ? "x" : "y");
      out.numbers(wall);
    }
  }
}

std::string scene_to_toml(const Scene& scene) {
  TomlText out;
  out.string("name", scene.name);
  if (!scene.description.empty()) out.string("description", scene.description);
  out.numbers(scene);
  write_numbers(out, "sampling", scene.sampling);
  for (std::size_t i = 0; i < scene.axes.size(); ++i) {
    write_numbers(out, axis_key("device", i), scene.axes[i].device);
  }
  for (std::size_t i = 0; i < scene.axes.size(); ++i) {
    const std::optional<HandSettings>& hand = scene.axes[i].hand;
    if (!hand) continue;
    write_numbers(out, axis_key("hand", i), *hand);
    write_path(out, *hand);
  }
  write_walls(out, "", scene);
  if (scene.environment != EnvironmentSettings{}) write_environment(out, "", scene.environment);
  write_algorithm(out, "", scene.algorithm);
  if (scene.estimator != EstimatorSettings{}) write_estimator(out, "", scene.estimator);
  write_simulator(out, "", scene.simulator);
  return out.text();
}

}  // namespace hapticwall::file
