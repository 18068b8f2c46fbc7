// Tests without threads which values the host takes of a library, and what it calls.
#include "device/port/plugin_port.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "tests/temporary_folder.h"

namespace hapticwall::device {
namespace {

using ::testing::HasSubstr;

// Calls that the library got, and its answers.
struct Library {
  hw_device_info info{};
  int info_result = 0;
  int open_result = 0;
  int read_result = HW_READ_POSITION;
  int write_result = 0;
  int opened = 0;
  int closed = 0;
  hw_device_reading reading{};
  hw_device_command command{};
  const char* words = "";
};
Library* library = nullptr;

int give_info(hw_device_info* info) {
  const std::uint32_t size = info->size;
  *info = library->info;
  info->size = size;
  return library->info_result;
}
int open_it() {
  ++library->opened;
  return library->open_result;
}
int read_it(hw_device_reading* reading) {
  EXPECT_EQ(reading->size, sizeof *reading);
  *reading = library->reading;
  return library->read_result;
}
int write_it(const hw_device_command* command) {
  library->command = *command;
  return library->write_result;
}
void close_it() { ++library->closed; }
const char* say_it() { return library->words; }

hw_device_plugin sound() {
  return {HAPTICWALL_DEVICE_ABI,
          sizeof(hw_device_plugin),
          "Handle",
          give_info,
          open_it,
          read_it,
          write_it,
          close_it,
          say_it};
}

TEST(DevicePluginProblem, EveryMemberIsChecked) {
  const auto with = [](const std::function<void(hw_device_plugin&)>& change) {
    hw_device_plugin plugin = sound();
    change(plugin);
    return device_plugin_problem(plugin);
  };
  EXPECT_EQ(device_plugin_problem(sound()), "");
  EXPECT_THAT(with([](auto& p) { p.abi = 2; }), HasSubstr("ABI 2, this program has ABI 1"));
  EXPECT_THAT(with([](auto& p) { p.size -= 8; }), HasSubstr("its hw_device_plugin has 56 bytes"));
  const std::vector<std::function<void(hw_device_plugin&)>> changes{
      [](auto& p) { p.info = nullptr; },  [](auto& p) { p.open = nullptr; },
      [](auto& p) { p.read = nullptr; },  [](auto& p) { p.write = nullptr; },
      [](auto& p) { p.close = nullptr; }, [](auto& p) { p.last_error = nullptr; }};
  for (const auto& change : changes) {
    EXPECT_THAT(with(change), HasSubstr("is NULL"));
  }
  static const std::string kLong(101, 'a');
  for (const char* title :
       {"", static_cast<const char*>(nullptr), "two\nlines", "\xff", kLong.c_str()}) {
    EXPECT_THAT(with([&](auto& p) { p.title = title; }), HasSubstr("its title must be one line"));
  }
}

class PluginPortTest : public hapticwall::test::FolderTest {
 protected:
  void SetUp() override {
    put("device.so", "");
    library = &its_;
    its_.info = {0, 0, 1e-5, 5.0, -0.1, 0.1, 5.0, 0.0};
  }
  [[nodiscard]] Result<PluginDevice> described() const {
    static const hw_device_plugin kSound = sound();
    return describe_plugin(kSound, path("device.so"));
  }
  // A link: two handles of one open().
  void open(std::uint32_t flags = 0) {
    its_.info.flags = flags;
    port_ = std::make_unique<PluginPort>(*described(), [this] { return now_ns_; });
    reader_ = opened();
    writer_ = opened();
  }
  std::unique_ptr<hid::Handle> opened() {
    auto handle = port_->open(path("device.so"));
    EXPECT_TRUE(handle);
    return handle ? std::move(*handle) : nullptr;
  }
  hid::ReadOutcome read() {
    now_ns_ += 1'000'000;
    return reader_->read(bytes_, 0);
  }
  hid::StateReport state() {
    EXPECT_EQ(read().kind, hid::ReadKind::kReport);
    return *hid::decode_state(bytes_).report();
  }
  bool write(double force_n, bool enable = true) {
    hid::ForceReport report;
    report.enable = enable;
    report.sequence = 7;
    report.force_n[0] = force_n;
    return writer_->write(hid::encode_force(report));
  }

