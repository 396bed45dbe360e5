// A point's loop on a record's bins (loop_point.h), of which each part is kept until one of its own
// parameters moves: the differences of a fit's curvature move one at a time, and its line searches
// leave no part worse off.
//
// The slopes of a likelihood come by its bins' weights (whittle_weights.h), taken back through the
// loop from the residuals to the parameters, so that no matrix of derivatives is filled.
#ifndef HOWL_ESTIMATION_RECORD_FIT_LOOP_KEPT_LOOP_H_
#define HOWL_ESTIMATION_RECORD_FIT_LOOP_KEPT_LOOP_H_

#include <Eigen/Core>
#include <array>
#include <complex>
#include <vector>

#include "estimation/record_fit/loop/line_shapes.h"
#include "estimation/record_fit/loop/loop_point.h"
#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/record_fit/whittle/whittle_weights.h"

namespace howl {

class KeptLoop {
 public:
  // Both must outlive it.
  KeptLoop(const RecordSpectra& record, const PointStructure& structure);

  // Returns whether a parameter has moved that R or F depends on.
  bool MoveTo(const Eigen::VectorXd& parameters);

  const LoopPoint& point() const { return point_; }
  const LoopResiduals& residuals() const { return residuals_; }
  const PathOnGrids& path() const { return path_; }
  // By all parameters from `first` on; of others it may be anything.
  Eigen::VectorXd Slope(const WhittleWeights& weights, Eigen::Index first = 0);

 private:
  // 1 / (s^2 + 2 xi omega s + omega^2) on both grids.
  struct ModeGrids {
    Eigen::VectorXcd over, edge_over;
  };

  // Whether these parameters are others than the present ones.
  bool Moved(const Eigen::VectorXd& parameters, Eigen::Index begin, Eigen::Index count) const;
  void MoveModes();
  void MoveAnswer();
  // Null for ones.
  const std::complex<double>* AcousticFactors() const {
    return structure_.acoustic_lines > 0 ? acoustic_factors_.data() : nullptr;
  }
  const std::complex<double>* FlameFactors() const {
    return structure_.flame_lines > 0 ? flame_factors_.data() : nullptr;
  }
  bool HasLines() const { return structure_.acoustic_lines + structure_.flame_lines > 0; }
  // Of the lines' factors on the record's bins, by the errors of one cut.
  Eigen::VectorXd SlopeByBandLines(const WhittleWeights& weights,
                                   const Eigen::VectorXcd& other_factors, Eigen::Index lines);
  void MoveChanges();
  void SlopeByChanges(const WhittleWeights& weights, Eigen::VectorXd* out);
  void SlopeByAcoustics(const WhittleWeights& weights, Eigen::VectorXd* out);
  void SlopeByFlame(const WhittleWeights& weights, Eigen::VectorXd* out);

  const RecordSpectra& record_;
  const PointStructure& structure_;
  Eigen::VectorXd x_, edge_x_;                  // of s = j x
  LineShapes lines_;                            // before the taper
  LineShapes band_lines_;                       // on the record's bins
  Eigen::MatrixXd flame_real_, flame_imag_;     // b_k
  std::vector<Eigen::MatrixXd> noise_columns_;  // one a source
  std::vector<Eigen::VectorXd> noise_shapes_;   // noise_shape.h
  std::vector<Eigen::VectorXd> lost_power_;     // of most sources empty
  Eigen::VectorXd parameters_;
  LoopPoint point_;
  LoopResiduals residuals_;
  std::vector<ModeGrids> modes_;
  PathOnGrids path_;
  // Q in either cut.
  Eigen::VectorXcd acoustic_heat_release_, flame_heat_release_;
  Eigen::VectorXcd burning_;  // sum of c_k b_k
  // Of the two cuts before the taper: without the lines' errors, and 1 + those where a cut has any.
  Eigen::VectorXcd answer_, acoustic_factors_;
  Eigen::VectorXcd arriving_, flame_factors_;
  Eigen::VectorXcd band_acoustic_factors_, band_flame_factors_;
  Eigen::VectorXcd edge_weights_, weighted_, driven_, band_weighted_;  // room for the slopes
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_LOOP_KEPT_LOOP_H_
