// The duct and the delay against closed forms.
#include "rig/duct.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rig/constants.h"
#include "rig/delay_line.h"
#include "rig/filters.h"

namespace rig::duct_test {
namespace {

TEST(Duct, HasTheResponseOfTwoModes) {
  for (const double xi : {0.02, 0.06, 0.12, 0.2}) {
    const Modes modes{.omega_hz = 210.0, .xi = xi, .N = 5000.0, .M = 1300.0};
    const Duct duct = DesignDuct(modes, 5e-5);
    EXPECT_LT(LargestMismatch(duct, modes, 30.0, 1800.0), 5e-4) << xi;
  }
  for (const double ratio : {2.65, 3.4}) {
    for (const double factor : {0.6, 1.6}) {
      const Modes modes{210.0, 0.12, 5000.0, 1300.0, ratio, factor};
      EXPECT_LT(LargestMismatch(DesignDuct(modes, 5e-5), modes, 30.0, 1800.0), 2e-3)
          << ratio << " " << factor;
    }
  }
}

// The modes' poles, in closed form, are poles of the duct.
TEST(Duct, ComesBackInPhaseAtItsPoles) {
  const Modes modes{.omega_hz = 190.0, .xi = 0.09, .N = 4000.0, .M = 900.0};
  const Duct duct = DesignDuct(modes, 6e-5);
  for (const double times : {1.0, 3.0}) {
    const Complex pole = kTwoPi * 190.0 * times * Complex(-0.09, std::sqrt(1.0 - 0.09 * 0.09));
    Complex round_trip = 0.0;
    for (std::size_t k = 0; k < duct.reflection.size(); ++k) {
      round_trip += duct.reflection[k] * std::exp(-pole * (static_cast<double>(k) * 6e-5));
    }
    EXPECT_NEAR(std::abs(round_trip - 1.0), 0.0, 1e-9) << times;
  }
}

// Driven by an impulse, sample by sample, the duct rings as the modes do: the inverse transform of
// N s / (s^2 + 2 xi w s + w^2) is N e^(-xi w t) (cos w_d t - xi w / w_d sin w_d t).
TEST(Duct, RingsAsItsModes) {
  const double step_s = 2.5e-5;
  const Modes modes{.omega_hz = 200.0, .xi = 0.1, .N = 1000.0, .M = 0.0};
  const Duct duct = DesignDuct(modes, step_s);
  std::vector<double> p(1200, 0.0);
  // A pulse without high frequencies: normal, 0.4 ms wide; its transform at the mode's pole is the
  // factor by which the ringing is larger.
  const double width_s = 4e-4;
  const double centre_s = 2.4e-3;
  std::vector<double> q(p.size());
  for (std::size_t n = 0; n < q.size(); ++n) {
    const double x = (static_cast<double>(n) * step_s - centre_s) / width_s;
    q[n] = std::exp(-0.5 * x * x) / (width_s * std::sqrt(kTwoPi));
  }
  for (std::size_t n = 0; n < p.size(); ++n) {
    for (std::size_t k = 0; k < duct.distribution.size() && k <= n; ++k) {
      p[n] += duct.distribution[k] * q[n - k];
    }
    for (std::size_t k = 1; k < duct.reflection.size() && k <= n; ++k) {
      p[n] += duct.reflection[k] * p[n - k];
    }
  }
  const double w = kTwoPi * 200.0;
  const Complex pole = w * Complex(-0.1, std::sqrt(0.99));
  const Complex residue = 1000.0 * pole / (pole - std::conj(pole));
  const Complex pulse = std::exp(0.5 * pole * pole * width_s * width_s);
  for (std::size_t n = 240; n < p.size(); ++n) {
    const double t = static_cast<double>(n) * step_s - centre_s;
    const double expected = 2.0 * (residue * pulse * std::exp(pole * t)).real();
    EXPECT_NEAR(p[n], expected, 1.5) << n;  // of 1000
  }
}

TEST(DelayLine, ConvergesAtItsOrder) {
  double before_value = 0.0;
  double before_slope = 0.0;
  for (const int refine : {1, 2, 4}) {
    const double step = 0.4 / refine;
    std::vector<double> x(200);
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] = std::sin(step * (static_cast<double>(i) - 199.0));
    }
    double value_error = 0.0;
    double slope_error = 0.0;
    for (const double part : {0.13, 0.37, 0.81}) {
      const double delay = 20.0 + part;
      Filter value;
      value.Add(ValueAt(delay), 1.0);
      value.Finish();
      Filter slope;
      slope.Add(SlopeAt(delay), 1.0 / step);
      slope.Finish();
      value_error = std::max(value_error, std::abs(value(&x[199]) - std::sin(-delay * step)));
      slope_error = std::max(slope_error, std::abs(slope(&x[199]) - std::cos(-delay * step)));
    }
    if (refine > 1) {
      // The phase at which it is read differs; half an order is left for that.
      EXPECT_GT(std::log2(before_value / value_error), 4.5);
      EXPECT_GT(std::log2(before_slope / slope_error), 4.0);
    }
    before_value = value_error;
    before_slope = slope_error;
  }
}

TEST(Filters, HaveTheirClosedForms) {
  const double step_s = 5e-5;
  const double f = 300.0;
  Lag lag(400.0, step_s);
  SideBranch branch(500.0, 0.1, 700.0, step_s);
  SecondOrder resonance(800.0, 0.2, 1.0, 0.0, 0.0, step_s);
  const Complex s(0.0, kTwoPi * f);
  const auto response = [&](auto& filter) {
    Complex sum = 0.0;
    const int period = 200;  // 3 cycles
    for (int n = 0; n < 40 * period; ++n) {
      const double y = filter.Next(std::cos(kTwoPi * f * n * step_s));
      if (n >= 20 * period) sum += y * std::polar(1.0, -kTwoPi * f * n * step_s);
    }
    return sum * 2.0 / (20.0 * period);
  };
  const double w = kTwoPi * 500.0;
  const double w2 = kTwoPi * 800.0;
  EXPECT_NEAR(std::abs(response(lag) - 1.0 / (1.0 + s / (kTwoPi * 400.0))), 0.0, 2e-3);
  EXPECT_NEAR(std::abs(response(branch) / (700.0 * s / (s * s + 0.2 * w * s + w * w)) - 1.0), 0.0,
              2e-3);
  EXPECT_NEAR(std::abs(response(resonance) / (w2 * w2 / (s * s + 0.4 * w2 * s + w2 * w2)) - 1.0),
              0.0, 2e-3);
}

}  // namespace
}  // namespace rig::duct_test
