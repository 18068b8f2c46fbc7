#include "app/ui/window/settings_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/paths.h"
#include "tests/temporary_folder.h"

namespace hapticwall::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ui::apply_settings;
using ui::settings_text;
using ui::SettingsFile;
using ui::UiState;

// A state with no default value.
void change_all(UiState& state) {
  state.appearance.look = draw::Look::kLight;
  state.appearance.scale_percent = 150;
  state.dock.layout = "evening";
  state.dock.docked = "X21.50em(Controls;Plots)";
  state.dock.own_layouts = {{"evening", *ui::parse_layout("Wall")},
                            {"a: b", *ui::parse_layout("Y25%(Wall;Map*,Plots)")}};
  state.recording.chosen_folder = "/tmp/recordings of mine";
  state.recording.chosen_signals = true;
  state.scene.recent = {"/a/b.toml", "/c \"d\".csv"};
  state.window.width = 1234;
  state.window.height = 800;
  state.window.maximised = true;
  state.hand.withdraw_mm_per_s = 40.0;
  state.time.window_s = 60.0;
  state.plots.persisted.arrangement = ui::PlotArrangement::kFigure5And6;
  state.plots.persisted.hidden_lines =
      draw::line_bit(&Sample::wall_force_n) | draw::line_bit(&Sample::energy_scv_j);
  state.plots.persisted.lines.at(0) = draw::line_bit(&Sample::position_m);
  state.plots.persisted.trigger = {draw::TriggerMode::kNormal, 0.5};
  state.plots.persisted.phase.shown = true;
  state.plots.persisted.spectrum = {true, &Sample::force_n};
  state.plots.persisted.show_bounds = false;
  state.plots.persisted.show_counts = true;
  state.time.follows_rhythm = false;
  state.wall.persisted.magnification = 50;
  state.compare.persisted = {true, false, "Which is steadier?", 12, 0.9, false};
  state.sound.volume = 0.8;
}

class SettingsTest : public FolderTest {
 protected:
  [[nodiscard]] std::string file() const { return path("settings.json"); }
};

TEST(Settings, EverythingThatIsKeptComesBack) {
  UiState state;
  change_all(state);
  const std::string settings = settings_text(state);
  UiState fresh;
  EXPECT_NE(settings_text(fresh), settings);
  const auto problems = apply_settings(settings, "", fresh);
  ASSERT_TRUE(problems) << problems.error().message;
  EXPECT_THAT(*problems, ::testing::IsEmpty());
  EXPECT_EQ(settings_text(fresh), settings);
  EXPECT_EQ(fresh.plots.persisted.hidden_lines, state.plots.persisted.hidden_lines);
  EXPECT_EQ(fresh.plots.persisted.lines, state.plots.persisted.lines);
  EXPECT_EQ(fresh.scene.recent, state.scene.recent);
  EXPECT_EQ(fresh.dock.own_layouts, state.dock.own_layouts);
  // Nearly every value differs from its default, so that the comparison above is meaningful.
  const auto usual = nlohmann::json::parse(settings_text(UiState())).flatten();
  std::size_t changed = 0;
  const auto kept = nlohmann::json::parse(settings).flatten();
  for (const auto& each : kept.items()) {
    if (!usual.contains(each.key()) || usual[each.key()] != each.value()) ++changed;
  }
  EXPECT_GE(changed, 25U);
}

TEST(Settings, APathThatIsNotUtf8IsLeftOut) {
  UiState state;
  state.recording.chosen_folder = "/tmp/\xff\xfe";
  state.scene.recent = {"/a", "/caf\xc3", "/caf\xc3\xa9"};
  const auto json = nlohmann::json::parse(settings_text(state));
  EXPECT_FALSE(json["recording"].contains("folder"));
  EXPECT_EQ(json["recent"], (nlohmann::json{"/a", "/caf\xc3\xa9"}));
}

TEST_F(SettingsTest, ThePageShowsAWholeFileWithoutAnUnknownKeyOrInvalidValue) {
  const std::string page = text_of(data_folder() + "/../docs/window.md");
  const std::string fence = "```json settings\n";
  const std::size_t begin = page.find(fence) + fence.size();
  ASSERT_GT(begin, fence.size());
  const std::string shown = page.substr(begin, page.find("```", begin) - begin);
  EXPECT_GT(nlohmann::json::parse(shown).flatten().size(), 10U);
  UiState state;
  const auto problems = apply_settings(shown, "", state);
  ASSERT_TRUE(problems) << problems.error().message;
  EXPECT_THAT(*problems, ::testing::IsEmpty());
}

TEST_F(SettingsTest, AFileIsWrittenIntoANewFolderAndReadBack) {
  const std::string file = path("a/settings.json");
  UiState state;
  SettingsFile settings(file);
  settings.load(state);
  EXPECT_FALSE(fs::exists(file)) << "nothing has changed yet";
  change_all(state);
  settings.save(state);
  UiState fresh;
  SettingsFile(file).load(fresh);
  EXPECT_EQ(settings_text(fresh), settings_text(state));
  EXPECT_TRUE(fresh.toasts.list().empty());
  EXPECT_FALSE(fs::exists(file + ".partial"));
}

