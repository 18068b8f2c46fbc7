// The reports of the open HID protocol 1.0 (docs/hid-protocol.md) as values and as bytes. No I/O.
//
// Everything here is realtime-safe: nothing allocates, locks, throws or asks the operating system.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

namespace hapticwall::device::hid {

// Every report, its id included: one packet of a full-speed interrupt endpoint.
inline constexpr std::size_t kReportBytes = 64;
using ReportBytes = std::array<std::uint8_t, kReportBytes>;

inline constexpr std::uint8_t kStateId = 0x01;  // device to host, input
inline constexpr std::uint8_t kForceId = 0x02;  // host to device, output
inline constexpr std::uint8_t kInfoId = 0x03;   // feature

inline constexpr std::uint8_t kProtocolMajor = 1;
inline constexpr std::uint8_t kProtocolMinor = 0;

inline constexpr std::uint16_t kUsagePage = 0xFF48;
inline constexpr std::uint16_t kUsage = 0x0001;
// For experiments on a desk; a device that leaves it needs numbers of its own.
inline constexpr std::uint16_t kTestVendorId = 0x1209;
inline constexpr std::uint16_t kTestProductId = 0x0001;

inline constexpr std::size_t kMostAxes = 2;
inline constexpr std::uint16_t kUsualTimeToLiveMs = 20;
inline constexpr std::uint16_t kLongestTimeToLiveMs = 100;
inline constexpr double kLargestForceN = 32.767;  // that a report can carry, either way

// The report descriptor that a device of protocol 1.0 gives. A test reads it item by item.
// clang-format off
inline constexpr auto kReportDescriptor = std::to_array<std::uint8_t>({
    0x06, 0x48, 0xFF,  // usage page (vendor 0xFF48)
    0x09, 0x01,        // usage (1)
    0xA1, 0x01,        // collection (application)
    0x15, 0x00,        //   logical minimum (0)
    0x26, 0xFF, 0x00,  //   logical maximum (255)
    0x75, 0x08,        //   report size (8 bits)
    0x95, 0x3F,        //   report count (63, the id comes on top)
    0x85, kStateId,    //   report id
    0x09, 0x02,        //   usage (2)
    0x81, 0x02,        //   input (data, variable, absolute)
    0x85, kForceId,    //   report id
    0x09, 0x03,        //   usage (3)
    0x91, 0x02,        //   output (data, variable, absolute)
    0x85, kInfoId,     //   report id
    0x09, 0x04,        //   usage (4)
    0xB1, 0x02,        //   feature (data, variable, absolute)
    0xC0,              // end collection
});
// clang-format on

enum StatusFlag : std::uint16_t {
  kStatusEnabled = 1,
  kStatusCalibrated = 2,
  kStatusWatchdog = 4,
  kStatusEmergencyStop = 8,
  kStatusSaturated = 16,
  kStatusOverTemperature = 32,
  kStatusOverCurrent = 64,
  kStatusEncoderFault = 128,
  kStatusCommandRejected = 256,
  kStatusReportOverrun = 512,
};
// Those that stop the force until they are cleared.
inline constexpr std::uint16_t kStatusFaults = kStatusWatchdog | kStatusEmergencyStop |
                                               kStatusOverTemperature | kStatusOverCurrent |
                                               kStatusEncoderFault;
inline constexpr std::uint16_t kStatusKnown = 0x03FF;  // by protocol 1.0

// What struck first since the faults were cleared. From kFirstOwnFault on: the device's own.
enum FaultCode : std::uint8_t {
  kNoFault = 0,
  kFaultWatchdog = 1,
  kFaultEmergencyStop = 2,
  kFaultOverTemperature = 3,
  kFaultOverCurrent = 4,
  kFaultEncoder = 5,
};
inline constexpr std::uint8_t kFirstOwnFault = 128;

// Counts and forces have one sense: a positive force pushes towards growing counts.
struct StateReport {
  std::uint8_t minor_version = kProtocolMinor;  // 0 to 15
  std::uint16_t sequence = 0;                   // one up every tick, sent or not
  std::uint32_t time_us = 0;                    // latched with the encoders; wraps
  std::array<std::int32_t, kMostAxes> position_counts{};
  std::array<std::int32_t, kMostAxes> velocity_counts_per_s{};
  std::array<double, kMostAxes> applied_force_n{};  // in steps of a millinewton
  std::uint16_t status = 0;                         // StatusFlag
  std::uint16_t acknowledged_sequence = 0;          // of the last command accepted
  std::uint32_t acknowledged_time_us = 0;           // when it came in, by the device's clock
  std::uint8_t buttons = 0;
  std::uint8_t fault = kNoFault;
  double temperature_c = 0.0;  // in steps of 0.01
  double supply_v = 0.0;       // in steps of 0.001
  std::uint16_t rejected_commands = 0;

