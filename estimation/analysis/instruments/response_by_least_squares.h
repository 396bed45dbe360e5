// A signal x from another, y, by a response of finite length and a constant:
//
//   minimise  sum over t of w_t (x_t - c - sum_k h_k y_(t-k))^2,   -ahead <= k <= back
//
// over back <= t < n - ahead, with weights of one or zero.
#ifndef HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_RESPONSE_BY_LEAST_SQUARES_H_
#define HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_RESPONSE_BY_LEAST_SQUARES_H_

#include <cstddef>
#include <span>
#include <vector>

namespace howl {

struct ResponseSpan {
  std::size_t ahead = 0;
  std::size_t back = 0;
};

// c + sum_k h_k y_(t-k) for back <= t < n - ahead, zero for the others. With M of these n samples
// out of use and K = ahead + back + 1 it takes K n + K^2 M + K^3 / 3 steps.
std::vector<double> PredictByResponse(std::span<const double> y, std::span<const double> x,
                                      const std::vector<bool>& used, const ResponseSpan& span);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_RESPONSE_BY_LEAST_SQUARES_H_
