// Spread delays, against the integrals of their densities, and found again in drawn records.
#include "estimation/record_fit/loop/flame_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "estimation/record_fit/point_fit.h"
#include "estimation/record_fit/starts/point_starts.h"
#include "model/noise/random_stream.h"
#include "tests/estimation/record_fit/drawn_record.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::flame_path_test {
namespace {

using C = std::complex<double>;

// The integral of density(t) e^(-s t), by the trapezoidal rule.
C Transform(C s, double from, double to, auto density) {
  constexpr int kSteps = 200000;
  const double h = (to - from) / kSteps;
  C sum = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = from + i * h;
    sum += (i == 0 || i == kSteps ? 0.5 : 1.0) * density(t) * std::exp(-s * t);
  }
  return h * sum;
}

TEST(FlamePath, IsTheTransformOfItsDelays) {
  const double tau = 3.0;
  const double rho = 0.25;
  const double sigma = rho * tau;
  const double shape = 1.0 / (rho * rho);
  const auto inverse_gaussian = [&](double t) {
    if (t <= 0.0) return 0.0;
    const double lambda = tau * shape;
    return std::sqrt(lambda / (2.0 * std::numbers::pi * t * t * t)) *
           std::exp(-0.5 * lambda * std::pow((t - tau) / tau, 2) / t);
  };
  const auto gamma = [&](double t) {
    if (t <= 0.0) return 0.0;
    const double x = t * shape / tau;
    return std::exp((shape - 1.0) * std::log(x) - x - std::lgamma(shape)) * shape / tau;
  };
  for (const C s : {C(0.0, 0.3), C(0.0, 1.0), C(0.0, 3.0), C(0.1, 1.2)}) {
    const FlamePath by_normal{DelaySpread::kNormal, tau, rho};
    EXPECT_LT(std::abs(by_normal.At(s) - Transform(s, 0.0, tau + 40.0 * sigma, inverse_gaussian)),
              1e-9);
    const FlamePath by_gamma{DelaySpread::kGamma, tau, rho};
    EXPECT_LT(std::abs(by_gamma.At(s) - Transform(s, 0.0, tau + 30.0 * sigma, gamma)), 1e-9);
  }
}

// As the spread falls the difference to a normal density's transform falls as its third cumulant
// does: as rho^4.
TEST(FlamePath, IsNormalWhereTheSpreadIsSmall) {
  const C x(0.0, 2.0);
  const auto apart = [&](double rho) {
    const FlamePath path{DelaySpread::kNormal, 1.0, rho};
    return std::abs(path.At(x) - std::exp(-x + 0.5 * rho * rho * x * x));
  };
  EXPECT_NEAR(apart(0.1) / apart(0.05), 16.0, 1.0);
  EXPECT_LT(apart(0.05), 1e-4);
}

// One of each spread, alone and with a second path.
std::vector<FlamePath> AllPaths() {
  std::vector<FlamePath> out;
  for (const DelaySpread spread : {DelaySpread::kNone, DelaySpread::kNormal, DelaySpread::kGamma}) {
    for (const bool second : {false, true}) {
      FlamePath path{spread, 1.1, 0.3};
      if (second) path.second = SecondPath{-0.4, 0.8};
      out.push_back(path);
    }
  }
  return out;
}

// In the order of its parameters; `step` added to parameter k.
FlamePath Moved(FlamePath path, std::size_t k, double step) {
  const std::size_t second = path.spread == DelaySpread::kNone ? 1 : 2;
  if (k == 0) path.tau *= std::exp(step);
  if (k == 1 && second == 2) path.rho *= std::exp(step);
  if (path.second && k == second) path.second->share += step;
  if (path.second && k == second + 1) path.second->lambda *= std::exp(step);
  return path;
}

TEST(FlamePath, SlopesAreThoseOfItsLogarithm) {
  constexpr double kStep = 1e-6;
  for (const FlamePath& path : AllPaths()) {
    const std::size_t parameters =
        (path.spread == DelaySpread::kNone ? 1 : 2) + (path.second ? 2 : 0);
    for (const C s : {C(0.0, 0.5), C(0.05, 2.0)}) {
      for (std::size_t k = 0; k < parameters; ++k) {
        const FlamePath above = Moved(path, k, kStep);
        const FlamePath below = Moved(path, k, -kStep);
        EXPECT_LT(std::abs(path.WithSlopes(s).by[k] -
                           (std::log(above.At(s)) - std::log(below.At(s))) / (2.0 * kStep)),
                  1e-8);
        EXPECT_LT(
            std::abs(path.Fall(s).by[k] - (above.Fall(s).at - below.Fall(s).at) / (2.0 * kStep)),
            1e-8);
      }
    }
  }
}

