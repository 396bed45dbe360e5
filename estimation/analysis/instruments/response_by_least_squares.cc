#include "estimation/analysis/instruments/response_by_least_squares.h"

#include <glog/logging.h>

#include <utility>

namespace howl {
namespace {

// Of the power of y: a signal without power in some band leaves h free there.
constexpr double kRidge = 1e-9;

void Add(double times, const Eigen::Ref<const Eigen::MatrixXd>& regressors,
         Eigen::MatrixXd* products) {
  if (regressors.cols() == 0) return;  // which Eigen divides by
  products->selfadjointView<Eigen::Lower>().rankUpdate(regressors, times);
}

}  // namespace

// Lower half of the sum over all times of the regressors' products: its first column, and along the
// diagonals the sums differ by what enters at one end and leaves at the other.
Eigen::MatrixXd ResponseByLeastSquares::ProductsOverAll() const {
  const Eigen::Index length = Length();
  Eigen::MatrixXd out(length, length);
  out.col(0).setZero();
  for (std::size_t t = span_.back; t < End(); ++t) out.col(0) += y_[t - span_.back] * At(t);
  const double* const begin = y_.data();
  const double* const after = y_.data() + End() - span_.back;
  for (Eigen::Index j = 1; j < length; ++j) {
    for (Eigen::Index i = j; i < length; ++i) {
      out(i, j) = out(i - 1, j - 1) + after[i - 1] * after[j - 1] - begin[i - 1] * begin[j - 1];
    }
  }
  return out;
}

ResponseByLeastSquares::ResponseByLeastSquares(std::span<const double> y, std::vector<bool> used,
                                               const ResponseSpan& span)
    : y_(y), used_(std::move(used)), span_(span) {
  CHECK_EQ(used_.size(), y_.size());
  CHECK_GT(y_.size(), span_.ahead + span_.back);
  const Eigen::Index length = Length();
  mean_ = Eigen::VectorXd::Zero(length);
  for (std::size_t t = span_.back; t < End(); ++t) {
    if (!used_[t]) continue;
    ++count_;
    mean_ += At(t);
  }
  const bool most = 2 * count_ > End() - span_.back;
  Eigen::MatrixXd products =
      most ? ProductsOverAll() : Eigen::MatrixXd(Eigen::MatrixXd::Zero(length, length));
  constexpr Eigen::Index kBlock = 256;
  Eigen::MatrixXd regressors(length, kBlock);
  Eigen::Index column = 0;
  for (std::size_t t = span_.back; t < End(); ++t) {
    if (used_[t] == most) continue;
    regressors.col(column++) = At(t);
    if (column < kBlock) continue;
    Add(most ? -1.0 : 1.0, regressors, &products);
    column = 0;
  }
  Add(most ? -1.0 : 1.0, regressors.leftCols(column), &products);
  if (count_ == 0) return;
  mean_ /= static_cast<double>(count_);
  products.selfadjointView<Eigen::Lower>().rankUpdate(mean_, -static_cast<double>(count_));
  products.diagonal().array() += kRidge * products.diagonal().maxCoeff();
  products_.compute(products.selfadjointView<Eigen::Lower>());
}

std::vector<double> ResponseByLeastSquares::Predict(std::span<const double> x) const {
  CHECK_EQ(x.size(), y_.size());
  std::vector<double> out(y_.size(), 0.0);
  if (count_ == 0) return out;
  double mean_x = 0.0;
  for (std::size_t t = span_.back; t < End(); ++t) {
    if (used_[t]) mean_x += x[t];
  }
  mean_x /= static_cast<double>(count_);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(Length());
  for (std::size_t t = span_.back; t < End(); ++t) {
    if (used_[t]) right += (x[t] - mean_x) * At(t);
  }
  const Eigen::VectorXd response = products_.solve(right);
  const double constant = mean_x - response.dot(mean_);
  for (std::size_t t = span_.back; t < End(); ++t) out[t] = constant + response.dot(At(t));
  return out;
}

double ResponseByLeastSquares::DegreesOfFreedom() const {
  return static_cast<double>(count_) - static_cast<double>(Length() + 1);
}

}  // namespace howl
