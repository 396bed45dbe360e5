#include "model/cycles/balance_equations.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace howl::internal {
namespace {

using Complex64 = std::complex<double>;

// Powers of e^(2 pi j / n): index arithmetic instead of a transform, H being small.
class Circle {
 public:
  explicit Circle(int n) : points_(static_cast<std::size_t>(n)) {
    for (int i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / n;
      points_[static_cast<std::size_t>(i)] = {std::cos(angle), std::sin(angle)};
    }
  }
  std::size_t size() const { return points_.size(); }
  const Complex64& operator()(std::size_t k, std::size_t i) const {
    return points_[(k * i) % points_.size()];
  }

 private:
  std::vector<Complex64> points_;
};

std::vector<double> Sample(const std::vector<Complex64>& series, const Circle& circle) {
  std::vector<double> values(circle.size(), 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t k = 0; k < series.size(); ++k) {
      const Complex64& e = circle(k, i);
      values[i] += series[k].real() * e.real() - series[k].imag() * e.imag();
    }
  }
  return values;
}

// X_k, k = 0 .. H, of x(t) = Re sum X_k e^(j k theta).
std::vector<Complex64> Transform(const std::vector<double>& values, std::size_t harmonics,
                                 const Circle& circle) {
  std::vector<Complex64> series(harmonics + 1);
  for (std::size_t k = 0; k <= harmonics; ++k) {
    Complex64 sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * std::conj(circle(k, i));
    series[k] = sum * ((k == 0 ? 1.0 : 2.0) / static_cast<double>(values.size()));
  }
  return series;
}

// Samples in time: enough that aliases of the flame's harmonics are as small as the tail.
int TimeSamples(std::size_t harmonics) {
  int n = 64;
  while (n < 8 * static_cast<int>(harmonics)) n *= 2;
  return n;
}

Complex64 JOmega(double frequency_hz, std::size_t k) {
  return {0.0, kRadPerSPerHz * frequency_hz * static_cast<double>(k)};
}

}  // namespace

double RateScale(const Flame<double>& flame) { return flame.saturation / std::abs(flame.slope); }

Eigen::VectorXd PackState(const BalanceState& state, double rate_scale) {
  const auto h = static_cast<Eigen::Index>(state.rate.size()) - 1;
  Eigen::VectorXd u(2 * h);
  u(0) = state.rate[1].real() / rate_scale;
  u(1) = std::log(state.frequency_hz);
  for (Eigen::Index k = 2; k <= h; ++k) {
    const Complex64& v = state.rate[static_cast<std::size_t>(k)];
    u(2 * k - 2) = v.real() / rate_scale;
    u(2 * k - 1) = v.imag() / rate_scale;
  }
  return u;
}

BalanceState UnpackState(const Eigen::VectorXd& u, double rate_scale) {
  BalanceState state;
  const Eigen::Index h = u.size() / 2;
  state.rate.assign(static_cast<std::size_t>(h) + 1, 0.0);
  state.rate[1] = u(0) * rate_scale;
  state.frequency_hz = std::exp(u(1));
  for (Eigen::Index k = 2; k <= h; ++k) {
    state.rate[static_cast<std::size_t>(k)] = rate_scale * Complex64(u(2 * k - 2), u(2 * k - 1));
  }
  return state;
}

Eigen::VectorXd BalanceResiduals(const ClosedLoop& model, const BalanceState& state,
                                 Eigen::MatrixXd* jacobian) {
  const std::size_t h = state.rate.size() - 1;
  const double scale = RateScale(model.flame);
  const Circle circle(TimeSamples(h));
  const std::vector<double> v = Sample(state.rate, circle);
  std::vector<double> q(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) q[i] = FlameResponse(model.flame, v[i]);
  const std::vector<Complex64> heat = Transform(q, h, circle);

  std::vector<ModeTransfer> loop(h + 1);
  for (std::size_t k = 1; k <= h; ++k) {
    loop[k] = LoopTransfer(model.loop, JOmega(state.frequency_hz, k));
  }
  const double v1 = state.rate[1].real();
  Eigen::VectorXd r(static_cast<Eigen::Index>(2 * h));
  for (std::size_t k = 1; k <= h; ++k) {
    const Complex64 residual = k == 1 ? 1.0 - loop[1].value * heat[1] / v1
                                      : (state.rate[k] - loop[k].value * heat[k]) / scale;
    r(static_cast<Eigen::Index>(2 * k - 2)) = residual.real();
    r(static_cast<Eigen::Index>(2 * k - 1)) = residual.imag();
  }
  if (jacobian == nullptr) return r;

  std::vector<double> slope(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) slope[i] = FlameSlope(model.flame, v[i]);
  const std::vector<Complex64> doubled = Transform(slope, 2 * h, circle);
  const auto g = [&doubled](std::size_t k, std::size_t m) {  // g_(k - m)
    if (k == m) return doubled[0];
    return 0.5 * (k > m ? doubled[k - m] : std::conj(doubled[m - k]));
  };
  jacobian->resize(r.size(), r.size());
  for (std::size_t k = 1; k <= h; ++k) {
    const double row_scale = k == 1 ? v1 : scale;
    const auto row = static_cast<Eigen::Index>(2 * k - 2);
    const auto set = [&](Eigen::Index column, const Complex64& value) {
      (*jacobian)(row, column) = value.real();
      (*jacobian)(row + 1, column) = value.imag();
    };
    for (std::size_t m = 1; m <= h; ++m) {
      const Complex64 minus = g(k, m);
      const Complex64 plus = 0.5 * doubled[k + m];
      const auto column = static_cast<Eigen::Index>(2 * m - 2);
      const double same = k == m ? 1.0 : 0.0;
      Complex64 d_re = (same - loop[k].value * (minus + plus)) * scale / row_scale;
      if (k == 1 && m == 1) {  // of 1 - L Q_1 / V_1
        d_re = -loop[1].value * (minus + plus - heat[1] / v1) * scale / v1;
      }
      set(column, d_re);
      if (m > 1) {
        const Complex64 j(0.0, 1.0);
        set(column + 1, (same * j - loop[k].value * j * (minus - plus)) * scale / row_scale);
      }
    }
    set(1, -JOmega(state.frequency_hz, k) * loop[k].derivative * heat[k] / row_scale);
  }
  return r;
}

double Tail(const std::vector<std::complex<double>>& rate) {
  const std::size_t h = rate.size() - 1;
  double largest = 0.0;
  for (std::size_t k = 3 * h / 4 + 1; k <= h; ++k) largest = std::max(largest, std::abs(rate[k]));
  return largest / std::abs(rate[1]);
}

LimitCycle MakeLimitCycle(const ClosedLoop& model, const BalanceState& state) {
  LimitCycle cycle;
  cycle.frequency_hz = state.frequency_hz;
  cycle.rate = state.rate;
  cycle.tail = Tail(state.rate);
  const std::size_t h = state.rate.size() - 1;
  const Circle circle(TimeSamples(h));
  std::vector<double> values = Sample(state.rate, circle);
  for (double& value : values) value = FlameResponse(model.flame, value);
  cycle.heat_release = Transform(values, h, circle);
  cycle.pressure.assign(h + 1, 0.0);
  for (std::size_t k = 1; k <= h; ++k) {
    const Complex64 s = JOmega(state.frequency_hz, k);
    cycle.pressure[k] = RateTransfer(model.loop.acoustics, s) / s * cycle.heat_release[k];
  }
  return cycle;
}

}  // namespace howl::internal
