#include "estimation/record_fit/loop/return_difference.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "estimation/record_fit/loop/beside_band.h"
#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/record_fit/loop/loop_tail.h"
#include "estimation/record_fit/loop/possible_loop.h"
#include "estimation/record_fit/whittle/log_of_product.h"
#include "model/numerics/complex_products.h"

namespace howl {
namespace {

using C = std::complex<double>;

C LineFactor(const LoopResiduals& at, Eigen::Index bin) {
  return at.line_factors.size() > 0 ? at.line_factors[bin] : 1.0;
}

C SlowPart(const LoopResiduals& at, Eigen::Index bin) {
  return at.slow.size() > 0 ? at.slow[bin] : 0.0;
}

// What the acoustics are fed back, as D has it.
C FeedbackOf(const LoopResiduals& at, Eigen::Index bin) {
  return Times(at.f[bin], LineFactor(at, bin)) - SlowPart(at, bin);
}

// The sum of 2 w ln |D| over the band.
double Within(const RecordSpectra& record, const LoopResiduals& at) {
  LogOfProduct squares;
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    squares.Multiply(std::norm(1.0 - Times(at.r[i], FeedbackOf(at, i))), record.share[i]);
  }
  return squares.Sum();
}

// The smaller one, smoothly.
double Both(double beside, double within) {
  return std::min(beside, within) - std::log1p(std::exp(-std::abs(beside - within))) +
         std::numbers::ln2;
}

// The weight of the first in the slope of -ln(e^-a + e^-b).
double WeightOfFirst(double a, double b) { return 1.0 / (1.0 + std::exp(a - b)); }

}  // namespace

C OpenLoop(const RecordSpectra& record, const LoopPoint& point, C s) {
  return LoopAt(record, point, s).u;
}

double LogDeterminant(const RecordSpectra& record, const LoopPoint& point) {
  return LogDeterminant(record, point, TransfersOf(record, point));
}

double LogDeterminant(const RecordSpectra& record, const LoopPoint& point,
                      const LoopResiduals& at) {
  const LoopTail tail(record, point);
  if (!IsPossible(record, point, tail)) return -std::numeric_limits<double>::infinity();
  return Both(BesideBand(record, point, tail), Within(record, at));
}

double AddBandWeights(const RecordSpectra& record, const LoopResiduals& at, double beside,
                      WhittleWeights* weights) {
  const double of_beside = WeightOfFirst(beside, Within(record, at));
  weights->line_factors.resize(at.line_factors.size());
  weights->slow.resize(at.slow.size());
  for (Eigen::Index i = 0; i < record.bins(); ++i) {
    const C feedback = FeedbackOf(at, i);
    const C over =
        -2.0 * (1.0 - of_beside) * record.share[i] * Reciprocal(1.0 - Times(at.r[i], feedback));
    const C by_feedback = Times(over, at.r[i]);
    weights->r[i] += Times(over, feedback);
    weights->f[i] += Times(by_feedback, LineFactor(at, i));
    if (at.line_factors.size() > 0) weights->line_factors[i] = Times(by_feedback, at.f[i]);
    if (at.slow.size() > 0) weights->slow[i] = -by_feedback;
  }
  return of_beside;
}

}  // namespace howl
