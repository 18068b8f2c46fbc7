// Check that the handle obeys the force: its sign, found with a weak force. Until then the force
// limit is a small share, which switches between two values while the handle is in contact. A force
// that changes by a step moves every passive hand and handle with the step, whatever the hand does
// otherwise. Arithmetic only: no clock, no device. Realtime-safe: yes, all of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hapticwall::session {

// Max share of the force limit, for a handle that shows no response to a weaker force.
inline constexpr double kMaxUntriedShare = 0.3;
// Ramp time from the weak force to the full one, after the handle has obeyed.
inline constexpr double kObeyedRampS = 0.2;

class Obedience {
 public:
  enum class Word : std::uint8_t { kUnknown, kObeys, kDisobeys };

  // `rate_hz`: tick rate, positive. `encoder_m`: 0 if unknown. `untried_share`: 1 for a device
  // whose force needs no trial.
  Obedience(double encoder_m, double rate_hz, double untried_share);

  // The device was armed: nothing is known.
  void begin();
  // One tick: the new position, the force commanded until it, and the delay of the device (0:
  // unknown).
  void hear(double position_m, double force_n, double delay_s);
  [[nodiscard]] Word word() const { return word_; }
  // Shares at the next tick, of the force limit, and of the force within it; above 0, at most 1.
  [[nodiscard]] double limit_share() const { return share_; }
  [[nodiscard]] double level() const;

 private:
  // Positions and forces of about a millisecond each.
  static constexpr std::size_t kChunks = 256;
  struct Chunk {
    double position_m = 0.0;  // position at the end of the chunk
    double force_n = 0.0;     // mean
    bool pushes = false;      // all forces of one sign, and that sign is the one of force_n
  };

  [[nodiscard]] const Chunk& at(std::uint64_t index) const { return chunks_[index % kChunks]; }
  void end_chunk(double position_m, double delay_s);
  void switch_force();
  [[nodiscard]] double mean_force(std::uint64_t begin) const;
  [[nodiscard]] bool pushes_throughout(std::uint64_t begin, std::uint64_t end) const;
  void weigh(std::uint64_t step, std::uint64_t delay);
  [[nodiscard]] double place(std::uint64_t end) const;
  void count(double moved_m, double step_n);

  double encoder_m_;
  double rate_hz_;
  double untried_share_;
  double ramp_step_;
  std::uint32_t chunk_ticks_;
  std::uint64_t span_;  // chunks between two positions that are compared

  std::array<Chunk, kChunks> chunks_{};
  std::uint64_t count_ = 0;  // whole chunks
  std::uint32_t ticks_ = 0;  // ticks in the present chunk
  double sum_n_ = 0.0;
  bool mixed_ = false;
  std::uint64_t step_ = 0;         // chunk at which the present level began
  std::uint64_t next_switch_ = 0;  // chunk
  bool weighed_ = true;            // the step at `step_`
  bool high_ = true;
  std::uint32_t random_ = 1;
  double share_;
  Word word_;
  // Consecutive steps with a like response: with the force, against it, and none.
  std::uint32_t with_ = 0;
  std::uint32_t against_ = 0;
  std::uint32_t none_ = 0;
  double least_m_per_n_ = 0.0;  // smallest response of the present series
  double most_m_per_n_ = 0.0;
};

}  // namespace hapticwall::session
