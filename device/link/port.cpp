#include "device/link/port.h"

#include <algorithm>
#include <array>

namespace hapticwall::device::hid {

std::string obstacle_text(const std::string& path, Obstacle obstacle) {
  // Texts in the order of Obstacle.
  constexpr std::array kTexts{
      "",
      " cannot be opened: permission denied; install the udev rule 70-hapticwall.rules, then plug "
      "the device in again",
      " is in use: close the program that uses it",
      " is no longer connected: plug the device in again"};
  return obstacle == Obstacle::kNone ? "" : path + kTexts.at(static_cast<std::size_t>(obstacle));
}

std::string in_use_text(const std::string& path, const std::string& host) {
  return path + " is in use by " + host + ": end that session first";
}

bool may_be_haptic(const Listing& listing) {
  if (listing.usage_page == 0) return true;
  return listing.usage_page == kUsagePage && (listing.usage == kUsage || listing.usage == 0);
}

std::vector<Listing> each_path_once(const std::vector<Listing>& listings) {
  std::vector<Listing> once;
  for (const Listing& listing : listings) {
    const auto same = std::find_if(once.begin(), once.end(), [&](const Listing& earlier) {
      return earlier.path == listing.path;
    });
    if (same == once.end()) {
      once.push_back(listing);
    } else if (!may_be_haptic(*same) && may_be_haptic(listing)) {
      *same = listing;
    }
  }
  return once;
}

}  // namespace hapticwall::device::hid
