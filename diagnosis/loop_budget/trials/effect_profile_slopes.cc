// The slopes of the profile over a shared effect's values.
#include "diagnosis/loop_budget/trials/effect_profile.h"
#include "estimation/parallel.h"
#include "estimation/record_fit/point_posterior.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

// Of the range: ten times as long differences see the third derivative, a tenth as long ones the
// last digits of sums over thousands of bins.
constexpr double kDifference = 1e-5;

}  // namespace

EffectProfile::Slopes EffectProfile::SlopesOfPoint(const EffectPoint& point, std::size_t e,
                                                   Eigen::Index count) const {
  struct Beside {
    double value = 0.0;
    Eigen::VectorXd gradient;
  };
  const PointFit& fit = point.fits[e];
  const auto beside = [&](const Eigen::VectorXd& u, bool with_gradient) {
    const LoopForm form = FormAt(u);
    const RecordSpectra record = records_.WholeAlone(form, e);
    const PointPrior prior = PriorOfTrial(records_, from_, form, e, record);
    PointPosterior posterior(record, form.structure, prior);
    Beside out{posterior.Value(fit.parameters) + records_.LogJacobianOfWhole(form, e), {}};
    if (with_gradient) {
      out.gradient = posterior.Gradient(fit.parameters).cwiseQuotient(prior.deviation);
    }
    return out;
  };
  const Eigen::VectorXd steps = kDifference * span_;
  const double here = fit.log_posterior + records_.LogJacobianOfWhole(FormAt(point.u), e);
  Slopes out{Eigen::VectorXd(count), Eigen::MatrixXd(count, count), {}};
  Eigen::MatrixXd turns(fit.parameters.size(), count);
  Eigen::VectorXd uphill;
  std::vector<double> both(static_cast<std::size_t>(count));  // values on both sides
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::VectorXd step = steps[i] * Eigen::VectorXd::Unit(steps.size(), i);
    const Beside below = beside(point.u - step, true);
    const Beside above = beside(point.u + step, true);
    out.slope[i] = (above.value - below.value) / (2.0 * steps[i]);
    turns.col(i) = (above.gradient - below.gradient) / (2.0 * steps[i]);
    uphill = 0.5 * (above.gradient + below.gradient);
    both[static_cast<std::size_t>(i)] = above.value + below.value;
    out.curvature(i, i) = (above.value - 2.0 * here + below.value) / (steps[i] * steps[i]);
    for (Eigen::Index j = 0; j < i; ++j) {
      const Eigen::VectorXd along = step + steps[j] * Eigen::VectorXd::Unit(steps.size(), j);
      const double ends =
          beside(point.u + along, false).value + beside(point.u - along, false).value;
      out.curvature(i, j) = out.curvature(j, i) =
          (ends + 2.0 * here - both[static_cast<std::size_t>(i)] -
           both[static_cast<std::size_t>(j)]) /
          (2.0 * steps[i] * steps[j]);
    }
  }
  out.by = SolveSymmetric(fit.information, turns);
  out.slope += out.by.transpose() * uphill;
  out.curvature += turns.transpose() * out.by;
  return out;
}

std::vector<EffectProfile::Slopes> EffectProfile::SlopesAt(const EffectPoint& point,
                                                           Eigen::Index count) const {
  std::vector<Slopes> out(records_.size());
  RunUnits(out.size(), options_.threads,
           [&](std::size_t e) { out[e] = SlopesOfPoint(point, e, count); });
  return out;
}

}  // namespace howl
