#include "device/port/wheel_port.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "device/link/description.h"
#include "device/link/stand_in.h"

namespace hapticwall::device {
namespace {

// The age of a resting position counts from the last look.
constexpr int kLookMs = 1;
// Repeats a command, to play the force again and to notice that it grew old.
constexpr std::int64_t kRepeatNs = kMillisecondNs;

}  // namespace

ImpulseEngineOptions options_of(const WheelOptions& options) {
  const WheelDescription& wheel = options.wheel;
  ImpulseEngineOptions link;
  link.kind = "wheel or stick with a constant force";
  link.path = options.path;
  link.vendor_id = options.vendor_id;
  link.product_id = options.product_id;
  link.serial = options.serial;
  link.name = options.name;
  const double end_m = wheel.travel_m() / 2.0;
  const double rate_n_per_s = wheel.max_force_rate_n_per_s > 0.0
                                  ? wheel.max_force_rate_n_per_s
                                  : wheel.limit_n() / hid::kForceRiseS;
  link.axes[0] =
      AxisDescription{0.0, wheel.limit_n(), {-end_m, end_m, wheel.max_speed_m_per_s}, rate_n_per_s};
  link.keep_alive_ns = kRepeatNs;
  link.has_clock = false;
  link.acknowledges = false;
  link.delay_s = wheel.delay_s;
  link.delay_date = wheel.delay_date;
  link.first_state_advice = "turn the wheel a little: it reports its position only when it moves";
  link.prepare_thread = options.prepare_thread;
  return link;
}

// An open wheel, for both handles. The writer ends before the node.
class WheelPort::Connection {
 public:
  Connection(std::shared_ptr<evdev::WheelNode> wheel, const WheelDescription& description,
             double rate_hz, std::int64_t now_ns)
      : node(std::move(wheel)),
        scale(description, node->axis()),
        stand_in({scale.encoder_m(), 0.0}, 0),
        writer(*node, scale, rate_hz, now_ns) {}

  const std::shared_ptr<evdev::WheelNode> node;
  const WheelScale scale;
  hid::StandIn stand_in;
  WheelWriter writer;
  std::atomic<bool> gone{false};  // the wheel did not accept a report
  // Set when one of the two handles has closed: no new handle may share the device.
  std::atomic<bool> closing{false};
};

class WheelPort::WheelHandle : public hid::Handle {
 public:
  WheelHandle(std::shared_ptr<Connection> connection, HostClock now_ns)
      : connection_(std::move(connection)), now_ns_(std::move(now_ns)) {}
  ~WheelHandle() override { connection_->closing = true; }

  // Silence is rest: without an event the position of now is known, too.
  hid::ReadOutcome read(std::span<std::uint8_t> bytes, int wait_ms) override {
    const evdev::WheelNews news = connection_->node->listen(std::min(wait_ms, kLookMs));
    if (news.gone || connection_->gone) return {hid::ReadKind::kGone, 0};
    if (!news.value || (wait_ms == 0 && news.events == 0)) return {};
    hid::Told told{.calibrated = true};
    told.answer = {0, false, 0.0 - connection_->writer.taken_n()};
    const hid::ReportBytes state = connection_->stand_in.state(
        {connection_->scale.position_m(*news.value), 0.0}, now_ns_(), told);
    const std::size_t size = std::min(bytes.size(), state.size());
    std::copy_n(state.begin(), size, bytes.begin());
    return {hid::ReadKind::kReport, size};
  }

  bool write(std::span<const std::uint8_t> bytes) override {
    const hid::Decoded<hid::ForceReport> command = hid::decode_force(bytes);
    if (command.report() == nullptr) return false;
    const bool taken = connection_->writer.write(*command.report(), now_ns_());
    if (!taken) connection_->gone = true;
    return taken;
  }

  std::size_t get_feature(std::uint8_t /*id*/, std::span<std::uint8_t> /*bytes*/) override {
    return 0;
  }

  [[nodiscard]] std::int64_t free_ns() const override { return connection_->writer.free_ns(); }

  void complete(AxisDescription& axis) const override {
    axis.encoder_m = connection_->scale.encoder_m();
    axis.motion.min_m -= axis.encoder_m;
    axis.motion.max_m += axis.encoder_m;
  }

 private:
  std::shared_ptr<Connection> connection_;
  const HostClock now_ns_;
};

WheelPort::WheelPort(WheelDescription wheel, Wheels wheels, HostClock now_ns)
    : wheel_(std::move(wheel)), wheels_(std::move(wheels)), now_ns_(std::move(now_ns)) {}

WheelPort::~WheelPort() = default;

Result<std::vector<hid::Listing>> WheelPort::list() {
  std::vector<hid::Listing> listings;
  listed_.clear();
  for (const evdev::WheelListing& wheel : wheels_.list()) {
    const std::string path = wheel.node.path();
    listings.push_back({path, wheel.vendor_id, wheel.product_id, wheel.node.serial(), "",
                        wheel.name, hid::kUsagePage, hid::kUsage});
    listed_.emplace(path, wheel);
  }
  return listings;
}

Result<std::unique_ptr<hid::Handle>> WheelPort::open(const std::string& path) {
  auto connection = open_[path].lock();
  if (connection && connection->closing)
    return device_error(path + ": a report to it has not returned");
  if (!connection) {
    const evdev::WheelListing& listing = listed_.at(path);
    if (!listing.refusal.empty()) return device_error(listing.name + ": " + listing.refusal);
    auto node = wheels_.open(listing);
    if (!node) return node.error();
    const double rate_hz =
        wheel_.rate_hz > 0.0 ? std::min(wheel_.rate_hz, listing.max_rate_hz) : listing.max_rate_hz;
    connection = std::make_shared<Connection>(*node, wheel_, rate_hz, now_ns_());
    open_[path] = connection;
  }
  return std::unique_ptr<hid::Handle>(std::make_unique<WheelHandle>(connection, now_ns_));
}

hid::Obstacle WheelPort::obstacle(const std::string& /*path*/) { return hid::Obstacle::kNone; }

std::unique_ptr<ImpulseEngine> make_wheel(const WheelOptions& options, Wheels wheels,
                                          HostClock now_ns) {
  auto port = std::make_unique<WheelPort>(options.wheel, std::move(wheels), now_ns);
  return make_impulse_engine(options_of(options), std::move(port), std::move(now_ns));
}

}  // namespace hapticwall::device
