#include "estimation/family/bounds/contract/interval.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "estimation/family/bounds/contract/cell_contractor.h"
#include "estimation/family/bounds/contract/contract.h"
#include "tests/estimation/family/reference.h"
#include "tests/r228.h"

#ifdef HOWL_HAVE_MPFI
#include <boost/multiprecision/mpfi.hpp>
#endif

namespace howl::interval_test {
namespace {

// The root of x in the rounding mode itself.
double RootRounded(double x, int mode) {
  const int before = std::fegetround();
  std::fesetround(mode);
  volatile double from = x;  // not to be moved across the switches
  volatile double root = std::sqrt(from);
  std::fesetround(before);
  return root;
}

TEST(IntervalTest, RootsAreThoseOfTheRoundingModes) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<double> values = {0.0,
                                1.0,
                                4.0,
                                std::numeric_limits<double>::denorm_min(),
                                std::numeric_limits<double>::min(),
                                std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::infinity()};
  for (int draw = 0; draw < 100000; ++draw) {
    const double x = std::ldexp(uniform(random), static_cast<int>(random() % 2100) - 1070);
    values.push_back(x);
    // Exact squares, and their neighbours.
    const double root = static_cast<double>(random() % (1u << 26));
    values.push_back(root * root);
    values.push_back(std::nextafter(root * root, 1e300));
    values.push_back(std::nextafter(root * root, 0.0));
    // Squares that are not exact: just above or below one.
    values.push_back(x * x);
  }
  for (const double x : values) {
    Interval root;
    {
      const RoundingGuard guard;
      root = sqrt(Interval(x));
    }
    ASSERT_EQ(root.lower(), RootRounded(x, FE_DOWNWARD)) << x;
    ASSERT_EQ(root.upper(), RootRounded(x, FE_UPWARD)) << x;
  }
}

#ifdef HOWL_HAVE_MPFI
using Precise = boost::multiprecision::mpfi_float_50;

// The enclosure of f over [lo, hi] must hold f at both ends and between, as MPFI has it to fifty
// digits; and be no wider than a few ulp beyond the ends where f is monotone.
void ExpectHolds(const Interval& range, const Precise& value, const char* what) {
  ASSERT_TRUE(Precise(range.lower()) <= value) << what << " " << range.lower() - double(value);
  ASSERT_TRUE(Precise(range.upper()) >= value) << what;
}

TEST(IntervalTest, MonotoneFunctionsAgainstMpfi) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int draw = 0; draw < 3000; ++draw) {
    const double f = 50.0 + 400.0 * uniform(random);
    double a = f * std::exp(2.0 * uniform(random) - 1.0);
    double b = a * (1.0 + std::pow(10.0, -15.0 * uniform(random)));
    const Interval omega(a, b);
    const double angle = 1.5 * (2.0 * uniform(random) - 1.0);
    const Interval narrow(angle, angle + 1e-9 * uniform(random));
    Interval detuning, back, arctangent, tangent;
    {
      const RoundingGuard guard;
      detuning = DetuningOf(Interval(f), omega);
      back = OmegaOf(Interval(f), detuning);
      arctangent = Arctangent(10.0 * narrow);
      tangent = Tangent(narrow);
    }
    for (const double x : {a, b, 0.5 * (a + b)}) {
      const Precise p(x), q(f);
      ExpectHolds(detuning, (q / p - p / q) / 2, "detuning");
      ExpectHolds(back, p, "omega of detuning of omega");
    }
    EXPECT_LE(Width(back), Width(omega) + 1e-13 * b);
    for (const double x : {narrow.lower(), narrow.upper()}) {
      ExpectHolds(tangent, tan(Precise(x)), "tangent");
      ExpectHolds(arctangent, atan(10 * Precise(x)), "arctangent");
    }
  }
}
#else
TEST(IntervalTest, MonotoneFunctionsAgainstMpfi) {
  GTEST_SKIP() << "MPFI was not found when the tests were built";
}
#endif

