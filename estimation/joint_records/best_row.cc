#include "estimation/joint_records/best_row.h"

#include "estimation/parallel.h"

namespace howl {

std::vector<Eigen::VectorXd> BestRow(
    const StartGrid& grid, int threads,
    const std::function<PointFit(std::size_t row, std::size_t point)>& fit) {
  std::vector<std::vector<PointFit>> fits(grid.rows, std::vector<PointFit>(grid.points));
  RunUnits(grid.rows * grid.points, threads, [&](std::size_t i) {
    const std::size_t row = i / grid.points;
    const std::size_t point = i % grid.points;
    fits[row][point] = fit(row, point);
  });
  const auto sum = [&](std::size_t row) {
    double nats = 0.0;
    for (const PointFit& each : fits[row]) nats += each.log_posterior;
    return nats;
  };
  std::size_t best = 0;
  for (std::size_t row = 1; row < grid.rows; ++row) {
    if (sum(row) > sum(best)) best = row;
  }
  std::vector<Eigen::VectorXd> out;
  for (std::size_t point = 0; point < grid.points; ++point) {
    std::size_t of = best;
    for (std::size_t row = 0; grid.apart && row < grid.rows; ++row) {
      if (fits[row][point].log_posterior > fits[of][point].log_posterior) of = row;
    }
    out.push_back(fits[of][point].parameters);
  }
  return out;
}

}  // namespace howl
