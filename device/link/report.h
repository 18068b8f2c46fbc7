// The reports of the open HID protocol 1.0 (docs/hid-protocol.md) as values and as bytes. No I/O.
// Realtime-safe: yes, all of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

namespace hapticwall::device::hid {

// Every report, including its id: one packet of a full-speed interrupt endpoint.
inline constexpr std::size_t kReportBytes = 64;
using ReportBytes = std::array<std::uint8_t, kReportBytes>;

inline constexpr std::uint8_t kStateId = 0x01;  // device to host, input
inline constexpr std::uint8_t kForceId = 0x02;  // host to device, output
inline constexpr std::uint8_t kInfoId = 0x03;   // feature

inline constexpr std::uint8_t kProtocolMajor = 1;
inline constexpr std::uint8_t kProtocolMinor = 0;

inline constexpr std::uint16_t kUsagePage = 0xFF48;
inline constexpr std::uint16_t kUsage = 0x0001;
// Numbers for experiments only; a device for others needs its own numbers.
inline constexpr std::uint16_t kTestVendorId = 0x1209;
inline constexpr std::uint16_t kTestProductId = 0x0001;

inline constexpr std::size_t kMaxAxes = 2;
inline constexpr std::uint16_t kUsualTimeToLiveMs = 20;
inline constexpr std::uint16_t kMaxTimeToLiveMs = 100;
inline constexpr std::uint16_t kMaxTickUs = 19'999;  // the host gives a link up after 20 ms
inline constexpr double kMaxForceN = 32.767;         // of a report, in either direction
inline constexpr double kStepsPerNewton = 1000.0;    // a report counts force in millinewtons

// The report descriptor of protocol 1.0. A test reads it item by item.
// clang-format off
inline constexpr auto kReportDescriptor = std::to_array<std::uint8_t>({
    0x06, 0x48, 0xFF,  // usage page (vendor 0xFF48)
    0x09, 0x01,        // usage (1)
    0xA1, 0x01,        // collection (application)
    0x15, 0x00,        //   logical minimum (0)
    0x26, 0xFF, 0x00,  //   logical maximum (255)
    0x75, 0x08,        //   report size (8 bits)
    0x95, 0x3F,        //   report count (63, without the id)
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
// These stop the force until they are cleared.
inline constexpr std::uint16_t kStatusFaults = kStatusWatchdog | kStatusEmergencyStop |
                                               kStatusOverTemperature | kStatusOverCurrent |
                                               kStatusEncoderFault;
inline constexpr std::uint16_t kStatusKnown = 0x03FF;  // flags of protocol 1.0

// The first fault since the last clearing. Codes from kFirstOwnFault are specific to the device.
enum FaultCode : std::uint8_t {
  kNoFault = 0,
  kFaultWatchdog = 1,
  kFaultEmergencyStop = 2,
  kFaultOverTemperature = 3,
  kFaultOverCurrent = 4,
  kFaultEncoder = 5,
};
inline constexpr std::uint8_t kFirstOwnFault = 128;

// A positive force pushes towards growing counts.
struct StateReport {
  std::uint8_t minor_version = kProtocolMinor;  // 0 to 15
  std::uint16_t sequence = 0;                   // incremented every tick, sent or not
  std::uint32_t time_us = 0;                    // latched with the encoders; wraps
  std::array<std::int32_t, kMaxAxes> position_counts{};
  std::array<std::int32_t, kMaxAxes> velocity_counts_per_s{};
  std::array<double, kMaxAxes> applied_force_n{};  // in steps of a millinewton
  std::uint16_t status = 0;                        // StatusFlag
  std::uint16_t acknowledged_sequence = 0;         // of the last accepted command
  std::uint32_t acknowledged_time_us = 0;          // its arrival by the device's clock
  std::uint8_t buttons = 0;
  std::uint8_t fault = kNoFault;
  double temperature_c = 0.0;  // in steps of 0.01
  double supply_v = 0.0;       // in steps of 0.001
  std::uint16_t rejected_commands = 0;

  friend bool operator==(const StateReport&, const StateReport&) = default;
};

// A command. A force leaves in whole millinewtons, within ±kMaxForceN; a positive one pushes
// towards growing counts.
struct ForceReport {
  bool enable = false;
  bool clear_faults = false;
  std::uint16_t sequence = 0;
  std::uint16_t echoed_state_sequence = 0;  // of the state that the force was computed from
  std::uint16_t time_to_live_ms = kUsualTimeToLiveMs;  // 1 to kMaxTimeToLiveMs
  std::array<double, kMaxAxes> force_n{};

  friend bool operator==(const ForceReport&, const ForceReport&) = default;
};

enum InfoFlag : std::uint8_t {
  kInfoMeasuresVelocity = 1,  // STATE has velocities
  kInfoCalibrates = 2,        // once calibrated, count 0 is a fixed place of the mechanism
};
inline constexpr std::uint8_t kInfoKnown = 0x03;

// A device's description of itself. The host reads it whenever it opens the device.
struct InfoReport {
  std::uint8_t minor_version = kProtocolMinor;  // 0 to 15
  std::uint8_t axes = 1;                        // 1 to kMaxAxes
  std::uint8_t flags = 0;                       // InfoFlag
  std::uint32_t firmware = 0;                   // the device's own numbering
  // Positive for each axis of the device, 0 for a missing one.
  std::array<std::int32_t, kMaxAxes> counts_per_metre{};
  std::array<double, kMaxAxes> maximum_force_n{};
  std::uint16_t tick_us = 0;      // 1 to kMaxTickUs
  std::uint16_t watchdog_ms = 0;  // 1 to kMaxTimeToLiveMs

  friend bool operator==(const InfoReport&, const InfoReport&) = default;
};

// Why a report was refused, in the order of the checks.
enum class Refusal : std::uint8_t { kLength, kId, kCrc, kProtocol, kReserved, kValue };
inline constexpr std::array<std::string_view, 6> kRefusalTexts{
    "not 64 bytes",
    "another report id",
    "wrong CRC",
    "another major version of the protocol",
    "reserved bits are not zero",
    "a value out of range"};
[[nodiscard]] constexpr std::string_view refusal_text(Refusal refusal) {
  return kRefusalTexts.at(static_cast<std::size_t>(refusal));
}

// A report, or why it was refused.
template <typename Report>
class [[nodiscard]] Decoded {
 public:
  Decoded(Report report) : content_(report) {}     // NOLINT(google-explicit-constructor)
  Decoded(Refusal refusal) : content_(refusal) {}  // NOLINT(google-explicit-constructor)

  // nullptr if the other one is held.
  [[nodiscard]] const Report* report() const { return std::get_if<Report>(&content_); }
  [[nodiscard]] const Refusal* refusal() const { return std::get_if<Refusal>(&content_); }

 private:
  std::variant<Report, Refusal> content_;
};

// Accept any number of any bytes. A command without enable is taken whatever its time to live and
// its force; values out of range read as the usual time and as 0. Reserved bytes are not checked if
// the minor version is newer than ours, which may use them.
Decoded<StateReport> decode_state(std::span<const std::uint8_t> bytes);
Decoded<ForceReport> decode_force(std::span<const std::uint8_t> bytes);
Decoded<InfoReport> decode_info(std::span<const std::uint8_t> bytes);

// Values out of range are saturated; a force that is not finite becomes 0. The result can always be
// decoded, except for an InfoReport with invalid numbers.
[[nodiscard]] ReportBytes encode_state(const StateReport& state);
[[nodiscard]] ReportBytes encode_force(const ForceReport& force);
[[nodiscard]] ReportBytes encode_info(const InfoReport& info);

// CRC-16/CCITT-FALSE: polynomial 0x1021, initial value 0xFFFF, no reflection, no final XOR.
[[nodiscard]] std::uint16_t crc16(std::span<const std::uint8_t> bytes);
// Writes the CRC into the last two bytes.
void seal(ReportBytes& bytes);

// Rounded and clamped to the type; 0 for NaN.
[[nodiscard]] std::int32_t saturated_count(double value);

// Steps from `from` to `to`, -32768 to 32767; correct below half a turn.
[[nodiscard]] constexpr int sequence_step(std::uint16_t from, std::uint16_t to) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(to - from));
}

// sequence_step() for the clock, microseconds: half a turn is 35 min 47 s.
[[nodiscard]] constexpr std::int32_t clock_step_us(std::uint32_t from_us, std::uint32_t to_us) {
  return static_cast<std::int32_t>(to_us - from_us);
}

// Unwraps the device's clock: the instant nearest to `before_us` at which it shows `clock_us`.
[[nodiscard]] constexpr std::int64_t unwrapped_us(std::int64_t before_us, std::uint32_t clock_us) {
  return before_us + clock_step_us(static_cast<std::uint32_t>(before_us), clock_us);
}

}  // namespace hapticwall::device::hid
