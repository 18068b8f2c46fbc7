// INFO, what a device says of itself.
#include "tests/fuzz/report_promises.h"

namespace hapticwall::fuzz {
namespace {

using device::hid::InfoReport;

constexpr std::size_t kAxesAt = 2;
constexpr std::size_t kCountsAt = 8;
constexpr std::size_t kMaxForceAt = 16;
constexpr std::size_t kTickAt = 20;
constexpr std::size_t kWatchdogAt = 22;
constexpr Layout kLayout{0x03, true, {3, 0xFC}, 24};

// Both values of an existing axis are more than 0; both values of a missing axis are 0.
bool is_axis(bool there, double counts_per_metre, double maximum_force) {
  return there ? counts_per_metre > 0 && maximum_force > 0
               : counts_per_metre == 0 && maximum_force == 0;
}

bool are_common_values(unsigned axes, unsigned tick_us, unsigned watchdog_ms) {
  return (axes == 1 || axes == 2) && tick_us >= 1 && tick_us < 20'000 && watchdog_ms >= 1 &&
         watchdog_ms <= 100;
}

bool bytes_make_sense(Bytes bytes) {
  const unsigned axes = bytes[kAxesAt];
  return are_common_values(axes, u16_at(bytes, kTickAt), u16_at(bytes, kWatchdogAt)) &&
         is_axis(true, i32_at(bytes, kCountsAt), i16_at(bytes, kMaxForceAt)) &&
         is_axis(axes == 2, i32_at(bytes, kCountsAt + 4), i16_at(bytes, kMaxForceAt + 2));
}

bool values_make_sense(const InfoReport& info) {
  return are_common_values(info.axes, info.tick_us, info.watchdog_ms) &&
         is_axis(true, info.counts_per_metre[0], info.maximum_force_n[0]) &&
         is_axis(info.axes == 2, info.counts_per_metre[1], info.maximum_force_n[1]) &&
         is_force_n(info.maximum_force_n[0]) && is_force_n(info.maximum_force_n[1]) &&
         info.flags <= device::hid::kInfoKnown && info.minor_version < 16;
}

Outcome fuzz_one(Bytes input) {
  static constexpr ReportPromises<InfoReport> kPromises{kLayout, device::hid::decode_info,
                                                        device::hid::encode_info, bytes_make_sense,
                                                        values_make_sense};
  return check_report(input, kPromises);
}

const Registered kRegistered({"info", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
