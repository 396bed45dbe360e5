#include "diagnosis/samples/gain_fluctuation.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "diagnosis/numerics/real_fft.h"
#include "diagnosis/records/band_signal.h"
#include "diagnosis/samples/fluctuation_kind.h"

namespace howl {
namespace {

constexpr double kCarrierBand = 0.35;    // of the cycle's frequency, on each side
constexpr double kLowPass = 1.0 / 12.0;  // of the cycle's frequency
constexpr double kStepsPerPeriod = 2.0;
// The spacing of the values from which the kinds are told apart: their noise must be independent,
// and few of them may straddle a jump.
constexpr double kKindLowPass = 1.0 / 10.0;
constexpr double kKindStepsPerPeriod = 1.0 / 0.7;
constexpr double kEnds = 0.03;  // of the record, left out
constexpr double kLeastAmplitude = 0.02;

using Series = std::vector<std::complex<double>>;

// The analytic signal of the part near the cycle's frequency.
std::vector<std::complex<double>> Analytic(const CutRecord& record, const Eigen::VectorXcd& band) {
  Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(record.pressure_spectrum.size());
  const double f0 = record.at.cycle_frequency_hz;
  for (Eigen::Index k = 0; k < band.size(); ++k) {
    if (std::abs(record.frequency_hz[k] - f0) < kCarrierBand * f0) {
      spectrum[record.first - kTapReach + k] = band[k];
    }
  }
  const Eigen::VectorXd re = InverseFft(spectrum, record.samples);
  spectrum *= std::complex<double>(0.0, -1.0);
  const Eigen::VectorXd im = InverseFft(spectrum, record.samples);
  std::vector<std::complex<double>> out;
  for (Eigen::Index i = 0; i < re.size(); ++i) out.emplace_back(re[i], im[i]);
  return out;
}

// C, the residual over the reference, and the reference's slow amplitude, whose mean square is 1.
struct Demodulated {
  double step_s = 0.0;
  std::ptrdiff_t first = 0;  // sample of the first value
  std::ptrdiff_t stride = 0;
  Series ratio;                   // C
  std::vector<double> amplitude;  // A

  // D = A C is relative to the mean amplitude and not to the present one, so that the noise is as
  // large at all times.
  std::complex<double> Scaled(std::size_t i) const { return amplitude[i] * ratio[i]; }
};

// A Gaussian in time with the low-pass exp(-(f / f_c)^2), steps_per_period values in 1 / f_c.
Demodulated Demodulate(const CutRecord& record, const Series& residual, const Series& reference,
                       double low_pass_hz, double steps_per_period) {
  Demodulated out;
  out.stride = static_cast<std::ptrdiff_t>(
      std::max(1.0, record.sampling_hz / (steps_per_period * low_pass_hz)));
  out.step_s = static_cast<double>(out.stride) / record.sampling_hz;
  const double width = record.sampling_hz / (std::numbers::pi * low_pass_hz);
  const auto reach = static_cast<std::ptrdiff_t>(3.0 * width);
  std::vector<double> kernel;
  for (std::ptrdiff_t i = -reach; i <= reach; ++i) {
    const double x = static_cast<double>(i) / width;
    kernel.push_back(std::exp(-x * x));
  }
  out.first = static_cast<std::ptrdiff_t>(kEnds * static_cast<double>(record.samples)) + reach;
  double mean_power = 0.0;
  for (std::ptrdiff_t centre = out.first; centre + out.first < record.samples;
       centre += out.stride) {
    std::complex<double> top = 0.0;
    double bottom = 1e-300;
    for (std::ptrdiff_t i = -reach; i <= reach; ++i) {
      const auto at = static_cast<std::size_t>(centre + i);
      const double w = kernel[static_cast<std::size_t>(i + reach)];
      top += w * residual[at] * std::conj(reference[at]);
      bottom += w * std::norm(reference[at]);
    }
    out.ratio.push_back(top / bottom);
    out.amplitude.push_back(std::sqrt(bottom));
    mean_power += bottom;
  }
  const double scale =
      1.0 / std::sqrt(mean_power / std::max<double>(1.0, static_cast<double>(out.ratio.size())));
  for (double& value : out.amplitude) value *= scale;
  return out;
}

// Re C at every sample.
Eigen::VectorXd Interpolated(const Demodulated& at, Eigen::Index samples) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(samples);
  for (Eigen::Index i = 0; i < samples && !at.ratio.empty(); ++i) {
    const double x = std::clamp(static_cast<double>(i - at.first) / static_cast<double>(at.stride),
                                0.0, static_cast<double>(at.ratio.size() - 1));
    const auto k = std::min(static_cast<std::size_t>(x), at.ratio.size() - 1);
    const double next = at.ratio[std::min(k + 1, at.ratio.size() - 1)].real();
    out[i] = at.ratio[k].real() + (x - static_cast<double>(k)) * (next - at.ratio[k].real());
  }
  return out;
}

GainSeries SeriesOf(const Demodulated& at) {
  GainSeries out;
  double mean = 0.0;
  double noise = 0.0;
  const double count = static_cast<double>(at.ratio.size());
  for (std::size_t i = 0; i < at.ratio.size(); ++i) mean += at.Scaled(i).imag() / count;
  for (std::size_t i = 0; i < at.ratio.size(); ++i) {
    noise += std::pow(at.Scaled(i).imag() - mean, 2) / count;
  }
  for (std::size_t i = 0; i < at.ratio.size(); ++i) {
    out.gain.push_back(1.0 + at.ratio[i].real());
    out.amplitude.push_back(at.amplitude[i]);
    out.variance.push_back(noise / std::pow(std::max(at.amplitude[i], kLeastAmplitude), 2));
  }
  return out;
}

}  // namespace

