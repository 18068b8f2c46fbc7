// A machine with HID devices of our choice, for the real libhidapi: umockdev puts folders of our
// own in the place of /sys and /dev. One at a time in a process.
#pragma once

#include <umockdev.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "device/link/report.h"
#include "tests/umockdev/hidraw_node.h"

namespace hapticwall::device::hid::testing {

// Identity of a device in /sys.
struct MockIdentity {
  std::uint16_t vendor_id = kTestVendorId;
  std::uint16_t product_id = kTestProductId;
  std::string manufacturer = "Workshop";
  std::string product = "Paddle";
  std::string serial = "A-1";
  std::vector<std::uint8_t> descriptor{kReportDescriptor.begin(), kReportDescriptor.end()};
  // Lines of the device's uevent: if empty, as the kernel writes them.
  std::string hid_id;
  std::string left_out;  // one of HID_ID, HID_NAME, HID_UNIQ
  bool has_descriptor_file = true;
  bool is_on_usb = true;  // false: like one that a program made through /dev/uhid
};

// A device of the mocked machine.
class MockDevice {
 public:
  [[nodiscard]] const std::string& path() const { return path_; }  // "/dev/hidraw0"
  [[nodiscard]] HidrawNode& node() { return *node_; }
  [[nodiscard]] const std::filesystem::path& node_file() const { return file_; }

 private:
  friend class MockBus;
  std::string path_;
  std::filesystem::path file_;        // real path of the node
  std::vector<std::string> folders_;  // in /sys, outermost first
  std::vector<std::uint8_t> descriptor_;
  std::unique_ptr<HidrawNode> node_;
  UMockdevIoctlBase* answers_ = nullptr;
};

class MockBus {
 public:
  MockBus();
  MockBus(const MockBus&) = delete;
  MockBus& operator=(const MockBus&) = delete;
  // Precondition: nobody has a node open.
  ~MockBus();

  // Plugged in, from the next enumeration on; the node is answered by this emulator.
  MockDevice& plug(const MockIdentity& identity, FirmwareEmulator emulator);
  MockDevice& plug(const MockIdentity& identity = {});
  // Off the bus, out of /sys and /dev.
  void unplug(MockDevice& device);

  // The node is there and opens, and whatever is asked of it, it is no hidraw.
  void make_deaf(MockDevice& device);

 private:
  std::string add(const std::string& subsystem, const std::string& name, const std::string& parent,
                  std::vector<std::string> attributes, std::vector<std::string> properties);
  void add_folders(const MockIdentity& identity, MockDevice& device);

  UMockdevTestbed* testbed_;
  std::filesystem::path root_;
  std::vector<std::unique_ptr<MockDevice>> devices_;
};

}  // namespace hapticwall::device::hid::testing
