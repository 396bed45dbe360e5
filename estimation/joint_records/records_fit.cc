#include "estimation/joint_records/records_fit.h"

#include <glog/logging.h>

#include <utility>

#include "estimation/joint_records/records_fitter.h"
#include "estimation/parallel.h"
#include "estimation/record_fit/delay_maxima.h"
#include "estimation/record_fit/fit_under_prior.h"
#include "estimation/record_fit/mode_maxima.h"

namespace howl {
namespace {

constexpr int kRounds = 12;
// In which each point looks at other delays and places of modes under the law.
constexpr int kRoundsOfSearch = 2;

RecordsFit FitWith(const RecordsFitter& fitter, const std::vector<OperatingPoint>& points,
                   const PointStructure& structure, const StartRows& starts,
                   const RecordsFitOptions& options) {
  RecordsFit out;
  out.structure = structure;
  out.reference = ReferenceOf(points);
  out.z = Standardised(points);
  out.points = fitter.Best(starts, options);
  for (std::size_t e = 0; e < points.size(); ++e) out.prior.push_back(fitter.base(e));
  const bool alone = points.size() == 1;
  for (int round = 0; round < kRounds; ++round) {
    const ParameterLaw law = fitter.Law(fitter.Evidence(out.points, out.prior));
    const bool converged = round >= kRoundsOfSearch && fitter.Stands(out.law, law);
    out.law = law;
    RunUnits(points.size(), options.threads, [&](std::size_t e) {
      out.prior[e] = alone ? fitter.PriorOfErrors(law) : fitter.Prior(e, law.PriorAt(out.z[e]));
      const bool early = round < kRoundsOfSearch;
      out.points[e] = KeptFit(
          options.units, UnitKey(options, "round", static_cast<std::size_t>(round), e), [&] {
            PointFit fit = FitUnder(points[e].record, structure, out.prior[e],
                                    out.points[e].parameters, !alone && early);
            if (!early) return fit;
            fit = BestByDelay(points[e].record, structure, out.prior[e], std::move(fit));
            return BestByModes(points[e].record, structure, out.prior[e], std::move(fit));
          });
    });
    VLOG(1) << "round " << round << " of the law of the parameters";
    if (converged) break;
  }
  return out;
}

}  // namespace

std::vector<PointPrior> PriorsOfOthers(const std::vector<OperatingPoint>& points,
                                       const RecordsFit& fit, int threads) {
  const RecordsFitter fitter(points, fit.structure, fit.reference, fit.z, threads);
  const std::vector<ParameterEvidence> evidence = fitter.Evidence(fit.points, fit.prior);
  std::vector<PointPrior> out(points.size());
  RunUnits(points.size(), threads, [&](std::size_t e) {
    std::vector<ParameterEvidence> others = evidence;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(e));
    out[e] = fitter.Prior(e, fitter.Law(others).PredictionAt(fit.z[e]));
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
  return FitWith(fitter, points, structure, starts, options);
}

StartRows StartsInRicher(const std::vector<OperatingPoint>& points, const RecordsFit& poorer,
                         const PointStructure& structure) {
  const RecordsFitter fitter(points, structure, poorer.reference, poorer.z, 1);
  return fitter.FromPoorer(poorer);
}

RecordsFit FitRecordsFrom(const std::vector<OperatingPoint>& points,
                          const PointStructure& structure, const StartRows& starts,
                          const RecordsFitOptions& options) {
  CHECK(!points.empty());
  const RecordsFitter fitter(points, structure, ReferenceOf(points), Standardised(points),
                             options.threads);
  return FitWith(fitter, points, structure, starts, options);
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
