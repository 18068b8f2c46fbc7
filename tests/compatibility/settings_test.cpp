// The settings of earlier versions. A key that the window no longer knows is no problem.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "app/ui/window/settings_file.h"
#include "tests/paths.h"
#include "tests/temporary_folder.h"

namespace hapticwall::test {
namespace {

using ::testing::ElementsAre;

TEST(Version010, SettingsWithEveryKeyAreTakenWithoutAComplaint) {
  const TemporaryFolder folder;
  const std::string path = folder.file("settings.toml");
  std::filesystem::copy_file(data_folder() + "/compatibility/0.1.0/settings.toml", path);
  ui::UiState state;
  ui::SettingsFile settings(folder.file("settings.json"));
  settings.load(state);
  EXPECT_TRUE(state.toasts.list().empty()) << state.toasts.newest().text;
  EXPECT_THAT(folder.names(), ElementsAre("settings.toml"));

  EXPECT_EQ(state.appearance.look, draw::Look::kLight);
  EXPECT_EQ(state.appearance.scale_percent, 100);
  EXPECT_EQ(state.window.width, 1234);
  EXPECT_EQ(state.window.height, 800);
  EXPECT_TRUE(state.window.more);
  EXPECT_EQ(state.dock.layout, "evening");
  EXPECT_EQ(state.hand.withdraw_mm_per_s, 40.0);
  EXPECT_EQ(state.recording.chosen_folder, "/tmp/recordings of mine");
  EXPECT_TRUE(state.recording.chosen_signals);
  EXPECT_EQ(state.time.window_s, 6.0);
  EXPECT_EQ(state.plots.persisted.arrangement, ui::PlotArrangement::kAll);
  EXPECT_THAT(state.scene.recent, ElementsAre("/a/b.toml"));
  EXPECT_NEAR(state.sound.volume, 0.8, 1e-6);
  EXPECT_EQ(state.wall.persisted.magnification, 50.0);
  EXPECT_FALSE(state.compare.persisted.ghost_shown);

  const ui::PlotsState::Persisted& plots = state.plots.persisted;
  EXPECT_TRUE(plots.phase.shown && plots.phase.last_contact && plots.spectrum.shown);
  EXPECT_EQ(plots.spectrum.quantity, draw::Quantity(&Sample::force_n));
  EXPECT_FALSE(plots.show_bounds);
  EXPECT_EQ(plots.trigger.mode, draw::TriggerMode::kNormal);
  EXPECT_EQ(plots.trigger.pre_share, 0.5);
  EXPECT_EQ(plots.lines.at(0), draw::line_bit(&Sample::position_m));
  EXPECT_EQ(plots.lines.at(1),
            draw::line_bit(&Sample::force_n) | draw::line_bit(&Sample::wall_force_n));
}

TEST(Version010, SettingsAreReadOnceAndKeptAsJson) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(data_folder() + "/compatibility/0.1.0/settings.toml",
                             folder.file("settings.toml"));
  ui::UiState state;
  ui::SettingsFile settings(folder.file("settings.json"));
  settings.load(state);
  settings.save(state);
  EXPECT_THAT(folder.names(), ::testing::UnorderedElementsAre("settings.json", "settings.toml"));
  std::filesystem::remove(folder.file("settings.toml"));
  ui::UiState again;
  ui::SettingsFile(folder.file("settings.json")).load(again);
  EXPECT_TRUE(again.toasts.list().empty());
  EXPECT_EQ(ui::settings_text(again), ui::settings_text(state));
}

// Layouts of one's own, also one with a window that floats.
TEST(Version010, LayoutsAreThereByTheirNames) {
  ui::UiState state;
  const auto problems = ui::apply_old_settings(
      text_of(data_folder() + "/compatibility/0.1.0/settings.toml"), "settings.toml", state);
  ASSERT_TRUE(problems) << problems.error().message;
  EXPECT_THAT(*problems, ::testing::IsEmpty());
  ASSERT_EQ(state.dock.own_layouts.size(), 2U);
  EXPECT_EQ(state.dock.own_layouts[0].name, "evening");
  EXPECT_EQ(state.dock.own_layouts[1].name, "a: b");
  EXPECT_EQ(state.dock.own_layouts[1].layout.floating.size(), 1U);
  EXPECT_FALSE(state.dock.docked.empty());
}

}  // namespace
}  // namespace hapticwall::test
