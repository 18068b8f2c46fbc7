#include "core/study/identify/intervals.h"

#include <cmath>
#include <random>

#include "core/encoder.h"

namespace hapticwall::identify {
namespace {

constexpr int kDraws = 60;

ParameterMatrix inverse(const ParameterMatrix& hessian) {
  return hessian.completeOrthogonalDecomposition().pseudoInverse();
}

// The error of a model's positions after a shifted encoder has counted them.
Eigen::VectorXd counting_error(const Eigen::VectorXd& model_m, double encoder_m, double shift_m) {
  return model_m.unaryExpr(
      [&](double x) { return quantise(x + shift_m, encoder_m) - shift_m - x; });
}

ParameterMatrix requantised(const Record& record, const Fit& fit,
                            const std::vector<SegmentNormal>& normals,
                            const ParameterMatrix& inverse_hessian) {
  std::minstd_rand random(1);
  ParameterMatrix sum = ParameterMatrix::Zero();
  for (int draw = 0; draw < kDraws; ++draw) {
    ParameterVector gradient = ParameterVector::Zero();
    for (std::size_t s = 0; s < normals.size(); ++s) {
      const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(
          &record.position_m[fit.segments[s].first], normals[s].residual_m.size());
      const double share =
          static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max());
      gradient +=
          normals[s].slope.transpose() *
          counting_error(y - normals[s].residual_m, record.encoder_m, share * record.encoder_m);
    }
    const ParameterVector error = inverse_hessian * gradient;
    sum += error * error.transpose();
  }
  return sum / kDraws;
}

}  // namespace

// Cornish and Fisher's expansion.
double student_quantile(double degrees) {
  const double z = 1.959964;
  const double z3 = z * z * z;
  const double z5 = z3 * z * z;
  return z + (z3 + z) / (4.0 * degrees) +
         (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * degrees * degrees) +
         (3.0 * z5 * z * z + 19.0 * z5 + 17.0 * z3 - 15.0 * z) /
             (384.0 * degrees * degrees * degrees);
}

Intervals::Intervals(const Record& record, const Fit& fit) {
  const std::vector<SegmentNormal> normals = linearise(record, fit);
  ParameterMatrix hessian = ParameterMatrix::Zero();
  ParameterMatrix spread = ParameterMatrix::Zero();
  for (const SegmentNormal& normal : normals) {
    hessian += normal.hessian;
    spread += normal.gradient * normal.gradient.transpose();
  }
  const auto count = static_cast<double>(normals.size());
  const double degrees = std::max(1.0, count - kParameters);
  const ParameterMatrix inverse_hessian = inverse(hessian);
  sandwich_ = inverse_hessian * spread * inverse_hessian * (count / degrees);
  requantised_ = requantised(record, fit, normals, inverse_hessian);
  quantile_ = student_quantile(degrees);
}

double Intervals::half_width(const ParameterVector& weights) const {
  const double variance =
      std::max(weights.dot(sandwich_ * weights), weights.dot(requantised_ * weights));
  return quantile_ * std::sqrt(std::max(variance, 0.0));
}

}  // namespace hapticwall::identify
