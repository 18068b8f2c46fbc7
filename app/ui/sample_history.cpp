#include "app/ui/sample_history.h"

#include <algorithm>
#include <cmath>

namespace hapticwall::ui {
namespace {

std::array<double, kQuantityCount> quantities_of(const Sample& sample) {
  return {
      sample.time_s,        sample.position_m,   sample.truth.position_m,  sample.truth.hand_path_m,
      sample.force_n,       sample.wall_force_n, sample.stiffness_n_per_m, sample.energy_cv_j,
      sample.energy_hold_j, sample.energy_scv_j, sample.energy_budget_j};
}

}  // namespace

SampleHistory::SampleHistory(std::size_t capacity)
    : capacity_(std::max<std::size_t>(capacity, 1)) {}

void SampleHistory::push(const Sample& sample) {
  if (!empty() && sample.tick <= newest_tick_) clear();
  // The front is cut off only once a whole capacity has piled up: a cheap step, taken seldom.
  if (size() >= 2 * capacity_) forget_old();
  const auto values = quantities_of(sample);
  for (std::size_t i = 0; i < kQuantityCount; ++i) columns_[i].push_back(values[i]);
  newest_tick_ = sample.tick;
}

void SampleHistory::push(std::span<const Sample> samples) {
  for (const Sample& sample : samples) push(sample);
}

void SampleHistory::clear() {
  for (auto& column : columns_) column.clear();
  forgotten_ = 0;
}

void SampleHistory::forget_old() {
  const std::size_t surplus = size() - capacity_;
  for (auto& column : columns_) {
    column.erase(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(surplus));
  }
  forgotten_ += surplus;
}

double SampleHistory::newest_time_s() const {
  return empty() ? 0.0 : column(Quantity::kTime).back();
}

std::span<const double> SampleHistory::column(Quantity quantity) const {
  return columns_[static_cast<std::size_t>(quantity)];
}

IndexRange SampleHistory::range(double from_s, double to_s) const {
  const std::span<const double> time = column(Quantity::kTime);
  const auto begin = std::lower_bound(time.begin(), time.end(), from_s);
  const auto end = std::upper_bound(begin, time.end(), to_s);
  IndexRange result{static_cast<std::size_t>(begin - time.begin()),
                    static_cast<std::size_t>(end - time.begin())};
  if (result.first > 0) --result.first;
  if (result.last < time.size()) ++result.last;
  return result;
}

Extremes SampleHistory::extremes(Quantity quantity, IndexRange range) const {
  const std::span<const double> values = column(quantity).subspan(range.first, range.count());
  Extremes result{values.front(), values.front()};
  for (const double value : values) {
    result.minimum = std::min(result.minimum, value);
    result.maximum = std::max(result.maximum, value);
  }
  return result;
}

void SampleHistory::decimate(Quantity quantity, IndexRange range, std::size_t columns, double scale,
                             Trace& trace) const {
  trace.time_s.clear();
  trace.value.clear();
  const std::span<const double> time = column(Quantity::kTime);
  const std::span<const double> values = column(quantity);
  const auto add = [&](std::size_t index) {
    trace.time_s.push_back(time[index]);
    trace.value.push_back(values[index] * scale);
  };
  // One group fewer than columns: the first and the last group may be cut by the edges of the
  // range.
  const std::size_t groups = std::max<std::size_t>(columns, 2) - 1;
  const std::size_t group = (range.count() + groups - 1) / groups;
  if (group <= 2) {
    for (std::size_t i = range.first; i < range.last; ++i) add(i);
    return;
  }
  std::size_t first = range.first;
  while (first < range.last) {
    const std::size_t used = static_cast<std::size_t>((forgotten_ + first) % group);
    const std::size_t last = std::min(first + group - used, range.last);
    std::size_t lowest = first;
    std::size_t highest = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      if (values[i] < values[lowest]) lowest = i;
      if (values[i] > values[highest]) highest = i;
    }
    // Whichever extreme is nearer to where the line stands comes first: the line then crosses a
    // column once instead of twice, which halves what a software renderer has to paint.
    const double stands = trace.value.empty() ? values[first] : trace.value.back() / scale;
    const bool low_first = std::abs(stands - values[lowest]) <= std::abs(stands - values[highest]);
    trace.time_s.push_back(time[std::min(lowest, highest)]);
    trace.value.push_back(values[low_first ? lowest : highest] * scale);
    if (lowest != highest) {
      trace.time_s.push_back(time[std::max(lowest, highest)]);
      trace.value.push_back(values[low_first ? highest : lowest] * scale);
    }
    first = last;
  }
}

}  // namespace hapticwall::ui
