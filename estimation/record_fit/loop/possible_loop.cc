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

// Of ln(1 - x^2), by ln x: with slopes of ln x.
void Add(double x, const Eigen::VectorXd& slopes, PossibleSlopes* out) {
  const double left = 1.0 - x * x;
  out->gradient -= 2.0 * x * x / left * slopes;
  out->information += 4.0 * x * x / (left * left) * slopes * slopes.transpose();
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

PossibleSlopes SlopesOfPossible(const RecordSpectra& record, const PointStructure& structure,
                                const LoopPoint& point) {
  const LoopTail tail(record, point);
  const auto [of_constant, of_loop, of_delay, of_spread] = ToEdges(record, point, tail);
  const double slope = record.slopes.dot(point.flame);
  const Eigen::Index size = structure.Flame() + record.slopes.size();
  const Eigen::VectorXd by_flame = record.slopes / slope;
  PossibleSlopes out{Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Zero(size, size)};
  if (of_constant > 0.0) {
    Eigen::VectorXd by = Eigen::VectorXd::Zero(size);
    by.segment(structure.Frequencies() + structure.Dampings(), structure.modes)
        .setConstant(1.0 / SumOfResidues(point));
    for (Eigen::Index i = 0; i < structure.Delays(); ++i) {
      by[structure.Delay() + i] = tail.loop.slopes.by[static_cast<std::size_t>(i)].real();
    }
    by.tail(by_flame.size()) = by_flame;
    Add(of_constant, by, &out);
  }
  if (of_loop > 0.0) {
    Eigen::VectorXd by = Eigen::VectorXd::Zero(size);
    tail.loop.AddSlopes(structure, point, 1.0 / tail.loop.u, &by);
    by.tail(by_flame.size()) = by_flame;
    Add(of_loop, by, &out);
  }
  Eigen::VectorXd by = Eigen::VectorXd::Zero(size);
  by[structure.Delay()] = -1.0;
  Add(of_delay, by, &out);
  if (of_spread > 0.0) {
    by.setZero();
    by[structure.Delay() + 1] = 1.0;
    Add(of_spread, by, &out);
  }
  return out;
}

}  // namespace howl
