#include "core/plant/taylor_polynomial.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hapticwall {
namespace {

constexpr std::size_t kTerms = kTaylorDegree + 1;
template <typename Real>
using Coefficients = std::array<Real, kTerms>;

// binomial(i, j) / binomial(degree, j): power basis to Bernstein basis.
constexpr std::array<Coefficients<long double>, kTerms> make_bernstein_matrix() {
  std::array<Coefficients<long double>, kTerms> binomial{};
  for (std::size_t i = 0; i < kTerms; ++i) {
    binomial[i][0] = 1.0L;
    for (std::size_t j = 1; j <= i; ++j) {
      binomial[i][j] = binomial[i - 1][j - 1] + (j < i ? binomial[i - 1][j] : 0.0L);
    }
  }
  std::array<Coefficients<long double>, kTerms> matrix{};
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (std::size_t j = 0; j <= i; ++j) matrix[i][j] = binomial[i][j] / binomial[kTerms - 1][j];
  }
  return matrix;
}
constexpr std::array<Coefficients<long double>, kTerms> kLongToBernstein = make_bernstein_matrix();

template <typename Real>
constexpr std::array<Coefficients<Real>, kTerms> rounded_bernstein_matrix() {
  std::array<Coefficients<Real>, kTerms> matrix{};
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (std::size_t j = 0; j <= i; ++j) matrix[i][j] = static_cast<Real>(kLongToBernstein[i][j]);
  }
  return matrix;
}
template <typename Real>
constexpr std::array<Coefficients<Real>, kTerms> kToBernstein = rounded_bernstein_matrix<Real>();

template <typename Real>
Coefficients<Real> to_bernstein(const Coefficients<Real>& power) {
  const auto& matrix = kToBernstein<Real>;
  Coefficients<Real> result{};
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (std::size_t j = 0; j <= i; ++j) result[i] += matrix[i][j] * power[j];
  }
  return result;
}

template <typename Real>
int sign_changes(const Coefficients<Real>& b) {
  int changes = 0;
  Real last = 0;
  for (const Real value : b) {
    if (value == 0) continue;
    if (last != 0 && (value > 0) != (last > 0)) ++changes;
    last = value;
  }
  return changes;
}

// de Casteljau at 1/2: `b` becomes the right half, the result is the left half.
template <typename Real>
Coefficients<Real> split_left(Coefficients<Real>& b) {
  Coefficients<Real> left{};
  for (std::size_t level = 0; level < kTerms; ++level) {
    left[level] = b[0];
    for (std::size_t i = 0; i + 1 + level < kTerms; ++i) b[i] = (b[i] + b[i + 1]) / 2;
  }
  // Each level leaves its last value in place, so `b` now holds the right half in order.
  return left;
}

// Newton from the middle, replaced by bisection wherever it leaves [low, high]; P(low) > 0 >
// P(high) after multiplication by `sign`.
template <typename Real>
Real refine(const TaylorPolynomial<Real>& p, Real sign, Real low, Real high) {
  constexpr int kMaxIterations = 100;
  Real theta = (low + high) / 2;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Real value = sign * p.at(theta);
    if (value == 0) return theta;
    (value > 0 ? low : high) = theta;
    const Real slope = sign * p.slope_at(theta);
    Real next = slope != 0 ? theta - value / slope : low;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (next == theta || next <= low || next >= high) return next;
    theta = next;
  }
  return theta;
}

// The answer of search() on [0, 1] in the simple cases, without Bernstein coefficients: P keeps its
// sign, or it is monotone and clearly ends on one side.
enum class Plain : std::uint8_t { kNo, kStays, kCrosses };
template <typename Real>
Plain plain_case(const Coefficients<Real>& c, Real sign) {
  constexpr Real kMargin{1e-9};  // far above the rounding of these sums
  Real rest = 0;
  Real rest_of_slope = 0;
  Real end = 0;
  for (std::size_t j = kTerms - 1; j > 0; --j) {
    rest += std::abs(c[j]);
    if (j > 1) rest_of_slope += static_cast<Real>(j) * std::abs(c[j]);
    end += c[j];
  }
  const Real begin = sign * c[0];
  end = begin + sign * end;
  const Real rounding = kMargin * (std::abs(begin) + rest);
  if (begin - rest > rounding) return Plain::kStays;
  if (begin < rounding || std::abs(c[1]) - rest_of_slope < rounding) return Plain::kNo;
  if (end > rounding) return Plain::kStays;
  return end < -rounding ? Plain::kCrosses : Plain::kNo;
}

constexpr int kMaxDepth = 48;

