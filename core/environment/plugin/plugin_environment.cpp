#include "core/environment/plugin/plugin_environment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/algorithm/plugin/include/hapticwall/environment.h"
#include "core/algorithm/plugin/plugin_algorithm.h"
#include "core/algorithm/plugin/plugin_check.h"
#include "core/scene_keys.h"

namespace hapticwall {
namespace {

constexpr double kNoForce = std::numeric_limits<double>::quiet_NaN();

std::deque<EnvironmentPlugin>& environment_plugins() {
  static std::deque<EnvironmentPlugin> plugins;
  return plugins;
}

hw_motion c_motion(const EnvironmentMotion& motion) {
  return {sizeof(hw_motion),
          motion.axis,
          motion.two_axes ? 2U : 1U,
          0,
          motion.time_s,
          motion.position_m,
          motion.velocity_m_per_s,
          motion.other_position_m,
          motion.other_velocity_m_per_s};
}

std::string interface_problem(const hw_environment& plugin) {
  if (plugin.abi != HAPTICWALL_ENVIRONMENT_ABI)
    return "it was built for ABI " + std::to_string(plugin.abi) + ", this program has ABI " +
           std::to_string(HAPTICWALL_ENVIRONMENT_ABI);
  if (plugin.size != sizeof(hw_environment))
    return "its hw_environment has " + std::to_string(plugin.size) + " bytes, this program's has " +
           std::to_string(sizeof(hw_environment));
  if (plugin.force == nullptr) return "force is NULL";
  if (plugin.state_bytes > kMaxPluginStateBytes)
    return "a state of " + std::to_string(plugin.state_bytes) + " bytes; at most " +
           std::to_string(kMaxPluginStateBytes) + " are taken";
  return "";
}

std::string texts_problem(const hw_environment& plugin) {
  if (!is_plugin_word(plugin.name, '-')) return "its name is not a word of a-z, 0-9 and -";
  if (find_environment(plugin.name))
    return "an environment is called \"" + std::string(plugin.name) + "\" already";
  if (!is_plugin_line(plugin.title) || !is_plugin_line(plugin.idea) ||
      !is_plugin_line(plugin.equation))
    return "title, idea and equation must be one line of UTF-8 each, of at most 200 bytes";
  if (environments().size() == kMaxEnvironments)
    return "the program takes at most " + std::to_string(kMaxEnvironments) + " environments";
  return "";
}

}  // namespace

std::string environment_problem(const hw_environment& plugin) {
  std::string problem = interface_problem(plugin);
  if (problem.empty()) problem = texts_problem(plugin);
  if (!problem.empty()) return problem;
  return parameters_problem({plugin.parameters, plugin.parameter_count},
                            {environment_parameters(), kMaxEnvironmentParameters, "environment"});
}

std::size_t add_environment_plugin(const hw_environment& plugin) {
  EnvironmentPlugin& loaded = environment_plugins().emplace_back();
  loaded.functions = &plugin;
  for (std::size_t i = 0; i < plugin.parameter_count; ++i) {
    const hw_parameter& one = plugin.parameters[i];
    loaded.defaults.push_back(std::isnan(one.fallback) ? "the plug-in's choice"
                                                       : number_text(one.fallback));
    loaded.parameters.push_back(number_parameter(one.key, one.unit, one.minimum, one.maximum,
                                                 loaded.defaults.back(), one.meaning));
  }
  Environment environment{
      {plugin.name, plugin.title, plugin.idea, loaded.parameters, plugin.equation}};
  environment.plugin = &loaded;
  environment.has_stiffness_hint = plugin.stiffness_hint != nullptr;
  return add_environment(environment);
}

LibraryFault environment_fault(std::size_t environment) {
  const EnvironmentPlugin* const plugin = environments().at(environment).plugin;
  return plugin == nullptr ? LibraryFault::kNone : plugin->fault.load();
}

PluginEnvironment::PluginEnvironment() {
  for (const EnvironmentPlugin& loaded : environment_plugins())
    bytes_ = std::max<std::size_t>(bytes_, loaded.functions->state_bytes);
  constexpr std::size_t kUnit = sizeof(std::max_align_t);
  if (bytes_ > 0)  // choose() sets to zero as much as a plug-in needs
    state_ = std::make_unique_for_overwrite<std::max_align_t[]>((bytes_ + kUnit - 1) / kUnit);
}

template <class Call>
void PluginEnvironment::guarded(const char* function, const Call& call) const {
  if (failed_) return;
  const LibraryCall here{
      .library = plugin_->functions->name, .function = function, .pulse = &pulse_};
  const LibraryFault fault = call_library(here, call);
  if (fault == LibraryFault::kNone) return;
  failed_ = true;
  plugin_->fault = fault;
}

void PluginEnvironment::choose(const EnvironmentPlugin* plugin) {
  starts_ = plugin != plugin_;
  if (!starts_) return;
  plugin_ = plugin;
  if (plugin == nullptr) return;
  pulse_.begin();
  failed_ = plugin->functions->state_bytes > bytes_;  // loaded after the construction of this
  if (!failed_ && bytes_ > 0) std::memset(state_.get(), 0, plugin->functions->state_bytes);
}

void PluginEnvironment::configure(const EnvironmentContext& context) {
  const hw_environment& plugin = *plugin_->functions;
  std::array<double, kMaxPluginParameters> values{};
  for (std::size_t i = 0; i < plugin.parameter_count; ++i)
    values.at(i) = context.value_or(plugin.parameters[i].key, plugin.parameters[i].fallback);
  const hw_environment_context scene{sizeof(hw_environment_context), context.axis, context.period_s,
                                     values.data()};
  if (plugin.configure != nullptr)
    guarded("configure()", [&] { plugin.configure(state_.get(), &scene); });
  if (starts_) reset();
}

void PluginEnvironment::reset() {
  if (plugin_->functions->reset == nullptr) return;
  guarded("reset()", [&] { plugin_->functions->reset(state_.get()); });
}

WallContact PluginEnvironment::contact(const EnvironmentMotion& motion) const {
  const hw_environment& plugin = *plugin_->functions;
  const hw_motion asked = c_motion(motion);
  WallContact contact{kNoForce, 0.0, false};
  guarded("force()", [&] { contact.force_n = plugin.force(state_.get(), &asked); });
  if (plugin.depth != nullptr)
    guarded("depth()", [&] { contact.penetration_m = plugin.depth(state_.get(), &asked); });
  if (failed_) return {kNoForce, 0.0, false};
  if (!std::isfinite(contact.penetration_m)) contact.penetration_m = 0.0;
  contact.in_contact =
      plugin.depth != nullptr ? contact.penetration_m > 0.0 : contact.force_n != 0.0;
  return contact;
}

double PluginEnvironment::stiffness_hint(const EnvironmentMotion& motion) const {
  const hw_environment& plugin = *plugin_->functions;
  const hw_motion asked = c_motion(motion);
  double hint = kNoForce;
  if (plugin.stiffness_hint != nullptr)
    guarded("stiffness_hint()", [&] { hint = plugin.stiffness_hint(state_.get(), &asked); });
  return hint;
}

void PluginEnvironment::advance(const EnvironmentMotion& motion, double applied_force_n) {
  const hw_environment& plugin = *plugin_->functions;
  if (plugin.advance == nullptr) return;
  const hw_motion asked = c_motion(motion);
  guarded("advance()", [&] { plugin.advance(state_.get(), &asked, applied_force_n); });
}

}  // namespace hapticwall
