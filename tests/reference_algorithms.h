// Every algorithm once more, written straight from its published or derived formula in plain
// doubles, one function each: nothing of the program is used or imitated. A function takes the
// measured position of a tick, and does all of it: velocity, walls, algorithm, limit. Tests only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace hapticwall::testing {

struct ReferenceWall {
  double at, stiffness, damping;
};

// A scene's values. `walls` are sorted by position.
struct ReferenceScene {
  double rate = 1000.0;  // 1/T
  double b = 1.0;
  double limit = 1e300;
  std::vector<ReferenceWall> walls{};
  double alpha_rest = 0.0;                     // energy-bounding
  double c2 = 0.0;                             // energy-bounding-2010
  double coupling = 0.0, coupling_damp = 0.0;  // virtual-coupling
  bool held = false, credited = false, forgets = false;
  double alpha_most = 0.0, floor = 0.0;  // passivity-control
  bool ahead = false;                    // beside `held`: the observer one-step
};

struct ReferenceState {
  bool moved_before = false;
  double x = 0.0;      // position in the last tick
  double force = 0.0;  // F_d(k-1)
  double energy = 0.0, eaten = 0.0;
  std::vector<double> proxies = std::vector<double>(8, 0.0);
};

inline double reference_limited(const ReferenceScene& s, double force) {
  return std::min(s.limit, std::max(-s.limit, force));
}

// F_e at `x`: a wall pushes, it never pulls.
inline double reference_wall_force(const ReferenceScene& s, double x, double v) {
  double sum = 0.0;
  for (const ReferenceWall& wall : s.walls) {
    const double p = x - wall.at;
    if (p > 0.0) sum += std::max(0.0, wall.stiffness * p + wall.damping * v);
  }
  return sum;
}

inline double reference_step(ReferenceState& m, double x) {
  const double dx = m.moved_before ? x - m.x : 0.0;
  m.x = x;
  m.moved_before = true;
  return dx;
}

inline double reference_none(const ReferenceScene& s, ReferenceState& m, double x) {
  const double dx = reference_step(m, x);
  m.force = reference_limited(s, reference_wall_force(s, x, dx * s.rate));
  return m.force;
}

// Between the coupling and the wall's spring and damper the massless proxy q is in balance:
// K q + B q' = K_c (p - q) + B_c (v - q'), with q' over the tick that ends now.
inline double reference_virtual_coupling(const ReferenceScene& s, ReferenceState& m, double x) {
  const double dx = reference_step(m, x);
  const double period = 1.0 / s.rate;
  double contacts = 0.0;
  for (const ReferenceWall& wall : s.walls) contacts += x > wall.at ? 1.0 : 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < s.walls.size(); ++i) {
    const ReferenceWall& wall = s.walls[i];
    const double p = x - wall.at;
    const double kc = s.coupling / contacts;
    const double bc = s.coupling_damp / contacts;
    const double before = p > 0.0 ? m.proxies[i] : 0.0;
    const double weight = wall.stiffness + kc + (wall.damping + bc) / period;
    double q = 0.0;
    if (p > 0.0 && weight > 0.0) {
      q = (kc * p + bc * dx / period + (wall.damping + bc) * before / period) / weight;
      q = std::max(q, 0.0);
      sum += std::max(0.0, wall.stiffness * q + wall.damping * (q - before) / period);
    }
    m.proxies[i] = q;
  }
  m.force = reference_limited(s, sum);
  return m.force;
}

// `wanted` takes the place of F_e; `m` holds energy and credit.
inline double reference_passivity(const ReferenceScene& s, ReferenceState& m, double wanted,
                                  double dx, bool contact) {
  const double v = dx * s.rate;
  if (s.held) m.energy += m.force * dx;
  if (s.credited) m.eaten += s.b * std::abs(v * dx);
  if (s.forgets && !contact) m.energy = m.eaten = 0.0;
  const double w = s.held && !s.ahead ? m.energy : m.energy + wanted * dx;
  double force = wanted;
  if (w < -m.eaten && std::abs(v) > s.floor) {
    const double missing = -m.eaten - w;
    // α = missing/(T v²) and T v² = v Δx; where α_max is less, α_max.
    force = missing >= s.alpha_most * std::abs(v * dx) ? wanted + s.alpha_most * v
                                                       : wanted + missing / dx;
  }
  force = reference_limited(s, force);
  if (!s.held && !(s.forgets && !contact)) m.energy += force * dx;
  return force;
}

inline double reference_passivity_control(const ReferenceScene& s, ReferenceState& m, double x) {
  const double dx = reference_step(m, x);
  const double wall = reference_wall_force(s, x, dx * s.rate);
  const bool contact = !s.walls.empty() && x > s.walls.front().at;
  m.force = reference_passivity(s, m, wall, dx, contact);
  return m.force;
}

