#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/run/workers.h"

namespace hapticwall {
namespace {

TEST(Workers, AreAsManyAsAskedForOrAsTheProcessorRuns) {
  EXPECT_EQ(worker_count(3), 3U);
  EXPECT_GE(worker_count(0), 1U);
}

// The mask belongs to the thread, so the other tests keep theirs.
TEST(Workers, AreNoMoreThanTheAffinityMaskAllows) {
  std::size_t workers = 0;
  std::jthread([&] {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<std::size_t>(sched_getcpu()), &one);
    ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
    workers = worker_count(0);
  }).join();
  EXPECT_EQ(workers, 1U);
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
  constexpr int kPatience = 1000;  // yields for another call to come in and be met
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

// Runs as a user of its own: root has no limit. `threads` includes the first thread of the process.
[[noreturn]] void work_with_few(rlim_t threads) {
  constexpr uid_t kUser = 54325;
  constexpr std::size_t kItems = 1000;
  const rlimit limit{threads, threads};
  std::vector<int> done(kItems);
  if (setrlimit(RLIMIT_NPROC, &limit) != 0 || setuid(kUser) != 0) _exit(2);
  alarm(60);  // ends a hang
  share_out(kItems, 8, [&](std::size_t item, std::size_t) { ++done[item]; });
  _exit(done == std::vector<int>(kItems, 1) ? 0 : 1);
}

TEST(Workers, DoAllWithoutTheThreadsOfTheSystem) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to be a user without other processes";
  for (const rlim_t threads : {1U, 2U, 3U, 5U}) {
    const pid_t child = fork();
    if (child == 0) work_with_few(threads);
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 0) << threads << " threads";
  }
}

}  // namespace
}  // namespace hapticwall
