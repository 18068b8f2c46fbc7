// Which real device a session is for, and what is known of it beforehand.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "device/hid_report.h"

namespace hapticwall::device {

// One axis as a device file describes it; it wins over what the device says of itself, but for the
// force: there the smaller of both holds.
struct AxisFigures {
  double encoder_m = 0.0;
  double force_limit_n = 0.0;

  friend bool operator==(const AxisFigures&, const AxisFigures&) = default;
};

// A number for every axis; that of one that there is not is 0.
using AxisValues = std::array<double, hid::kMostAxes>;

struct ImpulseEngineOptions {
  std::string path;  // of a listing; empty: the first one that fits
  // Where the vendor is 0: any that has the protocol's usage page, or the protocol's test numbers.
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::string serial;  // empty: any
  std::string name;    // of the device file; empty: what the device calls itself
  std::optional<AxisFigures> x;
  std::optional<AxisFigures> y;
  // Where the handle is taken to be when the link comes up and the device says that it is not
  // calibrated (metres); one that is calibrated tells its place itself.
  AxisValues start_m{};
  // Called first on each of the threads that read and write, for those who give them a priority.
  std::function<void()> prepare_thread;
};

// Nanoseconds since a fixed instant; never goes back. Realtime-safe: yes.
using HostClock = std::function<std::int64_t()>;

}  // namespace hapticwall::device
