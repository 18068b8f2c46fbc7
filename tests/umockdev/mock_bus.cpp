#include "tests/umockdev/mock_bus.h"

#include <fmt/format.h>
#include <linux/hidraw.h>
#include <linux/input.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "tests/device/emulator/emulator_support.h"

namespace hapticwall::device::hid::testing {
namespace {

constexpr unsigned kGetFeature = 7;  // the number of HIDIOCGFEATURE, whatever its length

void check(gboolean done, GError* error) {
  if (done != FALSE) return;
  const std::string message = error == nullptr ? "umockdev failed" : error->message;
  g_clear_error(&error);
  throw std::runtime_error(message);
}

// Into the caller's memory, then the result.
void answer(UMockdevIoctlClient* client, UMockdevIoctlData* memory, Reply reply) {
  if (!reply.bytes.empty()) {
    umockdev_ioctl_data_update(memory, 0, reply.bytes.data(),
                               static_cast<gint>(reply.bytes.size()));
  }
  umockdev_ioctl_client_complete(client, reply.result, reply.error);
}

Reply descriptor_size(const std::vector<std::uint8_t>& descriptor) {
  const auto size = static_cast<int>(descriptor.size());
  Reply reply{0, 0, std::vector<std::uint8_t>(sizeof size)};
  std::memcpy(reply.bytes.data(), &size, sizeof size);
  return reply;
}

Reply descriptor_itself(const std::vector<std::uint8_t>& descriptor) {
  hidraw_report_descriptor all{};
  all.size = static_cast<std::uint32_t>(descriptor.size());
  std::copy(descriptor.begin(), descriptor.end(), std::begin(all.value));
  Reply reply{0, 0, std::vector<std::uint8_t>(sizeof all)};
  std::memcpy(reply.bytes.data(), &all, sizeof all);
  return reply;
}

// Answers to the requests of an open node, on umockdev's thread.
struct Answers {
  HidrawNode& node;
  std::vector<std::uint8_t> descriptor;

  [[nodiscard]] Reply to_ioctl(unsigned long request, UMockdevIoctlData* memory) {
    if (request == HIDIOCGRDESCSIZE) return descriptor_size(descriptor);
    if (request == HIDIOCGRDESC) return descriptor_itself(descriptor);
    if (_IOC_TYPE(request) == 'H' && _IOC_NR(request) == kGetFeature) {
      return node.get_feature(memory->data[0], _IOC_SIZE(request));
    }
    return {-1, ENOTTY, {}};
  }
};

gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer answers) {
  const gulong request = umockdev_ioctl_client_get_request(client);
  UMockdevIoctlData* memory = umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0,
                                                          _IOC_SIZE(request), nullptr);
  answer(client, memory, static_cast<Answers*>(answers)->to_ioctl(request, memory));
  if (memory != nullptr) g_object_unref(memory);  // there is none of size 0
  return TRUE;
}

gboolean on_read(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer answers) {
  UMockdevIoctlData* memory = umockdev_ioctl_client_get_arg(client);
  const auto room = static_cast<std::size_t>(memory->data_len);
  answer(client, memory, static_cast<Answers*>(answers)->node.read(room));
  return TRUE;
}

gboolean on_write(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer answers) {
  UMockdevIoctlData* memory = umockdev_ioctl_client_get_arg(client);
  const std::span bytes(memory->data, static_cast<std::size_t>(memory->data_len));
  answer(client, memory, static_cast<Answers*>(answers)->node.write(bytes));
  return TRUE;
}

void forget_answers(gpointer answers, GClosure*) { delete static_cast<Answers*>(answers); }

UMockdevIoctlBase* make_answers(HidrawNode& node, const std::vector<std::uint8_t>& descriptor) {
  UMockdevIoctlBase* base = umockdev_ioctl_base_new();
  const auto connect = [&](const char* signal, GCallback callback) {
    g_signal_connect_data(base, signal, callback, new Answers{node, descriptor}, forget_answers,
                          GConnectFlags{});
  };
  connect("handle-ioctl", G_CALLBACK(on_ioctl));
  connect("handle-read", G_CALLBACK(on_read));
  connect("handle-write", G_CALLBACK(on_write));
  return base;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> hid_properties(const MockIdentity& identity) {
  const std::string id =
      identity.hid_id.empty()
          ? fmt::format("0003:{:08X}:{:08X}", identity.vendor_id, identity.product_id)
          : identity.hid_id;
  std::vector<std::string> properties;
  for (const auto& [key, value] : {std::pair<std::string, std::string>{"HID_ID", id},
                                   {"HID_NAME", identity.manufacturer + " " + identity.product},
                                   {"HID_UNIQ", identity.serial}}) {
    if (key == identity.left_out) continue;
    properties.push_back(key);
    properties.push_back(value);
  }
  return properties;
}

}  // namespace

