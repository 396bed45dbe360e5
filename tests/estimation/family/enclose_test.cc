#include "estimation/family/bounds/enclose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <sstream>
#include <string>

#include "estimation/family/bounds/bound_text.h"
#include "estimation/family/bounds/inside.h"
#include "estimation/family/members/enumerate.h"
#include "tests/estimation/family/reference.h"
#include "tests/r228.h"

namespace howl::enclose_test {
namespace {

FamilyProblem Problem(std::size_t experiments, int modes) {
  FamilyProblem problem{.experiments = R228()};
  problem.experiments.resize(experiments);
  problem.model.modes = modes;
  if (modes == 2) {
    // Without a least xi the two modes may cancel each other at any size: N and M have no bound.
    problem.domain[ParameterKind::kXi].lo = 0.05;
    problem.model[ParameterKind::kM].scope = ParameterScope::kExperiment;
    problem.test.second_mode_share_max = std::numeric_limits<double>::infinity();
  }
  return problem;
}

// With the conditions on the second mode: minor at the limit cycle, and a second crossing that the
// line bounds from below.
FamilyProblem MinorProblem(std::size_t experiments) {
  FamilyProblem problem = Problem(experiments, 2);
  problem.test.second_mode_share_max = 0.1;
  problem.test.second_crossing_gain_min = 0.9;
  problem.test.second_crossing_tolerance_deg = 90.0;
  for (Experiment& experiment : problem.experiments) experiment.lines = {{750.0, 10.0}};
  return problem;
}

bool Within(const Range& range, double value) { return range.lo <= value && value <= range.hi; }

void ExpectWithinOuter(const Enclosure& enclosure, const std::vector<Experiment>& experiments,
                       const Member& member) {
  for (std::size_t i = 0; i < member.size(); ++i) {
    const LoopModel& m = member[i];
    const auto outer = [&](FamilyParameter p) { return enclosure.Bound(i, p).outer; };
    ASSERT_TRUE(Within(outer(FamilyParameter::kOmega), m.omega_hz)) << i << " " << m.omega_hz;
    ASSERT_TRUE(Within(outer(FamilyParameter::kXi), m.xi)) << i << " " << m.xi;
    ASSERT_TRUE(Within(outer(FamilyParameter::kN), m.N)) << i << " " << m.N;
    ASSERT_TRUE(Within(outer(FamilyParameter::kTau), m.tau_s)) << i << " " << m.tau_s;
    if (m.M > 0.0) {
      ASSERT_TRUE(Within(outer(FamilyParameter::kM), m.M)) << i << " " << m.M;
    }
    const double loop_gain =
        double(std::abs(reference::L(reference::From(m), experiments[i].frequency_hz))) *
        std::abs(*experiments[i].flame_slope);
    ASSERT_TRUE(Within(outer(FamilyParameter::kLoopGain), loop_gain)) << i << " " << loop_gain;
  }
}

// Brute force, from the paper's equations alone: xi (or xi and omega) at random, the rest such that
// the errors are drawn from somewhat more than the tolerances, so that many pass and many fail.
class BruteForce {
 public:
  BruteForce(const FamilyProblem& problem, unsigned seed) : problem_(problem), random_(seed) {
    minor_ = std::isfinite(problem.test.second_mode_share_max) && problem.model.modes == 2;
  }

  Member Draw() {
    const std::size_t n = problem_.experiments.size();
    Member member(n);
    const double common = 120.0 + 100.0 * Uniform();  // keeps many omega within one window
    const double xi_top = 0.32 * Uniform() + 1e-4;
    std::vector<double> xis(n);
    for (double& xi : xis) xi = xi_top * (0.02 + 0.98 * Uniform());
    // phi falls along the table; one draw in eight is left unsorted.
    if (Uniform() > 0.125) std::sort(xis.rbegin(), xis.rend());
    for (std::size_t i = 0; i < n; ++i) {
      const Experiment& e = problem_.experiments[i];
      const double w = 2 * M_PI * e.frequency_hz;
      const double gain = e.gain * (1.0 + 0.0115 * Signed());
      const double phase = (e.phase_deg + 0.55 * Signed()) * M_PI / 180;
      LoopModel& m = member[i];
      m.xi = xis[i];
      const std::complex<double> z = std::polar(gain, phase);
      if (problem_.model.modes == 1) {
        const double t = std::tan(-phase);
        m.omega_hz = e.frequency_hz * (std::sqrt(m.xi * m.xi * t * t + 1) - m.xi * t);
        if (Uniform() < 0.02) m.omega_hz *= 1.0 + 0.01 * Signed();  // off the band
        const std::complex<double> u = Mode(m.omega_hz, m.xi, w);
        m.N = gain / std::abs(u);
      } else {
        m.omega_hz = common * (0.9 + 0.2 * Uniform());
        if (Uniform() < 0.1) m.omega_hz = 60.0 + 160.0 * Uniform();
        if (minor_) {
          // Below the one-mode solution, mostly as little as a minor second mode allows.
          const double t = std::tan(-phase);
          const double top = e.frequency_hz * (std::sqrt(m.xi * m.xi * t * t + 1) - m.xi * t);
          m.omega_hz = top * (1.0 - (Uniform() < 0.1 ? 0.7 : 0.2 * m.xi) * Uniform());
        }
        // N u_1 + M u_3 = z: two real equations.
        const std::complex<double> u1 = Mode(m.omega_hz, m.xi, w);
        const std::complex<double> u3 = Mode(3 * m.omega_hz, m.xi, w);
        const double det = u1.real() * u3.imag() - u1.imag() * u3.real();
        m.N = (z.real() * u3.imag() - z.imag() * u3.real()) / det;
        m.M = (u1.real() * z.imag() - u1.imag() * z.real()) / det;
      }
      m.tau_s = (1.5 * M_PI + phase - 1.1 * Signed() * M_PI / 180) / w;
    }
    return member;
  }

