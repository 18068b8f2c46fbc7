// A plug-in that is built again while a session runs with it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/file/plugin/plugin_file.h"
#include "app/file/plugin/plugin_watch.h"
#include "core/algorithm/plugin/include/hapticwall/plugin.h"
#include "core/algorithm/plugin/plugin_list.h"
#include "tests/app/session/session_support.h"
#include "tests/plugins/loaded/loaded_plugins.h"

namespace hapticwall::session {
namespace {

using file::PluginNews;
using file::PluginWatch;
using hapticwall::test::rebuild;
using hapticwall::test::rebuilt_path;
using hapticwall::test::rebuilt_plugin;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kStiffness = 1000.0;

// A file that a linker is still writing.
void write_in_place(const std::string& bytes) {
  std::ofstream(rebuilt_path(), std::ios::binary | std::ios::trunc) << bytes;
}

class RebuiltPlugin : public ::testing::Test {
 protected:
  RebuiltPlugin() {
    rebuild("full");
    EXPECT_TRUE(file::reload_plugin(rebuilt_plugin()).ok());
    EXPECT_THAT(news_after_a_second(), IsEmpty());
    revision_ = plugin_revision(rebuilt_plugin());
  }

  // Looks for news as often as the window does.
  std::vector<PluginNews> news_after_a_second() {
    std::vector<PluginNews> all;
    for (int frame = 0; frame < 60; ++frame) {
      for (PluginNews& news : watch_.look(now_s_ += 1.0 / 60.0)) all.push_back(std::move(news));
    }
    return all;
  }
  void expect_refused(const std::string& reason) {
    const std::vector<PluginNews> news = news_after_a_second();
    ASSERT_THAT(news, SizeIs(1));
    EXPECT_FALSE(news.front().loaded);
    EXPECT_THAT(news.front().text, HasSubstr(reason));
    EXPECT_THAT(news.front().text, HasSubstr("; the algorithm stays as it was"));
    EXPECT_EQ(plugin_revision(rebuilt_plugin()), revision_);
    EXPECT_THAT(news_after_a_second(), IsEmpty()) << "told once";
  }
  void expect_loaded() {
    const std::vector<PluginNews> news = news_after_a_second();
    ASSERT_THAT(news, SizeIs(1));
    EXPECT_TRUE(news.front().loaded) << news.front().text;
    EXPECT_EQ(news.front().algorithm, rebuilt_plugin());
    EXPECT_EQ(plugin_revision(rebuilt_plugin()), revision_ + 1);
  }

