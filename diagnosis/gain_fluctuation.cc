#include "diagnosis/gain_fluctuation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "diagnosis/real_fft.h"

namespace howl {
namespace {

constexpr double kCarrierBand = 0.35;    // of the cycle's frequency, on each side
constexpr double kLowPass = 1.0 / 12.0;  // of the cycle's frequency
constexpr double kEnds = 0.03;           // of the record, left out

using Series = std::vector<std::complex<double>>;

// Analytic signal of what lies near the cycle.
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

// D(t), at twice the low-pass's frequency.
Series Demodulate(const CutRecord& record, const Series& residual, const Series& reference,
                  double low_pass_hz, double* step_s, Eigen::VectorXd* gain) {
  const auto stride =
      static_cast<Eigen::Index>(std::max(1.0, record.sampling_hz / (2.0 * low_pass_hz)));
  // A Gaussian in time with the low-pass exp(-(f / f_c)^2).
  const double width = record.sampling_hz / (std::numbers::pi * low_pass_hz);
  const auto reach = static_cast<Eigen::Index>(3.0 * width);
  std::vector<double> kernel;
  for (Eigen::Index i = -reach; i <= reach; ++i) {
    const double x = static_cast<double>(i) / width;
    kernel.push_back(std::exp(-x * x));
  }
  const auto ends = static_cast<Eigen::Index>(kEnds * static_cast<double>(record.samples)) + reach;
  Series out;
  std::vector<double> local;  // Re D over the present amplitude
  double mean_power = 0.0;
  for (Eigen::Index centre = ends; centre + ends < record.samples; centre += stride) {
    std::complex<double> top = 0.0;
    double bottom = 0.0;
    for (Eigen::Index i = -reach; i <= reach; ++i) {
      const auto at = static_cast<std::size_t>(centre + i);
      const double w = kernel[static_cast<std::size_t>(i + reach)];
      top += w * residual[at] * std::conj(reference[at]);
      bottom += w * std::norm(reference[at]);
    }
    // Over the mean amplitude, not the present one, the noise is as large at all times.
    out.push_back(top / std::sqrt(std::max(bottom, 1e-300)));
    local.push_back(top.real() / std::max(bottom, 1e-300));
    mean_power += bottom;
  }
  mean_power /= std::max<double>(1.0, static_cast<double>(out.size()));
  for (auto& value : out) value /= std::sqrt(mean_power);
  *step_s = static_cast<double>(stride) / record.sampling_hz;
  gain->setZero(record.samples);
  for (Eigen::Index i = 0; i < record.samples && !local.empty(); ++i) {
    const double x = std::clamp(static_cast<double>(i - ends) / static_cast<double>(stride), 0.0,
                                static_cast<double>(local.size() - 1));
    const auto k = std::min(static_cast<std::size_t>(x), local.size() - 1);
    const double next = local[std::min(k + 1, local.size() - 1)];
    (*gain)[i] = local[k] + (x - static_cast<double>(k)) * (next - local[k]);
  }
  return out;
}

double Normal(double x, double mean, double variance) {
  const double d = x - mean;
  return std::exp(-0.5 * d * d / variance) / std::sqrt(2.0 * std::numbers::pi * variance);
}

// First-order autoregression with a mean: - log-likelihood of all series, three parameters.
double ColouredCost(const std::vector<std::vector<double>>& all) {
  double sum_xy = 0.0;
  double sum_xx = 0.0;
  double count = 0.0;
  double mean = 0.0;
  for (const auto& x : all) {
    for (const double value : x) {
      mean += value;
      count += 1.0;
    }
  }
  mean /= count;
  for (const auto& x : all) {
    for (std::size_t i = 1; i < x.size(); ++i) {
      sum_xy += (x[i] - mean) * (x[i - 1] - mean);
      sum_xx += (x[i - 1] - mean) * (x[i - 1] - mean);
    }
  }
  const double a = std::clamp(sum_xy / sum_xx, -0.99, 0.99);
  double squares = 0.0;
  for (const auto& x : all) {
    squares += (x[0] - mean) * (x[0] - mean) * (1.0 - a * a);
    for (std::size_t i = 1; i < x.size(); ++i) {
      const double e = x[i] - mean - a * (x[i - 1] - mean);
      squares += e * e;
    }
  }
  const double variance = squares / count;
  return 0.5 * count * (std::log(2.0 * std::numbers::pi * variance) + 1.0) + 3.0;
}

struct Switching {
  double cost = 0.0;
  std::array<double, 2> mean{};
  std::array<double, 2> leave{};
};

// Two levels with one spread, by expectation maximisation: five parameters.
Switching FitSwitching(const std::vector<std::vector<double>>& all) {
  std::vector<double> pooled;
  for (const auto& x : all) pooled.insert(pooled.end(), x.begin(), x.end());
  std::sort(pooled.begin(), pooled.end());
  const double spread = pooled[pooled.size() * 9 / 10] - pooled[pooled.size() / 10];
  Switching at;
  at.mean = {pooled[pooled.size() / 5], pooled[pooled.size() * 3 / 5]};
  at.leave = {0.15, 0.15};
  double variance = spread * spread / 9.0;  // of both levels
  const double floor = 1e-4 * spread * spread;
  double log_likelihood = 0.0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    log_likelihood = 0.0;
    std::array<double, 2> weight{};
    std::array<double, 2> sum{};
    std::array<double, 2> squares{};
    std::array<double, 2> stays{};
    std::array<double, 2> leaves{};
    for (const auto& x : all) {
      const std::size_t n = x.size();
      std::vector<std::array<double, 2>> forward(n);
      std::vector<double> scale(n);
      const double total = at.leave[0] + at.leave[1];
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t s = 0; s < 2; ++s) {
          const double before = i == 0 ? at.leave[1 - s] / total
                                       : forward[i - 1][s] * (1.0 - at.leave[s]) +
                                             forward[i - 1][1 - s] * at.leave[1 - s];
          forward[i][s] = before * Normal(x[i], at.mean[s], variance) + 1e-300;
        }
        scale[i] = forward[i][0] + forward[i][1];
        for (double& value : forward[i]) value /= scale[i];
        log_likelihood += std::log(scale[i]);
      }
      std::array<double, 2> backward = {1.0, 1.0};
      for (std::size_t i = n; i-- > 0;) {
        for (std::size_t s = 0; s < 2; ++s) {
          const double gamma = forward[i][s] * backward[s];
          weight[s] += gamma;
          sum[s] += gamma * x[i];
          squares[s] += gamma * (x[i] - at.mean[s]) * (x[i] - at.mean[s]);
        }
        if (i == 0) break;
        std::array<double, 2> emitted{};
        for (std::size_t s = 0; s < 2; ++s) {
          emitted[s] = Normal(x[i], at.mean[s], variance) * backward[s] / scale[i];
        }
        for (std::size_t s = 0; s < 2; ++s) {
          stays[s] += forward[i - 1][s] * (1.0 - at.leave[s]) * emitted[s];
          leaves[s] += forward[i - 1][s] * at.leave[s] * emitted[1 - s];
          backward[s] = (1.0 - at.leave[s]) * emitted[s] + at.leave[s] * emitted[1 - s];
        }
      }
    }
    variance = std::max((squares[0] + squares[1]) / (weight[0] + weight[1]), floor);
    for (std::size_t s = 0; s < 2; ++s) {
      at.mean[s] = sum[s] / std::max(weight[s], 1e-300);
      at.leave[s] = std::clamp(leaves[s] / std::max(leaves[s] + stays[s], 1e-300), 1e-3, 0.9);
    }
  }
  at.cost = -log_likelihood + 5.0;
  return at;
}

}  // namespace

