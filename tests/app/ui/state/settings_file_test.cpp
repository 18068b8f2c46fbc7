#include "app/ui/state/settings_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "app/file/scene/settings_text.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ui::apply_settings;
using ui::settings_of;
using ui::SettingsFile;
using ui::UiState;

class Folder {
 public:
  Folder() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = fs::path(::testing::TempDir()) / (std::string("hapticwall_settings_") + info->name());
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }
  [[nodiscard]] std::string file() const { return (path_ / "a" / "settings.toml").string(); }
  void put(const std::string& text) const {
    fs::create_directories(fs::path(file()).parent_path());
    std::ofstream(file()) << text;
  }
  [[nodiscard]] static std::string content(const std::string& path) {
    std::ifstream in(path);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// A state with no default value.
void change_all(UiState& state) {
  state.persisted.look = draw::Look::kLight;
  state.persisted.scale_percent = 150;
  state.persisted.panel_ems = 30.5;
  state.persisted.view_share = 0.3;
  state.persisted.picture_share = 0.7;
  state.persisted.recording_folder = "/tmp/recordings of mine";
  state.persisted.recent = {"/a/b.toml", "/c \"d\".csv"};
  state.persisted.window_width = 1234;
  state.persisted.window_height = 800;
  state.persisted.window_maximised = true;
  state.persisted.hand_stays_where_released = true;
  state.persisted.time_window_s = 60.0;
  state.persisted.arrangement = ui::PlotArrangement::kFigure5And6;
  state.persisted.hidden_lines =
      draw::line_bit(&Sample::wall_force_n) | draw::line_bit(&Sample::energy_scv_j);
  state.plots.persisted.lines.at(0) = draw::line_bit(&Sample::position_m);
  state.plots.persisted.trigger = {draw::TriggerMode::kNormal, 0.5};
  state.plots.persisted.phase.shown = true;
  state.plots.persisted.show_bounds = false;
  state.wall.persisted.magnification = 50;
  state.persisted.lower_page = ui::LowerPage::kBlindTest;
  state.compare.persisted = {false, "Which is steadier?", 12, 0.9};
}

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
  // Every key differs from its default, so that the comparison above is meaningful.
  const UiState at_start;
  const file::Settings usual = settings_of(at_start);
  std::size_t changed = 0;
  for (const auto& [key, value] : settings) {
    const auto at_first = usual.find(key);
    if (at_first == usual.end() || at_first->second != value) ++changed;
  }
  EXPECT_GE(changed, 24U);
}

TEST(Settings, AFileIsWrittenAndReadBack) {
  const Folder folder;
  UiState state;
  SettingsFile file(folder.file());
  file.load(state);
  EXPECT_FALSE(fs::exists(folder.file())) << "nothing has changed yet";
  change_all(state);
  file.save(state);
  UiState fresh;
  SettingsFile(folder.file()).load(fresh);
  EXPECT_EQ(settings_of(fresh), settings_of(state));
  EXPECT_TRUE(fresh.transient.toasts.list().empty());
  EXPECT_FALSE(fs::exists(folder.file() + ".partial"));
}

TEST(Settings, AChangeIsWrittenOnceItRests) {
  const Folder folder;
  UiState state;
  SettingsFile file(folder.file());
  file.load(state);
  constexpr double kFrameS = 1.0 / 60.0;
  for (int frame = 0; frame < 300; ++frame) {  // a drag of five seconds
    state.persisted.panel_ems = 20.0 + 0.01 * frame;
    file.pass(state, kFrameS);
    EXPECT_FALSE(fs::exists(folder.file()));
  }
  for (int frame = 0; frame < 120; ++frame) file.pass(state, kFrameS);
  ASSERT_TRUE(fs::exists(folder.file()));
  EXPECT_THAT(Folder::content(folder.file()), HasSubstr("panel_ems = 22.99"));
  fs::remove(folder.file());
  for (int frame = 0; frame < 600; ++frame) file.pass(state, kFrameS);
  EXPECT_FALSE(fs::exists(folder.file())) << "what has not changed is not written again";
}

TEST(Settings, ABrokenFileIsToldKeptAsideAndReplaced) {
  const Folder folder;
  folder.put("[window\ntheme = light\n");
  UiState state;
  SettingsFile file(folder.file());
  file.load(state);
  ASSERT_EQ(state.transient.toasts.list().size(), 1U);
  const ui::Message told = state.transient.toasts.newest();
  EXPECT_EQ(told.kind, ui::MessageKind::kProblem);
  EXPECT_THAT(told.text, HasSubstr("settings.toml:1"));
  EXPECT_THAT(told.text, HasSubstr("settings.toml.broken"));
  const UiState usual;
  EXPECT_EQ(settings_of(state), settings_of(usual));
  EXPECT_EQ(Folder::content(folder.file() + ".broken"), "[window\ntheme = light\n");
  file.save(state);
  UiState fresh;
  SettingsFile(folder.file()).load(fresh);
  EXPECT_TRUE(fresh.transient.toasts.list().empty());
}

