#include "estimation/analysis/instruments/fill_gaps.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "estimation/analysis/instruments/cycle_span.h"
#include "estimation/analysis/instruments/present_autocovariance.h"
#include "estimation/analysis/instruments/response_by_least_squares.h"

namespace howl {
namespace {

constexpr int kTurnsWhereBothMiss = 3;

std::vector<bool> Present(std::size_t size, const std::vector<Gap>& gaps) {
  std::vector<bool> out(size, true);
  for (const Gap& gap : gaps) {
    CHECK_LE(gap.first + gap.length, size);
    std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(gap.first), gap.length, false);
  }
  return out;
}

// The conditional mean of x in a gap, given what is present within `beside` samples of it.
void FillFromBeside(const Gap& gap, const std::vector<bool>& present,
                    const std::vector<double>& covariance, std::size_t beside,
                    std::span<double> x) {
  const std::size_t end = gap.first + gap.length;
  const std::size_t from = gap.first - std::min(gap.first, beside);
  std::vector<std::size_t> known;
  for (std::size_t t = from; t < std::min(end + beside, x.size()); ++t) {
    if (present[t]) known.push_back(t);
  }
  const auto at = [&](std::size_t a, std::size_t b) {
    const std::size_t lag = a > b ? a - b : b - a;
    return lag < covariance.size() ? covariance[lag] : 0.0;
  };
  const auto count = static_cast<Eigen::Index>(known.size());
  Eigen::MatrixXd among(count, count);
  Eigen::VectorXd values(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    values[j] = x[known[static_cast<std::size_t>(j)]];
    for (Eigen::Index i = j; i < count; ++i) {
      among(i, j) = at(known[static_cast<std::size_t>(i)], known[static_cast<std::size_t>(j)]);
    }
  }
  const Eigen::VectorXd weights = among.selfadjointView<Eigen::Lower>().llt().solve(values);
  for (std::size_t t = gap.first; t < end; ++t) {
    x[t] = 0.0;
    for (Eigen::Index i = 0; i < count; ++i) {
      x[t] += at(t, known[static_cast<std::size_t>(i)]) * weights[i];
    }
  }
}

// What the other channel's response leaves of x (all of it where there is no other), with its gaps
// filled, and what the response tells put back. Samples before `first` and from `end` on stay.
void FillBeside(const std::vector<Gap>& gaps, std::span<const double> told, std::size_t first,
                std::size_t end, std::size_t beside, std::vector<double>* x) {
  const std::vector<bool> all_present = Present(x->size(), gaps);
  const std::vector<bool> present(all_present.begin() + static_cast<std::ptrdiff_t>(first),
                                  all_present.begin() + static_cast<std::ptrdiff_t>(end));
  std::vector<double> rest(end - first);
  double mean = 0.0;
  double count = 0.0;
  for (std::size_t t = 0; t < rest.size(); ++t) {
    rest[t] = (*x)[first + t] - told[first + t];
    if (!present[t]) continue;
    mean += rest[t];
    ++count;
  }
  if (count == 0.0) return;
  mean /= count;
  for (double& value : rest) value -= mean;
  const std::vector<double> covariance =
      PresentAutocovariance(rest, present, std::min(4 * beside, rest.size()));
  for (const Gap& gap : gaps) {
    const std::size_t from = std::max(gap.first, first);
    const std::size_t to = std::min(gap.first + gap.length, end);
    if (from >= to) continue;
    FillFromBeside({from - first, to - from}, present, covariance, beside, rest);
    for (std::size_t t = from; t < to; ++t) (*x)[t] = told[t] + mean + rest[t - first];
  }
}

// The end of the last gap that begins before `limit`.
std::size_t LastEndBefore(std::size_t limit, const std::vector<Gap>& gaps) {
  std::size_t out = 0;
  for (const Gap& gap : gaps) {
    if (gap.first < limit) out = std::max(out, gap.first + gap.length);
  }
  return out;
}

std::size_t FirstBeginAfter(std::size_t limit, std::size_t size, const std::vector<Gap>& gaps) {
  std::size_t out = size;
  for (const Gap& gap : gaps) {
    if (gap.first + gap.length > limit) out = std::min(out, gap.first);
  }
  return out;
}

void Cut(std::size_t first, std::size_t end, std::vector<double>* x) {
  x->resize(end);
  x->erase(x->begin(), x->begin() + static_cast<std::ptrdiff_t>(first));
}

}  // namespace

Record WithGapsFilled(Record record, const std::vector<Gap>& pressure,
                      const std::vector<Gap>& heat_release, double cycle_hz) {
  if (pressure.empty() && heat_release.empty()) return record;
  CHECK_GT(cycle_hz, 0.0);
  std::vector<double>& p = record.pressure;
  std::vector<double>& q = record.heat_release;
  const std::size_t n = p.size();
  CHECK_EQ(q.size(), n);
  const CycleSpan of_cycle = SpanOfCycle(n, record.sampling_hz / cycle_hz);
  const ResponseSpan& span = of_cycle.response;
  const std::size_t beside = of_cycle.beside;
  const auto fill = [&](const std::vector<Gap>& gaps, const std::vector<double>& from,
                        std::vector<double>* x) {
    const std::vector<double> told =
        ResponseByLeastSquares(from, Present(n, gaps), span).Predict(*x);
    FillBeside(gaps, told, span.back, n - span.ahead, beside, x);
  };
  const std::vector<bool> p_is_there = Present(n, pressure);
  const std::vector<bool> q_is_there = Present(n, heat_release);
  std::size_t lost = 0;
  for (std::size_t t = 0; t < n; ++t) lost += p_is_there[t] && q_is_there[t] ? 0 : 1;
  record.lost_share = static_cast<double>(lost) / static_cast<double>(n);
  const bool both = !pressure.empty() && !heat_release.empty();
  if (both) {
    const std::vector<double> nothing(n, 0.0);
    FillBeside(pressure, nothing, 0, n, beside, &p);
    FillBeside(heat_release, nothing, 0, n, beside, &q);
  }
  for (int turn = 0; turn < (both ? kTurnsWhereBothMiss : 1); ++turn) {
    if (!pressure.empty()) fill(pressure, q, &p);
    if (!heat_release.empty()) fill(heat_release, p, &q);
  }
  const std::size_t first =
      std::max(LastEndBefore(span.back, pressure), LastEndBefore(span.back, heat_release));
  const std::size_t end = std::min(FirstBeginAfter(n - span.ahead, n, pressure),
                                   FirstBeginAfter(n - span.ahead, n, heat_release));
  CHECK_LT(first, end);
  Cut(first, end, &p);
  Cut(first, end, &q);
  return record;
}

}  // namespace howl
