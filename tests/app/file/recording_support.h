// Shared by the tests of recordings.
#pragma once

#include <string>

#include "app/file/recording/recording_writer.h"
#include "core/sample.h"
#include "core/scene.h"
#include "tests/temporary_folder.h"

namespace hapticwall::file::test {

using Recording = hapticwall::test::FolderTest;

inline Sample sample_at(std::uint64_t tick) {
  Sample sample;
  sample.tick = tick;
  sample.time_s = static_cast<double>(tick) / 1000.0;
  sample.position_m = 0.1 + 0.2;
  sample.force_n = -0.0;
  sample.energy_cv_j = 5e-324;
  sample.truth.kinetic_j = 1.7976931348623157e308;
  sample.flags = kFlagInContact | kFlagDeviceFault;
  return sample;
}

inline Tick tick_at(std::uint64_t tick) { return {{sample_at(tick)}}; }

inline Scene scene_of_ten_ticks() {
  Scene scene;
  scene.name = "ten";
  scene.duration_s = 0.01;
  return scene;
}

inline RecordingMetadata headless() {
  RecordingMetadata metadata;
  metadata.device = "simulator";
  metadata.realtime_status = "none";
  return metadata;
}

}  // namespace hapticwall::file::test
