// The module `hapticwall._core`; app/python/hapticwall is the interface that a user sees.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "app/file/text/text.h"
#include "app/python/environment.h"
#include "app/python/law.h"
#include "app/python/listing.h"
#include "app/python/named_study.h"
#include "app/python/results.h"
#include "app/python/runs.h"
#include "app/python/scene.h"
#include "app/python/scene_state.h"
#include "app/python/session.h"
#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/plugin_list.h"

namespace nb = nanobind;

namespace hapticwall::python {
namespace {

using Bytes = nb::ndarray<nb::numpy, const std::uint8_t, nb::ndim<1>>;

// A view of the rows; `owner` keeps them.
Bytes bytes_of(const Rows& rows, const nb::object& owner) {
  return Bytes(rows.samples.data(), {rows.samples.size() * sizeof(Sample)}, owner);
}

using Numbers = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
MapValues map_values(const std::pair<std::string, Numbers>& of_key) {
  return {of_key.first, {of_key.second.data(), of_key.second.size()}};
}

using HandRunner = nb::typed<nb::callable, nb::bytes(nb::bytes)>;
using SummaryList = nb::typed<nb::list, SummaryDict>;
SummaryList dicts_of(const std::vector<RunSummary>& runs) {
  SummaryList dicts;
  for (const RunSummary& run : runs) dicts.append(summary_dict(run));
  return dicts;
}

std::vector<std::string_view> algorithm_names() {
  return file::names_of(algorithms(), &AlgorithmDescription::name);
}

void bind_scene(nb::module_& m) {
  nb::class_<SceneBox> bound(m, "Scene");
  bound.def_static("load", &SceneBox::load)
      .def("toml", &SceneBox::toml)
      .def("number_keys", &SceneBox::number_keys)
      .def("number",
           [](const SceneBox& scene, const std::string& key) {
             const auto number = scene.number(key);
             return std::pair(number.has_value(), number.value_or(std::nullopt));
           })
      .def("check_key", &SceneBox::check_key)
      .def("replaced", &SceneBox::with)
      .def("under", &SceneBox::under)
      .def("with_algorithm", &SceneBox::with_algorithm)
      .def_prop_ro("not_repeatable_because",
                   [](const SceneBox& scene) { return scene.loaded().not_repeatable_because; });
  bind_scene_state(bound, m);
}

void bind_rows(nb::module_& m) {
  nb::class_<RowLayout>(m, "RowLayout")
      .def_ro("names", &RowLayout::names)
      .def_ro("formats", &RowLayout::formats)
      .def_ro("offsets", &RowLayout::offsets)
      .def_ro("row_bytes", &RowLayout::row_bytes);
  nb::class_<RunBox>(m, "Run")
      .def_prop_ro("scene", [](const RunBox& run) { return run.scene; })
      .def("summary", [](const RunBox& run) { return summary_dict(run.summary); })
      .def("layout", [](const RunBox& run) { return layout_of(run.rows.columns); })
      .def("row_data",
           [](const nb::object& self) { return bytes_of(nb::cast<RunBox&>(self).rows, self); })
      .def_ro("first_different_tick", &RunBox::first_different_tick)
      .def("save", &RunBox::save);
  nb::class_<RecordingBox>(m, "Recording")
      .def(nb::init<const std::string&>())
      .def_prop_ro("notes", [](const RecordingBox& recording) { return recording.info().notes; })
      .def("scene", &RecordingBox::scene)
      .def(
          "layout",
          [](const RecordingBox& recording) { return layout_of(recording.info().scanned.columns); })
      .def("row_data",
           [](const nb::object& self) {
             return bytes_of(nb::cast<RecordingBox&>(self).rows(), self);
           })
      .def("rerun", &RecordingBox::rerun);
}

void bind_laws(nb::module_& m) {
  nb::class_<LawParameter>(m, "LawParameter")
      .def(nb::init<std::string, std::string, double, double, double, std::string>());
  m.def("add_law",
        [](std::string name, std::string title, std::string idea, std::string equation,
           std::uint32_t state_bytes, std::vector<LawParameter> parameters, std::uintptr_t step,
           std::uintptr_t configure, std::uintptr_t reset, bool takes_lock) {
          return add_law({{std::move(name), std::move(title), std::move(idea), std::move(equation),
                           state_bytes, std::move(parameters), takes_lock},
                          step,
                          configure,
                          reset});
        });
  m.def("algorithm_index", &algorithm_index);
  m.def("algorithm_names", &algorithm_names);
  m.def("first_plugin", &first_plugin);
  m.def("note_raised", &note_raised);
}

}  // namespace
}  // namespace hapticwall::python

NB_MODULE(_core, m) {
  using namespace hapticwall::python;  // NOLINT(google-build-using-namespace)
  // A daemon thread or another library may hold an object when the process ends.
  nb::set_leak_warnings(false);
  bind_scene(m);
  bind_rows(m);
  bind_laws(m);
  bind_environments(m);
  bind_session(m);
  bind_listing(m);
  bind_studies(m);
  m.def("run", &run);
  m.def("batch", [](const std::vector<SceneBox>& scenes, int threads) {
    return dicts_of(run_batch(scenes, threads));
  });
  m.attr("hand_bytes") = kHandBytes;
  m.def("worst_hand", [](const SceneBox& scene, std::uint64_t hands, std::uint64_t seed,
                         const std::string& bounds, const std::string& motion, int threads,
                         const std::optional<HandRunner>& elsewhere) {
    return search_hand(scene, {hands, seed, bounds, motion, threads, elsewhere});
  });
  m.def("run_hands", [](const SceneBox& scene, const std::string& bounds, const std::string& motion,
                        const nb::bytes& hands, int threads) {
    return run_hands(scene, {1, 0, bounds, motion, threads}, hands);
  });
  m.def("compare", [](const SceneBox& scene, const std::vector<std::size_t>& algorithms,
                      int threads) { return dicts_of(compare(scene, algorithms, threads)); });
  m.def("map", [](const SceneBox& scene, const std::pair<std::string, Numbers>& x,
                  const std::pair<std::string, Numbers>& y,
                  const std::vector<std::size_t>& algorithms, int threads) {
    return python_columns(map(scene, map_values(x), map_values(y), algorithms, threads));
  });
  m.def("map_columns",
        [] { return hapticwall::file::names_of(number_columns(0), &NumberColumn::name); });
  m.def("check_map",
        [](const SceneBox& scene, const std::pair<std::string, Numbers>& x,
           const std::pair<std::string, Numbers>& y, const std::vector<std::size_t>& algorithms) {
          check_map(scene, map_values(x), map_values(y), algorithms);
        });
}
