#include "estimation/record_fit/loop/line_shapes.h"

#include <complex>

#include "estimation/record_fit/loop/loop_point.h"
#include "model/numerics/complex_products.h"

namespace howl {

using C = std::complex<double>;

LineShapes::LineShapes(const Eigen::VectorXcd& s, Eigen::Index lines)
    : x_(s.imag()), real_(s.size(), lines), imag_(s.size(), lines) {
  for (Eigen::Index k = 0; k < lines; ++k) {
    const auto h = static_cast<double>(k + 1);
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      const C shape =
          2.0 * kLineReach * Reciprocal(C(h * h - x_[i] * x_[i], 2.0 * kLineReach * x_[i]));
      real_(i, k) = shape.real();
      imag_(i, k) = shape.imag();
    }
  }
}

void LineShapes::Factors(const Eigen::VectorXcd& errors, Eigen::VectorXcd* out) const {
  out->setOnes(x_.size());
  const Eigen::Index lines = errors.size();
  if (lines == 0 || errors.isZero(0.0)) return;
  const Eigen::VectorXd by_rate = errors.real();
  const Eigen::VectorXd by_level = -errors.imag().cwiseProduct(
      Eigen::VectorXd::LinSpaced(lines, 1.0, static_cast<double>(lines)));
  const Eigen::VectorXd rate_real = real_.leftCols(lines) * by_rate;
  const Eigen::VectorXd rate_imag = imag_.leftCols(lines) * by_rate;
  out->real() += real_.leftCols(lines) * by_level - x_.cwiseProduct(rate_imag);
  out->imag() += imag_.leftCols(lines) * by_level + x_.cwiseProduct(rate_real);
}

Eigen::MatrixXcd LineShapes::Columns(const Eigen::VectorXcd& answer) const {
  const Eigen::Index lines = real_.cols();
  Eigen::MatrixXcd out(x_.size(), 2 * lines);
  for (Eigen::Index k = 0; k < lines; ++k) {
    for (Eigen::Index i = 0; i < x_.size(); ++i) {
      const C shape(real_(i, k), imag_(i, k));
      out(i, k) = Times(Times(C(0.0, x_[i]), shape), answer[i]);
      out(i, lines + k) = -static_cast<double>(k + 1) * Times(shape, answer[i]);
    }
  }
  return out;
}

Eigen::VectorXd LineShapes::Slope(const Eigen::VectorXcd& weights, Eigen::Index lines) const {
  Eigen::VectorXd out(2 * lines);
  if (lines == 0) return out;
  const Eigen::VectorXd real = weights.real();
  const Eigen::VectorXd imag = weights.imag();
  out.head(lines) = -(real_.leftCols(lines).transpose() * x_.cwiseProduct(imag) +
                      imag_.leftCols(lines).transpose() * x_.cwiseProduct(real));
  out.tail(lines) =
      imag_.leftCols(lines).transpose() * imag - real_.leftCols(lines).transpose() * real;
  out.tail(lines).array() *= Eigen::ArrayXd::LinSpaced(lines, 1.0, static_cast<double>(lines));
  return out;
}

}  // namespace howl
