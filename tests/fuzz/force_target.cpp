// FORCE, host to device.
#include "tests/fuzz/report_promises.h"

namespace hapticwall::fuzz {
namespace {

using device::hid::ForceReport;

constexpr std::size_t kFlagsAt = 1;
constexpr unsigned kEnable = 1;
constexpr std::size_t kTimeToLiveAt = 6;
constexpr std::size_t kForceAt = 8;
constexpr Layout kLayout{0x02, false, {1, 0xFC}, 12};

bool is_time_to_live_ms(unsigned time_ms) { return time_ms >= 1 && time_ms <= 100; }

bool fields_make_sense(Bytes bytes) {
  return is_time_to_live_ms(u16_at(bytes, kTimeToLiveAt)) && is_force_mn(i16_at(bytes, kForceAt)) &&
         is_force_mn(i16_at(bytes, kForceAt + 2));
}

// A command without enable removes the force, whatever else it says.
bool bytes_make_sense(Bytes bytes) {
  return (bytes[kFlagsAt] & kEnable) == 0 || fields_make_sense(bytes);
}
bool has_ignored_values(Bytes bytes) { return !fields_make_sense(bytes); }

bool values_make_sense(const ForceReport& force) {
  return is_time_to_live_ms(force.time_to_live_ms) && is_force_n(force.force_n[0]) &&
         is_force_n(force.force_n[1]);
}

Outcome fuzz_one(Bytes input) {
  static constexpr ReportPromises<ForceReport> kPromises{
      kLayout,          device::hid::decode_force, device::hid::encode_force,
      bytes_make_sense, values_make_sense,         has_ignored_values};
  return check_report(input, kPromises);
}

const Registered kRegistered({"force", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