GainFluctuation EstimateGainFluctuation(const std::vector<CutRecord>& records,
                                        const EffectFit& fit) {
  GainFluctuation out;
  std::vector<std::vector<double>> in_phase;
  double step_s = 0.0;
  double lag_product = 0.0;
  double lag_power = 0.0;
  double in_phase_power = 0.0;
  double quadrature_power = 0.0;
  double total_count = 0.0;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const CutRecord& record = records[e];
    const double low_pass_hz = kLowPass * record.at.cycle_frequency_hz;
    const FlameColumns columns = MakeFlameColumns(record, *fit.effect, fit.values, fit.tau_s);
    const Eigen::VectorXcd phi = FlameMultiplier(record, *fit.effect, fit.values, fit.tau_s)
                                     .cwiseProduct(columns.spectrum * fit.experiments[e].flame);
    const Eigen::VectorXcd q =
        record.heat_release_spectrum.segment(record.first - kTapReach, phi.size());
    const Series reference = Analytic(record, phi);
    const Series residual = Analytic(record, q - phi);
    Eigen::VectorXd gain;
    const Series d = Demodulate(record, residual, reference, low_pass_hz, &step_s, &gain);
    Eigen::VectorXd fluctuation(record.samples);
    for (Eigen::Index i = 0; i < record.samples; ++i) {
      fluctuation[i] = gain[i] * reference[static_cast<std::size_t>(i)].real();
    }
    out.corrected.push_back(
        fit.experiments[e].flame_residual -
        ApplyWindow(ForwardFft(fluctuation)
                        .segment(record.first - kTapReach, record.flame_count + 2 * kTapReach),
                    record.flame_count));
    std::vector<double> x;
    double re = 0.0;
    double im = 0.0;
    std::complex<double> mean = 0.0;
    for (const auto& value : d) mean += value / static_cast<double>(d.size());
    for (const auto& value : d) {
      x.push_back(value.real());
      re += std::pow(value.real() - mean.real(), 2) / static_cast<double>(d.size());
      im += std::pow(value.imag() - mean.imag(), 2) / static_cast<double>(d.size());
    }
    // Independent values: the low-pass's noise bandwidth times the duration.
    const double independent = 1.25 * low_pass_hz * step_s * static_cast<double>(d.size());
    (re > im ? out.gain : out.quadrature_gain) +=
        0.5 * independent * (2.0 * std::log(0.5 * (re + im)) - std::log(re * im));
    for (std::size_t i = 2; i < x.size(); ++i) {
      lag_product += (x[i] - mean.real()) * (x[i - 2] - mean.real());
      lag_power += std::pow(x[i] - mean.real(), 2);
    }
    in_phase_power += re * static_cast<double>(d.size());
    quadrature_power += im * static_cast<double>(d.size());
    total_count += static_cast<double>(d.size());
    for (double& value : x) value -= mean.real();
    in_phase.push_back(std::move(x));
  }
  out.in_phase_std = std::sqrt(in_phase_power / total_count);
  out.quadrature_std = std::sqrt(quadrature_power / total_count);
  const double correlation = std::clamp(lag_product / lag_power, 1e-3, 0.999);
  out.correlation_s = -2.0 * step_s / std::log(correlation);
  out.coloured_cost = ColouredCost(in_phase);
  const Switching switching = FitSwitching(in_phase);
  out.switching_cost = switching.cost;
  const std::size_t low = switching.mean[0] < switching.mean[1] ? 0 : 1;
  out.low_level = (1.0 + switching.mean[low]) / (1.0 + switching.mean[1 - low]);
  out.dwell_s = step_s / switching.leave[low];
  return out;
}

}  // namespace howl
