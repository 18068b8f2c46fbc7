#include "device/link/report.h"

#include <algorithm>
#include <cmath>
#include <concepts>

#include "device/link/little_endian.h"

namespace hapticwall::device::hid {
namespace {

constexpr std::size_t kCrcAt = kReportBytes - sizeof(std::uint16_t);
constexpr std::size_t kVersionAt = 1;  // offset in STATE and INFO
constexpr double kMillivoltsPerVolt = 1e3;
constexpr double kCentidegreesPerDegree = 1e2;
constexpr std::uint8_t kMaxMinor = 0x0F;
constexpr std::uint8_t kEnableFlag = 1;  // flag in FORCE
constexpr std::uint8_t kClearFaultsFlag = 2;
constexpr std::uint8_t kKnownForceFlags = kEnableFlag | kClearFaultsFlag;

// First reserved byte of each report.
constexpr std::size_t kStateReserved = 44;
constexpr std::size_t kForceReserved = 12;
constexpr std::size_t kInfoReserved = 24;

// Clamped symmetrically. A force that is not finite becomes 0: it is a mistake, not a strong force.
std::int16_t millinewtons(double force_n) {
  if (!std::isfinite(force_n)) return 0;
  return saturated<std::int16_t>(std::clamp(force_n, -kMaxForceN, kMaxForceN) * kStepsPerNewton);
}

// Writes fields into the bytes of a report.
struct FieldWriter {
  ReportBytes& bytes;

  template <std::integral T>
  void field(std::size_t at, const T& value) {
    put(bytes, at, value);
  }
  template <std::integral T>
  void scaled(std::size_t at, const double& value, double steps_per_unit) {
    put(bytes, at, saturated<T>(value * steps_per_unit));
  }
  void force(std::size_t at, const double& force_n) { put(bytes, at, millinewtons(force_n)); }
};

// Reads them. Precondition: kReportBytes bytes.
struct FieldReader {
  std::span<const std::uint8_t> bytes;

  template <std::integral T>
  void field(std::size_t at, T& value) {
    value = get<T>(bytes, at);
  }
  template <std::integral T>
  void scaled(std::size_t at, double& value, double steps_per_unit) {
    value = get<T>(bytes, at) / steps_per_unit;
  }
  void force(std::size_t at, double& force_n) {
    scaled<std::int16_t>(at, force_n, kStepsPerNewton);
  }
};

// The offsets of docs/hid-protocol.md, for both directions. `version`, `flags`: the packed bytes.
template <typename Fields, typename Report, typename Byte>
void state_fields(Fields fields, Report& state, Byte& version) {
  fields.field(kVersionAt, version);
  fields.field(2, state.sequence);
  fields.field(4, state.time_us);
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
    fields.field(8 + 4 * axis, state.position_counts[axis]);
    fields.field(16 + 4 * axis, state.velocity_counts_per_s[axis]);
    fields.force(24 + 2 * axis, state.applied_force_n[axis]);
  }
  fields.field(28, state.status);
  fields.field(30, state.acknowledged_sequence);
  fields.field(32, state.acknowledged_time_us);
  fields.field(36, state.buttons);
  fields.field(37, state.fault);
  fields.template scaled<std::int16_t>(38, state.temperature_c, kCentidegreesPerDegree);
  fields.template scaled<std::uint16_t>(40, state.supply_v, kMillivoltsPerVolt);
  fields.field(42, state.rejected_commands);
}

template <typename Fields, typename Report, typename Byte>
void force_fields(Fields fields, Report& force, Byte& flags) {
  fields.field(1, flags);
  fields.field(2, force.sequence);
  fields.field(4, force.echoed_state_sequence);
  fields.field(6, force.time_to_live_ms);
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
    fields.force(8 + 2 * axis, force.force_n[axis]);
  }
}

template <typename Fields, typename Report, typename Byte>
void info_fields(Fields fields, Report& info, Byte& version) {
  fields.field(kVersionAt, version);
  fields.field(2, info.axes);
  fields.field(3, info.flags);
  fields.field(4, info.firmware);
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
    fields.field(8 + 4 * axis, info.counts_per_metre[axis]);
    fields.force(16 + 2 * axis, info.maximum_force_n[axis]);
  }
  fields.field(20, info.tick_us);
  fields.field(22, info.watchdog_ms);
}

std::uint8_t version_of(std::uint8_t minor) {
  return static_cast<std::uint8_t>(kProtocolMajor << 4U | std::min(minor, kMaxMinor));
}

// Checks the parts that all reports share: length, id and CRC.
bool sound(std::span<const std::uint8_t> bytes, std::uint8_t id, Refusal& refusal) {
  refusal = Refusal::kLength;
  if (bytes.size() != kReportBytes) return false;
  refusal = Refusal::kId;
  if (bytes.front() != id) return false;
  refusal = Refusal::kCrc;
  return crc16(bytes.first(kCrcAt)) == get<std::uint16_t>(bytes, kCrcAt);
}

