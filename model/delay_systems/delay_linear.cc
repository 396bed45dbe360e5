#include "model/delay_systems/delay_linear.h"

#include <algorithm>
#include <cmath>

namespace howl::internal {
namespace {

constexpr double kDifference = 6e-6;  // the cube root of rounding, for central differences

}  // namespace

Linearised Linearise(const DelaySystem& system, double parameter, const Eigen::VectorXd& rest) {
  const int n = system.dimension;
  const std::size_t delays = system.delays.size();
  Linearised out{Eigen::MatrixXd(n, n),
                 std::vector<Eigen::MatrixXd>(delays, Eigen::MatrixXd(n, n))};
  std::vector<Eigen::VectorXd> past(delays, rest);
  Eigen::VectorXd x = rest, up(n), down(n);
  const auto column = [&](Eigen::VectorXd* moved, int j, Eigen::MatrixXd* a) {
    const double value = (*moved)(j);
    const double step = kDifference * std::max(1.0, std::abs(value));
    (*moved)(j) = value + step;
    system.rate(parameter, x, past, &up);
    (*moved)(j) = value - step;
    system.rate(parameter, x, past, &down);
    (*moved)(j) = value;
    a->col(j) = (up - down) / (2.0 * step);
  };
  for (int j = 0; j < n; ++j) {
    column(&x, j, &out.present);
    for (std::size_t k = 0; k < delays; ++k) column(&past[k], j, &out.delayed[k]);
  }
  return out;
}

Eigen::MatrixXcd CharacteristicMatrix(const Linearised& a, const std::vector<double>& delays,
                                      std::complex<double> s) {
  Eigen::MatrixXcd d = -a.present.cast<std::complex<double>>();
  d.diagonal().array() += s;
  for (std::size_t k = 0; k < delays.size(); ++k) {
    d -= a.delayed[k].cast<std::complex<double>>() * std::exp(-s * delays[k]);
  }
  return d;
}

}  // namespace howl::internal
