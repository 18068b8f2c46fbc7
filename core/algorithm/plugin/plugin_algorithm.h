// The algorithm of a plug-in on one axis, with its state.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/tick/pulse.h"

struct hw_plugin;  // hapticwall/plugin.h

namespace hapticwall {

struct AlgorithmContext;
struct AlgorithmInput;

// Limits that plugin_problem() checks.
inline constexpr std::size_t kMaxPluginStateBytes = std::size_t{1} << 18U;  // 256 KiB
inline constexpr std::size_t kMaxPluginParameters = 16;
inline constexpr std::size_t kMaxPluginSignals = 8;

// Moved only, so that the state keeps its address. Realtime-safe: yes, except the constructor.
class PluginAlgorithm {
 public:
  // Allocates plugin_state_capacity().
  PluginAlgorithm();

  // nullptr: no plug-in is in force. Another plug-in than before starts with a state of zeros.
  void choose(const hw_plugin* plugin);
  void configure(const AlgorithmContext& context);
  void reset();
  // The force. After a fault (LibraryFault) it is NaN, until another plug-in starts. `signals` are
  // NaN before the call.
  [[nodiscard]] double step(const AlgorithmInput& input, std::span<double> signals);

 private:
  template <class Call>
  void guarded(const char* function, const Call& call);

  std::size_t bytes_ = 0;
  std::unique_ptr<std::max_align_t[]> state_;
  const hw_plugin* plugin_ = nullptr;
  std::uint64_t tick_ = 0;
  bool starts_ = false;
  bool failed_ = false;
  Pulse pulse_;
};

}  // namespace hapticwall
