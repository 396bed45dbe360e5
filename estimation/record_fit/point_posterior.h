// The log posterior of a point's parameters, in units of the prior's deviations, with its slopes
// and curvature: what point_fit.h climbs. Its prior is that of point_prior.h times the density of
// possible loops (possible_loop.h).
#ifndef HOWL_ESTIMATION_RECORD_FIT_POINT_POSTERIOR_H_
#define HOWL_ESTIMATION_RECORD_FIT_POINT_POSTERIOR_H_

#include <Eigen/Core>

#include "estimation/record_fit/loop/point_likelihood.h"
#include "estimation/record_fit/loop/point_prior.h"

namespace howl {

struct PosteriorSlopes {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;
};

class PointPosterior {
 public:
  // All three must outlive it.
  PointPosterior(const RecordSpectra& record, const PointStructure& structure,
                 const PointPrior& prior)
      : record_(record), structure_(structure), prior_(prior), likelihood_(record, structure) {}

  double LogPrior(const Eigen::VectorXd& parameters) const;  // of possible loops
  // -infinity where the parameters are impossible.
  double Value(const Eigen::VectorXd& parameters);
  // By the parameters from `first` on.
  Eigen::VectorXd Gradient(const Eigen::VectorXd& parameters, Eigen::Index first = 0);
  // That of whittle.h, and the prior's.
  Eigen::MatrixXd Information(const Eigen::VectorXd& parameters);
  // The same from the record's share, in the parameters' own units.
  Eigen::MatrixXd WithPrior(const Eigen::MatrixXd& of_record,
                            const Eigen::VectorXd& parameters) const;
  PosteriorSlopes Expand(const Eigen::VectorXd& parameters) {
    return {Gradient(parameters), Information(parameters)};
  }
  // The curvature itself, by differences of the gradient from that in `here`, whose information
  // sets their length. Of the two differences that show an element that one is taken which needs no
  // slopes by earlier parameters, which cost most. Where the model misses what the record shows it
  // differs from the information, and steps on the latter come near the maximum slowly.
  Eigen::MatrixXd Curvature(const Eigen::VectorXd& parameters, const PosteriorSlopes& here);
  // How much of a step, in units of the prior's deviations, stays among possible loops with room to
  // the edge.
  double ShareWithin(const Eigen::VectorXd& parameters, const Eigen::VectorXd& step) const;

 private:
  LoopPoint PointAt(const Eigen::VectorXd& parameters) const {
    return ToPoint(structure_, record_.flame.cols(), parameters);
  }

  const RecordSpectra& record_;
  const PointStructure& structure_;
  const PointPrior& prior_;
  PointLikelihood likelihood_;
};

// Far from the maximum the record's share may leave the information without a sign: the steps then
// take the size of its curvature, as Greenstadt's modified Newton steps do. What has less than the
// prior tells has that.
Eigen::MatrixXd Positive(const Eigen::MatrixXd& information);

// The symmetric update of rank one (SR1): what a step has shown of the curvature along it, at the
// cost of one gradient. It need not have a sign, which the curvature has not either.
void CorrectAlong(const Eigen::VectorXd& step, const Eigen::VectorXd& fall_of_gradient,
                  Eigen::MatrixXd* information);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_POINT_POSTERIOR_H_
