#include "device/port/wheel_node.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "device/port/node_lock.h"

namespace hapticwall::device::evdev {
namespace {

// Direction of a level's force: positive to the left, as Documentation/input/ff.rst has it.
constexpr std::uint16_t kLeft = 0x4000;
constexpr std::int32_t kFullGain = 0xFFFF;
// Share of the endpoint's rate that is used: at all of it, a queue of the kernel stays full, and is
// a delay.
constexpr double kShareOfEndpoint = 0.9;
// Value of an axis whose wheel has reported nothing since it was opened.
constexpr std::int32_t kUntold = std::numeric_limits<std::int32_t>::min();
// Rate of a wheel of which neither endpoint nor model is known: the slowest one known.
constexpr double kUnknownRateHz = 125.0;

struct ModelRate {
  std::uint16_t vendor_id;
  double max_rate_hz;
};
// Makers whose wheels accept less than their endpoints declare: Moza, Thrustmaster, Logitech.
constexpr std::array kModelRates{ModelRate{0x346E, 400.0}, ModelRate{0x044F, 125.0},
                                 ModelRate{0x046D, 250.0}};

struct Model {
  std::uint16_t vendor_id;
  std::uint16_t product_id;
};
// Logitech G920, G923 for Xbox, G Pro: their driver queues tens of thousands of commands.
constexpr std::array kHidPlusPlus{Model{0x046D, 0xC262}, Model{0x046D, 0xC26D},
                                  Model{0x046D, 0xC26E}, Model{0x046D, 0xC272}};

double rate_of(const WheelListing& listing, double endpoint_hz) {
  double rate_hz = endpoint_hz > 0.0 ? kShareOfEndpoint * endpoint_hz : kUnknownRateHz;
  for (const ModelRate& model : kModelRates) {
    if (model.vendor_id == listing.vendor_id) rate_hz = std::min(rate_hz, model.max_rate_hz);
  }
  return rate_hz;
}

std::string refusal_of(const WheelListing& listing) {
  const bool queues = std::ranges::any_of(kHidPlusPlus, [&](const Model& model) {
    return model.vendor_id == listing.vendor_id && model.product_id == listing.product_id;
  });
  if (queues)
    return "its driver (HID++) queues thousands of commands: its force comes seconds late";
  if (::access(listing.node.path().c_str(), R_OK | W_OK) == 0) return "";
  return "a udev rule or the group 'input' must permit it";
}

WheelListing described(const NodeListing& node) {
  WheelListing listing{node, node.name(), node.id("vendor"), node.id("product"), 0.0, false, ""};
  const double endpoint_hz = node.output_rate_hz();
  listing.rate_is_known = endpoint_hz > 0.0;
  listing.max_rate_hz = rate_of(listing, endpoint_hz);
  listing.refusal = refusal_of(listing);
  return listing;
}

class EventWheel final : public WheelNode {
 public:
  EventWheel(EventNode node, std::shared_ptr<hid::NodeLock> lock, const NodeListing& listing)
      : node_(std::move(node)),
        lock_(std::move(lock)),
        has_gain_(listing.has("ff", FF_GAIN)),
        has_autocentre_(listing.has("ff", FF_AUTOCENTER)) {
    effect_.type = FF_CONSTANT;
    effect_.id = -1;
    effect_.direction = kLeft;
    effect_.replay.length = kEffectMs;
  }
  EventWheel(const EventWheel&) = delete;
  EventWheel& operator=(const EventWheel&) = delete;
  ~EventWheel() override {
    input_absinfo axis{};
    if (!fuzzy_ || node_.get_axis(ABS_X, axis)) return;
    if (axis.value != kUntold) fuzzy_->value = axis.value;
    static_cast<void>(node_.set_axis(ABS_X, *fuzzy_));
  }

