// An array that grows at its end and shrinks at its front, in blocks: growing moves nothing, and a
// copy shares the blocks that both have.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace hapticwall::draw {

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

}  // namespace hapticwall::draw