  PluginWatch watch_;
  double now_s_ = 100.0;
  std::uint32_t revision_ = 0;
};

TEST_F(RebuiltPlugin, IsLoadedOnceWithinASecond) {
  rebuild("half");
  expect_loaded();
  EXPECT_THAT(news_after_a_second(), IsEmpty());
  EXPECT_NE(file::plugin_file(rebuilt_plugin(), revision_)->sha256,
            file::plugin_file(rebuilt_plugin())->sha256);
  EXPECT_NE(plugin_at(rebuilt_plugin(), revision_), plugin_at(rebuilt_plugin()));
}

TEST_F(RebuiltPlugin, WithTheSameBytesIsNoNews) {
  rebuild("full");
  EXPECT_THAT(news_after_a_second(), IsEmpty());
  EXPECT_EQ(plugin_revision(rebuilt_plugin()), revision_);
}

TEST_F(RebuiltPlugin, ThatIsBeingWrittenWaitsUntilItIsWhole) {
  rebuild("half");
  const std::string whole = test::text_of(rebuilt_path());
  write_in_place(whole.substr(0, whole.size() / 2));
  expect_refused("no plug-in: the file is not whole");
  write_in_place(whole);
  expect_loaded();
}

// Every look finds another length.
TEST_F(RebuiltPlugin, ThatGrowsIsNotTouched) {
  rebuild("half");
  const std::string whole = test::text_of(rebuilt_path());
  for (std::size_t part = 1; part < 20; ++part) {
    write_in_place(whole.substr(0, part * whole.size() / 20));
    now_s_ += PluginWatch::kIntervalS;
    EXPECT_THAT(watch_.look(now_s_), IsEmpty());
  }
  write_in_place(whole);
  expect_loaded();
}

TEST_F(RebuiltPlugin, ThatIsGoneForAWhileIsNoNews) {
  std::filesystem::remove(rebuilt_path());
  EXPECT_THAT(news_after_a_second(), IsEmpty());
  rebuild("half");
  expect_loaded();
}

TEST_F(RebuiltPlugin, ThatIsAnotherOneIsRefusedInASentence) {
  write_in_place("a text\n");
  expect_refused("no plug-in: ");
  rebuild("missing");
  expect_refused("it exports no hapticwall_plugin");
  rebuild("abi");
  expect_refused("built for ABI 7");
  rebuild("sound");
  expect_refused("its name is not \"test-rebuilt\" any more");
  rebuild("keys");
  expect_refused("its parameters are not the same any more");
  rebuild("shown");
  expect_refused("its signals are not the same any more");
  rebuild("large");
  expect_refused("a state of 6001 bytes; this program has room for 6000");
}

TEST_F(RebuiltPlugin, WithAnotherParameterIsRefused) {
  const hw_plugin& older = *plugin_at(rebuilt_plugin());
  const auto problem_of = [&](const hw_parameter& parameter) {
    hw_plugin newer = older;
    newer.parameters = &parameter;
    return replacement_problem(newer, rebuilt_plugin());
  };
  hw_parameter parameter = older.parameters[0];
  EXPECT_EQ(problem_of(parameter), "");
  parameter.fallback = parameter.maximum + 1.0;
  EXPECT_NE(problem_of(parameter), "");
  parameter = older.parameters[0];
  parameter.minimum -= 1.0;
  EXPECT_NE(problem_of(parameter), "");
  parameter = older.parameters[0];
  parameter.unit = "N";
  EXPECT_NE(problem_of(parameter), "");
}

// The file is looked at a few times a second, not in each frame.
TEST_F(RebuiltPlugin, IsNotSeenBetweenTwoLooks) {
  rebuild("half");
  static_cast<void>(watch_.look(now_s_ += PluginWatch::kIntervalS));
  EXPECT_THAT(watch_.look(now_s_ += 0.5 * PluginWatch::kIntervalS), IsEmpty());
  EXPECT_THAT(watch_.look(now_s_ += PluginWatch::kIntervalS), SizeIs(1));
}

TEST_F(RebuiltPlugin, ThatThrowsIsNoted) {
  rebuild("half");
  expect_loaded();
  note_plugin_fault(*plugin_at(rebuilt_plugin()), LibraryFault::kThrew);
  EXPECT_EQ(plugin_fault(rebuilt_plugin()), LibraryFault::kThrew);
  EXPECT_EQ(plugin_fault(hapticwall::test::hooked_plugin()), LibraryFault::kNone);
}

// ---- in a session ----

Scene pressed_scene() {
  Scene scene = test::contact_scene();
  scene.x().device.encoder_m.reset();
  scene.x().walls = {{0.05, kStiffness, 0.0}};
  scene.algorithm.index = rebuilt_plugin();
  return scene;
}

class RebuiltInSession : public RebuiltPlugin {
 protected:
  void pass(std::uint32_t ticks) {
    ticks_ += ticks;
    session_->step(ticks);
    ASSERT_TRUE(test::ticks_reach(*session_, ticks_));
    for (const Sample& sample : test::all_samples(*session_)) samples_.push_back(sample);
  }
  // A second of the loop, in which the window asks for news.
  void pass_a_second() {
    for (int frame = 0; frame < 50; ++frame) {
      for (const PluginNews& news : watch_.look(now_s_ += 0.02)) {
        if (news.loaded) EXPECT_FALSE(session_->change_scene(Scene(session_->scene())));
      }
      pass(20);
    }
  }

