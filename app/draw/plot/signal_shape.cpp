#include "app/draw/plot/signal_shape.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hapticwall::draw {
namespace {

void clear(SignalShape& shape) {
  for (Trace* trace : {&shape.line, &shape.strokes}) {
    trace->time_s.clear();
    trace->value.clear();
  }
  shape.band.clear();
  shape.groups.clear();
  shape.travelled.clear();
  shape.line_end.clear();
}

// Makes groups and strokes, and sums the travel of the strokes. A gap has no travel.
void collect(const SampleHistory& history, Quantity quantity, IndexRange range, std::size_t columns,
             double scale, SignalShape& shape) {
  double travelled = 0.0;
  history.for_each_group(quantity, range, columns, [&](const SampleGroup& group) {
    const std::size_t before = shape.strokes.value.size();
    append_group(group, scale, shape.strokes);
    for (std::size_t i = std::max<std::size_t>(before, 1); i < shape.strokes.value.size(); ++i) {
      const double step = std::abs(shape.strokes.value[i] - shape.strokes.value[i - 1]);
      if (!std::isnan(step)) travelled += step;
    }
    shape.groups.push_back(group);
    shape.travelled.push_back(travelled);
    shape.line_end.push_back(shape.strokes.value.size());
  });
}

// Groups [first, last] around `middle`.
struct Window {
  std::size_t first = 0;
  std::size_t middle = 0;
  std::size_t last = 0;
};

// Two runs of a power of two cover any window, so a lookup costs the same for any reach.
void find_extremes(SignalShape& shape, std::size_t reach) {
  const std::size_t count = shape.groups.size();
  const auto levels = static_cast<std::size_t>(std::bit_width(2 * reach + 1));
  if (shape.extremes.size() < levels) shape.extremes.resize(levels);
  shape.extremes.front().clear();
  for (const SampleGroup& group : shape.groups)
    shape.extremes.front().push_back(group.stats.extremes);
  for (std::size_t level = 1; level < levels; ++level) {
    const std::vector<Extremes>& half = shape.extremes[level - 1];
    const std::size_t away = std::size_t{1} << (level - 1);
    shape.extremes[level] = half;
    for (std::size_t i = 0; i + away < count; ++i) shape.extremes[level][i].include(half[i + away]);
  }
}

Extremes extremes_of(const SignalShape& shape, Window window, double scale) {
  const std::size_t count = window.last - window.first + 1;
  const auto level = static_cast<std::size_t>(std::bit_width(count)) - 1;
  Extremes all = shape.extremes[level][window.first];
  all.include(shape.extremes[level][window.last + 1 - (std::size_t{1} << level)]);
  return {all.minimum * scale, all.maximum * scale};
}

// Nearer groups count more: a cycle that does not fit the window leaves little of itself.
double mean_of(const SignalShape& shape, Window window) {
  double sum = 0.0;
  double weights = 0.0;
  const std::size_t reach = std::max(window.middle - window.first, window.last - window.middle);
  for (std::size_t i = window.first; i <= window.last; ++i) {
    const SampleStats& stats = shape.groups[i].stats;
    const std::size_t away = i > window.middle ? i - window.middle : window.middle - i;
    const auto weight = static_cast<double>(reach + 1 - away);
    sum += weight * stats.sum;
    weights += weight * stats.count;
  }
  return sum / weights;
}

bool oscillates(const SignalShape& shape, Window window, const Extremes& extremes, bool before) {
  const double travelled = shape.travelled[window.last] - shape.travelled[window.first];
  return travelled > (before ? kKeptTravel : kBandTravel) * (extremes.maximum - extremes.minimum);
}

void add_strokes(SignalShape& shape, std::size_t group) {
  const std::size_t first = group > 0 ? shape.line_end[group - 1] : 0;
  for (std::size_t i = first; i < shape.line_end[group]; ++i) {
    shape.line.time_s.push_back(shape.strokes.time_s[i]);
    shape.line.value.push_back(shape.strokes.value[i]);
  }
}

}  // namespace

void shape_signal(const SampleHistory& history, Quantity quantity, IndexRange range,
                  std::size_t columns, double scale, SignalShape& shape) {
  clear(shape);
  collect(history, quantity, range, columns, scale, shape);
  const std::size_t count = shape.groups.size();
  const auto reach = static_cast<std::size_t>(kBandReach * static_cast<double>(count) /
                                              static_cast<double>(columns));
  find_extremes(shape, reach);
  const auto around = [&](std::size_t i, std::size_t groups) {
    return Window{i - std::min(i, groups), i, std::min(i + groups, count - 1)};
  };
  // Near its ends, the signal is treated as it is one reach away from them.
  const std::size_t room = std::min(reach, (std::max<std::size_t>(count, 1) - 1) / 2);
  bool in_band = false;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t inside = std::clamp(i, room, count - 1 - room);
    const Window window = around(inside, reach);
    in_band = !shape.groups[i].stats.empty() &&
              oscillates(shape, window, extremes_of(shape, window, scale), in_band);
    if (!in_band) {
      add_strokes(shape, i);
      continue;
    }
    const double time_s = shape.groups[i].time_s;
    const Extremes extremes = extremes_of(shape, around(i, reach / 2), scale);
    shape.band.push_back({time_s, extremes.minimum, extremes.maximum});
    shape.line.time_s.push_back(time_s);
    shape.line.value.push_back(mean_of(shape, window) * scale);
  }
}

}  // namespace hapticwall::draw