  double Uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  double Signed() { return 2.0 * Uniform() - 1.0; }

 private:
  static std::complex<double> Mode(double omega_hz, double xi, double w) {
    const std::complex<double> s(0, w);
    const double o = 2 * M_PI * omega_hz;
    return s / (s * s + 2 * o * xi * s + o * o);
  }
  const FamilyProblem& problem_;
  std::mt19937_64 random_;
  bool minor_;
};

bool InBox(const std::vector<ModelBox>& box, const Member& member) {
  for (std::size_t i = 0; i < box.size(); ++i) {
    if (!Within(box[i].omega_hz, member[i].omega_hz) || !Within(box[i].xi, member[i].xi) ||
        !Within(box[i].N, member[i].N) || !Within(box[i].tau_s, member[i].tau_s) ||
        !Within(box[i].M, member[i].M)) {
      return false;
    }
  }
  return true;
}

struct Case {
  std::size_t experiments;
  int modes;
  std::size_t draws;  // one million over the cases
  std::size_t least;  // that pass
  bool minor = false;
};

class BruteForceTest : public testing::TestWithParam<Case> {};

TEST_P(BruteForceTest, EveryModelThatPassesLiesWithinOuterAndNoneThatFailsInAnInsideBox) {
  const Case c = GetParam();
  const FamilyProblem problem =
      c.minor ? MinorProblem(c.experiments) : Problem(c.experiments, c.modes);
  Enclosure enclosure(problem, {.max_cells = c.modes == 2 ? 60u : 0u, .threads = 2});
  ASSERT_TRUE(enclosure.Run());
  std::vector<std::vector<ModelBox>> boxes;
  for (const Member& member : EnumerateMembers(problem, 40, 5, 1).members) {
    boxes.push_back(GrowInside(problem, member));
    if (boxes.back().empty()) boxes.pop_back();
  }
  ASSERT_GT(boxes.size(), 20u);

  BruteForce brute(problem, 11);
  std::size_t passed = 0;
  const double xi_lo = problem.domain[ParameterKind::kXi].lo;
  for (std::size_t k = 0; k < c.draws; ++k) {
    Member member = brute.Draw();
    // One draw in ten is put around an inside box, beyond it on every side.
    if (k % 10 == 0) {
      const std::vector<ModelBox>& box = boxes[k / 10 % boxes.size()];
      for (std::size_t i = 0; i < box.size(); ++i) {
        const auto around = [&](const Range& range) {
          return range.lo + (range.hi - range.lo) * (-0.02 + 1.04 * brute.Uniform());
        };
        member[i].omega_hz = around(box[i].omega_hz);
        member[i].xi = around(box[i].xi);
        member[i].N = around(box[i].N);
        member[i].M = around(box[i].M);
        member[i].tau_s = around(box[i].tau_s);
      }
    }
    const bool in_domain = std::all_of(member.begin(), member.end(), [&](const LoopModel& m) {
      return m.xi >= xi_lo && m.N > 0.0 && m.M >= 0.0;
    });
    const bool passes = in_domain && reference::Passes(problem.experiments, member, problem.test);
    if (passes) {
      ++passed;
      ExpectWithinOuter(enclosure, problem.experiments, member);
      if (HasFatalFailure()) return;
    } else if (k % 10 == 0) {
      for (const std::vector<ModelBox>& box : boxes) ASSERT_FALSE(InBox(box, member));
    }
  }
  EXPECT_GE(passed, c.least);
  RecordProperty("passed", static_cast<int>(passed));
}

std::string NameOfCase(const testing::TestParamInfo<Case>& one) {
  return std::to_string(one.param.experiments) + "_experiments_" + std::to_string(one.param.modes) +
         "_modes" + (one.param.minor ? "_second_minor" : "");
}

INSTANTIATE_TEST_SUITE_P(All, BruteForceTest,
                         testing::Values(Case{1, 1, 200000, 50000}, Case{4, 1, 200000, 10000},
                                         Case{6, 1, 200000, 1000}, Case{1, 2, 200000, 50000},
                                         Case{4, 2, 100000, 200}, Case{1, 2, 100000, 5000, true},
                                         Case{3, 2, 100000, 50, true}),
                         NameOfCase);
INSTANTIATE_TEST_SUITE_P(LongAll, BruteForceTest, testing::Values(Case{6, 2, 100000, 50}),
                         NameOfCase);

// Shared M: the members come from the enumeration, and are confirmed by the independent test.
TEST(EncloseTest, SharedSecondModeKeepsMembersWithinOuter) {
  for (const bool relative : {false, true}) {
    FamilyProblem problem = Problem(4, 2);
    problem.model[ParameterKind::kM].scope = ParameterScope::kShared;
    problem.model.second_mode_relative = relative;
    Enclosure enclosure(problem, {.max_cells = 40, .threads = 2});
    enclosure.Run();
    for (const Member& member : EnumerateMembers(problem, 500, 9, 2).members) {
      ASSERT_TRUE(reference::Passes(problem.experiments, member, problem.test, 1e-9L));
      ExpectWithinOuter(enclosure, problem.experiments, member);
    }
  }
}

TEST(EncloseTest, OuterMeetsInnerToOnePerCentForSixExperiments) {
  const FamilyProblem problem = Problem(6, 1);
  Enclosure enclosure(problem, {.width = 0.01, .threads = 2});
  ASSERT_TRUE(enclosure.Run());
  EXPECT_EQ(enclosure.Counts().pending, 0u);
  for (std::size_t i = 0; i < 6; ++i) {
    for (const FamilyParameter parameter : kFamilyParameters) {
      if (!enclosure.IsBounded(i, parameter)) continue;
      const EnclosedBound bound = enclosure.Bound(i, parameter);
      EXPECT_TRUE(bound.closed);
      EXPECT_LE(bound.Excess(), 0.01) << i << " " << FamilyParameterName(parameter);
      EXPECT_LE(bound.outer.lo, bound.inner.lo);
      EXPECT_GE(bound.outer.hi, bound.inner.hi);
    }
  }
  for (const Member& witness : enclosure.Witnesses()) {
    ASSERT_TRUE(reference::Passes(problem.experiments, witness, problem.test, 1e-9L));
  }
}

// With one experiment the bounds are known: xi up to xi_max, omega by the closed form at the
// phase's edge, tau by both phases' edges, N at xi_max.
TEST(EncloseTest, OneExperimentAgainstTheClosedForm) {
  const FamilyProblem problem = Problem(1, 1);
  Enclosure enclosure(problem, {.width = 1e-4});
  ASSERT_TRUE(enclosure.Run());
  const Experiment& e = problem.experiments[0];
  const double rad = M_PI / 180;
  const double t = std::tan(6.24 * rad);
  const double omega = e.frequency_hz * (std::sqrt(0.09 * t * t + 1) - 0.3 * t);
  EXPECT_NEAR(enclosure.Bound(0, FamilyParameter::kOmega).outer.lo, omega, 1e-3);
  EXPECT_NEAR(enclosure.Bound(0, FamilyParameter::kOmega).outer.hi, e.frequency_hz, 1e-3);
  const double w = 2 * M_PI * e.frequency_hz;
  EXPECT_NEAR(enclosure.Bound(0, FamilyParameter::kTau).outer.lo, (270 - 6.24 - 1) * rad / w, 1e-8);
  EXPECT_NEAR(enclosure.Bound(0, FamilyParameter::kTau).outer.hi, (270 - 5.24 + 1) * rad / w, 1e-8);
  EXPECT_NEAR(enclosure.Bound(0, FamilyParameter::kXi).outer.hi, 0.3, 1e-9);
  EXPECT_NEAR(enclosure.Bound(0, FamilyParameter::kLoopGain).outer.hi, 1.01 * e.gain * w * 0.703e-4,
              1e-4);
}

// A slope at rest that is known to a percent: the loop gain reaches four of its standard deviations
// farther, and a least loop gain asks what the steepest of these slopes gives.
TEST(EncloseTest, TheLoopGainIsThatOfEverySlopeThatTheDataAllow) {
  FamilyProblem problem = Problem(1, 1);
  Experiment& e = problem.experiments[0];
  e.flame_slope_std = 0.01 * std::abs(*e.flame_slope);
  const double loop_gain = e.gain * 2 * M_PI * e.frequency_hz * std::abs(*e.flame_slope);
  Enclosure enclosure(problem, {.width = 1e-4});
  ASSERT_TRUE(enclosure.Run());
  const EnclosedBound bound = enclosure.Bound(0, FamilyParameter::kLoopGain);
  EXPECT_NEAR(bound.outer.hi, 1.01 * 1.04 * loop_gain, 1e-4);
  EXPECT_NEAR(bound.outer.lo, 0.99 * 0.96 * loop_gain, 1e-4);
  EXPECT_NEAR(bound.inner.hi, 1.01 * 1.04 * loop_gain, 1e-3);
  problem.test.loop_gain_min = 1.03 * loop_gain;
  EXPECT_FALSE(EnumerateMembers(problem, 1, 1, 1).members.empty());
  problem.test.loop_gain_min = 1.06 * loop_gain;
  EXPECT_TRUE(EnumerateMembers(problem, 1, 1, 1).members.empty());
}

TEST(EncloseTest, EmptyFamilyIsProvedEmpty) {
  FamilyProblem problem = Problem(6, 1);
  problem.test.omega_spread_max = 0.15;
  Enclosure enclosure(problem, {.threads = 2});
  EXPECT_TRUE(enclosure.Run());
  EXPECT_TRUE(enclosure.IsProvedEmpty());
}

std::string Text(const Enclosure& enclosure) {
  std::ostringstream out;
  enclosure.Save(out);
  return out.str();
}

TEST(EncloseTest, KilledTenTimesAtRandomAndResumedIsTheSame) {
  const FamilyProblem problem = Problem(2, 2);
  const EncloseOptions options{.max_cells = 80, .threads = 2};
  Enclosure whole(problem, options);
  ASSERT_TRUE(whole.Run());
  const std::string expected = Text(whole);

  std::mt19937 random(3);
  std::string state;
  for (int kill = 0; kill < 10; ++kill) {
    Enclosure part(problem, options);
    if (!state.empty()) {
      std::istringstream in(state);
      ASSERT_TRUE(part.Load(in));
    }
    std::atomic<int> left{std::uniform_int_distribution<int>(1, 20)(random)};
    part.Run([&] { return left-- <= 0; });
    state = Text(part);
  }
  Enclosure last(problem, options);
  std::istringstream in(state);
  ASSERT_TRUE(last.Load(in));
  EXPECT_FALSE(last.IsComplete());
  ASSERT_TRUE(last.Run());
  EXPECT_EQ(Text(last), expected);
}

// A digit changed in the state gave bounds that no search had found.
TEST(EncloseTest, DamagedSearchesBeginAnew) {
  const FamilyProblem problem = Problem(2, 1);
  const EncloseOptions options{.max_cells = 80, .threads = 1};
  Enclosure whole(problem, options);
  ASSERT_TRUE(whole.Run());
  const std::string expected = Text(whole);
  std::mt19937 random(5);
  const std::size_t head = expected.find('\n') + 1;
  for (int trial = 0; trial < 8; ++trial) {
    std::string damaged = expected;
    std::size_t at = 0;
    do {
      at = std::uniform_int_distribution<std::size_t>(head, damaged.size() - 1)(random);
    } while (damaged[at] < '0' || damaged[at] > '9');
    damaged[at] = damaged[at] == '9' ? '0' : static_cast<char>(damaged[at] + 1);
    Enclosure again(problem, options);
    std::istringstream in(damaged);
    ASSERT_TRUE(again.Load(in)) << at;
    EXPECT_FALSE(again.IsComplete()) << at;
    ASSERT_TRUE(again.Run());
    EXPECT_EQ(Text(again), expected) << at;
    std::istringstream count(damaged);
    EXPECT_GE(CountDamagedSearches(count), 1u) << at;
  }
  std::istringstream sound(expected);
  EXPECT_EQ(CountDamagedSearches(sound), 0u);
}

TEST(EncloseTest, SameWhateverTheThreads) {
  const FamilyProblem problem = Problem(4, 1);
  Enclosure one(problem, {.threads = 1});
  Enclosure two(problem, {.threads = 2});
  one.Run();
  two.Run();
  EXPECT_EQ(Text(one), Text(two));
}

TEST(EncloseTest, LoadRefusesWhatSaveDidNotWrite) {
  Enclosure enclosure(Problem(1, 1));
  for (const char* text : {"", "howl.enclosure/1 3", "howl.enclosure/1 10 1\n9 9 9", "x y z"}) {
    std::istringstream in(text);
    EXPECT_FALSE(enclosure.Load(in)) << text;
  }
  EXPECT_TRUE(enclosure.Run());
}

}  // namespace
}  // namespace howl::enclose_test
