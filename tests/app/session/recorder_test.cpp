#include "app/session/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>

#include "app/session/loop/realtime_setup.h"
#include "tests/app/session/loop/fake_writer.h"
#include "tests/app/session/support.h"

namespace hapticwall::session {
namespace {

using test::eventually;
using test::FakeWriter;
using test::WriterLog;
using ::testing::HasSubstr;

class RecorderTest : public ::testing::Test {
 protected:
  void start() { recorder_.start(std::make_unique<FakeWriter>(log_)); }
  void push(std::uint64_t first, std::uint64_t end) {
    for (std::uint64_t number = first; number < end; ++number) {
      Tick tick;
      tick.axes.front().tick = number;
      ASSERT_TRUE(queue_.try_push(tick));
    }
  }
  Failure finish() {
    recorder_.drain_and_join();
    return recorder_.finish(Scene{}, {});
  }

  SpscQueue<Tick> queue_{1000};
  Recorder recorder_{queue_};
  std::shared_ptr<WriterLog> log_ = std::make_shared<WriterLog>();
};

TEST_F(RecorderTest, EverythingPushedIsWrittenInOrderAndFinishedOnce) {
  start();
  push(40, 140);
  ASSERT_TRUE(eventually([&] { return recorder_.rows() == 100; })) << "drained while it runs";
  push(140, 900);
  EXPECT_FALSE(finish());
  ASSERT_EQ(log_->ticks.size(), 860U);
  for (std::size_t i = 0; i < log_->ticks.size(); ++i) ASSERT_EQ(log_->ticks[i], 40 + i);
  ASSERT_EQ(log_->finished.size(), 1U);
  EXPECT_EQ(log_->finished[0].first_tick, 40U);
  EXPECT_EQ(recorder_.end_tick(), 900U);
  EXPECT_FALSE(recorder_.running());
}

TEST_F(RecorderTest, RowsReachTheOperatingSystemWhileItRuns) {
  start();
  EXPECT_TRUE(eventually([&] { return log_->flushes >= 2; }));
  EXPECT_LE(Recorder::kDrainInterval + Recorder::kFlushInterval, std::chrono::milliseconds(500));
  EXPECT_FALSE(finish());
}

// A power cut costs a second: rows are on the disk sooner, and no disk is asked more often.
TEST_F(RecorderTest, RowsReachTheDiskEverySecond) {
  std::atomic<std::int64_t> now_ms = 0;
  Recorder recorder(queue_, [&] {
    return std::chrono::steady_clock::time_point(std::chrono::milliseconds(now_ms.load()));
  });
  EXPECT_LT(Recorder::kDrainInterval + Recorder::kSyncInterval, std::chrono::seconds(1));
  recorder.start(std::make_unique<FakeWriter>(log_));
  for (int syncs = 1; syncs <= 3; ++syncs) {
    now_ms += Recorder::kSyncInterval.count() - 1;
    const int flushes = log_->flushes;
    ASSERT_TRUE(eventually([&] { return log_->flushes > flushes; }));
    EXPECT_EQ(log_->syncs, syncs - 1);
    now_ms += 1;
    ASSERT_TRUE(eventually([&] { return log_->syncs == syncs; }));
  }
  recorder.drain_and_join();
  EXPECT_FALSE(recorder.finish(Scene{}, {}));
}

struct Scheduling {
  int policy = -1;
  int priority = -1;
  friend bool operator==(const Scheduling&, const Scheduling&) = default;
};

Scheduling of_this_thread() {
  Scheduling found;
  sched_param parameters{};
  EXPECT_EQ(pthread_getschedparam(pthread_self(), &found.policy, &parameters), 0);
  found.priority = parameters.sched_priority;
  return found;
}

class WatchingWriter : public FakeWriter {
 public:
  WatchingWriter(std::shared_ptr<WriterLog> log, Scheduling& seen)
      : FakeWriter(std::move(log)), seen_(seen) {}
  Failure append(const Tick& tick) override {
    seen_ = of_this_thread();
    return FakeWriter::append(tick);
  }

 private:
  Scheduling& seen_;
};

// If real-time priority is refused, the recorder cannot have it either.
TEST_F(RecorderTest, ItsThreadComesBeforeOrdinaryOnesAndAfterTheLoop) {
  Scheduling permitted;
  bool loop_comes_first = false;
  std::thread([&] {
    set_up_recorder_thread();
    permitted = of_this_thread();
    loop_comes_first = permitted.priority < set_up_realtime_thread(-1).priority;
  }).join();
  Scheduling seen;
  recorder_.start(std::make_unique<WatchingWriter>(log_, seen));
  push(0, 1);
  ASSERT_TRUE(eventually([&] { return recorder_.rows() == 1; }));
  EXPECT_FALSE(finish());
  EXPECT_EQ(seen, permitted);
  EXPECT_TRUE(loop_comes_first);
}

TEST_F(RecorderTest, AFullDiskIsKeptAndTheQueueIsDrainedAllTheSame) {
  log_->fail_at_row = 11;
  start();
  push(0, 1000);
  ASSERT_TRUE(eventually([&] { return queue_.size() == 0; }));
  ASSERT_TRUE(eventually([&] { return recorder_.failure().has_value(); }));
  EXPECT_EQ(recorder_.failure()->message, "disk full");
  const Failure failure = finish();
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, ErrorKind::kFile);
  EXPECT_EQ(recorder_.rows(), 10U);
  EXPECT_TRUE(log_->finished.empty()) << "what is not whole gets no name";
}

TEST_F(RecorderTest, AFailingFlushIsSeenWithoutAnyRow) {
  log_->fail_at_flush = true;
  start();
  EXPECT_TRUE(eventually([&] { return recorder_.failure().has_value(); }));
  EXPECT_TRUE(finish());
}

TEST_F(RecorderTest, AWriterThatThrowsEndsTheRecordingAndNotTheProgram) {
  log_->throw_at_row = 5;
  start();
  push(0, 20);
  const Failure failure = finish();
  ASSERT_TRUE(failure);
  EXPECT_THAT(failure->message, HasSubstr("no memory"));
}

TEST_F(RecorderTest, TheNextRecordingStartsAfresh) {
  log_->fail_at_row = 3;
  start();
  push(0, 10);
  ASSERT_TRUE(finish());
  push(10, 12);  // left over: nobody was recording
  log_ = std::make_shared<WriterLog>();
  start();
  EXPECT_FALSE(recorder_.failure());
  push(50, 53);
  EXPECT_FALSE(finish());
  EXPECT_EQ(log_->ticks, (std::vector<std::uint64_t>{50, 51, 52}));
  EXPECT_EQ(log_->finished.at(0).first_tick, 50U);
}

TEST_F(RecorderTest, DestroyedInTheMiddleItEndsItsThread) {
  auto recorder = std::make_unique<Recorder>(queue_);
  recorder->start(std::make_unique<FakeWriter>(log_));
  push(0, 10);
  recorder.reset();
  EXPECT_EQ(log_->ticks.size(), 10U);
  EXPECT_TRUE(log_->finished.empty());
}

TEST_F(RecorderTest, WithoutARowThereIsStillAWholeFile) {
  start();
  EXPECT_FALSE(finish());
  EXPECT_EQ(log_->finished.size(), 1U);
  EXPECT_EQ(recorder_.rows(), 0U);
}

}  // namespace
}  // namespace hapticwall::session
