// The port to a device that speaks a dialect, report by report.
#include "device/port/dialect_port.h"

#include <gtest/gtest.h>

#include "tests/device/emulator/emulator_support.h"
#include "tests/device/link/link_fake_bus.h"

namespace hapticwall::device::hid::testing {
namespace {

constexpr std::int64_t kNowNs = 5'000'000;

DialectDevice wooden_device() {
  DialectDevice device;
  device.dialect.usage_page = 0xFFAB;
  device.dialect.in.bytes = device.dialect.out.bytes = WoodenBoard::kBytes;
  device.dialect.in.axes[0] = ReportField{0, FieldType::kI16, -43.20e-6};
  device.dialect.out.axes[0] = ReportField{0, FieldType::kI16, 1.8836e-3};
  device.vendor_id = 0x1234;
  device.product_id = 0x0006;
  device.encoder_m = {43.20e-6, 0.0};
  device.rate_hz = 100.0;
  return device;
}

class DialectPortTest : public ::testing::Test {
 protected:
  DialectPortTest() {
    Listing listing = usual_listing();
    listing.vendor_id = 0x1234;
    listing.product_id = 0x0006;
    listing.usage_page = 0xFFAB;
    plug_ = &bus_.add(listing, one_axis());
    plug_->foreign = std::make_unique<WoodenBoard>(held_scene());
    port_ = dialect_port(std::make_shared<FakePort>(bus_), wooden_device(), [] { return kNowNs; });
  }
  std::unique_ptr<Handle> opened() {
    EXPECT_TRUE(port_->list());
    auto handle = port_->open(plug_->listing.path);
    EXPECT_TRUE(handle);
    return std::move(*handle);
  }
  static StateReport read(Handle& handle) {
    ReportBytes bytes{};
    EXPECT_EQ(handle.read(bytes, 0).size, bytes.size());
    const Decoded<StateReport> state = decode_state(bytes);
    return state.report() == nullptr ? StateReport{} : *state.report();
  }
  [[nodiscard]] std::uint16_t listed_page() { return port_->list()->front().usage_page; }

  FakeBus bus_;
  Plug* plug_ = nullptr;
  std::shared_ptr<Port> port_;
};

TEST_F(DialectPortTest, OnlyItsNumbersAndItsPageSpeakTheProtocol) {
  EXPECT_EQ(listed_page(), kUsagePage);
  plug_->listing.usage_page = 0xFFAC;
  EXPECT_NE(listed_page(), kUsagePage);
  plug_->listing.usage_page = 0;  // 0: unknown
  EXPECT_EQ(listed_page(), kUsagePage);
  plug_->listing.product_id = 7;
  EXPECT_NE(listed_page(), kUsagePage);
  plug_->listing.product_id = 6;
  plug_->listing.vendor_id = kTestVendorId;
  EXPECT_NE(listed_page(), kUsagePage);
}

TEST_F(DialectPortTest, ReportsThatArriveTogetherAreHalfAPeriodApart) {
  const auto handle = opened();
  bus_.move_to(2000);  // two reports
  const StateReport first = read(*handle);
  EXPECT_EQ(first.time_us, 5000U);
  EXPECT_EQ(read(*handle).time_us, 10'000U);
}

TEST_F(DialectPortTest, AnswersWithTheForceThatWasWritten) {
  const auto reader = opened();
  const auto writer = opened();
  ForceReport command;
  command.enable = true;
  command.sequence = 3;
  command.force_n[0] = 1.5;
  EXPECT_TRUE(writer->write(encode_force(command)));
  EXPECT_NEAR(plug_->foreign->force_n(), 1.5, 2e-3);
  EXPECT_FALSE(writer->write(Bytes(kReportBytes)));  // no command: the device gets nothing
  EXPECT_EQ(plug_->foreign->written.size(), 1U);
  bus_.move_to(1000);
  EXPECT_EQ(read(*reader).acknowledged_sequence, 3);
}

TEST_F(DialectPortTest, ANewLinkKnowsNothingOfTheOldOneWhoseOtherHandleIsStillOpen) {
  auto reader = opened();
  const auto stuck = opened();
  ForceReport command;
  command.enable = true;
  command.sequence = 3;
  EXPECT_TRUE(stuck->write(encode_force(command)));
  reader.reset();
  const auto next = opened();
  bus_.move_to(1000);
  const StateReport state = read(*next);
  EXPECT_EQ(state.acknowledged_sequence, 0);
  EXPECT_EQ(state.status, 0);
}

}  // namespace
}  // namespace hapticwall::device::hid::testing
