#include "app/session/loop/timing_probe.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "app/session/loop/cycle_scheduler.h"
#include "app/session/loop/realtime_setup.h"
#include "app/session/loop/spinning_clock.h"

namespace hapticwall::session {
namespace {

constexpr std::chrono::milliseconds kLookInterval{20};

std::int64_t nanoseconds(double seconds) { return std::llround(seconds * kNanosecondsPerSecond); }

void reserve(TimingRecord& record, std::uint64_t ticks, bool has_device) {
  record.latency_ns.reserve(ticks);
  record.compute_ns.reserve(ticks);
  if (!has_device) return;
  record.age_ns.reserve(ticks);
  record.round_trip_ns.reserve(ticks);
  record.write_ns.reserve(ticks);
}

// Records each new measurement of the link once: at most one a tick, as reserved.
class LinkWatch {
 public:
  explicit LinkWatch(TimingRecord& record) : record_(record) {}

  void look(const device::LinkStats& link) {
    if (link.connected) record_.age_ns.push_back(nanoseconds(link.age_s));
    const bool new_state = link.states != states_;
    states_ = link.states;
    if (new_state && link.round_trip_s > 0.0) {
      record_.round_trip_ns.push_back(nanoseconds(link.round_trip_s));
    }
    if (new_state && link.write_time_s > 0.0) {
      record_.write_ns.push_back(nanoseconds(link.write_time_s));
    }
    record_.link = link;
  }

 private:
  TimingRecord& record_;
  std::uint64_t states_ = 0;
};

struct Shared {
  std::atomic<std::uint64_t> done{0};
  std::atomic<bool> stop{false};
  std::atomic<bool> finished{false};
};

// Processor time of the calling thread, seconds.
double processor_s() {
  return static_cast<double>(thread_processor_time_ns()) / kNanosecondsPerSecond;
}

void run(const TimingPlan& plan, device::Device* device, Clock& sleeping, TimingRecord& record,
         Shared& shared) {
  record.status = describe(set_up_realtime_thread(plan.affinity_core));
  SpinningClock clock(sleeping, spin_ns(plan.spin_s, plan.rate_hz));
  const std::int64_t start_ns = clock.now_ns();
  const double processor_before_s = processor_s();
  CycleScheduler scheduler(plan.rate_hz, clock.now_ns());
  LinkWatch watch(record);
  for (std::uint64_t tick = 0; tick < plan.ticks && !shared.stop.load(std::memory_order_relaxed);
       ++tick) {
    clock.sleep_until_ns(scheduler.deadline_ns());
    const Wake wake = scheduler.wake(clock.now_ns());
    if (device != nullptr) {
      static_cast<void>(device->read());
      device->write(0.0);
      watch.look(device->link());
    }
    record.latency_ns.push_back(wake.latency_ns);
    record.compute_ns.push_back(clock.now_ns() - wake.now_ns);
    record.missed_ticks += wake.missed;
    shared.done.store(tick + 1, std::memory_order_relaxed);
  }
  const double passed_s = static_cast<double>(clock.now_ns() - start_ns) / kNanosecondsPerSecond;
  if (passed_s > 0.0) record.processor_share = (processor_s() - processor_before_s) / passed_s;
  shared.finished.store(true, std::memory_order_release);
}

}  // namespace

TimingRecord probe_timing(const TimingPlan& plan, device::Device* device, Clock& clock,
                          const std::function<bool(std::uint64_t done)>& should_stop) {
  TimingRecord record;
  reserve(record, plan.ticks, device != nullptr);
  Shared shared;
  std::thread loop([&] { run(plan, device, clock, record, shared); });
  while (!shared.finished.load(std::memory_order_acquire)) {
    if (should_stop(shared.done.load(std::memory_order_relaxed))) shared.stop = true;
    std::this_thread::sleep_for(kLookInterval);
  }
  loop.join();
  return record;
}

}  // namespace hapticwall::session
