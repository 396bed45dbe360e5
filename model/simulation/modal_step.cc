#include "model/simulation/modal_step.h"

#include <Eigen/LU>

#include "model/numerics/lagrange.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

constexpr int kMostTerms = 200;

// sum over m of Z^m v k! / (m + k + 1)!; k = -1: e^Z v.
Eigen::MatrixXd Series(const Eigen::MatrixXd& z, const Eigen::MatrixXd& v, int k) {
  Eigen::MatrixXd term = v / (k < 0 ? 1.0 : k + 1.0);
  Eigen::MatrixXd sum = term;
  for (int m = 1; m < kMostTerms; ++m) {
    term = z * term / (m + k + 1.0);
    const Eigen::MatrixXd before = sum;
    sum += term;
    if (m > 2 && sum == before) break;
  }
  return sum;
}

}  // namespace

std::complex<double> DriveResponse(ModalDrive drive, double leak_hz, std::complex<double> s) {
  switch (drive) {
    case ModalDrive::kPressureRate:
      return s;
    case ModalDrive::kPressure:
      return 1.0;
    case ModalDrive::kVelocity:
      return 1.0 / (s + kRadPerSPerHz * leak_hz);
  }
  return s;
}

ModalStep::ModalStep(std::span<const ResidueMode> modes, ModalDrive drive, double leak_hz,
                     double step_s) {
  const bool integrates = drive == ModalDrive::kVelocity;
  const auto count = static_cast<Eigen::Index>(modes.size());
  const Eigen::Index size = 2 * count + (integrates ? 1 : 0);
  rate_ = Eigen::MatrixXd::Zero(size, size);
  direct_input_ = Eigen::VectorXd::Zero(size);
  pressure_ = Eigen::VectorXd::Zero(size);
  for (Eigen::Index k = 0; k < count; ++k) {
    const ResidueMode& mode = modes[static_cast<std::size_t>(k)];
    const double w = kRadPerSPerHz * mode.omega_hz;
    const Eigen::Index y = 2 * k;
    const Eigen::Index p = y + 1;
    rate_(y, p) = w;
    rate_(p, y) = -w;
    rate_(p, p) = -2.0 * mode.xi * w;
    direct_input_[p] = 1.0;
    pressure_[y] = mode.B;
    pressure_[p] = mode.N;
  }
  drive_ = pressure_;
  if (drive == ModalDrive::kPressureRate) {
    drive_ = rate_.transpose() * pressure_;
    direct_ = pressure_.dot(direct_input_);
  }
  if (integrates) {
    rate_.row(size - 1) = pressure_;
    rate_(size - 1, size - 1) = -kRadPerSPerHz * leak_hz;
    drive_ = Eigen::VectorXd::Unit(size, size - 1);
  }
  const Eigen::MatrixXd z = rate_ * step_s;
  exponential_ = Series(z, Eigen::MatrixXd::Identity(size, size), -1);
  // mu_k, the highest by its series, the others by mu_(k-1) = (Z mu_k + b h) / k.
  constexpr auto kCoefficients = LagrangeCoefficients<kOrder>();
  const Eigen::VectorXd input = direct_input_ * step_s;
  Eigen::MatrixXd moments(size, kOrder);
  moments.col(kOrder - 1) = Series(z, input, kOrder - 1);
  for (Eigen::Index k = kOrder - 1; k > 0; --k) {
    moments.col(k - 1) = (z * moments.col(k) + input) / static_cast<double>(k);
  }
  weights_ = Eigen::MatrixXd::Zero(size, kOrder);
  for (Eigen::Index j = 0; j < kOrder; ++j) {
    for (Eigen::Index k = 0; k < kOrder; ++k) {
      weights_.col(j) +=
          kCoefficients[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)] * moments.col(k);
    }
  }
}

Eigen::VectorXcd ModalStep::AnswerTo(std::complex<double> lambda) const {
  Eigen::MatrixXcd system = -rate_.cast<std::complex<double>>();
  system.diagonal().array() += lambda;
  return system.partialPivLu().solve(direct_input_.cast<std::complex<double>>());
}

void ModalStep::Advance(const double* u, Eigen::VectorXd* x) const {
  *x = (exponential_ * *x + weights_ * Eigen::Map<const Eigen::VectorXd>(u, kOrder)).eval();
}

}  // namespace howl
