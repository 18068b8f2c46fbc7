// A column of samples with extremes and sums of its blocks, for extremes and mean of any range in
// few steps.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace hapticwall::draw {

// An array that grows at its end and shrinks at its front, in blocks: growing moves nothing, and a
// copy shares the blocks that both have.
//
// An element keeps its index: that of the n-th push is `first` + n. A block whose elements all have
// the same bits (an unmeasured quantity, a force in free motion) takes no memory. A copy is cheap
// and does not change while the original grows, on another thread too, as long as only one of the
// two is pushed to. Realtime-safe: no.
template <typename T>
class BlockArray {
 public:
  static constexpr std::uint64_t kBlock = 1024;  // elements

  // The first push has the index `first`.
  explicit BlockArray(std::uint64_t first = 0) : first_(first / kBlock * kBlock), end_(first) {}

  [[nodiscard]] std::uint64_t first() const { return first_; }  // the oldest one kept
  [[nodiscard]] std::uint64_t end() const { return end_; }

  // Precondition: first() <= index < end().
  [[nodiscard]] const T& operator[](std::uint64_t index) const {
    const Block& block = blocks_[static_cast<std::size_t>((index - first_) / kBlock)];
    return block.values != nullptr ? block.values[static_cast<std::ptrdiff_t>(index % kBlock)]
                                   : block.same;
  }

  void push_back(const T& value) {
    const auto place = static_cast<std::ptrdiff_t>(end_ % kBlock);
    if (place == 0 || blocks_.empty()) blocks_.push_back({nullptr, value});
    Block& block = blocks_.back();
    if (block.values == nullptr && !same_bits(block.same, value)) {
      block.values = std::make_shared<T[]>(kBlock);
      std::fill_n(block.values.get(), place, block.same);
    }
    if (block.values != nullptr) block.values[place] = value;
    ++end_;
  }

  // Drops the blocks that end before this index.
  void forget_before(std::uint64_t index) {
    const std::uint64_t whole = (std::min(index, end_) - std::min(index, first_)) / kBlock;
    blocks_.erase(blocks_.begin(), blocks_.begin() + static_cast<std::ptrdiff_t>(whole));
    first_ += whole * kBlock;
  }

 private:
  struct Block {
    std::shared_ptr<T[]> values;  // none: all are `same`
    T same;
  };
  static bool same_bits(const T& a, const T& b) {
    using Bits = std::array<std::byte, sizeof(T)>;
    return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
  }

  std::vector<Block> blocks_;
  std::uint64_t first_;  // a multiple of kBlock
  std::uint64_t end_;
};

struct Extremes {
  double minimum = 0.0;
  double maximum = 0.0;

  void include(const Extremes& more) {
    minimum = std::min(minimum, more.minimum);
    maximum = std::max(maximum, more.maximum);
  }
};
// include() into a range that may be empty.
inline void include(std::optional<Extremes>& all, const Extremes& more) {
  if (!all) all = more;
  all->include(more);
}

// Statistics of some samples without the masked ones; of none, the extremes are {infinity,
// -infinity}.
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

// Statistics of one sample.
[[nodiscard]] inline SampleStats stats_of(double value) {
  if (std::isnan(value)) return {};
  return {{value, value}, value, 1.0};
}

// Levels of blocks: of 16 samples, of 64, of 256 and so on. Each block holds the stats of its
// samples. Takes 3 bytes a sample.
struct BlockLevels {
  static constexpr std::uint64_t kMinBlock = 16;  // samples
  static constexpr std::uint64_t kFan = 4;        // blocks in a block of the next level
  static constexpr std::size_t kLevels = 9;       // the largest block: 2^20 samples
  // Squares exist for blocks of this level only: 1024 samples.
  static constexpr std::size_t kSquaresLevel = 3;

  [[nodiscard]] static constexpr std::uint64_t size_of(std::size_t level) {
    return kMinBlock << (2 * level);
  }

  void forget_before(std::uint64_t first);

