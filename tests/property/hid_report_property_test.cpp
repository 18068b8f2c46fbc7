// The codec over random reports and random bytes.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "device/link/report.h"

namespace hapticwall::device::hid {
namespace {

template <typename T>
T any() {
  return *rc::gen::arbitrary<T>();
}

// Force in steps of the report, so that nothing is lost on the way.
double any_millinewtons() { return *rc::gen::inRange(-32767, 32768) / 1e3; }

// Every pattern of bits that a double can have: denormals, infinities and NaN among them.
double any_double() {
  using Limits = std::numeric_limits<double>;
  if (*rc::gen::inRange(0, 4) == 0) {
    return *rc::gen::element(Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(),
                             Limits::max(), -Limits::denorm_min());
  }
  return std::bit_cast<double>(any<std::uint64_t>());
}

StateReport any_state() {
  StateReport state;
  state.sequence = any<std::uint16_t>();
  state.time_us = any<std::uint32_t>();
  state.position_counts = {any<std::int32_t>(), any<std::int32_t>()};
  state.velocity_counts_per_s = {any<std::int32_t>(), any<std::int32_t>()};
  state.applied_force_n = {any_millinewtons(), any_millinewtons()};
  state.status = any<std::uint16_t>() & kStatusKnown;
  state.acknowledged_sequence = any<std::uint16_t>();
  state.acknowledged_time_us = any<std::uint32_t>();
  state.buttons = any<std::uint8_t>();
  state.fault = any<std::uint8_t>();
  state.temperature_c = any<std::int16_t>() / 1e2;
  state.supply_v = any<std::uint16_t>() / 1e3;
  state.rejected_commands = any<std::uint16_t>();
  return state;
}

ForceReport any_force() {
  return {any<bool>(),
          any<bool>(),
          any<std::uint16_t>(),
          any<std::uint16_t>(),
          *rc::gen::inRange<std::uint16_t>(1, kMaxTimeToLiveMs + 1),
          {any_millinewtons(), any_millinewtons()}};
}

InfoReport any_info() {
  InfoReport info;
  info.axes = *rc::gen::inRange<std::uint8_t>(1, kMaxAxes + 1);
  info.flags = any<std::uint8_t>() & kInfoKnown;
  info.firmware = any<std::uint32_t>();
  for (std::size_t axis = 0; axis < info.axes; ++axis) {
    info.counts_per_metre.at(axis) = *rc::gen::inRange<std::int32_t>(1, 0x7FFFFFFF);
    info.maximum_force_n.at(axis) = *rc::gen::inRange(1, 32768) / 1e3;
  }
  info.tick_us = *rc::gen::inRange<std::uint16_t>(1, kMaxTickUs + 1);
  info.watchdog_ms = *rc::gen::inRange<std::uint16_t>(1, kMaxTimeToLiveMs + 1);
  return info;
}

RC_GTEST_PROP(HidReportProperty, StatesGoRound, ()) {
  const StateReport state = any_state();
  const auto decoded = decode_state(encode_state(state));
  RC_ASSERT(decoded.report() != nullptr);
  RC_ASSERT(*decoded.report() == state);
}

RC_GTEST_PROP(HidReportProperty, ForcesGoRound, ()) {
  const ForceReport force = any_force();
  const auto decoded = decode_force(encode_force(force));
  RC_ASSERT(decoded.report() != nullptr);
  RC_ASSERT(*decoded.report() == force);
}

RC_GTEST_PROP(HidReportProperty, InfosGoRound, ()) {
  const InfoReport info = any_info();
  const auto decoded = decode_info(encode_info(info));
  RC_ASSERT(decoded.report() != nullptr);
  RC_ASSERT(*decoded.report() == info);
}

RC_GTEST_PROP(HidReportProperty, WhateverForceGoesInAFiniteOneWithinTheLimitComesOut, ()) {
  ForceReport force = any_force();
  force.force_n = {any_double(), any_double()};
  force.time_to_live_ms = any<std::uint16_t>();
  const auto decoded = decode_force(encode_force(force));
  RC_ASSERT(decoded.report() != nullptr);
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
    const double out_n = decoded.report()->force_n.at(axis);
    const double in_n = force.force_n.at(axis);
    RC_ASSERT(std::abs(out_n) <= kMaxForceN);
    if (std::abs(in_n) <= kMaxForceN) RC_ASSERT(std::abs(out_n - in_n) <= 0.50001e-3);
  }
}

// Bytes that are taken say the same again when they are encoded: nothing in them was lost.
RC_GTEST_PROP(HidReportProperty, RandomBytesAreRefusedOrUnderstoodWhole, ()) {
  ReportBytes bytes{};
  bytes[0] = *rc::gen::inRange<std::uint8_t>(0, 5);
  bytes[1] = *rc::gen::element<std::uint8_t>(0x10, 0x10, 0x11, 0x20, 0x00, 0x03);
  const auto filled = *rc::gen::inRange<std::size_t>(2, kReportBytes);
  for (std::size_t i = 2; i < filled; ++i) bytes.at(i) = any<std::uint8_t>();
  if (any<bool>()) seal(bytes);
  const auto state = decode_state(bytes);
  const auto force = decode_force(bytes);
  const auto info = decode_info(bytes);
  const int taken = (state.report() ? 1 : 0) + (force.report() ? 1 : 0) + (info.report() ? 1 : 0);
  RC_ASSERT(taken <= 1);
  // -32768 mN is the one pattern that is never sent; a command without enable ignores its fields.
  if (state.report() && state.report()->minor_version == 0 &&
      std::abs(state.report()->applied_force_n[0]) <= kMaxForceN &&
      std::abs(state.report()->applied_force_n[1]) <= kMaxForceN) {
    RC_ASSERT(encode_state(*state.report()) == bytes);
  }
  if (force.report() && force.report()->enable) {
    RC_ASSERT(encode_force(*force.report()) == bytes);
  }
  RC_CLASSIFY(taken == 1, "understood");
}

}  // namespace
}  // namespace hapticwall::device::hid
