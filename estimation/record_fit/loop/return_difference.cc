#include "estimation/record_fit/loop/return_difference.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "estimation/record_fit/loop/beside_band.h"
#include "estimation/record_fit/loop/loop_tail.h"
#include "estimation/record_fit/whittle/log_of_product.h"
#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

// The sum of 2 w ln |D| over the band. slope_u: slope U at each bin.
template <typename SlopeU>
double Within(const RecordSpectra& record, const SlopeU& slope_u) {
  LogOfProduct squares;
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    squares.Multiply(std::norm(1.0 - slope_u(i)), record.share[i]);
  }
  return squares.Sum();
}

// The smaller one, smoothly.
double Both(double beside, double within) {
  return std::min(beside, within) - std::log1p(std::exp(-std::abs(beside - within))) +
         std::numbers::ln2;
}

LoopGradient WithinGradient(const RecordSpectra& record, const PointStructure& structure,
                            const LoopPoint& point) {
  const double slope = record.slopes.dot(point.flame);
  LoopGradient out{Eigen::VectorXd::Zero(structure.Flame())};
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const LoopAt loop(record, point, record.s[i]);
    const C over = -2.0 * record.share[i] * Reciprocal(1.0 - slope * loop.u);
    out.Add(structure, point, slope, loop, over);
  }
  out.value =
      Within(record, [&](Eigen::Index i) { return slope * LoopAt(record, point, record.s[i]).u; });
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
  const double slope = record.slopes.dot(point.flame);
  const double within =
      Within(record, [&](Eigen::Index i) { return slope * LoopAt(record, point, record.s[i]).u; });
  return Both(BesideBand(record, point, tail), within);
}

double LogDeterminant(const RecordSpectra& record, const LoopPoint& point,
                      const LoopResiduals& at) {
  const LoopTail tail(record, point);
  if (!tail.Possible(point.path)) return -std::numeric_limits<double>::infinity();
  const double within = Within(record, [&](Eigen::Index i) { return Times(at.r[i], at.f[i]); });
  return Both(BesideBand(record, point, tail), within);
}

double AddBandWeights(const RecordSpectra& record, const LoopResiduals& at, double beside,
                      WhittleWeights* weights) {
  const double within = Within(record, [&](Eigen::Index i) { return Times(at.r[i], at.f[i]); });
  const double of_beside = WeightOfFirst(beside, within);
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const C over =
        -2.0 * (1.0 - of_beside) * record.share[i] * Reciprocal(1.0 - Times(at.r[i], at.f[i]));
    weights->r[i] += Times(over, at.f[i]);
    weights->f[i] += Times(over, at.r[i]);
  }
  return of_beside;
}

Eigen::VectorXd LogDeterminantGradient(const RecordSpectra& record, const PointStructure& structure,
                                       const LoopPoint& point) {
  const LoopTail tail(record, point);
  const LoopGradient beside = BesideBandGradient(record, structure, point, tail);
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
