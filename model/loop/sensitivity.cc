#include "model/loop/sensitivity.h"

#include <complex>

#include "model/loop/laplace.h"

namespace howl {
namespace {

struct ModeDerivatives {
  std::complex<double> value;  // of s^2 / D
  std::complex<double> omega;
  std::complex<double> xi;
};

ModeDerivatives UnitMode(double omega, double xi, std::complex<double> s) {
  const std::complex<double> d = s * s + 2.0 * omega * xi * s + omega * omega;
  const std::complex<double> value = s * s / d;
  return {value, -value * (2.0 * xi * s + 2.0 * omega) / d, -value * 2.0 * omega * s / d};
}

Sensitivity FromLogarithm(std::complex<double> d_log) {
  return {kDegPerRad * d_log.imag(), d_log.real()};
}

}  // namespace

LoopSensitivity LoopSensitivityAt(const LoopParameters<double>& loop, double frequency_hz) {
  const Acoustics<double>& a = loop.acoustics;
  const std::complex<double> s(0.0, kRadPerSPerHz * frequency_hz);
  const double w1 = kRadPerSPerHz * a.omega_hz;
  const ModeDerivatives first = UnitMode(w1, a.xi, s);
  const ModeDerivatives second = UnitMode(a.harmonic_ratio * w1, a.xi, s);
  const std::complex<double> rate = a.N * first.value + a.M * second.value;
  const ModeTransfer transfer = LoopTransfer(loop, s);

  LoopSensitivity result;
  const auto set = [&](LoopParameter p, std::complex<double> d_log) {
    result.parameter[static_cast<std::size_t>(p)] = FromLogarithm(d_log);
  };
  set(LoopParameter::kOmega,
      kRadPerSPerHz * (a.N * first.omega + a.M * a.harmonic_ratio * second.omega) / rate);
  set(LoopParameter::kXi, (a.N * first.xi + a.M * second.xi) / rate);
  set(LoopParameter::kN, first.value / rate);
  set(LoopParameter::kM, second.value / rate);
  set(LoopParameter::kHarmonicRatio, a.M * w1 * second.omega / rate);
  set(LoopParameter::kTau, -s);
  result.frequency = FromLogarithm(std::complex<double>(0.0, kRadPerSPerHz) * transfer.derivative /
                                   transfer.value);
  return result;
}

}  // namespace howl
