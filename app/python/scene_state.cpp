#include "app/python/scene_state.h"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <set>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "app/file/plugin/plugin_file.h"
#include "app/python/interruptible.h"
#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/plugin_list.h"
#include "core/environment/environment.h"

namespace nb = nanobind;

namespace hapticwall::python {
namespace {

template <typename T>
nb::bytes bytes_of(const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  return nb::bytes(values.data(), values.size() * sizeof(T));
}
template <typename T>
std::vector<T> values_of(const nb::bytes& bytes) {
  if (bytes.size() % sizeof(T) != 0) raise(usage_error("the state of a scene is cut off"));
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

bool is_beyond_text(const SharedPath& path) { return !path.file.empty() || path.recorded; }

PathState path_state(std::size_t axis, const SharedPath& path) {
  PathState state{axis, bytes_of(path.points()), path.file, path.sha256, 0.0, nb::bytes("", 0)};
  if (path.recorded) {
    state.rate_hz = path.recorded->rate_hz;
    state.pieces = bytes_of(path.recorded->pieces);
  }
  return state;
}

SharedPath path_of(const PathState& state) {
  SharedPath path;
  if (const auto points = values_of<PathPoint>(state.points); !points.empty())
    path = SharedPath(points);
  path.file = state.file;
  path.sha256 = state.sha256;
  if (state.rate_hz == 0.0) return path;
  auto pieces = values_of<PathPiece>(state.pieces);
  if (pieces.empty()) raise(usage_error("the state of a scene is cut off"));
  path.recorded =
      std::make_shared<const RecordedPieces>(RecordedPieces{state.rate_hz, std::move(pieces)});
  return path;
}

bool same_piece(const PathPiece& a, const PathPiece& b) {
  return a.from_tick == b.from_tick && a.begin_tick == b.begin_tick &&
         a.position_m == b.position_m && a.velocity_m_per_s == b.velocity_m_per_s;
}
// By value: the scene compares pointers.
bool same_recorded(const SharedPath& a, const SharedPath& b) {
  if (!a.recorded || !b.recorded) return a.recorded == b.recorded;
  return a.recorded->rate_hz == b.recorded->rate_hz &&
         std::ranges::equal(a.recorded->pieces, b.recorded->pieces, same_piece);
}

bool same_scene(Scene a, Scene b) {
  for (std::size_t i = 0; i < std::min(a.axes.size(), b.axes.size()); ++i) {
    if (!a.axes[i].hand || !b.axes[i].hand) continue;
    SharedPath& path = a.axes[i].hand->path;
    SharedPath& other = b.axes[i].hand->path;
    if (!same_recorded(path, other)) return false;
    path.recorded.reset();
    other.recorded.reset();
  }
  return a == b;
}

bool is_set(const AlgorithmSettings& settings, const ParameterDescription& parameter) {
  const auto place = find_algorithm_parameter(parameter.key);
  return place && settings.values.at(*place).has_value();
}
bool is_built_in(std::string_view key) {
  return std::ranges::any_of(algorithms().first(first_plugin()), [&](const auto& algorithm) {
    return std::ranges::find(algorithm.parameters, key, &ParameterDescription::key) !=
           algorithm.parameters.end();
  });
}
bool sets_parameter_of(const AlgorithmSettings& settings, std::size_t plugin) {
  return std::ranges::any_of(algorithms()[plugin].parameters,
                             [&](const ParameterDescription& parameter) {
                               return is_set(settings, parameter) && !is_built_in(parameter.key);
                             });
}

}  // namespace

SceneState state_of(const SceneBox& box) {
  Scene scene = scene_of_study(box);
  SceneState state;
  for (std::size_t i = 0; i < scene.axes.size(); ++i) {
    if (!scene.axes[i].hand || !is_beyond_text(scene.axes[i].hand->path)) continue;
    SharedPath& path = scene.axes[i].hand->path;
    state.paths.push_back(path_state(i, path));
    path = SharedPath({{0.0, 0.0}});  // scene_of_state() replaces it
  }
  state.toml = file::scene_to_toml(scene);
  return state;
}

SceneBox scene_of_state(const SceneState& state) {
  file::LoadedScene loaded = value_or_raise(file::parse_scene(state.toml, "scene"));
  if (!loaded.not_repeatable_because.empty()) raise(usage_error(loaded.not_repeatable_because));
  for (const PathState& path : state.paths) {
    if (path.axis >= loaded.scene.axes.size() || !loaded.scene.axes[path.axis].hand)
      raise(usage_error("the state of a scene has a path without a hand"));
    loaded.scene.axes[path.axis].hand->path = path_of(path);
  }
  if (const auto problem = validate(loaded.scene))
    raise(usage_error(problem->key + ": " + problem->message));
  return SceneBox(std::move(loaded));
}

SceneBox scene_of_text(const std::string& toml) {
  return SceneBox(value_or_raise(file::parse_scene(toml, "text")));
}

bool equal(const SceneBox& a, const SceneBox& b) {
  const file::LoadedScene& one = a.loaded();
  const file::LoadedScene& other = b.loaded();
  return same_scene(one.scene, other.scene) &&
         one.first_recorded_tick == other.first_recorded_tick &&
         one.not_repeatable_because == other.not_repeatable_because &&
         std::ranges::equal(one.changes, other.changes,
                            [](const ScheduledChange& x, const ScheduledChange& y) {
                              return x.tick == y.tick && same_scene(x.scene, y.scene);
                            });
}

std::vector<std::size_t> algorithms_of(const SceneBox& box) {
  const AlgorithmSettings& settings = box.loaded().scene.algorithm;
  std::vector<std::size_t> indices{settings.index};
  for (std::size_t i = first_plugin(); i < algorithms().size(); ++i) {
    if (i != settings.index && sets_parameter_of(settings, i)) indices.push_back(i);
  }
  return indices;
}

// Names of the environment, and of those that brought a key which the scene sets.
std::vector<std::string> environments_of(const SceneBox& box) {
  const EnvironmentSettings& settings = box.loaded().scene.environment;
  const EnvironmentContext context{.settings = &settings};
  std::vector<std::string> names;
  std::set<std::string_view> known;  // keys of those before
  for (std::size_t i = 0; i < environments().size(); ++i) {
    const EnvironmentDescription& one = environments()[i].description;
    bool brings = i == settings.index;
    for (const ParameterDescription& parameter : one.parameters)
      brings = (known.insert(parameter.key).second && context.value(parameter.key)) || brings;
    if (brings) names.emplace_back(one.name);
  }
  return names;
}

void bind_scene_state(nb::class_<SceneBox>& scene, nb::module_& m) {
  nb::class_<PathState>(m, "PathState")
      .def("__getstate__",
           [](const PathState& path) {
             return std::tuple(path.axis, path.points, path.file, path.sha256, path.rate_hz,
                               path.pieces);
           })
      .def("__setstate__",
           [](PathState& path, const std::tuple<std::size_t, nb::bytes, std::string, std::string,
                                                double, nb::bytes>& state) {
             const auto& [axis, points, file, sha256, rate_hz, pieces] = state;
             new (&path) PathState{axis, points, file, sha256, rate_hz, pieces};
           });
  scene
      .def("state",
           [](const SceneBox& box) {
             SceneState state = state_of(box);
             return std::pair(std::move(state.toml), std::move(state.paths));
           })
      .def_static("of_state",
                  [](const std::string& toml, const std::vector<PathState>& paths) {
                    return scene_of_state({toml, paths});
                  })
      .def_static("of_text", &scene_of_text)
      .def("equal", &equal)
      .def("algorithms", &algorithms_of)
      .def("environments", &environments_of);
  m.def("plugin_file", [](std::size_t algorithm) {
    const file::PluginFile* const found = file::plugin_file(algorithm);
    return found == nullptr ? std::pair(std::string(), std::string())
                            : std::pair(found->path, found->sha256);
  });
}

}  // namespace hapticwall::python
