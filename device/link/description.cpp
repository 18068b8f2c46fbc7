#include "device/link/description.h"

#include <algorithm>
#include <cmath>

namespace hapticwall::device::hid {
namespace {

// Larger than a report, so that an overlong one is noticed.
constexpr std::size_t kFeatureRoom = kReportBytes + 16;
constexpr std::size_t kProtocolOffset = 1;
// A device with an INFO report may fail to answer once.
constexpr int kAsks = 3;
// Keeps 8.9 N at 8900 steps despite rounding.
constexpr double kRoundingSteps = 1e-6;

// The largest force that a report can carry within the limit.
double whole_millinewtons(double limit_n) {
  const double steps = std::floor(std::min(limit_n, kMaxForceN) * kStepsPerNewton + kRoundingSteps);
  return std::max(steps, 0.0) / kStepsPerNewton;
}

bool is_of_the_protocol(const Listing& listing) {
  const bool test_numbers =
      listing.vendor_id == kTestVendorId && listing.product_id == kTestProductId;
  return may_be_haptic(listing) && (listing.usage_page != 0 || test_numbers);
}

bool is_same_device(const Listing& listing, const Listing& known) {
  return may_be_haptic(listing) && listing.vendor_id == known.vendor_id &&
         listing.product_id == known.product_id && listing.serial == known.serial;
}

Error refused(const Listing& listing, const std::string& why) {
  return device_error(listing.path + " " + why);
}

Error not_understood(const Listing& listing, Refusal refusal, std::span<const std::uint8_t> bytes) {
  if (refusal == Refusal::kProtocol) {
    const unsigned major = bytes[kProtocolOffset] >> 4U;
    return refused(listing, "speaks version " + std::to_string(major) +
                                " of the protocol, this program speaks version " +
                                std::to_string(unsigned{kProtocolMajor}) +
                                ": update the older of the two");
  }
  return refused(listing, "gives an INFO report that is void (" +
                              std::string(refusal_text(refusal)) +
                              "): its firmware has to follow docs/hid-protocol.md");
}

AxisDescription axis_of(const InfoReport* info, std::size_t axis,
                        const std::optional<AxisDescription>& file) {
  AxisDescription described = file.value_or(AxisDescription{});
  if (info != nullptr) {
    if (described.encoder_m <= 0.0) described.encoder_m = 1.0 / info->counts_per_metre[axis];
    described.force_limit_n = described.force_limit_n > 0.0
                                  ? std::min(described.force_limit_n, info->maximum_force_n[axis])
                                  : info->maximum_force_n[axis];
  }
  described.force_limit_n = whole_millinewtons(described.force_limit_n);
  if (described.max_force_rate_n_per_s <= 0.0 && described.force_limit_n > kFreeRiseN) {
    described.max_force_rate_n_per_s = described.force_limit_n / kForceRiseS;
  }
  return described;
}

std::string name_of(const Listing& listing, const ImpulseEngineOptions& options) {
  if (!options.name.empty()) return options.name;
  if (!listing.product.empty()) return listing.product;
  return "haptic device at " + listing.path;
}

}  // namespace

bool fits(const Listing& listing, const ImpulseEngineOptions& options) {
  if (!may_be_haptic(listing)) return false;
  if (!options.path.empty() && listing.path != options.path) return false;
  if (!options.serial.empty() && listing.serial != options.serial) return false;
  if (options.vendor_id != 0) {
    return listing.vendor_id == options.vendor_id && listing.product_id == options.product_id;
  }
  return !options.path.empty() || is_of_the_protocol(listing);
}

std::optional<Listing> choose(const std::vector<Listing>& listings,
                              const ImpulseEngineOptions& options,
                              const std::optional<Listing>& known) {
  const auto first = [&](const auto& wanted) -> std::optional<Listing> {
    const auto found = std::find_if(listings.begin(), listings.end(), wanted);
    return found == listings.end() ? std::nullopt : std::optional(*found);
  };
  if (!known) return first([&](const Listing& listing) { return fits(listing, options); });
  auto same_place = first([&](const Listing& listing) {
    return is_same_device(listing, *known) && listing.path == known->path;
  });
  if (same_place) return same_place;
  if (known->serial.empty() && !options.path.empty()) return std::nullopt;
  return first([&](const Listing& listing) { return is_same_device(listing, *known); });
}

Result<DeviceDescription> describe(const Listing& listing, Handle& handle,
                                   const ImpulseEngineOptions& options) {
  std::array<std::uint8_t, kFeatureRoom> room{};
  std::size_t size = 0;
  for (int i = 0; i < kAsks && size == 0; ++i) {
    size = std::min(handle.get_feature(kInfoId, room), room.size());
  }
  const auto bytes = std::span<const std::uint8_t>(room).first(size);
  std::optional<InfoReport> info;
  if (size > 0) {
    const Decoded<InfoReport> decoded = decode_info(bytes);
    if (decoded.report() == nullptr) return not_understood(listing, *decoded.refusal(), bytes);
    info = *decoded.report();
  } else if (!options.axes[0]) {
    return refused(listing,
                   "does not describe itself (no INFO report): name a device file that does");
  }
  DeviceDescription described;
  described.name = name_of(listing, options);
  described.axes = info ? info->axes : (options.axes[1] ? 2 : 1);
  for (std::size_t axis = 0; axis < described.axes; ++axis) {
    described.axis[axis] = axis_of(info ? &*info : nullptr, axis, options.axes[axis]);
  }
  handle.complete(described.axis[0]);
  described.describes_itself = info.has_value();
  described.firmware = info ? info->firmware : 0;
  return described;
}

}  // namespace hapticwall::device::hid
