#include "core/batch/lane_scene.h"

#include <cstring>
#include <limits>
#include <type_traits>

#include "core/encoder.h"
#include "core/loop/servo_step.h"
#include "core/plant/plant_model.h"
#include "core/stabiliser/plugin/plugin_list.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall::batch {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A wall out of reach.
constexpr double kNowhereM = std::numeric_limits<double>::max();

bool names(std::optional<double> part) { return part.value_or(0.0) != 0.0; }

template <std::size_t kCount, typename Numbers>
void set_rows(std::array<LaneNumbers, kCount>& rows, std::size_t lane, const Numbers& numbers) {
  for (std::size_t i = 0; i < kCount; ++i) rows[i][lane] = numbers[i];
}

void set_servo(const Scene& scene, std::size_t lane, LaneParameters& parameters) {
  const ServoSettings settings = servo_settings(scene);
  const StabiliserContext context = stabiliser_context(settings);
  parameters.rate_hz[lane] = settings.rate_hz;
  parameters.encoder_m[lane] = settings.encoder_m;
  parameters.force_limit_n[lane] = settings.force_limit_n;
  parameters.budget_n_per_m[lane] = believed_damping(context) * settings.rate_hz;
  const WallSettings wall =
      scene.x().walls.empty() ? WallSettings{kNowhereM, 0.0, 0.0} : scene.x().walls.front();
  parameters.wall_m[lane] = wall.position_m;
  parameters.wall_stiffness_n_per_m[lane] = wall.stiffness_n_per_m;
  parameters.wall_damping_n_s_per_m[lane] = wall.damping_n_s_per_m;
  Stabiliser stabiliser;
  stabiliser.configure(scene.algorithm.index, context);
  set_rows(parameters.law, lane, stabiliser.parameters());
}

void set_plant(const Scene& scene, const OneBody& body, std::size_t lane,
               LaneParameters& parameters) {
  const PlantParameters plant = plant_parameters(scene);
  const auto& tick = body.level(0);
  parameters.damping_n_s_per_m[lane] = plant.damping_n_s_per_m;
  parameters.hand_stiffness_n_per_m[lane] = plant.hand_stiffness_n_per_m;
  parameters.hand_damping_n_s_per_m[lane] = plant.hand_damping_n_s_per_m;
  parameters.half_mass_kg[lane] = plant.mass_kg / 2.0;
  parameters.duration_s[lane] = tick.duration_s;
  set_rows(parameters.velocity, lane, tick.velocity);
  set_rows(parameters.drift, lane, tick.drift);
  set_rows(parameters.hand_force_drift, lane, tick.hand_force_drift);
  set_rows(parameters.integral_at_rest, lane, tick.integral_at_rest);
  set_rows(parameters.square, lane, tick.square);
  set_rows(parameters.hand_work, lane, tick.hand_work);
  set_rows(parameters.square_at_rest, lane, tick.square_at_rest);
  parameters.period_s[lane] = scene.sampling.period_s();
}

// Sets every number of the lane in a struct of LaneNumbers to 0.
template <typename Numbers>
void clear_numbers(std::size_t lane, Numbers& numbers) {
  static_assert(std::is_trivially_copyable_v<Numbers> &&
                sizeof(Numbers) % sizeof(LaneNumbers) == 0);
  constexpr double kZero = 0.0;
  auto* const bytes = reinterpret_cast<char*>(&numbers);
  for (std::size_t row = 0; row < sizeof(Numbers); row += sizeof(LaneNumbers)) {
    std::memcpy(bytes + row + lane * sizeof kZero, &kZero, sizeof kZero);
  }
}

void reset_state(std::size_t lane, LaneState& state) {
  clear_numbers(lane, state);
  state.account.sums.maximum_m[lane] = -kInfinity;
  begin_tail(lane, state);
}

}  // namespace

std::optional<LaneKind> lane_kind(const Scene& scene) {
  const DeviceSettings& device = scene.x().device;
  const bool fits =
      !has_follower(scene.algorithm) && scene.algorithm.index < first_plugin() &&
      scene.simulator.integrator == Integrator::kExact && scene.x().walls.size() <= 1 &&
      !names(device.friction_n) && !names(device.amplifier_time_constant_s) &&
      !names(device.force_resolution_n) && !names(device.max_force_rate_n_per_s) &&
      device.delay_ticks.value_or(0) == 0 &&
      !(scene.x().hand && (scene.x().hand->has_grip() || scene.x().hand->follows_mouse));
  if (!fits) return std::nullopt;
  const bool damped = !scene.x().walls.empty() && scene.x().walls.front().damping_n_s_per_m != 0.0;
  return LaneKind{scene.algorithm.index, names(device.encoder_m), damped};
}

const OneBody& PlantCache::plant(const PlantParameters& p, double period_s) {
  const Key key{p.mass_kg, p.damping_n_s_per_m, p.hand_stiffness_n_per_m, p.hand_damping_n_s_per_m,
                period_s};
  const auto place = plants_.lower_bound(key);
  if (place != plants_.end() && place->first == key) return place->second;
  if (plants_.size() < kMaxEntries)
    return plants_.emplace_hint(place, key, OneBody(p, period_s))->second;
  plants_.clear();
  return plants_.emplace(key, OneBody(p, period_s)).first->second;
}

void set_lane(const Scene& scene, const OneBody& body, std::size_t lane, LaneBlock& block) {
  reset_state(lane, block.state);
  set_servo(scene, lane, block.parameters);
  set_plant(scene, body, lane, block.parameters);
  const double start_m = scene.x().device.start_m;
  const double encoder_m = block.parameters.encoder_m[lane];
  const double measured_m = encoder_m > 0.0 ? quantise(start_m, encoder_m) : start_m;
  block.state.motion.position_m[lane] = start_m;
  block.state.motion.measured_m[lane] = measured_m;
  block.state.account.sums.measured_m[lane] = measured_m;
}

void clear_lane(std::size_t lane, LaneBlock& block) {
  reset_state(lane, block.state);
  clear_numbers(lane, block.parameters);
  block.parameters.encoder_m[lane] = 1.0;  // is divided by
}

void begin_tail(std::size_t lane, LaneState& state) {
  LaneAccount& a = state.account;
  clear_numbers(lane, a.tail);
  a.maximum_before_tail_m[lane] = a.sums.maximum_m[lane];
  a.sums.maximum_m[lane] = -kInfinity;
  a.tail.minimum_m[lane] = kInfinity;
}

}  // namespace hapticwall::batch
