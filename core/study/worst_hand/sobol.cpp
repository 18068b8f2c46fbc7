#include "core/study/worst_hand/sobol.h"

#include <bit>

namespace hapticwall::worst_hand {
namespace {

// A primitive polynomial: its degree, its inner coefficients as bits, and the first numbers.
struct Primitive {
  std::size_t degree;
  std::uint32_t coefficients;
  std::array<std::uint32_t, 4> first;
};
// Direction numbers of the second and the following dimensions; those of the first are all 1.
constexpr std::array<Primitive, kHandNumbers - 1> kPrimitives{{{1, 0, {1}},
                                                               {2, 1, {1, 3}},
                                                               {3, 1, {1, 3, 1}},
                                                               {3, 2, {1, 1, 1}},
                                                               {4, 1, {1, 1, 3, 3}},
                                                               {4, 4, {1, 3, 5, 13}}}};

}  // namespace

Sobol::Sobol(Random& random, std::size_t numbers) : numbers_(numbers) {
  for (std::size_t bit = 0; bit < kBits; ++bit) directions_[0][bit] = 1U << (kBits - 1 - bit);
  for (std::size_t i = 1; i < kHandNumbers; ++i) {
    const Primitive& polynomial = kPrimitives.at(i - 1);
    auto& directions = directions_.at(i);
    for (std::size_t bit = 0; bit < kBits; ++bit) {
      if (bit < polynomial.degree) {
        directions.at(bit) = polynomial.first.at(bit) << (kBits - 1 - bit);
        continue;
      }
      const std::uint32_t back = directions.at(bit - polynomial.degree);
      directions.at(bit) = back ^ (back >> polynomial.degree);
      for (std::size_t k = 1; k < polynomial.degree; ++k) {
        if (((polynomial.coefficients >> (polynomial.degree - 1 - k)) & 1U) != 0)
          directions.at(bit) ^= directions.at(bit - k);
      }
    }
  }
  for (std::size_t i = 0; i < numbers_; ++i)
    now_.at(i) = static_cast<std::uint32_t>(random.bits() >> 32U);
}

HandPoint Sobol::next() {
  HandPoint point{};
  for (std::size_t i = 0; i < numbers_; ++i) point.at(i) = (now_.at(i) + 0.5) * 0x1p-32;
  const auto bit = static_cast<std::size_t>(std::countr_one(count_++));
  for (std::size_t i = 0; i < kHandNumbers; ++i) now_.at(i) ^= directions_.at(i).at(bit);
  return point;
}

}  // namespace hapticwall::worst_hand