  std::unique_ptr<LiveSession> session_ = test::started_paused(pressed_scene());
  std::uint64_t ticks_ = 0;
  std::vector<Sample> samples_;
};

TEST_F(RebuiltInSession, BlendsIntoTheNewAlgorithmWithinASecondOfContact) {
  pass(500);
  rebuild("half");
  pass_a_second();
  const auto changed = std::ranges::find_if(samples_, [](const Sample& sample) {
    return sample.tick > 0 && (sample.flags & kFlagParametersChanged) != 0;
  });
  ASSERT_NE(changed, samples_.end());
  const double before_n = (changed - 1)->force_n;
  ASSERT_GT(before_n, 2.0) << "in contact";
  EXPECT_EQ(before_n, (changed - 1)->wall_force_n);
  constexpr double kBlendTicks = 50.0;
  for (auto sample = changed; sample != samples_.end(); ++sample) {
    const double own_n = kStiffness * std::abs(sample->position_m - (sample - 1)->position_m);
    ASSERT_LE(std::abs(sample->force_n - (sample - 1)->force_n), own_n + before_n / kBlendTicks)
        << sample->tick;
  }
  EXPECT_EQ(samples_.back().force_n, 0.5 * samples_.back().wall_force_n);
}

TEST_F(RebuiltInSession, TheRecordingTellsWhichFileWasInForceFromWhichTick) {
  const test::TemporaryFolder folder;
  ASSERT_FALSE(session_->start_recording(folder.file("a.csv")));
  pass(500);
  rebuild("half");
  pass_a_second();
  ASSERT_FALSE(session_->stop_recording());
  const std::string sidecar = test::text_of(folder.file("a.toml"));
  const auto sha256 = [](std::uint32_t revision) {
    return "plugin_sha256 = \"" + file::plugin_file(rebuilt_plugin(), revision)->sha256 + '"';
  };
  const std::size_t change = sidecar.find("[[recording.change]]");
  ASSERT_NE(change, std::string::npos);
  EXPECT_LT(sidecar.find(sha256(revision_)), change);
  EXPECT_GT(sidecar.find(sha256(revision_ + 1)), change);
  EXPECT_NE(sidecar.find(sha256(revision_ + 1)), std::string::npos);
  const auto loaded = file::load_scene(folder.file("a.toml"));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(loaded->changed_plugin, rebuilt_path()) << "a re-run starts with another file";
  ASSERT_THAT(loaded->changes, SizeIs(1));
  EXPECT_GE(loaded->changes.front().tick, 500U);
}

// The scene at the start names no plug-in.
TEST_F(RebuiltInSession, ARecordingThatChangedToAnOlderFileIsNotRepeatable) {
  Scene scene = pressed_scene();
  scene.algorithm.index = 0;
  session_ = test::started_paused(scene);
  const test::TemporaryFolder folder;
  ASSERT_FALSE(session_->start_recording(folder.file("a.csv")));
  pass(100);
  ASSERT_FALSE(session_->change_scene(pressed_scene()));
  pass(100);
  ASSERT_FALSE(session_->stop_recording());
  EXPECT_EQ(file::load_scene(folder.file("a.toml"))->changed_plugin, "");
  rebuild("half");
  expect_loaded();
  EXPECT_EQ(file::load_scene(folder.file("a.toml"))->changed_plugin, rebuilt_path());
}

// The first build goes on where it is in force.
TEST_F(RebuiltInSession, ARefusedOneChangesNothing) {
  pass(500);
  rebuild("keys");
  pass_a_second();
  EXPECT_TRUE(std::ranges::none_of(samples_, [](const Sample& sample) {
    return sample.tick > 0 && (sample.flags & kFlagParametersChanged) != 0;
  }));
  EXPECT_EQ(samples_.back().force_n, samples_.back().wall_force_n);
}

}  // namespace
}  // namespace hapticwall::session
