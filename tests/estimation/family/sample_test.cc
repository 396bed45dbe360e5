#include "estimation/family/members/sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include "estimation/family/bounds/enclose.h"
#include "estimation/family/members/convergence.h"
#include "estimation/family/members/member_spread.h"
#include "tests/estimation/family/reference.h"
#include "tests/r228.h"

namespace howl::sample_test {
namespace {

// Two-sample Kolmogorov-Smirnov distance.
double Distance(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  double largest = 0.0;
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (a[i] <= b[j]) {
      ++i;
    } else {
      ++j;
    }
    largest =
        std::max(largest, std::abs(double(i) / double(a.size()) - double(j) / double(b.size())));
  }
  return largest;
}

// sup |F - G| exceeds this once in 10 000 when both samples have one law: 2.23 sqrt(1/n + 1/m),
// with n the effective sample size of the chains.
double Threshold(double n, double m) { return 2.23 * std::sqrt(1.0 / n + 1.0 / m); }

std::vector<double> Column(const std::vector<Member>& members, std::size_t i, int k) {
  std::vector<double> column;
  for (const Member& member : members) {
    const LoopModel& m = member[i];
    const double values[] = {m.omega_hz, m.xi, m.N, m.M, m.tau_s};
    column.push_back(values[k]);
  }
  return column;
}

// Rejection: every experiment's parameters uniform in a box that holds all that pass, then the
// conditions that couple the experiments. Written from (5c) and (5a) directly.
class Rejection {
 public:
  Rejection(const FamilyProblem& problem, std::vector<Range> n, std::vector<Range> omega, Range m)
      : problem_(problem), n_(std::move(n)), omega_(std::move(omega)), m_(m) {}

  std::vector<Member> Draw(std::size_t count) {
    std::vector<Member> members;
    Member member(problem_.experiments.size());
    while (members.size() < count) {
      for (std::size_t i = 0; i < member.size(); ++i) member[i] = DrawOne(i);
      bool ordered = true;  // phi falls along the table
      for (std::size_t i = 1; i < member.size(); ++i) {
        ordered = ordered && member[i].xi <= member[i - 1].xi;
      }
      if (ordered && reference::Passes(problem_.experiments, member, problem_.test)) {
        members.push_back(member);
      }
    }
    return members;
  }

 private:
  double Uniform(const Range& range) {
    return range.lo + (range.hi - range.lo) * std::uniform_real_distribution<double>()(random_);
  }

  LoopModel DrawOne(std::size_t i) {
    const Experiment& e = problem_.experiments[i];
    const double w = 2 * M_PI * e.frequency_hz;
    const Range xi{problem_.domain[ParameterKind::kXi].lo, problem_.test.xi_max};
    LoopModel m;
    for (;;) {
      m.omega_hz = Uniform(omega_[i]);
      m.xi = Uniform(xi);
      m.N = Uniform(n_[i]);
      m.M = problem_.model.modes == 2 ? Uniform(m_) : 0.0;
      const double o = 2 * M_PI * m.omega_hz;
      const std::complex<double> s(0.0, w);
      std::complex<double> z = m.N * s / (o * o - w * w + 2.0 * o * m.xi * s);
      if (m.M > 0.0) z += m.M * s / (9.0 * o * o - w * w + 6.0 * o * m.xi * s);
      if (std::abs(std::abs(z) / e.gain - 1.0) > problem_.test.gain_tolerance) continue;
      const double phase = std::arg(z) * 180 / M_PI;
      if (std::abs(phase - e.phase_deg) > problem_.test.phase_tolerance_deg) continue;
      // tau: uniform in a box that holds every tau that passes; the loop phase decides.
      const double reach =
          problem_.test.phase_tolerance_deg + problem_.test.loop_phase_tolerance_deg;
      const double turned = 270.0 + e.phase_deg + Uniform({-reach, reach});
      if (std::abs(270.0 + phase - turned) > problem_.test.loop_phase_tolerance_deg) continue;
      m.tau_s = turned * M_PI / 180 / w;
      return m;
    }
  }

