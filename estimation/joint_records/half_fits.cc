#include "estimation/joint_records/half_fits.h"

#include <numeric>
#include <string>
#include <utility>

#include "estimation/analysis/spectra/half_of_record.h"
#include "estimation/joint_records/records_fitter.h"
#include "estimation/parallel.h"
#include "estimation/record_fit/fit_under_prior.h"
#include "estimation/record_fit/other_maxima.h"

namespace howl {
namespace {

// Nats of all points together: odds of 20 to 1.
constexpr double kGainFound = 3.0;
// On 2, 4 and 13 points of a measured combustor none went on for more than two.
constexpr int kMostRounds = 4;

double SumOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

std::vector<PointPrior> PriorsOf(const std::vector<OperatingPoint>& points, const RecordsFit& fit,
                                 int threads) {
  return points.size() == 1 ? fit.prior : PriorsOfOthers(points, fit, threads);
}

RecordSpectra SpectraOfHalf(const LoopRecord& record, const OperatingPoint& whole, bool second) {
  return MakeRecordSpectra(HalfOf(record.record, second), whole.record);
}

}  // namespace

std::vector<HalfFits> FitHalves(const std::vector<LoopRecord>& records,
                                const std::vector<OperatingPoint>& points, const RecordsFit& fit,
                                const RecordsFitOptions& options) {
  const bool alone = points.size() == 1;
  const std::vector<PointPrior> prior = PriorsOf(points, fit, options.threads);
  const std::vector<Eigen::VectorXd> noise = PressureNoiseOf(points, fit, options.threads);
  std::vector<HalfFits> out(points.size());
  RunUnits(2 * points.size(), options.threads, [&](std::size_t i) {
    const std::size_t e = i / 2;
    const bool second = i % 2 == 1;
    out[e][i % 2] = KeptFit(options.units, UnitKey(options, "half", i % 2, e), [&] {
      RecordSpectra half = SpectraOfHalf(records[e], points[e], second);
      const Eigen::Index samples = half.Samples();
      half = DrivenWithout(std::move(half),
                           second ? noise[e].tail(samples).eval() : noise[e].head(samples).eval());
      const Eigen::VectorXd& at = alone ? fit.points[e].parameters : prior[e].mean;
      return BestOfOtherMaxima(half, fit.structure, prior[e],
                               FitUnder(half, fit.structure, prior[e], at, !alone));
    });
  });
  return out;
}

std::vector<HalfLoops> LoopsOfHalves(const std::vector<LoopRecord>& records,
                                     const std::vector<OperatingPoint>& points,
                                     const PointStructure& structure,
                                     const std::vector<HalfFits>& halves) {
  std::vector<HalfLoops> out(points.size());
  for (std::size_t e = 0; e < points.size(); ++e) {
    for (std::size_t half = 0; half < 2; ++half) {
      out[e][half] =
          FittedLoopOf(SpectraOfHalf(records[e], points[e], half == 1), structure, halves[e][half]);
    }
  }
  return out;
}

std::optional<RecordsFit> BetterByHalves(const std::vector<OperatingPoint>& points,
                                         const RecordsFit& fit, const std::vector<HalfFits>& halves,
                                         const RecordsFitOptions& options) {
  const std::vector<PointPrior> prior = PriorsOf(points, fit, options.threads);
  StartRows starts(1, std::vector<Eigen::VectorXd>(points.size()));
  std::vector<double> gain(points.size());
  RunUnits(points.size(), options.threads, [&](std::size_t e) {
    const auto from = [&](std::size_t which, const Eigen::VectorXd& at) {
      return KeptFit(options.units, UnitKey(options, "whole", which, e), [&] {
        return FitPoint(points[e].record, fit.structure, prior[e], at, kToTheMaximum);
      });
    };
    PointFit best = from(0, fit.points[e].parameters);
    const double before = best.log_posterior;
    for (std::size_t half = 0; half < 2; ++half) {
      PointFit other = from(1 + half, halves[e][half].parameters);
      if (other.log_posterior > best.log_posterior) best = std::move(other);
    }
    gain[e] = best.log_posterior - before;
    starts[0][e] = std::move(best.parameters);
  });
  if (SumOf(gain) < kGainFound) return std::nullopt;
  RecordsFitOptions again = options;
  again.other_maxima = false;
  return FitRecordsFrom(points, fit.structure, starts, again);
}

FitWithHalves GoOnFromHalves(const std::vector<LoopRecord>& records,
                             const std::vector<OperatingPoint>& points, RecordsFit fit,
                             const RecordsFitOptions& options) {
  FitWithHalves out;
  out.fit = std::move(fit);
  out.log_density = LeftOutDensities(points, out.fit, options);
  for (int round = 0;; ++round) {
    RecordsFitOptions of_round = options;
    of_round.key += "halves/" + std::to_string(round) + "/";
    out.halves = FitHalves(records, points, out.fit, of_round);
    if (round == kMostRounds) return out;
    std::optional<RecordsFit> next = BetterByHalves(points, out.fit, out.halves, of_round);
    if (!next) return out;
    std::vector<double> log_density = LeftOutDensities(points, *next, of_round);
    if (!(SumOf(log_density) > SumOf(out.log_density))) return out;
    out.fit = std::move(*next);
    out.log_density = std::move(log_density);
  }
}

}  // namespace howl
