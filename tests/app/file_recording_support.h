// What the tests of recordings as files share.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "app/file/recording_writer.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::file::test {

class Recording : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("hapticwall_" + std::string(info->name()) + "_" + std::to_string(getpid()));
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::string content(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      names.push_back(entry.path().filename());
    }
    return names;
  }

 private:
  std::filesystem::path folder_;
};

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
