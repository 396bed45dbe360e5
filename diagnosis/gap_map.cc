#include "diagnosis/gap_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/gap.h"

namespace howl {
namespace {

constexpr int kBands = 16;

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

}  // namespace

std::vector<GapCell> GapMap(const std::vector<CutRecord>& records,
                            const std::vector<ExperimentFit>& before,
                            const std::vector<ExperimentFit>* after,
                            const std::vector<Eigen::VectorXd>& flame_noise, bool without_masked) {
  std::vector<GapCell> cells;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const CutRecord& record = records[e];
    for (const bool flame : {false, true}) {
      const Eigen::VectorXd& variance = flame ? flame_noise[e] : record.sensor_noise;
      const auto residual = [&](const ExperimentFit& fit) -> const Eigen::VectorXcd& {
        return flame ? fit.flame_residual : fit.acoustic_residual;
      };
      for (const Band& band : Bands(record, flame ? record.flame_count : record.acoustic_count)) {
        const auto gap = [&](const std::vector<ExperimentFit>& fits) {
          const double excess =
              MeanExcess(record, band.bins, residual(fits[e]), variance,
                         flame ? record.flame_share : Eigen::VectorXd(), without_masked);
          return std::isnan(excess) ? excess : std::sqrt(std::max(0.0, excess));
        };
        const double nothing = std::numeric_limits<double>::quiet_NaN();
        cells.push_back({flame ? "q" : "p", record.name, band.low_hz, band.high_hz, gap(before),
                         after != nullptr ? gap(*after) : nothing});
      }
    }
  }
  return cells;
}

}  // namespace howl
