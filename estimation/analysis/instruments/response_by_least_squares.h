// A signal x from another, y, by a response of finite length and a constant:
//
//   minimise  sum over t of w_t (x_t - c - sum_k h_k y_(t-k))^2,   -ahead <= k <= back
//
// over back <= t < n - ahead, with weights of one or zero.
#ifndef HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_RESPONSE_BY_LEAST_SQUARES_H_
#define HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_RESPONSE_BY_LEAST_SQUARES_H_

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace howl {

struct ResponseSpan {
  std::size_t ahead = 0;
  std::size_t back = 0;
};

// With M of these n samples in use, or out of it if these are fewer, and K = ahead + back + 1 it
// takes K n + K^2 M + K^3 / 3 steps, and for each x 2 K n more.
class ResponseByLeastSquares {
 public:
  // y stays where it is.
  ResponseByLeastSquares(std::span<const double> y, std::vector<bool> used,
                         const ResponseSpan& span);

  // c + sum_k h_k y_(t-k) for back <= t < n - ahead, zero for the others, and where none is in use.
  std::vector<double> Predict(std::span<const double> x) const;

  // Of the samples in use, how many more than c and h take.
  double DegreesOfFreedom() const;

 private:
  // The regressors of one time, y_(t + ahead) ... y_(t - back), stand in memory in the other order.
  auto At(std::size_t t) const {
    return Eigen::Map<const Eigen::VectorXd>(y_.data() + t - span_.back, Length());
  }
  Eigen::Index Length() const { return static_cast<Eigen::Index>(span_.ahead + span_.back + 1); }
  std::size_t End() const { return y_.size() - span_.ahead; }
  Eigen::MatrixXd ProductsOverAll() const;

  std::span<const double> y_;
  std::vector<bool> used_;
  ResponseSpan span_;
  std::size_t count_ = 0;  // of samples in use
  Eigen::VectorXd mean_;   // of the regressors
  Eigen::LLT<Eigen::MatrixXd> products_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_RESPONSE_BY_LEAST_SQUARES_H_
