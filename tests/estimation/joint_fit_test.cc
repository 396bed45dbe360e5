#include "estimation/fit/joint_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <random>

#include "estimation/analysis/loop/closed_form.h"
#include "estimation/family/problem/membership.h"
#include "model/numerics/constants.h"
#include "tests/r228.h"

namespace howl::joint_fit_test {
namespace {

ResidualSet WithoutPriors() {
  ResidualSet residuals = DefaultResidualSet();
  for (const ResidualKind prior : {ResidualKind::kOmegaPrior, ResidualKind::kXiIncreasing,
                                   ResidualKind::kDampingPrior, ResidualKind::kTauPrior}) {
    residuals[prior].enabled = false;
  }
  return residuals;
}

const FitParameter& Find(const JointFit& fit, const std::string& name) {
  for (const FitParameter& parameter : fit.parameters) {
    if (parameter.name == name) return parameter;
  }
  ADD_FAILURE() << "no parameter " << name;
  return fit.parameters.front();
}

TEST(ClosedForm, DelaysOfThePapersTable) {
  // notes to the paper, item 4.
  const std::vector<double> expected_ms = {3.338, 3.461, 3.452, 3.437, 3.459, 3.511};
  const std::vector<Experiment> experiments = R228();
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    EXPECT_NEAR(1e3 * DelayFromPhase(experiments[i].frequency_hz, experiments[i].phase_deg),
                expected_ms[i], 0.0005);
  }
}

TEST(JointFit, PublishedTableIsFittedWithinItsTolerances) {
  const JointProblem problem(R228(), DefaultModelSpec(), DefaultResidualSet());
  const JointFit fit = SolveJoint(problem, {}, 1, 2);
  EXPECT_TRUE(fit.converged) << fit.termination;
  EXPECT_EQ(fit.starts_at_best, fit.starts);
  EXPECT_TRUE(IsMember(problem.experiments(), fit.models, {}));
  // p lags q, so the natural frequency lies below the limit cycle's (section 3.3).
  for (std::size_t i = 0; i < fit.models.size(); ++i) {
    EXPECT_LT(fit.models[i].omega_hz, problem.experiments()[i].frequency_hz);
  }
}

TEST(JointFit, LoopGainsOfThePublishedTable) {
  // notes to the paper, item 2: gain 2 pi f |Phi'(0)|, which every fit of the gains reproduces.
  const std::vector<double> expected = {1.179, 1.221, 1.281, 1.280, 0.940, 0.443};
  const JointProblem problem(R228(), DefaultModelSpec(), WithoutPriors());
  const JointFit fit = SolveJoint(problem, {}, 1, 1);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(ComputeErrors(problem.experiments()[i], fit.models[i]).loop_gain, expected[i],
                0.0006);
  }
}

// It was a crash.
TEST(JointFit, FailsWhereNoStartHasAFiniteCost) {
  std::vector<Experiment> experiments = R228();
  TransferPoint point;
  point.frequency_hz = experiments[0].frequency_hz;
  point.re = std::numeric_limits<double>::quiet_NaN();
  point.variance_re = point.variance_im = 1.0;
  experiments[0].transfer = {point};
  const JointProblem problem(experiments, DefaultModelSpec(), DefaultResidualSet());
  const JointFit fit = SolveJoint(problem, {}, 1, 1);
  EXPECT_FALSE(fit.converged);
  EXPECT_TRUE(std::isnan(fit.cost));
  EXPECT_THAT(fit.termination, testing::HasSubstr("not finite at any start"));
  EXPECT_EQ(fit.models.size(), experiments.size());
  EXPECT_EQ(fit.residuals.size(), problem.residuals().size());
  EXPECT_TRUE(std::isnan(JointCost(problem, fit.logs)));
}

TEST(JointFit, FailsWithoutAResidual) {
  ResidualSet none = DefaultResidualSet();
  for (const ResidualKind kind : kResidualKinds) none[kind].enabled = false;
  const JointProblem problem(R228(), DefaultModelSpec(), none);
  const JointFit fit = SolveJoint(problem, {}, 1, 1);
  EXPECT_FALSE(fit.converged);
  EXPECT_TRUE(std::isnan(fit.cost));
}

