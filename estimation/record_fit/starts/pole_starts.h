// Poles of the acoustics with which fits of a record begin (point_starts.h), from cut A alone:
//
//   P = R Q + noise,   R = sum_k (a_k s + b_k omega_k) / (s^2 + 2 xi_k omega_k s + omega_k^2)
//
// With the poles given, the residues are linear. A grid gives the poles one after the other, each
// where it leaves least; vector fitting (Gustavsen & Semlyen 1999) moves all at once. Bins weigh as
// the inverse of recorded p's smooth power, so that the cycle's line does not rule alone.
#ifndef HOWL_ESTIMATION_RECORD_FIT_STARTS_POLE_STARTS_H_
#define HOWL_ESTIMATION_RECORD_FIT_STARTS_POLE_STARTS_H_

#include <Eigen/Core>
#include <vector>

#include "estimation/record_fit/loop/loop_point.h"
#include "model/noise/random_stream.h"

namespace howl {

// Without units, as in loop_point.h.
struct StartPole {
  double omega;
  double xi;
};

class PoleStarts {
 public:
  PoleStarts(const RecordSpectra& record, const PointStructure& structure);

  std::vector<StartPole> Greedy() const;
  // One more than these, where it leaves least. Frequencies are free.
  StartPole Next(const std::vector<StartPole>& poles) const;
  // Even over the band's logarithm.
  std::vector<StartPole> Spread() const;
  std::vector<StartPole> Relocated(std::vector<StartPole> poles) const;
  std::vector<StartPole> Drawn(RandomStream* random) const;
  std::vector<LoopMode> WithResidues(const std::vector<StartPole>& poles) const;

 private:
  void AddColumns(const StartPole& pole, Eigen::MatrixXcd* columns) const;
  Eigen::MatrixXcd Columns(const std::vector<StartPole>& poles) const;
  std::vector<StartPole> Tied(double omega, double xi) const;
  template <typename ColumnsOf>
  StartPole BestOfGrid(const ColumnsOf& columns) const;

  const RecordSpectra& record_;
  const PointStructure& structure_;
  Eigen::VectorXcd heat_release_;
  Eigen::VectorXd weight_;
  Eigen::VectorXcd target_;  // weighted P
  double low_;
  double high_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_STARTS_POLE_STARTS_H_
