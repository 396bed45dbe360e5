// Transfers as a condition of membership. Truth: the falsification test of reference.h, and the
// ellipsoid written out a second time from its covariance.
#include "estimation/analysis/transfer/transfer.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "estimation/analysis/transfer/joint_deviation.h"
#include "estimation/family/answers/conflict/conflict.h"
#include "estimation/family/answers/tradeoff.h"
#include "estimation/family/bounds/enclose.h"
#include "estimation/family/bounds/inside.h"
#include "estimation/family/local/local_search.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/members/sample.h"
#include "estimation/family/members/transfer_starts.h"
#include "estimation/family/members/transfer_volume.h"
#include "tests/estimation/family/reference.h"
#include "tests/r228.h"

namespace howl::transfer_test {
namespace {

// Correlated as transfers are: N goes with xi.
TransferMatrix Covariance(double scale) {
  TransferMatrix correlation;
  correlation << 1.0, 0.1, 0.0, -0.3,  //
      0.1, 1.0, 0.8, 0.2,              //
      0.0, 0.8, 1.0, 0.1,              //
      -0.3, 0.2, 0.1, 1.0;
  const TransferVector std = scale * TransferVector(0.004, 0.1, 0.09, 0.2);
  return std.asDiagonal() * correlation * std.asDiagonal();
}

// Squared distance over the parameters `used`, by the inverse of their covariance.
double SquaredDistance(const Experiment& e, const LoopModel& m, const std::vector<int>& used) {
  const TransferVector& centre = e.transfer_ellipsoid->Centre();
  const double v[4] = {std::log(m.omega_hz) - std::log(centre(0)),
                       std::log(m.xi) - std::log(centre(1)), (m.N - centre(2)) / centre(2),
                       (m.M - centre(3)) / centre(3)};
  Eigen::VectorXd off(used.size());
  Eigen::MatrixXd covariance(used.size(), used.size());
  for (std::size_t a = 0; a < used.size(); ++a) {
    const auto ia = static_cast<Eigen::Index>(a);
    off(ia) = v[used[a]];
    for (std::size_t b = 0; b < used.size(); ++b) {
      covariance(ia, static_cast<Eigen::Index>(b)) =
          e.transfer_ellipsoid->Covariance()(used[a], used[b]);
    }
  }
  return off.dot(covariance.inverse() * off);
}

bool Passes(const FamilyProblem& problem, const Member& member) {
  if (!reference::Passes(problem.experiments, member, problem.test)) return false;
  for (std::size_t i = 0; i < member.size(); ++i) {
    if (!problem.experiments[i].transfer_ellipsoid) continue;
    const std::vector<int> used =
        member[i].M > 0.0 ? std::vector<int>{0, 1, 2, 3} : std::vector<int>{0, 1, 2};
    // As improbable as that many standard deviations of one number.
    const double square = SquaredDistance(problem.experiments[i], member[i], used);
    const double z = problem.test.transfer_distance_max;
    if (std::isinf(z)) continue;
    const boost::math::chi_squared one(1.0), all(static_cast<double>(used.size()));
    if (!(cdf(complement(all, square)) >= cdf(complement(one, z * z)))) return false;
  }
  return true;
}

// N and M that give exactly the experiment's phase and gain.
LoopModel ExactModel(const Experiment& e, double omega_hz, double xi, int modes, double gain_error,
                     double phase_error_deg, double loop_error_deg) {
  const double w = 2 * M_PI * e.frequency_hz;
  const double phase = (e.phase_deg + phase_error_deg) * M_PI / 180;
  const std::complex<double> z = std::polar(e.gain * (1 + gain_error), phase);
  const auto mode = [&](double f0) {
    const std::complex<double> s(0, w);
    const double o = 2 * M_PI * f0;
    return s / (s * s + 2 * o * xi * s + o * o);
  };
  LoopModel m{.omega_hz = omega_hz, .xi = xi};
  m.tau_s = (1.5 * M_PI + phase - loop_error_deg * M_PI / 180) / w;
  if (modes == 1) {
    const double t = std::tan(-phase);
    m.omega_hz = e.frequency_hz * (std::sqrt(xi * xi * t * t + 1) - xi * t);
    m.N = std::abs(z) / std::abs(mode(m.omega_hz));
  } else {
    const std::complex<double> u1 = mode(omega_hz), u3 = mode(3 * omega_hz);
    const double det = u1.real() * u3.imag() - u1.imag() * u3.real();
    m.N = (z.real() * u3.imag() - z.imag() * u3.real()) / det;
    m.M = (u1.real() * z.imag() - u1.imag() * z.real()) / det;
  }
  return m;
}

// A rig within the family: light at low phi, with the second mode at some 0.15 of the first.
Member Rig(const std::vector<Experiment>& experiments, int modes) {
  Member rig;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const double xi = 0.17 - 0.015 * static_cast<double>(i);
    const double t = std::tan(-experiments[i].phase_deg * M_PI / 180);
    const double top = experiments[i].frequency_hz * (std::sqrt(xi * xi * t * t + 1) - xi * t);
    rig.push_back(ExactModel(experiments[i], modes == 1 ? top : 0.993 * top, xi, modes, 0, 0, 0));
  }
  return rig;
}

FamilyProblem Problem(std::size_t experiments, int modes, double scale = 1.0) {
  FamilyProblem problem{.experiments = R228()};
  problem.experiments.resize(experiments);
  problem.model.modes = modes;
  problem.model[ParameterKind::kM].scope = ParameterScope::kExperiment;
  const Member rig = Rig(problem.experiments, modes);
  for (std::size_t i = 0; i < experiments; ++i) {
    const LoopModel& m = rig[i];
    const TransferVector centre(m.omega_hz, m.xi, m.N, modes == 2 ? m.M : 0.2 * m.N);
    problem.experiments[i].transfer_ellipsoid =
        TransferEllipsoid::Make(centre, Covariance(scale), {true, true, true, true});
  }
  return problem;
}

TEST(TransferEllipsoidTest, DistanceIsThatOfTheCovariance) {
  FamilyProblem problem = Problem(2, 2);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 200; ++k) {
    LoopModel m = Rig(problem.experiments, 2)[1];
    m.omega_hz *= std::exp(0.01 * normal(random));
    m.xi *= std::exp(0.2 * normal(random));
    m.N *= std::exp(0.2 * normal(random));
    m.M *= std::exp(0.2 * normal(random));
    const Experiment& e = problem.experiments[1];
    const double two = MahalanobisDistance(*e.transfer_ellipsoid, m);
    EXPECT_NEAR(two, std::sqrt(SquaredDistance(e, m, {0, 1, 2, 3})), 1e-9);
    EXPECT_EQ(ComputeErrors(e, m).transfer_distance, DeviationOfDistance(two, 4));
    m.M = 0.0;  // the marginal of what one mode has
    const double one = MahalanobisDistance(*e.transfer_ellipsoid, m);
    EXPECT_NEAR(one, std::sqrt(SquaredDistance(e, m, {0, 1, 2})), 1e-9);
    EXPECT_LE(one, two + 1e-9);
    EXPECT_EQ(ComputeErrors(e, m).transfer_distance, DeviationOfDistance(one, 3));
  }
}