TEST(Settings, AValueThatDoesNotFitIsToldAndTheOthersAreTaken) {
  const Folder folder;
  folder.put(
      "[window]\ntheme = \"pink\"\nscale_percent = 1e9\nview_share = true\n"
      "panel_ems = 25\nfrom_the_future = 1\n[other]\nx = 2\n[recent]\nfile_1 = 3\n"
      "[plots]\nloop = 1\n");
  UiState state;
  SettingsFile(folder.file()).load(state);
  EXPECT_DOUBLE_EQ(state.persisted.panel_ems, 25.0);
  EXPECT_EQ(state.persisted.look, draw::Look::kScreen);
  EXPECT_EQ(state.persisted.scale_percent, 0);
  const std::string told = state.transient.toasts.newest().text;
  EXPECT_THAT(told, HasSubstr("window.theme must be one of: dark, light"));
  EXPECT_THAT(told, HasSubstr("window.scale_percent must be a number from 0 to 300"));
  EXPECT_THAT(told, HasSubstr("window.view_share must be a number"));
  EXPECT_THAT(told, HasSubstr("plots.loop must be true or false"));
  EXPECT_THAT(told, ::testing::Not(HasSubstr("future")));
  EXPECT_TRUE(fs::exists(folder.file() + ".broken"));
}

TEST(Settings, UnknownKeysAreNoProblemAndAreNotKept) {
  const Folder folder;
  folder.put("[window]\npanel_ems = 25\nfrom_the_future = 1\n");
  UiState state;
  SettingsFile file(folder.file());
  file.load(state);
  EXPECT_TRUE(state.transient.toasts.list().empty());
  state.persisted.panel_ems = 26.0;
  file.save(state);
  EXPECT_THAT(Folder::content(folder.file()), ::testing::Not(HasSubstr("future")));
}

// The window opens with valid values, whatever the file contains.
TEST(Settings, NoFileIsFatal) {
  const Folder folder;
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
    folder.put(text);
    UiState state;
    SettingsFile(folder.file()).load(state);
    EXPECT_GE(state.persisted.view_share, 0.1);
    EXPECT_LE(state.persisted.view_share, 0.9);
    EXPECT_GE(state.persisted.scale_percent, 0);
    EXPECT_LE(state.persisted.scale_percent, 300);
    EXPECT_GE(state.persisted.time_window_s, ui::kTimeWindowsS.front());
  }
  folder.put(std::string(1U << 20U, '#'));
  UiState state;
  SettingsFile(folder.file()).load(state);
  EXPECT_THAT(state.transient.toasts.newest().text, HasSubstr("larger than"));
}

TEST(Settings, WhatCannotBeWrittenIsToldOnce) {
  const Folder folder;
  std::ofstream(folder.path() / "a") << "a file where the folder should be";
  UiState state;
  SettingsFile file(folder.file());
  file.load(state);
  state.persisted.panel_ems = 25.0;
  file.save(state);
  ASSERT_EQ(state.transient.toasts.list().size(), 1U);
  EXPECT_THAT(state.transient.toasts.newest().text, HasSubstr("settings are not kept"));
  state.persisted.panel_ems = 26.0;
  file.save(state);
  EXPECT_EQ(state.transient.toasts.list().size(), 1U);
  EXPECT_EQ(state.transient.toasts.newest().text, state.transient.toasts.list()[0].message.text);
  EXPECT_EQ(state.transient.toasts.list()[0].times, 1);
}

TEST(Settings, WithoutAPathNothingIsReadOrWritten) {
  UiState state;
  SettingsFile file("");
  file.load(state);
  state.persisted.panel_ems = 25.0;
  for (int i = 0; i < 100; ++i) file.pass(state, 1.0);
  file.save(state);
  EXPECT_TRUE(state.transient.toasts.list().empty());
}

class SettingsOfTheWindow : public GuiTest {};

TEST_F(SettingsOfTheWindow, TheFolderOfRecordingsIsTypedAndMustBeThere) {
  const Folder folder;
  click("settings");
  frames(2);
  type("recording folder", "/nowhere at all");
  EXPECT_THAT(message().text, HasSubstr("there is no such folder"));
  EXPECT_EQ(application_->state().transient.recording_folder, "");
  application_->state().transient.toasts.clear();
  frames(2);
  type("recording folder", folder.path().string());
  EXPECT_EQ(application_->state().persisted.recording_folder, folder.path());
  press(ImGuiKey_Escape);
  click("record");
  EXPECT_EQ(fake_->recording_status().path, (folder.path() / "press-energy-bounding.csv").string());
}

}  // namespace
}  // namespace hapticwall::test
