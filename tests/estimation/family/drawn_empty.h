// Drawn problems whose families are mostly empty: rigs with random parameters, seen exactly, and a
// test with one or two limits tighter than the rig passes. Rigs are built from the paper's
// equations by std::complex alone (reference.h).
#ifndef HOWL_TESTS_ESTIMATION_FAMILY_DRAWN_EMPTY_H_
#define HOWL_TESTS_ESTIMATION_FAMILY_DRAWN_EMPTY_H_

#include <algorithm>
#include <random>
#include <string>

#include "estimation/family/problem/problem.h"
#include "tests/estimation/family/reference.h"

namespace howl::reference {

struct DrawnKind {
  int modes = 1;
  bool transfers = false;
  bool shared_tau = false;
  bool bounds = false;  // of omega and N, around the rig's
};

inline FamilyProblem DrawnProblem(const DrawnKind& kind, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  };
  FamilyProblem problem;
  problem.model.modes = kind.modes;
  if (kind.shared_tau) problem.model[ParameterKind::kTau].scope = ParameterScope::kShared;
  const int count = 2 + static_cast<int>(seed % 3);
  const double middle_hz = uniform(120.0, 400.0);
  const double size = std::pow(10.0, uniform(-1.0, 2.0));
  const double tau_s = 0.7 / middle_hz;
  const double M = kind.modes == 2 ? uniform(0.05, 0.3) * size : 0.0;
  double omega_lo = 1e30, omega_hi = 0.0, xi_hi = 0.0;
  for (int i = 0; i < count; ++i) {
    Model m{.omega_hz = middle_hz * uniform(0.93, 1.07),
            .xi = uniform(0.04, 0.25),
            .N = size * uniform(0.7, 1.4),
            .M = M,
            .tau_s = 0.0,
            .r = 3.0};
    Experiment e;
    e.name = "exp" + std::to_string(i + 1);
    e.phi = 0.45 + 0.02 * i;
    e.frequency_hz = static_cast<double>(m.omega_hz) * uniform(1.0, 1.1);
    if (kind.shared_tau) {  // the loop closes at this delay: arg G - w tau = 270 degrees
      const auto phase = [&](Real f) { return Deg(G(m, f)) + 360.0L * (0.75L - f * tau_s); };
      Real lo = 0.5L * m.omega_hz, hi = 1.8L * m.omega_hz;
      for (int k = 0; k < 200; ++k) (phase(0.5L * (lo + hi)) > 0 ? lo : hi) = 0.5L * (lo + hi);
      e.frequency_hz = static_cast<double>(lo);
    }
    const Complex z = G(m, e.frequency_hz);
    e.phase_deg = static_cast<double>(Deg(z));
    e.gain = static_cast<double>(std::abs(z));
    e.flame_slope = -uniform(1.02, 1.4) / (2 * 3.14159265358979 * e.frequency_hz * e.gain);
    e.reliable = uniform(0.0, 1.0) < 0.8;
    if (kind.transfers) {
      const TransferVector std = TransferVector(0.01, 0.1, 0.1, 0.3);
      const TransferVector centre(static_cast<double>(m.omega_hz) * std::exp(0.01 * uniform(-1, 1)),
                                  static_cast<double>(m.xi) * std::exp(0.1 * uniform(-1, 1)),
                                  static_cast<double>(m.N) * std::exp(0.1 * uniform(-1, 1)),
                                  std::max(M, 0.1 * size));
      e.transfer_ellipsoid = TransferEllipsoid::Make(
          centre, std.cwiseAbs2().asDiagonal().toDenseMatrix(), {true, true, true, true});
    }
    omega_lo = std::min(omega_lo, static_cast<double>(m.omega_hz));
    omega_hi = std::max(omega_hi, static_cast<double>(m.omega_hz));
    xi_hi = std::max(xi_hi, static_cast<double>(m.xi));
    problem.experiments.push_back(e);
  }
  MembershipTest& test = problem.test;
  test.xi_increasing = uniform(0.0, 1.0) < 0.5;
  test.omega_spread_max = (omega_hi / omega_lo - 1.0) * uniform(0.1, 1.2);
  test.xi_max = xi_hi * uniform(0.3, 1.2);
  test.loop_gain_min = uniform(0.0, 1.0) < 0.3 ? uniform(1.0, 1.5) : 0.9;
  if (kind.transfers) test.transfer_distance_max = uniform(0.3, 4.0);
  if (kind.bounds) {
    problem.domain[ParameterKind::kOmega] = {middle_hz * uniform(0.8, 1.02), middle_hz * 1.2};
    problem.domain[ParameterKind::kN] = {0.5 * size, 2.0 * size};
    problem.domain[ParameterKind::kXi].lo = 0.02;
  }
  if (kind.modes == 2) problem.domain[ParameterKind::kM].hi = 2.0 * M;
  return problem;
}

}  // namespace howl::reference

#endif  // HOWL_TESTS_ESTIMATION_FAMILY_DRAWN_EMPTY_H_
