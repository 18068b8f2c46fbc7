#include "core/algorithm/plugin/plugin_algorithm.h"

#include <array>
#include <cstring>
#include <limits>

#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/include/hapticwall/plugin.h"
#include "core/algorithm/plugin/library_call.h"
#include "core/algorithm/plugin/plugin_list.h"

namespace hapticwall {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

std::array<double, kMaxPluginParameters> plugin_values(const hw_plugin& plugin,
                                                       const AlgorithmContext& context) {
  std::array<double, kMaxPluginParameters> values{};
  for (std::size_t i = 0; i < plugin.parameter_count; ++i) {
    values.at(i) = context.value_or(plugin.parameters[i].key, plugin.parameters[i].fallback);
  }
  return values;
}

}  // namespace

PluginAlgorithm::PluginAlgorithm() : bytes_(plugin_state_capacity()) {
  constexpr std::size_t kUnit = sizeof(std::max_align_t);
  if (bytes_ > 0)  // start() sets to zero as much as a plug-in needs
    state_ = std::make_unique_for_overwrite<std::max_align_t[]>((bytes_ + kUnit - 1) / kUnit);
}

template <class Call>
void PluginAlgorithm::guarded(const char* function, const Call& call) {
  if (failed_) return;
  const LibraryCall here{.library = plugin_->name, .function = function, .pulse = &pulse_};
  const LibraryFault fault = call_library(here, call);
  if (fault == LibraryFault::kNone) return;
  failed_ = true;
  note_plugin_fault(*plugin_, fault);
}

void PluginAlgorithm::choose(const hw_plugin* plugin) {
  starts_ = plugin != plugin_;
  if (!starts_) return;
  plugin_ = plugin;
  tick_ = 0;
  if (plugin == nullptr) return;
  pulse_.begin();
  failed_ = plugin->state_bytes > bytes_;  // loaded after the construction of this
  if (!failed_ && plugin->state_bytes > 0) std::memset(state_.get(), 0, plugin->state_bytes);
}

void PluginAlgorithm::configure(const AlgorithmContext& context) {
  const auto values = plugin_values(*plugin_, context);
  std::array<hw_wall, kMaxWalls> walls{};
  std::uint32_t count = 0;
  for (const WallSettings& wall : context.walls.walls())
    walls.at(count++) = {wall.position_m, wall.stiffness_n_per_m, wall.damping_n_s_per_m};
  const hw_context scene{sizeof(hw_context),
                         context.period_s,
                         context.device_damping_n_s_per_m,
                         context.encoder_m,
                         context.force_limit_n,
                         values.data(),
                         walls.data(),
                         count};
  guarded("configure()", [&] { plugin_->configure(state_.get(), &scene); });
  if (starts_) reset();
}

void PluginAlgorithm::reset() {
  tick_ = 0;
  guarded("reset()", [&] { plugin_->reset(state_.get()); });
}

double PluginAlgorithm::step(const AlgorithmInput& in, std::span<double> signals) {
  const hw_input input{sizeof(hw_input),    in.in_contact ? 1U : 0U, tick_++,
                       in.wall_force_n,     in.position_m,           in.displacement_m,
                       in.velocity_m_per_s, in.penetration_m,        in.previous_force_n};
  double force_n = kNoNumber;
  guarded("step()", [&] { force_n = plugin_->step(state_.get(), &input, signals.data()); });
  return failed_ ? kNoNumber : force_n;
}

}  // namespace hapticwall
