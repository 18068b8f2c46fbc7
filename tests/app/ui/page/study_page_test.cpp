#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "app/file/text/text.h"
#include "app/ui/page/pages.h"
#include "app/ui/state/blind_test.h"
#include "tests/app/ui/gui_test.h"
#include "tests/app/ui/replay_support.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kMostLooks = 50'000;
constexpr int kFramesToRest = 60;  // frames, until the wall is refined

class StudyPageTest : public GuiTest {
 protected:
  void SetUp() override {
    GuiTest::SetUp();
    change([](Scene& brief) { brief.duration_s = 0.2; });
    click("page Study");
  }

  template <typename Change>
  void change(Change change) {
    Scene changed = scene();
    change(changed);
    ASSERT_FALSE(fake_->change_scene(changed));
    frames(2);
  }
  void compute() {
    click("study compute");
    // A study has the lowest priority: a test that looks all the time would starve it.
    for (int look = 0; look < kMostLooks && shown().running(); ++look) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      frames(1);
    }
    EXPECT_FALSE(shown().running());
    frames(3);
  }
  [[nodiscard]] ui::SceneStudy& shown() const { return state().studies.shown(); }
  [[nodiscard]] const table::Sheet& sheet() const { return shown().result()->sheet; }

  // Moves the table to its left or its right end.
  void scroll_table(bool right) {
    for (ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
      if (window->WasActive && window->ScrollMax.x > 0.0F) {
        ImGui::SetScrollX(window, right ? window->ScrollMax.x : 0.0F);
      }
    }
    frames(3);
  }
  // The cells in sight, titles first. The log has all rows in one line, with bars between cells.
  std::vector<std::vector<std::string>> lines() {
    std::vector<std::string> cells;
    const std::string all = text();
    for (const std::string_view line : file::split(all, '\n')) {
      if (!line.starts_with("|")) continue;
      for (const std::string_view cell : file::split(line, '|')) {
        if (!file::trimmed(cell).empty()) cells.emplace_back(file::trimmed(cell));
      }
    }
    const std::size_t rows = sheet().rows.size() + 1;
    EXPECT_FALSE(cells.empty());
    EXPECT_EQ(cells.size() % rows, 0U) << all;
    if (cells.empty() || cells.size() % rows != 0) return {};
    const std::size_t columns = cells.size() / rows;
    std::vector<std::vector<std::string>> lines;
    for (auto at = cells.begin(); at != cells.end(); at += static_cast<std::ptrdiff_t>(columns)) {
      lines.emplace_back(at, at + static_cast<std::ptrdiff_t>(columns));
    }
    return lines;
  }
  std::vector<std::string> first_cells() {
    std::vector<std::string> cells;
    for (const auto& line : lines()) cells.push_back(line.front());
    return cells;
  }

  // Scrolled to the left the table shows the first cells of each row, to the right the last ones.
  void expect_every_cell() {
    for (const bool right : {false, true}) {
      scroll_table(right);
      std::vector<std::vector<std::string>> shown_rows = lines();
      ASSERT_EQ(shown_rows.size(), sheet().rows.size() + 1) << text();
      shown_rows.erase(shown_rows.begin());  // the titles
      for (std::size_t i = 0; i < shown_rows.size(); ++i) {
        std::vector<std::string> seen = shown_rows[i];
        std::vector<std::string> wanted;
        for (const std::string& cell : sheet().rows[i]) wanted.emplace_back(file::trimmed(cell));
        EXPECT_EQ(seen.front(), wanted.front()) << "it stays in sight";
        ASSERT_GT(2 * seen.size(), wanted.size()) << "both ends make the whole";
        if (right) {
          std::ranges::reverse(seen);
          std::ranges::reverse(wanted);
          seen.pop_back();
        }
        wanted.resize(seen.size());
        EXPECT_EQ(seen, wanted);
      }
    }
  }
};

TEST_F(StudyPageTest, ShowsEveryCellOfTheRankingWithTheFirstColumnInSight) {
  EXPECT_THAT(text(), HasSubstr("not computed yet"));
  compute();
  ASSERT_TRUE(shown().complete());
  EXPECT_THAT(text(), HasSubstr("complete, in "));
  EXPECT_THAT(text(), HasSubstr("press: wall of 35.00 kN/m"));
  expect_every_cell();
  EXPECT_TRUE(sees("study column algorithm"));
}

TEST_F(StudyPageTest, ShowsEveryCellOfTheAccuracyBelowItsDiagram) {
  change([](Scene& brief) { brief.duration_s = 0.05; });
  click("study accuracy");
  compute();
  EXPECT_THAT(text(), HasSubstr("(a) Largest error of position"));
  EXPECT_THAT(text(), HasSubstr("reference: "));
  scroll_down_at("study csv");
  expect_every_cell();
}

