// Every residual of the registry in joint problems: its Jacobian at random points, and its value at
// points worked by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "estimation/fit/joint_problem.h"
#include "estimation/residuals/registry.h"
#include "model/numerics/constants.h"
#include "tests/residual_jacobian.h"

namespace howl::residuals_test {
namespace {

constexpr int kRandomPoints = 100;

double Draw(std::mt19937_64& generator, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(generator);
}

// All that a residual can act on: a slope, lines, a transfer.
Experiment DrawExperiment(std::mt19937_64& g, int number) {
  Experiment experiment{.name = "e" + std::to_string(number),
                        .phi = Draw(g, 0.4, 0.8),
                        .frequency_hz = Draw(g, 180, 220),
                        .phase_deg = Draw(g, -60, 60),
                        .gain = Draw(g, 5, 50),
                        .flame_slope = -Draw(g, 1e-7, 1e-4),
                        .frequency_std_hz = Draw(g, 0, 3),
                        .lines = {{Draw(g, 700, 800), Draw(g, 0, 10)}}};
  for (const double frequency_hz : {150.0, 250.0}) {
    experiment.transfer.push_back({.frequency_hz = frequency_hz,
                                   .spread_hz = 2.0,
                                   .re = Draw(g, -20, 20),
                                   .im = Draw(g, -20, 20),
                                   .variance_re = 0.5,
                                   .variance_im = 0.3,
                                   .covariance = 0.1,
                                   .q_noise_bias = 0.2});
  }
  return experiment;
}

struct Form {
  const char* name;
  int modes;
  bool relative;
  double ratio;
};

constexpr std::array kForms = {Form{"reduced", 1, false, 3.0}, Form{"full, M", 2, false, 3.0},
                               Form{"full, M over N", 2, true, 2.7}};

JointProblem DrawProblem(std::mt19937_64& g, const Form& form) {
  ModelSpec model = DefaultModelSpec();
  model.modes = form.modes;
  model.second_mode_relative = form.relative;
  model.harmonic_ratio = form.ratio;
  ResidualSet residuals = DefaultResidualSet();
  for (const ResidualKind kind : kResidualKinds) {
    residuals[kind].std *= Draw(g, 0.2, 5.0);
    residuals[kind].center *= Draw(g, 0.1, 2.0);
  }
  return {{DrawExperiment(g, 1), DrawExperiment(g, 2), DrawExperiment(g, 3)}, model, residuals};
}

// Logarithms of plausible values; the frequencies above match them.
double DrawLog(std::mt19937_64& g, const ParameterBlock& parameter) {
  if (parameter.is_q_noise) return Draw(g, -2.0, 2.0);
  switch (parameter.kind) {
    case ParameterKind::kOmega:
      return std::log(Draw(g, 170.0, 230.0));
    case ParameterKind::kXi:
      return std::log(Draw(g, 0.02, 0.5));
    case ParameterKind::kN:
      return std::log(Draw(g, 1e3, 2e4));
    case ParameterKind::kM:
      return std::log(Draw(g, 1e2, 2e4));
    case ParameterKind::kMOverN:
      return std::log(Draw(g, 0.05, 2.0));
    case ParameterKind::kTau:
      return std::log(Draw(g, 3e-3, 4e-3));
  }
  ADD_FAILURE();
  return 0.0;
}

// Residual values start as NaN, so that a block that writes nothing fails.
std::vector<double> Evaluate(const ceres::CostFunction& cost, const std::vector<double>& logs,
                             std::vector<double>* gradient = nullptr) {
  std::vector<const double*> blocks;
  for (const double& log : logs) blocks.push_back(&log);
  const auto rows = static_cast<std::size_t>(cost.num_residuals());
  std::vector<double> residuals(rows, std::nan(""));
  if (gradient == nullptr) {
    EXPECT_TRUE(cost.Evaluate(blocks.data(), residuals.data(), nullptr));
    return residuals;
  }
  EXPECT_EQ(rows, 1u);
  gradient->assign(logs.size(), std::nan(""));
  std::vector<double*> jacobians;
  for (double& derivative : *gradient) jacobians.push_back(&derivative);
  EXPECT_TRUE(cost.Evaluate(blocks.data(), residuals.data(), jacobians.data()));
  return residuals;
}

// One-sided residuals have a kink and wrapped phases a jump, across which differences mean nothing:
// true where one lies within the reach of the numeric derivative.
bool NearKinkOrJump(const ceres::CostFunction& cost, std::vector<double> logs) {
  constexpr double kReach = 0.01;
  const std::vector<double> here = Evaluate(cost, logs);
  for (double& log : logs) {
    const double kept = log;
    log = kept + kReach;
    const std::vector<double> ahead = Evaluate(cost, logs);
    log = kept - kReach;
    const std::vector<double> behind = Evaluate(cost, logs);
    log = kept;
    for (std::size_t r = 0; r < here.size(); ++r) {
      // Second differences of a smooth residual are far smaller than first ones at this reach.
      if (std::abs(ahead[r] - 2.0 * here[r] + behind[r]) >
          0.5 * std::abs(ahead[r] - behind[r]) + 0.01) {
        return true;
      }
    }
  }
  return false;
}

TEST(Residuals, JacobiansOfAllAreCorrectAtRandomPoints) {
  for (const Form& form : kForms) {
    std::mt19937_64 generator(1);
    std::map<ResidualKind, int> checked;
    for (int round = 0; round < kRandomPoints; ++round) {
      const JointProblem problem = DrawProblem(generator, form);
      for (const ResidualBlock& block : problem.residuals()) {
        SCOPED_TRACE(block.label + ", " + form.name);
        std::vector<double> logs;
        for (const int index : block.parameters) {
          logs.push_back(DrawLog(generator, problem.parameters()[static_cast<std::size_t>(index)]));
        }
        if (NearKinkOrJump(*block.cost, logs)) continue;
        EXPECT_CORRECT_JACOBIAN(*block.cost, logs);
        ++checked[block.kind];
      }
    }
    for (const ResidualKind kind : kResidualKinds) {
      const bool there = form.modes == 2 || !DefinitionOf(kind).needs_two_modes;
      EXPECT_GE(checked[kind], there ? kRandomPoints : 0) << ResidualName(kind) << " " << form.name;
    }
  }
}

TEST(Residuals, DefinitionsAreComplete) {
  std::set<std::string_view> names;
  for (const ResidualKind kind : kResidualKinds) {
    const ResidualDefinition& definition = DefinitionOf(kind);
    SCOPED_TRACE(ResidualName(kind));
    EXPECT_TRUE(names.insert(ResidualName(kind)).second);
    EXPECT_NE(definition.text, "");
    EXPECT_NE(definition.equation, "");
    EXPECT_NE(definition.std.text, "");
    EXPECT_GT(definition.std.value, 0.0);
    EXPECT_THAT((std::set<std::string_view>{"std", "std_deg", "std_relative"}),
                testing::Contains(definition.std.key));
    EXPECT_NE(definition.add_to == nullptr, definition.add_across == nullptr);
  }
}

// Parameters in natural units, by their names in the problem.
using Values = std::map<std::string, double>;

std::vector<double> LogsOf(const JointProblem& problem, const ResidualBlock& block,
                           const Values& values) {
  std::vector<double> logs;
  for (const int index : block.parameters) {
    logs.push_back(std::log(values.at(problem.parameters()[static_cast<std::size_t>(index)].name)));
  }
  return logs;
}

// The residuals of one kind at these parameters.
std::vector<double> ResidualsOf(ResidualKind kind, const JointProblem& problem,
                                const Values& values) {
  std::vector<double> found;
  for (const ResidualBlock& block : problem.residuals()) {
    if (block.kind != kind) continue;
    for (const double residual : Evaluate(*block.cost, LogsOf(problem, block, values))) {
      found.push_back(residual);
    }
  }
  return found;
}

// Of a problem of one experiment, where there is one.
double ResidualOf(ResidualKind kind, const JointProblem& problem, const Values& values) {
  const std::vector<double> all = ResidualsOf(kind, problem, values);
  EXPECT_EQ(all.size(), 1u);
  return all.size() == 1 ? all[0] : std::nan("");
}

ModelSpec OneMode() { return DefaultModelSpec(); }

ModelSpec TwoModes(bool relative = false) {
  ModelSpec model = DefaultModelSpec();
  model.modes = 2;
  model.second_mode_relative = relative;
  return model;
}

ResidualSet With(ResidualKind kind, double std, double center = 0.0) {
  ResidualSet residuals = DefaultResidualSet();
  residuals[kind].std = std;
  residuals[kind].center = center;
  return residuals;
}

Experiment At(double frequency_hz, double gain = 12.0, double phase_deg = 0.0) {
  return {.name = "e", .frequency_hz = frequency_hz, .phase_deg = phase_deg, .gain = gain};
}

Values Loop(double omega_hz, double xi, double N, double M = 0.0, double tau_s = 3.4e-3) {
  return {{"e.omega_hz", omega_hz}, {"e.xi", xi},      {"e.N", N}, {"M", M},
          {"M_over_N", M / N},      {"e.tau_s", tau_s}};
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
  const Values values = Loop(200.0, 0.2, 6000.0, 2500.0);
  const std::complex<double> G = PaperAcoustics(200.0, 0.2, 6000.0, 2500.0, 3.0, 215.0);
  const JointProblem problem({At(215.0, 12.0, -10.0)}, TwoModes(), DefaultResidualSet());
  EXPECT_NEAR(ResidualOf(ResidualKind::kGainEquality, problem, values),
              std::log(std::abs(G) / 12.0) / 0.01, 1e-9);
  EXPECT_NEAR(ResidualOf(ResidualKind::kPhaseEquality, problem, values),
              (std::arg(G) * 180.0 / kPi + 10.0) / 0.5, 1e-9);
}

TEST(Residuals, ReducedFormIsThePapersClosedForm) {
  // (5c): at omega = f the phase is zero and the gain is N / (2 xi omega).
  const double peak = 6000.0 / (2.0 * 0.2 * 2.0 * kPi * 200.0);
  const JointProblem problem({At(200.0, peak)}, OneMode(), DefaultResidualSet());
  const Values values = Loop(200.0, 0.2, 6000.0);
  EXPECT_NEAR(ResidualOf(ResidualKind::kPhaseEquality, problem, values), 0.0, 1e-12);
  EXPECT_NEAR(ResidualOf(ResidualKind::kGainEquality, problem, values), 0.0, 1e-10);
}

// A measured gain of error 0.6 in 12, and a phase of error 2 degrees, come before the defaults.
TEST(Residuals, ErrorsOfTheDataTakeTheDefaultsPlace) {
  Experiment experiment = At(200.0, 12.0, -3.0);
  experiment.gain_std = 0.6;
  experiment.phase_std_deg = 2.0;
  const JointProblem problem({experiment}, OneMode(), DefaultResidualSet());
  const double N = 2.0 * 12.0 * 2.0 * 0.2 * 2.0 * kPi * 200.0;  // twice the gain, no phase
  EXPECT_NEAR(ResidualOf(ResidualKind::kGainEquality, problem, Loop(200.0, 0.2, N)),
              std::log(2.0) / 0.05, 1e-9);
  EXPECT_NEAR(ResidualOf(ResidualKind::kPhaseEquality, problem, Loop(200.0, 0.2, N)), 1.5, 1e-9);
}

TEST(Residuals, PhaseWrapsAcrossHalfATurn) {
  // The model's phase is 0 degrees; a measured one of 359 degrees is 1 degree away, not 359.
  const JointProblem problem({At(200.0, 12.0, 359.0)}, OneMode(),
                             With(ResidualKind::kPhaseEquality, 1.0));
  EXPECT_NEAR(ResidualOf(ResidualKind::kPhaseEquality, problem, Loop(200.0, 0.2, 6000.0)), 1.0,
              1e-9);
}

TEST(Residuals, LimitCyclePhaseVanishesAtThePapersDelay) {
  // With the phase of G zero, (3) gives tau = 270 / (360 f).
  const double tau_s = 270.0 / 360.0 / 200.0;
  const JointProblem problem({At(200.0)}, OneMode(), DefaultResidualSet());
  const auto residual = [&](double tau) {
    return ResidualOf(ResidualKind::kLimitCyclePhase, problem, Loop(200.0, 0.2, 6000.0, 0.0, tau));
  };
  EXPECT_NEAR(residual(tau_s), 0.0, 1e-9);
  // One per cent more delay turns the phase back by 2.7 degrees.
  EXPECT_NEAR(residual(1.01 * tau_s), -2.7, 1e-9);
}

TEST(Residuals, DelayDerivativeIsExactAndNotZero) {
  // d(arg L) / d(log tau) = -360 f tau degrees, whatever the acoustics.
  std::mt19937_64 generator(2);
  for (int point = 0; point < kRandomPoints; ++point) {
    const double f = Draw(generator, 180.0, 800.0);
    const JointProblem problem({At(f)}, TwoModes(), DefaultResidualSet());
    for (const ResidualBlock& block : problem.residuals()) {
      if (block.kind != ResidualKind::kLimitCyclePhase) continue;
      const double tau_s = Draw(generator, 3e-3, 4e-3);
      const Values values =
          Loop(Draw(generator, 170, 230), Draw(generator, 0.02, 0.5), 6000.0, 2500.0, tau_s);
      std::vector<double> gradient;
      Evaluate(*block.cost, LogsOf(problem, block, values), &gradient);
      const double expected = -360.0 * f * tau_s;
      EXPECT_NEAR(gradient.back(), expected, 1e-9 * std::abs(expected));
    }
  }
}

TEST(Residuals, LimitCycleGainIsOneSided) {
  const double gain = std::abs(PaperAcoustics(200.0, 0.2, 6000.0, 0.0, 3.0, 200.0));
  const double critical_slope = -1.0 / (gain * 2.0 * kPi * 200.0);
  const auto residual = [&](double share) {
    Experiment experiment = At(200.0);
    experiment.flame_slope = share * critical_slope;
    const JointProblem problem({experiment}, OneMode(), DefaultResidualSet());
    return ResidualOf(ResidualKind::kLimitCycleGain, problem, Loop(200.0, 0.2, 6000.0));
  };
  EXPECT_EQ(residual(1.2), 0.0);
  EXPECT_NEAR(residual(0.8), 0.2 / 0.05, 1e-9);
}

// The loop's phase at the line, by std::complex, over a deviation that carries the line's own. With
// the phase of G zero at 200 Hz, (3) gives a delay of 3.75 ms, which turns the phase by 1.35
// degrees per hertz.
TEST(Residuals, SecondCrossingCarriesTheLinesOwnError) {
  Experiment experiment = At(200.0);
  experiment.lines = {{750.0, 10.0}};
  const JointProblem problem({experiment}, TwoModes(), DefaultResidualSet());
  const double tau_s = 3.4e-3;
  const std::complex<double> s(0.0, 2.0 * kPi * 750.0);
  const std::complex<double> L =
      -s * PaperAcoustics(200.0, 0.2, 6000.0, 2500.0, 3.0, 750.0) * std::exp(-s * tau_s);
  EXPECT_NEAR(
      ResidualOf(ResidualKind::kSecondCrossing, problem, Loop(200.0, 0.2, 6000.0, 2500.0, tau_s)),
      std::arg(L) * 180.0 / kPi / std::hypot(5.0, 13.5), 1e-9);
}

// The modes' contributions by std::complex, one at a time.
TEST(Residuals, SecondModeMinorIsTheShareBeyondWhatIsAllowed) {
  const double share = std::abs(PaperAcoustics(200.0, 0.2, 0.0, 9000.0, 3.0, 215.0)) /
                       std::abs(PaperAcoustics(200.0, 0.2, 6000.0, 0.0, 3.0, 215.0));
  const auto residual = [&](double share_max) {
    const JointProblem problem({At(215.0)}, TwoModes(),
                               With(ResidualKind::kSecondModeMinor, 0.01, share_max));
    return ResidualOf(ResidualKind::kSecondModeMinor, problem, Loop(200.0, 0.2, 6000.0, 9000.0));
  };
  EXPECT_NEAR(residual(0.5 * share), 0.5 * share / 0.01, 1e-9);
  EXPECT_EQ(residual(1.01 * share), 0.0);
}

// The paper's section 4 (omega 215 Hz, xi 0.2, M / N 0.415 and 0.75, N 6609, slope 0.703e-4 of
// experiment 1): reading note 9 gives the gain 0.87 at the second crossing, and one above one.
TEST(Residuals, SecondCrossingGainAsksForMoreThanOne) {
  const double line_hz = 750.0;
  Experiment experiment = At(219.9);
  experiment.flame_slope = -0.703e-4;
  experiment.lines = {{line_hz, 10.0}};
  const JointProblem problem({experiment}, TwoModes(true), DefaultResidualSet());
  const auto residual = [&](double ratio) {
    return ResidualOf(ResidualKind::kSecondCrossingGain, problem,
                      Loop(215.0, 0.2, 6609.0, ratio * 6609.0));
  };
  const double gain = std::abs(PaperAcoustics(215.0, 0.2, 6609.0, 0.415 * 6609.0, 3.0, line_hz)) *
                      2.0 * kPi * line_hz * 0.703e-4;
  EXPECT_NEAR(gain, 0.87, 0.01);
  EXPECT_NEAR(residual(0.415), (1.0 - gain) / 0.05, 1e-9);
  EXPECT_EQ(residual(0.75), 0.0);
}

TEST(Residuals, PriorsAtPointsWorkedByHand) {
  Experiment lower = At(200.0), higher = At(200.0);
  lower.name = "a", lower.phi = 0.5;
  higher.name = "b", higher.phi = 0.6;
  ResidualSet residuals = With(ResidualKind::kDampingPrior, 0.5, 0.1);
  const JointProblem problem({higher, lower}, OneMode(), residuals);
  const Values values = {{"a.omega_hz", 190.0},
                         {"b.omega_hz", 210.0},
                         {"omega_hz_mean", 200.0},
                         {"a.xi", 0.2},
                         {"b.xi", 0.1}};
  const std::vector<double> omega = ResidualsOf(ResidualKind::kOmegaPrior, problem, values);
  ASSERT_EQ(omega.size(), 2u);
  EXPECT_NEAR(omega[0], std::log(1.05) / 0.05, 1e-12);
  EXPECT_NEAR(omega[1], std::log(0.95) / 0.05, 1e-12);
  EXPECT_NEAR(ResidualOf(ResidualKind::kXiIncreasing, problem, values), 0.1 / 0.02, 1e-12);
  EXPECT_EQ(ResidualOf(ResidualKind::kXiIncreasing, problem, {{"a.xi", 0.1}, {"b.xi", 0.2}}), 0.0);
  const std::vector<double> damping = ResidualsOf(ResidualKind::kDampingPrior, problem, values);
  ASSERT_EQ(damping.size(), 2u);
  EXPECT_NEAR(damping[0], 0.0, 1e-12);
  EXPECT_NEAR(damping[1], std::log(2.0) / 0.5, 1e-12);
}

// One point by hand: G = 5 against H = 3j, a variance of 4 and 1; the model's own error is off.
TEST(Residuals, TransferIsTheWhitenedDifferenceAndItsNoiseHasAPrior) {
  Experiment experiment = At(100.0);
  experiment.transfer = {
      {.frequency_hz = 100.0, .im = 3.0, .variance_re = 4.0, .variance_im = 1.0}};
  const JointProblem problem({experiment}, OneMode(), With(ResidualKind::kTransfer, 1e-9));
  Values values = Loop(100.0, 0.1, 5.0 * 0.2 * 200.0 * kPi);
  values["e.q_noise"] = std::exp(0.7);
  const std::vector<double> residuals = ResidualsOf(ResidualKind::kTransfer, problem, values);
  ASSERT_EQ(residuals.size(), 3u);
  EXPECT_NEAR(residuals[0], 5.0 / 2.0, 1e-9);
  EXPECT_NEAR(residuals[1], -3.0, 1e-9);
  EXPECT_NEAR(residuals[2], 0.7, 1e-12);
}

}  // namespace
}  // namespace howl::residuals_test
