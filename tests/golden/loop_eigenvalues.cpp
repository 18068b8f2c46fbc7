#include "tests/golden/loop_eigenvalues.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <unsupported/Eigen/MatrixFunctions>

namespace hapticwall::testing {
namespace {

using Real = long double;
using Column = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

// x, v and y, w of handle and hand in SI, the amplifier's force, and a command that is held.
enum State { kX, kV, kY, kW, kForce, kCommand, kStates };

// The matrix that takes the states over `duration_s`. The hand's mass, if any, is held by a grip.
Matrix motion(const Scene& scene, Real duration_s) {
  const DeviceSettings& device = scene.x().device;
  const HandSettings hand = scene.x().hand.value_or(HandSettings{});
  Matrix rates = Matrix::Zero(kStates, kStates);
  const Real rigid_kg = hand.has_grip() ? 0.0 : hand.mass_kg.value_or(0.0);
  const Real mass_kg = Real(device.mass_kg) + rigid_kg;
  rates(kX, kV) = 1;
  rates(kV, kV) = -Real(device.damping_n_s_per_m) / mass_kg;
  if (hand.has_grip()) {
    const Real hand_kg = *hand.mass_kg;
    const Real stiffness = *hand.grip_stiffness_n_per_m;
    const Real damping = hand.grip_damping_n_s_per_m.value_or(0.0);
    rates(kV, kX) -= stiffness / mass_kg;
    rates(kV, kV) -= damping / mass_kg;
    rates(kV, kY) = stiffness / mass_kg;
    rates(kV, kW) = damping / mass_kg;
    rates(kY, kW) = 1;
    rates(kW, kX) = stiffness / hand_kg;
    rates(kW, kV) = damping / hand_kg;
    rates(kW, kY) = -(stiffness + Real(hand.stiffness_n_per_m)) / hand_kg;
    rates(kW, kW) = -(damping + Real(hand.damping_n_s_per_m)) / hand_kg;
  } else {
    rates(kV, kX) -= Real(hand.stiffness_n_per_m) / mass_kg;
    rates(kV, kV) -= Real(hand.damping_n_s_per_m) / mass_kg;
  }
  const std::optional<double> lag_s = device.amplifier_time_constant_s;
  rates(kV, lag_s ? kForce : kCommand) = -1 / mass_kg;
  if (lag_s) {
    rates(kForce, kCommand) = 1 / Real(*lag_s);
    rates(kForce, kForce) = -1 / Real(*lag_s);
  }
  return Matrix(rates * duration_s).exp();
}

// A tick of the closed loop: states, the previous position, and the commands on their way, newest
// first.
Matrix closed_loop(const Scene& scene, double delay_s, Real stiffness) {
  const Real period_s = 1 / Real(scene.sampling.rate_hz);
  const Real mass_kg = scene.x().device.mass_kg;
  const Real ticks = Real(delay_s) / period_s;
  const int whole = static_cast<int>(std::floor(ticks + Real(1e-6)));
  const Real late = std::max(Real(0), ticks - whole);
  const bool split = late > Real(1e-6);
  const int waiting = whole + (split ? 1 : 0);
  const int plant = kCommand;  // states without the command
  const int size = plant + 1 + waiting;
  // The command now as a row of the loop's states.
  const Real damping = Real(scene.x().walls[0].damping_n_s_per_m) / period_s;
  Matrix command = Matrix::Zero(1, size);
  command(0, kX) = stiffness + damping;
  command(0, plant) = -damping;
  const auto sent = [&](int ticks_ago) {
    Matrix row = Matrix::Zero(1, size);
    if (ticks_ago > 0) row(0, plant + ticks_ago) = 1;
    return ticks_ago > 0 ? row : command;
  };
  Matrix states = Matrix::Identity(plant, size);
  const auto hold = [&](Real duration_s, const Matrix& held) {
    const Matrix step = motion(scene, duration_s);
    states = (step.topLeftCorner(plant, plant) * states + step.block(0, kCommand, plant, 1) * held)
                 .eval();
  };
  if (split) hold(late * period_s, sent(whole + 1));
  hold((1 - late) * period_s, sent(whole));
  Matrix loop = Matrix::Zero(size, size);
  loop.topRows(plant) = states;
  loop(plant, kX) = 1;
  if (waiting > 0) loop.row(plant + 1) = command;
  for (int i = 1; i < waiting; ++i) loop(plant + 1 + i, plant + i) = 1;
  // States that a scene does not have would stay as they are.
  const bool grip = scene.x().hand && scene.x().hand->has_grip();
  if (!grip) loop(kY, kY) = loop(kW, kW) = 0;
  if (!scene.x().device.amplifier_time_constant_s) loop(kForce, kForce) = 0;
  // The states are in ticks and m/T², because eigenvalues lose digits if the numbers differ much in
  // size.
  Column unit = Column::Constant(size, period_s * period_s / mass_kg);
  unit(kX) = unit(kY) = unit(plant) = 1;
  unit(kV) = unit(kW) = period_s;
  return unit.asDiagonal() * loop * unit.cwiseInverse().asDiagonal();
}

}  // namespace

LoopEigenvalues::LoopEigenvalues(const Scene& scene, double delay_s)
    : unit_n_per_m_(scene.x().device.mass_kg * scene.sampling.rate_hz * scene.sampling.rate_hz),
      without_wall_(closed_loop(scene, delay_s, 0)),
      by_wall_(closed_loop(scene, delay_s, unit_n_per_m_) - without_wall_) {}

Real LoopEigenvalues::growth(Real stiffness_n_per_m) const {
  const Matrix loop = without_wall_ + stiffness_n_per_m / unit_n_per_m_ * by_wall_;
  const Eigen::EigenSolver<Matrix> solver(loop, false);
  if (solver.info() != Eigen::Success) throw std::runtime_error("the eigenvalues do not converge");
  return solver.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace hapticwall::testing
