#include "estimation/analysis/spectra/lines.h"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <cmath>

#include "estimation/analysis/spectra/line_phase.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

double Log10PValue(double nu, double ratio) {
  const boost::math::gamma_distribution<> noise(nu, 1.0 / nu);
  return std::log10(std::max(boost::math::cdf(boost::math::complement(noise, ratio)), 1e-300));
}

// Local maxima above threshold, strongest first, each separated from every stronger one by a
// valley.
std::vector<int> PeakBins(std::span<const double> s, std::span<const double> floor,
                          double threshold, double prominence, int first) {
  std::vector<int> candidates;
  const int last = static_cast<int>(s.size()) - 3;
  const auto at = [&](int k) { return s[static_cast<std::size_t>(k)]; };
  for (int k = std::max(first, 2); k <= last; ++k) {
    if (at(k) > threshold * floor[static_cast<std::size_t>(k)] && at(k) >= at(k - 1) &&
        at(k) > at(k + 1)) {
      candidates.push_back(k);
    }
  }
  std::sort(candidates.begin(), candidates.end(), [&](int a, int b) { return at(a) > at(b); });
  std::vector<int> peaks;
  for (int k : candidates) {
    bool separate = true;
    for (int stronger : peaks) {
      const int distance = std::abs(k - stronger);
      if (distance <= kBlackmanHarrisMainLobeBins) {
        separate = false;
        break;
      }
      if (distance >= 40) continue;  // far apart, the floor has already judged
      const auto [low, high] = std::minmax(k, stronger);
      double valley = at(k);
      for (int j = low; j <= high; ++j) valley = std::min(valley, at(j));
      if (at(k) < prominence * valley) separate = false;
    }
    if (separate) peaks.push_back(k);
  }
  return peaks;
}

double HalfPowerWidth(std::span<const double> s, double floor, int bin) {
  const int last = static_cast<int>(s.size()) - 1;
  const auto above = [&](int k) { return std::max(s[static_cast<std::size_t>(k)] - floor, 0.0); };
  const double half = 0.5 * above(bin);
  const auto side = [&](int step) {
    for (int k = bin; k + step > 0 && k + step < last; k += step) {
      const double here = above(k), next = above(k + step);
      if (next < half) return std::abs(k - bin) + (here - half) / std::max(here - next, 1e-300);
    }
    return std::abs(last - bin) + 0.0;
  };
  return side(-1) + side(1);
}

double Amplitude(std::span<const double> s, std::span<const double> floor, int bin, int half_width,
                 double bin_hz) {
  double power = 0.0;
  const int last = static_cast<int>(s.size()) - 1;
  for (int k = std::max(bin - half_width, 0); k <= std::min(bin + half_width, last); ++k) {
    const auto i = static_cast<std::size_t>(k);
    power += s[i] - floor[i];
  }
  return std::sqrt(2.0 * std::max(power, 0.0) * bin_hz);
}

// A line whose phase cannot be followed is a resonance, and its frequency the place of a maximum of
// a spectrum known to 1 / sqrt(nu): within half the width times nu^(-1/4) of the peak of a
// Lorentzian the spectrum falls by less than that.
Estimate RefineFrequency(std::span<const double> x, double sampling_hz, double frequency_hz,
                         double width_hz, double nu) {
  const int n = static_cast<int>(x.size());
  Estimate result{frequency_hz, std::numeric_limits<double>::quiet_NaN()};
  bool followed = true;
  for (int pass = 0; pass < 2; ++pass) {
    // Long blocks are tried first, because unwrapping needs every block well above the noise.
    const Blocks blocks = Demodulate(x, sampling_hz, result.value, n / 12);
    const PhaseSeries phase = UnwrapPhase(blocks.amplitude);
    const LineFrequency line = EstimateLineFrequency(blocks.amplitude, phase, blocks.hop_s);
    if (!std::isfinite(line.offset_hz.value)) break;
    result = {result.value + line.offset_hz.value, line.offset_hz.std};
    followed = phase.reliable;
  }
  if (!followed) result.std = std::hypot(result.std, 0.5 * width_hz / std::sqrt(std::sqrt(nu)));
  return result;
}

// 5 Hz of the paper's cycle at 220 Hz, sampled at 5 kHz.
double LowestLine(double sampling_hz, double fundamental_hz) {
  return fundamental_hz > 0.0 ? fundamental_hz / 44.0 : std::min(5.0, sampling_hz / 1000.0);
}

}  // namespace

std::vector<double> NoiseFloor(std::span<const double> spectrum, double nu) {
  const int n = static_cast<int>(spectrum.size());
  const int half = std::clamp(n / 8, 4, 30);
  const boost::math::gamma_distribution<> noise(nu, 1.0 / nu);
  const double scale = 1.0 / boost::math::median(noise);
  std::vector<double> floor(spectrum.size());
  for (int k = 0; k < n; ++k) {
    // The window keeps its size at the ends, by sliding inwards; bins 0 and 1 hold the mean.
    const int low = std::clamp(k - half, std::min(2, n - 1), std::max(n - 2 * half - 1, 2));
    const int high = std::min(low + 2 * half + 1, n);
    floor[static_cast<std::size_t>(k)] =
        scale * Median(spectrum.subspan(static_cast<std::size_t>(low),
                                        static_cast<std::size_t>(high - low)));
  }
  return floor;
}