TEST(JointFit, WithoutPriorsOneDirectionAnExperimentIsFree) {
  const JointProblem problem(R228(), DefaultModelSpec(), WithoutPriors());
  const JointFit fit = SolveJoint(problem, {}, 1, 1);
  EXPECT_EQ(fit.identifiability.rank, 18);
  ASSERT_EQ(fit.identifiability.undetermined.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const UndeterminedDirection& free = fit.identifiability.undetermined[i];
    EXPECT_TRUE(std::isinf(free.log_std));
    EXPECT_THAT(free.text, testing::StartsWith("omega_hz, xi and N of exp" + std::to_string(i + 1) +
                                               " trade off along ("));
    EXPECT_TRUE(std::isinf(Find(fit, "exp" + std::to_string(i + 1) + ".xi").std_relative));
    EXPECT_TRUE(std::isfinite(Find(fit, "exp" + std::to_string(i + 1) + ".tau_s").std_relative));
    // Along the closed form of the paper's notes, item 6.
    const Experiment& experiment = problem.experiments()[i];
    const double h = 1e-6;
    const double xi = fit.models[i].xi;
    const LoopModel ahead = ClosedFormMember(experiment, xi * std::exp(h));
    const LoopModel behind = ClosedFormMember(experiment, xi * std::exp(-h));
    Eigen::Vector3d expected(std::log(ahead.omega_hz / behind.omega_hz), 2.0 * h,
                             std::log(ahead.N / behind.N));
    expected.normalize();
    // Parameters are ordered by kind, then experiment.
    const Eigen::Vector3d found(free.direction.coeff(static_cast<Eigen::Index>(i)),
                                free.direction.coeff(static_cast<Eigen::Index>(6 + i)),
                                free.direction.coeff(static_cast<Eigen::Index>(12 + i)));
    EXPECT_NEAR(std::abs(found.dot(expected)), 1.0, 1e-7);
  }
}

std::complex<double> PaperLoop(const LoopModel& m, double f);

TEST(JointFit, NonHarmonicLineDeterminesTheSecondMode) {
  ModelSpec model = DefaultModelSpec();
  model.modes = 2;
  model[ParameterKind::kM].max = 5000.0;  // (5b): small beside the first mode at the cycle
  ResidualSet residuals = DefaultResidualSet();
  residuals[ResidualKind::kDampingPrior].center = 0.2;  // sections 3.3 and 4
  residuals[ResidualKind::kDampingPrior].std = 0.5;
  residuals[ResidualKind::kSecondCrossingGain].enabled = false;  // the line's frequency alone
  std::vector<Experiment> experiments = R228();
  // By the stated standard deviations: what the data determine, not how well the model fits them.
  const auto stated_std_of_M = [](const JointProblem& problem, const JointFit& fit) {
    const Identifiability stated = IdentifiabilityAt(problem, fit.logs);
    const auto at = std::ranges::find(fit.free_names, "M") - fit.free_names.begin();
    return stated.log_std.at(static_cast<std::size_t>(at));
  };
  const JointProblem without_line(experiments, model, residuals);
  const JointFit without = SolveJoint(without_line, {}, 1, 2);
  for (Experiment& experiment : experiments) {
    if (experiment.reliable) experiment.lines = {{750.0, 10.0}};
  }
  const JointProblem with_line(experiments, model, residuals);
  const JointFit with = SolveJoint(with_line, {}, 1, 2);
  EXPECT_TRUE(with.converged);
  EXPECT_FALSE(Find(with, "M").at_bound);
  // Without the line M is free within more than a factor e; with it, it is held.
  EXPECT_GT(stated_std_of_M(without_line, without), 3.0);
  EXPECT_LT(stated_std_of_M(with_line, with), 1.0);
  // The ratio that the paper's figures 11 and 12 imply is 0.415 for experiment 1 (notes, item 9).
  EXPECT_NEAR(with.models[0].M / with.models[0].N, 0.415, 0.15);
  // Section 4 asks for magnitude above one there, which that ratio does not give (0.87, the same
  // note): with its residual the second mode grows.
  residuals[ResidualKind::kSecondCrossingGain].enabled = true;
  const JointFit loud = SolveJoint(JointProblem(experiments, model, residuals), {}, 1, 2);
  for (std::size_t i = 0; i < 4; ++i) {
    const double quiet_gain =
        std::abs(PaperLoop(with.models[i], 750.0) * *experiments[i].flame_slope);
    const double loud_gain =
        std::abs(PaperLoop(loud.models[i], 750.0) * *experiments[i].flame_slope);
    EXPECT_GT(loud_gain, quiet_gain) << i;
    EXPECT_GT(loud_gain, 0.9) << i;
  }
}

