#include "app/ui/state/settings_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "app/file/scene/settings_text.h"
#include "tests/paths.h"
#include "tests/temporary_folder.h"

namespace hapticwall::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ui::apply_settings;
using ui::settings_of;
using ui::SettingsFile;
using ui::UiState;

// A state with no default value.
void change_all(UiState& state) {
  state.persisted.look = draw::Look::kLight;
  state.persisted.scale_percent = 150;
  state.persisted.layout = "evening";
  state.persisted.docked = "X21.50em(Controls;Plots)";
  state.persisted.own_layouts = {{"evening", *ui::parse_layout("Wall")},
                                 {"a: b", *ui::parse_layout("Y25%(Wall;Map*,Plots)")}};
  state.persisted.recording_folder = "/tmp/recordings of mine";
  state.persisted.records_signals = true;
  state.persisted.recent = {"/a/b.toml", "/c \"d\".csv"};
  state.persisted.window_width = 1234;
  state.persisted.window_height = 800;
  state.persisted.window_maximised = true;
  state.persisted.withdraw_mm_per_s = 40.0;
  state.persisted.time_window_s = 60.0;
  state.persisted.arrangement = ui::PlotArrangement::kFigure5And6;
  state.persisted.hidden_lines =
      draw::line_bit(&Sample::wall_force_n) | draw::line_bit(&Sample::energy_scv_j);
  state.plots.persisted.lines.at(0) = draw::line_bit(&Sample::position_m);
  state.plots.persisted.trigger = {draw::TriggerMode::kNormal, 0.5};
  state.plots.persisted.phase.shown = true;
  state.plots.persisted.spectrum = {true, &Sample::force_n};
  state.plots.persisted.show_bounds = false;
  state.wall.persisted.magnification = 50;
  state.compare.persisted = {false, "Which is steadier?", 12, 0.9, false};
  state.persisted.sound_volume = 0.8;
}

class SettingsTest : public FolderTest {
 protected:
  [[nodiscard]] std::string file() const { return path("settings.toml"); }
};

TEST(Settings, EverythingThatIsKeptComesBack) {
  UiState state;
  change_all(state);
  const file::Settings settings = settings_of(state);
  UiState fresh;
  EXPECT_NE(settings_of(fresh), settings);
  EXPECT_TRUE(apply_settings(settings, fresh).empty());
  EXPECT_EQ(settings_of(fresh), settings);
  EXPECT_EQ(fresh.persisted.hidden_lines, state.persisted.hidden_lines);
  EXPECT_EQ(fresh.plots.persisted.lines, state.plots.persisted.lines);
  EXPECT_EQ(fresh.persisted.recent, state.persisted.recent);
  EXPECT_EQ(fresh.persisted.own_layouts, state.persisted.own_layouts);
  // Every key differs from its default, so that the comparison above is meaningful.
  const UiState at_start;
  const file::Settings usual = settings_of(at_start);
  std::size_t changed = 0;
  for (const auto& [key, value] : settings) {
    const auto at_first = usual.find(key);
    if (at_first == usual.end() || at_first->second != value) ++changed;
  }
  EXPECT_GE(changed, 25U);
}

TEST_F(SettingsTest, ThePageShowsAWholeFileWithoutAnUnknownKeyOrInvalidValue) {
  const std::string page = text_of(data_folder() + "/../docs/window.md");
  const std::string fence = "```toml settings\n";
  const std::size_t begin = page.find(fence) + fence.size();
  ASSERT_GT(begin, fence.size());
  const auto shown = file::parse_settings(page.substr(begin, page.find("```", begin) - begin), "");
  ASSERT_TRUE(shown) << shown.error().message;
  EXPECT_GT(shown->size(), 10U);
  UiState state;
  EXPECT_THAT(apply_settings(*shown, state), ::testing::IsEmpty());
  const file::Settings taken = settings_of(state);
  for (const auto& [key, value] : *shown) EXPECT_TRUE(taken.contains(key)) << key;
}

