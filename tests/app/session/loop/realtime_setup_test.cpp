#include "app/session/loop/realtime_setup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>

#include <cerrno>
#include <cfenv>
#include <limits>
#include <thread>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace hapticwall::session {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(RealtimeStatus, SaysWhatWasReachedAndAdvisesNothing) {
  RealtimeOutcome outcome;
  outcome.priority = kLoopPriority;
  outcome.affinity_core = 1;
  const RealtimeStatus status = describe(outcome);
  EXPECT_TRUE(status.fifo_priority);
  EXPECT_TRUE(status.memory_locked);
  EXPECT_TRUE(status.affinity_set);
  EXPECT_EQ(status.text, "real-time priority 80, memory locked, core 1");
  EXPECT_EQ(status.advice, "");
}

TEST(RealtimeStatus, SaysWhatIsMissingAndWhatToDoButNeverToRunAsRoot) {
  RealtimeOutcome outcome;
  outcome.priority = kLoopPriority;
  outcome.priority_error = EPERM;
  outcome.lock_error = EPERM;
  const RealtimeStatus status = describe(outcome);
  EXPECT_FALSE(status.fifo_priority);
  EXPECT_FALSE(status.memory_locked);
  EXPECT_FALSE(status.affinity_set);
  EXPECT_THAT(status.text, HasSubstr("no real-time priority (Operation not permitted)"));
  EXPECT_THAT(status.text, HasSubstr("memory not locked"));
  EXPECT_THAT(status.advice, HasSubstr("'rtprio 80' and 'memlock unlimited'"));
  EXPECT_THAT(status.advice, HasSubstr("/etc/security/limits.conf"));
  EXPECT_THAT(status.advice, Not(HasSubstr("root")));
}

TEST(RealtimeStatus, ACoreThatIsNotThereIsNamed) {
  RealtimeOutcome outcome;
  outcome.priority = kLoopPriority;
  outcome.affinity_core = 4711;
  outcome.affinity_error = EINVAL;
  const RealtimeStatus status = describe(outcome);
  EXPECT_FALSE(status.affinity_set);
  EXPECT_THAT(status.text, HasSubstr("not on core 4711 (Invalid argument)"));
  EXPECT_THAT(status.advice, HasSubstr("choose a core"));
  EXPECT_THAT(status.advice, Not(HasSubstr("limits.conf")));
}

// The outcome agrees with the kernel, with and without privileges.
TEST(RealtimeSetup, OutcomeIsTheTruthAboutTheThread) {
  std::thread([] {
    const RealtimeOutcome outcome = set_up_realtime_thread(-1);
    int policy = -1;
    sched_param parameters{};
    ASSERT_EQ(pthread_getschedparam(pthread_self(), &policy, &parameters), 0);
    EXPECT_EQ(policy == SCHED_FIFO, outcome.priority_error == 0);
    if (outcome.priority_error == 0) {
      EXPECT_EQ(parameters.sched_priority, outcome.priority);
      EXPECT_LE(outcome.priority, kLoopPriority);
    }
    EXPECT_FALSE(describe(outcome).text.empty());
  }).join();
}

TEST(RealtimeSetup, AffinityIsSetOrRefused) {
  std::thread([] {
    const int core = sched_getcpu();
    ASSERT_EQ(set_up_realtime_thread(core).affinity_error, 0);
    cpu_set_t cores;
    ASSERT_EQ(pthread_getaffinity_np(pthread_self(), sizeof cores, &cores), 0);
    EXPECT_EQ(CPU_COUNT(&cores), 1);
    EXPECT_TRUE(CPU_ISSET(static_cast<std::size_t>(core), &cores));
    EXPECT_NE(set_up_realtime_thread(CPU_SETSIZE - 1).affinity_error, 0);
    EXPECT_NE(set_up_realtime_thread(1'000'000).affinity_error, 0);
  }).join();
}

TEST(RealtimeSetup, BoundsTheProcessorTimeOfAThreadThatNeverSleeps) {
  std::thread([] { set_up_realtime_thread(-1); }).join();
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_RTTIME, &limit), 0);
  EXPECT_LE(limit.rlim_cur, kMaxAwakeUs) << "SIGXCPU, which ends the force first";
  EXPECT_LE(limit.rlim_max, kMaxAwakeKilledUs);
  EXPECT_LT(limit.rlim_cur, limit.rlim_max);
}

TEST(RealtimeSetup, SignalsStayWithTheMainThread) {
  std::thread([] {
    set_up_realtime_thread(-1);
    sigset_t blocked;
    ASSERT_EQ(pthread_sigmask(SIG_BLOCK, nullptr, &blocked), 0);
    EXPECT_EQ(sigismember(&blocked, SIGINT), 1);
    EXPECT_EQ(sigismember(&blocked, SIGTERM), 1);
  }).join();
}

#if defined(__SSE2__)
TEST(RealtimeSetup, DenormalsAreKeptWhateverALibraryDidBefore) {
  std::thread([] {
    constexpr unsigned kFlushToZeroAndDenormalsAreZero = 0x8040;
    _mm_setcsr(_mm_getcsr() | kFlushToZeroAndDenormalsAreZero);
    std::fesetround(FE_UPWARD);
    volatile double smallest = std::numeric_limits<double>::min();
    ASSERT_EQ(smallest / 2, 0.0);
    use_default_floating_point();
    EXPECT_GT(smallest / 2, 0.0);
    EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  }).join();
}
#endif

TEST(MonotonicClock, SleepsUntilTheDeadlineAndNotBeyondThePast) {
  MonotonicClock clock;
  const std::int64_t before_ns = clock.now_ns();
  clock.sleep_until_ns(before_ns + 2'000'000);
  EXPECT_GE(clock.now_ns(), before_ns + 2'000'000);
  clock.sleep_until_ns(before_ns);  // returns
  clock.sleep_until_ns(0);
}

}  // namespace
}  // namespace hapticwall::session
