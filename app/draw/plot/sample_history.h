// The newest samples of a session, kept for the plots, and their reduction to the pixels of a
// screen.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "app/draw/plot/displayed_stiffness.h"
#include "app/draw/plot/sample_pyramid.h"
#include "core/algorithm/algorithm.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::draw {

// Columns that the history computes from those of the sample, behind them.
enum class Derived : std::uint8_t { kStiffness };  // see DisplayedStiffness
inline constexpr std::size_t kDerivedCount = 1;
// First column of the signals of algorithms, by place.
inline constexpr std::size_t kFirstSignal = kSampleColumns.size() + kDerivedCount;
inline constexpr std::size_t kQuantityCount = kFirstSignal + kMaxSignals;

// A column of kSampleColumns, written as the member: `history.value(&Sample::force_n, i)`. A member
// that has no column does not compile. Or a computed column.
class Quantity {
 public:
  // The signal of an algorithm at this place of Sample::signals.
  [[nodiscard]] static constexpr Quantity signal(std::size_t place) {
    return Quantity(kFirstSignal + place);
  }
  consteval Quantity(Derived derived)  // NOLINT(google-explicit-constructor)
      : index_(
            static_cast<std::uint8_t>(kSampleColumns.size() + static_cast<std::size_t>(derived))) {}
  template <typename Member>
  requires std::is_member_pointer_v<Member>
  consteval Quantity(Member member)  // NOLINT(google-explicit-constructor): a member is its column
      : index_(static_cast<std::uint8_t>(column_index(member))) {}

  [[nodiscard]] constexpr std::size_t index() const { return index_; }
  friend constexpr bool operator==(Quantity, Quantity) = default;

 private:
  explicit constexpr Quantity(std::size_t index) : index_(static_cast<std::uint8_t>(index)) {}

  std::uint8_t index_;
};

// The window keeps an hour at 1 kHz. About 11 bytes a sample for each quantity; quantities that
// do not change take none.
inline constexpr std::size_t kHistoryCapacity = 3'600'000;

// Samples [first, last) by age: 0 is the oldest that is still kept.
struct IndexRange {
  std::size_t first = 0;
  std::size_t last = 0;

  [[nodiscard]] std::size_t count() const { return last - first; }
};

// Some neighbouring samples that are drawn as one.
struct SampleGroup {
  double time_s = 0.0;  // time of its middle
  double first = 0.0;   // oldest value of the group
  SampleStats stats;
};

// Points of one line, ready to be plotted.
struct Trace {
  std::vector<double> time_s;
  std::vector<double> value;
};

// Adds the extremes of a group, multiplied by `scale`, at its time; kMasked if it is empty.
void append_group(const SampleGroup& group, double scale, Trace& trace);

// The number of samples that are drawn as one group: as many as fit one column of pixels, at least
// 1. A large group is 4 to 16 whole blocks of the pyramid, and so up to a fifth narrower than a
// column.
[[nodiscard]] std::size_t decimation_group(std::size_t samples, std::size_t columns);

// Keeps at least the newest `capacity` samples of one axis, and not many more, in columns. A sample
// that is not newer than the last one means that the session was reset: it clears the history. A
// copy is cheap and does not change while the original grows, on another thread too; only one of
// the two may be pushed to. Realtime-safe: no.
class SampleHistory {
 public:
  // `count_m`: a count of the encoder; nullopt without one.
  explicit SampleHistory(std::size_t capacity, std::optional<double> count_m = std::nullopt);

  // Sets the encoder's count for the samples pushed after this call.
  void set_count(std::optional<double> count_m) { count_m_ = count_m.value_or(0.0); }

  // Names of the signals of algorithms; those of algorithm_signals() until others are set.
  void name_signals(const SignalNames& names) { signals_ = names; }
  [[nodiscard]] SignalNames signals() const { return signals_.value_or(signal_names()); }

