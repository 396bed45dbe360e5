// The parameters that the operating points of one rig have in common (all of loop_point.h but the
// flame's and what the record's ends leave), in units that are the same at every point: those of a
// reference point. Errors of the cycle's lines have no unit.
//
//   common = scale u + shift,   u without unit as in loop_point.h
//
//   ln omega: + ln c     ln tau, ln lambda: - ln c     a, b: times c P / Q
//   ln S_j: + 2 ln(P or Q) - ln F     the background's ratio: times P / Q
//   k of damping: times Q / P         of frequency: times c Q / P          r: over c
//
// c, P, Q and F: the point's cycle, root mean squares of p and q, and sampling rate, over those of
// the reference. The shape of a spectrum is over the band, which follows the cycle.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_SHARED_UNITS_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_SHARED_UNITS_H_

#include <Eigen/Core>
#include <vector>

#include "estimation/joint_records/parameter_law.h"
#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/loop/point_prior.h"

namespace howl {

struct ReferenceUnits {
  double cycle_hz = 1.0;
  double pressure = 1.0;
  double heat_release = 1.0;
  double sampling_hz = 1.0;
};

class SharedUnits {
 public:
  SharedUnits(const PointStructure& structure, const RecordSpectra& record,
              const ReferenceUnits& reference);

  Eigen::Index size() const { return scale_.size(); }
  // Where shared parameter i stands in the point's vector.
  Eigen::Index IndexOf(Eigen::Index i) const { return index_[static_cast<std::size_t>(i)]; }

  Eigen::VectorXd ToCommon(const Eigen::VectorXd& parameters) const;
  // `base` gives the others.
  Eigen::VectorXd FromCommon(const Eigen::VectorXd& common, const Eigen::VectorXd& base) const;
  // The prior of a point whose shared parameters are normal with these common means and deviations.
  PointPrior FromCommon(const PointPrior& common, const PointPrior& base) const;
  PointPrior ToCommon(const PointPrior& prior) const;

  const Eigen::VectorXd& scale() const { return scale_; }
  // Those of acoustics and of the flame, where there are any.
  const std::vector<ErrorGroup>& errors() const { return errors_; }

 private:
  std::vector<Eigen::Index> index_;
  std::vector<ErrorGroup> errors_;
  Eigen::VectorXd scale_;
  Eigen::VectorXd shift_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_SHARED_UNITS_H_
