#include "estimation/record_fit/spectra/flame_basis.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace howl {
namespace {

constexpr Eigen::Index kIntervals = kFlameTerms + 1 - 3;

struct Piece {
  Eigen::Index first;
  std::array<double, 4> weight;
};

// Which interval of the range v lies in, and how far on in it, 0 to 1; beyond the range at its end.
struct Located {
  Eigen::Index interval;
  double u;
};

Located Locate(double v, double range) {
  const double scaled =
      std::clamp((v / range + 1.0) * 0.5, 0.0, 1.0) * static_cast<double>(kIntervals);
  // What is no number, as after a wild step of a search, has weights that are none, in some column.
  const Eigen::Index interval =
      std::isnan(scaled) ? 0 : std::min(static_cast<Eigen::Index>(scaled), kIntervals - 1);
  return {interval, scaled - static_cast<double>(interval)};
}

// The four cubic B-splines that do not vanish at v; uniform knots beyond the range's ends too.
Piece Evaluate(double v, double range) {
  const auto [interval, u] = Locate(v, range);
  const double w = 1.0 - u;
  return {interval,
          {w * w * w / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
           (3.0 * w * w * w - 6.0 * w * w + 4.0) / 6.0, u * u * u / 6.0}};
}

// Their slopes by u.
Piece Rise(double v, double range) {
  const auto [interval, u] = Locate(v, range);
  const double w = 1.0 - u;
  return {interval, {-0.5 * w * w, 1.5 * u * u - 2.0 * u, 2.0 * w - 1.5 * w * w, 0.5 * u * u}};
}

}  // namespace

Eigen::VectorXd FlameBasis::Knots() const {
  const double step = 2.0 * range_ / static_cast<double>(kIntervals);
  return Eigen::VectorXd::LinSpaced(kFlameTerms + 1, -range_ - step, range_ + step);
}

Eigen::MatrixXd FlameBasis::Columns(const Eigen::VectorXd& v) const {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(v.size(), kFlameTerms);
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const Piece piece = Evaluate(v[i], range_);
    for (Eigen::Index j = 0; j < 4 && piece.first + j < kFlameTerms; ++j) {
      columns(i, piece.first + j) = piece.weight[static_cast<std::size_t>(j)];
    }
  }
  return columns;
}

Eigen::VectorXd FlameBasis::MeanSlopes(const Eigen::VectorXd& v) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(kFlameTerms + 1);
  for (const double each : v) {
    if (std::abs(each) > range_) continue;
    const Piece piece = Rise(each, range_);
    for (Eigen::Index j = 0; j < 4; ++j) {
      sum[piece.first + j] += piece.weight[static_cast<std::size_t>(j)];
    }
  }
  const double u_of_v = 0.5 * static_cast<double>(kIntervals) / range_;
  return u_of_v / static_cast<double>(v.size()) * sum.head(kFlameTerms);
}

double FlameBasis::At(double v, const Eigen::VectorXd& coefficients) const {
  const Piece piece = Evaluate(v, range_);
  double sum = 0.0;
  for (Eigen::Index j = 0; j < 4 && piece.first + j < kFlameTerms; ++j) {
    sum += piece.weight[static_cast<std::size_t>(j)] * coefficients[piece.first + j];
  }
  return sum;
}

Eigen::VectorXd FlameBasis::Value(const Eigen::VectorXd& v,
                                  const Eigen::VectorXd& coefficients) const {
  Eigen::VectorXd value(v.size());
  for (Eigen::Index i = 0; i < v.size(); ++i) value[i] = At(v[i], coefficients);
  return value;
}

}  // namespace howl