TEST_F(SettingsTest, AChangeIsWrittenOnceItRests) {
  UiState state;
  SettingsFile settings(file());
  settings.load(state);
  constexpr double kFrameS = 1.0 / 60.0;
  for (int frame = 0; frame < 300; ++frame) {  // a drag of five seconds
    state.sound.volume = 0.003 * frame;
    settings.pass(state, kFrameS);
    EXPECT_FALSE(fs::exists(file()));
  }
  for (int frame = 0; frame < 120; ++frame) settings.pass(state, kFrameS);
  ASSERT_TRUE(fs::exists(file()));
  EXPECT_THAT(content("settings.json"), HasSubstr("\"volume\": 0.897"));
  fs::remove(file());
  for (int frame = 0; frame < 600; ++frame) settings.pass(state, kFrameS);
  EXPECT_FALSE(fs::exists(file())) << "unchanged settings are not written again";
}

TEST_F(SettingsTest, ABrokenFileIsToldKeptAsideAndReplaced) {
  put("settings.json", "{\"window\":\n {theme: light}\n");
  UiState state;
  SettingsFile settings(file());
  settings.load(state);
  ASSERT_EQ(state.toasts.list().size(), 1U);
  const ui::Message told = state.toasts.newest();
  EXPECT_EQ(told.kind, ui::MessageKind::kProblem);
  EXPECT_THAT(told.text, HasSubstr("settings.json:2"));
  EXPECT_THAT(told.text, HasSubstr("settings.json.broken"));
  const UiState usual;
  EXPECT_EQ(settings_text(state), settings_text(usual));
  EXPECT_EQ(content("settings.json.broken"), "{\"window\":\n {theme: light}\n");
  settings.save(state);
  UiState fresh;
  SettingsFile(file()).load(fresh);
  EXPECT_TRUE(fresh.toasts.list().empty());
}

TEST_F(SettingsTest, AValueThatDoesNotFitIsToldAndTheOthersAreTaken) {
  put("settings.json", R"({"window": {"theme": "pink", "scale_percent": 1e9, "more": 3,
      "width": 1250, "from_the_future": 1}, "other": {"x": 2}, "recent": {"file_1": "/a"},
      "plots": {"loop": 1}, "hand": 3, "lines": {"force": 1}, "layouts": []})");
  UiState state;
  SettingsFile(file()).load(state);
  EXPECT_EQ(state.window.width, 1250);
  EXPECT_EQ(state.appearance.look, draw::Look::kScreen);
  EXPECT_EQ(state.appearance.scale_percent, 0);
  ASSERT_EQ(state.toasts.list().size(), 1U);
  const std::string told = state.toasts.newest().text;
  for (const char* line :
       {"window.theme must be one of: dark, light", "plots.loop must be true or false",
        "window.scale_percent must be a number from 0 to 300", "window.more must be true or false",
        "window.from_the_future is unknown", "other is unknown", "recent must be a list of paths",
        "hand must be an object", "lines.force must be a string", "layouts must be an object"})
    EXPECT_THAT(told, HasSubstr(line));
  EXPECT_TRUE(fs::exists(file() + ".broken"));
}

TEST_F(SettingsTest, AFileThatIsNoObjectIsToldAndLeftOut) {
  for (const char* text : {"3", "[1, 2]", "null", "\"window\""}) {
    put("settings.json", text);
    UiState state;
    SettingsFile(file()).load(state);
    EXPECT_THAT(state.toasts.newest().text, HasSubstr("not a JSON object")) << text;
    EXPECT_EQ(settings_text(state), settings_text(UiState()));
  }
}

TEST_F(SettingsTest, ASpectrumOfASignalThatNoLongerExistsIsLeftOut) {
  put("settings.toml",
      "[plots]\nderived = \"derivative(handle)\"\nspectrum_signal = \"derivative(handle)\"\n");
  UiState state;
  SettingsFile(file()).load(state);
  EXPECT_TRUE(state.toasts.list().empty());
  EXPECT_EQ(state.plots.persisted.spectrum.quantity, draw::SpectrumSettings().quantity);
  put("settings.json", R"({"plots": {"spectrum_signal": "paddle"}})");
  SettingsFile(file()).load(state);
  EXPECT_THAT(state.toasts.newest().text,
              HasSubstr("plots.spectrum_signal must be the name of a signal"));
}