bool reserved_is_zero(std::span<const std::uint8_t> bytes, std::size_t from) {
  const auto reserved = bytes.subspan(from, kCrcAt - from);
  return std::all_of(reserved.begin(), reserved.end(), [](std::uint8_t byte) { return byte == 0; });
}

// True if the version is ours, and, unless it is newer, everything reserved is zero.
bool is_compatible(std::span<const std::uint8_t> bytes, bool has_unknown_flags,
                   std::size_t reserved_from, Refusal& refusal) {
  refusal = Refusal::kProtocol;
  if (bytes[kVersionAt] >> 4U != kProtocolMajor) return false;
  refusal = Refusal::kReserved;
  return (bytes[kVersionAt] & kMaxMinor) > kProtocolMinor ||
         (!has_unknown_flags && reserved_is_zero(bytes, reserved_from));
}

// -32768 mN is invalid: it has no positive counterpart.
bool are_forces(const std::array<double, kMaxAxes>& force_n) {
  return std::all_of(force_n.begin(), force_n.end(),
                     [](double axis_n) { return axis_n >= -kMaxForceN; });
}

bool makes_sense(const InfoReport& info) {
  if (info.axes < 1 || info.axes > kMaxAxes) return false;
  if (info.tick_us < 1 || info.tick_us > kMaxTickUs) return false;
  if (info.watchdog_ms < 1 || info.watchdog_ms > kMaxTimeToLiveMs) return false;
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
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

Decoded<StateReport> decode_state(std::span<const std::uint8_t> bytes) {
  Refusal refusal{};
  if (!sound(bytes, kStateId, refusal)) return refusal;
  StateReport state;
  std::uint8_t version = 0;
  state_fields(FieldReader{bytes}, state, version);
  state.minor_version = version & kMaxMinor;
  const bool unknown_status = (state.status & ~std::uint32_t{kStatusKnown}) != 0;
  if (!is_compatible(bytes, unknown_status, kStateReserved, refusal)) return refusal;
  state.status &= kStatusKnown;
  if (!are_forces(state.applied_force_n)) return Refusal::kValue;
  return state;
}

ReportBytes encode_state(const StateReport& state) {
  StateReport known = state;
  known.status &= kStatusKnown;
  const std::uint8_t version = version_of(state.minor_version);
  ReportBytes bytes{kStateId};
  state_fields(FieldWriter{bytes}, known, version);
  seal(bytes);
  return bytes;
}

Decoded<ForceReport> decode_force(std::span<const std::uint8_t> bytes) {
  Refusal refusal{};
  if (!sound(bytes, kForceId, refusal)) return refusal;
  ForceReport force;
  std::uint8_t flags = 0;
  force_fields(FieldReader{bytes}, force, flags);
  if ((flags & ~kKnownForceFlags) != 0 || !reserved_is_zero(bytes, kForceReserved)) {
    return Refusal::kReserved;
  }
  force.enable = (flags & kEnableFlag) != 0;
  force.clear_faults = (flags & kClearFaultsFlag) != 0;
  const bool lives = force.time_to_live_ms >= 1 && force.time_to_live_ms <= kMaxTimeToLiveMs;
  if (lives && are_forces(force.force_n)) return force;
  if (force.enable) return Refusal::kValue;
  // A command without enable removes the force, whatever these ignored fields hold.
  force.time_to_live_ms = kUsualTimeToLiveMs;
  force.force_n = {};
  return force;
}

ReportBytes encode_force(const ForceReport& force) {
  ForceReport valid = force;
  valid.time_to_live_ms = std::clamp(force.time_to_live_ms, std::uint16_t{1}, kMaxTimeToLiveMs);
  const auto flags = static_cast<std::uint8_t>((force.enable ? kEnableFlag : 0U) |
                                               (force.clear_faults ? kClearFaultsFlag : 0U));
  ReportBytes bytes{kForceId};
  force_fields(FieldWriter{bytes}, valid, flags);
  seal(bytes);
  return bytes;
}

Decoded<InfoReport> decode_info(std::span<const std::uint8_t> bytes) {
  Refusal refusal{};
  if (!sound(bytes, kInfoId, refusal)) return refusal;
  InfoReport info;
  std::uint8_t version = 0;
  info_fields(FieldReader{bytes}, info, version);
  info.minor_version = version & kMaxMinor;
  const bool unknown_flags = (info.flags & ~kInfoKnown) != 0;
  if (!is_compatible(bytes, unknown_flags, kInfoReserved, refusal)) return refusal;
  info.flags &= kInfoKnown;
  if (!makes_sense(info)) return Refusal::kValue;
  return info;
}

ReportBytes encode_info(const InfoReport& info) {
  InfoReport known = info;
  known.flags &= kInfoKnown;
  const std::uint8_t version = version_of(info.minor_version);
  ReportBytes bytes{kInfoId};
  info_fields(FieldWriter{bytes}, known, version);
  seal(bytes);
  return bytes;
}

}  // namespace hapticwall::device::hid
