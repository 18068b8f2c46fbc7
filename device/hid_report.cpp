#include "device/hid_report.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

namespace hapticwall::device::hid {
namespace {

constexpr std::size_t kCrcAt = kReportBytes - sizeof(std::uint16_t);
constexpr double kMillinewtonsPerNewton = 1e3;
constexpr double kMillivoltsPerVolt = 1e3;
constexpr double kCentidegreesPerDegree = 1e2;
constexpr std::uint8_t kMostMinor = 0x0F;

// Offsets, as docs/hid-protocol.md has them.
namespace state_at {
constexpr std::size_t kProtocol = 1;
constexpr std::size_t kSequence = 2;
constexpr std::size_t kTime = 4;
constexpr std::size_t kPosition = 8;
constexpr std::size_t kVelocity = 16;
constexpr std::size_t kForce = 24;
constexpr std::size_t kStatus = 28;
constexpr std::size_t kAcknowledgedSequence = 30;
constexpr std::size_t kAcknowledgedTime = 32;
constexpr std::size_t kButtons = 36;
constexpr std::size_t kFault = 37;
constexpr std::size_t kTemperature = 38;
constexpr std::size_t kSupply = 40;
constexpr std::size_t kRejected = 42;
constexpr std::size_t kReserved = 44;
}  // namespace state_at

namespace force_at {
constexpr std::size_t kFlags = 1;
constexpr std::size_t kSequence = 2;
constexpr std::size_t kEchoedSequence = 4;
constexpr std::size_t kTimeToLive = 6;
constexpr std::size_t kForce = 8;
constexpr std::size_t kReserved = 12;
constexpr std::uint8_t kEnable = 1;
constexpr std::uint8_t kClearFaults = 2;
constexpr std::uint8_t kKnownFlags = kEnable | kClearFaults;
}  // namespace force_at

namespace info_at {
constexpr std::size_t kProtocol = 1;
constexpr std::size_t kAxes = 2;
constexpr std::size_t kFlags = 3;
constexpr std::size_t kFirmware = 4;
constexpr std::size_t kCountsPerMetre = 8;
constexpr std::size_t kMaximumForce = 16;
constexpr std::size_t kTick = 20;
constexpr std::size_t kWatchdog = 22;
constexpr std::size_t kReserved = 24;
}  // namespace info_at

// The nearest whole number of the type, its ends where it is beyond them; 0 for NaN.
template <std::integral T>
T saturated(double value) {
  if (std::isnan(value)) return 0;
  constexpr auto kLeast = static_cast<double>(std::numeric_limits<T>::min());
  constexpr auto kMost = static_cast<double>(std::numeric_limits<T>::max());
  return static_cast<T>(std::clamp(std::round(value), kLeast, kMost));
}

// Symmetric, and 0 for what is not finite: an infinite force is a mistake, not a strong force.
std::int16_t millinewtons(double force_n) {
  if (!std::isfinite(force_n)) return 0;
  return saturated<std::int16_t>(std::clamp(force_n, -kLargestForceN, kLargestForceN) *
                                 kMillinewtonsPerNewton);
}

double newtons(std::int16_t millinewtons) { return millinewtons / kMillinewtonsPerNewton; }

// Little endian, whatever the machine.
template <std::integral T>
void put(ReportBytes& bytes, std::size_t at, T value) {
  using Bits = std::make_unsigned_t<T>;
  const auto bits = static_cast<std::uint32_t>(static_cast<Bits>(value));
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(bits >> (8 * i));
  }
}

// Precondition: `bytes` has kReportBytes.
template <std::integral T>
T get(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bits |= static_cast<std::uint32_t>(bytes[at + i]) << (8 * i);
  }
  return static_cast<T>(static_cast<std::make_unsigned_t<T>>(bits));
}

std::uint8_t protocol_byte(std::uint8_t minor) {
  return static_cast<std::uint8_t>(kProtocolMajor << 4U | std::min(minor, kMostMinor));
}
std::uint8_t major_of(std::uint8_t protocol) { return protocol >> 4U; }
std::uint8_t minor_of(std::uint8_t protocol) { return protocol & kMostMinor; }

