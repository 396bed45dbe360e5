// One problem run slower or faster and recorded in other units gives the same answers for the same
// work: times scale by 1 / a, p by b, q by c. See tests/model/scaling_test.cc for the loop itself.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "estimation/analysis/analyse.h"
#include "estimation/family/answers/tradeoff.h"
#include "estimation/family/bounds/enclose.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/members/sample.h"
#include "estimation/fit/joint_fit.h"
#include "tests/estimation/analysis/synthetic_record.h"
#include "tests/r228.h"

namespace howl::scaling_test {
namespace {

struct Units {
  double a = 1.0;  // of rates
  double b = 1.0;  // of p
  double c = 1.0;  // of q
};

std::ostream& operator<<(std::ostream& out, const Units& u) {
  return out << "a " << u.a << ", b " << u.b << ", c " << u.c;
}

// From below 1 Hz to above 100 kHz, and from 1e-6 to 1e6 in p and q; the last two are no powers of
// two.
std::vector<Units> AllUnits() {
  return {{std::exp2(-8), 1.0, 1.0},
          {std::exp2(9), 1.0, 1.0},
          {1.0, std::exp2(-20), std::exp2(20)},
          {1.0, std::exp2(20), std::exp2(-20)},
          {1.0 / 219.9, 1e-6, 1e6},
          {1e5 / 219.9, 1e6, 1e-6}};
}

std::vector<Experiment> Scaled(std::vector<Experiment> experiments, const Units& u) {
  for (Experiment& e : experiments) {
    e.frequency_hz *= u.a;
    e.gain *= u.b / u.c;
    if (e.flame_slope) *e.flame_slope *= u.c / (u.a * u.b);
    for (ObservedLine& line : e.lines) {
      line.frequency_hz *= u.a;
      line.frequency_std_hz *= u.a;
    }
  }
  return experiments;
}

// The largest relative difference of two models, with `u` taken out of the first.
double Difference(const LoopModel& got, const LoopModel& expected, const Units& u) {
  const double coefficient = u.a * u.b / u.c;
  const auto off = [](double x, double y) {
    return y == 0.0 ? std::abs(x) : std::abs(x / y - 1.0);
  };
  return std::max({off(got.omega_hz / u.a, expected.omega_hz), off(got.xi, expected.xi),
                   off(got.N / coefficient, expected.N), off(got.M / coefficient, expected.M),
                   off(got.tau_s * u.a, expected.tau_s)});
}

double UnitOf(FamilyParameter parameter, const Units& u) {
  switch (parameter) {
    case FamilyParameter::kOmega:
      return u.a;
    case FamilyParameter::kN:
    case FamilyParameter::kM:
      return u.a * u.b / u.c;
    case FamilyParameter::kTau:
      return 1.0 / u.a;
    default:
      return 1.0;
  }
}

ModelSpec TwoModes() {
  ModelSpec model = DefaultModelSpec();
  model.modes = 2;
  model.second_mode_relative = true;
  return model;
}

std::vector<Experiment> WithLines() {
  std::vector<Experiment> experiments = R228Reliable();
  experiments.resize(2);
  for (Experiment& e : experiments) e.lines.push_back({750.0, 2.0});
  return experiments;
}

void ExpectSameFit(const std::vector<Experiment>& experiments, const ModelSpec& model) {
  const auto fit = [&](const Units& u) {
    return SolveJoint(JointProblem(Scaled(experiments, u), model, DefaultResidualSet()), {}, 1, 2);
  };
  const JointFit expected = fit({});
  ASSERT_TRUE(expected.converged);
  for (const Units& u : AllUnits()) {
    const JointFit got = fit(u);
    EXPECT_TRUE(got.converged) << u;
    EXPECT_NEAR(got.cost, expected.cost, 1e-9 * (1.0 + expected.cost)) << u;
    EXPECT_EQ(got.starts_at_best, expected.starts_at_best) << u;
    EXPECT_EQ(got.identifiability.rank, expected.identifiability.rank) << u;
    for (std::size_t i = 0; i < got.models.size(); ++i) {
      EXPECT_LT(Difference(got.models[i], expected.models[i], u), 1e-6) << u;
    }
    for (std::size_t k = 0; k < got.parameters.size(); ++k) {
      EXPECT_EQ(got.parameters[k].at_bound, expected.parameters[k].at_bound) << u;
    }
  }
}

TEST(Scaling, FitOfOneMode) { ExpectSameFit(R228(), DefaultModelSpec()); }
TEST(Scaling, FitOfTwoModes) { ExpectSameFit(WithLines(), TwoModes()); }

FamilyProblem Family(const std::vector<Experiment>& experiments, const ModelSpec& model) {
  FamilyProblem problem{.experiments = experiments, .model = model};
  if (model.modes == 2) {
    problem.test.second_crossing_tolerance_deg = 30.0;
    problem.domain[ParameterKind::kMOverN].hi = 2.0;  // the branch of the paper, which has an end
  }
  return problem;
}

void ExpectSameBounds(const std::vector<Experiment>& experiments, const ModelSpec& model,
                      std::size_t max_cells) {
  const EncloseOptions options{.width = 0.02, .max_cells = max_cells, .seed = 1, .threads = 2};
  Enclosure expected(Family(experiments, model), options);
  expected.Run();
  for (const Units& u : AllUnits()) {
    Enclosure got(Family(Scaled(experiments, u), model), options);
    got.Run();
    // The same work: cells looked at.
    EXPECT_EQ(got.Counts().outside, expected.Counts().outside) << u;
    EXPECT_EQ(got.Counts().undecided, expected.Counts().undecided) << u;
    for (std::size_t i = 0; i < experiments.size(); ++i) {
      for (const FamilyParameter parameter : kFamilyParameters) {
        if (!got.IsBounded(i, parameter)) continue;
        const double unit = UnitOf(parameter, u);
        const EnclosedBound a = got.Bound(i, parameter);
        const EnclosedBound b = expected.Bound(i, parameter);
        // The members at the ends of `inner` are local optima, sought to a few more digits.
        const double tolerance = 1e-5 * (b.inner.hi - b.inner.lo);
        const auto expect_same = [&](double x, double y, const char* end) {
          if (std::isinf(y) && x == y) return;  // open within the few cells asked for
          EXPECT_NEAR(x / unit, y, tolerance)
              << FamilyParameterName(parameter) << " " << end << " " << u;
        };
        expect_same(a.outer.lo, b.outer.lo, "outer.lo");
        expect_same(a.outer.hi, b.outer.hi, "outer.hi");
        expect_same(a.inner.lo, b.inner.lo, "inner.lo");
        expect_same(a.inner.hi, b.inner.hi, "inner.hi");
        EXPECT_EQ(a.closed, b.closed) << FamilyParameterName(parameter) << " " << u;
      }
    }
  }
}

TEST(Scaling, FamilyBoundsOfOneMode) { ExpectSameBounds(R228(), DefaultModelSpec(), 0); }
TEST(LongScaling, FamilyBoundsOfTwoModes) { ExpectSameBounds(WithLines(), TwoModes(), 30); }

void ExpectSameMembers(const std::vector<Experiment>& experiments, const ModelSpec& model) {
  constexpr std::size_t kMembers = 50;
  const FamilyProblem problem = Family(experiments, model);
  const Enumeration expected = EnumerateMembers(problem, kMembers, 3, 2);
  ASSERT_EQ(expected.members.size(), kMembers);
  const MemberSample sample = SampleMembers(problem, {.count = 40, .seed = 3, .threads = 2});
  ASSERT_EQ(sample.members.size(), 40u);
  const TradeoffPoint point = ComputeTradeoff(problem, 0.15, 1);
  ASSERT_TRUE(point.xi_max.has_value());
  for (const Units& u : AllUnits()) {
    const FamilyProblem scaled = Family(Scaled(experiments, u), model);
    const Enumeration got = EnumerateMembers(scaled, kMembers, 3, 2);
    EXPECT_EQ(got.counts.drawn, expected.counts.drawn) << u;
    ASSERT_EQ(got.members.size(), kMembers) << u;
    double worst = 0.0;
    for (std::size_t k = 0; k < kMembers; ++k) {
      for (std::size_t i = 0; i < experiments.size(); ++i) {
        worst = std::max(worst, Difference(got.members[k][i], expected.members[k][i], u));
      }
    }
    EXPECT_LT(worst, 1e-6) << u;
    const MemberSample drawn = SampleMembers(scaled, {.count = 40, .seed = 3, .threads = 2});
    ASSERT_EQ(drawn.members.size(), sample.members.size()) << u;
    worst = 0.0;
    for (std::size_t i = 0; i < experiments.size(); ++i) {
      worst = std::max(worst, Difference(drawn.members[7][i], sample.members[7][i], u));
    }
    EXPECT_LT(worst, 1e-6) << u;
    const TradeoffPoint same = ComputeTradeoff(scaled, 0.15, 1);
    ASSERT_TRUE(same.xi_max.has_value()) << u;
    EXPECT_NEAR(*same.xi_max, *point.xi_max, 1e-7) << u;
  }
}

TEST(Scaling, MembersAndTradeoffOfOneMode) { ExpectSameMembers(R228(), DefaultModelSpec()); }
TEST(LongScaling, MembersAndTradeoffOfTwoModes) { ExpectSameMembers(WithLines(), TwoModes()); }

// Of a record with a line, diffusion and noise, everything that analysis says, digit for digit.
void ExpectSame(const Estimate& got, const Estimate& expected, double unit, const char* what,
                const Units& u) {
  EXPECT_NEAR(got.value / unit, expected.value, 1e-12 * std::abs(expected.value))
      << what << " " << u;
  if (std::isfinite(expected.std)) {
    EXPECT_NEAR(got.std / unit, expected.std, 1e-9 * expected.std) << what << " " << u;
  }
}

TEST(Scaling, AnalysisOfARecord) {
  fixtures::SyntheticOptions options;
  options.loop_gain = 1.4;
  options.diffusion_rad2_per_s = 0.5;
  options.breathing = 0.05;
  options.line_ratio = 3.45;
  const Record record = fixtures::Synthesise(options, 7).record;
  AnalysisOptions analysis;
  analysis.model = TwoModes();
  const auto analyse = [&](const Units& u) {
    NamedRecord scaled{"exp1", 0.5, record};
    scaled.record.sampling_hz *= u.a;
    for (double& p : scaled.record.pressure) p *= u.b;
    for (double& q : scaled.record.heat_release) q *= u.c;
    return AnalyseRecords(std::vector{scaled}, analysis).analyses[0];
  };
  const Analysis expected = analyse({});
  ASSERT_EQ(expected.characteristics.state, CycleState::kLimitCycle);
  ASSERT_TRUE(expected.flame_curve && expected.transfer && expected.loop_gain);
  ASSERT_TRUE(expected.transfer_fit.has_value());
  for (const Units& u : {Units{std::exp2(-8), 1.0, 1.0}, Units{std::exp2(9), 1.0, 1.0},
                         Units{1.0, std::exp2(-20), std::exp2(20)},
                         Units{std::exp2(8), std::exp2(20), std::exp2(-20)}}) {
    const Analysis got = analyse(u);
    const Characteristics& c = got.characteristics;
    const Characteristics& d = expected.characteristics;
    ASSERT_EQ(c.state, d.state) << u;
    EXPECT_EQ(c.stationary, d.stationary) << u;
    ExpectSame(c.frequency_hz, d.frequency_hz, u.a, "frequency", u);
    ExpectSame(c.phase_deg, d.phase_deg, 1.0, "phase", u);
    ExpectSame(c.gain, d.gain, u.b / u.c, "gain", u);
    ASSERT_TRUE(got.tau_s && got.flame_curve && got.loop_gain && got.transfer) << u;
    ExpectSame(*got.tau_s, *expected.tau_s, 1.0 / u.a, "tau", u);
    ExpectSame(got.flame_curve->slope, expected.flame_curve->slope, u.c / (u.a * u.b), "slope", u);
    ExpectSame(*got.loop_gain, *expected.loop_gain, 1.0, "loop gain", u);
    ASSERT_EQ(got.lines.size(), expected.lines.size()) << u;
    for (std::size_t k = 0; k < got.lines.size(); ++k) {
      ExpectSame(got.lines[k].frequency_hz, expected.lines[k].frequency_hz, u.a, "line", u);
      EXPECT_EQ(got.lines[k].harmonic, expected.lines[k].harmonic) << u;
    }
    ASSERT_EQ(got.transfer->points.size(), expected.transfer->points.size()) << u;
    for (std::size_t k = 0; k < got.transfer->points.size(); ++k) {
      EXPECT_NEAR(got.transfer->points[k].frequency_hz / u.a,
                  expected.transfer->points[k].frequency_hz, 1e-9);
    }
    ASSERT_EQ(got.transfer_fit.has_value(), expected.transfer_fit.has_value()) << u;
    if (got.transfer_fit) {
      EXPECT_NEAR(got.transfer_fit->omega_hz.value / u.a / expected.transfer_fit->omega_hz.value,
                  1.0, 1e-6)
          << u;
    }
  }
}

}  // namespace
}  // namespace howl::scaling_test
