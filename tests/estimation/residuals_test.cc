#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "estimation/residuals/constant_prior.h"
#include "estimation/residuals/damping_prior.h"
#include "estimation/residuals/gain_equality.h"
#include "estimation/residuals/limit_cycle_gain.h"
#include "estimation/residuals/limit_cycle_phase.h"
#include "estimation/residuals/phase_equality.h"
#include "estimation/residuals/second_crossing.h"
#include "estimation/residuals/second_crossing_gain.h"
#include "estimation/residuals/second_mode_minor.h"
#include "estimation/residuals/xi_increasing.h"
#include "tests/residual_jacobian.h"

namespace howl {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kRandomPoints = 100;

using CostPtr = std::unique_ptr<ceres::CostFunction>;

// A block, and the order of its parameters by first letters: omega, xi, N, second mode, tau.
struct Block {
  std::string name;
  std::string order;
  std::function<CostPtr(std::mt19937_64&)> create;
};

double Draw(std::mt19937_64& generator, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(generator);
}

// Logarithms of plausible values; the frequencies below match them.
std::vector<double> DrawLogs(std::mt19937_64& generator, const std::string& order) {
  std::vector<double> logs;
  for (const char c : order) {
    switch (c) {
      case 'w':
        logs.push_back(std::log(Draw(generator, 170.0, 230.0)));
        break;
      case 'x':
        logs.push_back(std::log(Draw(generator, 0.02, 0.5)));
        break;
      case 'N':
        logs.push_back(std::log(Draw(generator, 1e3, 2e4)));
        break;
      case 'M':
        logs.push_back(std::log(Draw(generator, 1e2, 2e4)));
        break;
      case 'm':
        logs.push_back(std::log(Draw(generator, 0.05, 2.0)));
        break;
      case 't':
        logs.push_back(std::log(Draw(generator, 3e-3, 4e-3)));
        break;
      default:
        ADD_FAILURE() << c;
    }
  }
  return logs;
}

template <typename Residual, typename Functor>
void AddAllForms(const std::string& name, const std::string& tail,
                 std::function<Functor(std::mt19937_64&)> draw, std::vector<Block>& blocks) {
  blocks.push_back({name + " reduced", "wxN" + tail, [draw](std::mt19937_64& generator) {
                      return CostPtr(Residual::CreateReduced(draw(generator)));
                    }});
  blocks.push_back({name + " full, M", "wxNM" + tail, [draw](std::mt19937_64& generator) {
                      return CostPtr(Residual::CreateFull(draw(generator), {3.0, false}));
                    }});
  blocks.push_back({name + " full, M over N", "wxNm" + tail, [draw](std::mt19937_64& generator) {
                      return CostPtr(Residual::CreateFull(draw(generator), {2.7, true}));
                    }});
}

std::vector<Block> AllBlocks() {
  std::vector<Block> blocks;
  AddAllForms<GainEqualityResidual, GainEquality>(
      "gain_equality", "",
      [](auto& g) {
        return GainEquality{Draw(g, 180, 220), Draw(g, 5, 50), Draw(g, 0.005, 0.1)};
      },
      blocks);
  AddAllForms<PhaseEqualityResidual, PhaseEquality>(
      "phase_equality", "",
      [](auto& g) {
        return PhaseEquality{Draw(g, 180, 220), Draw(g, -60, 60), Draw(g, 0.1, 5)};
      },
      blocks);
  AddAllForms<LimitCycleGainResidual, LimitCycleGain>(
      "limit_cycle_gain", "",
      [](auto& g) {
        return LimitCycleGain{Draw(g, 180, 220), -Draw(g, 1e-7, 1e-4), Draw(g, 0.01, 0.1)};
      },
      blocks);
  AddAllForms<LimitCyclePhaseResidual, LimitCyclePhase>(
      "limit_cycle_phase", "t",
      [](auto& g) {
        return LimitCyclePhase{Draw(g, 180, 220), Draw(g, 0.1, 5)};
      },
      blocks);
  AddAllForms<LimitCyclePhaseResidual, LimitCyclePhase>(
      "second_crossing", "t",
      [](auto& g) { return SecondCrossing(Draw(g, 700, 800), Draw(g, 0, 10), 3.4e-3, 5.0); },
      blocks);
  AddAllForms<LimitCycleGainResidual, LimitCycleGain>(
      "second_crossing_gain", "",
      [](auto& g) {
        return SecondCrossingGain(Draw(g, 700, 800), -Draw(g, 1e-6, 1e-4), Draw(g, 0.01, 0.1));
      },
      blocks);
  for (const bool relative : {false, true}) {
    blocks.push_back({relative ? "second_mode_minor, M over N" : "second_mode_minor, M",
                      relative ? "wxNm" : "wxNM", [relative](auto& g) {
                        return CostPtr(SecondModeMinorResidual::CreateFull(
                            {Draw(g, 180, 220), Draw(g, 0.001, 0.2), Draw(g, 0.01, 0.1)},
                            {relative ? 2.7 : 3.0, relative}));
                      }});
  }
  blocks.push_back({"omega_prior", "ww",
                    [](auto& g) { return CostPtr(ConstantPrior::Create(Draw(g, 0.01, 1))); }});
  blocks.push_back({"tau_prior", "tt",
                    [](auto& g) { return CostPtr(ConstantPrior::Create(Draw(g, 0.01, 1))); }});
  blocks.push_back({"xi_increasing", "xx",
                    [](auto& g) { return CostPtr(XiIncreasing::Create(Draw(g, 0.01, 1))); }});
  blocks.push_back({"damping_prior", "x", [](auto& g) {
                      return CostPtr(DampingPrior::Create(Draw(g, 0.05, 0.3), Draw(g, 0.1, 1)));
                    }});
  return blocks;
}

// Residual values start as NaN, so that a block that writes nothing fails.
double Evaluate(const ceres::CostFunction& cost, const std::vector<double>& logs,
                std::vector<double>* gradient = nullptr) {
  std::vector<const double*> blocks;
  for (const double& log : logs) blocks.push_back(&log);
  double residual = std::nan("");
  std::vector<double> derivative(logs.size(), std::nan(""));
  std::vector<double*> jacobians;
  for (double& d : derivative) jacobians.push_back(&d);
  EXPECT_TRUE(cost.Evaluate(blocks.data(), &residual, jacobians.data()));
  if (gradient != nullptr) *gradient = derivative;
  return residual;
}

// One-sided residuals have a kink and wrapped phases a jump, across which differences mean nothing:
// true where one lies within the reach of the numeric derivative.
bool NearKinkOrJump(const ceres::CostFunction& cost, std::vector<double> logs) {
  constexpr double kReach = 0.01;
  const double here = Evaluate(cost, logs);
  for (double& log : logs) {
    const double kept = log;
    log = kept + kReach;
    const double ahead = Evaluate(cost, logs);
    log = kept - kReach;
    const double behind = Evaluate(cost, logs);
    log = kept;
    // Second differences of a smooth residual are far smaller than first ones at this reach.
    if (std::abs(ahead - 2.0 * here + behind) > 0.5 * std::abs(ahead - behind) + 0.01) return true;
  }
  return false;
}

TEST(Residuals, JacobiansAreCorrectAtRandomPoints) {
  for (const Block& block : AllBlocks()) {
    SCOPED_TRACE(block.name);
    std::mt19937_64 generator(1);
    for (int point = 0; point < kRandomPoints;) {
      const CostPtr cost = block.create(generator);
      const std::vector<double> logs = DrawLogs(generator, block.order);
      if (NearKinkOrJump(*cost, logs)) continue;
      EXPECT_CORRECT_JACOBIAN(*cost, logs);
      ++point;
    }
  }
}

// The paper's equations with std::complex and no code of model/.
std::complex<double> PaperAcoustics(double omega_hz, double xi, double N, double M, double ratio,
                                    double f) {
  const std::complex<double> s(0.0, 2.0 * kPi * f);
  const double w = 2.0 * kPi * omega_hz;
  const double v = ratio * w;
  return N * s / (s * s + 2.0 * w * xi * s + w * w) + M * s / (s * s + 2.0 * v * xi * s + v * v);
}

TEST(Residuals, GainAndPhaseMatchThePapersFullForm) {
  const std::vector<double> logs = {std::log(200.0), std::log(0.2), std::log(6000.0),
                                    std::log(2500.0)};
  const std::complex<double> G = PaperAcoustics(200.0, 0.2, 6000.0, 2500.0, 3.0, 215.0);
  const CostPtr gain(GainEqualityResidual::CreateFull({215.0, 12.0, 0.01}, {}));
  EXPECT_NEAR(Evaluate(*gain, logs), std::log(std::abs(G) / 12.0) / 0.01, 1e-9);
  const CostPtr phase(PhaseEqualityResidual::CreateFull({215.0, -10.0, 0.5}, {}));
  EXPECT_NEAR(Evaluate(*phase, logs), (std::arg(G) * 180.0 / kPi + 10.0) / 0.5, 1e-9);
}

TEST(Residuals, ReducedFormIsThePapersClosedForm) {
  // (5c): at omega = f the phase is zero and the gain is N / (2 xi omega).
  const std::vector<double> logs = {std::log(200.0), std::log(0.2), std::log(6000.0)};
  const CostPtr phase(PhaseEqualityResidual::CreateReduced({200.0, 0.0, 1.0}));
  EXPECT_NEAR(Evaluate(*phase, logs), 0.0, 1e-12);
  const double peak = 6000.0 / (2.0 * 0.2 * 2.0 * kPi * 200.0);
  const CostPtr gain(GainEqualityResidual::CreateReduced({200.0, peak, 0.01}));
  EXPECT_NEAR(Evaluate(*gain, logs), 0.0, 1e-10);
}

TEST(Residuals, PhaseWrapsAcrossHalfATurn) {
  // The model's phase is 0 degrees; a measured one of 359 degrees is 1 degree away, not 359.
  const std::vector<double> logs = {std::log(200.0), std::log(0.2), std::log(6000.0)};
  const CostPtr phase(PhaseEqualityResidual::CreateReduced({200.0, 359.0, 1.0}));
  EXPECT_NEAR(Evaluate(*phase, logs), 1.0, 1e-9);
}

TEST(Residuals, LimitCyclePhaseVanishesAtThePapersDelay) {
  // With the phase of G zero, (3) gives tau = 270 / (360 f).
  const double tau_s = 270.0 / 360.0 / 200.0;
  const CostPtr phase(LimitCyclePhaseResidual::CreateReduced({200.0, 1.0}));
  std::vector<double> logs = {std::log(200.0), std::log(0.2), std::log(6000.0), std::log(tau_s)};
  EXPECT_NEAR(Evaluate(*phase, logs), 0.0, 1e-9);
  // One per cent more delay turns the phase back by 2.7 degrees.
  logs[3] = std::log(1.01 * tau_s);
  EXPECT_NEAR(Evaluate(*phase, logs), -2.7, 1e-9);
}

TEST(Residuals, DelayDerivativeIsExactAndNotZero) {
  // d(arg L) / d(log tau) = -360 f tau degrees, whatever the acoustics.
  std::mt19937_64 generator(2);
  for (int point = 0; point < kRandomPoints; ++point) {
    const double f = Draw(generator, 180.0, 800.0);
    const CostPtr cost(LimitCyclePhaseResidual::CreateFull({f, 1.0}, {}));
    const std::vector<double> logs = DrawLogs(generator, "wxNMt");
    std::vector<double> gradient;
    Evaluate(*cost, logs, &gradient);
    const double expected = -360.0 * f * std::exp(logs[4]);
    EXPECT_NEAR(gradient[4], expected, 1e-9 * std::abs(expected));
  }
}

TEST(Residuals, LimitCycleGainIsOneSided) {
  const std::vector<double> logs = {std::log(200.0), std::log(0.2), std::log(6000.0)};
  const double gain = std::abs(PaperAcoustics(200.0, 0.2, 6000.0, 0.0, 3.0, 200.0));
  const double critical_slope = -1.0 / (gain * 2.0 * kPi * 200.0);
  const CostPtr above(LimitCycleGainResidual::CreateReduced({200.0, 1.2 * critical_slope, 0.05}));
  EXPECT_EQ(Evaluate(*above, logs), 0.0);
  const CostPtr below(LimitCycleGainResidual::CreateReduced({200.0, 0.8 * critical_slope, 0.05}));
  EXPECT_NEAR(Evaluate(*below, logs), 0.2 / 0.05, 1e-9);
}

TEST(Residuals, SecondCrossingCarriesTheLinesOwnError) {
  // 3.4 ms of delay turn the phase by 1.224 degrees per hertz.
  const LimitCyclePhase crossing = SecondCrossing(750.0, 10.0, 3.4e-3, 5.0);
  EXPECT_NEAR(crossing.std_deg, std::sqrt(25.0 + 12.24 * 12.24), 1e-12);
}

// The modes' contributions by std::complex, one at a time.
TEST(Residuals, SecondModeMinorIsTheShareBeyondWhatIsAllowed) {
  const std::vector<double> logs = {std::log(200.0), std::log(0.2), std::log(6000.0),
                                    std::log(9000.0)};
  const double share = std::abs(PaperAcoustics(200.0, 0.2, 0.0, 9000.0, 3.0, 215.0)) /
                       std::abs(PaperAcoustics(200.0, 0.2, 6000.0, 0.0, 3.0, 215.0));
  const CostPtr above(SecondModeMinorResidual::CreateFull({215.0, 0.5 * share, 0.01}, {}));
  EXPECT_NEAR(Evaluate(*above, logs), 0.5 * share / 0.01, 1e-9);
  const CostPtr below(SecondModeMinorResidual::CreateFull({215.0, 1.01 * share, 0.01}, {}));
  EXPECT_EQ(Evaluate(*below, logs), 0.0);
}

// The paper's section 4 (omega 215 Hz, xi 0.2, M / N 0.415 and 0.75, N 6609, slope 0.703e-4 of
// experiment 1): reading note 9 gives the gain 0.87 at the second crossing, and one above one.
TEST(Residuals, SecondCrossingGainAsksForMoreThanOne) {
  const double line_hz = 750.0;
  const auto residual = [&](double ratio) {
    const CostPtr cost(LimitCycleGainResidual::CreateFull(
        SecondCrossingGain(line_hz, -0.703e-4, 0.05), {3.0, true}));
    return Evaluate(*cost, {std::log(215.0), std::log(0.2), std::log(6609.0), std::log(ratio)});
  };
  const double gain = std::abs(PaperAcoustics(215.0, 0.2, 6609.0, 0.415 * 6609.0, 3.0, line_hz)) *
                      2.0 * kPi * line_hz * 0.703e-4;
  EXPECT_NEAR(gain, 0.87, 0.01);
  EXPECT_NEAR(residual(0.415), (1.0 - gain) / 0.05, 1e-9);
  EXPECT_EQ(residual(0.75), 0.0);
}

TEST(Residuals, PriorsAtPointsWorkedByHand) {
  const CostPtr omega(ConstantPrior::Create(0.05));
  EXPECT_NEAR(Evaluate(*omega, {std::log(210.0), std::log(200.0)}), std::log(1.05) / 0.05, 1e-12);
  const CostPtr order(XiIncreasing::Create(0.02));
  EXPECT_EQ(Evaluate(*order, {std::log(0.1), std::log(0.2)}), 0.0);
  EXPECT_NEAR(Evaluate(*order, {std::log(0.2), std::log(0.1)}), 5.0, 1e-12);
  const CostPtr damping(DampingPrior::Create(0.1, 0.5));
  EXPECT_NEAR(Evaluate(*damping, {std::log(0.1)}), 0.0, 1e-12);
  EXPECT_NEAR(Evaluate(*damping, {std::log(0.2)}), std::log(2.0) / 0.5, 1e-12);
}

}  // namespace
}  // namespace howl