bool only_zeros(std::span<const std::uint8_t> bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte == 0; });
}

// What all reports share; true where there is nothing against it.
bool sound(std::span<const std::uint8_t> bytes, std::uint8_t id, Refusal& refusal) {
  refusal = Refusal::kLength;
  if (bytes.size() != kReportBytes) return false;
  refusal = Refusal::kId;
  if (bytes.front() != id) return false;
  refusal = Refusal::kCrc;
  return crc16(bytes.first(kCrcAt)) == get<std::uint16_t>(bytes, kCrcAt);
}

bool reserved_is_zero(std::span<const std::uint8_t> bytes, std::size_t from) {
  return only_zeros(bytes.subspan(from, kCrcAt - from));
}

// -32768 mN is none: it has no counterpart of the other sign.
bool are_forces(const std::array<double, kMostAxes>& force_n) {
  return std::all_of(force_n.begin(), force_n.end(),
                     [](double axis_n) { return axis_n >= -kLargestForceN; });
}

bool makes_sense(const InfoReport& info) {
  if (info.axes < 1 || info.axes > kMostAxes || info.tick_us == 0) return false;
  if (info.watchdog_ms < 1 || info.watchdog_ms > kLongestTimeToLiveMs) return false;
  for (std::size_t axis = 0; axis < kMostAxes; ++axis) {
    const bool there = axis < info.axes;
    if ((info.counts_per_metre[axis] > 0) != there || info.counts_per_metre[axis] < 0) return false;
    if ((info.maximum_force_n[axis] > 0.0) != there || info.maximum_force_n[axis] < 0.0) {
      return false;
    }
  }
  return true;
}

constexpr std::uint16_t kCrcPolynomial = 0x1021;
constexpr std::uint16_t kCrcBegin = 0xFFFF;

constexpr std::array<std::uint16_t, 256> make_crc_table() {
  constexpr std::uint32_t kTop = 0x8000;
  std::array<std::uint16_t, 256> table{};
  for (std::size_t byte = 0; byte < table.size(); ++byte) {
    auto rest = static_cast<std::uint32_t>(byte << 8U);
    for (int bit = 0; bit < 8; ++bit) {
      rest = (rest & kTop) != 0 ? (rest << 1U) ^ kCrcPolynomial : rest << 1U;
    }
    table[byte] = static_cast<std::uint16_t>(rest);
  }
  return table;
}
constexpr std::array<std::uint16_t, 256> kCrcTable = make_crc_table();

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
  std::uint16_t crc = kCrcBegin;
  for (const std::uint8_t byte : bytes) {
    const auto index = static_cast<std::size_t>(crc >> 8U) ^ byte;
    crc = static_cast<std::uint16_t>(static_cast<std::uint32_t>(crc) << 8U ^ kCrcTable[index]);
  }
  return crc;
}

void seal(ReportBytes& bytes) { put(bytes, kCrcAt, crc16(std::span(bytes).first(kCrcAt))); }

std::int32_t saturated_count(double value) { return saturated<std::int32_t>(value); }

std::string_view refusal_text(Refusal refusal) {
  switch (refusal) {
    case Refusal::kLength:
      return "not 64 bytes";
    case Refusal::kId:
      return "another report id";
    case Refusal::kCrc:
      return "wrong CRC";
    case Refusal::kProtocol:
      return "another major version of the protocol";
    case Refusal::kReserved:
      return "reserved bits are not zero";
    case Refusal::kValue:
      break;
  }
  return "a value out of range";
}

