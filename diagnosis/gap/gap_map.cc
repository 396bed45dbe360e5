#include "diagnosis/gap/gap_map.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "diagnosis/gap/gap.h"

namespace howl {
namespace {

constexpr int kBands = 16;
constexpr double kDiscoveryRate = 0.05;

struct Band {
  BinRange bins;
  double low_hz = 0.0;
  double high_hz = 0.0;
};

std::vector<Band> Bands(const CutRecord& record, Eigen::Index count) {
  std::vector<Band> bands;
  const double low = std::max(record.frequency(0), record.bin_hz);
  const double high = record.frequency(count - 1) + record.bin_hz;
  Eigen::Index next = 0;
  for (int k = 0; k < kBands; ++k) {
    Band band;
    band.low_hz = low * std::pow(high / low, static_cast<double>(k) / kBands);
    band.high_hz = low * std::pow(high / low, static_cast<double>(k + 1) / kBands);
    band.bins.first = next;
    while (next < count && record.frequency(next) < band.high_hz) ++next;
    band.bins.last = k + 1 == kBands ? count : next;
    if (band.bins.last > band.bins.first) bands.push_back(band);
  }
  return bands;
}

double Root(double excess) {
  return std::isnan(excess) ? excess : std::sqrt(std::max(0.0, excess));
}

double IndependentBins(const CutRecord& record, const BinRange& bins, bool flame) {
  double sum = 0.0;
  double squares = 0.0;
  for (Eigen::Index k = bins.first; k < bins.last; ++k) {
    if (record.masked[static_cast<std::size_t>(k)]) continue;
    const double share = flame ? record.flame_share[k] : 1.0;
    sum += share;
    squares += share * share;
  }
  return squares > 0.0 ? sum * sum / squares / kBinCorrelation : 0.0;
}

// The probability that noise alone has as large a mean of |E|^2 / V, less one.
double NoisePValue(double excess, double bins) {
  if (std::isnan(excess) || bins <= 0.0) return 1.0;
  return boost::math::gamma_q(bins, bins * std::max(0.0, 1.0 + excess));
}

// Benjamini and Hochberg: the largest p-value that is no more than its rank's share of the level.
double DiscoveryThreshold(std::vector<double> p_values) {
  std::sort(p_values.begin(), p_values.end());
  const double count = static_cast<double>(p_values.size());
  double threshold = -1.0;
  for (std::size_t i = 0; i < p_values.size(); ++i) {
    if (p_values[i] <= kDiscoveryRate * static_cast<double>(i + 1) / count) {
      threshold = p_values[i];
    }
  }
  return threshold;
}

}  // namespace

std::vector<GapCell> GapMap(const std::vector<CutRecord>& records, const GapSide& before,
                            const GapSide& after, const std::vector<Eigen::VectorXd>& flame_noise) {
  std::vector<GapCell> cells;
  std::vector<double> before_p;
  std::vector<double> after_p;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const CutRecord& record = records[e];
    for (const bool flame : {false, true}) {
      const Eigen::VectorXd& variance = flame ? flame_noise[e] : record.sensor_noise;
      const auto residual = [&](const ExperimentFit& fit) -> const Eigen::VectorXcd& {
        return flame ? fit.flame_residual : fit.acoustic_residual;
      };
      for (const Band& band : Bands(record, flame ? record.flame_count : record.acoustic_count)) {
        const auto excess = [&](const GapSide& side) {
          if (!side.residuals) return std::numeric_limits<double>::quiet_NaN();
          return MeanExcess(record, band.bins, residual((*side.residuals)[e]), variance,
                            flame ? record.flame_share : Eigen::VectorXd(), side.without_masked);
        };
        const double was = excess(before);
        const double is = excess(after);
        const double bins = IndependentBins(record, band.bins, flame);
        cells.push_back(
            {flame ? "q" : "p", record.name, band.low_hz, band.high_hz, Root(was), Root(is)});
        before_p.push_back(NoisePValue(was, bins));
        after_p.push_back(NoisePValue(is, bins));
      }
    }
  }
  for (const auto& [p_values, found] :
       {std::pair{&before_p, &GapCell::before_found}, std::pair{&after_p, &GapCell::after_found}}) {
    const double least = DiscoveryThreshold(*p_values);
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i].*found = (*p_values)[i] <= least;
  }
  return cells;
}

}  // namespace howl