TEST(TransferEllipsoidTest, WhatIsNotDeterminedDoesNotCount) {
  TransferFit fit;
  fit.available = true;
  fit.acoustics = {200.0, 0.1, 3000.0, 600.0, 3.0};
  fit.log_covariance = Covariance(1.0);
  fit.log_covariance.row(3) *= 4.0;
  fit.log_covariance.col(3) *= 4.0;  // 80 % standard deviation of M
  const auto ellipsoid = MakeTransferEllipsoid(fit);
  ASSERT_TRUE(ellipsoid.has_value());
  EXPECT_FALSE(ellipsoid->IsDetermined(3));
  LoopModel m{.omega_hz = 200.0, .xi = 0.1, .N = 3000.0, .M = 6e5};
  EXPECT_NEAR(TransferDistance(*ellipsoid, m), 0.0, 1e-9);
  m.xi *= std::exp(0.1);
  EXPECT_GT(MahalanobisDistance(*ellipsoid, m), 1.0);
  EXPECT_EQ(ellipsoid->Count(true), 3);
  fit.available = false;
  EXPECT_FALSE(MakeTransferEllipsoid(fit).has_value());
  EXPECT_FALSE(
      TransferEllipsoid::Make(TransferVector::Ones(), -Covariance(1.0), {true, true, true, true})
          .has_value());
}

TEST(TransferMembershipTest, IsAConditionThatCanBeSwitchedOff) {
  FamilyProblem problem = Problem(4, 2, 0.1);
  problem.test.second_mode_share_max = std::numeric_limits<double>::infinity();
  Member member = Rig(problem.experiments, 2);
  EXPECT_TRUE(Holds(problem, member));
  // Another omega with the same response: only the transfer tells.
  member[2] =
      ExactModel(problem.experiments[2], 0.99 * member[2].omega_hz, member[2].xi, 2, 0, 0, 0);
  const ConditionSet failed = Falsify(problem.experiments, member, problem.test);
  EXPECT_TRUE(failed.Contains(Condition::kTransfer));
  EXPECT_FALSE(failed.Contains(Condition::kGain));
  EXPECT_FALSE(failed.Contains(Condition::kPhase));
  problem.test.transfer_distance_max = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(Holds(problem, member));
  EXPECT_FALSE(problem.HasTransfer());
}

