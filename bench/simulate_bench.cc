// Steps a second of the simulator: two modes, one delay, tanh flame, without noise; one rig, and
// eight side by side. Beside it a plain fourth-order Runge-Kutta of the same equations with cubic
// interpolation of the delay, at the step at which it is as accurate; "error" is the amplitude
// and phase error of a linear loop's mode after 0.1 s.
//
// One rig is bound by the chain of dependent operations from one state to the next (a product and
// two sums, half of the time of a step); all else runs in vectors along time. Eight rigs are bound
// by the vector units: some 125 operations a member and step, a third of them in tanh, whose
// quotient makes it two fifths of the time.
#include <benchmark/benchmark.h>

#include <cmath>
#include <complex>
#include <vector>

#include "model/numerics/constants.h"
#include "model/simulation/simulate.h"

namespace {

howl::RigParameters Rig(int index) {
  howl::RigParameters rig;
  rig.model = {{{215.0 - index, 0.2, 6609.0, 2743.0, 3.0}, 0.00346 + 1e-5 * index},
               {howl::FlameShape::kTanh, -0.703e-4, 0.5, 0.0}};
  rig.past = {{0.1, 216.0, 0.0, 0.0}};
  return rig;
}

void RunRigs(benchmark::State& state, int members, double internal_hz, double noise) {
  std::vector<howl::SimulationCase> cases;
  for (int i = 0; i < members; ++i) {
    cases.push_back({Rig(i % 8), static_cast<std::uint64_t>(i)});
    cases.back().rig.noise.combustion_density = noise;
    cases.back().rig.noise.combustion_corner_hz = 1000.0;
  }
  howl::SimulationOptions options;
  // The run is long against its record: the anti-alias filter has a benchmark of its own.
  options.duration_s = 0.01;
  options.settle_s = 20.0;
  options.internal_hz = internal_hz;
  options.threads = 1;
  for (auto _ : state) benchmark::DoNotOptimize(howl::SimulateBatch(cases, options));
  state.counters["steps/s"] = benchmark::Counter(options.settle_s * internal_hz * members,
                                                 benchmark::Counter::kIsIterationInvariantRate);
}

void OneRig(benchmark::State& state) { RunRigs(state, 1, 20000.0, 0.0); }
void EightRigs(benchmark::State& state) { RunRigs(state, 8, 20000.0, 0.0); }
void EightRigsWithNoise(benchmark::State& state) { RunRigs(state, 8, 20000.0, 1e-8); }
BENCHMARK(OneRig)->Unit(benchmark::kMillisecond);
BENCHMARK(EightRigs)->Unit(benchmark::kMillisecond);
BENCHMARK(EightRigsWithNoise)->Unit(benchmark::kMillisecond);

void EightRigsRecorded(benchmark::State& state) {
  std::vector<howl::SimulationCase> cases;
  for (int i = 0; i < 8; ++i) cases.push_back({Rig(i), 0});
  howl::SimulationOptions options;
  options.duration_s = 3.2;
  options.internal_hz = 20000.0;
  options.threads = 1;
  for (auto _ : state) benchmark::DoNotOptimize(howl::SimulateBatch(cases, options));
  state.counters["steps/s"] = benchmark::Counter(options.duration_s * options.internal_hz * 8,
                                                 benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(EightRigsRecorded)->Unit(benchmark::kMillisecond);

// Plain Runge-Kutta: state y, p of each mode; p' of the past on the grid, read by cubic
// interpolation at the delayed times of the stages.
class RungeKutta {
 public:
  RungeKutta(const howl::ClosedLoop& model, double rate_hz, bool linear)
      : n_(model.loop.acoustics.N),
        m_(model.loop.acoustics.M),
        xi_(model.loop.acoustics.xi),
        w1_(howl::kTwoPi * model.loop.acoustics.omega_hz),
        w2_(model.loop.acoustics.harmonic_ratio * w1_),
        slope_(model.flame.slope),
        saturation_(model.flame.saturation),
        step_(1.0 / rate_hz),
        linear_(linear),
        delay_(model.loop.tau_s * rate_hz) {}

  template <typename Past>
  void Start(std::complex<double> q, std::complex<double> s, std::size_t steps, Past&& mode) {
    past_ = static_cast<std::size_t>(delay_) + 4;
    rate_.assign(past_ + steps + 1, 0.0);
    const std::complex<double> i1 = n_ * q * mode(w1_, xi_, s);
    const std::complex<double> i2 = m_ * q * mode(w2_, xi_, s);
    x_[0] = (w1_ * i1).real();
    x_[1] = (s * i1).real();
    x_[2] = (w2_ * i2).real();
    x_[3] = (s * i2).real();
    for (std::size_t i = 0; i <= past_; ++i) {
      const double t = (static_cast<double>(i) - static_cast<double>(past_)) * step_;
      rate_[i] = (s * s * (i1 + i2) * std::exp(s * t)).real();
    }
    at_ = past_;
  }

  void Step() {
    const double q0 = Heat(0.0);
    const double qh = Heat(0.5);
    const double q1 = Heat(1.0);
    double k1[4];
    double k2[4];
    double k3[4];
    double k4[4];
    double y[4];
    Derivative(x_, q0, k1);
    for (int i = 0; i < 4; ++i) y[i] = x_[i] + 0.5 * step_ * k1[i];
    Derivative(y, qh, k2);
    for (int i = 0; i < 4; ++i) y[i] = x_[i] + 0.5 * step_ * k2[i];
    Derivative(y, qh, k3);
    for (int i = 0; i < 4; ++i) y[i] = x_[i] + step_ * k3[i];
    Derivative(y, q1, k4);
    for (int i = 0; i < 4; ++i) x_[i] += step_ / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
    Derivative(x_, q1, k1);
    rate_[++at_] = k1[1] + k1[3];
  }

  double pressure() const { return x_[1] + x_[3]; }

 private:
  double Heat(double fraction) const {
    const double position = static_cast<double>(at_) + fraction - delay_;
    const auto i = static_cast<std::size_t>(position);
    const double f = position - static_cast<double>(i);
    const double* r = rate_.data() + i - 1;
    const double v =
        -f * (f - 1.0) * (f - 2.0) / 6.0 * r[0] + (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0 * r[1] -
        (f + 1.0) * f * (f - 2.0) / 2.0 * r[2] + (f + 1.0) * f * (f - 1.0) / 6.0 * r[3];
    return linear_ ? slope_ * v : saturation_ * std::tanh(slope_ * v / saturation_);
  }
  void Derivative(const double* x, double q, double* d) const {
    d[0] = w1_ * x[1];
    d[1] = -w1_ * x[0] - 2.0 * xi_ * w1_ * x[1] + n_ * q;
    d[2] = w2_ * x[3];
    d[3] = -w2_ * x[2] - 2.0 * xi_ * w2_ * x[3] + m_ * q;
  }

  double n_, m_, xi_, w1_, w2_, slope_, saturation_, step_;
  bool linear_;
  double delay_;
  std::vector<double> rate_;
  std::size_t past_ = 0;
  std::size_t at_ = 0;
  double x_[4] = {};
};

// A linear loop with the solution e^(lambda t): N and M from the characteristic equation.
struct KnownSolution {
  howl::RigParameters rig;
  std::complex<double> lambda{22.0, howl::kTwoPi * 216.0};
  std::complex<double> pressure;
};

std::complex<double> Integral(double w, double xi, std::complex<double> s) {
  return 1.0 / (s * s + 2.0 * w * xi * s + w * w);
}

KnownSolution MakeKnownSolution() {
  KnownSolution known;
  const std::complex<double> s = known.lambda;
  constexpr double kTau = 0.00346123456789;
  constexpr double kSlope = -0.7e-4;
  const double w = howl::kTwoPi * 215.0;
  const std::complex<double> common = kSlope * s * s * std::exp(-s * kTau);
  const std::complex<double> a = common * Integral(w, 0.2, s);
  const std::complex<double> b = common * Integral(3.0 * w, 0.2, s);
  const double determinant = a.real() * b.imag() - b.real() * a.imag();
  const double n = b.imag() / determinant;
  const double m = -a.imag() / determinant;
  known.rig.model = {{{215.0, 0.2, n, m, 3.0}, kTau},
                     {howl::FlameShape::kLinear, kSlope, 1.0, 0.0}};
  known.rig.past = {{1.0, s.imag() / howl::kTwoPi, s.real(), 0.0}};
  known.pressure = s * (n * Integral(w, 0.2, s) + m * Integral(3.0 * w, 0.2, s));
  return known;
}

double RungeKuttaError(double rate_hz) {
  const KnownSolution known = MakeKnownSolution();
  RungeKutta rk(known.rig.model, rate_hz, true);
  const auto steps = static_cast<std::size_t>(0.1 * rate_hz);
  rk.Start(1.0, known.lambda, steps, Integral);
  double error = 0.0;
  double scale = 0.0;
  for (std::size_t i = 1; i <= steps; ++i) {
    rk.Step();
    const double t = static_cast<double>(i) / rate_hz;
    const double truth = (known.pressure * std::exp(known.lambda * t)).real();
    error = std::max(error, std::abs(rk.pressure() - truth));
    scale = std::max(scale, std::abs(truth));
  }
  return error / scale;
}

double SimulatorError(double rate_hz) {
  const KnownSolution known = MakeKnownSolution();
  howl::SimulationOptions options;
  options.duration_s = 0.1;
  options.sampling_hz = rate_hz;
  const auto record = howl::Simulate({known.rig, 0}, options);
  double error = 0.0;
  double scale = 0.0;
  for (std::size_t i = 0; i < record.pressure.size(); ++i) {
    const double t = static_cast<double>(i) / rate_hz;
    const double truth = (known.pressure * std::exp(known.lambda * t)).real();
    error = std::max(error, std::abs(record.pressure[i] - truth));
    scale = std::max(scale, std::abs(truth));
  }
  return error / scale;
}

// Reports seconds of rig time a second, for the ratio at equal accuracy.
void RungeKuttaAsAccurate(benchmark::State& state) {
  const double target = SimulatorError(20000.0);
  double rate_hz = 20000.0;
  while (RungeKuttaError(rate_hz) > target && rate_hz < 2e6) rate_hz *= 1.1;
  const howl::RigParameters rig = Rig(0);
  const auto steps = static_cast<std::size_t>(rate_hz);
  for (auto _ : state) {
    RungeKutta rk(rig.model, rate_hz, false);
    rk.Start(0.1, {0.0, howl::kTwoPi * 216.0}, steps, Integral);
    for (std::size_t i = 0; i < steps; ++i) rk.Step();
    benchmark::DoNotOptimize(rk.pressure());
  }
  state.counters["rate_hz"] = rate_hz;
  state.counters["error"] = RungeKuttaError(rate_hz);
  state.counters["steps/s"] =
      benchmark::Counter(static_cast<double>(steps), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["rig_s/s"] =
      benchmark::Counter(1.0, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(RungeKuttaAsAccurate)->Unit(benchmark::kMillisecond);

void SimulatorAsAccurate(benchmark::State& state) {
  howl::SimulationOptions options;
  options.duration_s = 0.01;
  options.settle_s = 20.0;
  options.internal_hz = 20000.0;
  options.threads = 1;
  const howl::SimulationCase one{Rig(0), 0};
  for (auto _ : state) benchmark::DoNotOptimize(howl::Simulate(one, options));
  state.counters["rate_hz"] = options.internal_hz;
  state.counters["error"] = SimulatorError(options.internal_hz);
  state.counters["rig_s/s"] =
      benchmark::Counter(options.settle_s, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(SimulatorAsAccurate)->Unit(benchmark::kMillisecond);

}  // namespace
