// The simulator's order, against solutions known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdio>
#include <memory>
#include <vector>

#include "model/numerics/constants.h"
#include "model/simulation/simulate.h"
#include "tests/model/paper_loop.h"

namespace howl::simulate_convergence_test {
namespace {

using Complex64 = std::complex<double>;

// s / (s^2 + 2 omega xi s + omega^2), written out here on its own.
Complex64 Mode(double omega_hz, double xi, Complex64 s) {
  const double w = kTwoPi * omega_hz;
  return s / (s * s + 2.0 * w * xi * s + w * w);
}

// A linear loop of which e^(lambda t) is a solution: 1 = k lambda (N g_1 + M g_2) e^(-lambda tau)
// is two real equations, linear in N and M.
struct LinearLoop {
  RigParameters rig;
  Complex64 pressure;  // p(t) = Re(pressure e^(lambda t))
  Complex64 lambda;
};

LinearLoop MakeLinearLoop(Complex64 lambda, double tau_s) {
  constexpr double kSlope = -0.7e-4;
  const Complex64 common = kSlope * lambda * std::exp(-lambda * tau_s);
  const Complex64 a = common * Mode(215.0, 0.2, lambda);
  const Complex64 b = common * Mode(645.0, 0.2, lambda);
  const double determinant = a.real() * b.imag() - b.real() * a.imag();
  const double n = b.imag() / determinant;
  const double m = -a.imag() / determinant;
  LinearLoop loop;
  loop.lambda = lambda;
  loop.pressure = n * Mode(215.0, 0.2, lambda) + m * Mode(645.0, 0.2, lambda);
  loop.rig.model = {{{215.0, 0.2, n, m, 3.0}, tau_s}, {FlameShape::kLinear, kSlope, 1.0, 0.0}};
  loop.rig.past = {{1.0, lambda.imag() / kTwoPi, lambda.real(), 0.0}};
  return loop;
}

double LinearError(const LinearLoop& loop, double internal_hz) {
  SimulationOptions options;
  options.duration_s = 0.1;
  options.sampling_hz = options.internal_hz = internal_hz;
  const SimulatedRecord record = Simulate({loop.rig, 1}, options);
  double error = 0.0;
  double scale = 0.0;
  for (std::size_t i = 0; i < record.pressure.size(); ++i) {
    const double t = static_cast<double>(i) / internal_hz;
    const double truth = (loop.pressure * std::exp(loop.lambda * t)).real();
    error = std::max(error, std::abs(record.pressure[i] - truth));
    scale = std::max(scale, std::abs(truth));
  }
  return error / scale;
}

TEST(SimulateConvergence, LinearDelayEquationToTenDigits) {
  // Growing, decaying; delays that are no multiple of the step.
  for (const Complex64 lambda :
       {Complex64(22.0, kTwoPi * 216.0), Complex64(-20.0, kTwoPi * 216.5)}) {
    const LinearLoop loop = MakeLinearLoop(lambda, 0.00346123456789);
    const double error = LinearError(loop, 160000.0);
    std::printf("linear delay equation, 0.1 s: largest relative error %.1e\n", error);
    EXPECT_LT(error, 1e-10) << lambda;
  }
}

TEST(SimulateConvergence, LinearOrder) {
  const LinearLoop loop = MakeLinearLoop({22.0, kTwoPi * 216.0}, 0.00346123456789);
  const double coarse = LinearError(loop, 15000.0);
  const double fine = LinearError(loop, 60000.0);
  const double order = std::log2(coarse / fine) / 2.0;
  std::printf("order on a linear loop: %.2f\n", order);
  EXPECT_GT(order, 5.5) << coarse << " " << fine;
  EXPECT_LT(order, 7.0);
}

// A source that makes q(t) = cos(w t) + 0.3 cos(2.7 w t) the solution of the nonlinear loop.
class ManufacturedSource final : public LoopEffect {
 public:
  static constexpr double kFrequencies[] = {212.3, 2.7 * 212.3};
  static constexpr double kAmplitudes[] = {1.0, 0.3};

  static double HeatRelease(double t) {
    double q = 0.0;
    for (int i = 0; i < 2; ++i) q += kAmplitudes[i] * std::cos(kTwoPi * kFrequencies[i] * t);
    return q;
  }
  static Complex64 Acoustic(const Acoustics<double>& a, Complex64 s) {
    return a.N * Mode(a.omega_hz, a.xi, s) + a.M * Mode(3.0 * a.omega_hz, a.xi, s);
  }
  static double Pressure(const Acoustics<double>& a, double t) {
    double p = 0.0;
    for (int i = 0; i < 2; ++i) {
      const Complex64 s(0.0, kTwoPi * kFrequencies[i]);
      p += kAmplitudes[i] * (Acoustic(a, s) * std::exp(s * t)).real();
    }
    return p;
  }
  static double Rate(const Acoustics<double>& a, double t) {
    double rate = 0.0;
    for (int i = 0; i < 2; ++i) {
      const Complex64 s(0.0, kTwoPi * kFrequencies[i]);
      rate += kAmplitudes[i] * (s * Acoustic(a, s) * std::exp(s * t)).real();
    }
    return rate;
  }

  std::unique_ptr<LoopEffect> Clone() const override {
    return std::make_unique<ManufacturedSource>(*this);
  }
  void Source(const LoopContext& at, std::span<double> heat_release) override {
    for (std::size_t i = 0; i < heat_release.size(); ++i) {
      const double t = at.time_s + static_cast<double>(i) * at.step_s;
      const double v = Rate(at.loop.acoustics, t - at.loop.tau_s);
      heat_release[i] += HeatRelease(t) -
                         at.flame.saturation * std::tanh(at.flame.slope * v / at.flame.saturation);
    }
  }
};

double NonlinearError(double tau_s, double internal_hz) {
  RigParameters rig;
  rig.model = PaperLoop(0.415);
  rig.model.loop.tau_s = tau_s;
  for (int i = 0; i < 2; ++i) {
    rig.past.push_back(
        {ManufacturedSource::kAmplitudes[i], ManufacturedSource::kFrequencies[i], 0.0, 0.0});
  }
  rig.effects = {std::make_shared<ManufacturedSource>()};
  SimulationOptions options;
  options.duration_s = 0.05;
  options.sampling_hz = options.internal_hz = internal_hz;
  const SimulatedRecord record = Simulate({rig, 1}, options);
  double error = 0.0;
  for (std::size_t i = 0; i < record.pressure.size(); ++i) {
    const double t = static_cast<double>(i) / internal_hz;
    error = std::max(error, std::abs(record.pressure[i] -
                                     ManufacturedSource::Pressure(rig.model.loop.acoustics, t)));
    error = std::max(error, std::abs(record.heat_release[i] - ManufacturedSource::HeatRelease(t)));
  }
  return error;
}

TEST(SimulateConvergence, NonlinearOrderAtAnyDelay) {
  // The first delay is a whole number of steps at every rate, the others at none.
  for (const double tau_s : {0.00350, 0.00346123456789, 0.0035 + 0.5 / 12345.0}) {
    double previous = NonlinearError(tau_s, 16000.0);
    for (const double rate : {32000.0, 64000.0}) {
      const double error = NonlinearError(tau_s, rate);
      const double order = std::log2(previous / error);
      std::printf("order on a nonlinear loop, delay of %.2f steps: %.2f\n", tau_s * rate, order);
      EXPECT_GT(order, 5.3) << "tau " << tau_s << " rate " << rate << " error " << error;
      previous = error;
    }
    EXPECT_LT(previous, 1e-6);
  }
}

}  // namespace
}  // namespace howl::simulate_convergence_test