Decoded<StateReport> decode_state(std::span<const std::uint8_t> bytes) {
  namespace at = state_at;
  Refusal refusal{};
  if (!sound(bytes, kStateId, refusal)) return refusal;
  if (major_of(bytes[at::kProtocol]) != kProtocolMajor) return Refusal::kProtocol;
  StateReport state;
  state.minor_version = minor_of(bytes[at::kProtocol]);
  state.sequence = get<std::uint16_t>(bytes, at::kSequence);
  state.time_us = get<std::uint32_t>(bytes, at::kTime);
  for (std::size_t axis = 0; axis < kMostAxes; ++axis) {
    state.position_counts[axis] =
        get<std::int32_t>(bytes, at::kPosition + axis * sizeof(std::int32_t));
    state.velocity_counts_per_s[axis] =
        get<std::int32_t>(bytes, at::kVelocity + axis * sizeof(std::int32_t));
    state.applied_force_n[axis] =
        newtons(get<std::int16_t>(bytes, at::kForce + axis * sizeof(std::int16_t)));
  }
  state.status = get<std::uint16_t>(bytes, at::kStatus);
  state.acknowledged_sequence = get<std::uint16_t>(bytes, at::kAcknowledgedSequence);
  state.acknowledged_time_us = get<std::uint32_t>(bytes, at::kAcknowledgedTime);
  state.buttons = bytes[at::kButtons];
  state.fault = bytes[at::kFault];
  state.temperature_c = get<std::int16_t>(bytes, at::kTemperature) / kCentidegreesPerDegree;
  state.supply_v = get<std::uint16_t>(bytes, at::kSupply) / kMillivoltsPerVolt;
  state.rejected_commands = get<std::uint16_t>(bytes, at::kRejected);
  const bool unknown_status = (state.status & ~std::uint32_t{kStatusKnown}) != 0;
  if (state.minor_version <= kProtocolMinor &&
      (unknown_status || !reserved_is_zero(bytes, at::kReserved))) {
    return Refusal::kReserved;
  }
  state.status &= kStatusKnown;
  if (!are_forces(state.applied_force_n)) return Refusal::kValue;
  return state;
}

ReportBytes encode_state(const StateReport& state) {
  namespace at = state_at;
  ReportBytes bytes{};
  bytes[0] = kStateId;
  bytes[at::kProtocol] = protocol_byte(state.minor_version);
  put(bytes, at::kSequence, state.sequence);
  put(bytes, at::kTime, state.time_us);
  for (std::size_t axis = 0; axis < kMostAxes; ++axis) {
    put(bytes, at::kPosition + axis * sizeof(std::int32_t), state.position_counts[axis]);
    put(bytes, at::kVelocity + axis * sizeof(std::int32_t), state.velocity_counts_per_s[axis]);
    put(bytes, at::kForce + axis * sizeof(std::int16_t), millinewtons(state.applied_force_n[axis]));
  }
  put(bytes, at::kStatus, static_cast<std::uint16_t>(state.status & kStatusKnown));
  put(bytes, at::kAcknowledgedSequence, state.acknowledged_sequence);
  put(bytes, at::kAcknowledgedTime, state.acknowledged_time_us);
  bytes[at::kButtons] = state.buttons;
  bytes[at::kFault] = state.fault;
  put(bytes, at::kTemperature,
      saturated<std::int16_t>(state.temperature_c * kCentidegreesPerDegree));
  put(bytes, at::kSupply, saturated<std::uint16_t>(state.supply_v * kMillivoltsPerVolt));
  put(bytes, at::kRejected, state.rejected_commands);
  seal(bytes);
  return bytes;
}

Decoded<ForceReport> decode_force(std::span<const std::uint8_t> bytes) {
  namespace at = force_at;
  Refusal refusal{};
  if (!sound(bytes, kForceId, refusal)) return refusal;
  const std::uint8_t flags = bytes[at::kFlags];
  if ((flags & ~at::kKnownFlags) != 0 || !reserved_is_zero(bytes, at::kReserved)) {
    return Refusal::kReserved;
  }
  ForceReport force;
  force.enable = (flags & at::kEnable) != 0;
  force.clear_faults = (flags & at::kClearFaults) != 0;
  force.sequence = get<std::uint16_t>(bytes, at::kSequence);
  force.echoed_state_sequence = get<std::uint16_t>(bytes, at::kEchoedSequence);
  force.time_to_live_ms = get<std::uint16_t>(bytes, at::kTimeToLive);
  for (std::size_t axis = 0; axis < kMostAxes; ++axis) {
    force.force_n[axis] =
        newtons(get<std::int16_t>(bytes, at::kForce + axis * sizeof(std::int16_t)));
  }
  if (force.time_to_live_ms < 1 || force.time_to_live_ms > kLongestTimeToLiveMs) {
    return Refusal::kValue;
  }
  if (!are_forces(force.force_n)) return Refusal::kValue;
  return force;
}

