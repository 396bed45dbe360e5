#include "diagnosis/gap/slack.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/numerics/local_power.h"
#include "diagnosis/numerics/real_gram.h"
#include "diagnosis/numerics/scaled_solve.h"

namespace howl {
namespace {

constexpr double kBandOfCycle = 0.2;  // width, of the cycle's frequency
constexpr Eigen::Index kMedianReach = 12;

// x: predicted signals, e: residuals, v: noise; one of each for every experiment.
std::vector<SlackBand> Bands(const std::vector<CutRecord>& records,
                             const std::vector<Eigen::VectorXcd>& x,
                             const std::vector<const Eigen::VectorXcd*>& e,
                             const std::vector<const Eigen::VectorXd*>& v) {
  const double width = kBandOfCycle * records[0].at.cycle_frequency_hz;
  const double low = records[0].frequency(0);
  const double high = records[0].frequency(e[0]->size() - 1);
  std::vector<SlackBand> bands;
  const auto count = static_cast<int>(std::ceil((high - low) / width - 0.5));
  for (int b = 0; b < count; ++b) {
    const double from = low + b * width;
    SlackBand band{from, std::min(from + width, high), 0.0, 0.0, {}};
    std::complex<double> sum = 0.0;
    double norm = 0.0;
    for (std::size_t i = 0; i < records.size(); ++i) {
      const Eigen::VectorXd& share = records[i].reference.acoustic_share;
      std::complex<double> own = 0.0;
      double own_norm = 0.0;
      for (Eigen::Index k = 0; k < e[i]->size(); ++k) {
        const double f = records[i].frequency(k);
        if (f < from || f >= band.high_hz || records[i].masked[static_cast<std::size_t>(k)])
          continue;
        const double counts = share.size() > 0 ? share[k] : 1.0;
        own += counts * (std::conj(x[i][k]) * (*e[i])[k] / (*v[i])[k]);
        own_norm += counts * (std::norm(x[i][k]) / (*v[i])[k]);
      }
      band.by_experiment.push_back(own_norm > 0.0 ? std::norm(own) / own_norm / kBinCorrelation
                                                  : 0.0);
      sum += own;
      norm += own_norm;
    }
    if (norm <= 0.0) continue;
    band.error = sum / norm;
    band.gain = std::norm(sum) / norm / kBinCorrelation;
    bands.push_back(std::move(band));
  }
  return bands;
}

double Excess(const std::vector<SlackBand>& bands) {
  double sum = 0.0;
  for (const SlackBand& band : bands) sum += band.gain - 1.0;
  // Four standard deviations of what noise alone gives.
  return std::max(0.0, sum - 4.0 * std::sqrt(static_cast<double>(bands.size())));
}

// Offsets from tau, half a period of the band's upper edge apart.
std::vector<double> Offsets(const CutRecord& record, double tau_s) {
  const double step = 0.5 / record.frequency(record.flame_count - 1);
  std::vector<double> offsets;
  const auto count = static_cast<int>(std::ceil(2.6 * tau_s / step));
  for (int j = 0; j < count; ++j) offsets.push_back(-0.6 * tau_s + j * step);
  return offsets;
}

// The typical power around each bin, as a variance. A gain that fluctuates spreads the cycle's line
// over a few hertz, which the smooth V does not contain, and slack would fit its chance pattern.
Eigen::VectorXd TypicalPower(const Eigen::VectorXcd& residual) {
  const Eigen::VectorXd power = residual.cwiseAbs2();
  Eigen::VectorXd out(power.size());
  for (Eigen::Index k = 0; k < power.size(); ++k) out[k] = LocalPower(power, k, kMedianReach);
  return out;
}

struct Normal {
  Eigen::MatrixXd gram;
  Eigen::VectorXd right;
};

// The decrease of the cost by least squares.
double Gain(const Normal& at) { return at.right.dot(SolveScaled(at.gram, at.right, 1e-6).col(0)); }

}  // namespace

Slack ComputeSlack(const std::vector<CutRecord>& records, const EffectFit& fit) {
  std::vector<Eigen::VectorXcd> x_a;
  std::vector<const Eigen::VectorXcd*> e_a;
  std::vector<const Eigen::VectorXd*> v_a;
  Slack out;
  const std::vector<double> offsets = Offsets(records[0], fit.tau_s);
  const auto taps = static_cast<Eigen::Index>(offsets.size());
  Normal total{Eigen::MatrixXd::Zero(taps, taps), Eigen::VectorXd::Zero(taps)};
  for (std::size_t i = 0; i < records.size(); ++i) {
    const ExperimentFit& at = fit.experiments[i];
    x_a.push_back(records[i].windowed_pressure - at.acoustic_residual);
    e_a.push_back(&at.acoustic_residual);
    v_a.push_back(&at.acoustic_noise);
    const Eigen::Index n = records[i].flame_count;
    Eigen::VectorXcd x = records[i].windowed_heat_release.head(n) - at.flame_residual;
    // X is the flame's part alone, because a leak has no delay that the filter may shorten.
    x -= fit.effect->PressureLeak(records[i].at.cycle_frequency_hz, records[i].at, fit.values) *
         records[i].windowed_pressure.head(n);
    Eigen::VectorXd weight =
        at.flame_noise.cwiseMax(TypicalPower(at.flame_residual)).cwiseInverse() / kBinCorrelation;
    weight = weight.cwiseProduct(records[i].flame_share).eval();
    Eigen::MatrixXcd columns(n, taps);
    for (Eigen::Index k = 0; k < n; ++k) {
      if (records[i].masked[static_cast<std::size_t>(k)]) weight[k] = 0.0;
      for (Eigen::Index j = 0; j < taps; ++j) {
        const double angle =
            -kRadPerSPerHz * records[i].frequency(k) * offsets[static_cast<std::size_t>(j)];
        columns(k, j) = x[k] * std::polar(1.0, angle);
      }
    }
    const Normal own{RealGram(weight, columns, columns),
                     RealGram(weight, columns, at.flame_residual)};
    out.flame_by_experiment.push_back(Gain(own));
    total.gram += own.gram;
    total.right += own.right;
  }
  out.acoustic = Bands(records, x_a, e_a, v_a);
  out.acoustic_excess = Excess(out.acoustic);
  // Half a unit for each real coefficient is expected of noise alone.
  const double expected = 0.5 * static_cast<double>(taps);
  out.flame_excess = std::max(0.0, Gain(total) - expected - 4.0 * std::sqrt(0.5 * expected));
  return out;
}

}  // namespace howl