MockBus::MockBus() : testbed_(umockdev_testbed_new()) {
  gchar* root = umockdev_testbed_get_root_dir(testbed_);
  root_ = root;
  g_free(root);
  std::filesystem::create_directory(root_ / "dev");
  // Everybody may look, as in a real /dev and /sys.
  std::filesystem::permissions(root_, std::filesystem::perms(0755));
}

MockBus::~MockBus() {
  for (const auto& device : devices_) {
    umockdev_testbed_detach_ioctl(testbed_, device->path_.c_str(), nullptr);
    g_clear_object(&device->answers_);
    std::filesystem::remove(device->file_);
  }
  std::filesystem::remove(root_ / "dev");
  g_object_unref(testbed_);
}

std::string MockBus::add(const std::string& subsystem, const std::string& name,
                         const std::string& parent, std::vector<std::string> attributes,
                         std::vector<std::string> properties) {
  gchar* folder = umockdev_testbed_add_devicev(
      testbed_, subsystem.c_str(), name.c_str(), parent.empty() ? nullptr : parent.c_str(),
      pointers_to(attributes).data(), pointers_to(properties).data());
  if (folder == nullptr) throw std::runtime_error("umockdev does not take " + name);
  std::string text = folder;
  g_free(folder);
  return text;
}

void MockBus::add_folders(const MockIdentity& identity, MockDevice& device) {
  const std::size_t number = devices_.size();
  std::string parent;
  if (identity.is_on_usb) {
    const std::string port = fmt::format("1-{}", number + 1);
    device.folders_.push_back(
        add("usb", port, "",
            {"manufacturer", identity.manufacturer, "product", identity.product, "serial",
             identity.serial, "bcdDevice", "0100"},
            {"DEVTYPE", "usb_device"}));
    device.folders_.push_back(add("usb", port + ":1.0", device.folders_.back(),
                                  {"bInterfaceNumber", "00"}, {"DEVTYPE", "usb_interface"}));
    parent = device.folders_.back();
  }
  const std::string hid =
      fmt::format("0003:{:04X}:{:04X}.{:04X}", identity.vendor_id, identity.product_id, number + 1);
  const std::string raw = fmt::format("hidraw{}", number);
  device.folders_.push_back(add("hid", hid, parent, {}, hid_properties(identity)));
  if (identity.has_descriptor_file) {
    std::vector<std::uint8_t> descriptor = identity.descriptor;
    umockdev_testbed_set_attribute_binary(testbed_, device.folders_.back().c_str(),
                                          "report_descriptor", descriptor.data(),
                                          static_cast<gint>(descriptor.size()));
  }
  device.folders_.push_back(
      add("hidraw", raw, device.folders_.back(), {},
          {"DEVNAME", "/dev/" + raw, "MAJOR", "240", "MINOR", std::to_string(number)}));
  umockdev_testbed_set_attribute_link(testbed_, device.folders_.back().c_str(), "device",
                                      ("../../" + hid).c_str());
  device.path_ = "/dev/" + raw;
  device.file_ = root_ / "dev" / raw;
}

MockDevice& MockBus::plug(const MockIdentity& identity, FirmwareEmulator emulator) {
  auto device = std::make_unique<MockDevice>();
  add_folders(identity, *device);
  device->descriptor_ = identity.descriptor;
  device->node_ = std::make_unique<HidrawNode>(device->file_, std::move(emulator));
  device->answers_ = make_answers(*device->node_, identity.descriptor);
  GError* error = nullptr;
  check(umockdev_testbed_attach_ioctl(testbed_, device->path_.c_str(), device->answers_, &error),
        error);
  devices_.push_back(std::move(device));
  return *devices_.back();
}

MockDevice& MockBus::plug(const MockIdentity& identity) {
  return plug(identity, FirmwareEmulator(one_axis()));
}

void MockBus::unplug(MockDevice& device) {
  device.node_->pull();
  for (auto folder = device.folders_.rbegin(); folder != device.folders_.rend(); ++folder) {
    umockdev_testbed_remove_device(testbed_, folder->c_str());
  }
  device.folders_.clear();
}

void MockBus::make_deaf(MockDevice& device) {
  GError* error = nullptr;
  check(umockdev_testbed_detach_ioctl(testbed_, device.path_.c_str(), &error), error);
}

}  // namespace hapticwall::device::hid::testing
