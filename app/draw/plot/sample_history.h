// The newest samples of a session, kept for the plots, and their reduction to what a screen can
// show.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/ui/sample_pyramid.h"
#include "core/sample.h"

namespace hapticwall::ui {

// What is kept of every sample, in SI units: everything that a recording has.
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
  kVelocity,
  kPenetration,
  kTrueVelocity,
  kHandForce,
  kActuatorWork,
  kDissipation,
  kHandWork,
  kKinetic,
  kTick,  // exact up to 2^53
  kDeviceTime,
  kReadAge,
  kFlags,  // of SampleFlag
};
inline constexpr std::size_t kQuantityCount = 23;

// An hour at 1 kHz: what the window keeps of a session. At most about 200 bytes a sample, less
// where quantities stand still.
inline constexpr std::size_t kHistoryCapacity = 3'600'000;

// Samples [first, last) by age: 0 is the oldest that is still kept.
struct IndexRange {
  std::size_t first = 0;
  std::size_t last = 0;

  [[nodiscard]] std::size_t count() const { return last - first; }
};

// Points of one line, ready to be plotted.
struct Trace {
  std::vector<double> time_s;
  std::vector<double> value;
};

// How many of so many samples are drawn as one group: the most that are not wider than one of the
// columns of pixels, and at least 1. Large groups are made of whole blocks of the pyramid, from 4
// to 16 of them, and so up to a fifth smaller than a column.
[[nodiscard]] std::size_t decimation_group(std::size_t samples, std::size_t columns);

// Keeps at least the newest `capacity` samples, and not many more, in columns. A sample that is not
// newer than the last one means that the session was reset: everything older is forgotten. A copy
// is cheap and stays as it is while the original grows, on another thread too; only one of the two
// may be pushed to. Realtime-safe: no.
class SampleHistory {
 public:
  explicit SampleHistory(std::size_t capacity);

  void push(const Sample& sample);
  void push(std::span<const Sample> samples);
  void clear();

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] double oldest_time_s() const;  // 0 where empty
  [[nodiscard]] double newest_time_s() const;  // 0 where empty

  // Precondition of both: index < size().
  [[nodiscard]] double value(Quantity quantity, std::size_t index) const {
    return column(quantity)[oldest() + index];
  }
  // As it was pushed, but for the generation of its parameters.
  [[nodiscard]] Sample sample(std::size_t index) const;

  // The samples within [from_s, to_s] and one more on either side, so that lines reach the edges.
  [[nodiscard]] IndexRange range(double from_s, double to_s) const;
  // The same without those beyond the edges.
  [[nodiscard]] IndexRange range_within(double from_s, double to_s) const;
  // The sample whose time is nearest; nothing where empty.
  [[nodiscard]] std::optional<std::size_t> nearest(double time_s) const;

  // Precondition: the range is not empty.
  [[nodiscard]] Extremes extremes(Quantity quantity, IndexRange range) const;

  // The newest sample of the range at which the quantity is above `threshold`, or is not.
  [[nodiscard]] std::optional<std::size_t> newest_above(Quantity quantity, IndexRange range,
                                                        double threshold) const;
  [[nodiscard]] std::optional<std::size_t> newest_not_above(Quantity quantity, IndexRange range,
                                                            double threshold) const;

  // Reduces the range to what `columns` columns of pixels can show: of each decimation_group() the
  // smallest and the largest sample, both at the time of its middle. Values are multiplied by
  // `scale` (not 0). No spike is lost, none is made up, and where there are fewer than three
  // samples to a column, every sample is there. Groups are fixed to the samples' count since the
  // reset, so that a moving window does not flicker. Costs O(columns) steps however many samples
  // there are.
  void decimate(Quantity quantity, IndexRange range, std::size_t columns, double scale,
                Trace& trace) const;

 private:
  [[nodiscard]] const SamplePyramid& column(Quantity quantity) const {
    return columns_[static_cast<std::size_t>(quantity)];
  }
  [[nodiscard]] std::uint64_t oldest() const { return columns_.front().first(); }
  [[nodiscard]] std::size_t first_not_before(double time_s) const;
  [[nodiscard]] std::optional<std::size_t> by_age(std::optional<std::uint64_t> index) const;

  std::size_t capacity_;
  std::uint64_t newest_tick_ = 0;
  std::array<SamplePyramid, kQuantityCount> columns_;
};

}  // namespace hapticwall::ui
