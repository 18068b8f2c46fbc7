// The real threads of a link on a library: what device_plugin.h promises of threads. Clean under
// ThreadSanitizer. Tests wait for conditions, never for times.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include "device/port/impulse_engine.h"
#include "device/port/plugin_port.h"
#include "tests/device/link/link_real_bus.h"
#include "tests/temporary_folder.h"

namespace hapticwall::device {
namespace {

// A library that watches who is in it.
struct Watched {
  std::atomic<int> readers{0};
  std::atomic<int> writers{0};
  std::atomic<bool> open{false};
  std::atomic<int> opened{0};
  std::atomic<int> overlaps{0};  // read() and write() at the same time, which is right
  std::atomic<int> mistakes{0};
  std::atomic<bool> gone{false};
  std::atomic<double> force_n{0.0};
};
Watched* watched = nullptr;

class Inside {
 public:
  Inside(std::atomic<int>& own, const std::atomic<int>& other) : own_(own) {
    if (own_.fetch_add(1) != 0 || !watched->open) ++watched->mistakes;
    if (other != 0) ++watched->overlaps;
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
  ~Inside() { --own_; }

 private:
  std::atomic<int>& own_;
};

int watched_info(hw_device_info* info) {
  info->encoder_m = 1e-5;
  info->force_limit_n = 5.0;
  info->min_m = -1.0;
  info->max_m = 1.0;
  info->max_speed_m_per_s = 10.0;
  return 0;
}
int watched_open() {
  if (watched->open.exchange(true) || watched->readers != 0 || watched->writers != 0)
    ++watched->mistakes;
  ++watched->opened;
  return 0;
}
int watched_read(hw_device_reading* reading) {
  const Inside inside(watched->readers, watched->writers);
  std::this_thread::sleep_for(std::chrono::microseconds(300));
  reading->position_m = 0.01;
  return watched->gone ? HW_READ_FAILED : HW_READ_POSITION;
}
int watched_write(const hw_device_command* command) {
  const Inside inside(watched->writers, watched->readers);
  watched->force_n = command->enable != 0 ? command->force_n : 0.0;
  return 0;
}
void watched_close() {
  if (!watched->open.exchange(false) || watched->readers != 0 || watched->writers != 0)
    ++watched->mistakes;
}
const char* watched_words() { return ""; }

constexpr hw_device_plugin kWatched = {HAPTICWALL_DEVICE_ABI,
                                       sizeof(hw_device_plugin),
                                       "Watched",
                                       watched_info,
                                       watched_open,
                                       watched_read,
                                       watched_write,
                                       watched_close,
                                       watched_words};

class PluginStress : public hapticwall::test::FolderTest {
 protected:
  void SetUp() override {
    put("device.so", "");
    watched = &library_;
    const auto device = describe_plugin(kWatched, path("device.so"));
    ASSERT_TRUE(device);
    engine_ = make_impulse_engine(options_of(*device),
                                  std::make_unique<PluginPort>(*device, hid::testing::slow_ns),
                                  hid::testing::slow_ns);
  }
  // A loop that asks for 1 N whenever the device is there, until a condition holds.
  bool loop_until(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!condition() && std::chrono::steady_clock::now() < end) {
      const bool ok = engine_->read_axes().state == DeviceState::kOk;
      if (!ok) engine_->enable(false);
      engine_->enable(ok);
      engine_->write_axes({1.0, 0.0});
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    return condition();
  }

  Watched library_;
  std::unique_ptr<ImpulseEngine> engine_;
};

TEST_F(PluginStress, ReadAndWriteRunTogetherAndNeitherRunsDuringOpenOrClose) {
  for (int round = 1; round <= 5; ++round) {
    ASSERT_FALSE(engine_->open());
    ASSERT_TRUE(loop_until([&] { return library_.overlaps >= 20 * round; }));
    ASSERT_TRUE(loop_until([&] { return library_.force_n == 1.0; }));
    engine_->close();
    EXPECT_EQ(library_.force_n, 0.0);
    EXPECT_FALSE(library_.open);
  }
  EXPECT_EQ(library_.mistakes, 0);
}

TEST_F(PluginStress, ALostDeviceIsClosedAndOpenedAgain) {
  ASSERT_FALSE(engine_->open());
  for (int round = 1; round <= 3; ++round) {
    ASSERT_TRUE(loop_until([&] { return library_.force_n == 1.0; }));
    library_.gone = true;
    ASSERT_TRUE(loop_until([&] { return !library_.open; }));
    EXPECT_EQ(library_.force_n, 0.0);
    library_.gone = false;
    ASSERT_TRUE(loop_until([&] { return library_.opened > round; }));
  }
  engine_->close();
  EXPECT_EQ(library_.mistakes, 0);
}

}  // namespace
}  // namespace hapticwall::device
