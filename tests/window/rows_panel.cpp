// The sections of the panel: scene, algorithm, wall, loop.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/environment/environment.h"
#include "core/estimator/estimator.h"
#include "tests/window/rows.h"

namespace hapticwall::test {
namespace {

double chosen_algorithm(Person& person) {
  return static_cast<double>(person.scene().algorithm.index);
}

void open_scenes(Person& person) { person.click("scene"); }

void open_every_builtin(Person& person) {
  for (const file::BuiltinScene& scene : file::builtin_scenes()) {
    open_scene(person, scene.name);
    EXPECT_EQ(person.session().snapshot().paused, false);
  }
  open_scene(person, "press");
}

void open_by_path(Person& person, const std::string& path) {
  open_scenes(person);
  person.type("open path", path + ".missing");
  EXPECT_EQ(person.message().kind, ui::MessageKind::kProblem);
  EXPECT_EQ(person.scene().name, "press");
  person.put_everything_away();
  open_scenes(person);
  person.type("open path", path);
  person.wait_until([&] { return person.scene().name != "press"; }, "the file's scene");
  open_scene(person, "press");
}

void open_recent(Person& person) {
  open_scenes(person);
  person.click("recent 1");
  person.wait_until([&] { return person.scene().name != "press"; }, "the file's scene");
  open_scene(person, "press");
}

// The buttons stand in the layouts of the paper's figures.
Row figure(const char* label, const char* algorithm) {
  return sets(label, chosen_algorithm, static_cast<double>(*find_algorithm(algorithm)),
              [](Person& person) {
                person.state().plots.persisted.arrangement = ui::PlotArrangement::kFigure4;
                person.wait_a_frame();
              });
}

void go_back_to_scene(Person& person) {
  person.state().plots.persisted.arrangement = ui::PlotArrangement::kAll;
  const double before = person.scene().x().walls.front().stiffness_n_per_m;
  person.type("stiffness", "1234");
  EXPECT_EQ(person.scene().x().walls.front().stiffness_n_per_m, 1234.0);
  person.click("reset to scene");
  EXPECT_EQ(person.scene().x().walls.front().stiffness_n_per_m, before);
}

std::optional<double> parameter(Person& person, std::string_view key) {
  return person.scene().algorithm.values.at(*find_algorithm_parameter(key));
}

void type_parameter(Person& person, const ParameterDescription& description) {
  const std::string item = "algorithm." + std::string(description.key);
  EXPECT_TRUE(person.has_tooltip(item));
  const double value =
      description.minimum > 0.0 ? 2.0 * description.minimum : std::min(0.5, description.maximum);
  person.type(item, fmt::format("{}", value));
  EXPECT_EQ(parameter(person, description.key), value);
  person.type(item, "nonsense");
  EXPECT_EQ(parameter(person, description.key), value)
      << "a text that is no number changes nothing";
  EXPECT_TRUE(person.state().edit.refusal);
  person.put_everything_away();
  person.type(item, "");
  EXPECT_EQ(parameter(person, description.key), std::nullopt);
}

void choose_parameter(Person& person, const ParameterDescription& description) {
  static constexpr std::array<std::string_view, 2> kSwitch{"false", "true"};
  const std::string item = "algorithm." + std::string(description.key);
  EXPECT_TRUE(person.has_tooltip(item));
  const std::span<const std::string_view> words = description.kind == ParameterKind::kBoolean
                                                      ? std::span<const std::string_view>(kSwitch)
                                                      : description.choices;
  for (std::size_t i = 0; i < words.size(); ++i) {
    person.click(item);
    person.click(fmt::format("{} = {}", description.key, words[i]));
    EXPECT_EQ(parameter(person, description.key), static_cast<double>(i)) << words[i];
  }
  person.choose(item, fmt::format("{} (default)", description.default_text));
  EXPECT_EQ(parameter(person, description.key), std::nullopt);
}

void use_algorithm(Person& person, std::size_t index) {
  const AlgorithmDescription& description = algorithms()[index];
  person.click(std::string(description.name));
  EXPECT_EQ(person.scene().algorithm.index, index);
  for (const ParameterDescription& parameter : description.parameters) {
    SCOPED_TRACE(std::string(parameter.key));
    if (parameter.kind == ParameterKind::kNumber) {
      type_parameter(person, parameter);
    } else {
      choose_parameter(person, parameter);
    }
  }
}

double stiffness(Person& person) { return person.scene().x().walls.front().stiffness_n_per_m; }
double damping(Person& person) { return person.scene().x().walls.front().damping_n_s_per_m; }
double position_mm(Person& person) { return person.scene().x().walls.front().position_m * 1e3; }

void choose_wall(Person& person, const std::string& scene_of_two_walls) {
  person.drop(std::array{scene_of_two_walls});
  person.wait_until([&] { return person.scene().x().walls.size() == 2; }, "two walls");
  person.wait_a_frame();
  person.click("wall 2");
  EXPECT_EQ(person.state().selection.wall, 1U);
  const double first = stiffness(person);
  person.type("stiffness", "4321");
  EXPECT_EQ(person.scene().x().walls.back().stiffness_n_per_m, 4321.0);
  EXPECT_EQ(stiffness(person), first);
  person.click("wall 1");
  EXPECT_EQ(person.state().selection.wall, 0U);
  open_scene(person, "press");
}

void choose_integrator(Person& person, std::string_view name) {
  person.click("integrator");
  person.click(std::string(name));
  EXPECT_EQ(person.scene().simulator.integrator_name(), name);
}

void choose_integrators(Person& person) {
  for (const std::string_view name :
       {kIntegratorNames[1], kIntegratorNames[2], kIntegratorNames[0]})
    choose_integrator(person, name);
}

void type_substeps(Person& person) {
  choose_integrator(person, "rk4");
  person.type("substeps", "7");
  EXPECT_EQ(person.scene().simulator.substeps, 7);
  choose_integrator(person, "exact");
  EXPECT_EQ(person.scene().simulator.substeps, 1);
}

// A list with a table of keys in the scene: estimators or environments.
template <class List, class Settings>
struct Part {
  std::string table;  // "estimator"
  const List& list;
  std::span<const ParameterDescription> keys;
  Settings Scene::*settings;
};
template <class List, class Settings>
Part(std::string, const List&, std::span<const ParameterDescription>, Settings Scene::*)
    -> Part<List, Settings>;
const Part kEstimators{"estimator", estimators(), estimator_parameters(), &Scene::estimator};
const Part kEnvironments{"environment", environments(), environment_parameters(),
                         &Scene::environment};

template <class AnyPart>
void choose_part(Person& person, const AnyPart& part, std::size_t index) {
  person.click(part.table);
  person.click(std::string(part.list[index].description.name));
  EXPECT_EQ((person.scene().*part.settings).index, index);
}

template <class AnyPart>
std::optional<double> part_value(Person& person, const AnyPart& part, std::string_view key) {
  const auto found = std::ranges::find(part.keys, key, &ParameterDescription::key);
  const auto index = static_cast<std::size_t>(found - part.keys.begin());
  return (person.scene().*part.settings).values.at(index);
}

template <class AnyPart>
void type_part_parameter(Person& person, const AnyPart& part,
                         const ParameterDescription& description) {
  const std::string item = part.table + "." + std::string(description.key);
  EXPECT_TRUE(person.has_tooltip(item));
  const double value = 0.5 * description.maximum;
  person.type(item, fmt::format("{}", value));
  EXPECT_EQ(part_value(person, part, description.key), value);
  person.type(item, fmt::format("{}", 2.0 * description.maximum));
  EXPECT_EQ(part_value(person, part, description.key), value) << "it is out of range";
  EXPECT_TRUE(person.state().edit.refusal);
  person.put_everything_away();
  person.type(item, "");
  EXPECT_EQ(part_value(person, part, description.key), std::nullopt);
}

// Ends with the default.
template <class AnyPart>
void use_parts(Person& person, const AnyPart& part) {
  for (std::size_t i = 1; i <= part.list.size(); ++i) {
    const std::size_t index = i % part.list.size();
    choose_part(person, part, index);
    for (const ParameterDescription& parameter : part.list[index].description.parameters) {
      SCOPED_TRACE(std::string(parameter.key));
      type_part_parameter(person, part, parameter);
    }
  }
}

// Ends with the walls of the scene.
void use_environments(Person& person) {
  const std::size_t walls = person.scene().x().walls.size();
  choose_part(person, kEnvironments, 1);
  EXPECT_TRUE(person.scene().x().walls.empty());
  choose_part(person, kEnvironments, 0);
  EXPECT_EQ(person.scene().x().walls.size(), walls);
  use_parts(person, kEnvironments);
  EXPECT_EQ(person.scene().x().walls.size(), walls);
}

// The numbers that an estimator shows.
void add_estimator_numbers(Table& table) {
  const EstimatorSettings settings;
  for (std::size_t i = 0; i < estimators().size(); ++i) {
    if (estimators()[i].numbers == nullptr) continue;
    for (const DerivedNumber& number : estimators()[i].numbers({1000.0, 0.0, &settings})) {
      table.push_back(shown(std::string(number.name),
                            [i](Person& person) { choose_part(person, kEstimators, i); }));
    }
  }
}

void change_rate(Person& person) {
  person.type("rate", "500");
  person.wait_until([&] { return person.scene().sampling.rate_hz == 500.0; }, "the rate");
  open_scene(person, "press");
}

// A number that begins a new session; a bad one does not.
Row new_clock(const std::string& item, const std::string& good, const std::string& bad,
              std::optional<double> (*read)(const Scene&)) {
  return {item, [=](Person& person) {
            person.type(item, bad);
            EXPECT_FALSE(read(person.scene())) << item;
            person.type(item, good);
            person.wait_until([&] { return read(person.scene()).has_value(); }, item.c_str());
            open_scene(person, "press");
          }};
}

}  // namespace

Table scene_rows(const std::string& scene_file) {
  return {{"scene", open_every_builtin},
          {"open path", [scene_file](Person& person) { open_by_path(person, scene_file); }},
          {"recent N", open_recent},
          figure("Figure 4", "none"),
          figure("Figure 5", "virtual-coupling"),
          figure("Figure 6", "energy-bounding"),
          {"reset to scene", go_back_to_scene}};
}

Table algorithm_rows() {
  Table table{{"algorithm.then", [](Person& p) { choose_parameter(p, kThenParameter); }}};
  for (std::size_t i = 0; i < algorithms().size(); ++i)
    table.push_back(
        {std::string(algorithms()[i].name), [i](Person& person) { use_algorithm(person, i); }});
  return table;
}

Table wall_rows(const std::string& scene_of_two_walls) {
  return {takes("stiffness", "2000", stiffness, 2000.0),
          slides("stiffness-slider", stiffness),
          takes("damping", "1.5", damping, 1.5),
          slides("damping-slider", damping),
          takes("position", "51", position_mm, 51.0),
          shown("bound, passive"),
          shown("bound, stable"),
          shown("bound, friction"),
          shown("bound, resolution"),
          {"environment", use_environments},
          {"wall 2",
           [scene_of_two_walls](Person& person) { choose_wall(person, scene_of_two_walls); }}};
}

Table loop_rows() {
  Table table{{"rate", change_rate},       {"integrator", choose_integrators},
              {"substeps", type_substeps}, shown("delay of velocity"),
              shown("cost of a tick"),     shown("energy error")};
  table.push_back(new_clock("sampling.jitter", "0.3", "2",
                            [](const Scene& scene) { return scene.sampling.jitter; }));
  table.push_back(
      new_clock("sampling.seed", "7", "1.5",
                [](const Scene& scene) -> std::optional<double> { return scene.sampling.seed; }));
  const Table skipped = departure_rows();
  table.insert(table.end(), skipped.begin(), skipped.end());
  add_estimator_numbers(table);
  table.push_back({"estimator", [](Person& person) { use_parts(person, kEstimators); }});
  return table;
}

}  // namespace hapticwall::test