TEST(IntervalTest, QuotientByAnIntervalThatTouchesZero) {
  const RoundingGuard guard;
  const Interval a = Quotient(Interval(1.0, 2.0), Interval(0.0, 4.0));
  EXPECT_EQ(a.lower(), 0.25);
  EXPECT_EQ(a.upper(), kUnbounded);
  const Interval b = Quotient(Interval(1.0, 2.0), Interval(-4.0, 0.0));
  EXPECT_EQ(b.lower(), -kUnbounded);
  EXPECT_EQ(b.upper(), -0.25);
  const Interval c = Quotient(Interval(1.0, 2.0), Interval(-1.0, 1.0));
  EXPECT_EQ(c.lower(), -kUnbounded);
  EXPECT_EQ(c.upper(), kUnbounded);
}

// A contractor loses no solution: boxes around random models that fulfil the equations exactly (by
// the independent reference) still hold them afterwards. Leading and lagging phases alike.
TEST(ContractTest, NoModelIsLost) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const int modes : {1, 2}) {
    int tried = 0;
    for (int draw = 0; draw < 20000; ++draw) {
      const double f = 200.0;
      LoopModel m{f * std::exp(1.2 * uniform(random) - (modes == 2 ? 1.1 : 0.6)),
                  0.01 + 0.5 * uniform(random),
                  1000.0 * std::exp(4.0 * uniform(random)),
                  modes == 2 ? 100.0 * std::exp(6.0 * uniform(random)) : 0.0,
                  0.0035,
                  3.0};
      const reference::Complex z = reference::G(reference::From(m), f);
      const double phase = double(std::arg(z));
      if (std::abs(phase) > 1.4) continue;
      ++tried;
      FamilyProblem problem;
      problem.experiments = {{.name = "one",
                              .phi = 0.5,
                              .frequency_hz = f,
                              .phase_deg = phase * 180 / M_PI,
                              .gain = double(std::abs(z))}};
      problem.model.modes = modes;
      problem.test.xi_max = 1.0;
      // Any second mode is drawn here; SecondModeTest has the share's own bound.
      problem.test.second_mode_share_max = std::numeric_limits<double>::infinity();
      m.tau_s = (1.5 * M_PI + phase) / (2 * M_PI * f);
      const double values[] = {m.omega_hz, m.xi, m.N, m.tau_s};
      const CellVariable variables[] = {kCellOmega, kCellXi, kCellN, kCellTau};
      const CellContractor contractor(problem);
      Cell cell = contractor.Root();
      // A box somewhere around the model in every variable, or all of its root.
      for (int k = 0; k < 4; ++k) {
        if (uniform(random) < 0.3) continue;
        const double below = values[k] * 0.3 * uniform(random);
        const double above = values[k] * 0.3 * uniform(random);
        Narrow(cell.boxes[0][variables[k]], Interval(values[k] - below, values[k] + above));
      }
      if (modes == 2 && uniform(random) < 0.7) {
        Narrow(cell.boxes[0][kCellM], Interval(0.8 * m.M, 1.3 * m.M));
      }
      ASSERT_TRUE(contractor.Contract(cell)) << draw;
      for (int k = 0; k < 4; ++k) {
        const Interval& x = cell.boxes[0][variables[k]];
        ASSERT_LE(x.lower(), values[k] * (1 + 1e-12)) << draw << " variable " << k;
        ASSERT_GE(x.upper(), values[k] * (1 - 1e-12)) << draw << " variable " << k;
      }
      if (modes == 2) {
        ASSERT_LE(cell.boxes[0][kCellM].lower(), m.M * (1 + 1e-12));
        ASSERT_GE(cell.boxes[0][kCellM].upper(), m.M * (1 - 1e-12));
        ASSERT_LE(cell.boxes[0][kCellRelative].lower(), m.M / m.N * (1 + 1e-12));
        ASSERT_GE(cell.boxes[0][kCellRelative].upper(), m.M / m.N * (1 - 1e-12));
      }
    }
    EXPECT_GT(tried, 5000) << modes;
  }
}

}  // namespace
}  // namespace howl::interval_test
