#include "estimation/record_fit/loop/possible_loop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace howl {
namespace {

using C = std::complex<double>;

std::array<double, 4> ToEdges(const RecordSpectra& record, const LoopPoint& point,
                              const LoopTail& tail) {
  return {std::abs(tail.constant), std::abs(tail.u), LeastDelay(record) / point.path.tau,
          point.path.spread == DelaySpread::kGamma ? point.path.rho : 0.0};
}

// Calls `take` with each x that is not nothing, and the slopes of ln x.
template <typename Take>
void ForEachEdge(const RecordSpectra& record, const PointStructure& structure,
                 const LoopPoint& point, const Take& take) {
  const LoopTail tail(record, point);
  const auto [of_constant, of_loop, of_delay, of_spread] = ToEdges(record, point, tail);
  const Eigen::VectorXd by_flame = record.slopes / record.slopes.dot(point.flame);
  Eigen::VectorXd by = Eigen::VectorXd::Zero(structure.Flame() + by_flame.size());
  if (of_constant > 0.0) {
    by.segment(structure.Frequencies() + structure.Dampings(), structure.modes)
        .setConstant(1.0 / SumOfResidues(point));
    for (Eigen::Index i = 0; i < structure.Delays(); ++i) {
      by[structure.Delay() + i] = tail.loop.slopes.by[static_cast<std::size_t>(i)].real();
    }
    by.tail(by_flame.size()) = by_flame;
    take(of_constant, by);
  }
  if (of_loop > 0.0) {
    by.setZero();
    tail.loop.AddSlopes(structure, point, 1.0 / tail.loop.u, &by);
    by.tail(by_flame.size()) = by_flame;
    take(of_loop, by);
  }
  by.setZero();
  by[structure.Delay()] = -1.0;
  take(of_delay, by);
  if (of_spread > 0.0) {
    by.setZero();
    by[structure.Delay() + 1] = 1.0;
    take(of_spread, by);
  }
}

}  // namespace

bool IsPossible(const RecordSpectra& record, const LoopPoint& point, const LoopTail& tail) {
  return std::ranges::all_of(ToEdges(record, point, tail), [](double x) { return x < 1.0; });
}

bool IsPossible(const RecordSpectra& record, const LoopPoint& point) {
  return IsPossible(record, point, LoopTail(record, point));
}

double LogDensityOfPossible(const RecordSpectra& record, const LoopPoint& point) {
  double out = 0.0;
  for (const double x : ToEdges(record, point, LoopTail(record, point))) {
    out += std::log1p(-x * x);
  }
  return out;
}

// Of ln(1 - x^2), by ln x: -2 x^2 / (1 - x^2), and the fall of that by ln x.
Eigen::VectorXd GradientOfPossible(const RecordSpectra& record, const PointStructure& structure,
                                   const LoopPoint& point) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(structure.Flame() + record.slopes.size());
  ForEachEdge(record, structure, point, [&](double x, const Eigen::VectorXd& slopes) {
    out -= 2.0 * x * x / (1.0 - x * x) * slopes;
  });
  return out;
}

Eigen::MatrixXd InformationOfPossible(const RecordSpectra& record, const PointStructure& structure,
                                      const LoopPoint& point) {
  const Eigen::Index size = structure.Flame() + record.slopes.size();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size, size);
  ForEachEdge(record, structure, point, [&](double x, const Eigen::VectorXd& slopes) {
    const double left = 1.0 - x * x;
    out += 4.0 * x * x / (left * left) * slopes * slopes.transpose();
  });
  return out;
}

}  // namespace howl
