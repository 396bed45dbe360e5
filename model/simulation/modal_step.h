// A step of h of acoustics that heat release u drives (model/loop/modal_acoustics.h), and of what
// then drives the flame:
//
//   y_k' = w_k p_k,   p_k' = -w_k y_k - 2 xi_k w_k p_k + u,   p = sum_k (N_k p_k + B_k y_k)
//   v = p' (pressure rate),   p,   or   v' = p - w_l v (velocity: the integral of p)
//
// The state x = (y_1, p_1, ..., y_K, p_K, and v where it is an integral) is propagated exactly, u
// being the polynomial through its six samples that stand nearest (mode_step.h has the formula):
//
//   x(h) = E x(0) + sum_j w_j u_j,   j = -2 .. 3
//
// w_l keeps the integral from running away: acoustics whose R(0) is not zero make a mean of p of a
// mean of q, whose integral has no end. Seconds; omega in Hz.
#ifndef HOWL_MODEL_SIMULATION_MODAL_STEP_H_
#define HOWL_MODEL_SIMULATION_MODAL_STEP_H_

#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <span>

#include "model/loop/modal_acoustics.h"

namespace howl {

enum class ModalDrive : std::uint8_t { kPressureRate, kPressure, kVelocity };

// v's transfer from p at s in rad/s.
std::complex<double> DriveResponse(ModalDrive drive, double leak_hz, std::complex<double> s);

class ModalStep {
 public:
  static constexpr int kOrder = 6;
  static constexpr int kAhead = 3;  // heat release is needed this many steps beyond the state
  static constexpr int kBehind = 2;

  ModalStep(std::span<const ResidueMode> modes, ModalDrive drive, double leak_hz, double step_s);

  Eigen::Index size() const { return direct_input_.size(); }
  // The state's answer to u = e^(lambda t), at t = 0.
  Eigen::VectorXcd AnswerTo(std::complex<double> lambda) const;
  // `u`: of the six samples, the oldest first.
  void Advance(const double* u, Eigen::VectorXd* x) const;

  double Pressure(const Eigen::VectorXd& x) const { return pressure_.dot(x); }
  // u: at the state's time.
  double Drive(const Eigen::VectorXd& x, double u) const { return drive_.dot(x) + direct_ * u; }

 private:
  Eigen::MatrixXd rate_;          // A: x' = A x + b u
  Eigen::VectorXd direct_input_;  // b
  Eigen::VectorXd pressure_;
  Eigen::VectorXd drive_;
  double direct_ = 0.0;  // of u in v
  Eigen::MatrixXd exponential_;
  Eigen::MatrixXd weights_;  // one column a sample
};

}  // namespace howl

#endif  // HOWL_MODEL_SIMULATION_MODAL_STEP_H_
