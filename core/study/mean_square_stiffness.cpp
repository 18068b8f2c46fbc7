#include "core/study/mean_square_stiffness.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

#include "core/study/pulse_transfer.h"

namespace hapticwall {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kMaxStates = 12;

// A length of the tick and its weight; the weights sum to 1.
struct Length {
  double periods = 1.0;
  double weight = 1.0;
};

// Nodes of Gauss and Legendre for the uniform lengths within 1 ± jitter, by Golub and Welsch.
std::vector<Length> lengths(double jitter) {
  if (jitter == 0.0) return {{}};
  constexpr Index kNodes = 12;
  MatrixXd jacobi = MatrixXd::Zero(kNodes, kNodes);
  for (Index i = 1; i < kNodes; ++i) {
    const auto n = static_cast<double>(i);
    jacobi(i, i - 1) = jacobi(i - 1, i) = n / std::sqrt(4.0 * n * n - 1.0);
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(jacobi);
  std::vector<Length> found;
  for (Index i = 0; i < kNodes; ++i) {
    const double first = solver.eigenvectors()(0, i);
    found.push_back({1.0 + jitter * solver.eigenvalues()(i), first * first});
  }
  return found;
}

// The states of a loop: those of the plant; the commands on their way, the newest last, and at
// least that one; the last measured position; the past of the estimator.
class Loop {
 public:
  Loop(const SampledLoop& sampled, Index delay_ticks, double periods_of_estimator)
      : velocity_(sampled.velocity),
        periods_of_estimator_(periods_of_estimator),
        delay_ticks_(delay_ticks),
        plant_(plant_step(sampled, 1.0).input.size()),
        forces_(std::max<Index>(delay_ticks, 1)),
        displacements_(static_cast<Index>(velocity_.numerator_count) - 1),
        velocities_(static_cast<Index>(velocity_.denominator_count) - 1) {}

  [[nodiscard]] Index size() const { return past() + displacements_ + velocities_; }

  // A tick under this step of the plant. `computes`: a new force, else the last one again.
  [[nodiscard]] MatrixXd tick(const PlantStep& step, bool computes, double stiffness,
                              double damping) const {
    MatrixXd next = MatrixXd::Zero(size(), size());
    VectorXd force = VectorXd::Unit(size(), newest());
    if (computes) {
      force = computed(next, stiffness, damping);
    } else {
      const Index kept = size() - last_position();
      next.bottomRightCorner(kept, kept).setIdentity();
    }
    const VectorXd acting = delay_ticks_ == 0 ? force : VectorXd::Unit(size(), plant_).eval();
    next.topLeftCorner(plant_, plant_) = step.transition;
    next.topRows(plant_) -= step.input * acting.transpose();
    for (Index i = plant_; i < newest(); ++i) next(i, i + 1) = 1.0;
    next.row(newest()) = force.transpose();
    return next;
  }

 private:
  [[nodiscard]] Index newest() const { return plant_ + forces_ - 1; }
  [[nodiscard]] Index last_position() const { return newest() + 1; }
  [[nodiscard]] Index past() const { return last_position() + 1; }

  // The new force as a row over the states; fills the rows of position and estimator.
  [[nodiscard]] VectorXd computed(MatrixXd& next, double stiffness, double damping) const {
    const VectorXd position = VectorXd::Unit(size(), 0);
    const VectorXd displacement = position - VectorXd::Unit(size(), last_position());
    VectorXd velocity = velocity_.numerator[0] * displacement;
    for (Index i = 0; i < displacements_; ++i)
      velocity(past() + i) += velocity_.numerator.at(static_cast<std::size_t>(i) + 1);
    for (Index i = 0; i < velocities_; ++i) {
      velocity(past() + displacements_ + i) -=
          velocity_.denominator.at(static_cast<std::size_t>(i) + 1);
    }
    next.row(last_position()) = position.transpose();
    remember(next, past(), displacements_, displacement);
    remember(next, past() + displacements_, velocities_, velocity);
    return stiffness * position + damping / periods_of_estimator_ * velocity;
  }
  // `count` values from `first` on move by one place, and the new one comes first.
  static void remember(MatrixXd& next, Index first, Index count, const VectorXd& value) {
    if (count == 0) return;
    next.row(first) = value.transpose();
    for (Index i = 1; i < count; ++i) next(first + i, first + i - 1) = 1.0;
  }

  VelocityTransfer velocity_;
  double periods_of_estimator_;
  Index delay_ticks_;
  Index plant_;
  Index forces_;
  Index displacements_;
  Index velocities_;
};

// Adds weight A X Aᵀ as a matrix on the lower triangle of the symmetric X.
void add_second_moment(const MatrixXd& a, double weight, MatrixXd& sum) {
  const Index n = a.rows();
  for (Index j = 0, column = 0; j < n; ++j) {
    for (Index i = j; i < n; ++i, ++column) {
      for (Index l = 0, row = 0; l < n; ++l) {
        for (Index k = l; k < n; ++k, ++row) {
          const double other = i == j ? 0.0 : a(k, j) * a(l, i);
          sum(row, column) += weight * (a(k, i) * a(l, j) + other);
        }
      }
    }
  }
}

class SecondMoments {
 public:
  SecondMoments(const Loop& loop, const SampledLoop& sampled, const SamplingSettings& sampling)
      : loop_(loop),
        lost_(sampling.lost_ticks.value_or(0.0)),
        held_ticks_(sampling.render_every.value_or(1) - 1) {
    for (const Length& length : lengths(sampling.jitter.value_or(0.0)))
      steps_.push_back({plant_step(sampled, length.periods), length.weight});
  }

  // True if they grow from computation to computation. Stiffness and damping in the units of
  // PulseTransfer.
  [[nodiscard]] bool grow(double stiffness, double damping) const {
    constexpr double kOnCircle = 1e-9;
    const Index size = loop_.size() * (loop_.size() + 1) / 2;
    MatrixXd held = MatrixXd::Zero(size, size);
    MatrixXd whole = MatrixXd::Zero(size, size);
    for (const Step& step : steps_) {
      const MatrixXd holding = loop_.tick(step.plant, false, stiffness, damping);
      add_second_moment(holding, step.weight, held);
      add_second_moment(holding, step.weight * lost_, whole);
      add_second_moment(loop_.tick(step.plant, true, stiffness, damping),
                        step.weight * (1.0 - lost_), whole);
    }
    for (int i = 0; i < held_ticks_; ++i) whole = (held * whole).eval();
    return !(whole.eigenvalues().cwiseAbs().maxCoeff() <= 1.0 + kOnCircle);
  }

 private:
  struct Step {
    PlantStep plant;
    double weight = 1.0;
  };

  const Loop& loop_;
  double lost_;
  int held_ticks_;
  std::vector<Step> steps_;
};

// The limit without chance.
double regular_limit(const SampledLoop& loop, int render_every) {
  SampledLoop regular = loop;
  regular.period_s *= render_every;
  return largest_stable_stiffness(regular);
}

}  // namespace

std::optional<double> mean_square_stiffness(const SampledLoop& sampled,
                                            const SamplingSettings& sampling) {
  constexpr double kSameTick = 1e-9;
  const double delay_ticks = sampled.delay_s / sampled.period_s;
  const double whole_ticks = std::round(delay_ticks);
  if (std::abs(delay_ticks - whole_ticks) > kSameTick || whole_ticks > kMaxStates)
    return std::nullopt;
  const int render_every = sampling.render_every.value_or(1);
  const Loop loop(sampled, static_cast<Index>(whole_ticks), render_every);
  if (loop.size() > kMaxStates) return std::nullopt;
  const double regular = regular_limit(sampled, render_every);
  if (regular == 0.0) return 0.0;
  const SecondMoments moments(loop, sampled, sampling);
  const double mass_kg = sampled.plant.mass_kg;
  const double damping = sampled.wall_damping_n_s_per_m * sampled.period_s / mass_kg;
  const double scale = sampled.period_s * sampled.period_s / mass_kg;
  const auto grow = [&](double stiffness) { return moments.grow(stiffness * scale, damping); };
  constexpr double kSoftest = 1e-6;
  constexpr double kStiffest = 4.0;
  constexpr double kRatio = 1.2;
  double low = kSoftest * regular;
  if (grow(low)) return 0.0;
  double high = low * kRatio;
  while (!grow(high)) {
    low = high;
    high *= kRatio;
    if (low > kStiffest * regular) return std::nullopt;
  }
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (grow(middle) ? high : low) = middle;
  }
  return low;
}

}  // namespace hapticwall
