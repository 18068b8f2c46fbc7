#include "device/port/dialect_port.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/units.h"
#include "device/link/stand_in.h"
#include "device/port/dialect.h"

namespace hapticwall::device::hid {
namespace {

// Larger than a report, so that an overlong one is noticed.
constexpr std::size_t kRawRoom = kMaxDialectBytes + 64;
// A device that reports on change counts as resting after this time: a quarter of the maximum age
// of a position.
constexpr std::int64_t kRestNs = kLinkLostNs / 4;

std::int64_t half_period_ns(double rate_hz) {
  return static_cast<std::int64_t>(kNanosecondsPerSecond / (2.0 * rate_hz));
}

// Translation that both handles of a link share.
struct Translation {
  Translation(const DialectDevice& device, HostClock clock)
      : dialect(device.dialect),
        now_ns(std::move(clock)),
        stand_in(device.encoder_m, half_period_ns(device.rate_hz)) {}

  const Dialect dialect;
  const HostClock now_ns;
  StandIn stand_in;
  // Set when one of the two handles has closed: no handle of the next link may share the device.
  std::atomic<bool> closing{false};
};

class DialectHandle : public Handle {
 public:
  DialectHandle(std::unique_ptr<Handle> raw, std::shared_ptr<Translation> translation)
      : raw_(std::move(raw)), translation_(std::move(translation)) {}
  ~DialectHandle() override { translation_->closing = true; }

  ReadOutcome read(std::span<std::uint8_t> bytes, int wait_ms) override {
    std::array<std::uint8_t, kRawRoom> room{};
    const ReadOutcome outcome = raw_->read(room, wait_ms);
    if (outcome.kind == ReadKind::kFailed) return outcome;
    if (outcome.kind == ReadKind::kNothing) return rests() ? state(bytes) : outcome;
    const auto report = std::span(room).first(std::min(outcome.size, room.size()));
    const auto position_m = decode_positions(translation_->dialect.in, report);
    if (!position_m) return {ReadKind::kReport, 0};  // void
    position_m_ = position_m;
    return state(bytes);
  }

  bool write(std::span<const std::uint8_t> bytes) override {
    const Decoded<ForceReport> command = decode_force(bytes);
    if (command.report() == nullptr) return false;
    const RawReport report = encode_forces(translation_->dialect.out, *command.report());
    if (!raw_->write(report.view())) {
      translation_->stand_in.refused();
      return false;
    }
    translation_->stand_in.took(*command.report(), translation_->now_ns());
    return true;
  }

  std::size_t get_feature(std::uint8_t /*id*/, std::span<std::uint8_t> /*bytes*/) override {
    return 0;
  }

 private:
  [[nodiscard]] bool rests() const {
    return translation_->dialect.reports_on_change && position_m_ &&
           translation_->now_ns() - told_ns_ >= kRestNs;
  }
  ReadOutcome state(std::span<std::uint8_t> bytes) {
    told_ns_ = translation_->now_ns();
    const ReportBytes report = translation_->stand_in.state(*position_m_, told_ns_);
    const std::size_t size = std::min(bytes.size(), report.size());
    std::copy_n(report.begin(), size, bytes.begin());
    return {ReadKind::kReport, size};
  }

  std::unique_ptr<Handle> raw_;
  std::shared_ptr<Translation> translation_;
  std::optional<std::array<double, kMaxAxes>> position_m_;  // last reported position and its time
  std::int64_t told_ns_ = 0;
};

class DialectPort : public Port {
 public:
  DialectPort(std::shared_ptr<Port> port, const DialectDevice& device, HostClock now_ns)
      : port_(std::move(port)), device_(device), now_ns_(std::move(now_ns)) {}

  Result<std::vector<Listing>> list() override {
    auto listings = port_->list();
    if (!listings) return listings;
    for (Listing& listing : *listings) {
      listing.usage_page = speaks_it(listing) ? kUsagePage : kForeignPage;
      listing.usage = kUsage;
    }
    return listings;
  }

  Result<std::unique_ptr<Handle>> open(const std::string& path) override {
    auto raw = port_->open(path);
    if (!raw) return raw;
    auto& known = open_[path];
    auto translation = known.lock();
    if (!translation || translation->closing)
      known = translation = std::make_shared<Translation>(device_, now_ns_);
    return std::unique_ptr<Handle>(
        std::make_unique<DialectHandle>(std::move(*raw), std::move(translation)));
  }

  Obstacle obstacle(const std::string& path) override { return port_->obstacle(path); }

 private:
  static constexpr std::uint16_t kForeignPage = 0x0001;

  [[nodiscard]] bool speaks_it(const Listing& listing) const {
    const std::uint16_t page = device_.dialect.usage_page;
    return listing.vendor_id == device_.vendor_id && listing.product_id == device_.product_id &&
           (page == 0 || listing.usage_page == 0 || listing.usage_page == page);
  }

  std::shared_ptr<Port> port_;
  const DialectDevice device_;
  const HostClock now_ns_;
  std::map<std::string, std::weak_ptr<Translation>> open_;
};

}  // namespace

std::shared_ptr<Port> dialect_port(std::shared_ptr<Port> port, const DialectDevice& device,
                                   HostClock now_ns) {
  return std::make_shared<DialectPort>(std::move(port), device, std::move(now_ns));
}

PortOpener translated(const ImpulseEngineOptions& options, PortOpener open_port,
                      const HostClock& now_ns) {
  if (!options.dialect) return open_port;
  DialectDevice device{
      *options.dialect, options.vendor_id, options.product_id, {}, options.rate_hz};
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
    if (options.axes[axis]) device.encoder_m[axis] = options.axes[axis]->encoder_m;
  }
  return [device, open_port = std::move(open_port), now_ns]() -> Result<std::shared_ptr<Port>> {
    auto port = open_port();
    if (!port) return port;
    return dialect_port(std::move(*port), device, now_ns);
  };
}

}  // namespace hapticwall::device::hid
