// Which of several rows of starts all points begin from.
#ifndef HOWL_ESTIMATION_JOINT_RECORDS_BEST_ROW_H_
#define HOWL_ESTIMATION_JOINT_RECORDS_BEST_ROW_H_

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "estimation/record_fit/point_fit.h"

namespace howl {

struct StartGrid {
  std::size_t rows = 0;
  std::size_t points = 0;
  // Whether each point may begin in a row of its own.
  bool apart = false;
};

// Where `fit` of a row and a point comes to in the row that is the most likely of all points
// together; of each point by itself where they may begin apart.
std::vector<Eigen::VectorXd> BestRow(
    const StartGrid& grid, int threads,
    const std::function<PointFit(std::size_t row, std::size_t point)>& fit);

}  // namespace howl

#endif  // HOWL_ESTIMATION_JOINT_RECORDS_BEST_ROW_H_
