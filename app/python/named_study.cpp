#include "app/python/named_study.h"

#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>
#include <time.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "app/file/text/text.h"
#include "app/python/interruptible.h"
#include "app/python/law.h"
#include "app/python/scene.h"
#include "app/study/studies.h"
#include "app/table/json_report.h"
#include "core/algorithm/algorithm.h"
#include "core/study/boundary.h"
#include "core/units.h"

namespace nb = nanobind;

namespace hapticwall::python {
namespace {

using Choice = std::pair<std::string, std::string>;  // key and text of an option

std::int64_t processor_time_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  constexpr auto kPerSecond = static_cast<std::int64_t>(kNanosecondsPerSecond);
  return std::int64_t{now.tv_sec} * kPerSecond + now.tv_nsec;
}

const study::Study& study_of(const std::string& name) {
  const auto all = study::studies();
  const auto found =
      std::ranges::find(all, name, [](const study::Study* one) { return one->name; });
  if (found != all.end()) return **found;
  std::vector<std::string_view> names;
  for (const study::Study* const one : all) names.push_back(one->name);
  raise(usage_error(
      fmt::format("no study is called {}; known: {}", file::in_quotes(name), file::joined(names))));
}

study::Choices choices_of(const study::Study& study, const std::vector<Choice>& given) {
  study::Choices choices;
  for (const auto& [key, text] : given) {
    const auto option = std::ranges::find(study.options, key, &study::Option::key);
    if (option == study.options.end()) {
      const auto keys = file::names_of(study.options, &study::Option::key);
      raise(usage_error(fmt::format("the study {} has no option {}{}; it takes: {}", study.name,
                                    file::in_quotes(key), file::suggestion(key, keys),
                                    file::joined(keys))));
    }
    if (const std::string wrong = option->wrong(text); !wrong.empty())
      raise(usage_error(fmt::format("{} {}: {}", key, file::in_quotes(text), wrong)));
    choices[key] = text;
  }
  return choices;
}

// A law in Python would make the threads wait for each other.
int threads_for(const Scene& scene, const std::vector<std::size_t>& used, int threads) {
  if (threads < 0) raise(usage_error("threads: 0 or more"));
  return scene_takes_lock(scene) || std::ranges::any_of(used, takes_lock) ? 1 : threads;
}
std::vector<std::size_t> all_algorithms() {
  std::vector<std::size_t> all(algorithms().size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

std::string study_json(const SceneBox& box, const std::string& name,
                       const std::vector<Choice>& given, int threads) {
  const study::Study& study = study_of(name);
  const Scene& scene = scene_of_study(box);
  const study::Choices choices = choices_of(study, given);
  const study::Run run = value_or_raise(study.plan(scene, choices));
  const int used = threads_for(
      scene, study.of_all_algorithms ? all_algorithms() : std::vector{scene.algorithm.index},
      threads);
  const auto outcome = interruptibly([&](const StopQuestion& should_stop) {
    return run(
        {.threads = used, .should_stop = should_stop, .progress = {}, .now_ns = processor_time_ns});
  });
  return outcome->json;
}

// Key, first and last value, count, and whether they have equal ratios.
using AxisText = std::tuple<std::string, double, double, std::size_t, bool>;

MapAxis axis_of(const Scene& scene, const AxisText& text) {
  const auto& [key, low, high, count, logarithmic] = text;
  auto number = find_scene_number(scene, key);
  if (!number) {
    const std::vector<SceneNumber> numbers = scene_numbers(scene);
    const auto paths = file::names_of(numbers, &SceneNumber::path);
    PyErr_SetString(PyExc_KeyError, fmt::format("no number of this scene is called {}{}",
                                                file::in_quotes(key), file::suggestion(key, paths))
                                        .c_str());
    throw nb::python_error();
  }
  if (count < 2 || count > kMaxMapValues)
    raise(usage_error(fmt::format("{}: {} values; it takes 2 to {}", key, count, kMaxMapValues)));
  if (!(low < high) || (logarithmic && low <= 0.0))
    raise(usage_error(fmt::format("{}: {} to {}; it takes an increasing range{}", key, low, high,
                                  logarithmic ? " above 0" : "")));
  return {std::move(*number), low, high, count, logarithmic};
}

struct BoundaryText {
  AxisText along;
  std::optional<AxisText> x;
  std::vector<std::size_t> algorithms;
  double tolerance = 0.0;
};

BoundaryPlan plan_of(const SceneBox& box, const BoundaryText& text) {
  BoundaryPlan plan;
  plan.scene = scene_of_study(box);
  plan.algorithms = text.algorithms;
  plan.along = axis_of(plan.scene, text.along);
  if (text.x) plan.x = axis_of(plan.scene, *text.x);
  if (plan.x && plan.x->number.path == plan.along.number.path)
    raise(usage_error("x and along are the same key, " + plan.along.number.path));
  if (!(text.tolerance >= kMinTolerance && text.tolerance < 1.0))
    raise(usage_error(fmt::format("tolerance: {:g} to less than 1", kMinTolerance)));
  plan.tolerance = text.tolerance;
  if (const auto problem = validate(plan))
    raise(usage_error(problem->key + ": " + problem->message));
  return plan;
}

std::string boundary_json(const SceneBox& box, const BoundaryText& text, int threads) {
  const BoundaryPlan plan = plan_of(box, text);
  const int used = threads_for(plan.scene, plan.algorithms, threads);
  const auto found = interruptibly([&](const StopQuestion& should_stop) {
    return find_boundaries(plan, {.threads = used, .should_stop = should_stop, .progress = {}});
  });
  table::Json rows = table::Json::array();
  for (const Boundary& boundary : found) rows.push_back(table::boundary_object(plan, boundary));
  return table::json_text(rows);
}

using OptionText = std::tuple<std::string, std::string, std::string>;  // key, help, default

std::vector<std::pair<std::string, std::vector<OptionText>>> study_list() {
  std::vector<std::pair<std::string, std::vector<OptionText>>> list;
  for (const study::Study* const study : study::studies()) {
    auto& options = list.emplace_back(std::string(study->name), std::vector<OptionText>()).second;
    for (const study::Option& option : study->options)
      options.emplace_back(option.key, option.help, option.default_value);
  }
  return list;
}

}  // namespace

void bind_studies(nb::module_& m) {
  m.def("study", &study_json);
  nb::class_<BoundaryText>(m, "BoundaryText")
      .def(nb::init<AxisText, std::optional<AxisText>, std::vector<std::size_t>, double>());
  m.def("boundary", &boundary_json);
  m.def("check_boundary", [](const SceneBox& box, const BoundaryText& text) {
    static_cast<void>(plan_of(box, text));
  });
  m.def("studies", &study_list);
}

}  // namespace hapticwall::python
