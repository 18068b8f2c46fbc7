// Covariance matrix adaptation evolution strategy (CMA-ES) in the unit cube.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/study/worst_hand/hand_space.h"
#include "core/study/worst_hand/random.h"

namespace hapticwall::worst_hand {

// Maximises a score of the first kNumbers numbers of a hand, with a population of fixed size.
//
// Source: Hansen, "The CMA evolution strategy: a tutorial", arXiv:1604.00772, with its default
// constants. A smooth periodic transform maps all numbers into the cube, so that a maximum at a
// bound is one inside. Realtime-safe: no.
template <std::size_t kNumbers>
class CmaEs {
 public:
  CmaEs(const HandPoint& start, std::size_t population);

  // The next population.
  [[nodiscard]] std::vector<HandPoint> ask(Random& random);
  // Scores of the population in its order. Equal scores rank by their index.
  void tell(std::span<const double> scores);
  // True if the population has shrunk to a point, or has found nothing better for long.
  [[nodiscard]] bool is_over() const;

 private:
  static constexpr int kSize = static_cast<int>(kNumbers);
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  void move_mean(const std::vector<std::size_t>& order);
  void decompose();

  std::size_t population_;
  std::vector<double> weights_;  // of the better half, from the best one on
  double effective_ = 0.0;       // effective number of parents
  double sigma_;
  Vector mean_;
  Matrix covariance_ = Matrix::Identity();
  Matrix axes_ = Matrix::Identity();  // eigenvectors
  Vector lengths_ = Vector::Ones();   // along them
  Vector sigma_path_ = Vector::Zero();
  Vector covariance_path_ = Vector::Zero();
  double unfinished_ = 1.0;    // share of the start in sigma_path_
  std::vector<Vector> steps_;  // of the population, in units of sigma_
  double best_ = -1e300;
  std::uint32_t generations_without_better_ = 0;
};

extern template class CmaEs<number_count(Motion::kLetGo)>;
extern template class CmaEs<number_count(Motion::kRamp)>;

}  // namespace hapticwall::worst_hand