TEST_F(SettingsTest, AFileIsWrittenIntoANewFolderAndReadBack) {
  const std::string file = path("a/settings.toml");
  UiState state;
  SettingsFile settings(file);
  settings.load(state);
  EXPECT_FALSE(fs::exists(file)) << "nothing has changed yet";
  change_all(state);
  settings.save(state);
  UiState fresh;
  SettingsFile(file).load(fresh);
  EXPECT_EQ(settings_of(fresh), settings_of(state));
  EXPECT_TRUE(fresh.transient.toasts.list().empty());
  EXPECT_FALSE(fs::exists(file + ".partial"));
}

TEST_F(SettingsTest, AChangeIsWrittenOnceItRests) {
  UiState state;
  SettingsFile settings(file());
  settings.load(state);
  constexpr double kFrameS = 1.0 / 60.0;
  for (int frame = 0; frame < 300; ++frame) {  // a drag of five seconds
    state.persisted.sound_volume = 0.003 * frame;
    settings.pass(state, kFrameS);
    EXPECT_FALSE(fs::exists(file()));
  }
  for (int frame = 0; frame < 120; ++frame) settings.pass(state, kFrameS);
  ASSERT_TRUE(fs::exists(file()));
  EXPECT_THAT(content("settings.toml"), HasSubstr("volume = 0.897"));
  fs::remove(file());
  for (int frame = 0; frame < 600; ++frame) settings.pass(state, kFrameS);
  EXPECT_FALSE(fs::exists(file())) << "unchanged settings are not written again";
}

TEST_F(SettingsTest, ABrokenFileIsToldKeptAsideAndReplaced) {
  put("settings.toml", "[window\ntheme = light\n");
  UiState state;
  SettingsFile settings(file());
  settings.load(state);
  ASSERT_EQ(state.transient.toasts.list().size(), 1U);
  const ui::Message told = state.transient.toasts.newest();
  EXPECT_EQ(told.kind, ui::MessageKind::kProblem);
  EXPECT_THAT(told.text, HasSubstr("settings.toml:1"));
  EXPECT_THAT(told.text, HasSubstr("settings.toml.broken"));
  const UiState usual;
  EXPECT_EQ(settings_of(state), settings_of(usual));
  EXPECT_EQ(content("settings.toml.broken"), "[window\ntheme = light\n");
  settings.save(state);
  UiState fresh;
  SettingsFile(file()).load(fresh);
  EXPECT_TRUE(fresh.transient.toasts.list().empty());
}

TEST_F(SettingsTest, AValueThatDoesNotFitIsToldAndTheOthersAreTaken) {
  put("settings.toml",
      "[window]\ntheme = \"pink\"\nscale_percent = 1e9\nmore = 3\n"
      "width = 1250\nfrom_the_future = 1\n[other]\nx = 2\n[recent]\nfile_1 = 3\n"
      "[plots]\nloop = 1\n");
  UiState state;
  SettingsFile(file()).load(state);
  EXPECT_EQ(state.persisted.window_width, 1250);
  EXPECT_EQ(state.persisted.look, draw::Look::kScreen);
  EXPECT_EQ(state.persisted.scale_percent, 0);
  const std::string told = state.transient.toasts.newest().text;
  EXPECT_THAT(told, HasSubstr("window.theme must be one of: dark, light"));
  EXPECT_THAT(told, HasSubstr("window.scale_percent must be a number from 0 to 300"));
  EXPECT_THAT(told, HasSubstr("window.more must be true or false"));
  EXPECT_THAT(told, HasSubstr("plots.loop must be true or false"));
  EXPECT_THAT(told, ::testing::Not(HasSubstr("future")));
  EXPECT_TRUE(fs::exists(file() + ".broken"));
}

TEST_F(SettingsTest, ASpectrumOfASignalThatNoLongerExistsIsLeftOut) {
  put("settings.toml",
      "[plots]\nderived = \"derivative(handle)\"\nspectrum_signal = \"derivative(handle)\"\n");
  UiState state;
  SettingsFile(file()).load(state);
  EXPECT_TRUE(state.transient.toasts.list().empty());
  EXPECT_EQ(state.plots.persisted.spectrum.quantity, draw::SpectrumSettings().quantity);
  put("settings.toml", "[plots]\nspectrum_signal = \"paddle\"\n");
  SettingsFile(file()).load(state);
  EXPECT_THAT(state.transient.toasts.newest().text,
              HasSubstr("plots.spectrum_signal must be the name of a signal"));
}

