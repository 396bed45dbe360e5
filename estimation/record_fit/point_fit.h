// The most likely loop of one operating point, given its record (whittle.h) and priors
// (point_prior.h), and its evidence.
//
//   maximise ln L + ln prior;  ln Z = ln L + ln prior - ln det(H / (2 pi)) / 2       (Laplace)
//
// Levenberg's and Marquardt's steps on the information H, with the damping set by the ratio of what
// a step gains to what was foretold (Nielsen 1999). The likelihood has several maxima, since noise
// and modes make up for one another: the fit is repeated from several starts (point_starts.h).
#ifndef HOWL_ESTIMATION_RECORD_FIT_POINT_FIT_H_
#define HOWL_ESTIMATION_RECORD_FIT_POINT_FIT_H_

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/loop/point_prior.h"

namespace howl {

struct PointFitOptions {
  int iterations = 100;
  double converged = 1e-3;  // nats that the next step would gain
  // Whether the curvature is learnt where the fit ends, as its evidence and its errors need: a
  // third of the work. Without, both are those of what the steps have shown.
  bool curvature = true;
  // Of minus the log likelihood where the fit begins, as a fit under another prior has learnt it:
  // it is learnt anew only where the fit goes farther than its own errors.
  const Eigen::MatrixXd* of_record = nullptr;
  // Of what it has gained over a log posterior of `over` the share that need not be known: a fit
  // that is compared with others of the record then ends earlier, where it gained much.
  double share = 0.0;
  double over = std::numeric_limits<double>::infinity();
};

// To well within a nat of the maximum, which tells maxima apart.
inline constexpr PointFitOptions kToTheMaximum{.iterations = 60, .converged = 0.1};
// The same for fits that are only compared. In the valleys that lead to a maximum steps that do not
// know the curvature seem to gain less than they do: of 96 fits that ended where the next step
// seemed to gain a nat 16 were ten nats and more below their maximum, of those that ended at a
// hundredth of one none but what used up its iterations (bench/fit_end_study.cc).
inline constexpr PointFitOptions kToCompare{
    .iterations = 60, .converged = 0.01, .curvature = false};

// Nats that the next step would gain, from which on a fit is near a maximum: steps then learn the
// curvature, and starts are compared.
inline constexpr double kNearMaximum = 20.0;

struct PointFit {
  Eigen::VectorXd parameters;
  double log_likelihood = 0.0;
  double log_posterior = 0.0;
  double log_evidence = 0.0;
  // Of the parameters, with the prior's precision in it: symmetric to the bit. Its inverse is their
  // covariance.
  Eigen::MatrixXd information;
  int iterations = 0;
  bool converged = false;

  Eigen::MatrixXd Covariance() const;
  // The information without what this prior, under which the fit was, has in it.
  Eigen::MatrixXd InformationOfRecord(const PointPrior& prior) const;
};

PointFit FitPoint(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& prior, Eigen::VectorXd start,
                  const PointFitOptions& options = {});

// The best of the fits from all starts: all come near a maximum, of the record's middle where that
// is much shorter, and the best of them then go on to that of the record.
PointFit FitPoint(const RecordSpectra& record, const PointStructure& structure,
                  const PointPrior& prior, const std::vector<Eigen::VectorXd>& starts,
                  const PointFitOptions& options = {});

double LogLikelihood(const RecordSpectra& record, const PointStructure& structure,
                     const Eigen::VectorXd& parameters);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_POINT_FIT_H_