  Library its_;
  std::int64_t now_ns_ = 1'000'000'000;
  hid::ReportBytes bytes_{};
  std::unique_ptr<PluginPort> port_;
  std::unique_ptr<hid::Handle> reader_;
  std::unique_ptr<hid::Handle> writer_;
};

TEST_F(PluginPortTest, InfoThatFailsOrIsOutOfRangeIsAnError) {
  EXPECT_TRUE(described());
  its_.info_result = 1;
  its_.words = "no\x01 device";
  EXPECT_EQ(described().error().message, path("device.so") + ": info() failed: no? device");
  its_.info_result = 0;
  for (double hw_device_info::*member :
       {&hw_device_info::encoder_m, &hw_device_info::force_limit_n, &hw_device_info::min_m,
        &hw_device_info::max_m, &hw_device_info::max_speed_m_per_s,
        &hw_device_info::max_force_rate_n_per_s}) {
    for (const double bad : {std::nan(""), 1e9, -1e9}) {
      Library sane = its_;
      its_.info.*member = bad;
      EXPECT_THAT(described().error().message, HasSubstr("out of range"));
      its_ = sane;
    }
  }
}

TEST_F(PluginPortTest, TheFlagsBecomeThoseOfTheLink) {
  const ImpulseEngineOptions plain = options_of(*described());
  EXPECT_FALSE(plain.delay_is_known);
  EXPECT_TRUE(plain.reads_may_hang);
  EXPECT_EQ(plain.keep_alive_ns, 10'000'000);
  its_.info.flags = HW_DEVICE_ANSWERS;
  EXPECT_TRUE(options_of(*described()).delay_is_known);
}

TEST_F(PluginPortTest, TheLastHandleCloses) {
  open();
  EXPECT_EQ(its_.opened, 1);
  reader_.reset();
  EXPECT_EQ(its_.closed, 0);
  EXPECT_THAT(port_->open(path("device.so")).error().message, HasSubstr("has not returned"));
  writer_.reset();
  EXPECT_EQ(its_.closed, 1);
  EXPECT_NE(opened(), nullptr);
  EXPECT_EQ(its_.opened, 2);
}

TEST_F(PluginPortTest, AnOpenThatFailsIsNotClosed) {
  its_.open_result = 5;
  PluginPort port(*described(), [] { return 0; });
  EXPECT_THAT(port.open(path("device.so")).error().message, HasSubstr("open() failed"));
  EXPECT_EQ(its_.closed, 0);
}

TEST_F(PluginPortTest, AForceOutOfTheWallIsPositiveAndNoneWithoutEnable) {
  open();
  EXPECT_TRUE(write(-1.5));
  EXPECT_EQ(its_.command.force_n, 1.5);
  EXPECT_EQ(its_.command.enable, 1U);
  EXPECT_EQ(its_.command.number, 7U);
  EXPECT_EQ(its_.command.size, sizeof(hw_device_command));
  EXPECT_TRUE(write(-1.5, false));
  EXPECT_EQ(its_.command.force_n, 0.0);
  EXPECT_EQ(its_.command.enable, 0U);
  EXPECT_FALSE(writer_->write(hid::ReportBytes{}));
}

TEST_F(PluginPortTest, ReadingsBecomeStates) {
  open(HW_DEVICE_CALIBRATED);
  its_.reading.position_m = 0.01;
  EXPECT_EQ(state().position_counts[0], 1000);
  EXPECT_EQ(state().status, hid::kStatusCalibrated);
  its_.reading.flags = HW_READING_FAULT;
  EXPECT_EQ(state().fault, hid::kFirstOwnFault);
  its_.read_result = HW_READ_NOTHING;
  EXPECT_EQ(read().kind, hid::ReadKind::kNothing);
  for (const int result : {-1, 2, 99}) {
    its_.read_result = result;
    EXPECT_EQ(read().kind, hid::ReadKind::kFailed);
  }
}

TEST_F(PluginPortTest, WithoutAnswersACommandCountsWhenItWasTaken) {
  open();
  EXPECT_TRUE(write(-1.5));
  EXPECT_EQ(state().acknowledged_sequence, 7);
  EXPECT_EQ(state().applied_force_n[0], -1.5);
  its_.write_result = 1;
  EXPECT_FALSE(write(-1.5));
  EXPECT_EQ(state().rejected_commands, 1);
}

TEST_F(PluginPortTest, WithAnswersOnlyTheDevicesWordCounts) {
  open(HW_DEVICE_ANSWERS);
  EXPECT_TRUE(write(-1.5));
  EXPECT_EQ(state().acknowledged_sequence, 0);
  EXPECT_EQ(state().acknowledged_time_us, 0U);
  EXPECT_EQ(state().status & hid::kStatusEnabled, 0);
  its_.reading.command = 7;
  its_.reading.flags = HW_READING_ENABLED;
  its_.reading.force_n = 1.5;
  EXPECT_EQ(state().acknowledged_sequence, 7);
  EXPECT_EQ(state().status & hid::kStatusEnabled, hid::kStatusEnabled);
  EXPECT_EQ(state().applied_force_n[0], -1.5);
}

TEST_F(PluginPortTest, IsNotAskedMoreOftenThanItsPace) {
  open();
  EXPECT_EQ(read().kind, hid::ReadKind::kReport);
  EXPECT_EQ(reader_->read(bytes_, 0).kind, hid::ReadKind::kNothing);
}

}  // namespace
}  // namespace hapticwall::device
