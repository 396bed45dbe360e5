#include "estimation/record_fit/loop/point_likelihood.h"

#include <limits>

#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/record_fit/loop/return_difference.h"

namespace howl {

PointLikelihood::PointLikelihood(const RecordSpectra& record, const PointStructure& structure)
    : record_(record), structure_(structure), loop_(record, structure) {}

void PointLikelihood::MoveTo(const Eigen::VectorXd& parameters) {
  if (loop_.MoveTo(parameters)) beside_known_ = false;
}

double PointLikelihood::Value(const Eigen::VectorXd& parameters) {
  if (!parameters.allFinite()) return -std::numeric_limits<double>::infinity();
  MoveTo(parameters);
  return WhittleLogLikelihood(structure_.noise, record_.share, loop_.residuals()) +
         LogDeterminant(record_, loop_.point(), loop_.residuals());
}

Eigen::VectorXd PointLikelihood::Gradient(const Eigen::VectorXd& parameters, Eigen::Index first) {
  MoveTo(parameters);
  WeighBins(structure_.noise, record_.share, loop_.residuals(), &weights_);
  // The loop's determinant does not hang on its noise.
  if (first >= structure_.Noise(record_.flame.cols())) return loop_.Slope(weights_, first);
  if (!beside_known_) {
    const LoopPoint& point = loop_.point();
    beside_ = BesideBandGradient(record_, structure_, point, LoopTail(record_, point));
    beside_known_ = true;
  }
  const double beside = AddBandWeights(record_, loop_.residuals(), beside_.value, &weights_);
  Eigen::VectorXd out = loop_.Slope(weights_, first);
  out.head(structure_.Flame()) += beside * beside_.loop;
  out.segment(structure_.Flame(), record_.slopes.size()) += beside * beside_.slope * record_.slopes;
  return out;
}

Eigen::MatrixXd PointLikelihood::Information(const Eigen::VectorXd& parameters) {
  MoveTo(parameters);
  return WhittleInformation(structure_.noise, record_.share, loop_.residuals(),
                            DerivativesOf(record_, structure_, loop_.point(), loop_.path()));
}

}  // namespace howl
