#include "diagnosis/gap/gap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/noise/noise_fit.h"

namespace howl {
namespace {

double Gap(const GapParts& parts, std::size_t without) {
  double sum = 0.0;
  double count = 0.0;
  for (const std::vector<double>* values : {&parts.acoustic, &parts.flame}) {
    for (std::size_t e = 0; e < values->size(); ++e) {
      if (e == without) continue;
      sum += std::max(0.0, (*values)[e]);
      count += 1.0;
    }
  }
  return std::sqrt(sum / std::max(count, 1.0));
}

}  // namespace

double MeanExcess(const CutRecord& record, const BinRange& bins, const Eigen::VectorXcd& residual,
                  const Eigen::VectorXd& variance, const Eigen::VectorXd& share,
                  bool without_masked) {
  double sum = 0.0;
  double count = 0.0;
  for (Eigen::Index k = bins.first; k < std::min(bins.last, residual.size()); ++k) {
    if (without_masked && record.masked[static_cast<std::size_t>(k)]) continue;
    const double counts = share.size() > 0 ? share[k] : 1.0;
    sum += counts * std::norm(residual[k]) / variance[k];
    count += counts;
  }
  return count > 0.0 ? sum / count - 1.0 : std::numeric_limits<double>::quiet_NaN();
}

GapParts ComputeGapParts(const std::vector<CutRecord>& records,
                         const std::vector<ExperimentFit>& residuals,
                         const std::vector<Eigen::VectorXd>& flame_noise, bool without_masked) {
  GapParts parts;
  for (std::size_t e = 0; e < records.size(); ++e) {
    const CutRecord& record = records[e];
    parts.acoustic.push_back(MeanExcess(record, {0, record.acoustic_count},
                                        residuals[e].acoustic_residual, record.sensor_noise, {},
                                        without_masked));
    parts.flame.push_back(MeanExcess(record, {0, record.flame_count}, residuals[e].flame_residual,
                                     flame_noise[e], record.flame_share, without_masked));
  }
  return parts;
}

double Gap(const GapParts& parts) { return Gap(parts, parts.acoustic.size()); }

double GapFloor(const std::vector<CutRecord>& records) {
  // V is fitted to the same record, so that only the part of the mean's scatter is left that V's
  // own freedom absorbs: three terms for each block of 48 bins in cut A, and a few for all in cut
  // B. The mean positive part of a normal deviate is 0.4 standard deviations.
  double sum = 0.0;
  for (const CutRecord& record : records) {
    const double a = static_cast<double>(record.acoustic_count) / kBinCorrelation;
    const double b = record.flame_share.sum() / kBinCorrelation;
    sum += 0.4 * std::sqrt(3.0 * kBinCorrelation / 48.0 / a);
    sum += 0.4 * std::sqrt(static_cast<double>(kFlameNoiseTerms)) / b;
  }
  return std::sqrt(0.5 * sum / static_cast<double>(records.size()));
}

ConfidenceInterval ShrinkageInterval(const GapParts& before, const GapParts& after) {
  const std::size_t n = before.acoustic.size();
  const auto shrinkage = [&](std::size_t without) {
    return 1.0 - Gap(after, without) / std::max(Gap(before, without), 1e-12);
  };
  const double all = shrinkage(n);
  if (n < 2) return {all, all};
  double mean = 0.0;
  std::vector<double> left_out;
  for (std::size_t e = 0; e < n; ++e) {
    left_out.push_back(shrinkage(e));
    mean += left_out.back() / static_cast<double>(n);
  }
  double squares = 0.0;
  for (const double value : left_out) squares += (value - mean) * (value - mean);
  const double error = std::sqrt(squares * static_cast<double>(n - 1) / static_cast<double>(n));
  return {all - 2.0 * error, std::min(1.0, all + 2.0 * error)};
}

}  // namespace howl
