// A mocked machine and the program's own port to it.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "device/link/port.h"
#include "tests/umockdev/mock_bus.h"

namespace hapticwall::device::hid::testing {

class HidrawTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (transport_name() != "hidraw") GTEST_SKIP() << "this program talks to USB by itself";
    Result<std::unique_ptr<Port>> port = open_system_port();
    ASSERT_TRUE(port) << port.error().message;
    port_ = std::move(*port);
  }

  [[nodiscard]] std::vector<Listing> listed() {
    const Result<std::vector<Listing>> listings = port_->list();
    EXPECT_TRUE(listings) << listings.error().message;
    return listings ? *listings : std::vector<Listing>{};
  }

  // The listing of a path, which must be there once.
  [[nodiscard]] Listing listing_of(const std::string& path) {
    const std::vector<Listing> all = listed();
    const auto is_it = [&](const Listing& listing) { return listing.path == path; };
    EXPECT_EQ(std::count_if(all.begin(), all.end(), is_it), 1) << path;
    const auto found = std::find_if(all.begin(), all.end(), is_it);
    return found == all.end() ? Listing{} : *found;
  }

  // Precondition: the device was listed.
  [[nodiscard]] std::unique_ptr<Handle> opened(const MockDevice& device) {
    Result<std::unique_ptr<Handle>> handle = port_->open(device.path());
    EXPECT_TRUE(handle) << handle.error().message;
    return handle ? std::move(*handle) : nullptr;
  }

  // Why it is not opened: one line of a device's error, which names the path.
  [[nodiscard]] std::string refusal_of(const std::string& path) {
    const Result<std::unique_ptr<Handle>> handle = port_->open(path);
    EXPECT_FALSE(handle);
    if (handle) return "";
    EXPECT_EQ(handle.error().kind, ErrorKind::kDevice);
    EXPECT_THAT(handle.error().message, ::testing::HasSubstr(path));
    EXPECT_THAT(handle.error().message, ::testing::Not(::testing::HasSubstr("\n")));
    return handle.error().message;
  }

  MockBus bus_;
  std::unique_ptr<Port> port_;
};

}  // namespace hapticwall::device::hid::testing
