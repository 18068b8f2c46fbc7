// The law of a plug-in on one axis, with its state.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/loop/pulse.h"
#include "core/sample.h"

struct hw_plugin;  // hapticwall/plugin.h

namespace hapticwall {

struct StabiliserContext;
template <class N, class F>
struct BasicStabiliserInput;

inline constexpr std::size_t kMaxPluginStateBytes = std::size_t{1} << 18U;
inline constexpr std::size_t kMaxPluginParameters = 16;
inline constexpr std::size_t kMaxPluginSignals = 8;

// Moved only, so that the state keeps its address. Realtime-safe: yes, except the constructor.
class PluginLaw {
 public:
  // Allocates plugin_state_capacity().
  PluginLaw();

  // nullptr: no plug-in is in force. Another plug-in than before starts with a state of zeros.
  void configure(const hw_plugin* plugin, const StabiliserContext& context);
  void reset();
  // After a fault (LibraryFault) NaN, until another plug-in starts.
  [[nodiscard]] double step(const BasicStabiliserInput<double, bool>& input);
  // Puts the signals of the last step() into their places.
  void show(Signals& signals) const;

 private:
  void start(const hw_plugin* plugin);
  void find_places();
  template <class Call>
  void guarded(const char* function, const Call& call);

  std::size_t bytes_ = 0;
  std::unique_ptr<std::max_align_t[]> state_;
  const hw_plugin* plugin_ = nullptr;
  std::uint64_t tick_ = 0;
  std::array<double, kMaxPluginSignals> signals_{};
  std::array<std::size_t, kMaxPluginSignals> places_{};  // in Signals
  bool failed_ = false;
  Pulse pulse_;
};

}  // namespace hapticwall