  void push(const Sample& sample);
  void push(std::span<const Sample> samples);
  void clear();

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] double oldest_time_s() const;  // 0 if empty
  [[nodiscard]] double newest_time_s() const;  // 0 if empty

  // Precondition of both: index < size().
  [[nodiscard]] double value(Quantity quantity, std::size_t index) const;
  // The sample as it was pushed, without the generation of its parameters.
  [[nodiscard]] Sample sample(std::size_t index) const;

  // The samples within [from_s, to_s] and one more on either side, so that lines reach the edges.
  [[nodiscard]] IndexRange range(double from_s, double to_s) const;
  // range() without the samples beyond the edges.
  [[nodiscard]] IndexRange range_within(double from_s, double to_s) const;
  // The sample whose time is nearest; nullopt if empty.
  [[nodiscard]] std::optional<std::size_t> nearest(double time_s) const;

  // Precondition: the range is not empty. Without masked samples.
  [[nodiscard]] SampleStats stats(Quantity quantity, IndexRange range) const;
  [[nodiscard]] Extremes extremes(Quantity quantity, IndexRange range) const;
  // Variance of the samples that are not masked; 0 without one.
  [[nodiscard]] double variance(Quantity quantity, IndexRange range) const;

  // The newest sample of the range at which the quantity is above `threshold`, or is not.
  [[nodiscard]] std::optional<std::size_t> newest_above(Quantity quantity, IndexRange range,
                                                        double threshold) const;
  [[nodiscard]] std::optional<std::size_t> newest_not_above(Quantity quantity, IndexRange range,
                                                            double threshold) const;

  // Reduces the range to `columns` columns of pixels: the smallest and the largest sample of each
  // decimation_group(), both at the time of its middle, multiplied by `scale` (not 0). It loses no
  // spike and invents none. Below three samples to a column it keeps every sample. Groups are
  // counted from the reset, so that a moving window does not flicker. Costs O(columns) steps for
  // any number of samples.
  void decimate(Quantity quantity, IndexRange range, std::size_t columns, double scale,
                Trace& trace) const;

  // Calls visit(SampleGroup) for each decimation_group() of the range in order; of groups of one or
  // two samples for each sample.
  template <typename Visit>
  void for_each_group(Quantity quantity, IndexRange range, std::size_t columns,
                      Visit&& visit) const {
    const SamplePyramid& time = columns_[Quantity(&Sample::time_s).index()];
    const std::uint64_t group = decimation_group(range.count(), columns);
    const std::uint64_t end = oldest() + range.last;
    const SamplePyramid& values = column(quantity);
    for (std::uint64_t first = oldest() + range.first; first < end;) {
      const std::uint64_t whole = std::min((first / group + 1) * group, end);
      const std::uint64_t last = whole - first <= 2 ? first + 1 : whole;
      visit(
          SampleGroup{time[first + (last - first) / 2], values[first], values.stats(first, last)});
      first = last;
    }
  }

 private:
  [[nodiscard]] const SamplePyramid& column(Quantity quantity) const {
    return columns_[quantity.index()];
  }
  [[nodiscard]] std::uint64_t oldest() const { return columns_.front().first(); }
  [[nodiscard]] std::size_t first_not_before(double time_s) const;
  [[nodiscard]] std::optional<std::size_t> by_age(std::optional<std::uint64_t> index) const;

  std::size_t capacity_;
  double count_m_;
  std::uint64_t newest_tick_ = 0;
  DisplayedStiffness stiffness_;
  std::array<SamplePyramid, kQuantityCount> columns_;
  std::optional<SignalNames> signals_;
};

inline double SampleHistory::value(Quantity quantity, std::size_t index) const {
  return column(quantity)[oldest() + index];
}

// The histories of all axes of a session.
class TickHistory {
 public:
  void push(std::span<const Tick> ticks);
  void clear();
  void set_counts(const Scene& scene);  // see SampleHistory::set_count()
  void name_signals(const SignalNames& names);
  [[nodiscard]] const SampleHistory& axis(std::size_t index) const { return axes_.at(index); }

 private:
  std::array<SampleHistory, kMaxAxes> axes_{SampleHistory(kHistoryCapacity),
                                            SampleHistory(kHistoryCapacity)};
};

}  // namespace hapticwall::draw
