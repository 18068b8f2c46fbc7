// The loop without a thread of its own.
#include <cmath>

#include "app/session/loop/cycle_scheduler.h"
#include "app/session/loop/loop_driver.h"

namespace hapticwall::session {
namespace {

class TurnedLoop final : public LoopDriver {
 public:
  TurnedLoop(ServoLoop& loop, Exchange& exchange, double rate_hz, Clock& clock)
      : loop_(loop),
        exchange_(exchange),
        clock_(clock),
        rate_hz_(rate_hz),
        scheduler_(rate_hz, clock.now_ns()) {
    status_.text = "no thread of its own: the window runs the ticks that are due";
  }
  ~TurnedLoop() override { end(false); }

  [[nodiscard]] const RealtimeStatus& status() const override { return status_; }

  void turn() override {
    const std::int64_t now_ns = clock_.now_ns();
    leave_gap_out(now_ns);
    while (!ended() && scheduler_.deadline_ns() <= now_ns) cycle();
  }

  void wait() override {
    clock_.sleep_until_ns(scheduler_.deadline_ns());
    turn();
  }

 private:
  void leave_gap_out(std::int64_t now_ns) {
    const std::int64_t excess_ns = now_ns - scheduler_.deadline_ns() - kMaxTurnNs;
    if (excess_ns <= 0) return;
    const double periods =
        std::ceil(static_cast<double>(excess_ns) * rate_hz_ / kNanosecondsPerSecond);
    scheduler_.skip(static_cast<std::uint64_t>(periods));
  }

  void cycle() {
    Wake wake = scheduler_.wake(scheduler_.deadline_ns());
    wake.now_ns = clock_.now_ns();
    try {
      loop_.cycle(wake, clock_);
    } catch (...) {
      return end(true);
    }
    scheduler_.skip(loop_.rest_periods());
  }

  [[nodiscard]] bool ended() const { return exchange_.finished.load(std::memory_order_relaxed); }
  void end(bool by_itself) {
    if (!ended()) loop_.shut_down(by_itself);
  }

  ServoLoop& loop_;
  Exchange& exchange_;
  Clock& clock_;
  double rate_hz_;
  CycleScheduler scheduler_;
  RealtimeStatus status_;
};

}  // namespace

std::unique_ptr<LoopDriver> turned_by_owner(ServoLoop& loop, Exchange& exchange, double rate_hz,
                                            Clock& clock) {
  return std::make_unique<TurnedLoop>(loop, exchange, rate_hz, clock);
}

}  // namespace hapticwall::session
