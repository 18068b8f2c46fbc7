// Somebody who uses a session for hours: changes algorithm, wall, device and integrator, leads the
// hand, pauses, records, starts again; and looks at every sample.
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>

#include "app/session/live_session.h"
#include "core/scene.h"

namespace hapticwall::soak {

// A firm hand that presses and lets go, for as long as anybody waits between two resets.
[[nodiscard]] Scene pressing_scene(double rate_hz);

struct Tally {
  std::uint64_t samples = 0;
  std::uint64_t contacts = 0;
  std::uint64_t changes = 0;
  std::uint64_t resets = 0;
  std::uint64_t recordings = 0;
  std::uint64_t rows = 0;
  double largest_force_n = 0.0;
  std::string trouble;  // the first thing that was not as it should be, in a line
};

class Researcher {
 public:
  // `csv_path` is of one recording at a time, and gone after it.
  Researcher(session::LiveSession& session, std::string csv_path, std::uint64_t seed);

  // One turn of a person who looks sixty times a second. `on_reset` is called when the session is
  // back at tick 0 and nothing is left of the time before.
  void turn(const std::function<void()>& on_reset);
  // A recording that runs is finished.
  void leave();
  [[nodiscard]] const Tally& tally() const { return tally_; }

 private:
  void take_ticks();
  void look_at(const Sample& sample);
  void act();
  void change(void (Researcher::*how)(Scene&));
  void another_algorithm(Scene& scene);
  void another_wall(Scene& scene);
  void another_device(Scene& scene);
  void another_integrator(Scene& scene);
  void lead_hand();
  void start_recording();
  void stop_recording();
  void check_recording();
  void reset(const std::function<void()>& on_reset);
  void trouble(const std::string& text);
  [[nodiscard]] double between(double low, double high);
  [[nodiscard]] bool once_in(int turns);

  session::LiveSession& session_;
  std::string path_;
  std::mt19937_64 random_;
  Tally tally_;
  std::uint64_t turn_ = 0;
  std::uint64_t next_tick_ = 0;
  std::uint64_t recorded_until_turn_ = 0;
  bool start_expected_ = false;  // tick 0 may come, whatever came before
  bool recording_ = false;
  bool paused_ = false;
  bool leading_ = false;
};

}  // namespace hapticwall::soak
