#include "diagnosis/table/table_diagnosis.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>

#include "model/numerics/constants.h"
#include "model/numerics/units.h"

namespace howl {
namespace {

using Complex64 = std::complex<double>;

constexpr double kLargestLag_deg = 60.0;
constexpr double kLagStep_deg = 0.5;
constexpr int kXis = 16;
constexpr int kSecondModes = 12;
constexpr int kOmegas = 48;
constexpr double kOmegaMost = 1.8;  // over f

Complex64 UnitMode(double omega_hz, double xi, double f) {
  const Complex<double> u = UnitModeResponse(kRadPerSPerHz * omega_hz, xi, kRadPerSPerHz * f);
  return {u.re, u.im};
}

// One experiment at one lag, and one damping and second mode; omega and N follow from arg G(f) and
// |G(f)|.
class Point {
 public:
  Point(const Experiment& experiment, double lag_deg, const TableLimits& limits)
      : experiment_(experiment),
        limits_(limits),
        f_(experiment.frequency_hz),
        target_(std::polar(1.0, -(experiment.phase_deg - lag_deg) * kRadPerDeg)),
        gain_(experiment.gain * std::cos(lag_deg * kRadPerDeg)),
        tau_s_(DelayAtLag(experiment, lag_deg)) {}

  bool Agrees() const {
    for (int i = 0; i < kXis; ++i) {
      const double xi =
          limits_.xi_min * std::pow(limits_.xi_max / limits_.xi_min, i / (kXis - 1.0));
      // About the size of N, beyond which a mode is not the second.
      const double scale = 4.0 * gain_ * xi * kRadPerSPerHz * f_;
      const double most = limits_.modes == 1 ? 0.0 : std::min(limits_.M_max, scale);
      for (int k = 0; k <= (limits_.modes == 1 ? 0 : kSecondModes); ++k) {
        if (AgreesWith(xi, most * k / kSecondModes)) return true;
      }
    }
    return false;
  }

 private:
  // N from |N u1 + M u2| = gain; NaN if there is none above zero.
  double FirstCoefficient(Complex64 u1, Complex64 u2, double M) const {
    const double a = std::norm(u1);
    const double b = M * (u1 * std::conj(u2)).real();
    const double c = M * M * std::norm(u2) - gain_ * gain_;
    const double root = b * b - a * c;
    if (root < 0.0) return kNaN;
    const double N = (-b + std::sqrt(root)) / a;
    return N > 0.0 && M <= limits_.M_over_N_max * N ? N : kNaN;
  }

  // Sine of arg G(f) less what it must be; NaN where there is no N or the angle is opposite.
  double PhaseError(double omega_hz, double xi, double M, double* N) const {
    const Complex64 u1 = UnitMode(omega_hz, xi, f_);
    const Complex64 u2 = M > 0.0 ? UnitMode(limits_.harmonic_ratio * omega_hz, xi, f_) : 0.0;
    *N = FirstCoefficient(u1, u2, M);
    const Complex64 g = (*N * u1 + M * u2) / gain_ * target_;
    return g.real() > 0.0 ? g.imag() : kNaN;
  }

  bool AgreesWith(double xi, double M) const {
    const double low = std::max(limits_.omega_min_hz, 0.2 * f_);
    const double step = (kOmegaMost * f_ - low) / kOmegas;
    double N = 0.0;
    double before = PhaseError(low, xi, M, &N);
    for (int i = 1; i <= kOmegas; ++i) {
      const double omega = low + step * i;
      const double now = PhaseError(omega, xi, M, &N);
      if (before * now <= 0.0 && LineAgrees(Root(omega - step, omega, before, xi, M), xi, M)) {
        return true;
      }
      before = now;
    }
    return false;
  }

