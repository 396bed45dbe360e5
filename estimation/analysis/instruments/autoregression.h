// A normal process by its autocovariance c_0 ... c_m, as the autoregression of order m that has it,
//
//   e_t = - sum_k a_k e_(t-k) + s u_t,   k = 1 ... m,   u white, of variance one
//
// (Yule and Walker). Its inverse covariance is a band: given all others, e_t is normal with the
// mean sum_k w_k (e_(t-k) + e_(t+k)) and one deviation at all t, but for m samples at either end.
#ifndef HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_AUTOREGRESSION_H_
#define HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_AUTOREGRESSION_H_

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "model/noise/random_stream.h"

namespace howl {

class Autoregression {
 public:
  // Of a positive definite sequence, m + 1 numbers.
  explicit Autoregression(std::span<const double> autocovariance);

  std::size_t order() const { return static_cast<std::size_t>(weights_.size()); }
  double GivenAllOthers(std::span<const double> e, std::size_t t) const;
  double deviation() const { return deviation_; }  // of e_t from that

  // A stretch of the process that began long before.
  std::vector<double> Draw(std::size_t size, RandomStream* random) const;

 private:
  Eigen::VectorXd a_;
  double innovation_ = 0.0;  // s
  Eigen::VectorXd weights_;  // w
  double deviation_ = 0.0;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_AUTOREGRESSION_H_
