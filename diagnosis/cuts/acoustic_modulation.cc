#include "diagnosis/cuts/acoustic_modulation.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/cuts/recorded_transfer.h"
#include "diagnosis/records/band_signal.h"

namespace howl {
namespace {

constexpr double kModulationStep = 1e-3;
constexpr int kPasses = 2;

Eigen::VectorXcd MovedFrequency(const CutRecord& record, const Effect& effect, EffectValues x,
                                const AcousticLocals& mean, const Eigen::ArrayXd& by) {
  const Eigen::VectorXcd& q = record.driving_heat_release;
  const auto transfer = [&](double log_omega) {
    AcousticLocals at = mean;
    at[0] += log_omega;
    return RecordedTransfer(record, effect, x, at);
  };
  const Eigen::VectorXcd r = transfer(0.0);
  const Eigen::VectorXcd up = transfer(kModulationStep);
  const Eigen::VectorXcd down = transfer(-kModulationStep);
  const Eigen::VectorXcd slope = (up - down) / (2.0 * kModulationStep);
  const Eigen::VectorXcd bend = (up + down - 2.0 * r) / (kModulationStep * kModulationStep);
  return BandSpectrum(record,
                      by * InTime(record, slope.cwiseProduct(q)).array() +
                          0.5 * by.square() * InTime(record, bend.cwiseProduct(q)).array(),
                      record.acoustic_count);
}

// One mode: c s / (s^2 + 2 xi omega s + omega^2), omega in rad/s.
Eigen::VectorXcd MovedDamping(const CutRecord& record, double omega, double xi, double c,
                              const Eigen::ArrayXd& xi_add) {
  const Eigen::Index n = record.extended();
  Eigen::VectorXcd s(n);
  Eigen::VectorXcd h(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    s[k] = LaplaceVariable(record.frequency_hz[k]);
    h[k] = 1.0 / (s[k] * s[k] + 2.0 * xi * omega * s[k] + omega * omega);
  }
  const Eigen::VectorXcd still = c * s.cwiseProduct(h).cwiseProduct(record.driving_heat_release);
  Eigen::VectorXcd moved = Eigen::VectorXcd::Zero(n);
  for (int pass = 0; pass < kPasses; ++pass) {
    const Eigen::VectorXd rate = InTime(record, s.cwiseProduct(still + moved));
    moved = h.cwiseProduct(
        BandSpectrum(record, -2.0 * omega * xi_add * rate.array(), record.acoustic_count));
  }
  return moved;
}

struct AcousticModulation {
  // The changes at each sample, less their means; empty where nothing moves.
  Eigen::ArrayXd log_omega;
  Eigen::ArrayXd xi_add;
};

AcousticModulation Modulation(const CutRecord& record, const Effect& effect, EffectValues x) {
  AcousticModulation out;
  const Eigen::Index n = record.samples;
  const auto at = [&](Eigen::Index i, double amplitude, double* factor, double* add) {
    *factor = 1.0;
    *add = 0.0;
    effect.ModulateAcoustics(static_cast<double>(i) / static_cast<double>(n) - 0.5, amplitude, x,
                             factor, add);
  };
  Eigen::ArrayXd amplitude = Eigen::ArrayXd::Constant(n, record.at.relative_amplitude);
  if (const auto sense = effect.AcousticSense(x)) {
    amplitude = SquaredAmplitude(record, *sense).sqrt();
  }
  Eigen::ArrayXd log_omega(n);
  Eigen::ArrayXd xi_add(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    double factor = 1.0;
    at(i, amplitude[i], &factor, &xi_add[i]);
    log_omega[i] = factor == 1.0 ? 0.0 : std::log(factor);
  }
  if (log_omega.abs().maxCoeff() > 0.0) {
    out.log_omega = log_omega - log_omega.mean();
  }
  if (xi_add.abs().maxCoeff() > 0.0) {
    out.xi_add = xi_add - xi_add.mean();
  }
  return out;
}

Eigen::VectorXcd MovedPressure(const CutRecord& record, const Effect& effect, EffectValues x,
                               const AcousticLocals& mean, const AcousticModulation& modulation) {
  Eigen::VectorXcd moved = Eigen::VectorXcd::Zero(record.extended());
  if (modulation.log_omega.size() > 0) {
    moved += MovedFrequency(record, effect, x, mean, modulation.log_omega);
  }
  if (modulation.xi_add.size() > 0) {
    const Acoustics<double> at = ToAcoustics(record.model, mean);
    const double omega = kRadPerSPerHz * at.omega_hz;
    Eigen::VectorXcd both = MovedDamping(record, omega, at.xi, at.N, modulation.xi_add);
    if (at.M != 0.0) {
      both += MovedDamping(record, at.harmonic_ratio * omega, at.xi, at.M, modulation.xi_add);
    }
    for (Eigen::Index k = 0; k < both.size(); ++k) {
      const double f = record.frequency_hz[k];
      both[k] *= effect.PressureInstrument(f, x) / effect.HeatReleaseInstrument(f, x);
    }
    if (record.reference.acoustic.size() > 0) both = both.cwiseProduct(record.reference.acoustic);
    moved += both;
  }
  return moved;
}

}  // namespace

Eigen::VectorXcd PressureOfMovement(const CutRecord& record, const Effect& effect, EffectValues x,
                                    const AcousticLocals& mean) {
  if (!effect.ModulatesAcoustics()) return {};
  const AcousticModulation modulation = Modulation(record, effect, x);
  if (modulation.log_omega.size() + modulation.xi_add.size() == 0) return {};
  return MovedPressure(record, effect, x, mean, modulation);
}

}  // namespace howl