template <typename Real>
std::optional<Real> search(const TaylorPolynomial<Real>& p, Real sign, Coefficients<Real> b,
                           Real low, Real high, int depth) {
  const int changes = sign_changes(b);
  if (changes == 0) return std::nullopt;
  if (changes == 1 && b.front() > 0 && b.back() < 0) return refine(p, sign, low, high);
  if (depth == kMaxDepth) return b.back() < 0 ? std::optional<Real>(high) : std::nullopt;
  const Coefficients<Real> left = split_left(b);
  const Real middle = (low + high) / 2;
  if (const auto found = search(p, sign, left, low, middle, depth + 1)) return found;
  return search(p, sign, b, middle, high, depth + 1);
}

template <typename Real>
std::optional<Real> first_crossing_from_above(const TaylorPolynomial<Real>& p, Real sign) {
  const Plain plain = plain_case(p.coefficient, sign);
  if (plain == Plain::kStays) return std::nullopt;
  if (plain == Plain::kCrosses) return refine<Real>(p, sign, 0, 1);
  Coefficients<Real> b = to_bernstein<Real>(p.coefficient);
  if (sign < 0) std::transform(b.begin(), b.end(), b.begin(), [](Real v) { return -v; });
  return search<Real>(p, sign, b, 0, 1, 0);
}

}  // namespace

int halvings_within_reach(double rate_per_s, double period_s) {
  int halvings = 0;
  for (double step_s = period_s; rate_per_s * step_s > kTaylorReach && halvings < kMaxHalvings;
       step_s *= 0.5) {
    ++halvings;
  }
  return halvings;
}

template <typename Real>
Real TaylorPolynomial<Real>::slope_at(Real theta) const {
  Real value = 0;
  for (std::size_t j = kTerms - 1; j > 0; --j) {
    value = value * theta + static_cast<Real>(j) * coefficient[j];
  }
  return value;
}

template <typename Real>
Real TaylorPolynomial<Real>::integral_to(Real theta) const {
  Real value = 0;
  for (std::size_t j = kTerms; j > 0; --j) {
    value = value * theta + coefficient[j - 1] / static_cast<Real>(j);
  }
  return value * theta;
}

template <typename Real, std::size_t kCount>
std::array<Real, kCount> product_integrals(
    const std::array<const TaylorPolynomial<Real>*, kCount>& ps, const TaylorPolynomial<Real>& q,
    Real theta) {
  // One lane a P: the additions of all sums wait for each other anyway.
  using Lanes = Eigen::Array<Real, kCount, 1>;
  std::array<Lanes, kTerms> p;
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (std::size_t k = 0; k < kCount; ++k) {
      p[i][static_cast<Eigen::Index>(k)] = ps[k]->coefficient[i];
    }
  }
  Lanes total = Lanes::Zero();
#pragma GCC unroll 30
  for (std::size_t n = 2 * kTerms - 1; n > 0; --n) {
    const std::size_t degree = n - 1;
    Lanes term = Lanes::Zero();
    const std::size_t first = degree < kTerms ? 0 : degree - (kTerms - 1);
    for (std::size_t i = first; i <= std::min(degree, kTerms - 1); ++i) {
      term += p[i] * q.coefficient[degree - i];
    }
    total = total * theta + term / static_cast<Real>(n);
  }
  total *= theta;
  std::array<Real, kCount> integrals;
  std::copy(total.begin(), total.end(), integrals.begin());
  return integrals;
}

template <typename Real>
std::optional<Real> first_crossing(const TaylorPolynomial<Real>& p, Real sign) {
  const auto& c = p.coefficient;
  if (!(sign * c[0] <= 0)) return first_crossing_from_above(p, sign);
  std::size_t zeros = 1;
  while (zeros < kTerms && c[zeros] == 0) ++zeros;
  if (zeros == kTerms) return std::nullopt;
  if (sign * c[zeros] < 0) return Real(0);
  TaylorPolynomial<Real> q;
  std::copy(c.begin() + static_cast<std::ptrdiff_t>(zeros), c.end(), q.coefficient.begin());
  return first_crossing_from_above(q, sign);
}

template struct TaylorPolynomial<double>;
template struct TaylorPolynomial<long double>;
#define HAPTICWALL_PRODUCT_INTEGRALS(Real, count)                                             \
  template std::array<Real, count> product_integrals(                                         \
      const std::array<const TaylorPolynomial<Real>*, count>&, const TaylorPolynomial<Real>&, \
      Real)
HAPTICWALL_PRODUCT_INTEGRALS(double, 2);
HAPTICWALL_PRODUCT_INTEGRALS(double, 3);
HAPTICWALL_PRODUCT_INTEGRALS(long double, 2);
HAPTICWALL_PRODUCT_INTEGRALS(long double, 3);
#undef HAPTICWALL_PRODUCT_INTEGRALS
template std::optional<double> first_crossing(const TaylorPolynomial<double>&, double);
template std::optional<long double> first_crossing(const TaylorPolynomial<long double>&,
                                                   long double);

}  // namespace hapticwall
