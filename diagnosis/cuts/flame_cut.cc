#include "diagnosis/cuts/flame_cut.h"

#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "diagnosis/numerics/real_fft.h"
#include "diagnosis/numerics/real_gram.h"
#include "diagnosis/numerics/scaled_solve.h"
#include "diagnosis/records/band_signal.h"

namespace howl {
namespace {

constexpr double kRangeMargin = 1.001;
constexpr double kEnds = 0.02;  // of the record
constexpr double kRidge = 1e-10;
constexpr std::size_t kPhasors = 32;

double DelayOf(const CutRecord& record, const Effect& effect, EffectValues x, double tau_s) {
  return tau_s * effect.DelayFactor(record.at, x);
}

// A delay that may move is at its null value a constant delay.
bool DelayMoves(const Effect& effect, EffectValues x) {
  return effect.ModulatesDelay() && effect.DelayPerAmplitude(x) != 0.0;
}

// e^(-tau s) on the first `count` bins of the extended band. Sines are computed for every
// kPhasors-th bin alone, and rotated by the same few angles for the others.
Eigen::VectorXcd DelayOnBand(const CutRecord& record, Eigen::Index count, double tau_s) {
  const double step = -kRadPerSPerHz * record.bin_hz * tau_s;
  std::array<Response, kPhasors> turns;
  for (std::size_t k = 0; k < turns.size(); ++k) {
    turns[k] = std::polar(1.0, step * static_cast<double>(k));
  }
  Eigen::VectorXcd out(count);
  Response from;
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto within = static_cast<std::size_t>(k) % kPhasors;
    if (within == 0) from = std::polar(1.0, -kRadPerSPerHz * record.frequency_hz[k] * tau_s);
    out[k] = from * turns[within];
  }
  return out;
}

// v in time; if `delayed`, by the experiment's delay with its slow part.
Eigen::VectorXd FlameInput(const CutRecord& record, const Effect& effect, EffectValues x,
                           double tau_s) {
  Eigen::VectorXcd spectrum = record.pressure_spectrum.cwiseProduct(record.derivative_filter);
  if (effect.ChangesFlameInput()) {
    for (Eigen::Index k = 1; k < spectrum.size(); ++k) {
      if (spectrum[k] == 0.0) continue;  // beyond the low-pass
      const double f = static_cast<double>(k) * record.bin_hz;
      spectrum[k] *= effect.FlameIn(f, record.at, x) / effect.PressureInstrument(f, x);
    }
  }
  if (!DelayMoves(effect, x)) return InverseFft(spectrum, record.samples);
  const double tau = DelayOf(record, effect, x, tau_s);
  Eigen::VectorXcd first(spectrum.size());
  Eigen::VectorXcd second(spectrum.size());
  for (Eigen::Index k = 0; k < spectrum.size(); ++k) {
    const Response s = LaplaceVariable(static_cast<double>(k) * record.bin_hz);
    spectrum[k] *= std::exp(-s * tau);
    first[k] = s * spectrum[k];
    second[k] = s * first[k];
  }
  const AmplitudeSense sense = effect.DelaySense(x).value_or(AmplitudeSense{});
  // The amplitude is that of the time when the mixture left the nozzle. The amplitude at the time
  // of burning depends on the combustion noise of that time, to which p responds at once, and would
  // explain some of it.
  const Eigen::ArrayXd amplitude = SquaredAmplitude(record, sense, tau).sqrt();
  const double mean =
      sense.of_rate ? record.at.relative_rate_amplitude : record.at.relative_amplitude;
  const Eigen::ArrayXd slow = tau_s * effect.DelayPerAmplitude(x) * (amplitude - mean);
  Eigen::VectorXd v = InverseFft(spectrum, record.samples);
  v.array() -= slow * InverseFft(first, record.samples).array();
  v.array() += 0.5 * slow.square() * InverseFft(second, record.samples).array();
  return v;
}

}  // namespace

FlameColumns MakeFlameColumns(const CutRecord& record, const Effect& effect, EffectValues x,
                              double tau_s) {
  FlameColumns out;
  out.v = FlameInput(record, effect, x, tau_s);
  // At the record's ends the derivative of the periodic continuation jumps; the window is zero
  // there.
  const auto ends = static_cast<Eigen::Index>(kEnds * static_cast<double>(record.samples));
  out.range = kRangeMargin * out.v.segment(ends, record.samples - 2 * ends).cwiseAbs().maxCoeff();
  const Eigen::MatrixXd columns = FlameBasis(out.range).Columns(out.v);
  out.spectrum.resize(record.flame_count + 2 * kTapReach, kFlameTerms);
  for (Eigen::Index j = 0; j < kFlameTerms; ++j) {
    out.spectrum.col(j) = BandSpectrum(record, columns.col(j), record.flame_count);
  }
  return out;
}

