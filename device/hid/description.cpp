#include "device/hid_description.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

namespace hapticwall::device::hid {
namespace {

// More than a report, so that one that is too long shows.
constexpr std::size_t kFeatureRoom = kReportBytes + 16;
constexpr std::size_t kProtocolOffset = 1;
constexpr double kStepsPerNewton = 1000.0;
// A device that has an INFO report may fail to answer once.
constexpr int kAsks = 3;
// 8.9 N is 8900 steps, whatever its last bit says.
constexpr double kRoundingSteps = 1e-6;

// What a report can carry without going over the limit.
double whole_millinewtons(double limit_n) {
  const double steps = std::floor(std::min(limit_n, kLargestForceN) * kStepsPerNewton +  //
                                  kRoundingSteps);
  return std::max(steps, 0.0) / kStepsPerNewton;
}

Error refused(const Listing& listing, const std::string& why) {
  return Error{ErrorKind::kDevice, listing.path + " " + why};
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

AxisFigures axis_of(const InfoReport* info, std::size_t axis,
                    const std::optional<AxisFigures>& file) {
  AxisFigures figures = file.value_or(AxisFigures{});
  if (info != nullptr) {
    if (figures.encoder_m <= 0.0) figures.encoder_m = 1.0 / info->counts_per_metre[axis];
    figures.force_limit_n = figures.force_limit_n > 0.0
                                ? std::min(figures.force_limit_n, info->maximum_force_n[axis])
                                : info->maximum_force_n[axis];
  }
  figures.force_limit_n = whole_millinewtons(figures.force_limit_n);
  return figures;
}

std::string name_of(const Listing& listing, const ImpulseEngineOptions& options) {
  if (!options.name.empty()) return options.name;
  if (!listing.product.empty()) return listing.product;
  return "haptic device at " + listing.path;
}

}  // namespace

Result<DeviceFigures> describe(const Listing& listing, Handle& handle,
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
  } else if (!options.x) {
    return refused(listing,
                   "does not describe itself (no INFO report): name a device file that does");
  }
  DeviceFigures figures;
  figures.name = name_of(listing, options);
  figures.axes = info ? info->axes : (options.y ? 2 : 1);
  for (std::size_t axis = 0; axis < figures.axes; ++axis) {
    figures.axis[axis] = axis_of(info ? &*info : nullptr, axis, axis == 0 ? options.x : options.y);
  }
  figures.describes_itself = info.has_value();
  figures.firmware = info ? info->firmware : 0;
  return figures;
}

}  // namespace hapticwall::device::hid