  std::array<BlockArray<SampleStats>, kLevels> stats;
  std::array<SampleStats, kLevels> growing;  // the incomplete blocks
  BlockArray<double> squares;                // distances from the mean of the block
};

// Samples under their levels. A push updates these in less than two comparisons of pairs. Indices
// are those of BlockArray. All values must be finite or kMasked.
class SamplePyramid {
 public:
  void push_back(double value) {
    samples_.push_back(value);
    stack(value, samples_.end());
  }
  void forget_before(std::uint64_t index) {
    samples_.forget_before(index);
    levels_.forget_before(samples_.first());
  }

  [[nodiscard]] std::uint64_t first() const { return samples_.first(); }
  [[nodiscard]] std::uint64_t end() const { return samples_.end(); }
  [[nodiscard]] double operator[](std::uint64_t index) const { return samples_[index]; }

  // Statistics of the samples [first, last).
  [[nodiscard]] SampleStats stats(std::uint64_t first, std::uint64_t last) const {
    SampleStats all;
    visit_parts(
        first, last, [&](const SampleStats& block) { all.include(block); },
        [&](double value) { all.include(stats_of(value)); });
    return all;
  }

  // The sum of their squared distances from `mean`.
  [[nodiscard]] double squares(std::uint64_t first, std::uint64_t last, double mean) const;

  // The newest of the samples [first, last) that is above `threshold`, or that is not.
  [[nodiscard]] std::optional<std::uint64_t> newest_above(std::uint64_t first, std::uint64_t last,
                                                          double threshold) const {
    return newest(first, last, [=](const Extremes& part) { return part.maximum > threshold; });
  }
  [[nodiscard]] std::optional<std::uint64_t> newest_not_above(std::uint64_t first,
                                                              std::uint64_t last,
                                                              double threshold) const {
    return newest(first, last, [=](const Extremes& part) { return part.minimum <= threshold; });
  }

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
        block(levels_.stats[level - 1][first / size_of(level - 1)]);
        first += size_of(level - 1);
        continue;
      }
      const std::uint64_t next = (first / BlockLevels::kMinBlock + 1) * BlockLevels::kMinBlock;
      for (const std::uint64_t stop = next < last ? next : last; first < stop; ++first)
        sample(samples_[first]);
    }
  }

 private:
  static constexpr std::size_t kLevels = BlockLevels::kLevels;
  [[nodiscard]] static constexpr std::uint64_t size_of(std::size_t level) {
    return BlockLevels::size_of(level);
  }

  // Updates the levels by the newest sample.
  void stack(double value, std::uint64_t end);
  template <typename Wanted>
  [[nodiscard]] std::optional<std::uint64_t> newest(std::uint64_t first, std::uint64_t last,
                                                    Wanted&& wanted) const;
  [[nodiscard]] double raw_squares(std::uint64_t first, std::uint64_t last, double mean) const;

  BlockArray<double> samples_;
  BlockLevels levels_;
};

// `wanted(extremes)`: whether a block may hold a wanted sample; of a sample's own extremes, whether
// it is wanted.
template <typename Wanted>
std::optional<std::uint64_t> SamplePyramid::newest(std::uint64_t first, std::uint64_t last,
                                                   Wanted&& wanted) const {
  std::size_t highest = kLevels;
  while (last > first) {
    std::size_t level = 0;  // like visit_parts(), from the other end
    while (level < highest && last % size_of(level) == 0 && last - first >= size_of(level)) ++level;
    const std::uint64_t size = level > 0 ? size_of(level - 1) : 1;
    const Extremes part = level > 0 ? levels_.stats[level - 1][last / size - 1].extremes
                                    : Extremes{samples_[last - 1], samples_[last - 1]};
    if (!wanted(part)) {
      last -= size;
    } else if (level == 0) {
      return last - 1;
    } else {
      highest = level - 1;  // the sample is in this block
    }
  }
  return std::nullopt;
}

}  // namespace hapticwall::draw