ReportBytes encode_force(const ForceReport& force) {
  namespace at = force_at;
  ReportBytes bytes{};
  bytes[0] = kForceId;
  bytes[at::kFlags] = static_cast<std::uint8_t>((force.enable ? at::kEnable : 0U) |
                                                (force.clear_faults ? at::kClearFaults : 0U));
  put(bytes, at::kSequence, force.sequence);
  put(bytes, at::kEchoedSequence, force.echoed_state_sequence);
  put(bytes, at::kTimeToLive,
      std::clamp(force.time_to_live_ms, std::uint16_t{1}, kLongestTimeToLiveMs));
  for (std::size_t axis = 0; axis < kMostAxes; ++axis) {
    put(bytes, at::kForce + axis * sizeof(std::int16_t), millinewtons(force.force_n[axis]));
  }
  seal(bytes);
  return bytes;
}

Decoded<InfoReport> decode_info(std::span<const std::uint8_t> bytes) {
  namespace at = info_at;
  Refusal refusal{};
  if (!sound(bytes, kInfoId, refusal)) return refusal;
  if (major_of(bytes[at::kProtocol]) != kProtocolMajor) return Refusal::kProtocol;
  InfoReport info;
  info.minor_version = minor_of(bytes[at::kProtocol]);
  info.axes = bytes[at::kAxes];
  info.flags = bytes[at::kFlags];
  info.firmware = get<std::uint32_t>(bytes, at::kFirmware);
  for (std::size_t axis = 0; axis < kMostAxes; ++axis) {
    info.counts_per_metre[axis] =
        get<std::int32_t>(bytes, at::kCountsPerMetre + axis * sizeof(std::int32_t));
    info.maximum_force_n[axis] =
        newtons(get<std::int16_t>(bytes, at::kMaximumForce + axis * sizeof(std::int16_t)));
  }
  info.tick_us = get<std::uint16_t>(bytes, at::kTick);
  info.watchdog_ms = get<std::uint16_t>(bytes, at::kWatchdog);
  const bool unknown_flags = (info.flags & ~kInfoKnown) != 0;
  if (info.minor_version <= kProtocolMinor &&
      (unknown_flags || !reserved_is_zero(bytes, at::kReserved))) {
    return Refusal::kReserved;
  }
  info.flags &= kInfoKnown;
  if (!makes_sense(info)) return Refusal::kValue;
  return info;
}

ReportBytes encode_info(const InfoReport& info) {
  namespace at = info_at;
  ReportBytes bytes{};
  bytes[0] = kInfoId;
  bytes[at::kProtocol] = protocol_byte(info.minor_version);
  bytes[at::kAxes] = info.axes;
  bytes[at::kFlags] = info.flags & kInfoKnown;
  put(bytes, at::kFirmware, info.firmware);
  for (std::size_t axis = 0; axis < kMostAxes; ++axis) {
    put(bytes, at::kCountsPerMetre + axis * sizeof(std::int32_t), info.counts_per_metre[axis]);
    put(bytes, at::kMaximumForce + axis * sizeof(std::int16_t),
        millinewtons(info.maximum_force_n[axis]));
  }
  put(bytes, at::kTick, info.tick_us);
  put(bytes, at::kWatchdog, info.watchdog_ms);
  seal(bytes);
  return bytes;
}

}  // namespace hapticwall::device::hid
