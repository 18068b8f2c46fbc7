// The source of a window: samples with their scene, from a live loop or from a recording.
//
// All members are called from one thread, the owner's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "app/file/recording/recording_writer.h"
#include "app/session/loop/realtime_setup.h"
#include "app/session/loop/snapshot.h"
#include "core/sample.h"
#include "core/scene.h"
#include "device/device.h"

namespace hapticwall::session {

class SampleSource {
 public:
  SampleSource() = default;
  SampleSource(const SampleSource&) = delete;
  SampleSource& operator=(const SampleSource&) = delete;
  virtual ~SampleSource() = default;

  // Live: the scene that the owner last asked for. Replayed: the scene at the present place.
  [[nodiscard]] virtual const Scene& scene() const = 0;

  virtual void pause(bool paused) = 0;
  // Advances by exactly `ticks` while paused; ignored otherwise.
  virtual void step(std::uint32_t ticks = 1) = 0;
  // Back to the first tick. Paused stays paused.
  virtual void reset() = 0;

  [[nodiscard]] virtual Snapshot snapshot() = 0;
  // Moves up to out.size() ticks, oldest first, and returns how many.
  virtual std::size_t take_ticks(std::span<Tick> out) = 0;
  // Marks in order. Live: of all recordings since the last reset. Replayed: of the whole recording.
  [[nodiscard]] virtual std::span<const file::Mark> marks() const = 0;

  [[nodiscard]] virtual const RealtimeStatus& realtime_status() const = 0;
  [[nodiscard]] virtual const device::DeviceInfo& device_info() const = 0;
  // The present problem of the device or of the file, in one line; empty where there is none.
  [[nodiscard]] virtual std::string device_trouble() const = 0;
  // True if Sample::truth is filled: only a simulator knows the true state.
  [[nodiscard]] virtual bool knows_truth() const = 0;
  // Names of Sample::signals. Live: of every algorithm.
  [[nodiscard]] virtual SignalNames signals() const { return signal_names(); }
};

}  // namespace hapticwall::session
