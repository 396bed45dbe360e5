// The falsification test written a second time, from the paper's equations alone: std::complex and
// long double, no code shared with model/ or estimation/family/. Truth for the tests beside it.
#ifndef HOWL_TESTS_ESTIMATION_FAMILY_REFERENCE_H_
#define HOWL_TESTS_ESTIMATION_FAMILY_REFERENCE_H_

#include <cmath>
#include <complex>
#include <vector>

#include "estimation/analysis/loop/experiment.h"
#include "estimation/family/problem/membership.h"

namespace howl::reference {

using Real = long double;
using Complex = std::complex<long double>;

inline const Real kPi = std::acos(Real(-1));

struct Model {
  Real omega_hz, xi, N, M, tau_s, r;
};

inline Model From(const LoopModel& model) {
  return {model.omega_hz, model.xi, model.N, model.M, model.tau_s, model.harmonic_ratio};
}

// (5a), and with M = 0 (5c).
inline Complex G(const Model& m, Real f) {
  const Complex s(0, 2 * kPi * f);
  const Real o = 2 * kPi * m.omega_hz;
  return m.N * s / (s * s + 2 * o * m.xi * s + o * o) +
         m.M * s / (s * s + 2 * m.r * o * m.xi * s + m.r * m.r * o * o);
}

inline Complex L(const Model& m, Real f) {
  const Complex s(0, 2 * kPi * f);
  return s * G(m, f) * std::exp(-m.tau_s * s);
}

inline Real Deg(const Complex& z) { return std::arg(z) * 180 / kPi; }

// Every tolerance times (1 + slack): a slack of either sign decides near ties.
inline bool Passes(const std::vector<Experiment>& experiments, const std::vector<Model>& models,
                   const MembershipTest& test, Real slack = 0) {
  Real omega_lo = 1e30L, omega_hi = 0;
  const Real more = 1 + slack;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const Experiment& e = experiments[i];
    const Model& m = models[i];
    if (!(m.omega_hz > 0 && m.xi > 0 && m.N >= 0 && m.M >= 0)) return false;
    const Complex z = G(m, e.frequency_hz);
    const Complex measured = std::polar(Real(e.gain), Real(e.phase_deg) * kPi / 180);
    if (!(std::abs(std::abs(z) / Real(e.gain) - 1) <= test.gain_tolerance * more)) return false;
    if (!(std::abs(Deg(z / measured)) <= test.phase_tolerance_deg * more)) return false;
    if (!(std::abs(Deg(-L(m, e.frequency_hz))) <= test.loop_phase_tolerance_deg * more)) {
      return false;
    }
    if (e.reliable && e.flame_slope &&
        !(std::abs(L(m, e.frequency_hz) * Real(*e.flame_slope)) * more >= test.loop_gain_min)) {
      return false;
    }
    if (m.M > 0) {
      for (const ObservedLine& line : e.lines) {
        if (!(std::abs(Deg(-L(m, line.frequency_hz))) <=
              test.second_crossing_tolerance_deg * more)) {
          return false;
        }
        if (e.reliable && e.flame_slope &&
            !(std::abs(L(m, line.frequency_hz) * Real(*e.flame_slope)) * more >=
              test.second_crossing_gain_min)) {
          return false;
        }
      }
      const Model first{m.omega_hz, m.xi, m.N, 0, m.tau_s, m.r};
      const Model second{m.omega_hz, m.xi, 0, m.M, m.tau_s, m.r};
      if (!(std::abs(G(second, e.frequency_hz)) <=
            test.second_mode_share_max * more * std::abs(G(first, e.frequency_hz)))) {
        return false;
      }
    }
    if (!(m.xi <= test.xi_max * more)) return false;
    omega_lo = std::min(omega_lo, m.omega_hz);
    omega_hi = std::max(omega_hi, m.omega_hz);
    for (std::size_t j = 0; test.xi_increasing && j < experiments.size(); ++j) {
      if (experiments[j].phi < e.phi && models[j].xi > m.xi * more) return false;
    }
  }
  return omega_hi / omega_lo <= 1 + test.omega_spread_max * more;
}

inline bool Passes(const std::vector<Experiment>& experiments, const std::vector<LoopModel>& models,
                   const MembershipTest& test, Real slack = 0) {
  std::vector<Model> converted;
  for (const LoopModel& model : models) converted.push_back(From(model));
  return Passes(experiments, converted, test, slack);
}

}  // namespace howl::reference

#endif  // HOWL_TESTS_ESTIMATION_FAMILY_REFERENCE_H_
