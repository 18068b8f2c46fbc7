// STATE, device to host.
#include <cmath>

#include "tests/fuzz/report_promises.h"

namespace hapticwall::fuzz {
namespace {

using device::hid::StateReport;

constexpr std::size_t kForceAt = 24;
constexpr Layout kLayout{0x01, true, {29, 0xFC}, 44};

bool bytes_make_sense(Bytes bytes) {
  return is_force_mn(i16_at(bytes, kForceAt)) && is_force_mn(i16_at(bytes, kForceAt + 2));
}

bool values_make_sense(const StateReport& state) {
  constexpr double kMaxDegrees = 327.68;
  constexpr double kMaxVolts = 65.535;
  return is_force_n(state.applied_force_n[0]) && is_force_n(state.applied_force_n[1]) &&
         std::abs(state.temperature_c) <= kMaxDegrees && state.supply_v >= 0.0 &&
         state.supply_v <= kMaxVolts && state.status <= device::hid::kStatusKnown &&
         state.minor_version < 16;
}

Outcome fuzz_one(Bytes input) {
  static constexpr ReportPromises<StateReport> kPromises{kLayout, device::hid::decode_state,
                                                         device::hid::encode_state,
                                                         bytes_make_sense, values_make_sense};
  return check_report(input, kPromises);
}

const Registered kRegistered({"state", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