TEST_F(SettingsTest, UnknownKeysAreNoProblemAndAreNotKept) {
  put("settings.toml",
      "[window]\nlower_page = \"map\"\npanel_ems = 25\nview_share = 0.3\npicture_share = 0.7\n"
      "from_the_future = 1\n");
  UiState state;
  SettingsFile settings(file());
  settings.load(state);
  EXPECT_TRUE(state.transient.toasts.list().empty());
  state.persisted.window_width = 1260;
  settings.save(state);
  for (const char* key : {"future", "lower_page", "panel_ems", "view_share", "picture_share"})
    EXPECT_THAT(content("settings.toml"), ::testing::Not(HasSubstr(key)));
}

TEST_F(SettingsTest, ADamagedLayoutIsToldAndLeftOut) {
  put("settings.toml",
      "[window]\nlayout = \"evening\"\ndocked = \"X21.5em(Controls\"\n[layouts]\n"
      "own_01 = \"evening: Wall\"\nown_02 = \"night: Y400%(Wall;Map)\"\nown_03 = 3\n"
      "own_04 = \"evening: Map\"\nown_05 = \": Map\"\n");
  UiState state;
  SettingsFile(file()).load(state);
  EXPECT_EQ(state.persisted.docked, "");
  ASSERT_EQ(state.persisted.own_layouts.size(), 1U);
  EXPECT_EQ(ui::layout_text(state.persisted.own_layouts.front().layout), "Wall");
  const std::string told = state.transient.toasts.newest().text;
  EXPECT_THAT(told, HasSubstr("window.docked is damaged"));
  for (const char* key : {"layouts.own_02 is", "layouts.own_03 is", "own_04 is", "own_05 is"})
    EXPECT_THAT(told, HasSubstr(key));
}

// The window opens with valid values, whatever the file contains.
TEST_F(SettingsTest, NoFileIsFatal) {
  std::mt19937 random(11);
  UiState changed;
  change_all(changed);
  const std::string whole = file::settings_text(settings_of(changed));
  std::uniform_int_distribution<std::size_t> place(0, whole.size() - 1);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int round = 0; round < 300; ++round) {
    std::string text = whole;
    for (int i = 0; i <= round % 8; ++i) text[place(random)] = static_cast<char>(byte(random));
    if (round % 5 == 0) text.resize(place(random));
    put("settings.toml", text);
    UiState state;
    SettingsFile(file()).load(state);
    EXPECT_TRUE(ui::parse_layout(state.persisted.docked) || state.persisted.docked.empty());
    EXPECT_GE(state.persisted.scale_percent, 0);
    EXPECT_LE(state.persisted.scale_percent, 300);
    EXPECT_GE(state.persisted.time_window_s, ui::kTimeWindowsS.front());
  }
  put("settings.toml", std::string(1U << 20U, '#'));
  UiState state;
  SettingsFile(file()).load(state);
  EXPECT_THAT(state.transient.toasts.newest().text, HasSubstr("larger than"));
}

TEST_F(SettingsTest, AFailedWriteIsReportedOnce) {
  put("a", "a file where the folder should be");
  UiState state;
  SettingsFile settings(path("a/settings.toml"));
  settings.load(state);
  state.persisted.window_width = 1250;
  settings.save(state);
  ASSERT_EQ(state.transient.toasts.list().size(), 1U);
  EXPECT_THAT(state.transient.toasts.newest().text, HasSubstr("settings are not kept"));
  state.persisted.window_width = 1260;
  settings.save(state);
  EXPECT_EQ(state.transient.toasts.list().size(), 1U);
  EXPECT_EQ(state.transient.toasts.newest().text, state.transient.toasts.list()[0].message.text);
  EXPECT_EQ(state.transient.toasts.list()[0].times, 1);
}

TEST(Settings, WithoutAPathNothingIsReadOrWritten) {
  UiState state;
  SettingsFile settings("");
  settings.load(state);
  state.persisted.window_width = 1250;
  for (int i = 0; i < 100; ++i) settings.pass(state, 1.0);
  settings.save(state);
  EXPECT_TRUE(state.transient.toasts.list().empty());
}

}  // namespace
}  // namespace hapticwall::test
