// How a flame's answer may arrive, as cut B tells it: the flame is linear in its coefficients once
// its path is given, and of the paths those are starts that leave less of q than those beside them.
#ifndef HOWL_ESTIMATION_RECORD_FIT_STARTS_PATH_STARTS_H_
#define HOWL_ESTIMATION_RECORD_FIT_STARTS_PATH_STARTS_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "estimation/record_fit/loop/flame_path.h"
#include "estimation/record_fit/spectra/record_spectra.h"

namespace howl {

class PathStarts {
 public:
  explicit PathStarts(const RecordSpectra& record);

  // The flame's coefficients that leave least of q, given its path.
  Eigen::VectorXd Flame(const FlamePath& path) const;
  // Delays, as far as their prior reaches: those that leave least, at most `count`.
  std::vector<double> Delays(std::size_t count) const;
  // Second paths of a path that has none: those that leave least, at most `count`.
  std::vector<SecondPath> SecondPaths(const FlamePath& first, std::size_t count) const;

 private:
  double LogLeft(const Eigen::VectorXcd& left) const;

  const RecordSpectra& record_;
  Eigen::VectorXcd heat_release_;
  Eigen::MatrixXcd flame_;
  Eigen::VectorXd weight_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_STARTS_PATH_STARTS_H_
