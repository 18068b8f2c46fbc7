// Recordings for the tests of replay: as a session on the simulator makes them, less its thread.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/file/recording/recording_reader.h"
#include "app/file/recording/recording_writer.h"
#include "core/run/simulate.h"
#include "core/tick/servo.h"
#include "device/simulated_device.h"
#include "tests/temporary_folder.h"

namespace hapticwall::session::test {

// Position of the pointer when the loop looks for it before a tick; nullopt: nobody holds the
// handle.
using Pointer = std::function<std::optional<double>(std::uint64_t tick)>;

class ReplayTest : public hapticwall::test::FolderTest {
 protected:
  [[nodiscard]] static std::unique_ptr<file::RecordingReader> opened(const std::string& csv_path) {
    auto reader = file::RecordingReader::open(csv_path);
    if (!reader) throw std::runtime_error(reader.error().message);
    return std::move(*reader);
  }

  // Records in the order of the servo loop: new parameters, then the pointer, then the tick.
  void record(const Scene& scene, std::uint64_t ticks, const Pointer& pointer,
              const std::vector<ScheduledChange>& changes = {}, std::uint64_t first_tick = 0) {
    auto writer = file::RecordingWriter::create(path("a.csv"), file::csv_columns(true));
    ASSERT_TRUE(writer) << writer.error().message;
    device::SimulatedDevice device(scene);
    Servo servo(servo_settings(scene));
    std::vector<std::unique_ptr<PlantModel>> plants;
    std::size_t change = 0;
    bool led = false;
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
      while (change < changes.size() && changes[change].tick == tick) {
        const Scene& changed = changes[change++].scene;
        servo.apply(servo_settings(changed));
        device.change_plant(*plants.emplace_back(std::make_unique<PlantModel>(changed)));
      }
      const std::optional<double> at_m = pointer ? pointer(tick) : std::nullopt;
      if (at_m) device.lead_hand_to(*at_m);
      if (led && !at_m) device.release_hand();
      led = at_m.has_value();
      const Sample sample = servo.tick(device);
      if (tick >= first_tick) ASSERT_FALSE((*writer)->append({{sample}}));
    }
    file::RecordingMetadata metadata;
    metadata.device = "simulator";
    metadata.first_tick = first_tick;
    metadata.session_ticks = ticks;
    metadata.changes = changes;
    ASSERT_FALSE((*writer)->finish(scene, metadata));
  }
};

}  // namespace hapticwall::session::test
