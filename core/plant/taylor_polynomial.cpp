#include "core/plant/taylor_polynomial.h"

#include <algorithm>
#include <cmath>

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

template <typename Real>
Real product_integral(const TaylorPolynomial<Real>& p, const TaylorPolynomial<Real>& q,
                      Real theta) {
  Real total = 0;
  for (std::size_t n = 2 * kTerms - 1; n > 0; --n) {
    const std::size_t degree = n - 1;
    Real term = 0;
    const std::size_t first = degree < kTerms ? 0 : degree - (kTerms - 1);
    for (std::size_t i = first; i <= std::min(degree, kTerms - 1); ++i) {
      term += p.coefficient[i] * q.coefficient[degree - i];
    }
    total = total * theta + term / static_cast<Real>(n);
  }
  return total * theta;
}

template <typename Real>
std::optional<Real> first_crossing(const TaylorPolynomial<Real>& p, Real sign) {
  const auto& c = p.coefficient;
  Real rest = 0;
  for (std::size_t j = 1; j < kTerms; ++j) rest += std::abs(c[j]);
  if (sign * c[0] > rest) return std::nullopt;

  TaylorPolynomial<Real> q = p;
  if (sign * c[0] <= 0) {
    std::size_t zeros = 1;
    while (zeros < kTerms && c[zeros] == 0) ++zeros;
    if (zeros == kTerms) return std::nullopt;
    if (sign * c[zeros] < 0) return Real(0);
    q = TaylorPolynomial<Real>{};
    std::copy(c.begin() + static_cast<std::ptrdiff_t>(zeros), c.end(), q.coefficient.begin());
  }
  Coefficients<Real> b = to_bernstein<Real>(q.coefficient);
  if (sign < 0) std::transform(b.begin(), b.end(), b.begin(), [](Real v) { return -v; });
  return search<Real>(q, sign, b, 0, 1, 0);
}

template struct TaylorPolynomial<double>;
template struct TaylorPolynomial<long double>;
template double product_integral(const TaylorPolynomial<double>&, const TaylorPolynomial<double>&,
                                 double);
template long double product_integral(const TaylorPolynomial<long double>&,
                                      const TaylorPolynomial<long double>&, long double);
template std::optional<double> first_crossing(const TaylorPolynomial<double>&, double);
template std::optional<long double> first_crossing(const TaylorPolynomial<long double>&,
                                                   long double);

}  // namespace hapticwall
