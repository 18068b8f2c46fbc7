#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/batch/workers.h"

namespace hapticwall::batch {
namespace {

TEST(Workers, AreAsManyAsAskedForOrAsTheProcessorRuns) {
  EXPECT_EQ(worker_count(3), 3U);
  EXPECT_GE(worker_count(0), 1U);
}

TEST(Workers, DoEveryItemOnce) {
  for (const std::size_t items : {0U, 1U, 2U, 1000U}) {
    std::vector<int> done(items);
    share_out(items, 4, [&](std::size_t item, std::size_t) { ++done[item]; });
    EXPECT_EQ(done, std::vector<int>(items, 1));
  }
}

TEST(Workers, DoOneItemAtATimeEach) {
  constexpr std::size_t kWorkers = 3;
  constexpr int kPatience = 1000;  // so often another call may come and be met
  std::vector<std::atomic<int>> at_work(kWorkers);
  std::atomic<int> inside = 0;
  std::atomic<bool> met = false;
  share_out(100, kWorkers, [&](std::size_t, std::size_t worker) {
    if (at_work.at(worker)++ != 0) met = true;
    ++inside;
    for (int i = 0; i < kPatience && inside < 2; ++i) std::this_thread::yield();
    --inside;
    --at_work.at(worker);
  });
  EXPECT_FALSE(met);
}

TEST(Workers, LetOutWhatACallThrowsAndBeginNoMore) {
  std::atomic<int> begun = 0;
  const auto work = [&](std::size_t, std::size_t) {
    ++begun;
    throw std::runtime_error("of an item");
  };
  EXPECT_THROW(share_out(1000, 2, work), std::runtime_error);
  EXPECT_LE(begun, 2);
}

}  // namespace
}  // namespace hapticwall::batch
