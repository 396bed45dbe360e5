#include "estimation/joint_records/records_fit.h"

#include <glog/logging.h>

#include <utility>

#include "estimation/joint_records/law_rounds.h"
#include "estimation/joint_records/records_fitter.h"
#include "estimation/parallel.h"
#include "estimation/record_fit/fit_under_prior.h"
#include "estimation/record_fit/loop/pressure_noise.h"

namespace howl {
std::vector<PointPrior> PriorsOfOthers(const std::vector<OperatingPoint>& points,
                                       const RecordsFit& fit, int threads) {
  const RecordsFitter fitter(points, fit.structure, fit.reference, fit.z, threads);
  const std::vector<ParameterEvidence> evidence = fitter.Evidence(fit.points, fit.prior);
  std::vector<PointPrior> out(points.size());
  RunUnits(points.size(), threads, [&](std::size_t e) {
    out[e] = fitter.Prior(e, fitter.LawOfOthers(evidence, e).PredictionAt(fit.z[e]));
  });
  return out;
}

RecordsFit FitRecords(const std::vector<OperatingPoint>& points, const PointStructure& structure,
                      const RecordsFitOptions& options, const RecordsFit* poorer) {
  CHECK(!points.empty());
  const RecordsFitter fitter(points, structure, ReferenceOf(points), Standardised(points),
                             options.threads);
  StartRows starts = fitter.FromOneAnother(fitter.Alone(options));
  if (poorer != nullptr) {
    for (auto& row : fitter.FromPoorer(*poorer)) starts.push_back(std::move(row));
  }
  return FitUnderLaw(fitter, points, starts, options);
}

StartRows StartsInRicher(const std::vector<OperatingPoint>& points, const RecordsFit& poorer,
                         const PointStructure& structure, int threads) {
  const RecordsFitter fitter(points, structure, poorer.reference, poorer.z, threads);
  return fitter.FromPoorer(poorer);
}

RecordsFit FitRecordsFrom(const std::vector<OperatingPoint>& points,
                          const PointStructure& structure, const StartRows& starts,
                          const RecordsFitOptions& options) {
  CHECK(!points.empty());
  const RecordsFitter fitter(points, structure, ReferenceOf(points), Standardised(points),
                             options.threads);
  return FitUnderLaw(fitter, points, starts, options);
}

std::vector<Eigen::VectorXd> PressureNoiseOf(const std::vector<OperatingPoint>& points,
                                             const RecordsFit& fit, int threads) {
  std::vector<Eigen::VectorXd> out(points.size());
  RunUnits(points.size(), threads, [&](std::size_t e) {
    out[e] = PressureNoise(points[e].record, fit.structure, fit.points[e].parameters);
  });
  return out;
}

RecordsFit FitDriven(const RecordsFit& fit, const RecordsFitOptions& options,
                     std::vector<OperatingPoint>* points) {
  const std::vector<Eigen::VectorXd> noise = PressureNoiseOf(*points, fit, options.threads);
  StartRows starts(1);
  for (std::size_t e = 0; e < points->size(); ++e) {
    RecordSpectra& record = (*points)[e].record;
    record = DrivenWithout(std::move(record), noise[e]);
    starts[0].push_back(fit.points[e].parameters);
  }
  RecordsFitOptions next = options;
  next.key += "driven/";
  next.other_maxima = false;
  return FitRecordsFrom(*points, fit.structure, starts, next);
}

std::vector<double> LeftOutDensities(const std::vector<OperatingPoint>& points,
                                     const RecordsFit& fit, const RecordsFitOptions& options) {
  if (points.size() == 1) return {fit.points[0].log_evidence};
  const std::vector<PointPrior> prior = PriorsOfOthers(points, fit, options.threads);
  std::vector<double> out(points.size());
  RunUnits(points.size(), options.threads, [&](std::size_t e) {
    out[e] = KeptFit(options.units, UnitKey(options, "left_out", 0, e), [&] {
               return FitUnder(points[e].record, fit.structure, prior[e], fit.points[e].parameters,
                               true);
             }).log_evidence;
  });
  return out;
}

}  // namespace howl
