// The sections of the panel: scene, algorithm, wall, loop.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "tests/window/rows.h"

namespace hapticwall::test {
namespace {

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
  EXPECT_TRUE(person.state().transient.refusal);
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

double position_mm(Person& person) { return person.scene().x().walls.front().position_m * 1e3; }

}  // namespace

Table scene_rows(const std::string& scene_file) {
  return {{"scene", open_every_builtin},
          {"open path", [scene_file](Person& person) { open_by_path(person, scene_file); }},
          {"recent N", open_recent}};
}

Table algorithm_rows() {
  Table table{{"algorithm.then", [](Person& p) { choose_parameter(p, kThenParameter); }}};
  for (std::size_t i = 0; i < algorithms().size(); ++i)
    table.push_back(
        {std::string(algorithms()[i].name), [i](Person& person) { use_algorithm(person, i); }});
  return table;
}

Table wall_rows() {
  return {takes("position", "51", position_mm, 51.0), shown("bound, passive"),
          shown("bound, friction"), shown("bound, resolution")};
}

Table loop_rows() { return {shown("cost of a tick")}; }

}  // namespace hapticwall::test