TEST_F(StudyPageTest, AHeaderSortsTheRowsAndNotTheCopy) {
  compute();
  const std::vector<std::string> as_computed = first_cells();
  click("study column algorithm");
  std::vector<std::string> sorted = first_cells();
  EXPECT_NE(sorted, as_computed);
  EXPECT_TRUE(std::is_sorted(sorted.begin() + 1, sorted.end()));
  click("study column algorithm");
  std::reverse(sorted.begin() + 1, sorted.end());
  EXPECT_EQ(first_cells(), sorted);
  click("study copy");
  EXPECT_EQ(ImGui::GetClipboardText(), table::sheet_text(sheet()));
  EXPECT_THAT(ImGui::GetClipboardText(), HasSubstr("\nvirtual-coupling "));
  click("study csv");
  EXPECT_EQ(ImGui::GetClipboardText(), shown().result()->csv);
  click("study column algorithm");
  EXPECT_EQ(first_cells(), as_computed) << "the third click takes the order away";
}

TEST_F(StudyPageTest, TheButtonEndsIt) {
  change([](Scene& endless) { endless.duration_s = 1e4; });
  click("study compute");
  ASSERT_TRUE(shown().running());
  EXPECT_THAT(text(), HasSubstr("0 %"));
  click("study compute");
  EXPECT_FALSE(shown().running());
  EXPECT_THAT(text(), HasSubstr("not computed yet"));
}

TEST_F(StudyPageTest, OneStudyRunsAtATime) {
  change([](Scene& endless) { endless.duration_s = 1e4; });
  click("study compute");
  click("study accuracy");
  EXPECT_TRUE(state().studies.all[0].running());
  click("study compute");
  EXPECT_TRUE(state().studies.all[1].running());
  EXPECT_FALSE(state().studies.all[0].running());
}

TEST_F(StudyPageTest, AChangeOfTheSceneMarksTheTable) {
  compute();
  EXPECT_THAT(text(), Not(HasSubstr("of the scene before")));
  change([](Scene& changed) { changed.x().walls.front().stiffness_n_per_m = 500.0; });
  EXPECT_THAT(text(), HasSubstr("of the scene before"));
  EXPECT_THAT(text(), HasSubstr("press: wall of 35.00 kN/m"));
  compute();
  EXPECT_THAT(text(), Not(HasSubstr("of the scene before")));
  EXPECT_THAT(text(), HasSubstr("press: wall of 0.50 kN/m"));
}

TEST_F(StudyPageTest, AnotherPageAndABlindTestEndIt) {
  change([](Scene& endless) { endless.duration_s = 1e4; });
  click("study compute");
  frames(kFramesToRest);
  ASSERT_TRUE(shown().running());
  EXPECT_TRUE(application_->moving()) << "a paused window takes the result";
  click("page Blind test");
  EXPECT_FALSE(shown().running());
  frames(kFramesToRest);
  EXPECT_FALSE(application_->moving());
  start_trials(4);
  ASSERT_TRUE(ui::blind_test_runs(state().compare));
  frames(3);
  EXPECT_FALSE(sees("study compute"));
}

TEST_F(StudyPageTest, WhereTheForceIsHiddenThePageSaysWhy) {
  const draw::Theme theme = draw::apply_theme(draw::Look::kScreen, 1.0F);
  const session::Snapshot snapshot = fake_->snapshot();
  const ui::PanelContext context =
      ui::context_of(state(), *fake_, snapshot, theme, {.live = fake_, .hides_force = true});
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  ImGui::LogToBuffer(0);
  ui::draw_study_page(context, state().studies);
  EXPECT_THAT(ImGui::GetCurrentContext()->LogBuffer.c_str(), HasSubstr("Hidden until"));
  ImGui::LogFinish();
  ImGui::Render();
}

TEST_F(StudyPageTest, ADeviceHasNoStudyAndThePageSaysSo) {
  with_device = true;
  open("press");
  click("page Study");
  frames(3);
  EXPECT_THAT(text(), HasSubstr("The hand at a device has no model"));
  EXPECT_FALSE(sees("study compute"));
}

class StudyOfARecording : public ReplayGuiTest {};

TEST_F(StudyOfARecording, IsNotThereAndThePageSaysWhy) {
  record("a.csv", 200);
  drop("a.csv");
  click("page Study");
  frames(2);
  EXPECT_THAT(text(), HasSubstr("a recording is shown"));
  EXPECT_FALSE(sees("study compute"));
}

}  // namespace
}  // namespace hapticwall::test
