#include "estimation/record_fit/delay_maxima.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "estimation/record_fit/other_starts.h"
#include "estimation/record_fit/point_posterior.h"
#include "estimation/record_fit/spectra/middle_part.h"
#include "estimation/record_fit/starts/path_starts.h"
#include "estimation/record_fit/starts/raise_noise.h"

namespace howl {
namespace {

constexpr std::size_t kDelays = 8;
constexpr double kSame = 0.25;  // radians of the cycle: a quarter of a period at the band's end
constexpr int kMostDelayScans = 3;
constexpr std::size_t kMostFollowed = 2;
// That starts are made of beside those of other points: with three of them the rigs on which they
// were compared came to the same maxima.
constexpr std::size_t kDelaysOfCut = 1;

// With the flame of that delay, as far as the prior reaches, and as much noise as it leaves; all
// else of `parameters`.
Eigen::VectorXd AtDelay(double tau, const PathStarts& paths, const RecordSpectra& record,
                        const PointStructure& structure, const PointPrior& prior,
                        const Eigen::VectorXd& parameters) {
  const Eigen::Index flame = record.flame.cols();
  LoopPoint point = ToPoint(structure, flame, parameters);
  point.path.tau = tau;
  point.flame = paths.Flame(point.path);
  point = ToPoint(structure, flame, prior.Within(ToParameters(structure, point)));
  RaiseNoise(record, structure, &point);
  return ToParameters(structure, point);
}

// The maxima of different delays, that of `parameters` with them, the most likely first. Each delay
// tried goes to the maximum of the record's middle (middle_part.h), and `followed` of them, the
// most likely there, to that of the record. Of 187 scans on three measured records and on twelve of
// rigs with a low-pass or a second path that the loop did not have, 34 could find a better maximum
// than the known one; two that were followed found 29 of these. Flames beyond what the prior calls
// possible stay here: begun with those of AtDelay, one of twelve rigs missed a maximum that was 70
// nats better.
std::vector<PointFit> FitsByDelay(const RecordSpectra& record, const PointStructure& structure,
                                  const PointPrior& prior, const Eigen::VectorXd& parameters,
                                  std::size_t followed) {
  const auto tau_of = [&](const PointFit& fit) {
    return std::exp(fit.parameters[structure.Delay()]);
  };
  std::vector<PointFit> begun;
  const PathStarts paths(record);
  for (const double tau : paths.Delays(kDelays)) {
    Eigen::VectorXd start = parameters;
    start[structure.Delay()] = std::log(tau);
    const FlamePath path = ToPoint(structure, record.flame.cols(), start).path;
    start.segment(structure.Flame(), record.flame.cols()) = paths.Flame(path);
    begun.push_back(FitPoint(MiddleOf(record), structure, prior,
                             BesideMiddle(record, structure, start), kToCompare));
  }
  std::ranges::stable_sort(begun, std::ranges::greater(), &PointFit::log_posterior);
  begun.resize(std::min(begun.size(), followed));
  std::vector<PointFit> all = {FitPoint(record, structure, prior, parameters, kToCompare)};
  for (const PointFit& fit : begun) {
    all.push_back(FitPoint(record, structure, prior,
                           BesideMiddle(record, structure, fit.parameters), kToCompare));
  }
  std::ranges::stable_sort(all, std::ranges::greater(), &PointFit::log_posterior);
  std::vector<PointFit> out;
  for (const PointFit& fit : all) {
    const auto same = [&](const PointFit& other) {
      return std::abs(tau_of(other) - tau_of(fit)) < kSame;
    };
    if (std::ranges::none_of(out, same)) out.push_back(fit);
  }
  return out;
}

}  // namespace

std::vector<Eigen::VectorXd> OtherDelayStarts(const RecordSpectra& record,
                                              const PointStructure& structure,
                                              const PointPrior& prior,
                                              const Eigen::VectorXd& parameters,
                                              const std::vector<Eigen::VectorXd>& of_other_points) {
  const PathStarts paths(record);
  std::vector<double> tried = {std::exp(parameters[structure.Delay()])};
  std::vector<Eigen::VectorXd> out;
  const auto add = [&](double tau, const Eigen::VectorXd& loop) {
    if (std::ranges::any_of(tried, [&](double other) { return std::abs(other - tau) < kSame; })) {
      return;
    }
    tried.push_back(tau);
    out.push_back(AtDelay(tau, paths, record, structure, prior, loop));
  };
  for (const Eigen::VectorXd& other : of_other_points) {
    add(std::exp(other[structure.Delay()]), other);
  }
  for (const double tau : paths.Delays(kDelaysOfCut)) add(tau, parameters);
  return out;
}

PointFit BestByDelay(const RecordSpectra& record, const PointStructure& structure,
                     const PointPrior& prior, PointFit fit) {
  for (int scan = 0; scan < kMostDelayScans; ++scan) {
    const PointFit next = FitsByDelay(record, structure, prior, fit.parameters, kMostFollowed)[0];
    if (next.log_posterior - fit.log_posterior < kWorthAnother) break;
    fit = FitPoint(record, structure, prior, next.parameters, kToTheMaximum);
  }
  return fit;
}

std::vector<DelayMaximum> OtherDelayMaxima(const RecordSpectra& record,
                                           const PointStructure& structure, const PointPrior& prior,
                                           const Eigen::VectorXd& parameters) {
  const double here = PointPosterior(record, structure, prior).Value(parameters);
  const double known = std::exp(parameters[structure.Delay()]);
  std::vector<DelayMaximum> out;
  for (const PointFit& fit : FitsByDelay(record, structure, prior, parameters, kDelays)) {
    const double tau = std::exp(fit.parameters[structure.Delay()]);
    if (std::abs(tau - known) >= kSame) out.push_back({tau, here - fit.log_posterior});
  }
  return out;
}

}  // namespace howl