TEST(JointFit, SameAnswerWithAnyNumberOfThreads) {
  const JointProblem problem(R228(), DefaultModelSpec(), DefaultResidualSet());
  const JointFit one = SolveJoint(problem, {}, 7, 1);
  const JointFit two = SolveJoint(problem, {}, 7, 2);
  EXPECT_EQ(one.logs, two.logs);
}

TEST(JointFit, UnreliableExperimentsWeighLess) {
  const JointProblem problem(R228(), DefaultModelSpec(), DefaultResidualSet());
  int gain_blocks_of_unreliable = 0;
  for (const ResidualBlock& block : problem.residuals()) {
    const bool reliable =
        problem.experiments()[static_cast<std::size_t>(block.experiment)].reliable;
    EXPECT_EQ(block.weight, reliable ? 1.0 : 0.25) << block.label;
    if (block.kind == ResidualKind::kLimitCycleGain && !reliable) ++gain_blocks_of_unreliable;
  }
  EXPECT_EQ(gain_blocks_of_unreliable, 0);
}

TEST(JointFit, ResidualsCanBeRestrictedToExperiments) {
  ResidualSet residuals = DefaultResidualSet();
  residuals[ResidualKind::kPhaseEquality].experiments = {"exp2", "exp6"};
  const JointProblem problem(R228(), DefaultModelSpec(), residuals);
  std::vector<std::string> labels;
  for (const ResidualBlock& block : problem.residuals()) {
    if (block.kind == ResidualKind::kPhaseEquality) labels.push_back(block.label);
  }
  EXPECT_THAT(labels, testing::ElementsAre("phase_equality exp2", "phase_equality exp6"));
}

TEST(JointFit, RobustLossLimitsAnOutlier) {
  std::vector<Experiment> experiments = R228();
  for (Experiment& experiment : experiments) {
    experiment.frequency_hz = 200.0;
    experiment.phase_deg = -10.0;  // the same rig at every operating point
    experiment.gain = 12.0;
    experiment.reliable = true;
    experiment.flame_slope.reset();
  }
  experiments[1].gain *= 3.0;
  ModelSpec model = DefaultModelSpec();
  for (const ParameterKind kind : {ParameterKind::kOmega, ParameterKind::kXi, ParameterKind::kN}) {
    model[kind].scope = ParameterScope::kShared;
  }
  ResidualSet residuals = DefaultResidualSet();
  const JointFit plain = SolveJoint(JointProblem(experiments, model, residuals), {}, 1, 2);
  residuals[ResidualKind::kGainEquality].loss = LossKind::kHuber;
  const JointFit robust = SolveJoint(JointProblem(experiments, model, residuals), {}, 1, 2);
  const auto gain_error = [&](const JointFit& fit) {
    return std::abs(ComputeErrors(experiments[0], fit.models[0]).gain_error);
  };
  // Least squares of logarithms go to the geometric mean; Huber's loss pulls five against one.
  EXPECT_NEAR(gain_error(plain), std::pow(3.0, 1.0 / 6.0) - 1.0, 1e-3);
  EXPECT_NEAR(gain_error(robust), 0.01 / 5.0, 1e-4);
}

// --- Parameters drawn, characteristics computed, parameters recovered. ---

std::complex<double> PaperLoop(const LoopModel& m, double f) {
  const std::complex<double> s(0.0, 2.0 * kPi * f);
  const double w = 2.0 * kPi * m.omega_hz;
  const std::complex<double> G = m.N * s / (s * s + 2.0 * w * m.xi * s + w * w) +
                                 m.M * s / (s * s + 6.0 * w * m.xi * s + 9.0 * w * w);
  return s * G * std::exp(-m.tau_s * s);
}