  FamilyProblem problem_;
  std::vector<Range> n_, omega_;
  Range m_;
  std::mt19937_64 random_{17};
};

void ExpectSameLaw(const MemberSample& sample, const std::vector<Member>& reference, int modes) {
  for (std::size_t i = 0; i < reference[0].size(); ++i) {
    for (const int k : {0, 1, 2, 3, 4}) {
      if (k == 3 && modes == 1) continue;
      const double distance = Distance(Column(sample.members, i, k), Column(reference, i, k));
      EXPECT_LT(distance,
                Threshold(sample.diagnostics.effective_sample_size, double(reference.size())))
          << "experiment " << i << " parameter " << k;
    }
  }
}

TEST(SampleTest, OneModeMarginalsAgreeWithRejection) {
  FamilyProblem problem{.experiments = R228Reliable()};
  problem.experiments.erase(problem.experiments.begin());
  problem.test.gain_tolerance = 0.1;
  problem.test.loop_gain_min = 1.2;
  problem.test.phase_tolerance_deg = 4.0;
  problem.test.omega_spread_max = 0.06;
  const MemberSample sample = SampleMembers(problem, {.count = 10000, .seed = 2, .threads = 2});
  ASSERT_EQ(sample.members.size(), 10000u);
  EXPECT_EQ(sample.diagnostics.rejected, 0u);
  EXPECT_GT(sample.diagnostics.effective_sample_size, 3000.0);
  EXPECT_LT(sample.diagnostics.split_r_hat, 1.01);
  Rejection rejection(problem, {{0.0, 13000.0}, {0.0, 14000.0}, {0.0, 14500.0}},
                      {{185.0, 210.0}, {175.0, 206.0}, {165.0, 203.0}}, {});
  ExpectSameLaw(sample, rejection.Draw(2500), 1);
}

TEST(SampleTest, TwoModeMarginalsAgreeWithRejection) {
  FamilyProblem problem{.experiments = {R228()[2]}};
  problem.model.modes = 2;
  problem.test.gain_tolerance = 0.2;
  problem.test.loop_gain_min = 0.0;
  problem.test.phase_tolerance_deg = 5.0;
  problem.test.second_mode_share_max = std::numeric_limits<double>::infinity();
  problem.domain[ParameterKind::kXi].lo = 0.1;
  problem.domain[ParameterKind::kM].hi = 40000.0;
  const MemberSample sample =
      SampleMembers(problem, {.count = 10000, .thin = 20, .seed = 2, .threads = 2});
  ASSERT_EQ(sample.members.size(), 10000u);
  EXPECT_GT(sample.diagnostics.effective_sample_size, 500.0);
  EXPECT_LT(sample.diagnostics.split_r_hat, 1.05);
  // The box of N: what the bounds prove.
  Enclosure enclosure(problem);
  enclosure.Run();
  const Range n = enclosure.Bound(0, FamilyParameter::kN).outer;
  ASSERT_LT(n.hi, 1e5);
  Rejection rejection(problem, {n}, {{60.0, 206.0}}, {0.0, 40000.0});
  ExpectSameLaw(sample, rejection.Draw(3000), 2);
}

TEST(SampleTest, SameSeedSameMembersWhateverTheThreads) {
  FamilyProblem problem{.experiments = R228()};
  const MemberSample one = SampleMembers(problem, {.count = 800, .seed = 5, .threads = 1});
  const MemberSample two = SampleMembers(problem, {.count = 800, .seed = 5, .threads = 2});
  ASSERT_EQ(one.members.size(), two.members.size());
  for (std::size_t k = 0; k < one.members.size(); ++k) {
    ASSERT_EQ(one.members[k][5].N, two.members[k][5].N);
  }
  EXPECT_EQ(one.diagnostics.largest_hole, two.diagnostics.largest_hole);
}

TEST(SampleTest, SixMembersThatSpanTheFamily) {
  FamilyProblem problem{.experiments = R228()};
  const MemberSample sample = SampleMembers(problem, {.count = 3000, .seed = 1, .threads = 2});
  const std::vector<std::size_t> six = SpreadMembers(sample.members, 6);
  ASSERT_EQ(six.size(), 6u);
  // The smallest distance (in xi of exp1 and exp4, in units of their range) exceeds what six
  // members at random have in nineteen draws of twenty.
  const auto smallest = [&](const std::vector<std::size_t>& chosen) {
    double least = 1e9;
    for (std::size_t a = 0; a < chosen.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < 6; ++i) {
          const LoopModel& p = sample.members[chosen[a]][i];
          const LoopModel& q = sample.members[chosen[b]][i];
          sum += std::pow((p.xi - q.xi) / 0.3, 2) + std::pow((p.N - q.N) / 1e4, 2) +
                 std::pow((p.tau_s - q.tau_s) / 4e-5, 2);
        }
        least = std::min(least, sum);
      }
    }
    return least;
  };
  std::mt19937 random(1);
  int beaten = 0;
  for (int draw = 0; draw < 100; ++draw) {
    std::vector<std::size_t> chosen(6);
    for (std::size_t& index : chosen) index = random() % sample.members.size();
    if (smallest(chosen) >= smallest(six)) ++beaten;
  }
  EXPECT_LE(beaten, 5);
}

// Truth: an AR(1) process has effective size n (1 - r) / (1 + r).
TEST(ConvergenceTest, EffectiveSizeOfAutoregression) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  std::vector<std::vector<double>> chains(4, std::vector<double>(20000));
  for (std::vector<double>& chain : chains) {
    double x = normal(random);
    for (double& value : chain) {
      x = 0.8 * x + 0.6 * normal(random);
      value = x;
    }
  }
  const Convergence convergence = AssessConvergence(chains);
  EXPECT_NEAR(convergence.effective_sample_size / (80000.0 * 0.2 / 1.8), 1.0, 0.1);
  EXPECT_LT(convergence.split_r_hat, 1.01);
  for (double& value : chains[0]) value += 3.0;
  EXPECT_GT(AssessConvergence(chains).split_r_hat, 1.5);
}

}  // namespace
}  // namespace howl::sample_test
