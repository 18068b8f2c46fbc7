// One tick as it is plotted and recorded, and the one list of its columns. Trivially copyable; SI
// units throughout.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

namespace hapticwall {

// Bits of Sample::flags and of the column `flags` (docs/recording.md).
enum SampleFlag : std::uint32_t {
  kFlagInContact = 1,
  kFlagForceLimit = 2,
  kFlagIntervened = 4,  // the algorithm's force differs from the wall's
  kFlagStaleInput = 8,
  kFlagParametersChanged = 16,  // first tick that uses new parameters
  kFlagDeviceFault = 32,
  kFlagForceRate = 64,  // the force rose slower than the algorithm asked
};

// Known to a simulator only: at the instant of the tick, before its force acts. Work and losses are
// sums since the start. They balance up to the integrator's error:
//
//   hand_work = (kinetic - kinetic at the start) + dissipation + actuator_work
//
// A hand's mass behind a grip is outside of this balance; a mass without a grip is the handle's
// own.
struct PlantTruth {
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
  double hand_path_m = 0.0;   // intended position; without a hand the handle's start
  double hand_force_n = 0.0;  // of the hand on the handle
  double actuator_work_j = 0.0;
  double dissipation_j = 0.0;
  double hand_work_j = 0.0;
  double kinetic_j = 0.0;
};

// Numbers that an algorithm shows of itself, in the order of algorithm_signals() (algorithm.h).
inline constexpr std::size_t kMaxSignals = 16;  // of all algorithms, with plug-ins
using Signals = std::array<double, kMaxSignals>;
// NaN in every place: no algorithm shows a number.
[[nodiscard]] constexpr Signals no_signals() {
  Signals none{};
  for (double& value : none) value = std::numeric_limits<double>::quiet_NaN();
  return none;
}

// Members are in the order of kSampleColumns: NumPy and HDF5 store no structure with another order.
struct Sample {
  std::uint64_t tick = 0;   // since the last reset
  double time_s = 0.0;      // tick / rate
  double position_m = 0.0;  // as measured
  double velocity_m_per_s = 0.0;
  double penetration_m = 0.0;
  double wall_force_n = 0.0;       // F_e
  double force_n = 0.0;            // F_d
  double stiffness_n_per_m = 0.0;  // F_d / penetration; 0 out of contact
  double energy_cv_j = 0.0;        // Eq. 6, the passivity observer
  double energy_hold_j = 0.0;      // Eq. 9
  double energy_scv_j = 0.0;       // Eq. 10
  double energy_budget_j = 0.0;    // -T Σ b v²
  std::uint32_t flags = 0;
  std::uint32_t generation = 0;  // of the parameters in force (live sessions; 0 in headless runs)
  PlantTruth truth;
  // Known to a real device only; 0 from the simulator.
  double device_time_s = 0.0;  // when it latched the position, by its own clock since it was opened
  double read_age_s = 0.0;     // age of the position when the loop used it
  double applied_force_n = 0.0;    // that the device says it applies from the latch on
  Signals signals = no_signals();  // finite, or NaN: the algorithm in force has none here
};

// Groups of the columns of a recording: kTick once, kAxis for every axis, and of every axis kTruth
// (from a simulator) or kDevice (from a real device), with kApplied if the device tells its force.
enum class ColumnGroup : std::uint8_t { kTick, kAxis, kTruth, kDevice, kApplied };

using SampleMember = std::variant<double Sample::*, double PlantTruth::*, std::uint64_t Sample::*,
                                  std::uint32_t Sample::*>;

struct SampleColumn {
  std::string_view name;  // in a recording; ends with the unit
  SampleMember member;
  ColumnGroup group;
};

// Columns in the order of a recording (docs/recording.md). A new field needs a line here; writer,
// reader, history and every comparison read this table. `generation` is not recorded; `signals`
// have columns of their own.
inline constexpr std::array<SampleColumn, 24> kSampleColumns{
    {{"tick", &Sample::tick, ColumnGroup::kTick},
     {"time_s", &Sample::time_s, ColumnGroup::kTick},
     {"position_m", &Sample::position_m, ColumnGroup::kAxis},
     {"velocity_m_per_s", &Sample::velocity_m_per_s, ColumnGroup::kAxis},
     {"penetration_m", &Sample::penetration_m, ColumnGroup::kAxis},
     {"wall_force_n", &Sample::wall_force_n, ColumnGroup::kAxis},
     {"force_n", &Sample::force_n, ColumnGroup::kAxis},
     {"stiffness_n_per_m", &Sample::stiffness_n_per_m, ColumnGroup::kAxis},
     {"energy_cv_j", &Sample::energy_cv_j, ColumnGroup::kAxis},
     {"energy_hold_j", &Sample::energy_hold_j, ColumnGroup::kAxis},
     {"energy_scv_j", &Sample::energy_scv_j, ColumnGroup::kAxis},
     {"energy_budget_j", &Sample::energy_budget_j, ColumnGroup::kAxis},
     {"flags", &Sample::flags, ColumnGroup::kAxis},
     {"true_position_m", &PlantTruth::position_m, ColumnGroup::kTruth},
     {"true_velocity_m_per_s", &PlantTruth::velocity_m_per_s, ColumnGroup::kTruth},
     {"hand_path_m", &PlantTruth::hand_path_m, ColumnGroup::kTruth},
     {"hand_force_n", &PlantTruth::hand_force_n, ColumnGroup::kTruth},
     {"true_actuator_work_j", &PlantTruth::actuator_work_j, ColumnGroup::kTruth},
     {"true_dissipation_j", &PlantTruth::dissipation_j, ColumnGroup::kTruth},
     {"true_hand_work_j", &PlantTruth::hand_work_j, ColumnGroup::kTruth},
     {"kinetic_j", &PlantTruth::kinetic_j, ColumnGroup::kTruth},
     {"device_time_s", &Sample::device_time_s, ColumnGroup::kDevice},
     {"read_age_s", &Sample::read_age_s, ColumnGroup::kDevice},
     {"applied_force_n", &Sample::applied_force_n, ColumnGroup::kApplied}}};

// The place of a member in kSampleColumns. Fails to compile for a member that has no column.
template <typename Member>
[[nodiscard]] consteval std::size_t column_index(Member member) {
  std::size_t index = 0;
  while (kSampleColumns.at(index).member != SampleMember(member)) ++index;
  return index;
}

// The value of a column: a reference into `sample`, which may be const.
template <std::size_t kIndex, typename AnySample>
[[nodiscard]] constexpr auto& column_value(AnySample& sample) {
  constexpr SampleMember kMember = kSampleColumns[kIndex].member;
  constexpr auto kPointer = std::get<kMember.index()>(kMember);
  if constexpr (kMember.index() == 1) {
    return sample.truth.*kPointer;
  } else {
    return sample.*kPointer;
  }
}

// Calls test(column, value) column by column until one returns false; true if none does. `value`:
// a reference into `sample`. Unrolled by the compiler: costs no more than the list written out.
template <typename AnySample, typename Test>
constexpr bool all_columns(AnySample& sample, Test&& test) {
  return [&]<std::size_t... kIndex>(std::index_sequence<kIndex...>) {
    return (test(kSampleColumns[kIndex], column_value<kIndex>(sample)) && ...);
  }
  (std::make_index_sequence<kSampleColumns.size()>());
}
// True if the test holds for all columns of two samples: test(column, value of a, value of b).
template <typename Test>
constexpr bool all_columns(const Sample& a, const Sample& b, Test&& test) {
  return [&]<std::size_t... kIndex>(std::index_sequence<kIndex...>) {
    return (test(kSampleColumns[kIndex], column_value<kIndex>(a), column_value<kIndex>(b)) && ...);
  }
  (std::make_index_sequence<kSampleColumns.size()>());
}
// Calls visit(column, value) for every column, in the order of kSampleColumns.
template <typename AnySample, typename Visit>
constexpr void for_each_column(AnySample& sample, Visit&& visit) {
  all_columns(sample, [&](const SampleColumn& column, auto& value) {
    visit(column, value);
    return true;
  });
}

// True if every number of the sample is finite. Realtime-safe: yes.
[[nodiscard]] constexpr bool is_finite(const Sample& sample) {
  // x * 0 is 0 for every finite x, and NaN for every other one.
  double zero = 0.0;
  for_each_column(sample, [&](const SampleColumn& /*column*/, const auto& value) {
    zero += static_cast<double>(value) * 0.0;
  });
  return zero == 0.0;
}

// Axes x and y.
inline constexpr std::size_t kMaxAxes = 2;

// One tick of all axes: the unit of queues, recordings and histories. Its axes share tick, time and
// generation.
struct Tick {
  std::array<Sample, kMaxAxes> axes;
  std::uint8_t count = 1;  // of axes in use

  [[nodiscard]] const Sample& x() const { return axes.front(); }
  [[nodiscard]] std::span<Sample> in_use() { return std::span(axes).first(count); }
  [[nodiscard]] std::span<const Sample> in_use() const { return std::span(axes).first(count); }
};
static_assert(std::is_trivially_copyable_v<Tick>);

// True if the samples of all axes in use are finite. Realtime-safe: yes.
[[nodiscard]] constexpr bool is_finite(const Tick& tick) {
  for (std::size_t axis = 0; axis < tick.count; ++axis) {
    if (!is_finite(tick.axes[axis])) return false;
  }
  return true;
}

}  // namespace hapticwall
