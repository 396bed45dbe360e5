// Whether delays that each operating point has for itself follow the operating parameter
// (delay_varies_with_phi), or scatter about one delay:
//
//   ln tau_e = m + b z_e + s n_e,   n_e standard normal,   z the operating parameter less its mean
//   over its deviation;             b = 0, or normal with a deviation that is not known
//
// What a record tells of its delay is normal about the most likely one (Laplace), but for errors
// that the points share: with an error of an effect's value that is the same at all points every
// delay moves, by what a fit with that value off by its deviation shows. The scatter s and
// the deviation of b have the same prior, level in the logarithm from a ten-thousandth to one: of
// how alike a rig's delays are nothing is known but that they are of one order. Both are summed
// over a grid, m and b are integrated in closed form.
//
// The score is that of the budget (loop_search.h): the density of each point's delay by what the
// others show, summed, less the same without a trend. Two points have no trend: of one left out
// the other tells none.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_DELAY_TREND_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_DELAY_TREND_H_

#include <cstddef>
#include <vector>

#include "diagnosis/loop_budget/trials/loop_trial.h"

namespace howl {

inline constexpr char kDelayTrendId[] = "delay_varies_with_phi";
inline constexpr std::size_t kFewestOfTrend = 4;

// What one record tells of its delay, in seconds.
struct TimedPoint {
  double z = 0.0;
  double log_tau = 0.0;
  double variance = 0.0;
  // Of ln tau, by one deviation of each value that all points share.
  std::vector<double> shared = {};
};

// A shared effect of a loop, and by how much its values may err.
struct SharedErrors {
  EffectPointer effect;
  std::vector<double> deviations;
};

struct DelayTrend {
  double nats = 0.0;
  std::size_t points_better = 0;
  // Of tau, from the smallest operating parameter to the largest, with its 95 % interval.
  double rel_span = 0.0;
  double low = 0.0;
  double high = 0.0;
};

// Points whose records tell nothing of their delays are left out.
std::vector<TimedPoint> DelaysOf(const LoopRecords& records, const LoopFit& fit,
                                 const std::vector<SharedErrors>& shared,
                                 const LoopBudgetOptions& options);

// Of fewer than kFewestOfTrend points nothing is told: all is zero.
DelayTrend TrendOf(const std::vector<TimedPoint>& points);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_ACCOUNT_DELAY_TREND_H_
