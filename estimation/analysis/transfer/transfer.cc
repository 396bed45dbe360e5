#include "estimation/analysis/transfer/transfer.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace howl {
namespace {

// A bound on white noise of the q sensor: the part of q that is not coherent with p is S_qq (1 -
// c), which contains that noise. The bound is the least over windows of 16 bins, away from the
// strong lines.
double HeatReleaseNoise(const CrossSpectrum& spectrum, const std::vector<char>& keep) {
  constexpr int kBins = 16;
  // The least of many estimates is biased low: with the 30 to 100 averages of a window and some
  // hundred windows, by a third.
  constexpr double kLeastOfMany = 1.5;
  const double nu = spectrum.DegreesOfFreedom(kBins);
  const int last = static_cast<int>(spectrum.qq.size()) * 98 / 100;
  double least = std::numeric_limits<double>::infinity();
  for (int start = 3; start + kBins <= last; start += kBins / 2) {
    double qq = 0, pp = 0;
    std::complex<double> qp = 0;
    bool kept = true;
    for (int k = start; k < start + kBins; ++k) {
      const auto i = static_cast<std::size_t>(k);
      kept = kept && keep[i];
      qq += spectrum.qq[i];
      pp += spectrum.pp[i];
      qp += spectrum.qp[i];
    }
    if (kept) least = std::min(least, qq - std::norm(qp) / std::max(pp, 1e-300));
  }
  if (!std::isfinite(least) || !(nu > 1.0)) return 0.0;
  return kLeastOfMany * std::max(least, 0.0) * nu / (nu - 1.0) / kBins;
}

// Sums over a point's bins.
struct Group {
  double pp = 0.0, qq = 0.0;
  std::complex<double> qp = 0.0;
  double moment = 0.0, second = 0.0;  // of the bin's number, weighed by q's power
  int start = 0;

  // Magnitude squared coherence, as it comes: one over nu where there is none.
  double Raw() const { return std::norm(qp) / (pp * qq); }
};

// The groups of adjacent bins that no strong line touches.
std::vector<Group> GroupsOf(const CrossSpectrum& spectrum, const std::vector<char>& keep, int count,
                            int first, int last) {
  std::vector<Group> groups;
  for (int start = first; start + count <= last;) {
    Group group;
    group.start = start;
    int blocked = -1;
    for (int k = start; k < start + count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (!keep[i]) blocked = k;
      group.pp += spectrum.pp[i];
      group.qq += spectrum.qq[i];
      group.qp += spectrum.qp[i];
      group.moment += spectrum.qq[i] * k;
      group.second += spectrum.qq[i] * k * k;
    }
    start = blocked >= 0 ? blocked + 1 : start + count;
    if (blocked < 0 && group.pp > 0.0 && group.qq > 0.0) groups.push_back(group);
  }
  return groups;
}

// Whether p and q are coherent about a group, by its neighbours alone. If the group itself decided,
// it would be taken where chance made |H| large and left where chance made it small, and a fit to
// the groups taken would come out too large.
bool IsCoherentAbout(const std::vector<Group>& groups, std::size_t at, int count, double nu,
                     const TransferOptions& options) {
  constexpr int kReach = 4;  // groups on either side
  double sum = 0.0;
  int neighbours = 0;
  const auto ask = [&](std::size_t other) {
    if (std::abs(groups[other].start - groups[at].start) > (kReach + 1) * count) return;
    sum += groups[other].Raw();
    ++neighbours;
  };
  for (std::size_t k = 1; k <= kReach; ++k) {
    if (at >= k) ask(at - k);
    if (at + k < groups.size()) ask(at + k);
  }
  if (neighbours < 2) return false;
  const double mean = sum / neighbours;
  // Without coherence Raw() has the mean and the standard deviation 1 / nu.
  constexpr double kUnlikely = 3.1;  // of a normal variable: once in a thousand
  const double by_chance = (1.0 + kUnlikely / std::sqrt(neighbours)) / nu;
  return mean > by_chance && (nu * mean - 1.0) / (nu - 1.0) >= options.min_coherence;
}

// The part of p that is not coherent with q, averaged about a group. One group's own estimate has
// the few degrees of freedom of a point, and weights with such a scatter would make a fit to the
// points scatter more than their variance says.
double IncoherentPower(const std::vector<Group>& groups, std::size_t at, int count) {
  constexpr int kReach = 2;  // groups on either side
  double sum = 0.0;
  int taken = 0;
  const std::size_t first = at < kReach ? 0 : at - kReach;
  for (std::size_t k = first; k < std::min(at + kReach + 1, groups.size()); ++k) {
    if (std::abs(groups[k].start - groups[at].start) > (kReach + 1) * count) continue;
    sum += groups[k].pp * std::max(1.0 - groups[k].Raw(), 1e-9);
    ++taken;
  }
  return sum / taken;
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
  transfer.q_noise_psd = HeatReleaseNoise(spectrum, keep);
  if (nu < 2.0) return transfer;

  const int first =
      std::max(static_cast<int>(std::ceil(options.min_frequency_hz / spectrum.bin_hz)), 3);
  const int last =
      std::min(static_cast<int>(top / spectrum.bin_hz), static_cast<int>(spectrum.pp.size()) - 1);
  const std::vector<Group> groups = GroupsOf(spectrum, keep, count, first, last);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (!IsCoherentAbout(groups, g, count, nu, options)) continue;
    const Group& group = groups[g];
    const double noise = std::min(0.5 * count * transfer.q_noise_psd, 0.5 * group.qq);
    const double power = group.qq - noise;
    const std::complex<double> h = group.qp / power;
    TransferPoint point;
    const double center = group.moment / group.qq;
    point.frequency_hz = center * spectrum.bin_hz;
    point.spread_hz =
        std::sqrt(group.second / group.qq - center * center + kBlackmanHarrisVarianceBins2) *
        spectrum.bin_hz;
    point.re = h.real();
    point.im = h.imag();
    const double raw = group.Raw();
    point.coherence = std::clamp((nu * raw - 1.0) / (nu - 1.0), 0.0, 1.0 - 1e-9);
    point.degrees_of_freedom = nu;
    point.q_noise_bias = noise / power;
    point.weight = std::norm(h) * power;
    // The variance is that of the part of p that is not coherent with q, which is independent of H.
    // |H|^2 (1 - c) / c instead would be small where chance made H large, and weigh such points
    // more.
    const double left = IncoherentPower(groups, g, count);
    const double scatter = left * group.qq / (2.0 * (nu - 1.0) * power * power);
    point.variance_re = scatter;
    point.variance_im = scatter;
    transfer.points.push_back(point);
  }
  return transfer;
}

}  // namespace howl
