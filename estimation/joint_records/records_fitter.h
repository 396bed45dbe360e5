// The steps of which a fit of several operating points' records is made (records_fit.h). Inner
// workings.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_RECORDS_FITTER_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_RECORDS_FITTER_H_

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "estimation/joint_records/records_fit.h"

namespace howl {

ReferenceUnits ReferenceOf(const std::vector<OperatingPoint>& points);
// The operating parameter less its mean, over its deviation.
std::vector<double> Standardised(const std::vector<OperatingPoint>& points);

// The key of a unit: what it is of, and which.
std::string UnitKey(const RecordsFitOptions& options, const char* what, std::size_t a,
                    std::size_t b);

class RecordsFitter {
 public:
  RecordsFitter(const std::vector<OperatingPoint>& points, const PointStructure& structure,
                const ReferenceUnits& reference, std::vector<double> z, int threads)
      : points_(points), structure_(structure), z_(std::move(z)), threads_(threads) {
    for (const OperatingPoint& point : points) {
      units_.emplace_back(structure, point.record, reference);
      base_.push_back(PriorOf(structure, point.record));
    }
    common_base_ = MeanBase();
  }

  std::size_t size() const { return points_.size(); }
  const PointStructure& structure() const { return structure_; }
  const PointPrior& base(std::size_t e) const { return base_[e]; }
  PointPrior Prior(std::size_t e, const PointPrior& common) const {
    return units_[e].FromCommon(common, base_[e]);
  }
  // Whether the law stands still from one to the next; of a point that has no others the errors
  // alone have one.
  bool Stands(const ParameterLaw& before, const ParameterLaw& after) const;
  // Of a point that has no others: its model's errors alone are what a law tells.
  PointPrior PriorOfErrors(const ParameterLaw& law) const;

  std::vector<PointFit> Alone(const RecordsFitOptions& options) const;
  StartRows FromOneAnother(const std::vector<PointFit>& alone) const;
  StartRows FromPoorer(const RecordsFit& poorer) const;
  // Of the row from which all points together become most likely, by the records' middles where
  // there is a choice (middle_part.h), the fits.
  std::vector<PointFit> Best(const StartRows& starts, const RecordsFitOptions& options) const;
  ParameterLaw Law(const std::vector<ParameterEvidence>& evidence) const {
    return FitParameterLaw(evidence, common_base_, units_[0].errors());
  }
  ParameterLaw LawOfOthers(std::vector<ParameterEvidence> evidence, std::size_t e) const {
    evidence.erase(evidence.begin() + static_cast<std::ptrdiff_t>(e));
    return Law(evidence);
  }
  std::vector<ParameterEvidence> Evidence(const std::vector<PointFit>& fits,
                                          const std::vector<PointPrior>& priors) const;

 private:
  // The base prior of each point, in common units, at its mean over the points.
  PointPrior MeanBase() const;
  Eigen::VectorXd StartFrom(std::size_t e, const Eigen::VectorXd& common) const;
  // The points that give candidates, evenly.
  std::vector<std::size_t> Drawn() const;

  const std::vector<OperatingPoint>& points_;
  const PointStructure& structure_;
  std::vector<double> z_;
  int threads_;
  std::vector<SharedUnits> units_;
  std::vector<PointPrior> base_;
  PointPrior common_base_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_RECORDS_FITTER_H_
