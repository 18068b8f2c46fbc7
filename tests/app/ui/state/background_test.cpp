// Background work: result, progress, and cancellation without waiting.
#include "app/ui/computed/background.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <new>
#include <string>
#include <thread>

#include "tests/app/session/support.h"

namespace hapticwall::ui {
namespace {

using session::test::eventually;

using Work = Background<std::string>;

TEST(Background, TellsItsOutcomeOnce) {
  Work work;
  EXPECT_FALSE(work.running());
  EXPECT_FALSE(work.take());
  work.start([](const Work::Progress& progress) {
    EXPECT_TRUE(progress(0.25));
    return Result<std::string>("done");
  });
  std::optional<Result<std::string>> outcome;
  ASSERT_TRUE(eventually([&] { return (outcome = work.take()).has_value(); }));
  ASSERT_TRUE(*outcome);
  EXPECT_EQ(**outcome, "done");
  EXPECT_EQ(work.fraction(), 0.25);
  EXPECT_FALSE(work.running());
  EXPECT_FALSE(work.take());
}

TEST(Background, AnExceptionBecomesAnError) {
  Work work;
  work.start([](const Work::Progress&) -> Result<std::string> { throw std::bad_alloc(); });
  std::optional<Result<std::string>> outcome;
  ASSERT_TRUE(eventually([&] { return (outcome = work.take()).has_value(); }));
  EXPECT_FALSE(*outcome);
}

TEST(Background, CancelledWorkEndsWithoutAnOutcome) {
  Work work;
  std::atomic<bool> ended{false};
  work.start([&](const Work::Progress& progress) {
    while (progress(0.5)) {
    }
    ended = true;
    return Result<std::string>("too late");
  });
  EXPECT_TRUE(work.running());
  work.give_up();
  EXPECT_FALSE(work.running());
  EXPECT_TRUE(eventually([&] { return ended.load(); }));
  EXPECT_FALSE(work.take());
}

TEST(Background, ANewPieceTakesThePlaceOfTheOldOne) {
  Work work;
  work.start([](const Work::Progress& progress) {
    while (progress(0.9)) {
    }
    return Result<std::string>("old");
  });
  work.start([](const Work::Progress&) { return Result<std::string>("new"); });
  std::optional<Result<std::string>> outcome;
  ASSERT_TRUE(eventually([&] { return (outcome = work.take()).has_value(); }));
  EXPECT_EQ(**outcome, "new");
}

// A browser has no thread for a task.
TEST(Background, WithoutAThreadTheOwnerDoesItAndMayCancelItBefore) {
  std::thread::id there;
  const auto work_here = [&](const Work::Progress& progress) {
    there = std::this_thread::get_id();
    EXPECT_TRUE(progress(0.5));
    return Result<std::string>("done");
  };
  Work work;
  work.start(work_here, std::launch::deferred);
  EXPECT_TRUE(work.running());
  work.give_up();
  EXPECT_FALSE(work.take());
  EXPECT_EQ(there, std::thread::id());
  work.start(work_here, std::launch::deferred);
  const auto outcome = work.take();
  ASSERT_TRUE(outcome);
  EXPECT_EQ(**outcome, "done");
  EXPECT_EQ(there, std::this_thread::get_id());
  EXPECT_FALSE(work.running());
}

// The owner may be destroyed at any time: it cancels the thread and waits for it.
TEST(Background, EndsWithItsOwner) {
  std::atomic<bool> ended{false};
  {
    Work work;
    work.start([&](const Work::Progress& progress) {
      while (progress(0.0)) {
      }
      ended = true;
      return Result<std::string>("nobody");
    });
  }
  EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace hapticwall::ui
