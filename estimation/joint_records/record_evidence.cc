#include "estimation/joint_records/record_evidence.h"

#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

constexpr double kLeastTold = 0.1;  // of what the prior tells

}  // namespace

ParameterEvidence EvidenceOf(const PointFit& fit, const PointPrior& prior, const SharedUnits& units,
                             double z) {
  const Eigen::Index size = units.size();
  const Eigen::MatrixXd whole = fit.Covariance();
  Eigen::MatrixXd covariance(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) {
      covariance(i, j) =
          units.scale()[i] * units.scale()[j] * whole(units.IndexOf(i), units.IndexOf(j));
    }
  }
  const PointPrior common = units.ToCommon(prior);
  const Eigen::VectorXd deviation = common.deviation;
  // Without the prior, in its units. A direction of which the record tells next to nothing, or in
  // which its density has a minimum, tells nothing: a force without a curvature has no limit.
  Eigen::MatrixXd told = deviation.asDiagonal() *
                         SolveSymmetric(covariance, Eigen::MatrixXd::Identity(size, size)) *
                         deviation.asDiagonal();
  told.diagonal().array() -= 1.0;
  const SymmetricEigen eigen = EigenOfSymmetric(0.5 * (told + told.transpose()));
  const Eigen::VectorXd kept = (eigen.values.array() > kLeastTold).select(eigen.values, 0.0);
  const Eigen::MatrixXd turn =
      eigen.vectors.transpose() * Eigen::MatrixXd(deviation.cwiseInverse().asDiagonal());
  ParameterEvidence out;
  out.z = z;
  out.precision = turn.transpose() * kept.asDiagonal() * turn;
  // So that with the prior the most likely parameters are the fit's.
  const Eigen::VectorXd at = units.ToCommon(fit.parameters);
  const Eigen::VectorXd pull = (kept.array() > 0.0).select((turn * (at - common.mean)).eval(), 0.0);
  out.information = out.precision * at + turn.transpose() * pull;
  return out;
}

}  // namespace howl
