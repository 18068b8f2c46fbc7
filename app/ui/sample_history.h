// The newest samples of a session, kept for the plots, and their reduction to what a screen can
// show.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/sample.h"

namespace hapticwall::ui {

// What is kept of every sample, in SI units.
enum class Quantity : std::uint8_t {
  kTime,
  kPosition,
  kTruePosition,
  kHandPath,
  kForce,
  kWallForce,
  kStiffness,
  kEnergyCv,
  kEnergyHold,
  kEnergyScv,
  kEnergyBudget,
};
inline constexpr std::size_t kQuantityCount = 11;

// Samples [first, last) by age: 0 is the oldest that is still kept.
struct IndexRange {
  std::size_t first = 0;
  std::size_t last = 0;

  [[nodiscard]] std::size_t count() const { return last - first; }
};

struct Extremes {
  double minimum = 0.0;
  double maximum = 0.0;
};

// Points of one line, ready to be plotted.
struct Trace {
  std::vector<double> time_s;
  std::vector<double> value;
};

// Keeps at least the newest `capacity` samples in columns without gaps, so that a search for
// extremes runs over plain arrays. A sample that is not newer than the last one means that the
// session was reset: everything older is forgotten. Realtime-safe: no.
class SampleHistory {
 public:
  explicit SampleHistory(std::size_t capacity);

  void push(const Sample& sample);
  void push(std::span<const Sample> samples);
  void clear();

  [[nodiscard]] std::size_t size() const { return columns_.front().size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] double newest_time_s() const;  // 0 where empty
  // All that is kept of a quantity, oldest first.
  [[nodiscard]] std::span<const double> column(Quantity quantity) const;

  // The samples within [from_s, to_s] and one more on either side, so that lines reach the edges.
  [[nodiscard]] IndexRange range(double from_s, double to_s) const;

  // Precondition: the range is not empty.
  [[nodiscard]] Extremes extremes(Quantity quantity, IndexRange range) const;

  // Reduces the range to at most two points for each of `columns` columns of pixels: the smallest
  // and the largest sample, at ascending times within the column; values are multiplied by `scale`
  // (not 0). No spike is lost. Groups are fixed to the samples' count since the reset, so that a
  // moving window does not flicker.
  void decimate(Quantity quantity, IndexRange range, std::size_t columns, double scale,
                Trace& trace) const;

 private:
  void forget_old();

  std::size_t capacity_;
  std::uint64_t forgotten_ = 0;  // samples dropped at the front since the last clear
  std::uint64_t newest_tick_ = 0;
  std::array<std::vector<double>, kQuantityCount> columns_;
};

}  // namespace hapticwall::ui
