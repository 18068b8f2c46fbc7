// The loop on its own thread.
#include <chrono>
#include <future>
#include <thread>
#include <utility>

#include "app/session/loop/crash_stop.h"
#include "app/session/loop/loop_driver.h"
#include "core/tick/pulse.h"

namespace hapticwall::session {
namespace {

// Polling interval of the owner while it waits for the loop.
constexpr std::chrono::microseconds kAnswerPollInterval{200};

class LoopThread final : public LoopDriver {
 public:
  LoopThread(ServoLoop& loop, Exchange& exchange, double rate_hz, Clock& clock, int affinity_core)
      : exchange_(exchange) {
    std::promise<RealtimeOutcome> set_up;
    std::future<RealtimeOutcome> outcome = set_up.get_future();
    thread_ = std::thread(
        [&loop, &exchange, rate_hz, &clock, affinity_core, ready = std::move(set_up)]() mutable {
          ready.set_value(set_up_realtime_thread(affinity_core));
          run_servo_loop(loop, exchange, rate_hz, clock);
        });
    status_ = describe(outcome.get());
  }
  ~LoopThread() override {
    exchange_.stop.store(true, std::memory_order_relaxed);
    thread_.join();
  }

  [[nodiscard]] const RealtimeStatus& status() const override { return status_; }
  void turn() override {}
  void wait() override { std::this_thread::sleep_for(kAnswerPollInterval); }

 private:
  Exchange& exchange_;
  RealtimeStatus status_;
  std::thread thread_;
};

}  // namespace

std::unique_ptr<LoopDriver> start_loop_thread(ServoLoop& loop, Exchange& exchange, double rate_hz,
                                              Clock& clock, int affinity_core) {
  return std::make_unique<LoopThread>(loop, exchange, rate_hz, clock, affinity_core);
}

void run_servo_loop(ServoLoop& loop, Exchange& exchange, double rate_hz, Clock& clock) noexcept {
  const LoopWithForce until_shut_down(
      [](void* ended) noexcept { static_cast<ServoLoop*>(ended)->remove_force(); }, &loop);
  Pulse pulse;
  pulse.begin();
  bool by_itself = false;
  try {
    CycleScheduler scheduler(rate_hz, clock.now_ns());
    while (!exchange.stop.load(std::memory_order_relaxed) && !must_end_force()) {
      pulse.beat();
      clock.sleep_until_ns(scheduler.deadline_ns());
      loop.cycle(scheduler.wake(clock.now_ns()), clock);
      scheduler.skip(loop.rest_periods());
    }
    by_itself = must_end_force();
  } catch (...) {
    by_itself = true;
  }
  pulse.rest();  // closing a device has its own time limit
  loop.shut_down(by_itself);
}

}  // namespace hapticwall::session