TEST_F(SettingsTest, UnknownKeysOfTheOldFileAreNoProblemAndAreNotKept) {
  put("settings.toml",
      "[window]\nlower_page = \"map\"\npanel_ems = 25\nview_share = 0.3\npicture_share = 0.7\n"
      "from_the_future = 1\n");
  UiState state;
  SettingsFile settings(file());
  settings.load(state);
  EXPECT_TRUE(state.toasts.list().empty());
  settings.save(state);
  for (const char* key : {"future", "lower_page", "panel_ems", "view_share", "picture_share"})
    EXPECT_THAT(content("settings.json"), ::testing::Not(HasSubstr(key)));
}

TEST_F(SettingsTest, ABrokenOldFileIsToldAndStays) {
  put("settings.toml", "[window\ntheme = light\n");
  UiState state;
  SettingsFile settings(file());
  settings.load(state);
  EXPECT_THAT(state.toasts.newest().text, HasSubstr("settings.toml:1"));
  settings.save(state);
  EXPECT_EQ(content("settings.toml"), "[window\ntheme = light\n");
  UiState fresh;
  SettingsFile(file()).load(fresh);
  EXPECT_TRUE(fresh.toasts.list().empty()) << "the old file is read once";
}

TEST_F(SettingsTest, ADamagedLayoutIsToldAndLeftOut) {
  put("settings.json", R"_({"window": {"layout": "evening", "docked": "X21.5em(Controls"},
      "layouts": {"evening": "Wall", "night": "Y400%(Wall;Map)", "noon": 3, "": "Map"}})_");
  UiState state;
  SettingsFile(file()).load(state);
  EXPECT_EQ(state.dock.docked, "");
  ASSERT_EQ(state.dock.own_layouts.size(), 1U);
  EXPECT_EQ(ui::layout_text(state.dock.own_layouts.front().layout), "Wall");
  const std::string told = state.toasts.newest().text;
  EXPECT_THAT(told, HasSubstr("window.docked is damaged"));
  for (const char* key : {"layouts.night is", "layouts.noon is", "layouts. is"})
    EXPECT_THAT(told, HasSubstr(key));
}

// The window opens with valid values, whatever the file contains.
TEST_F(SettingsTest, NoFileIsFatal) {
  std::mt19937 random(11);
  UiState changed;
  change_all(changed);
  const std::string whole = settings_text(changed);
  std::uniform_int_distribution<std::size_t> place(0, whole.size() - 1);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int round = 0; round < 300; ++round) {
    std::string text = whole;
    for (int i = 0; i <= round % 8; ++i) text[place(random)] = static_cast<char>(byte(random));
    if (round % 5 == 0) text.resize(place(random));
    put("settings.json", text);
    UiState state;
    SettingsFile(file()).load(state);
    EXPECT_TRUE(ui::parse_layout(state.dock.docked) || state.dock.docked.empty());
    EXPECT_GE(state.appearance.scale_percent, 0);
    EXPECT_LE(state.appearance.scale_percent, 300);
    EXPECT_GE(state.time.window_s, ui::kTimeWindowsS.front());
  }
  const auto leaves = nlohmann::json::parse(whole).flatten();
  for (const auto& each : leaves.items()) {
    for (const nlohmann::json& odd :
         {nlohmann::json(), nlohmann::json(true), nlohmann::json(-1), nlohmann::json(1e300),
          nlohmann::json("x"), nlohmann::json::array(), nlohmann::json::object()}) {
      nlohmann::json json = nlohmann::json::parse(whole);
      json[nlohmann::json::json_pointer(each.key())] = odd;
      put("settings.json", json.dump());
      UiState state;
      SettingsFile(file()).load(state);
      EXPECT_LE(state.window.width, 16384) << each.key();
      EXPECT_LE(state.scene.recent.size(), 8U) << each.key();
      EXPECT_LE(state.compare.persisted.trials, 1000U) << each.key();
    }
  }
  put("settings.json", std::string(1U << 20U, '#'));
  UiState state;
  SettingsFile(file()).load(state);
  EXPECT_THAT(state.toasts.newest().text, HasSubstr("larger than"));
}

TEST_F(SettingsTest, AFailedWriteIsReportedOnce) {
  put("a", "a file where the folder should be");
  UiState state;
  SettingsFile settings(path("a/settings.json"));
  settings.load(state);
  state.window.width = 1250;
  settings.save(state);
  ASSERT_EQ(state.toasts.list().size(), 1U);
  EXPECT_THAT(state.toasts.newest().text, HasSubstr("settings are not kept"));
  state.window.width = 1260;
  settings.save(state);
  EXPECT_EQ(state.toasts.list().size(), 1U);
  EXPECT_EQ(state.toasts.newest().text, state.toasts.list()[0].message.text);
  EXPECT_EQ(state.toasts.list()[0].times, 1);
}

TEST(Settings, WithoutAPathNothingIsReadOrWritten) {
  UiState state;
  SettingsFile settings("");
  settings.load(state);
  state.window.width = 1250;
  for (int i = 0; i < 100; ++i) settings.pass(state, 1.0);
  settings.save(state);
  EXPECT_TRUE(state.toasts.list().empty());
}

}  // namespace
}  // namespace hapticwall::test