  double Root(double low, double high, double at_low, double xi, double M) const {
    double N = 0.0;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (low + high);
      const double now = PhaseError(middle, xi, M, &N);
      (at_low * now > 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  // The loop's phase passes through 180 degrees within the line's window.
  bool LineAgrees(double omega_hz, double xi, double M) const {
    double N = 0.0;
    if (!(std::abs(PhaseError(omega_hz, xi, M, &N)) < 1e-6)) return false;
    const auto error_deg = [&](double f2) {
      const Complex64 g =
          N * UnitMode(omega_hz, xi, f2) + M * UnitMode(limits_.harmonic_ratio * omega_hz, xi, f2);
      return WrapDeg(90.0 + 360.0 * tau_s_ * f2 - std::arg(g) * kDegPerRad);
    };
    return std::ranges::all_of(experiment_.lines, [&](const ObservedLine& line) {
      const double half = limits_.line_sigmas * line.frequency_std_hz;
      const double low = error_deg(line.frequency_hz - half);
      const double high = error_deg(line.frequency_hz + half);
      // A crossing rises with frequency; at a wrap the angle falls by 360 degrees instead.
      return low <= 0.0 && high >= 0.0 && high - low < 180.0;
    });
  }

  const Experiment& experiment_;
  const TableLimits& limits_;
  double f_;
  Complex64 target_;
  double gain_;
  double tau_s_;
};

// The longest run of lags that agree, with its ends found by bisection.
LagInterval Interval(const std::function<bool(double)>& agrees) {
  LagInterval best;
  const int count = static_cast<int>(2.0 * kLargestLag_deg / kLagStep_deg);
  const auto lag = [](int i) { return -kLargestLag_deg + kLagStep_deg * i; };
  const auto edge = [&](double inside, double outside) {
    for (int i = 0; i < 12; ++i) {
      const double middle = 0.5 * (inside + outside);
      (agrees(middle) ? inside : outside) = middle;
    }
    return inside;
  };
  int first = -1;
  int best_length = 0;
  int best_first = 0;
  for (int i = 0; i <= count + 1; ++i) {
    const bool now = i <= count && agrees(lag(i));
    if (now && first < 0) first = i;
    if (now || first < 0) continue;
    if (i - first > best_length) {
      best_length = i - first;
      best_first = first;
    }
    first = -1;
  }
  if (best_length == 0) return best;
  const int last = best_first + best_length - 1;
  best.any = true;
  best.low_deg = best_first == 0 ? lag(0) : edge(lag(best_first), lag(best_first - 1));
  best.high_deg = last == count ? lag(count) : edge(lag(last), lag(last + 1));
  return best;
}

Candidate Explains(const char* effect, std::vector<EstimatedParameter> parameters) {
  Candidate candidate;
  candidate.effect = effect;
  candidate.block = LoopBlock::kHeatReleaseInstrument;
  candidate.gain = candidate.gap_after = candidate.shrinkage = kNaN;
  candidate.shrinkage_low = candidate.shrinkage_high = candidate.p_value = kNaN;
  candidate.parameters = std::move(parameters);
  return candidate;
}

Diagnosis Verdict(const TableDiagnosis& table) {
  Diagnosis out;
  out.kind = VerdictKind::kUnknown;
  out.probability_unknown = 1.0;
  out.gap_before = out.gap_after = out.gap_floor = kNaN;
  out.advice =
      table.lag.any
          ? "record p and q at two operating points: published characteristics bound the lag of "
            "the q sensor, but a lag, a shift between channels and a longer delay are the same "
            "there"
          : "check the table: no lag of the q sensor makes frequency, phase, gain and line agree";
  if (!table.lag.any) return out;
  EstimatedParameter lag{"lag_deg", kNaN, table.lag.low_deg, table.lag.high_deg, "deg"};
  lag.at_bound = table.lag.low_deg <= -kLargestLag_deg || table.lag.high_deg >= kLargestLag_deg;
  const double per_deg = 1.0 / (360.0 * table.mean_frequency_hz);
  out.candidates = {
      Explains("q_sensor_lowpass", {{"cutoff_hz", kNaN, table.cutoff_min_hz, kNaN, "Hz"}, lag}),
      Explains(
          "channel_skew",
          {{"skew_s", kNaN, table.lag.low_deg * per_deg, table.lag.high_deg * per_deg, "s"}, lag})};
  out.indistinguishable = {"q_sensor_lowpass", "channel_skew"};
  return out;
}

}  // namespace

double DelayAtLag(const Experiment& experiment, double lag_deg) {
  const double turns = (270.0 + experiment.phase_deg - lag_deg) / 360.0 + experiment.delay_periods;
  return turns / experiment.frequency_hz;
}

bool AgreesAtLag(const Experiment& experiment, double lag_deg, const TableLimits& limits) {
  return Point(experiment, lag_deg, limits).Agrees();
}

TableDiagnosis DiagnoseTable(const std::vector<Experiment>& experiments,
                             const TableLimits& limits) {
  TableDiagnosis out;
  std::vector<const Experiment*> with_lines;
  for (const Experiment& experiment : experiments) {
    if (!experiment.lines.empty()) with_lines.push_back(&experiment);
  }
  CHECK(!with_lines.empty());
  for (const Experiment* e : with_lines) {
    out.mean_frequency_hz += e->frequency_hz / static_cast<double>(with_lines.size());
  }
  const auto own_lag_deg = [&](const Experiment& e, double lag_deg) {
    return std::atan(std::tan(lag_deg * kRadPerDeg) * e.frequency_hz / out.mean_frequency_hz) *
           kDegPerRad;
  };
  const auto agrees = [&](const Experiment& e, double lag_deg) {
    return AgreesAtLag(e, own_lag_deg(e, lag_deg), limits);
  };
  for (const Experiment* e : with_lines) {
    out.experiments.push_back({e->name, Interval([&](double lag) { return agrees(*e, lag); }),
                               DelayAtLag(*e, 0.0), 0.0, 0.0});
  }
  out.lag.any = true;
  out.lag.low_deg = -kLargestLag_deg;
  out.lag.high_deg = kLargestLag_deg;
  for (const TableExperiment& e : out.experiments) {
    out.lag.any = out.lag.any && e.lag.any;
    out.lag.low_deg = std::max(out.lag.low_deg, e.lag.low_deg);
    out.lag.high_deg = std::min(out.lag.high_deg, e.lag.high_deg);
  }
  out.lag.any = out.lag.any && out.lag.low_deg <= out.lag.high_deg;
  if (out.lag.any) {
    out.cutoff_min_hz = out.lag.high_deg > 0.0
                            ? out.mean_frequency_hz / std::tan(out.lag.high_deg * kRadPerDeg)
                            : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < with_lines.size(); ++i) {
      const Experiment& e = *with_lines[i];
      out.experiments[i].tau_low_s = DelayAtLag(e, own_lag_deg(e, out.lag.high_deg));
      out.experiments[i].tau_high_s = DelayAtLag(e, own_lag_deg(e, out.lag.low_deg));
    }
  }
  out.diagnosis = Verdict(out);
  return out;
}

}  // namespace howl
