#include "diagnosis/loop_budget/trials/law_of_trial.h"

#include <Eigen/Cholesky>
#include <limits>
#include <set>
#include <string>

#include "diagnosis/loop_budget/forms/parameter_labels.h"
#include "diagnosis/loop_budget/trials/loop_trial.h"

namespace howl {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Where the parameters stand that `from` has not.
std::vector<Eigen::Index> NewIn(const LoopForm& with, const LoopForm& from, Eigen::Index terms,
                                Eigen::Index terms_before) {
  const std::vector<std::string> known = ParameterLabels(from.structure, terms_before);
  const std::set<std::string> old(known.begin(), known.end());
  const std::vector<std::string> all = ParameterLabels(with.structure, terms);
  std::vector<Eigen::Index> out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!old.contains(all[i])) out.push_back(static_cast<Eigen::Index>(i));
  }
  return out;
}

// Of these parameters that of `other`, which may be Student's.
PointPrior Exchanged(PointPrior prior, const PointPrior& other,
                     const std::vector<Eigen::Index>& parameters) {
  if (prior.degrees.size() == 0) {
    prior.degrees = Eigen::VectorXd::Constant(prior.mean.size(), kInfinity);
    prior.widest = prior.deviation;
  }
  for (const Eigen::Index i : parameters) {
    prior.mean[i] = other.mean[i];
    prior.deviation[i] = other.deviation[i];
    if (other.degrees.size() > 0) prior.degrees[i] = other.degrees[i];
    prior.widest[i] = (other.widest.size() > 0 ? other.widest : other.deviation)[i];
  }
  return prior;
}

Eigen::VectorXd SlopeOf(const PointPrior& prior, const Eigen::VectorXd& at) {
  return prior.Slope(at).cwiseQuotient(prior.deviation);
}

Eigen::VectorXd PrecisionOf(const PointPrior& prior, const Eigen::VectorXd& at) {
  return prior.Precision(at).cwiseQuotient(prior.deviation.cwiseAbs2());
}

double HalfLogDeterminant(const Eigen::LLT<Eigen::MatrixXd>& root) {
  return Eigen::MatrixXd(root.matrixL()).diagonal().array().log().sum();
}

// Laplace's evidence under `to` over that under `from`, at the maximum of which `fit` stands.
double Gained(const PointFit& fit, const PointPrior& from, const PointPrior& to) {
  const Eigen::VectorXd& at = fit.parameters;
  const Eigen::VectorXd precision = PrecisionOf(to, at) - PrecisionOf(from, at);
  const Eigen::LLT<Eigen::MatrixXd> before(fit.information);
  const Eigen::LLT<Eigen::MatrixXd> after(fit.information +
                                          Eigen::MatrixXd(precision.asDiagonal()));
  if (before.info() != Eigen::Success || after.info() != Eigen::Success) return 0.0;
  const Eigen::VectorXd uphill = SlopeOf(to, at) - SlopeOf(from, at);
  return to.LogDensity(at) - from.LogDensity(at) + 0.5 * uphill.dot(after.solve(uphill)) -
         HalfLogDeterminant(after) + HalfLogDeterminant(before);
}

}  // namespace

double GainedByLaw(const LoopRecords& records, const LoopFit& from, const LoopForm& with,
                   const std::vector<PointFit>& fits, int threads) {
  RecordsFit fit;
  fit.structure = with.structure;
  fit.reference = from.fit.reference;
  fit.z = from.fit.z;
  fit.points = fits;
  std::vector<OperatingPoint> points;
  for (std::size_t e = 0; e < fits.size(); ++e) {
    points.push_back({0.0, records.WholeAlone(with, e)});
    fit.prior.push_back(PriorOfTrial(records, from, with, e, points[e].record));
  }
  const std::vector<PointPrior> of_others = PriorsOfOthers(points, fit, threads);
  double out = 0.0;
  for (std::size_t e = 0; e < fits.size(); ++e) {
    const std::vector<Eigen::Index> parameters =
        NewIn(with, from.model, records.FlameTerms(with.flame_input, e),
              records.FlameTerms(from.model.flame_input, e));
    out += Gained(fits[e], fit.prior[e], Exchanged(fit.prior[e], of_others[e], parameters));
  }
  return out;
}

}  // namespace howl