inline double reference_energy_bounding(const ReferenceScene& s, ReferenceState& m, double x) {
  const double dx = reference_step(m, x);
  const double v = dx * s.rate;
  const bool moves = std::abs(dx) > 1e-15;  // metres
  const double bound = moves ? s.b * std::abs(v) : s.alpha_rest;
  const double wall = reference_wall_force(s, x, v);
  double force = wall;
  if (wall - m.force > bound) force = m.force + bound;
  if (wall - m.force < -bound) force = m.force - bound;
  m.force = reference_limited(s, force);
  return m.force;
}

// The roots stand as in the paper, the larger one first.
inline double reference_energy_bounding_2010(const ReferenceScene& s, ReferenceState& m, double x) {
  const double dx = reference_step(m, x);
  if (dx == 0.0) return m.force;
  const double wall = reference_wall_force(s, x, dx * s.rate);
  const double c1 = s.b * s.rate;
  const double r = m.force / dx;
  const double root = std::hypot(s.c2, r);
  double high = 0.0;
  double low = 0.0;
  if (s.c2 - r >= 0.0) {
    high = s.c2 - r + root;
    if (high > 0.0) low = -2.0 * s.c2 * r / high;
  } else {
    low = s.c2 - r - root;
    high = -2.0 * s.c2 * r / low;
  }
  double beta = (wall - m.force) / dx;
  beta = std::max(beta, std::max(-c1, low));
  beta = std::min(beta, std::min(c1, high));
  m.force = reference_limited(s, m.force + beta * dx);
  return m.force;
}

inline double reference_force_bounding(const ReferenceScene& s, ReferenceState& m, double x) {
  const double dx = reference_step(m, x);
  const double wall = reference_wall_force(s, x, dx * s.rate);
  const double c = s.b / (1.0 / s.rate);
  if (m.force == 0.0) m.energy = 0.0;
  m.energy = m.energy + c * (dx * dx) + m.force * dx;
  const double allowed = m.energy > 0.0 ? std::sqrt(4.0 * c * m.energy) : 0.0;
  m.force = reference_limited(s, std::min(wall, allowed));
  return m.force;
}

inline double reference_half_sample(const ReferenceScene& s, ReferenceState& m, double x) {
  const double dx = reference_step(m, x);
  m.force = reference_limited(s, reference_wall_force(s, x + dx / 2.0, dx * s.rate));
  return m.force;
}

// With several walls, a search finds the force that goes with an energy: all springs together hold
// it at some depth.
inline double reference_energy_limited_spring(const ReferenceScene& s, ReferenceState& m,
                                              double x) {
  const double dx = reference_step(m, x);
  const double wall = reference_wall_force(s, x, dx * s.rate);
  const double p = s.walls.empty() ? 0.0 : x - s.walls.front().at;
  m.energy = p > 0.0 ? m.energy + m.force * dx : 0.0;
  const double held = std::max(m.energy, 0.0);
  double spring = 0.0;
  if (s.walls.size() == 1) {
    spring = std::sqrt(2.0 * s.walls.front().stiffness * held);
  } else if (s.walls.size() > 1) {
    const double first = s.walls.front().at;
    const auto into = [&](const ReferenceWall& w, double depth) {
      return std::max(0.0, depth - (w.at - first));
    };
    const auto stored = [&](double depth) {
      double sum = 0.0;
      for (const ReferenceWall& w : s.walls) sum += w.stiffness * std::pow(into(w, depth), 2) / 2.0;
      return sum;
    };
    double near = 0.0;
    double far = 1.0;
    while (stored(far) < held && far < 1e9) far *= 2.0;
    for (int i = 0; i < 120; ++i) {
      const double middle = near + (far - near) / 2.0;
      (stored(middle) < held ? near : far) = middle;
    }
    for (const ReferenceWall& w : s.walls) spring += w.stiffness * into(w, near);
  }
  const double passive = 2.0 * s.b / (1.0 / s.rate) * p;
  m.force = reference_limited(s, std::min(wall, std::max(passive, spring)));
  return m.force;
}

inline double reference_force(const std::string& algorithm, const ReferenceScene& s,
                              ReferenceState& m, double x) {
  if (algorithm == "none") return reference_none(s, m, x);
  if (algorithm == "virtual-coupling") return reference_virtual_coupling(s, m, x);
  if (algorithm == "passivity-control") return reference_passivity_control(s, m, x);
  if (algorithm == "energy-bounding") return reference_energy_bounding(s, m, x);
  if (algorithm == "energy-bounding-2010") return reference_energy_bounding_2010(s, m, x);
  if (algorithm == "force-bounding") return reference_force_bounding(s, m, x);
  if (algorithm == "half-sample") return reference_half_sample(s, m, x);
  if (algorithm == "energy-limited-spring") return reference_energy_limited_spring(s, m, x);
  return std::nan("");
}

}  // namespace hapticwall::testing
