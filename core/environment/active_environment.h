// An environment at work.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "core/environment/environment.h"
#include "core/environment/plugin/plugin_environment.h"

namespace hapticwall {

// One environment on one axis, other than the walls. Realtime-safe: yes, except the constructor.
class ActiveEnvironment {
 public:
  ActiveEnvironment() : plugin_(std::make_unique<PluginEnvironment>()) {}

  // nullptr: the walls, which servo_step() computes itself. Another environment than before starts
  // anew.
  void configure(const Environment* environment, const EnvironmentContext& context);
  // Forgets the past, and keeps environment and parameters.
  void reset();

  // A tick, in this order: look(), contact() or other questions, advance(). `computes`: false on a
  // tick on which the controller does not compute; advance() then does nothing.
  void look(const EnvironmentMotion& motion, bool computes) {
    motion_ = motion;
    computes_ = computes;
  }
  [[nodiscard]] const EnvironmentMotion& motion() const { return motion_; }
  [[nodiscard]] WallContact contact() const { return contact_at(motion_); }
  [[nodiscard]] WallContact contact_at(const EnvironmentMotion& motion) const {
    return plugin_->acts() ? plugin_->contact(motion)
                           : environment_->contact(block_.data(), motion);
  }
  // The spring that stands for the environment here, N/m; see environment.h. NaN: none is known.
  [[nodiscard]] double stiffness_hint() const {
    return plugin_->acts() ? plugin_->stiffness_hint(motion_)
                           : environment_->stiffness_hint(block_.data(), motion_);
  }
  void advance(double applied_force_n);
  // The signals of the last tick, in their places.
  void show(Signals& signals) const;

 private:
  void find_places();

  const Environment* environment_ = nullptr;
  EnvironmentMotion motion_;
  bool computes_ = true;
  std::array<std::size_t, kMaxSignals> places_{};
  alignas(std::max_align_t) std::array<std::byte, kMaxEnvironmentBytes> block_{};
  std::unique_ptr<PluginEnvironment> plugin_;
};

}  // namespace hapticwall
