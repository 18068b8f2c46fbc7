// Functions that the tests of whole sessions share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/file/recording/recording_writer.h"
#include "app/file/scene/scene_file.h"
#include "app/session/live_session.h"
#include "app/session/loop_session.h"
#include "core/run/simulate.h"
#include "device/simulated_device.h"
#include "tests/app/session/support.h"

namespace hapticwall::session::test {

inline std::unique_ptr<LiveSession> started(const Scene& scene,
                                            const SessionOptions& options = {}) {
  auto session = LiveSession::start(scene, options);
  if (!session) throw std::runtime_error(session.error().message);
  return std::move(*session);
}

inline std::unique_ptr<LiveSession> started_paused(const Scene& scene) {
  SessionOptions options;
  options.start_paused = true;
  return started(scene, options);
}

inline bool ticks_reach(LiveSession& session, std::uint64_t ticks) {
  return eventually([&] { return session.snapshot().timing.ticks >= ticks; });
}

inline bool rows_reach(LiveSession& session, std::uint64_t rows) {
  return eventually([&] { return session.recording_status().rows >= rows; });
}

inline bool generation_is(LiveSession& session, std::uint64_t generation) {
  return eventually([&] { return session.snapshot().generation == generation; });
}

// Waits for a note of an unfinished recording. snapshot() lets the session write it.
inline bool note_says(LiveSession& session, const std::string& partial_sidecar,
                      const std::string& text) {
  return eventually([&] {
    static_cast<void>(session.snapshot());
    return text_of(partial_sidecar).find(text) != std::string::npos;
  });
}

inline AlgorithmSettings algorithm(std::size_t index) {
  AlgorithmSettings settings;
  settings.index = index;
  return settings;
}

inline std::vector<Sample> all_samples(LiveSession& session) {
  std::vector<Sample> samples;
  std::array<Tick, 64> some;
  while (const std::size_t count = session.take_ticks(some)) {
    for (const Tick& tick : std::span(some).first(count)) samples.push_back(tick.x());
  }
  return samples;
}

// A session that its test turns in virtual time: nothing is waited for, and every run of the test
// is the same.
class TurnedSession {
 public:
  explicit TurnedSession(const Scene& scene, SessionOptions options = {})
      : rate_hz_(scene.sampling.rate_hz) {
    options.driver = Driver::kTurnedByOwner;
    options.clock = &clock_;
    session_ = started(scene, options);
  }

  // Lets so many periods pass, in turns as of a window; the samples of their ticks.
  std::vector<Sample> pass(std::uint64_t periods) {
    constexpr std::int64_t kTurnNs = 16'000'000;
    passed_ += periods;
    const std::int64_t until_ns =
        start_ns_ + std::llround(static_cast<double>(passed_) * kNanosecondsPerSecond / rate_hz_);
    std::vector<Sample> samples;
    while (clock_.now_ns() < until_ns) {
      clock_.advance_ns(std::min<std::int64_t>(kTurnNs, until_ns - clock_.now_ns()));
      for (const Sample& sample : all_samples(*session_)) samples.push_back(sample);
    }
    return samples;
  }
  LiveSession& operator*() { return *session_; }
  LiveSession* operator->() { return session_.get(); }
  FakeClock& clock() { return clock_; }

 private:
  double rate_hz_;
  FakeClock clock_;
  std::int64_t start_ns_ = clock_.now_ns();
  std::uint64_t passed_ = 0;
  std::unique_ptr<LiveSession> session_;
};

inline std::vector<std::unique_ptr<device::Device>> one_device(
    std::unique_ptr<device::Device> device) {
  std::vector<std::unique_ptr<device::Device>> devices;
  devices.push_back(std::move(device));
  return devices;
}

inline std::unique_ptr<LoopSession> loop_session(double rate_hz = 1000.0) {
  const Scene scene = contact_scene(rate_hz);
  return std::make_unique<LoopSession>(one_device(std::make_unique<device::SimulatedDevice>(scene)),
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
    file::append_csv_row(rows.emplace_back(), {{sample}}, file::csv_columns(true));
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

// The rows below the header are those of a headless run of the sidecar.
inline void expect_repeated(const std::vector<std::string>& lines,
                            const std::string& sidecar_path) {
  const std::vector<std::string> repeated = repeated_rows(sidecar_path);
  ASSERT_EQ(repeated.size() + 1, lines.size());
  for (std::size_t i = 0; i < repeated.size(); ++i) ASSERT_EQ(lines[i + 1], repeated[i]);
}

}  // namespace hapticwall::session::test