GainFluctuation EstimateGainFluctuation(const std::vector<CutRecord>& records,
                                        const EffectFit& fit) {
  GainFluctuation out;
  std::vector<GainSeries> series;
  double step_s = 0.0;
  double lag_step_s = 0.0;
  double lag_product = 0.0;
  double lag_power = 0.0;
  double in_phase_power = 0.0;
  double quadrature_power = 0.0;
  double total_count = 0.0;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const CutRecord& record = records[e];
    const double low_pass_hz = kLowPass * record.at.cycle_frequency_hz;
    const FlameColumns columns = MakeFlameColumns(record, *fit.effect, fit.values, fit.DelayOf(e));
    const Eigen::VectorXcd phi = FlameMultiplier(record, *fit.effect, fit.values, fit.DelayOf(e))
                                     .cwiseProduct(columns.spectrum * fit.experiments[e].flame);
    const Eigen::VectorXcd q =
        record.heat_release_spectrum.segment(record.first - kTapReach, phi.size());
    const Series reference = Analytic(record, phi);
    const Series residual = Analytic(record, q - phi);
    const Demodulated d = Demodulate(record, residual, reference, low_pass_hz, kStepsPerPeriod);
    const Eigen::VectorXd gain = Interpolated(d, record.samples);
    Eigen::VectorXd fluctuation(record.samples);
    for (Eigen::Index i = 0; i < record.samples; ++i) {
      fluctuation[i] = gain[i] * reference[static_cast<std::size_t>(i)].real();
    }
    out.corrected.push_back(
        fit.experiments[e].flame_residual -
        ApplyWindow(BandSpectrum(record, fluctuation, record.flame_count), record.flame_count));
    double re = 0.0;
    double im = 0.0;
    std::complex<double> mean = 0.0;
    const double count = static_cast<double>(d.ratio.size());
    for (std::size_t i = 0; i < d.ratio.size(); ++i) mean += d.Scaled(i) / count;
    for (std::size_t i = 0; i < d.ratio.size(); ++i) {
      const std::complex<double> off = d.Scaled(i) - mean;
      re += off.real() * off.real() / count;
      im += off.imag() * off.imag() / count;
    }
    // Independent values: the low-pass's noise bandwidth times the duration.
    const double independent = 1.25 * low_pass_hz * d.step_s * count;
    (re > im ? out.gain : out.quadrature_gain) +=
        0.5 * independent * (2.0 * std::log(0.5 * (re + im)) - std::log(re * im));
    for (std::size_t i = 2; i < d.ratio.size(); ++i) {
      const double off = d.Scaled(i).real() - mean.real();
      lag_product += off * (d.Scaled(i - 2).real() - mean.real());
      lag_power += off * off;
    }
    lag_step_s = d.step_s;
    in_phase_power += re * count;
    quadrature_power += im * count;
    total_count += count;
    const Demodulated apart =
        Demodulate(record, residual, reference, kKindLowPass * record.at.cycle_frequency_hz,
                   kKindStepsPerPeriod);
    step_s = apart.step_s;
    series.push_back(SeriesOf(apart));
  }
  out.in_phase_std = std::sqrt(in_phase_power / total_count);
  out.quadrature_std = std::sqrt(quadrature_power / total_count);
  out.correlation_s =
      -2.0 * lag_step_s / std::log(std::clamp(lag_product / lag_power, 1e-3, 0.999));
  out.coloured_cost = FitColoured(series).cost;
  const SwitchingFluctuation switching = FitSwitching(series);
  out.switching_cost = switching.cost;
  out.low_level = 1.0 - switching.drop;
  out.dwell_s = step_s / switching.leave_low_per_step;
  return out;
}

}  // namespace howl
