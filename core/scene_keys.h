// The keys of a scene file as data: name, unit, range, whether it must be there, and where its
// value lives. Parsing, --set, validation, sidecars and the window's sliders all read these tables.
// (`[algorithm]` keys come from the algorithms themselves: algorithm_parameters().)
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "core/scene.h"

namespace hapticwall {

struct ValueRange {
  double minimum = 0.0;
  double maximum = 0.0;
  bool minimum_excluded = false;

  [[nodiscard]] bool contains(double value) const {  // false for NaN
    return (minimum_excluded ? value > minimum : value >= minimum) && value <= maximum;
  }
};

// A number as people write it in a message: shortest that reads back the same, 1e9 and 1e-6.
[[nodiscard]] std::string number_text(double value);

// A number of the table Owner.
template <typename Owner>
struct NumberKey {
  std::string_view key;
  std::string_view unit;
  ValueRange range;
  bool required = false;  // in a scene file
  std::variant<double Owner::*, std::optional<double> Owner::*, std::optional<int> Owner::*> member;

  // A key that counts: it takes whole numbers only.
  [[nodiscard]] bool whole() const {
    return std::holds_alternative<std::optional<int> Owner::*>(member);
  }
  [[nodiscard]] std::optional<double> get(const Owner& owner) const {
    return std::visit([&](auto place) { return std::optional<double>(owner.*place); }, member);
  }
  // A number that does not fit a counting key becomes the nearest that does; validate() then
  // judges it.
  void set(Owner& owner, double value) const {
    if (whole()) {
      constexpr double kMost = std::numeric_limits<int>::max();
      owner.*std::get<std::optional<int> Owner::*>(member) =
          static_cast<int>(std::clamp(std::round(value), -kMost, kMost));
    } else if (const auto* plain = std::get_if<double Owner::*>(&member)) {
      owner.** plain = value;
    } else {
      owner.*std::get<std::optional<double> Owner::*>(member) = value;
    }
  }
};

[[nodiscard]] std::span<const NumberKey<Scene>> scene_number_keys();                // duration_s
[[nodiscard]] std::span<const NumberKey<SamplingSettings>> sampling_number_keys();  // [sampling]
[[nodiscard]] std::span<const NumberKey<DeviceSettings>> device_number_keys();      // [device]
[[nodiscard]] std::span<const NumberKey<HandSettings>> hand_number_keys();  // [hand], less path
[[nodiscard]] std::span<const NumberKey<WallSettings>> wall_number_keys();  // [[wall]]

inline constexpr std::size_t kMaximumPathPoints = 10000;
inline constexpr ValueRange kPathTimeRange{0.0, 1e6};
inline constexpr ValueRange kPositionRange{-1.0, 1.0};

}  // namespace hapticwall