  [[nodiscard]] Failure begin() {
    if (Failure failed = node_.grab()) return failed;
    if (Failure failed = node_.use_monotonic_clock()) return failed;
    if (Failure failed = node_.upload(effect_)) return failed;
    // The gain comes after the force was made, because making the first one may reset the wheel.
    if (!set_gain(false)) return device_error("it does not take a gain");
    if (has_autocentre_) {
      if (Failure failed = node_.write(EV_FF, FF_AUTOCENTER, 0)) return failed;
    }
    return sharpen();
  }

  [[nodiscard]] WheelAxis axis() const override { return {fuzzy_->minimum, fuzzy_->maximum}; }

  [[nodiscard]] WheelNews listen(int wait_ms) override {
    WheelNews news;
    const Result<EventNode::Events> events = node_.drain(wait_ms, ABS_X);
    input_absinfo axis{};
    news.gone = !events || node_.get_axis(ABS_X, axis);
    if (news.gone) return news;
    news.events = events->count;
    news.latch_ns = events->last_ns;
    if (axis.value != kUntold) news.value = axis.value;
    return news;
  }

  bool set_level(std::int16_t level) override {
    effect_.u.constant.level = level;
    return !node_.upload(effect_);
  }
  bool play(bool starts) override {
    return !node_.write(EV_FF, static_cast<std::uint16_t>(effect_.id), starts ? 1 : 0);
  }
  bool set_gain(bool full) override {
    return !has_gain_ || !node_.write(EV_FF, FF_GAIN, full ? kFullGain : 0);
  }

 private:
  // The kernel gives joysticks a fuzz of 1/256 of their range, which hides small motions. The
  // kernel's value is 0 or old: usbhid drops what a wheel reports while it is opened, and a wheel
  // at rest may not report it again.
  [[nodiscard]] Failure sharpen() {
    input_absinfo axis{};
    if (Failure failed = node_.get_axis(ABS_X, axis)) return failed;
    fuzzy_ = axis;
    axis.value = kUntold;
    axis.fuzz = 0;
    axis.flat = 0;
    return node_.set_axis(ABS_X, axis);
  }

  EventNode node_;
  std::shared_ptr<hid::NodeLock> lock_;
  bool has_gain_;
  bool has_autocentre_;
  ff_effect effect_{};
  std::optional<input_absinfo> fuzzy_;  // axis before sharpen()
};

}  // namespace

std::vector<WheelListing> list_wheels() {
  std::vector<WheelListing> wheels;
  for (const NodeListing& node : list_nodes()) {
    if (node.has("ff", FF_CONSTANT) && node.has("abs", ABS_X)) wheels.push_back(described(node));
  }
  return wheels;
}

std::string kernel_release() {
  utsname names{};
  return ::uname(&names) == 0 ? names.release : "";
}

std::string kernel_advice(const std::string& release) {
  std::istringstream text(release);
  std::array<int, 3> version{};
  char dot = '.';
  text >> version[0] >> dot >> version[1] >> dot >> version[2];
  // The first one of each branch with hid-universal-pidff and the repaired hid-pidff.
  constexpr std::array kRepaired{std::array{6, 12, 24}, std::array{6, 13, 12},
                                 std::array{6, 14, 3}};
  for (const auto& first : kRepaired) {
    if (version[0] == first[0] && version[1] == first[1] && version >= first) return "";
  }
  if (version >= std::array{6, 15, 0}) return "";
  return "the kernel " + release +
         " has an old hid-pidff: if the force is wrong or missing, take 6.12.24, 6.13.12, 6.14.3, "
         "6.15 or a later one";
}

Result<std::shared_ptr<WheelNode>> open_wheel(const WheelListing& listing) {
  const std::string path = listing.node.path();
  Result<EventNode> node = EventNode::open(path);
  if (!node) return device_error(path + " cannot be opened: " + node.error().message);
  auto lock = hid::NodeLock::take(path, path);
  if (!lock) return lock.error();
  const auto wheel = std::make_shared<EventWheel>(std::move(*node), std::move(*lock), listing.node);
  if (Failure failed = wheel->begin()) {
    return device_error(path + " cannot be used: " + failed->message +
                        "; another program may have it");
  }
  return std::shared_ptr<WheelNode>(wheel);
}

}  // namespace hapticwall::device::evdev
