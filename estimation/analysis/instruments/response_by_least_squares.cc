#include "estimation/analysis/instruments/response_by_least_squares.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>

namespace howl {
namespace {

// Of the power of y: a signal without power in some band leaves h free there.
constexpr double kRidge = 1e-9;

// The regressors of one time, y_(t + ahead) ... y_(t - back), stand in memory in the other order.
auto RegressorsAt(std::span<const double> y, std::size_t t, const ResponseSpan& span) {
  const auto length = static_cast<Eigen::Index>(span.ahead + span.back + 1);
  return Eigen::Map<const Eigen::VectorXd>(y.data() + t - span.back, length);
}

// Lower half of the sum over first <= t < end of the regressors' products: its first column, and
// along the diagonals the sums differ by what enters at one end and leaves at the other.
Eigen::MatrixXd ProductsOverAll(std::span<const double> y, std::size_t first, std::size_t end,
                                const ResponseSpan& span) {
  const auto length = static_cast<Eigen::Index>(span.ahead + span.back + 1);
  Eigen::MatrixXd out(length, length);
  out.col(0).setZero();
  for (std::size_t t = first; t < end; ++t) {
    out.col(0) += y[t - span.back] * RegressorsAt(y, t, span);
  }
  const double* const begin = y.data() + first - span.back;
  const double* const after = y.data() + end - span.back;
  for (Eigen::Index j = 1; j < length; ++j) {
    for (Eigen::Index i = j; i < length; ++i) {
      out(i, j) = out(i - 1, j - 1) + after[i - 1] * after[j - 1] - begin[i - 1] * begin[j - 1];
    }
  }
  return out;
}

void TakeAway(const Eigen::Ref<const Eigen::MatrixXd>& regressors, Eigen::MatrixXd* products) {
  if (regressors.cols() == 0) return;  // which Eigen divides by
  products->selfadjointView<Eigen::Lower>().rankUpdate(regressors, -1.0);
}

}  // namespace

std::vector<double> PredictByResponse(std::span<const double> y, std::span<const double> x,
                                      const std::vector<bool>& used, const ResponseSpan& span) {
  const std::size_t n = y.size();
  CHECK_EQ(x.size(), n);
  CHECK_EQ(used.size(), n);
  CHECK_GT(n, span.ahead + span.back);
  const std::size_t first = span.back;
  const std::size_t end = n - span.ahead;
  const auto length = static_cast<Eigen::Index>(span.ahead + span.back + 1);
  std::vector<double> out(n, 0.0);

  std::size_t count = 0;
  double mean_x = 0.0;
  Eigen::VectorXd mean_y = Eigen::VectorXd::Zero(length);
  for (std::size_t t = first; t < end; ++t) {
    if (!used[t]) continue;
    ++count;
    mean_x += x[t];
    mean_y += RegressorsAt(y, t, span);
  }
  if (count == 0) return out;
  mean_x /= static_cast<double>(count);
  mean_y /= static_cast<double>(count);

  Eigen::MatrixXd products = ProductsOverAll(y, first, end, span);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(length);
  constexpr Eigen::Index kBlock = 256;
  Eigen::MatrixXd unused(length, kBlock);
  Eigen::Index column = 0;
  for (std::size_t t = first; t < end; ++t) {
    if (used[t]) {
      right += (x[t] - mean_x) * RegressorsAt(y, t, span);
      continue;
    }
    unused.col(column++) = RegressorsAt(y, t, span);
    if (column < kBlock) continue;
    TakeAway(unused, &products);
    column = 0;
  }
  TakeAway(unused.leftCols(column), &products);
  products.selfadjointView<Eigen::Lower>().rankUpdate(mean_y, -static_cast<double>(count));
  products.diagonal().array() += kRidge * products.diagonal().maxCoeff();
  const Eigen::VectorXd response = products.selfadjointView<Eigen::Lower>().llt().solve(right);
  const double constant = mean_x - response.dot(mean_y);
  for (std::size_t t = first; t < end; ++t) {
    out[t] = constant + response.dot(RegressorsAt(y, t, span));
  }
  return out;
}

}  // namespace howl
