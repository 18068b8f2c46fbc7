#include "tests/emulator/firmware/uhid_device.h"

#include <fcntl.h>
#include <linux/input.h>
#include <linux/uhid.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <system_error>
#include <utility>

#include "device/os_threads.h"

namespace hapticwall::device::hid {
namespace {

constexpr const char* kUhidPath = "/dev/uhid";
constexpr std::int64_t kNanosecondsInSecond = 1'000'000'000;
constexpr std::uint32_t kDeviceVersion = 0x0100;

static_assert(sizeof(uhid_create2_req::name) == kMaxUhidNameBytes + 1);
static_assert(sizeof(uhid_create2_req::uniq) == kMaxUhidSerialBytes + 1);

std::string words_of(int error) { return std::generic_category().message(error); }

Error opening_failed(int error) {
  std::string what = std::string(kUhidPath) + ": " + words_of(error);
  if (error == ENOENT || error == ENODEV || error == ENXIO) {
    what += "; the kernel module uhid is not loaded: run 'modprobe uhid' as root";
  } else if (error == EACCES || error == EPERM) {
    what +=
        "; run this as root, or add the udev rule KERNEL==\"uhid\", GROUP=\"plugdev\", "
        "MODE=\"0660\" and be a member of plugdev";
  }
  return device_error(what);
}

template <std::size_t size>
void copy_text(std::uint8_t (&to)[size], const std::string& text) {  // NOLINT(*-c-arrays)
  std::memcpy(to, text.data(), std::min(text.size(), size - 1));
}

class UhidBus final : public VirtualBus {
 public:
  UhidBus(int descriptor, HidIdentity identity)
      : descriptor_(descriptor), identity_(std::move(identity)) {}
  UhidBus(const UhidBus&) = delete;
  UhidBus& operator=(const UhidBus&) = delete;
  ~UhidBus() override {
    unplug();
    close(descriptor_);
  }

  Failure plug() override {
    uhid_event event{};
    event.type = UHID_CREATE2;
    uhid_create2_req& device = event.u.create2;
    copy_text(device.name, identity_.name);
    copy_text(device.uniq, identity_.serial);
    device.rd_size =
        static_cast<std::uint16_t>(std::min(identity_.descriptor.size(), sizeof device.rd_data));
    std::memcpy(device.rd_data, identity_.descriptor.data(), device.rd_size);
    device.bus = BUS_USB;
    device.vendor = identity_.vendor_id;
    device.product = identity_.product_id;
    device.version = kDeviceVersion;
    if (const int error = write_event(event); error != 0) {
      return device_error(std::string(kUhidPath) +
                          ": the device could not be created: " + words_of(error));
    }
    plugged_ = true;
    return {};
  }

  void unplug() override {
    if (!std::exchange(plugged_, false)) return;
    uhid_event event{};
    event.type = UHID_DESTROY;
    write_event(event);
    // Drop the requests of the host that are left.
    while (next_request()) {
    }
  }

  void send(std::span<const std::uint8_t> bytes) override {
    uhid_event event{};
    event.type = UHID_INPUT2;
    event.u.input2.size =
        static_cast<std::uint16_t>(std::min<std::size_t>(bytes.size(), sizeof event.u.input2.data));
    std::memcpy(event.u.input2.data, bytes.data(), event.u.input2.size);
    write_event(event);
  }

  std::optional<BusRequest> next_request() override {
    uhid_event event{};
    while (read(descriptor_, &event, sizeof event) > 0) {
      switch (event.type) {
        case UHID_OUTPUT:
          return BusRequest{RequestKind::kOutput, 0, event.u.output.data[0],
                            bytes_of(event.u.output.data, event.u.output.size)};
        case UHID_GET_REPORT:
          return BusRequest{
              RequestKind::kGetFeature, event.u.get_report.id, event.u.get_report.rnum, {}};
        case UHID_SET_REPORT:
          return BusRequest{RequestKind::kSet, event.u.set_report.id, event.u.set_report.rnum,
                            bytes_of(event.u.set_report.data, event.u.set_report.size)};
        default:
          break;  // start, stop, open and close change nothing
      }
    }
    return {};
  }

  void answer_get(std::uint32_t ticket, std::span<const std::uint8_t> bytes) override {
    uhid_event event{};
    event.type = UHID_GET_REPORT_REPLY;
    uhid_get_report_reply_req& reply = event.u.get_report_reply;
    reply.id = ticket;
    reply.err = bytes.empty() ? EIO : 0;
    reply.size = static_cast<std::uint16_t>(std::min<std::size_t>(bytes.size(), sizeof reply.data));
    if (!bytes.empty()) std::memcpy(reply.data, bytes.data(), reply.size);
    write_event(event);
  }

  void answer_set(std::uint32_t ticket, bool taken) override {
    uhid_event event{};
    event.type = UHID_SET_REPORT_REPLY;
    event.u.set_report_reply.id = ticket;
    event.u.set_report_reply.err = taken ? 0 : EIO;
    write_event(event);
  }

  std::int64_t now_ns() override { return monotonic_ns(); }

  void wait_until_ns(std::int64_t deadline_ns) override {
    const std::int64_t left_ns = std::max<std::int64_t>(deadline_ns - now_ns(), 0);
    const timespec left{static_cast<time_t>(left_ns / kNanosecondsInSecond),
                        static_cast<long>(left_ns % kNanosecondsInSecond)};
    pollfd poll_for{descriptor_, POLLIN, 0};
    ppoll(&poll_for, 1, &left, nullptr);
  }

 private:
  static std::vector<std::uint8_t> bytes_of(const std::uint8_t* data, std::size_t size) {
    return {data, data + std::min<std::size_t>(size, UHID_DATA_MAX)};
  }

  // 0, or errno.
  int write_event(const uhid_event& event) {
    return write(descriptor_, &event, sizeof event) < 0 ? errno : 0;
  }

  int descriptor_;
  HidIdentity identity_;
  bool plugged_ = false;
};

}  // namespace

Result<std::unique_ptr<VirtualBus>> open_uhid(const HidIdentity& identity) {
  const int descriptor = open(kUhidPath, O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return opening_failed(errno);
  return std::unique_ptr<VirtualBus>(std::make_unique<UhidBus>(descriptor, identity));
}

}  // namespace hapticwall::device::hid
