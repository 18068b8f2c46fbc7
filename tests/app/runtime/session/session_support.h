// What the tests of whole sessions share.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/file/recording_writer.h"
#include "app/file/scene_file.h"
#include "app/runtime/live_session.h"
#include "app/runtime/session.h"
#include "core/simulate.h"
#include "device/simulated_device.h"
#include "tests/app/runtime_support.h"

namespace hapticwall::runtime::test {

inline std::unique_ptr<Session> started(const Scene& scene, const SessionOptions& options = {}) {
  auto session = Session::start(scene, options);
  if (!session) throw std::runtime_error(session.error().message);
  return std::move(*session);
}

inline std::unique_ptr<Session> started_paused(const Scene& scene) {
  SessionOptions options;
  options.start_paused = true;
  return started(scene, options);
}

inline bool ticks_reach(Session& session, std::uint64_t ticks) {
  return eventually([&] { return session.snapshot().timing.ticks >= ticks; });
}

inline AlgorithmSettings algorithm(std::size_t index) {
  AlgorithmSettings settings;
  settings.index = index;
  return settings;
}

inline std::vector<Sample> all_samples(Session& session) {
  std::vector<Sample> samples;
  std::array<Sample, 64> some;
  while (const std::size_t count = session.take_samples(some)) {
    samples.insert(samples.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return samples;
}

inline std::unique_ptr<LiveSession> live_session(double rate_hz = 1000.0) {
  const Scene scene = contact_scene(rate_hz);
  return std::make_unique<LiveSession>(std::make_unique<device::SimulatedDevice>(scene), nullptr,
                                       scene, SessionOptions{});
}

// The rows that a headless run of the sidecar gives from the first recorded tick on.
inline std::vector<std::string> repeated_rows(const std::string& sidecar_path) {
  const auto loaded = file::load_scene(sidecar_path);
  if (!loaded) throw std::runtime_error(loaded.error().message);
  std::vector<std::string> rows;
  SimulationOptions options;
  options.changes = loaded->changes;
  options.on_sample = [&](const Sample& sample) {
    if (sample.tick < loaded->first_recorded_tick) return;
    file::append_csv_row(rows.emplace_back(), sample, file::MoreColumns::kSimulator);
    rows.back().pop_back();  // the line end
  };
  static_cast<void>(simulate(loaded->scene, options));
  return rows;
}

inline std::uint64_t tick_of(const std::string& row) { return std::stoull(row); }

inline std::uint64_t flags_of(const std::string& header, const std::string& row) {
  std::istringstream names(header);
  std::istringstream values(row);
  std::string name;
  std::string value;
  while (std::getline(names, name, ',') && std::getline(values, value, ',')) {
    if (name == "flags") return std::stoull(value);
  }
  throw std::runtime_error("no flags");
}

inline void expect_without_gap(const std::vector<std::string>& lines, std::uint64_t first_tick) {
  for (std::size_t i = 1; i < lines.size(); ++i) {
    ASSERT_EQ(tick_of(lines[i]), first_tick + i - 1) << "row " << i;
  }
}

}  // namespace hapticwall::runtime::test