double PeakThreshold(double nu, int bins, double alpha) {
  const boost::math::gamma_distribution<> noise(nu, 1.0 / nu);
  return boost::math::quantile(boost::math::complement(noise, alpha / std::max(bins, 1)));
}

std::vector<SpectralLine> FindLines(const Record& record, const CrossSpectrum& spectrum,
                                    double fundamental_hz, const LineOptions& options) {
  const double nu = spectrum.degrees_of_freedom;
  const int bins = static_cast<int>(spectrum.pp.size());
  const double threshold = PeakThreshold(nu, bins, options.false_alarm);
  const boost::math::fisher_f ratio(2.0 * nu, 2.0 * nu);
  const double prominence = boost::math::quantile(boost::math::complement(ratio, 1e-3));
  const double lowest_hz = options.min_frequency_hz > 0.0
                               ? options.min_frequency_hz
                               : LowestLine(record.sampling_hz, fundamental_hz);
  const int first = static_cast<int>(std::ceil(lowest_hz / spectrum.bin_hz));
  const std::vector<double> p = RemoveMean(record.pressure);
  const std::vector<double> q = RemoveMean(record.heat_release);
  const std::vector<double> p_floor = NoiseFloor(spectrum.pp, nu);
  const std::vector<double> q_floor =
      spectrum.HasHeatRelease() ? NoiseFloor(spectrum.qq, nu) : std::vector<double>();

  std::vector<int> peaks = PeakBins(spectrum.pp, p_floor, threshold, prominence, first);
  if (spectrum.HasHeatRelease()) {
    for (int k : PeakBins(spectrum.qq, q_floor, threshold, prominence, first)) {
      const bool known = std::any_of(peaks.begin(), peaks.end(), [&](int other) {
        return std::abs(other - k) <= kBlackmanHarrisMainLobeBins;
      });
      if (!known) peaks.push_back(k);
    }
  }
  std::vector<SpectralLine> lines;
  for (int k : peaks) {
    const auto i = static_cast<std::size_t>(k);
    SpectralLine line;
    line.p_over_floor = spectrum.pp[i] / p_floor[i];
    line.p_log10_p_value = Log10PValue(nu, line.p_over_floor);
    if (spectrum.HasHeatRelease()) {
      line.q_over_floor = spectrum.qq[i] / q_floor[i];
      line.q_log10_p_value = Log10PValue(nu, line.q_over_floor);
      line.coherence = std::norm(spectrum.qp[i]) / (spectrum.pp[i] * spectrum.qq[i]);
      line.phase_deg = {
          std::arg(spectrum.qp[i]) * kDegPerRad,
          std::sqrt((1.0 - line.coherence) / (2.0 * nu * line.coherence)) * kDegPerRad};
    }
    const bool by_p = line.p_over_floor >= line.q_over_floor;
    const std::vector<double>& s = by_p ? spectrum.pp : spectrum.qq;
    const double full = HalfPowerWidth(s, (by_p ? p_floor : q_floor)[i], k);
    const double excess = full * full - kBlackmanHarrisHalfPowerBins * kBlackmanHarrisHalfPowerBins;
    line.width_hz = std::sqrt(std::max(excess, 0.0)) * spectrum.bin_hz;
    line.resolution_hz = spectrum.bin_hz;
    const int reach = std::max(kBlackmanHarrisMainLobeBins, static_cast<int>(std::lround(full)));
    line.p_amplitude = Amplitude(spectrum.pp, p_floor, k, reach, spectrum.bin_hz);
    if (spectrum.HasHeatRelease()) {
      line.q_amplitude = Amplitude(spectrum.qq, q_floor, k, reach, spectrum.bin_hz);
    }
    double moment = 0.0, sum = 0.0;
    for (int j = k - 2; j <= k + 2; ++j) {
      sum += s[static_cast<std::size_t>(j)];
      moment += j * s[static_cast<std::size_t>(j)];
    }
    line.frequency_hz = RefineFrequency(by_p ? p : q, record.sampling_hz,
                                        moment / sum * spectrum.bin_hz, line.width_hz, nu);
    line.narrow =
        line.width_hz < std::max(options.max_width * line.frequency_hz.value, line.resolution_hz);
    if (fundamental_hz > 0.0) {
      const int multiple = static_cast<int>(std::lround(line.frequency_hz.value / fundamental_hz));
      const double distance = std::abs(line.frequency_hz.value - multiple * fundamental_hz);
      const double noise = std::isfinite(line.frequency_hz.std) ? line.frequency_hz.std : 0.0;
      if (multiple > 0 &&
          distance < std::max({1.5 * spectrum.bin_hz, 3.0 * noise, 0.5 * line.width_hz})) {
        line.harmonic = multiple;
      }
    }
    lines.push_back(line);
  }
  std::sort(lines.begin(), lines.end(), [](const SpectralLine& a, const SpectralLine& b) {
    return std::max(a.p_over_floor, a.q_over_floor) > std::max(b.p_over_floor, b.q_over_floor);
  });
  return lines;
}

}  // namespace howl
