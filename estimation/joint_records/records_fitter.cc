#include "estimation/joint_records/records_fitter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "estimation/joint_records/record_evidence.h"
#include "estimation/parallel.h"
#include "estimation/record_fit/starts/point_starts.h"
#include "estimation/unit_seed.h"

namespace howl {
namespace {

constexpr double kRounding = 1e-12;
constexpr double kErrorsConverged = 0.05;  // of ln s
// Of a parameter's spread, the largest move of the law's mean: as much as a fit leaves open that
// has converged to a thousandth of a nat.
constexpr double kConverged = 0.05;

double GeometricMean(const std::vector<OperatingPoint>& points, auto value) {
  double sum = 0.0;
  for (const OperatingPoint& point : points) sum += std::log(value(point.record));
  return std::exp(sum / static_cast<double>(points.size()));
}

}  // namespace

ReferenceUnits ReferenceOf(const std::vector<OperatingPoint>& points) {
  return {GeometricMean(points, [](const RecordSpectra& r) { return r.scale.cycle_hz; }),
          GeometricMean(points, [](const RecordSpectra& r) { return r.scale.pressure; }),
          GeometricMean(points, [](const RecordSpectra& r) { return r.scale.heat_release; }),
          GeometricMean(points, [](const RecordSpectra& r) { return r.sampling_hz; })};
}

std::vector<double> Standardised(const std::vector<OperatingPoint>& points) {
  const auto count = static_cast<double>(points.size());
  double mean = 0.0;
  for (const OperatingPoint& point : points) mean += point.operating_parameter / count;
  double square = 0.0;
  for (const OperatingPoint& point : points) {
    square += std::pow(point.operating_parameter - mean, 2) / count;
  }
  std::vector<double> out;
  for (const OperatingPoint& point : points) {
    out.push_back(square > 0.0 ? (point.operating_parameter - mean) / std::sqrt(square) : 0.0);
  }
  return out;
}

std::string UnitKey(const RecordsFitOptions& options, const char* what, std::size_t a,
                    std::size_t b) {
  return options.key + what + "/" + std::to_string(a) + "/" + std::to_string(b);
}

bool RecordsFitter::Stands(const ParameterLaw& before, const ParameterLaw& after) const {
  const auto stands = [&](const ErrorGroup& group) {
    return std::abs(std::log(after.spread[group.first] / before.spread[group.first])) <
           kErrorsConverged;
  };
  if (!std::ranges::all_of(units_[0].errors(), stands)) return false;
  const Eigen::ArrayXd moved = (after.mean - before.mean).array().abs();
  return size() == 1 || (moved < kConverged * after.spread.array() + kRounding).all();
}
PointPrior RecordsFitter::PriorOfErrors(const ParameterLaw& law) const {
  PointPrior common = units_[0].ToCommon(base_[0]);
  for (const ErrorGroup& group : units_[0].errors()) {
    common.deviation.segment(group.first, group.count) =
        law.spread.segment(group.first, group.count);
  }
  return Prior(0, common);
}

PointPrior RecordsFitter::MeanBase() const {
  const Eigen::Index size = units_[0].size();
  PointPrior out{Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size), {}, {}};
  const auto count = static_cast<double>(this->size());
  for (std::size_t e = 0; e < this->size(); ++e) {
    const PointPrior common = units_[e].ToCommon(base_[e]);
    out.mean += common.mean / count;
    out.deviation += common.deviation.cwiseAbs2() / count;
  }
  out.deviation = out.deviation.cwiseSqrt();
  return out;
}

std::vector<PointFit> RecordsFitter::Alone(const RecordsFitOptions& options) const {
  std::vector<PointFit> out(size());
  RunUnits(size(), threads_, [&](std::size_t e) {
    const RecordSpectra& record = points_[e].record;
    out[e] = KeptFit(options.units, UnitKey(options, "alone", 0, e), [&] {
      return FitPoint(record, structure_, base_[e],
                      StartsOf(record, structure_, base_[e], options.starts,
                               UnitSeed(options.seed, "starts of a point", e)));
    });
  });
  return out;
}

std::vector<ParameterEvidence> RecordsFitter::Evidence(
    const std::vector<PointFit>& fits, const std::vector<PointPrior>& priors) const {
  std::vector<ParameterEvidence> out;
  for (std::size_t e = 0; e < size(); ++e) {
    out.push_back(EvidenceOf(fits[e], priors[e], units_[e], z_[e]));
  }
  return out;
}

}  // namespace howl
