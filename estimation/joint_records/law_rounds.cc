#include "estimation/joint_records/law_rounds.h"

#include <glog/logging.h>

#include <numeric>
#include <utility>

#include "estimation/parallel.h"
#include "estimation/record_fit/fit_under_prior.h"
#include "estimation/record_fit/other_maxima.h"

namespace howl {
namespace {

constexpr int kMostSearches = 4;
// Rounds after which the law, if it does not stand, goes to and fro by what the records do not
// tell: other maxima are then looked for all the same.
constexpr int kPatience = 8;
// Nats of all points together, below which a search for other maxima is not repeated: odds of 20
// to 1.
constexpr double kFound = 3.0;

// The law's steps from round to round. Law and fits may push each other to and fro: where a
// parameter turns back it goes but half as far as before, and then by and by further again (the
// adaptive gains of delta-bar-delta, Jacobs 1988).
class LawSteps {
 public:
  ParameterLaw Toward(const ParameterLaw& from, const ParameterLaw& to) {
    const Eigen::MatrixX2d move = from.MoveTo(to);
    if (share_.size() == 0) share_ = Eigen::VectorXd::Ones(move.rows());
    if (last_.size() > 0) {
      const Eigen::ArrayXd along = move.cwiseProduct(last_).rowwise().sum();
      share_ =
          (along < 0.0)
              .select((kShorter * share_).cwiseMax(kLeastShare), (kLonger * share_).cwiseMin(1.0));
    }
    last_ = move;
    return from.Toward(to, share_);
  }

 private:
  static constexpr double kShorter = 0.5;
  static constexpr double kLonger = 1.1;
  static constexpr double kLeastShare = 0.05;

  Eigen::VectorXd share_;
  Eigen::MatrixX2d last_;
};

}  // namespace

RecordsFit FitUnderLaw(const RecordsFitter& fitter, const std::vector<OperatingPoint>& points,
                       const StartRows& starts, const RecordsFitOptions& options) {
  RecordsFit out;
  out.structure = fitter.structure();
  out.reference = ReferenceOf(points);
  out.z = Standardised(points);
  out.points = fitter.Best(starts, options);
  for (std::size_t e = 0; e < points.size(); ++e) out.prior.push_back(fitter.base(e));
  const bool alone = points.size() == 1;
  int searches = 0;
  int since_search = 0;
  LawSteps steps;
  for (int round = 0;; ++round) {
    const std::vector<ParameterEvidence> evidence = fitter.Evidence(out.points, out.prior);
    ParameterLaw law = fitter.Law(evidence);
    const bool stands = round > 0 && fitter.Stands(out.law, law);
    if (round > 0) law = steps.Toward(out.law, law);
    out.law = law;
    const bool search = stands || since_search == kPatience;
    since_search = search ? 0 : since_search + 1;
    std::vector<double> gain(points.size(), 0.0);
    RunUnits(points.size(), options.threads, [&](std::size_t e) {
      const RecordSpectra& record = points[e].record;
      PointPrior& prior = out.prior[e];
      const PointPrior before = prior;
      PointFit& fit = out.points[e];
      prior = alone    ? fitter.PriorOfErrors(law)
              : search ? fitter.Prior(e, fitter.LawOfOthers(evidence, e).PredictionAt(out.z[e]))
                       : fitter.Prior(e, law.PriorAt(out.z[e]));
      const auto r = static_cast<std::size_t>(round);
      fit = KeptFit(options.units, UnitKey(options, "round", r, e), [&] {
        return search ? FitUnder(record, out.structure, prior, fit.parameters, false)
                      : FitAgain(record, out.structure, before, prior, fit);
      });
      if (!search) return;
      if (options.other_maxima) {
        PointFit other = KeptFit(options.units, UnitKey(options, "search", r, e), [&] {
          return BestOfOtherMaxima(record, out.structure, prior,
                                   FitUnder(record, out.structure, prior, fit.parameters, !alone));
        });
        if (other.log_posterior > fit.log_posterior) {
          gain[e] = other.log_posterior - fit.log_posterior;
          fit = std::move(other);
        }
      }
      prior = prior.NormalAt(fit.parameters);
    });
    if (!search) continue;
    const double found = std::accumulate(gain.begin(), gain.end(), 0.0);
    if (found >= kFound) steps = LawSteps();
    VLOG(1) << "round " << round << " of the law of the parameters: " << found << " nats found";
    if (++searches == kMostSearches || found < kFound) return out;
  }
}

}  // namespace howl
