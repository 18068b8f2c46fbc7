#include "app/draw/plot/sample_history.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hapticwall::draw {

void append_group(const SampleGroup& group, double scale, Trace& trace) {
  const auto add = [&](double value) {
    trace.time_s.push_back(group.time_s);
    trace.value.push_back(value * scale);
  };
  if (group.stats.empty()) return add(kMasked);
  const auto [minimum, maximum] = group.stats.extremes;
  // The extreme nearer to the line's end comes first: the line then crosses a column once, which
  // halves the pixels that a software renderer paints.
  const double stands = trace.value.empty() ? group.first : trace.value.back() / scale;
  const bool low_first = !(std::abs(stands - minimum) > std::abs(stands - maximum));
  add(low_first ? minimum : maximum);
  if (minimum != maximum) add(low_first ? maximum : minimum);
}

std::size_t decimation_group(std::size_t samples, std::size_t columns) {
  const std::size_t most = std::max<std::size_t>(samples / std::max<std::size_t>(columns, 1), 1);
  std::size_t unit = 1;
  for (std::size_t level = 0; level < BlockLevels::kLevels; ++level) {
    if (BlockLevels::size_of(level) * BlockLevels::kFan <= most)
      unit = static_cast<std::size_t>(BlockLevels::size_of(level));
  }
  return most / unit * unit;
}

SampleHistory::SampleHistory(std::size_t capacity, std::optional<double> count_m)
    : capacity_(std::max<std::size_t>(capacity, 1)), count_m_(count_m.value_or(0.0)) {}

void SampleHistory::push(const Sample& sample) {
  if (!empty() && sample.tick <= newest_tick_) clear();
  SamplePyramid* next = columns_.data();
  for_each_column(sample, [&](const SampleColumn& /*column*/, const auto& value) {
    (next++)->push_back(static_cast<double>(value));
  });
  (next++)->push_back(stiffness_.push(sample, count_m_));
  for (const double signal : sample.signals) (next++)->push_back(signal);
  newest_tick_ = sample.tick;
  if (size() >= capacity_ + BlockArray<double>::kBlock) {
    for (SamplePyramid& column : columns_) column.forget_before(column.end() - capacity_);
  }
}

void SampleHistory::push(std::span<const Sample> samples) {
  for (const Sample& sample : samples) push(sample);
}

void SampleHistory::clear() {
  columns_.fill(SamplePyramid());
  stiffness_ = {};
}

std::size_t SampleHistory::size() const {
  return static_cast<std::size_t>(columns_.front().end() - columns_.front().first());
}

double SampleHistory::oldest_time_s() const { return empty() ? 0.0 : value(&Sample::time_s, 0); }

double SampleHistory::newest_time_s() const {
  return empty() ? 0.0 : value(&Sample::time_s, size() - 1);
}

Sample SampleHistory::sample(std::size_t index) const {
  Sample sample;
  const SamplePyramid* next = columns_.data();
  for_each_column(sample, [&]<typename Value>(const SampleColumn& /*column*/, Value& value) {
    value = static_cast<Value>((*next++)[oldest() + index]);
  });
  for (std::size_t place = 0; place < kMaxSignals; ++place)
    sample.signals[place] = columns_[kFirstSignal + place][oldest() + index];
  return sample;
}

std::size_t SampleHistory::first_not_before(double time_s) const {
  std::size_t first = 0;
  std::size_t last = size();
  while (first < last) {
    const std::size_t middle = first + (last - first) / 2;
    if (value(&Sample::time_s, middle) < time_s) {
      first = middle + 1;
    } else {
      last = middle;
    }
  }
  return first;
}

IndexRange SampleHistory::range_within(double from_s, double to_s) const {
  const std::size_t first = first_not_before(from_s);
  std::size_t last = first_not_before(to_s);
  if (last < size() && value(&Sample::time_s, last) == to_s) ++last;
  return {first, std::max(first, last)};
}

IndexRange SampleHistory::range(double from_s, double to_s) const {
  IndexRange result = range_within(from_s, to_s);
  if (result.first > 0) --result.first;
  if (result.last < size()) ++result.last;
  return result;
}

std::optional<std::size_t> SampleHistory::nearest(double time_s) const {
  if (empty()) return std::nullopt;
  const std::size_t after = std::min(first_not_before(time_s), size() - 1);
  if (after == 0) return after;
  const double before_s = time_s - value(&Sample::time_s, after - 1);
  return value(&Sample::time_s, after) - time_s < before_s ? after : after - 1;
}

SampleStats SampleHistory::stats(Quantity quantity, IndexRange range) const {
  return column(quantity).stats(oldest() + range.first, oldest() + range.last);
}

Extremes SampleHistory::extremes(Quantity quantity, IndexRange range) const {
  return stats(quantity, range).extremes;
}

double SampleHistory::variance(Quantity quantity, IndexRange range) const {
  const SampleStats all = stats(quantity, range);
  if (all.empty()) return 0.0;
  return column(quantity).squares(oldest() + range.first, oldest() + range.last, all.mean()) /
         all.count;
}

std::optional<std::size_t> SampleHistory::by_age(std::optional<std::uint64_t> index) const {
  if (!index) return std::nullopt;
  return static_cast<std::size_t>(*index - oldest());
}

std::optional<std::size_t> SampleHistory::newest_above(Quantity quantity, IndexRange range,
                                                       double threshold) const {
  return by_age(
      column(quantity).newest_above(oldest() + range.first, oldest() + range.last, threshold));
}

std::optional<std::size_t> SampleHistory::newest_not_above(Quantity quantity, IndexRange range,
                                                           double threshold) const {
  return by_age(
      column(quantity).newest_not_above(oldest() + range.first, oldest() + range.last, threshold));
}

void SampleHistory::decimate(Quantity quantity, IndexRange range, std::size_t columns, double scale,
                             Trace& trace) const {
  trace.time_s.clear();
  trace.value.clear();
  for_each_group(quantity, range, columns,
                 [&](const SampleGroup& group) { append_group(group, scale, trace); });
}

void TickHistory::push(std::span<const Tick> ticks) {
  for (const Tick& tick : ticks) {
    for (std::size_t axis = 0; axis < tick.count; ++axis) axes_[axis].push(tick.axes[axis]);
  }
}

void TickHistory::set_counts(const Scene& scene) {
  for (std::size_t axis = 0; axis < scene.axes.size(); ++axis)
    axes_[axis].set_count(scene.axes[axis].device.encoder_m);
}

void TickHistory::name_signals(const SignalNames& names) {
  for (SampleHistory& axis : axes_) axis.name_signals(names);
}

void TickHistory::clear() {
  for (SampleHistory& axis : axes_) axis.clear();
}

}  // namespace hapticwall::draw