struct Case {
  std::size_t experiments;
  int modes;
  std::size_t draws;
  std::size_t least;
};

class TransferBruteForceTest : public testing::TestWithParam<Case> {};

TEST_P(TransferBruteForceTest, MembersLieWithinOuterAndInsideBoxesHoldMembersAlone) {
  const Case c = GetParam();
  const FamilyProblem problem = Problem(c.experiments, c.modes);
  Enclosure enclosure(problem, {.max_cells = 40, .threads = 2});
  ASSERT_TRUE(enclosure.Run());
  std::vector<std::vector<ModelBox>> boxes;
  for (const Member& member : EnumerateMembers(problem, 40, 5, 1).members) {
    ASSERT_TRUE(Passes(problem, member));
    boxes.push_back(GrowInside(problem, member));
    if (boxes.back().empty()) boxes.pop_back();
  }
  ASSERT_GT(boxes.size(), 10u);
  const Member rig = Rig(problem.experiments, c.modes);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::size_t passed = 0, failed_near_box = 0;
  for (std::size_t k = 0; k < c.draws; ++k) {
    Member member = rig;
    const bool near_box = k % 10 == 0;
    for (std::size_t i = 0; i < member.size(); ++i) {
      if (near_box) {
        const ModelBox& box = boxes[k / 10 % boxes.size()][i];
        const auto around = [&](const Range& r) {
          return r.lo + (r.hi - r.lo) * (0.5 + 0.55 * uniform(random));
        };
        member[i] = {around(box.omega_hz), around(box.xi), around(box.N), around(box.M),
                     around(box.tau_s)};
      } else {
        member[i] =
            ExactModel(problem.experiments[i], rig[i].omega_hz * std::exp(0.012 * uniform(random)),
                       rig[i].xi * std::exp(0.3 * uniform(random)), c.modes,
                       0.0105 * uniform(random), 0.52 * uniform(random), 1.05 * uniform(random));
      }
    }
    const bool positive = std::all_of(member.begin(), member.end(),
                                      [](const LoopModel& m) { return m.N > 0.0 && m.M >= 0.0; });
    if (positive && Passes(problem, member)) {
      ++passed;
      for (std::size_t i = 0; i < member.size(); ++i) {
        for (const FamilyParameter parameter : kFamilyParameters) {
          if (!enclosure.IsBounded(i, parameter)) continue;
          const Range outer = enclosure.Bound(i, parameter).outer;
          const double value = ParameterValue(problem.experiments[i], member[i], parameter);
          ASSERT_TRUE(outer.lo <= value && value <= outer.hi)
              << i << " " << FamilyParameterName(parameter) << " " << value;
        }
      }
    } else if (near_box) {
      ++failed_near_box;
      const std::vector<ModelBox>& box = boxes[k / 10 % boxes.size()];
      bool inside = true;
      for (std::size_t i = 0; i < member.size(); ++i) {
        const auto in = [](const Range& r, double v) { return r.lo <= v && v <= r.hi; };
        inside &= in(box[i].omega_hz, member[i].omega_hz) && in(box[i].xi, member[i].xi) &&
                  in(box[i].N, member[i].N) && in(box[i].M, member[i].M) &&
                  in(box[i].tau_s, member[i].tau_s);
      }
      ASSERT_FALSE(inside);
    }
  }
  EXPECT_GE(passed, c.least);
  RecordProperty("passed", static_cast<int>(passed));
}

INSTANTIATE_TEST_SUITE_P(All, TransferBruteForceTest,
                         testing::Values(Case{1, 1, 100000, 20000}, Case{3, 1, 100000, 1000},
                                         Case{1, 2, 100000, 5000}, Case{3, 2, 100000, 50}),
                         [](const auto& one) {
                           return std::to_string(one.param.experiments) + "_experiments_" +
                                  std::to_string(one.param.modes) + "_modes";
                         });

// The bounds that a small transfer leaves are those that members reach.
TEST(TransferEncloseTest, InnerReachesOuter) {
  const FamilyProblem problem = Problem(2, 2, 0.3);
  Enclosure enclosure(problem, {.max_cells = 60, .threads = 2});
  ASSERT_TRUE(enclosure.Run());
  for (std::size_t i = 0; i < 2; ++i) {
    for (const FamilyParameter parameter : kFamilyParameters) {
      EXPECT_LE(enclosure.Bound(i, parameter).Excess(), 0.03)
          << i << " " << FamilyParameterName(parameter);
    }
  }
  for (const Member& witness : enclosure.Witnesses()) EXPECT_TRUE(Passes(problem, witness));
}