// At / Fall is the integral of At from s on: its slope is -At. Of two paths whose delays are spread
// the fall is a neighbour's of the frequency.
TEST(FlamePath, FallsAsItsIntegralDoes) {
  constexpr double kStep = 1e-6;
  for (const FlamePath& path : AllPaths()) {
    if (path.second && path.spread != DelaySpread::kNone) continue;
    const auto integral = [&](C at) { return path.At(at) / path.Fall(at).at; };
    for (const C s : {C(0.0, 0.5), C(0.05, 2.0)}) {
      EXPECT_LT(std::abs((integral(s + kStep) - integral(s - kStep)) / (2.0 * kStep) + path.At(s)),
                1e-8);
    }
  }
}

TEST(FlamePath, SecondAnswersLater) {
  const C s(0.1, 1.7);
  FlamePath path{DelaySpread::kNone, 2.0};
  const C first = path.At(s);
  path.second = SecondPath{0.3, 1.5};
  EXPECT_LT(std::abs(path.At(s) - (0.7 * first + 0.3 * std::exp(-3.5 * s))), 1e-14);
}

struct FoundPath {
  PointStructure structure;
  PointFit fit;
  Eigen::VectorXd std;
};

// In a record of the duct whose flame answers by this path, by a structure that has the like.
FoundPath FindPath(const ModalLoop& loop, double cycle_hz, const FlamePath& path) {
  const RecordSpectra spectra =
      MakeRecordSpectra(DrawnRecord(loop, path, 1.5, 9), cycle_hz, FlameInput::kPressureRate);
  FoundPath out{FreeStructure(2)};
  out.structure.delay_spread = path.spread;
  out.structure.second_path = path.second.has_value();
  out.structure.noise = {{LoopNoise::kCombustion, 2}, {LoopNoise::kDuct, 2}};
  const PointPrior prior = PriorOf(out.structure, spectra);
  out.fit = FitPoint(spectra, out.structure, prior, StartsOf(spectra, out.structure, prior, 8, 1));
  EXPECT_TRUE(out.fit.converged);
  out.std = out.fit.Covariance().diagonal().cwiseSqrt();
  return out;
}

TEST(FlamePath, SpreadIsFoundInRecords) {
  const ModalLoop loop = BroadDuct();
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  for (const DelaySpread spread : {DelaySpread::kNormal, DelaySpread::kGamma}) {
    const double rho = 0.15;
    const auto [structure, fit, errors] = FindPath(loop, cycle_hz, {spread, loop.tau_s, rho});
    const Eigen::Index delay = structure.Delay();
    const double tau = loop.tau_s * 2.0 * std::numbers::pi * cycle_hz;
    EXPECT_LT(std::abs(fit.parameters[delay] - std::log(tau)), 4.0 * errors[delay]);
    EXPECT_LT(std::abs(fit.parameters[delay + 1] - std::log(rho)), 4.0 * errors[delay + 1]);
    EXPECT_LT(errors[delay], 0.05);
    EXPECT_LT(errors[delay + 1], 0.3);
  }
}

TEST(FlamePath, SecondIsFoundInRecords) {
  const ModalLoop loop = BroadDuct();
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  const double radian_s = 1.0 / (2.0 * std::numbers::pi * cycle_hz);
  for (const double share : {0.3, -0.4}) {
    const double lambda = 2.0;
    const auto [structure, fit, errors] =
        FindPath(loop, cycle_hz,
                 {DelaySpread::kNone, loop.tau_s, 0.0, SecondPath{share, lambda * radian_s}});
    const Eigen::Index delay = structure.Delay();
    const Eigen::Index second = structure.SecondPath();
    EXPECT_LT(std::abs(fit.parameters[delay] - std::log(loop.tau_s / radian_s)),
              4.0 * errors[delay]);
    EXPECT_LT(std::abs(fit.parameters[second] - share), 4.0 * errors[second]);
    EXPECT_LT(std::abs(fit.parameters[second + 1] - std::log(lambda)), 4.0 * errors[second + 1]);
    EXPECT_LT(errors[second], 0.1);
    EXPECT_LT(errors[second + 1], 0.2);
  }
}

}  // namespace
}  // namespace howl::flame_path_test
