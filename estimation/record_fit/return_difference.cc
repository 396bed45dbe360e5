#include "estimation/record_fit/return_difference.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "estimation/record_fit/loop_tail.h"
#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

constexpr int kBelow = 16;   // points from zero to the band
constexpr int kAbove = 160;  // of the octave above it

double BinsEach(const RecordSpectra& record) {
  return 2.0 * record.share[0] * record.scale.cycle_hz / record.bin_hz;
}

// Calls `take` with each frequency beside the band and what it counts for: twice the weight of the
// bins that it stands for.
template <typename Take>
void ForEachBeside(const RecordSpectra& record, const Take& take) {
  const double lowest = std::abs(record.s[0]);
  const double below = lowest / kBelow;
  const double weight = BinsEach(record);
  for (int i = 0; i < kBelow; ++i) take(C(0.0, (i + 0.5) * below), weight * below);
  const double highest = std::abs(record.s[record.bins() - 1]);
  const double above = highest / kAbove;
  for (int i = 0; i < kAbove; ++i) take(C(0.0, highest + (i + 0.5) * above), weight * above);
}

// -sum of 2 w ln |D| beside the band.
double Beside(const RecordSpectra& record, const LoopPoint& point, const LoopTail& tail) {
  const double slope = record.slopes.dot(point.flame);
  double sum = BinsEach(record) * tail.Value().real();
  ForEachBeside(record, [&](C s, double weight) {
    sum -= weight * std::log(std::abs(1.0 - slope * LoopAt(record, point, s).u));
  });
  return sum;
}

// The sum of 2 w ln |D| over the band.
double Within(const RecordSpectra& record, const LoopPoint& point) {
  const double slope = record.slopes.dot(point.flame);
  double sum = 0.0;
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const C u = LoopAt(record, point, record.s[i]).u;
    sum += 2.0 * record.share[i] * std::log(std::abs(1.0 - slope * u));
  }
  return sum;
}

// A sum with its slopes by the loop's parameters and by the flame's slope.
struct LoopGradient {
  Eigen::VectorXd loop;
  double slope = 0.0;
  double value = 0.0;

  // `over`: of d (slope U).
  void Add(const PointStructure& structure, const LoopPoint& point, double slope_now,
           const LoopAt& at, C over) {
    at.AddSlopes(structure, point, slope_now * over, &loop);
    slope += (over * at.u).real();
  }
};

LoopGradient BesideGradient(const RecordSpectra& record, const PointStructure& structure,
                            const LoopPoint& point, const LoopTail& tail) {
  const double slope = record.slopes.dot(point.flame);
  LoopGradient out{Eigen::VectorXd::Zero(structure.Flame())};
  out.value = BinsEach(record) * tail.Value().real();
  ForEachBeside(record, [&](C s, double weight) {
    const LoopAt loop(record, point, s);
    out.value -= weight * std::log(std::abs(1.0 - slope * loop.u));
    out.Add(structure, point, slope, loop, weight * Reciprocal(1.0 - slope * loop.u));
  });
  const double bins = BinsEach(record);
  if (tail.u != 0.0) out.Add(structure, point, slope, tail.loop, bins * tail.ByLoop() / tail.u);
  if (tail.constant != 0.0) {
    const double by_constant = bins * tail.ByConstant().real();
    out.slope += by_constant / slope;
    const Eigen::Index residues = structure.Frequencies() + structure.Dampings();
    out.loop.segment(residues, structure.modes).array() += by_constant / SumOfResidues(point);
  }
  const C s = tail.loop.s;
  const auto by_path = [&](C by_log, C by_slope_and_log) {
    return bins * (tail.ByConstant() * by_log + tail.BySlope() * by_slope_and_log).real();
  };
  out.loop[structure.Delay()] += by_path(point.path.ByLogTau(s), point.path.BySlopeAndLogTau(s));
  if (structure.Delays() > 1) {
    out.loop[structure.Delay() + 1] +=
        by_path(point.path.ByLogRho(s), point.path.BySlopeAndLogRho(s));
  }
  return out;
}

LoopGradient WithinGradient(const RecordSpectra& record, const PointStructure& structure,
                            const LoopPoint& point) {
  const double slope = record.slopes.dot(point.flame);
  LoopGradient out{Eigen::VectorXd::Zero(structure.Flame())};
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const LoopAt loop(record, point, record.s[i]);
    const C over = -2.0 * record.share[i] * Reciprocal(1.0 - slope * loop.u);
    out.value += 2.0 * record.share[i] * std::log(std::abs(1.0 - slope * loop.u));
    out.Add(structure, point, slope, loop, over);
  }
  return out;
}

// The weight of the first in the slope of -ln(e^-a + e^-b).
double WeightOfFirst(double a, double b) { return 1.0 / (1.0 + std::exp(a - b)); }

}  // namespace

C OpenLoop(const RecordSpectra& record, const LoopPoint& point, C s) {
  return LoopAt(record, point, s).u;
}

double LogDeterminant(const RecordSpectra& record, const LoopPoint& point) {
  const LoopTail tail(record, point);
  if (!tail.Possible(point.path)) return -std::numeric_limits<double>::infinity();
  const double beside = Beside(record, point, tail);
  const double within = Within(record, point);
  return std::min(beside, within) - std::log1p(std::exp(-std::abs(beside - within))) +
         std::numbers::ln2;
}

Eigen::VectorXd LogDeterminantGradient(const RecordSpectra& record, const PointStructure& structure,
                                       const LoopPoint& point) {
  const LoopTail tail(record, point);
  const LoopGradient beside = BesideGradient(record, structure, point, tail);
  const LoopGradient within = WithinGradient(record, structure, point);
  const double weight = WeightOfFirst(beside.value, within.value);
  const Eigen::Index flame = point.flame.size();
  Eigen::VectorXd out = Eigen::VectorXd::Zero(structure.Parameters(flame));
  out.head(structure.Flame()) = weight * beside.loop + (1.0 - weight) * within.loop;
  out.segment(structure.Flame(), flame) =
      (weight * beside.slope + (1.0 - weight) * within.slope) * record.slopes;
  return out;
}

}  // namespace howl