// Rejection sampling in natural coordinates: uniform over a box that holds the family.
std::vector<LoopModel> Rejection(const FamilyProblem& problem, std::size_t count, unsigned seed) {
  const Experiment& e = problem.experiments[0];
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<LoopModel> accepted;
  while (accepted.size() < count) {
    LoopModel m;
    m.xi = 0.3 * uniform(random);
    m.omega_hz = 210.0 + 11.0 * uniform(random);
    // N within what the gain's tolerance and |U| allow, up to a slab: thinned by its width.
    const std::complex<double> s(0, 2 * M_PI * e.frequency_hz);
    const double o = 2 * M_PI * m.omega_hz;
    const double response = std::abs(s / (s * s + 2 * o * m.xi * s + o * o));
    const double lo = 0.99 * e.gain / response, hi = 1.01 * e.gain / response;
    const double widest = 0.02 * e.gain / 1.1e-3;  // |U| is least at xi = 0.3
    if (uniform(random) * widest > hi - lo) continue;
    m.N = lo + (hi - lo) * uniform(random);
    m.tau_s = 3.31e-3 + 0.06e-3 * uniform(random);
    if (Passes(problem, {m})) accepted.push_back(m);
  }
  return accepted;
}

double KolmogorovDistance(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double below =
        static_cast<double>(std::lower_bound(b.begin(), b.end(), a[k]) - b.begin()) /
        static_cast<double>(b.size());
    largest =
        std::max(largest, std::abs(below - static_cast<double>(k) / static_cast<double>(a.size())));
  }
  return largest;
}

TEST(TransferSampleTest, MarginalsAreThoseOfRejectionSampling) {
  const FamilyProblem problem = Problem(1, 1);
  const std::vector<LoopModel> truth = Rejection(problem, 1500, 5);
  const MemberSample sample = SampleMembers(problem, {.count = 6000, .seed = 2});
  ASSERT_EQ(sample.members.size(), 6000u);
  EXPECT_LT(sample.diagnostics.split_r_hat, 1.05);
  const double effective = std::min(1500.0, sample.diagnostics.effective_sample_size);
  const double threshold = 1.95 * std::sqrt(1.0 / 1500.0 + 1.0 / effective);  // 0.1 % level
  for (double LoopModel::*const parameter :
       {&LoopModel::omega_hz, &LoopModel::xi, &LoopModel::N, &LoopModel::tau_s}) {
    std::vector<double> a, b;
    for (const LoopModel& m : truth) a.push_back(m.*parameter);
    for (const Member& m : sample.members) b.push_back(m[0].*parameter);
    EXPECT_LT(KolmogorovDistance(a, b), threshold);
  }
}

// The share of a uniform sample of the family without the transfer.
TEST(TransferVolumeTest, RatioIsTheShareOfUniformDraws) {
  FamilyProblem problem = Problem(1, 1, 0.4);
  FamilyProblem without = WithoutTransfer(problem);
  const std::vector<LoopModel> uniform = Rejection(without, 20000, 9);
  const double share =
      static_cast<double>(std::count_if(uniform.begin(), uniform.end(),
                                        [&](const LoopModel& m) { return Passes(problem, {m}); })) /
      static_cast<double>(uniform.size());
  ASSERT_GT(share, 0.005);
  const TransferVolume volume =
      MeasureTransferVolume(problem, {.population = 1000, .seed = 3, .threads = 2});
  ASSERT_TRUE(volume.ln_ratio.has_value());
  EXPECT_TRUE(volume.finite_without);
  EXPECT_NEAR(*volume.ln_ratio, std::log(share), 0.3);
  ASSERT_TRUE(volume.least_distance.has_value());
  EXPECT_LT(*volume.least_distance, 0.1);  // the rig itself passes
}

TEST(TransferVolumeTest, ContradictionIsMeasured) {
  FamilyProblem problem = Problem(2, 1, 0.05);
  // A transfer whose omega contradicts the cycle's phase by far.
  TransferVector moved = problem.experiments[0].transfer_ellipsoid->Centre();
  moved(0) *= 1.02;
  problem.experiments[0].transfer_ellipsoid =
      TransferEllipsoid::Make(moved, Covariance(0.05), {true, true, true, true});
  const TransferVolume volume = MeasureTransferVolume(problem);
  ASSERT_TRUE(volume.least_distance.has_value());
  EXPECT_GT(*volume.least_distance, problem.test.transfer_distance_max);
  EXPECT_FALSE(volume.ln_ratio.has_value());
  Enclosure enclosure(problem);
  ASSERT_TRUE(enclosure.Run());
  EXPECT_TRUE(enclosure.IsProvedEmpty());
  const Conflict conflict = ExplainEmpty(problem);
  EXPECT_TRUE(conflict.is_empty);
  const auto names = ConflictNames(conflict);
  EXPECT_NE(std::find(names.begin(), names.end(), "transfer_distance_max"), names.end());
}

}  // namespace
}  // namespace howl::transfer_test
