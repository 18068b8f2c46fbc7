#include "device/hid_match.h"

#include <algorithm>

namespace hapticwall::device::hid {
namespace {

bool is_of_the_protocol(const Listing& listing) {
  const bool test_numbers =
      listing.vendor_id == kTestVendorId && listing.product_id == kTestProductId;
  return may_be_haptic(listing) && (listing.usage_page != 0 || test_numbers);
}

bool is_same_device(const Listing& listing, const Listing& known) {
  return may_be_haptic(listing) && listing.vendor_id == known.vendor_id &&
         listing.product_id == known.product_id && listing.serial == known.serial;
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

}  // namespace hapticwall::device::hid
