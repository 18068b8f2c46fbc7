#include "core/scene_keys.h"

#include <array>

namespace hapticwall {
namespace {

constexpr ValueRange kMass{1e-6, 1e3};
constexpr ValueRange kStiffness{0.0, 1e9};
constexpr ValueRange kDamping{0.0, 1e4};
constexpr ValueRange kFriction{0.0, 1e3};
constexpr ValueRange kEncoder{0.0, 0.01};
constexpr ValueRange kForceLimit{0.0, 1e6};
constexpr ValueRange kForceResolution{0.0, 1e3};
constexpr ValueRange kDelay{0.0, kMaximumDelayTicks};
constexpr ValueRange kTimeConstant{0.0, 10.0};
constexpr ValueRange kRate{10.0, 100e3};
constexpr ValueRange kDuration{0.0, 1e6, true};

constexpr std::array<NumberKey<Scene>, 1> kSceneKeys{
    NumberKey<Scene>{"duration_s", "s", kDuration, false, &Scene::duration_s}};

constexpr std::array<NumberKey<SamplingSettings>, 1> kSamplingKeys{
    NumberKey<SamplingSettings>{"rate_hz", "Hz", kRate, false, &SamplingSettings::rate_hz}};

constexpr std::array<NumberKey<DeviceSettings>, 9> kDeviceKeys{
    NumberKey<DeviceSettings>{"mass_kg", "kg", kMass, true, &DeviceSettings::mass_kg},
    NumberKey<DeviceSettings>{"damping_n_s_per_m", "N·s/m", kDamping, true,
                              &DeviceSettings::damping_n_s_per_m},
    NumberKey<DeviceSettings>{"friction_n", "N", kFriction, false, &DeviceSettings::friction_n},
    NumberKey<DeviceSettings>{"encoder_m", "m", kEncoder, false, &DeviceSettings::encoder_m},
    NumberKey<DeviceSettings>{"force_limit_n", "N", kForceLimit, false,
                              &DeviceSettings::force_limit_n},
    NumberKey<DeviceSettings>{"force_resolution_n", "N", kForceResolution, false,
                              &DeviceSettings::force_resolution_n},
    NumberKey<DeviceSettings>{"delay_ticks", "ticks", kDelay, false, &DeviceSettings::delay_ticks},
    NumberKey<DeviceSettings>{"amplifier_time_constant_s", "s", kTimeConstant, false,
                              &DeviceSettings::amplifier_time_constant_s},
    NumberKey<DeviceSettings>{"start_m", "m", kPositionRange, false, &DeviceSettings::start_m}};

constexpr std::array<NumberKey<HandSettings>, 5> kHandKeys{
    NumberKey<HandSettings>{"mass_kg", "kg", kMass, false, &HandSettings::mass_kg},
    NumberKey<HandSettings>{"stiffness_n_per_m", "N/m", kStiffness, false,
                            &HandSettings::stiffness_n_per_m},
    NumberKey<HandSettings>{"damping_n_s_per_m", "N·s/m", kDamping, false,
                            &HandSettings::damping_n_s_per_m},
    NumberKey<HandSettings>{"grip_stiffness_n_per_m", "N/m", kStiffness, false,
                            &HandSettings::grip_stiffness_n_per_m},
    NumberKey<HandSettings>{"grip_damping_n_s_per_m", "N·s/m", kDamping, false,
                            &HandSettings::grip_damping_n_s_per_m}};

constexpr std::array<NumberKey<WallSettings>, 3> kWallKeys{
    NumberKey<WallSettings>{"position_m", "m", kPositionRange, true, &WallSettings::position_m},
    NumberKey<WallSettings>{"stiffness_n_per_m", "N/m", kStiffness, true,
                            &WallSettings::stiffness_n_per_m},
    NumberKey<WallSettings>{"damping_n_s_per_m", "N·s/m", kDamping, false,
                            &WallSettings::damping_n_s_per_m}};

}  // namespace

std::span<const NumberKey<Scene>> scene_number_keys() { return kSceneKeys; }
std::span<const NumberKey<SamplingSettings>> sampling_number_keys() { return kSamplingKeys; }
std::span<const NumberKey<DeviceSettings>> device_number_keys() { return kDeviceKeys; }
std::span<const NumberKey<HandSettings>> hand_number_keys() { return kHandKeys; }
std::span<const NumberKey<WallSettings>> wall_number_keys() { return kWallKeys; }

}  // namespace hapticwall