  friend bool operator==(const StateReport&, const StateReport&) = default;
};

struct ForceReport {
  bool enable = false;
  bool clear_faults = false;
  std::uint16_t sequence = 0;
  std::uint16_t echoed_state_sequence = 0;  // of the state that the force was computed from
  std::uint16_t time_to_live_ms = kUsualTimeToLiveMs;  // 1 to kLongestTimeToLiveMs
  std::array<double, kMostAxes> force_n{};

  friend bool operator==(const ForceReport&, const ForceReport&) = default;
};

enum InfoFlag : std::uint8_t {
  kInfoMeasuresVelocity = 1,  // the velocities of STATE are filled in
  kInfoCalibrates = 2,        // count 0 is a place of the mechanism once it is calibrated
};
inline constexpr std::uint8_t kInfoKnown = 0x03;

struct InfoReport {
  std::uint8_t minor_version = kProtocolMinor;  // 0 to 15
  std::uint8_t axes = 1;                        // 1 to kMostAxes
  std::uint8_t flags = 0;                       // InfoFlag
  std::uint32_t firmware = 0;                   // the device's own numbering
  // Of an axis that there is: more than 0. Of one that there is not: 0.
  std::array<std::int32_t, kMostAxes> counts_per_metre{};
  std::array<double, kMostAxes> maximum_force_n{};
  std::uint16_t tick_us = 0;      // more than 0
  std::uint16_t watchdog_ms = 0;  // 1 to kLongestTimeToLiveMs

  friend bool operator==(const InfoReport&, const InfoReport&) = default;
};

// Why a report was not taken, in the order in which it is looked at.
enum class Refusal : std::uint8_t { kLength, kId, kCrc, kProtocol, kReserved, kValue };
[[nodiscard]] std::string_view refusal_text(Refusal refusal);

// A report, or why it is none.
template <typename Report>
class [[nodiscard]] Decoded {
 public:
  Decoded(Report report) : content_(report) {}     // NOLINT(google-explicit-constructor)
  Decoded(Refusal refusal) : content_(refusal) {}  // NOLINT(google-explicit-constructor)

  // nullptr where there is none.
  [[nodiscard]] const Report* report() const { return std::get_if<Report>(&content_); }
  [[nodiscard]] const Refusal* refusal() const { return std::get_if<Refusal>(&content_); }

 private:
  std::variant<Report, Refusal> content_;
};

// Any bytes of any number. A minor version above ours may have filled what we take for reserved:
// there it is not looked at.
Decoded<StateReport> decode_state(std::span<const std::uint8_t> bytes);
Decoded<ForceReport> decode_force(std::span<const std::uint8_t> bytes);
Decoded<InfoReport> decode_info(std::span<const std::uint8_t> bytes);

// What does not fit is saturated; a force that is not finite becomes 0. Whatever goes in, what
// comes out can be decoded, but for an InfoReport whose numbers make no sense.
[[nodiscard]] ReportBytes encode_state(const StateReport& state);
[[nodiscard]] ReportBytes encode_force(const ForceReport& force);
[[nodiscard]] ReportBytes encode_info(const InfoReport& info);

// CRC-16/CCITT-FALSE: polynomial 0x1021, begins with 0xFFFF, nothing reflected or inverted.
[[nodiscard]] std::uint16_t crc16(std::span<const std::uint8_t> bytes);
// Writes the CRC of the bytes before it into the last two.
void seal(ReportBytes& bytes);

// The nearest whole number that fits, 0 for NaN.
[[nodiscard]] std::int32_t saturated_count(double value);

// How far `to` is ahead of `from`, -32768 to 32767; right while they are less than half a turn
// apart.
[[nodiscard]] constexpr int sequence_step(std::uint16_t from, std::uint16_t to) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(to - from));
}

// The same of the clock, microseconds: half a turn is 35 min 47 s.
[[nodiscard]] constexpr std::int32_t clock_step_us(std::uint32_t from_us, std::uint32_t to_us) {
  return static_cast<std::int32_t>(to_us - from_us);
}

// A clock that does not wrap, from one that does: `before_us` moved to the nearest instant at which
// the device's clock shows `clock_us`.
[[nodiscard]] constexpr std::int64_t unwrapped_us(std::int64_t before_us, std::uint32_t clock_us) {
  return before_us + clock_step_us(static_cast<std::uint32_t>(before_us), clock_us);
}

}  // namespace hapticwall::device::hid
