// A column of samples with extremes and sums of its blocks, for extremes and mean of any range in
// few steps.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "app/draw/plot/sample_blocks.h"

namespace hapticwall::draw {

struct Extremes {
  double minimum = 0.0;
  double maximum = 0.0;

  void include(const Extremes& more) {
    minimum = std::min(minimum, more.minimum);
    maximum = std::max(maximum, more.maximum);
  }
};
// The same from nothing.
inline void include(std::optional<Extremes>& all, const Extremes& more) {
  if (!all) all = more;
  all->include(more);
}

// Of some samples without the masked ones; of none, the extremes are {infinity, -infinity}.
struct SampleStats {
  Extremes extremes{std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};
  double sum = 0.0;
  double count = 0.0;

  void include(const SampleStats& more) {
    extremes.include(more.extremes);
    sum += more.sum;
    count += more.count;
  }
  [[nodiscard]] bool empty() const { return count == 0.0; }
  [[nodiscard]] double mean() const { return sum / count; }  // NaN if empty
};

// A sample without a meaning: no line, extreme or mean shows it.
inline constexpr double kMasked = std::numeric_limits<double>::quiet_NaN();

// Levels of blocks lie over the samples: of 16 samples, of 64, of 256 and so on. Each block holds
// the stats of its samples. A push updates them in less than two comparisons of pairs.
// Indices are those of BlockArray. All values must be finite or kMasked.
class SamplePyramid {
 public:
  static constexpr std::uint64_t kMinBlock = 16;  // samples
  static constexpr std::uint64_t kFan = 4;        // blocks in a block of the next level
  static constexpr std::size_t kLevels = 9;       // the largest block: 2^20 samples

  void push_back(double value);
  void forget_before(std::uint64_t index);

  [[nodiscard]] std::uint64_t first() const { return samples_.first(); }
  [[nodiscard]] std::uint64_t end() const { return samples_.end(); }
  [[nodiscard]] double operator[](std::uint64_t index) const { return samples_[index]; }

  // Of the samples [first, last).
  [[nodiscard]] SampleStats stats(std::uint64_t first, std::uint64_t last) const;

  // The sum of their squared distances from `mean`.
  [[nodiscard]] double squares(std::uint64_t first, std::uint64_t last, double mean) const;

  // The newest of the samples [first, last) that is above `threshold`, or that is not.
  [[nodiscard]] std::optional<std::uint64_t> newest_above(std::uint64_t first, std::uint64_t last,
                                                          double threshold) const;
  [[nodiscard]] std::optional<std::uint64_t> newest_not_above(std::uint64_t first,
                                                              std::uint64_t last,
                                                              double threshold) const;

  // Calls `block(stats)` and `sample(value)` for the few parts that make up [first, last), in
  // order.
  template <typename Block, typename SingleSample>
  void visit_parts(std::uint64_t first, std::uint64_t last, Block&& block,
                   SingleSample&& sample) const {
    while (first < last) {
      std::size_t level = 0;  // blocks of this level, plus 1; 0: single samples
      while (level < kLevels && first % size_of(level) == 0 && first + size_of(level) <= last)
        ++level;
      if (level > 0) {
        block(levels_[level - 1][first / size_of(level - 1)]);
        first += size_of(level - 1);
        continue;
      }
      const std::uint64_t next = (first / kMinBlock + 1) * kMinBlock;
      for (const std::uint64_t stop = next < last ? next : last; first < stop; ++first)
        sample(samples_[first]);
    }
  }

  [[nodiscard]] static constexpr std::uint64_t size_of(std::size_t level) {
    return kMinBlock << (2 * level);
  }

 private:
  template <typename Wanted>
  [[nodiscard]] std::optional<std::uint64_t> newest(std::uint64_t first, std::uint64_t last,
                                                    Wanted&& wanted) const;

  [[nodiscard]] double raw_squares(std::uint64_t first, std::uint64_t last, double mean) const;

  // Squares exist for blocks of this level only: 1024 samples.
  static constexpr std::size_t kSquaresLevel = 3;

  BlockArray<double> samples_;
  BlockArray<double> squares_;  // distances from the mean of the block
  std::array<BlockArray<SampleStats>, kLevels> levels_;
  std::array<SampleStats, kLevels> growing_;  // the incomplete blocks
};

}  // namespace hapticwall::draw
