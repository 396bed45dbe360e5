#include "estimation/transfer.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace howl {
namespace {

// The lowest level of q's spectrum over any 16 bins: white noise of q's own is at most that. Zero
// where q is coherent with p even there: then nothing is known of the noise.
double HeatReleaseNoise(const CrossSpectrum& spectrum) {
  constexpr int kBins = 16;
  const int last = static_cast<int>(spectrum.qq.size()) * 98 / 100;
  double lowest = std::numeric_limits<double>::infinity();
  double coherence = 1.0;
  for (int start = 3; start + kBins <= last; start += kBins / 2) {
    double qq = 0, pp = 0;
    std::complex<double> qp = 0;
    for (int k = start; k < start + kBins; ++k) {
      const auto i = static_cast<std::size_t>(k);
      qq += spectrum.qq[i];
      pp += spectrum.pp[i];
      qp += spectrum.qp[i];
    }
    if (qq < lowest) {
      lowest = qq;
      coherence = std::norm(qp) / std::max(qq * pp, 1e-300);
    }
  }
  const double nu = spectrum.degrees_of_freedom * 0.4 * kBins;
  return std::isfinite(lowest) && coherence < 7.0 / std::max(nu, 8.0) ? lowest / kBins : 0.0;
}

}  // namespace

Transfer EstimateTransfer(const CrossSpectrum& spectrum, std::span<const SpectralLine> lines,
                          const TransferOptions& options) {
  Transfer transfer;
  if (!spectrum.HasHeatRelease()) return transfer;
  const int count = std::max(options.bins_per_point, 1);
  const double nyquist_hz = spectrum.Frequency(static_cast<int>(spectrum.pp.size()) - 1);
  const double top = options.max_frequency_hz > 0 ? options.max_frequency_hz : 0.9 * nyquist_hz;
  std::vector<char> keep(spectrum.pp.size(), 1);
  for (const SpectralLine& line : lines) {
    if (!line.narrow || std::max(line.p_over_floor, line.q_over_floor) < options.strong_line) {
      continue;
    }
    const double reach = kBlackmanHarrisMainLobeBins + 0.5 + 2.0 * line.width_hz / spectrum.bin_hz;
    const double center = line.frequency_hz.value / spectrum.bin_hz;
    for (int k = std::max(static_cast<int>(std::ceil(center - reach)), 0);
         k <= center + reach && k < static_cast<int>(keep.size()); ++k) {
      keep[static_cast<std::size_t>(k)] = 0;
    }
  }
  const double nu = spectrum.DegreesOfFreedom(count);
  constexpr int kMany = 16;
  transfer.neighbour_inflation = kMany * nu / spectrum.DegreesOfFreedom(kMany * count);
  transfer.q_noise_psd = HeatReleaseNoise(spectrum);
  if (nu < 2.0) return transfer;
  const double by_chance = 1.0 - std::pow(options.false_alarm, 1.0 / (nu - 1.0));

  const int first =
      std::max(static_cast<int>(std::ceil(options.min_frequency_hz / spectrum.bin_hz)), 3);
  const int last =
      std::min(static_cast<int>(top / spectrum.bin_hz), static_cast<int>(spectrum.pp.size()) - 1);
  for (int start = first; start + count <= last;) {
    double pp = 0, qq = 0, moment = 0, second = 0;
    std::complex<double> qp = 0;
    int blocked = -1;
    for (int k = start; k < start + count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (!keep[i]) blocked = k;
      pp += spectrum.pp[i];
      qq += spectrum.qq[i];
      qp += spectrum.qp[i];
      moment += spectrum.qq[i] * k;
      second += spectrum.qq[i] * k * k;
    }
    if (blocked >= 0) {
      start = blocked + 1;
      continue;
    }
    start += count;
    if (!(pp > 0.0) || !(qq > 0.0)) continue;
    const double raw = std::norm(qp) / (pp * qq);
    const double coherence = (nu * raw - 1.0) / (nu - 1.0);
    if (raw < by_chance || coherence < options.min_coherence) continue;
    const double noise = std::min(0.5 * count * transfer.q_noise_psd, 0.5 * qq);
    const std::complex<double> h = qp / (qq - noise);
    TransferPoint point;
    const double center = moment / qq;
    point.frequency_hz = center * spectrum.bin_hz;
    point.spread_hz =
        std::sqrt(second / qq - center * center + kBlackmanHarrisVarianceBins2) * spectrum.bin_hz;
    point.re = h.real();
    point.im = h.imag();
    point.coherence = std::min(coherence, 1.0 - 1e-9);
    point.degrees_of_freedom = nu;
    point.q_noise_bias = noise / (qq - noise);
    point.weight = std::norm(h) * (qq - noise);
    const double scatter = std::norm(h) * (1.0 - point.coherence) / (2.0 * nu * point.coherence);
    // The noise is anything from none to S_n, and what it changes lies along H.
    const std::complex<double> doubt = point.q_noise_bias / std::sqrt(3.0) * h;
    point.variance_re = scatter + doubt.real() * doubt.real();
    point.variance_im = scatter + doubt.imag() * doubt.imag();
    point.covariance = doubt.real() * doubt.imag();
    transfer.points.push_back(point);
  }
  return transfer;
}

}  // namespace howl
