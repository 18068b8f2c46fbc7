// A host in virtual time: owner, reader, writers and loop, one step at a time in the order of their
// threads. Deterministic.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "device/link/link_loop.h"
#include "device/link/link_owner.h"
#include "device/link/link_reader.h"
#include "device/link/link_writer.h"
#include "device/port/dialect_port.h"
#include "tests/device/link/link_fake_bus.h"

namespace hapticwall::device::testing {

// A person's side of the loop, which commands a force in every tick.
struct LoopBehaviour {
  AxisValues force_n{2.0, 0.0};
  // Disables after a fault, as the loop of a session does; otherwise keeps asking.
  bool disarms = true;
};

class VirtualHost {
 public:
  // Times within a millisecond: the device's tick, the loop, its write, the owner.
  static constexpr std::uint64_t kTickUs = 1000;
  static constexpr std::uint64_t kLoopUs = 300;
  static constexpr std::uint64_t kWriteUs = 350;
  static constexpr std::uint64_t kOwnerUs = 600;
  // hidraw's time-out for a device that takes no output.
  static constexpr std::uint64_t kMaxWriteUs = 5'000'000;

  VirtualHost(hid::testing::FakeBus& its_bus, const ImpulseEngineOptions& options)
      : bus(its_bus),
        port(std::make_shared<hid::testing::FakePort>(its_bus)),
        reader(exchange, clock),
        owner(exchange, reader, options,
              hid::translated(
                  options,
                  [this]() -> Result<std::shared_ptr<hid::Port>> {
                    return other_port ? other_port : std::shared_ptr<hid::Port>(port);
                  },
                  clock),
              clock,
              [this](const std::shared_ptr<WriteSession>& session) { return start(session); }),
        loop(exchange, clock) {}

  // One millisecond of everything, or of the devices alone.
  void tick() {
    now_us_ += kTickUs;
    bus.move_to(now_us_);
    if (!stalled) {
      if (!reader_stalled) reader.step(0);
      at(kLoopUs);
      if (!loop_stalled) run_loop();
      at(kWriteUs);
      run_writers();
      at(kOwnerUs);
      if (now_ns() >= next_owner_ns_) next_owner_ns_ = owner.step();
    }
    offset_us_ = 0;
    if (after_tick) after_tick();
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }
  // Ticks until a condition holds, with a limit; returns whether it holds.
  bool ticks_until(const std::function<bool()>& condition, int at_most) {
    for (int i = 0; i < at_most && !condition(); ++i) tick();
    return condition();
  }
  bool come_up() {
    return ticks_until([this] { return last.state == DeviceState::kOk; }, 1500);
  }

  void arm() { armed = true; }
  // Disarms, and arms again after the loop has seen it, as a person does.
  void rearm() {
    armed = false;
    ticks(2);
    armed = true;
  }

  [[nodiscard]] std::int64_t now_ns() const {
    return static_cast<std::int64_t>(now_us_ + offset_us_) * 1000;
  }
  [[nodiscard]] std::uint64_t now_us() const { return now_us_; }
  [[nodiscard]] const LinkStats& stats() const { return loop.stats(); }

 private:
  // First, because the others use the time.
  std::uint64_t now_us_ = 0;
  std::uint64_t offset_us_ = 0;

 public:
  hid::testing::FakeBus& bus;
  std::shared_ptr<hid::testing::FakePort> port;
  std::shared_ptr<hid::Port> other_port;  // replaces `port`
  HostClock clock = [this] { return now_ns(); };
  LinkExchange exchange;
  LinkReader reader;
  LinkOwner owner;
  LinkLoop loop;

  LoopBehaviour behaviour;
  bool armed = false;  // requested by the loop
  bool stalled = false;
  bool loop_stalled = false;
  bool reader_stalled = false;
  // Values of the loop's last turn.
  AxesReading last;
  bool asked = false;
  AxisValues commanded_n{};
  std::set<Trouble> troubles;  // that the loop has seen
  // Command of the loop from its reading; without a law it is behaviour.force_n.
  std::function<AxisValues(const AxesReading&)> law;
  std::function<void(const hid::ReportBytes&)> on_report;  // called when a report leaves the host
  std::function<void()> after_tick;
  std::function<void()> whole_loop;  // replaces this simple loop

 private:
  struct Writing {
    std::shared_ptr<WriteSession> session;
    std::optional<hid::ReportBytes> bytes;  // bytes of a write in progress
    std::uint64_t since_us = 0;
  };

  void at(std::uint64_t offset_us) {
    offset_us_ = offset_us;
    bus.move_to(now_us_ + offset_us);
  }

  void run_loop() {
    if (whole_loop) return whole_loop();
    loop.enable(armed);
    last = loop.read();
    if (stats().trouble != Trouble::kNone) troubles.insert(stats().trouble);
    const bool fault = last.state != DeviceState::kOk;
    if (fault && behaviour.disarms) {
      armed = false;
      loop.enable(false);
    }
    asked = armed;
    commanded_n = law ? law(last) : behaviour.force_n;
    loop.write(commanded_n);
  }

  std::function<void()> start(const std::shared_ptr<WriteSession>& session) {
    writers_.push_back({session, std::nullopt, 0});
    return [] {};
  }

  void run_writers() {
    for (Writing& writing : writers_) run(writing);
    std::erase_if(writers_, [](const Writing& writing) { return writing.session->over(); });
  }
  void run(Writing& writing) {
    if (!writing.bytes) {
      writing.bytes = writing.session->begin(now_ns());
      writing.since_us = now_us_;
      if (!writing.bytes) return;
      if (on_report) on_report(*writing.bytes);
    }
    hid::Handle& handle = writing.session->handle();
    const auto* fake = dynamic_cast<hid::testing::FakeHandle*>(&handle);
    const bool returns =
        fake != nullptr ? fake->write_returns() : bus.plugs().front()->accepts_output();
    if (!returns && now_us_ - writing.since_us < kMaxWriteUs) return;
    handle.write(*writing.bytes);
    writing.bytes.reset();
    writing.session->finish(now_ns());
  }

  std::int64_t next_owner_ns_ = 0;
  std::vector<Writing> writers_;
};

}  // namespace hapticwall::device::testing
