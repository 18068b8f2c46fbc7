// Shared by the tests of recordings.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "app/file/recording/recording_writer.h"
#include "core/sample.h"
#include "core/scene.h"
#include "tests/temporary_folder.h"

namespace hapticwall::file::test {

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

class Recording : public hapticwall::test::FolderTest {
 protected:
  // A recording in progress with the rows of `count` ticks.
  [[nodiscard]] std::unique_ptr<RecordingWriter> begun(const std::string& name = "a.csv",
                                                       std::uint64_t first_tick = 0,
                                                       std::uint64_t count = 0) const {
    auto writer = RecordingWriter::create(path(name), csv_columns(true));
    if (!writer) throw std::runtime_error(writer.error().message);
    for (std::uint64_t tick = first_tick; tick < first_tick + count; ++tick) {
      EXPECT_FALSE((*writer)->append(tick_at(tick)));
    }
    return std::move(*writer);
  }
};

}  // namespace hapticwall::file::test