// Bisection for arg L = 180 degrees in [lo, hi]; the phase of -L must fall through zero there.
double Crossing(const LoopModel& model, double lo, double hi) {
  const auto phase = [&](double f) { return std::arg(-PaperLoop(model, f)); };
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (lo + hi);
    (phase(middle) > 0.0 ? lo : hi) = middle;
  }
  return 0.5 * (lo + hi);
}

// Scans for a downward crossing between lo and hi hertz; zero when there is none.
double FindCrossing(const LoopModel& model, double lo, double hi) {
  for (double f = lo; f < hi; f += 0.5) {
    const double here = std::arg(-PaperLoop(model, f));
    const double next = std::arg(-PaperLoop(model, f + 0.5));
    if (here > 0.0 && next <= 0.0 && here - next < kPi) return Crossing(model, f, f + 0.5);
  }
  return 0.0;
}

TEST(JointFit, RecoversDrawnParameters) {
  constexpr int kDraws = 1000;
  constexpr int kExperiments = 4;
  ModelSpec model = DefaultModelSpec();
  model.modes = 2;
  model.second_mode_relative = true;
  model[ParameterKind::kOmega].scope = ParameterScope::kShared;
  model[ParameterKind::kXi].scope = ParameterScope::kShared;
  ResidualSet residuals = WithoutPriors();
  residuals[ResidualKind::kLimitCycleGain].enabled = false;
  residuals[ResidualKind::kSecondCrossingGain].enabled = false;
  int failures = 0;
  int draws = 0;
  std::mt19937_64 generator(3);
  const auto draw = [&](double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(generator);
  };
  while (draws < kDraws) {
    LoopModel shared{.omega_hz = draw(180, 220), .xi = draw(0.05, 0.25)};
    const double ratio = draw(0.2, 0.8);
    std::vector<Experiment> experiments;
    std::vector<LoopModel> truth;
    for (int i = 0; i < kExperiments; ++i) {
      LoopModel rig = shared;
      rig.N = draw(3000, 9000);
      rig.M = ratio * rig.N;
      rig.tau_s = 1e-3 * draw(3.3, 3.6);
      Experiment experiment;
      experiment.name = "exp" + std::to_string(i);
      experiment.phi = 0.5 + 0.01 * i;
      experiment.frequency_hz = FindCrossing(rig, 150.0, 300.0);
      const double line_hz = FindCrossing(rig, 600.0, 900.0);
      if (experiment.frequency_hz == 0.0 || line_hz == 0.0) break;
      const std::complex<double> s(0.0, 2.0 * kPi * experiment.frequency_hz);
      const std::complex<double> G =
          PaperLoop(rig, experiment.frequency_hz) * std::exp(rig.tau_s * s) / s;
      experiment.gain = std::abs(G);
      experiment.phase_deg = std::arg(G) * 180.0 / kPi;
      experiment.lines = {{line_hz, 0.0}};
      experiments.push_back(experiment);
      truth.push_back(rig);
    }
    if (static_cast<int>(experiments.size()) < kExperiments) continue;  // no such rig oscillates
    ++draws;
    const JointProblem problem(experiments, model, residuals);
    const JointFit fit = SolveJoint(problem, {.starts = 3}, 1, 1);
    bool recovered = fit.converged;
    for (int i = 0; i < kExperiments; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const auto close = [](double a, double b) { return std::abs(a / b - 1.0) < 1e-8; };
      recovered = recovered && close(fit.models[k].omega_hz, truth[k].omega_hz) &&
                  close(fit.models[k].xi, truth[k].xi) && close(fit.models[k].N, truth[k].N) &&
                  close(fit.models[k].M, truth[k].M) && close(fit.models[k].tau_s, truth[k].tau_s);
    }
    if (!recovered) ++failures;
  }
  RecordProperty("failures", failures);
  EXPECT_EQ(failures, 0) << "of " << kDraws;
}

}  // namespace
}  // namespace howl::joint_fit_test
