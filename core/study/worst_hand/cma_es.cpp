#include "core/study/worst_hand/cma_es.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace hapticwall::worst_hand {
namespace {

constexpr double kFirstSigma = 0.2;
constexpr double kMinSpread = 1e-4;         // largest axis of the population
constexpr double kBetter = 1e-3;            // a smaller relative gain is none
constexpr std::uint32_t kMaxPatience = 25;  // generations

// A line that runs to and fro in the unit interval, rounded at both ends.
double into_cube(double line) {
  const double turned = std::abs(line - 2.0 * std::floor(0.5 * line + 0.5));  // 0 to 1
  return turned < 0.5 ? 2.0 * turned * turned : 1.0 - 2.0 * (1.0 - turned) * (1.0 - turned);
}
double out_of_cube(double place) {
  return place < 0.5 ? std::sqrt(0.5 * place) : 1.0 - std::sqrt(0.5 * (1.0 - place));
}

// log(a/b) and exp(x) by sums and products, so that they round the same everywhere.
double log_ratio(double a, double b) {
  constexpr int kTerms = 400;
  const double t = (a - b) / (a + b);
  double sum = 0.0;
  double power = t;
  for (int i = 0; i < kTerms; ++i, power *= t * t) sum += power / (2.0 * i + 1.0);
  return 2.0 * sum;
}
double exponential(double x) {
  constexpr int kHalvings = 12;
  double power = 1.0 + x * 0x1p-12;
  for (int i = 0; i < kHalvings; ++i) power *= power;
  return power;
}

}  // namespace

template <std::size_t kNumbers>
CmaEs<kNumbers>::CmaEs(const HandPoint& start, std::size_t population)
    : population_(population), sigma_(kFirstSigma) {
  for (int i = 0; i < kSize; ++i) mean_(i) = out_of_cube(start.at(static_cast<std::size_t>(i)));
  const double middle = 0.5 * (static_cast<double>(population) + 1.0);
  for (std::size_t i = 0; i < population / 2; ++i)
    weights_.push_back(log_ratio(middle, static_cast<double>(i + 1)));
  const double sum = std::accumulate(weights_.begin(), weights_.end(), 0.0);
  double squares = 0.0;
  for (double& weight : weights_) {
    weight /= sum;
    squares += weight * weight;
  }
  effective_ = 1.0 / squares;
}

template <std::size_t kNumbers>
std::vector<HandPoint> CmaEs<kNumbers>::ask(Random& random) {
  std::vector<HandPoint> points(population_);
  steps_.clear();
  for (HandPoint& point : points) {
    Vector normal;
    for (double& value : normal) value = random.normal();
    steps_.emplace_back(axes_ * lengths_.cwiseProduct(normal));
    const Vector line = mean_ + sigma_ * steps_.back();
    for (int i = 0; i < kSize; ++i) point.at(static_cast<std::size_t>(i)) = into_cube(line(i));
  }
  return points;
}

template <std::size_t kNumbers>
void CmaEs<kNumbers>::tell(std::span<const double> scores) {
  std::vector<std::size_t> order(population_);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return scores[i]; });
  const double best = scores[order.front()];
  ++generations_without_better_;
  if (best > best_ + kBetter * std::abs(best_)) generations_without_better_ = 0;
  best_ = std::max(best_, best);
  move_mean(order);
  decompose();
}

// Equations and names of the tutorial's appendix A.
template <std::size_t kNumbers>
void CmaEs<kNumbers>::move_mean(const std::vector<std::size_t>& order) {
  constexpr double n = kSize;
  const double mu = effective_;
  const double cc = (4.0 + mu / n) / (n + 4.0 + 2.0 * mu / n);
  const double cs = (mu + 2.0) / (n + mu + 5.0);
  const double c1 = 2.0 / ((n + 1.3) * (n + 1.3) + mu);
  const double cmu = std::min(1.0 - c1, 2.0 * (mu - 2.0 + 1.0 / mu) / ((n + 2.0) * (n + 2.0) + mu));
  const double damps = 1.0 + 2.0 * std::max(0.0, std::sqrt((mu - 1.0) / (n + 1.0)) - 1.0) + cs;
  const double normal_length = std::sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));

  Vector step = Vector::Zero();
  Matrix spread = Matrix::Zero();
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const Vector& one = steps_[order[i]];
    step += weights_[i] * one;
    spread += weights_[i] * one * one.transpose();
  }
  mean_ += sigma_ * step;
  const Vector white = axes_ * (axes_.transpose() * step).cwiseQuotient(lengths_);
  sigma_path_ = (1.0 - cs) * sigma_path_ + std::sqrt(cs * (2.0 - cs) * mu) * white;
  unfinished_ *= (1.0 - cs) * (1.0 - cs);
  const double length = sigma_path_.norm();
  const bool follows = length * length / (n * (1.0 - unfinished_)) < 2.0 + 4.0 / (n + 1.0);
  covariance_path_ *= 1.0 - cc;
  if (follows) covariance_path_ += std::sqrt(cc * (2.0 - cc) * mu) * step;
  const double kept = 1.0 - c1 - cmu + (follows ? 0.0 : c1 * cc * (2.0 - cc));
  covariance_ =
      kept * covariance_ + c1 * covariance_path_ * covariance_path_.transpose() + cmu * spread;
  sigma_ *= exponential(std::min(1.0, cs / damps * (length / normal_length - 1.0)));
}

template <std::size_t kNumbers>
void CmaEs<kNumbers>::decompose() {
  constexpr double kMinVariance = 1e-20;
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(covariance_);
  axes_ = solver.eigenvectors();
  lengths_ = solver.eigenvalues().cwiseMax(kMinVariance).cwiseSqrt();
}

template <std::size_t kNumbers>
bool CmaEs<kNumbers>::is_over() const {
  return sigma_ * lengths_.maxCoeff() < kMinSpread || generations_without_better_ > kMaxPatience;
}

template class CmaEs<number_count(Motion::kLetGo)>;
template class CmaEs<number_count(Motion::kRamp)>;

}  // namespace hapticwall::worst_hand
