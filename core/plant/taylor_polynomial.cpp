#include "core/plant/taylor_polynomial.h"

#include <algorithm>
#include <cmath>

namespace hapticwall {
namespace {

constexpr std::size_t kTerms = kTaylorDegree + 1;
using Coefficients = std::array<double, kTerms>;

// binomial(i, j) / binomial(degree, j): power basis to Bernstein basis.
constexpr std::array<Coefficients, kTerms> make_bernstein_matrix() {
  std::array<std::array<double, kTerms>, kTerms> binomial{};
  for (std::size_t i = 0; i < kTerms; ++i) {
    binomial[i][0] = 1.0;
    for (std::size_t j = 1; j <= i; ++j) {
      binomial[i][j] = binomial[i - 1][j - 1] + (j < i ? binomial[i - 1][j] : 0.0);
    }
  }
  std::array<Coefficients, kTerms> matrix{};
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (std::size_t j = 0; j <= i; ++j) matrix[i][j] = binomial[i][j] / binomial[kTerms - 1][j];
  }
  return matrix;
}
constexpr std::array<Coefficients, kTerms> kToBernstein = make_bernstein_matrix();

Coefficients to_bernstein(const Coefficients& power) {
  Coefficients result{};
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (std::size_t j = 0; j <= i; ++j) result[i] += kToBernstein[i][j] * power[j];
  }
  return result;
}

int sign_changes(const Coefficients& b) {
  int changes = 0;
  double last = 0.0;
  for (const double value : b) {
    if (value == 0.0) continue;
    if (last != 0.0 && (value > 0.0) != (last > 0.0)) ++changes;
    last = value;
  }
  return changes;
}

// de Casteljau at 1/2: `b` becomes the right half, the result is the left half.
Coefficients split_left(Coefficients& b) {
  Coefficients left{};
  for (std::size_t level = 0; level < kTerms; ++level) {
    left[level] = b[0];
    for (std::size_t i = 0; i + 1 + level < kTerms; ++i) b[i] = 0.5 * (b[i] + b[i + 1]);
  }
  // Every level leaves its last value behind: what stands in `b` now is the right half, in order.
  return left;
}

// Newton from the middle, replaced by bisection wherever it leaves [low, high]; P(low) > 0 >
// P(high) after multiplication by `sign`.
double refine(const TaylorPolynomial& p, double sign, double low, double high) {
  constexpr int kMaximumIterations = 100;
  double theta = 0.5 * (low + high);
  for (int i = 0; i < kMaximumIterations; ++i) {
    const double value = sign * p.at(theta);
    if (value == 0.0) return theta;
    (value > 0.0 ? low : high) = theta;
    const double slope = sign * p.slope_at(theta);
    double next = slope != 0.0 ? theta - value / slope : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == theta || next <= low || next >= high) return next;
    theta = next;
  }
  return theta;
}

constexpr int kMaximumDepth = 48;

std::optional<double> search(const TaylorPolynomial& p, double sign, Coefficients b, double low,
                             double high, int depth) {
  const int changes = sign_changes(b);
  if (changes == 0) return std::nullopt;
  if (changes == 1 && b.front() > 0.0 && b.back() < 0.0) return refine(p, sign, low, high);
  if (depth == kMaximumDepth) return b.back() < 0.0 ? std::optional<double>(high) : std::nullopt;
  const Coefficients left = split_left(b);
  const double middle = 0.5 * (low + high);
  if (const auto found = search(p, sign, left, low, middle, depth + 1)) return found;
  return search(p, sign, b, middle, high, depth + 1);
}

}  // namespace

double TaylorPolynomial::slope_at(double theta) const {
  double value = 0.0;
  for (std::size_t j = kTerms - 1; j > 0; --j) {
    value = value * theta + static_cast<double>(j) * coefficient[j];
  }
  return value;
}

double TaylorPolynomial::integral_to(double theta) const {
  double value = 0.0;
  for (std::size_t j = kTerms; j > 0; --j) {
    value = value * theta + coefficient[j - 1] / static_cast<double>(j);
  }
  return value * theta;
}

double TaylorPolynomial::double_integral_to(double theta) const {
  double value = 0.0;
  for (std::size_t j = kTerms; j > 0; --j) {
    value = value * theta + coefficient[j - 1] / static_cast<double>(j * (j + 1));
  }
  return value * theta * theta;
}

double product_integral(const TaylorPolynomial& p, const TaylorPolynomial& q, double theta) {
  double total = 0.0;
  for (std::size_t n = 2 * kTerms - 1; n > 0; --n) {
    const std::size_t degree = n - 1;
    double term = 0.0;
    const std::size_t first = degree < kTerms ? 0 : degree - (kTerms - 1);
    for (std::size_t i = first; i <= std::min(degree, kTerms - 1); ++i) {
      term += p.coefficient[i] * q.coefficient[degree - i];
    }
    total = total * theta + term / static_cast<double>(n);
  }
  return total * theta;
}

double lagged_product_integral(const TaylorPolynomial& p, const TaylorPolynomial& q, double theta) {
  // The antiderivative has one degree more; its highest term is below the reach of a double.
  TaylorPolynomial antiderivative;
  for (std::size_t j = 1; j < kTerms; ++j) {
    antiderivative.coefficient[j] = q.coefficient[j - 1] / static_cast<double>(j);
  }
  return product_integral(p, antiderivative, theta);
}

std::optional<double> first_crossing(const TaylorPolynomial& p, double sign) {
  const auto& c = p.coefficient;
  double rest = 0.0;
  for (std::size_t j = 1; j < kTerms; ++j) rest += std::abs(c[j]);
  if (sign * c[0] > rest) return std::nullopt;

  TaylorPolynomial q = p;
  if (sign * c[0] <= 0.0) {
    std::size_t zeros = 1;
    while (zeros < kTerms && c[zeros] == 0.0) ++zeros;
    if (zeros == kTerms) return std::nullopt;
    if (sign * c[zeros] < 0.0) return 0.0;
    q = TaylorPolynomial{};
    std::copy(c.begin() + static_cast<std::ptrdiff_t>(zeros), c.end(), q.coefficient.begin());
  }
  Coefficients b = to_bernstein(q.coefficient);
  if (sign < 0.0) std::transform(b.begin(), b.end(), b.begin(), [](double v) { return -v; });
  return search(q, sign, b, 0.0, 1.0, 0);
}

}  // namespace hapticwall
