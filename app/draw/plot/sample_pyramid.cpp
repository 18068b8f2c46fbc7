#include "app/draw/plot/sample_pyramid.h"

#include <cmath>

namespace hapticwall::draw {
namespace {

static_assert(SamplePyramid::kFan == 4, "size_of() shifts by two bits a level");

SampleStats stats_of(double value) {
  if (std::isnan(value)) return {};
  return {{value, value}, value, 1.0};
}

}  // namespace

void SamplePyramid::push_back(double value) {
  samples_.push_back(value);
  SampleStats carried = stats_of(value);
  for (std::size_t level = 0; level < kLevels; ++level) {
    growing_[level].include(carried);
    if (samples_.end() % size_of(level) != 0) return;
    carried = growing_[level];
    levels_[level].push_back(carried);
    if (level == kSquaresLevel)
      squares_.push_back(
          raw_squares(samples_.end() - size_of(level), samples_.end(), carried.mean()));
    growing_[level] = {};
  }
}

void SamplePyramid::forget_before(std::uint64_t index) {
  samples_.forget_before(index);
  // No range asks for the block that the new beginning cuts.
  for (std::size_t level = 0; level < kLevels; ++level)
    levels_[level].forget_before(samples_.first() / size_of(level));
  squares_.forget_before(samples_.first() / size_of(kSquaresLevel));
}

SampleStats SamplePyramid::stats(std::uint64_t first, std::uint64_t last) const {
  SampleStats all;
  visit_parts(
      first, last, [&](const SampleStats& block) { all.include(block); },
      [&](double value) { all.include(stats_of(value)); });
  return all;
}

double SamplePyramid::raw_squares(std::uint64_t first, std::uint64_t last, double mean) const {
  double sum = 0.0;
  for (std::uint64_t i = first; i < last; ++i) {
    const double distance = samples_[i] - mean;
    if (!std::isnan(distance)) sum += distance * distance;
  }
  return sum;
}

double SamplePyramid::squares(std::uint64_t first, std::uint64_t last, double mean) const {
  constexpr std::uint64_t kSize = size_of(kSquaresLevel);
  const std::uint64_t first_block = (first + kSize - 1) / kSize;
  const std::uint64_t last_block = last / kSize;
  if (first_block >= last_block) return raw_squares(first, last, mean);
  double sum =
      raw_squares(first, first_block * kSize, mean) + raw_squares(last_block * kSize, last, mean);
  for (std::uint64_t i = first_block; i < last_block; ++i) {
    const SampleStats& block = levels_[kSquaresLevel][i];
    if (block.empty()) continue;
    const double distance = block.mean() - mean;
    sum += squares_[i] + block.count * distance * distance;
  }
  return sum;
}

// `wanted(extremes)`: whether a block may hold a wanted sample; of a sample's own extremes, whether
// it is wanted.
template <typename Wanted>
std::optional<std::uint64_t> SamplePyramid::newest(std::uint64_t first, std::uint64_t last,
                                                   Wanted&& wanted) const {
  std::size_t highest = kLevels;
  while (last > first) {
    std::size_t level = 0;  // as in visit_parts(), from the other end
    while (level < highest && last % size_of(level) == 0 && last - first >= size_of(level)) ++level;
    const std::uint64_t size = level > 0 ? size_of(level - 1) : 1;
    const Extremes part = level > 0 ? levels_[level - 1][last / size - 1].extremes
                                    : Extremes{samples_[last - 1], samples_[last - 1]};
    if (!wanted(part)) {
      last -= size;
    } else if (level == 0) {
      return last - 1;
    } else {
      highest = level - 1;  // it is in this block
    }
  }
  return std::nullopt;
}

std::optional<std::uint64_t> SamplePyramid::newest_above(std::uint64_t first, std::uint64_t last,
                                                         double threshold) const {
  return newest(first, last, [=](const Extremes& part) { return part.maximum > threshold; });
}

std::optional<std::uint64_t> SamplePyramid::newest_not_above(std::uint64_t first,
                                                             std::uint64_t last,
                                                             double threshold) const {
  return newest(first, last, [=](const Extremes& part) { return part.minimum <= threshold; });
}

}  // namespace hapticwall::draw
