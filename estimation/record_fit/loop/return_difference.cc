#include "estimation/record_fit/loop/return_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "estimation/record_fit/loop/beside_band.h"
#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/record_fit/loop/loop_tail.h"
#include "estimation/record_fit/loop/possible_loop.h"
#include "estimation/record_fit/whittle/log_of_product.h"
#include "model/numerics/complex_lanes.h"

namespace howl {
namespace {

using C = std::complex<double>;

// The band's loop: R, F, the lines' factors and the slow changes' part, the last two null where
// there are none.
struct Band {
  explicit Band(const LoopResiduals& at)
      : r(at.r.data()),
        f(at.f.data()),
        line_factors(at.line_factors.size() > 0 ? at.line_factors.data() : nullptr),
        slow(at.slow.size() > 0 ? at.slow.data() : nullptr) {}

  const C* r;
  const C* f;
  const C* line_factors;
  const C* slow;
};

// What the acoustics are fed back, as D has it, from bin i on.
template <typename V>
HOWL_IN_CLONES ComplexLanes<V> FeedbackAt(const Band& band, Eigen::Index i) {
  auto out = ComplexLanes<V>::Load(band.f + i);
  if (band.line_factors != nullptr) out = out * ComplexLanes<V>::Load(band.line_factors + i);
  if (band.slow != nullptr) out = out - ComplexLanes<V>::Load(band.slow + i);
  return out;
}

// D of R and of what is fed back.
template <typename V>
HOWL_IN_CLONES ComplexLanes<V> DifferenceOf(const ComplexLanes<V>& r, const ComplexLanes<V>& back) {
  const ComplexLanes<V> loop = r * back;
  return {1.0 - loop.re, -loop.im};
}

template <typename V>
HOWL_IN_CLONES void SquareAt(const Band& band, Eigen::Index i, double* out) {
  const auto r = ComplexLanes<V>::Load(band.r + i);
  Lanes<V>::Store(SquaredMagnitude(DifferenceOf(r, FeedbackAt<V>(band, i))), out);
}

constexpr Eigen::Index kBinsAtOnce = 64;

// |D|^2 of `bins` bins.
HOWL_VECTOR_CLONES
void SetSquares(const Band& band, Eigen::Index first, Eigen::Index bins, double* out) {
  Eigen::Index i = 0;
  for (; i + kLanes <= bins; i += kLanes) SquareAt<EightLanes>(band, first + i, out + i);
  for (; i < bins; ++i) SquareAt<double>(band, first + i, out + i);
}

// The sum of 2 w ln |D| over the band.
double Within(const RecordSpectra& record, const LoopResiduals& at) {
  const Band band(at);
  LogOfProduct product;
  std::array<double, kBinsAtOnce> squares;
  for (Eigen::Index first = 0; first < record.bins(); first += kBinsAtOnce) {
    const Eigen::Index bins = std::min(kBinsAtOnce, record.bins() - first);
    SetSquares(band, first, bins, squares.data());
    for (Eigen::Index i = 0; i < bins; ++i) {
      product.Multiply(squares[static_cast<std::size_t>(i)], record.share[first + i]);
    }
  }
  return product.Sum();
}

struct BandSlopes {
  C* r;
  C* f;
  C* line_factors;
  C* slow;
};

template <typename V>
HOWL_IN_CLONES void AddSlopesAt(const Band& band, const double* share, double scale, Eigen::Index i,
                                const BandSlopes& out) {
  const auto r = ComplexLanes<V>::Load(band.r + i);
  const ComplexLanes<V> back = FeedbackAt<V>(band, i);
  const V weight = scale * Lanes<V>::Load(share + i);
  const ComplexLanes<V> over = weight * Reciprocal(DifferenceOf(r, back));
  const ComplexLanes<V> by_feedback = over * r;
  Store(ComplexLanes<V>::Load(out.r + i) + over * back, out.r + i);
  ComplexLanes<V> by_f = by_feedback;
  if (band.line_factors != nullptr) {
    by_f = by_f * ComplexLanes<V>::Load(band.line_factors + i);
    Store(by_feedback * ComplexLanes<V>::Load(band.f + i), out.line_factors + i);
  }
  Store(ComplexLanes<V>::Load(out.f + i) + by_f, out.f + i);
  if (band.slow != nullptr) {
    Store(ComplexLanes<V>{-by_feedback.re, -by_feedback.im}, out.slow + i);
  }
}

// Of scale times the sum of w ln D.
HOWL_VECTOR_CLONES
void AddSlopes(const Band& band, const double* share, double scale, Eigen::Index bins,
               const BandSlopes& out) {
  Eigen::Index i = 0;
  for (; i + kLanes <= bins; i += kLanes) AddSlopesAt<EightLanes>(band, share, scale, i, out);
  for (; i < bins; ++i) AddSlopesAt<double>(band, share, scale, i, out);
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
  AddSlopes(
      Band(at), record.share.data(), -2.0 * (1.0 - of_beside), record.bins(),
      {weights->r.data(), weights->f.data(), weights->line_factors.data(), weights->slow.data()});
  return of_beside;
}

}  // namespace howl
