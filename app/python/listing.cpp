#include "app/python/listing.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/file/text/text.h"
#include "app/python/scene.h"
#include "core/algorithm/algorithm.h"
#include "core/environment/environment.h"
#include "core/estimator/estimator.h"
#include "core/scene_keys.h"
#include "hapticwall_version.h"

namespace nb = nanobind;

namespace hapticwall::python {
namespace {

using KeyDict = nb::typed<nb::dict, nb::str, nb::any>;
using KeyDicts = nb::typed<nb::list, KeyDict>;

struct Limits {
  std::string_view unit;
  ValueRange range;
  bool required = false;
  std::optional<double> fallback = std::nullopt;
};

KeyDict key_dict(const std::string& key, std::string_view kind, const Limits& limits) {
  KeyDict dict;
  dict["key"] = key;
  dict["kind"] = kind;
  dict["unit"] = limits.unit;
  dict["minimum"] = limits.range.minimum;
  dict["maximum"] = limits.range.maximum;
  dict["minimum_excluded"] = limits.range.minimum_excluded;
  dict["required"] = limits.required;
  dict["default"] = limits.fallback ? nb::cast(*limits.fallback) : nb::none();
  dict["default_text"] = limits.fallback ? number_text(*limits.fallback) : "";
  dict["choices"] = nb::list();
  dict["meaning"] = "";
  return dict;
}

KeyDict choice_dict(const std::string& key, const std::vector<std::string_view>& names,
                    std::string_view fallback) {
  KeyDict dict = key_dict(key, "choice", {"", {0.0, static_cast<double>(names.size() - 1)}});
  dict["choices"] = nb::cast(names);
  dict["default_text"] = fallback;
  return dict;
}

KeyDict parameter_dict(const std::string& key, const ParameterDescription& parameter) {
  constexpr std::string_view kKinds[]{"number", "switch", "choice"};
  KeyDict dict = key_dict(key, kKinds[static_cast<std::size_t>(parameter.kind)],
                          {parameter.unit, {parameter.minimum, parameter.maximum}});
  dict["choices"] =
      nb::cast(std::vector<std::string_view>(parameter.choices.begin(), parameter.choices.end()));
  dict["default_text"] = parameter.default_text;
  dict["meaning"] = parameter.meaning;
  return dict;
}

void add_parameters(KeyDicts& dicts, std::string_view table,
                    std::span<const ParameterDescription> parameters) {
  for (const ParameterDescription& parameter : parameters)
    dicts.append(parameter_dict(std::string(table).append(parameter.key), parameter));
}

// Numbers outside of [environment], [algorithm] and [estimator], whose tables have more than
// numbers.
void add_numbers(KeyDicts& dicts, const Scene& scene) {
  visit_scene_numbers(scene, [&](const NumberPath& path, const auto& key, const auto& owner) {
    using Owner = std::remove_cvref_t<decltype(owner)>;
    if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(key)>, ParameterNumberKey>) {
      const Owner fresh{};
      const std::optional<double> fallback = key.required ? std::nullopt : key.get(fresh);
      dicts.append(key_dict(path.text(), key.whole() ? "whole number" : "number",
                            {key.unit, key.range, key.required, fallback}));
    }
  });
}

// `list`: of environments or estimators; the first one is the default.
template <class List>
void add_named(KeyDicts& dicts, const std::string& table, const List& list,
               std::span<const ParameterDescription> parameters) {
  const std::vector<std::string_view> names = file::names_of(list);
  dicts.append(choice_dict(table + ".name", names, names.front()));
  add_parameters(dicts, table + ".", parameters);
}

KeyDicts keys_of(const Scene& scene) {
  KeyDicts dicts;
  add_numbers(dicts, scene);
  add_named(dicts, "environment", environments(), environment_parameters());
  const auto algorithm_names = file::names_of(algorithms(), &AlgorithmDescription::name);
  dicts.append(choice_dict("algorithm.name", algorithm_names, algorithm_names.front()));
  add_parameters(dicts, "algorithm.", algorithm_parameters());
  add_named(dicts, "estimator", estimators(), estimator_parameters());
  const SimulatorSettings simulator;
  dicts.append(choice_dict("simulator.integrator",
                           {kIntegratorNames.begin(), kIntegratorNames.end()},
                           simulator.integrator_name()));
  dicts.append(key_dict("simulator.substeps", "whole number",
                        {"", {1.0, kMaxSubsteps}, false, double{1.0}}));
  return dicts;
}

// With a hand and a wall, whose keys a list of all keys must have.
Scene scene_with_all_tables() {
  Scene scene;
  scene.x().hand.emplace();
  scene.x().walls.resize(1);
  return scene;
}

}  // namespace

void bind_listing(nb::module_& m) {
  m.attr("version") = kVersion;
  m.attr("build") = kBuild;
  m.def("keys_of", [](const SceneBox& scene) { return keys_of(scene.loaded().scene); });
  m.def("keys", [] { return keys_of(scene_with_all_tables()); });
  m.def("scenes", [] {
    std::vector<std::pair<std::string, std::string>> found;
    for (const file::BuiltinScene& scene : file::builtin_scenes())
      found.emplace_back(scene.name, scene.description);
    return found;
  });
}

}  // namespace hapticwall::python
