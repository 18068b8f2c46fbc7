#include "app/ui/page/timing_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <cmath>
#include <random>

#include "app/ui/page/timing_histogram.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using draw::Tone;
using ::testing::HasSubstr;
using ui::TimingState;

constexpr double kRateHz = 1000.0;

void count(session::LatencyCounts& counts, std::int64_t time_ns, std::uint64_t cycles = 1) {
  counts.bins[session::LatencyBins::of(time_ns)] += cycles;
  counts.maximum_ns = std::max(counts.maximum_ns, time_ns);
}

// A realistic loop: 12 µs late, sometimes more than 100 µs.
session::TimingHistograms usual_timing(int cycles) {
  std::mt19937 random(3);
  std::lognormal_distribution<double> latency(std::log(9e3), 0.5);
  std::lognormal_distribution<double> compute(std::log(2e3), 0.3);
  session::TimingHistograms timing;
  for (int i = 0; i < cycles; ++i) {
    count(timing.wake_latency, static_cast<std::int64_t>(latency(random)));
    count(timing.compute_time, static_cast<std::int64_t>(compute(random)));
  }
  return timing;
}

TEST(TimeText, HasThreeDigitsThatCount) {
  EXPECT_EQ(ui::time_text(0), "0 ns");
  EXPECT_EQ(ui::time_text(850), "850 ns");
  EXPECT_EQ(ui::time_text(14'240), "14.2 µs");
  EXPECT_EQ(ui::time_text(312'400), "312 µs");
  EXPECT_EQ(ui::time_text(1'340'000), "1.34 ms");
  EXPECT_EQ(ui::time_text(2'000'000'000), "2 s");
}

TEST(FrameTimesTest, KeepTheNewestAndTellMeanAndWorst) {
  ui::FrameTimes frames;
  EXPECT_EQ(ui::frame_stats(frames).maximum_ms, 0.0);
  for (int i = 1; i <= 100; ++i) frames.add(1e-3 * i);
  EXPECT_NEAR(ui::frame_stats(frames).mean_ms, 50.5, 1e-9);
  EXPECT_NEAR(ui::frame_stats(frames).p99_ms, 99.0, 1e-9);
  EXPECT_NEAR(ui::frame_stats(frames).maximum_ms, 100.0, 1e-9);
  for (std::size_t i = 0; i < ui::FrameTimes::kKept; ++i) frames.add(i == 0 ? 0.007 : 0.005);
  EXPECT_EQ(frames.size(), ui::FrameTimes::kKept);
  EXPECT_NEAR(ui::frame_stats(frames).maximum_ms, 7.0, 1e-9);
  ui::FrameTimes::Series series{};
  EXPECT_NEAR(frames.copy_ms(series).front(), 7.0, 1e-9) << "the oldest comes first";
}

class TimingSentence : public ::testing::Test {
 protected:
  std::string sentence(std::int64_t latency_ns, std::uint64_t missed = 0) {
    TimingState timing;
    session::LatencyCounts counts;
    count(counts, latency_ns, 10'000);
    timing.wake_latency = session::quantiles(counts);
    timing.shown.missed_ticks = missed;
    return ui::timing_sentence(timing, kRateHz, tone);
  }
  Tone tone = Tone::kText;
};

TEST_F(TimingSentence, SaysInWordsWhetherTheLoopKeepsItsTime) {
  EXPECT_EQ(sentence(14'000), "The loop meets its deadlines: p99 14 µs late of a 1000 µs period.");
  EXPECT_EQ(tone, Tone::kGood);
  EXPECT_EQ(
      sentence(200'000, 1),
      "The loop mostly meets its deadlines: p99.9 200 µs late of a 1000 µs period, 1 of 10001 "
      "ticks missed.");
  EXPECT_EQ(tone, Tone::kWarning);
  EXPECT_THAT(sentence(14'000, 500), HasSubstr("misses its deadlines"));
  EXPECT_EQ(tone, Tone::kBad);
}

TEST_F(TimingSentence, WaitsForAThousandCyclesAndKnowsWhereThereIsNoLoop) {
  TimingState timing;
  EXPECT_EQ(ui::timing_sentence(timing, kRateHz, tone), "No loop runs here.");
  timing.wake_latency.count = 999;
  EXPECT_THAT(ui::timing_sentence(timing, kRateHz, tone), HasSubstr("Measuring"));
}

class TimingPageTest : public GuiTest {
 protected:
  static constexpr float kPageHeight = 330.0F;

  // Only the page; `width` and `height` at scale 1.
  file::Picture page(float scale = 1.0F, draw::Look look = draw::Look::kScreen,
                     ImVec2 size = ImVec2(980.0F, kPageHeight)) {
    draw::restyle(theme_, look, scale);
    for (int i = 0; i < 3; ++i) draw_page(ImVec2(scale * size.x, scale * size.y));
    target_->bind();
    const ImVec4& background = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
    glClearColor(background.x, background.y, background.z, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    target_->resolve();
    return draw::read_pixels(target_->resolved_framebuffer(), kScreenWidth, kScreenHeight);
  }

  void draw_page(ImVec2 size) {
    ImGui_ImplOpenGL3_NewFrame();
    watch_items();
    ImGui::NewFrame();
    const session::Snapshot snapshot = fake_->snapshot();
    ui::note_timing(state().timing, fake_, snapshot.timing);
    ImGui::SetNextWindowPos(ImVec2(0.0F, 0.0F));
    ImGui::SetNextWindowSize(size);
    ImGui::Begin("page", nullptr, ImGuiWindowFlags_NoDecoration);
    ui::draw_timing_page(ui::context_of(state(), *fake_, snapshot, theme_, {.live = fake_}));
    ImGui::End();
    ImGui::Render();
  }

  void run_a_while() {
    fake_->histograms = usual_timing(120'000);
    count(fake_->histograms.wake_latency, 140'000, 60);
    count(fake_->histograms.wake_latency, 1'900'000);
    fake_->timing.ticks = 120'000;
    fake_->timing.missed_ticks = 1;
    for (int i = 0; i < 700; ++i) state().timing.frames.add(0.012 + 0.004 * (i % 7));
  }

  draw::Theme theme_ = {};

  void SetUp() override {
    GuiTest::SetUp();
    theme_ = draw::apply_theme(draw::Look::kScreen, 1.0F);
  }
};

TEST_F(TimingPageTest, WithoutALoopItSaysSo) {
  page();
  const ui::TimingState& timing = state().timing;
  EXPECT_EQ(timing.wake_latency.count, 0U);
  EXPECT_TRUE(timing.since_start());
  EXPECT_TRUE(sees("Wake-up latency"));
  expect_within(980.0F);
}

TEST_F(TimingPageTest, ShowsHistogramsAndFiguresOfManyCycles) {
  const file::Picture empty = page();
  run_a_while();
  const file::Picture full = page();
  page(1.0F, draw::Look::kLight);
  constexpr int kMany = 2000;
  EXPECT_GT(count_changed(empty, full, rect("plot Wake-up latency")), kMany);
  EXPECT_GT(count_changed(empty, full, rect("plot Compute time")), kMany);
  EXPECT_EQ(state().timing.wake_latency.count, 120'061U);
  EXPECT_EQ(state().timing.wake_latency.maximum_ns, 1'900'000);
  expect_within(980.0F);
}

TEST_F(TimingPageTest, FitsAtTwiceTheSizeAndInALowWindow) {
  run_a_while();
  const ImVec2 half(static_cast<float>(kScreenWidth) / 2.0F,
                    static_cast<float>(kScreenHeight) / 2.0F);
  page(2.0F, draw::Look::kScreen, half);
  expect_within(kScreenWidth);
  const ImVec2 low(700.0F, 200.0F);
  page(1.0F, draw::Look::kLight, low);
  expect_within(low.x);
}

TEST_F(TimingPageTest, ABarTellsItsFigures) {
  run_a_while();
  const file::Picture still = page();
  const ItemRect area = rect("plot Wake-up latency");
  // The lower end of the plot: somewhere there is a bar.
  bool told = false;
  for (float x = area.from.x; x < area.to.x && !told; x += 8.0F) {
    ImGui::GetIO().AddMousePosEvent(x, area.to.y - 40.0F);
    told = count_changed(still, page(), rect("plot Wake-up latency")) > 100;
  }
  EXPECT_TRUE(told);
}

TEST_F(TimingPageTest, ClearCountsAnewAndForgetsTheWorst) {
  run_a_while();
  page();
  state().timing.clear_asked = true;
  page();
  ui::TimingState& timing = state().timing;
  EXPECT_FALSE(timing.since_start());
  EXPECT_EQ(timing.wake_latency.count, 0U);
  EXPECT_EQ(timing.shown.missed_ticks, 0U);
  EXPECT_EQ(timing.frames.size(), 0U);
  count(fake_->histograms.wake_latency, 20'000, 2000);
  fake_->timing.ticks += 2000;
  page();
  EXPECT_EQ(timing.wake_latency.count, 2000U);
  EXPECT_EQ(timing.shown.ticks, 2000U);
  EXPECT_NEAR(static_cast<double>(timing.wake_latency.maximum_ns), 20'000.0, 20'000.0 / 16.0);
  fake_->histograms = usual_timing(500);
  fake_->timing = {};
  page();
  EXPECT_TRUE(timing.since_start()) << "another session";
  EXPECT_EQ(timing.wake_latency.count, 500U);
}

TEST_F(TimingPageTest, EveryFigureSaysWhatItIs) {
  run_a_while();
  page();
  for (const char* name :
       {"The loop …", "timing clear", "median", "p99", "p99.9", "max", "wake-up", "compute",
        "ticks", "missed ticks", "plot drops", "driven by the test", "frame"}) {
    const ImVec2 place = rect(name).centre();
    ImGui::GetIO().AddMousePosEvent(2.0F, 2.0F);
    page();
    ImGui::GetIO().AddMousePosEvent(place.x, place.y);
    constexpr int kPatientFrames = 60;
    for (int i = 0; i < kPatientFrames; ++i) draw_page(ImVec2(980.0F, kPageHeight));
    const ImGuiWindow* tooltip = ImGui::FindWindowByName("##Tooltip_00");
    EXPECT_TRUE(tooltip != nullptr && tooltip->Active) << name;
  }
}

// The application reads the histograms once a frame. A new session starts with nothing cleared.
TEST_F(TimingPageTest, TheWindowKeepsThemUpToDate) {
  fake_->histograms = usual_timing(5000);
  frames(1);
  ui::TimingState& timing = state().timing;
  EXPECT_EQ(timing.compute_time.count, 5000U);
  timing.clear_asked = true;
  frames(1);
  EXPECT_FALSE(timing.since_start());
  type("rate", "2000");
  EXPECT_EQ(sessions, 2);
  EXPECT_TRUE(timing.since_start());
}

}  // namespace
}  // namespace hapticwall::test