Eigen::VectorXcd FlameMultiplier(const CutRecord& record, const Effect& effect, EffectValues x,
                                 double tau_s) {
  const Eigen::Index n = record.flame_count + 2 * kTapReach;
  const double tau = DelayMoves(effect, x) ? 0.0 : DelayOf(record, effect, x, tau_s);
  Eigen::VectorXcd out = DelayOnBand(record, n, tau);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double f = record.frequency_hz[k];
    out[k] *= effect.HeatReleaseInstrument(f, x) * effect.FlameOut(f, record.at, x);
  }
  if (record.reference.flame.size() > 0) out = out.cwiseProduct(record.reference.flame).eval();
  return out;
}

FlameSolution SolveFlame(const CutRecord& record, const Effect& effect, EffectValues x,
                         double tau_s, const FlameColumns& columns, const Eigen::VectorXd& weight) {
  const Eigen::Index n = record.flame_count;
  const Eigen::VectorXcd multiplier = FlameMultiplier(record, effect, x, tau_s);
  FlameSolution out;
  out.columns.resize(n, kFlameTerms);
  for (Eigen::Index j = 0; j < kFlameTerms; ++j) {
    out.columns.col(j) = ApplyWindow(multiplier.cwiseProduct(columns.spectrum.col(j)), n);
  }
  Eigen::VectorXcd target = record.windowed_heat_release.head(n);
  const Response leak = effect.PressureLeak(record.at.cycle_frequency_hz, record.at, x);
  if (leak != 0.0) target -= leak * record.windowed_pressure.head(n);
  out.coefficients = SolveScaled(RealGram(weight, out.columns, out.columns),
                                 RealGram(weight, out.columns, target), kRidge);
  out.residual = target - out.columns * out.coefficients;
  return out;
}

Eigen::MatrixXcd FlameJacobian(const CutRecord& record, const Effect& effect, EffectValues x,
                               double tau_s, const FlameColumns& columns,
                               const FlameSolution& solution, const Eigen::VectorXd& steps) {
  const Eigen::Index n = record.flame_count;
  const Eigen::VectorXcd multiplier = FlameMultiplier(record, effect, x, tau_s);
  const Eigen::VectorXcd phi = columns.spectrum * solution.coefficients;
  const Eigen::VectorXcd now = multiplier.cwiseProduct(phi);
  const double factor = effect.DelayFactor(record.at, x);
  Eigen::MatrixXcd jacobian(n, 1 + steps.size());
  Eigen::VectorXcd by_tau(now.size());
  for (Eigen::Index k = 0; k < now.size(); ++k) {
    by_tau[k] = LaplaceVariable(record.frequency_hz[k]) * factor * now[k];
  }
  jacobian.col(0) = ApplyWindow(by_tau, n);
  std::vector<double> at(x.begin(), x.end());
  for (Eigen::Index j = 0; j < steps.size(); ++j) {
    at[static_cast<std::size_t>(j)] = x[static_cast<std::size_t>(j)] + steps[j];
    Eigen::VectorXcd moved = phi;
    if (effect.ChangesFlameInput() || effect.ModulatesDelay()) {
      const Eigen::VectorXd v = FlameInput(record, effect, at, tau_s);
      moved = BandSpectrum(record, FlameBasis(columns.range).Value(v, solution.coefficients), n);
    }
    moved = FlameMultiplier(record, effect, at, tau_s).cwiseProduct(moved);
    jacobian.col(1 + j) = ApplyWindow((now - moved) / steps[j], n);
    const double f0 = record.at.cycle_frequency_hz;
    const Response leak =
        effect.PressureLeak(f0, record.at, at) - effect.PressureLeak(f0, record.at, x);
    if (leak != 0.0) jacobian.col(1 + j) -= leak / steps[j] * record.windowed_pressure.head(n);
    at[static_cast<std::size_t>(j)] = x[static_cast<std::size_t>(j)];
  }
  return jacobian;
}

}  // namespace howl
