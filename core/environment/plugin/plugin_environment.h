// The environment of a plug-in on one axis, with its state; the list of such plug-ins.
#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "core/algorithm/plugin/library_call.h"
#include "core/environment/environment.h"

struct hw_environment;  // hapticwall/environment.h

namespace hapticwall {

// A plug-in in the list of environments.
struct EnvironmentPlugin {
  const hw_environment* functions = nullptr;
  // The description of the list points into these.
  std::deque<std::string> defaults{};
  std::vector<ParameterDescription> parameters{};
  mutable std::atomic<LibraryFault> fault = LibraryFault::kNone;
};

// Why the program cannot take this environment, or "". Reads `abi` and `size` before anything else.
// Realtime-safe: no.
[[nodiscard]] std::string environment_problem(const hw_environment& plugin);
// Puts it at the end of environments() and gives its index. Everything that it points to must live
// as long as the program. Call it before other threads and sessions start. Precondition:
// environment_problem() is "". Realtime-safe: no.
std::size_t add_environment_plugin(const hw_environment& plugin);
// The newest fault of an environment; kNone for a built-in one.
[[nodiscard]] LibraryFault environment_fault(std::size_t environment);

// Moved only, so that the state keeps its address. Realtime-safe: yes, except the constructor.
class PluginEnvironment {
 public:
  // Allocates the state of the largest plug-in that is loaded.
  PluginEnvironment();

  // nullptr: no plug-in is in force. Another plug-in than before starts with a state of zeros.
  void choose(const EnvironmentPlugin* plugin);
  [[nodiscard]] bool acts() const { return plugin_ != nullptr; }
  void configure(const EnvironmentContext& context);
  void reset();
  // The force is NaN after a fault (LibraryFault), until another plug-in starts.
  [[nodiscard]] WallContact contact(const EnvironmentMotion& motion) const;
  // NaN if the plug-in tells none.
  [[nodiscard]] double stiffness_hint(const EnvironmentMotion& motion) const;
  void advance(const EnvironmentMotion& motion, double applied_force_n);

 private:
  template <class Call>
  void guarded(const char* function, const Call& call) const;

  std::size_t bytes_ = 0;
  std::unique_ptr<std::max_align_t[]> state_;
  const EnvironmentPlugin* plugin_ = nullptr;
  bool starts_ = false;
  mutable bool failed_ = false;
  mutable Pulse pulse_;
};

}  // namespace hapticwall
