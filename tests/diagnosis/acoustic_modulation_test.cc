// Acoustics that move, against the modes' own equations integrated step by step, and the amplitude
// that moves them against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>

#include "diagnosis/cuts/acoustic_cut.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "model/numerics/constants.h"

namespace howl::acoustic_modulation_test {
namespace {

constexpr double kSampling_hz = 5000.0;
constexpr int kSamples = 8000;
constexpr double kDuration_s = kSamples / kSampling_hz;
constexpr Acoustics<double> kAcoustics{205.0, 0.12, 6000.0, 1500.0, kPaperHarmonicRatio};
constexpr double kSwing_hz = 25.0;  // of the damping: well within a mode's memory

// A damping that swings, of no amplitude's doing.
class Swing final : public NamedEffect {
 public:
  Swing() : NamedEffect("swing", LoopBlock::kAcoustics, {{"xi", "", 0.0, -0.1, 0.1, {0.01}}}) {}
  bool ChangesAcousticCut() const override { return true; }
  bool ModulatesAcoustics() const override { return true; }
  void ModulateAcoustics(double position, double /*amplitude*/, EffectValues x,
                         double* /*omega_factor*/, double* xi_add) const override {
    *xi_add += x[0] * std::cos(kTwoPi * kSwing_hz * kDuration_s * position);
  }
};

double HeatReleaseRate(double t) {  // q'
  double rate = 0.0;
  for (const auto& [hz, amplitude] :
       {std::pair{200.0, 1.0}, {211.25, 0.2}, {330.0, 0.1}, {600.0, 0.1}}) {
    rate -= amplitude * kTwoPi * hz * std::sin(kTwoPi * hz * t);
  }
  return rate;
}

double HeatRelease(double t) {
  double q = 0.0;
  for (const auto& [hz, amplitude] :
       {std::pair{200.0, 1.0}, {211.25, 0.2}, {330.0, 0.1}, {600.0, 0.1}}) {
    q += amplitude * std::cos(kTwoPi * hz * t);
  }
  return q;
}

// p'' + 2 xi(t) w p' + w^2 p = c q' of both modes, classical Runge-Kutta.
DiagnosisExperiment Integrated(double swing) {
  constexpr int kSteps = 16;
  constexpr double kStep_s = 1.0 / (kSampling_hz * kSteps);
  constexpr int kSettle = 1000;
  using State = std::array<double, 4>;
  const auto slope = [&](double t, const State& y) {
    const double xi =
        kAcoustics.xi + swing * std::cos(kTwoPi * kSwing_hz * (t - 0.5 * kDuration_s));
    State out{};
    for (std::size_t m = 0; m < 2; ++m) {
      const double w = kTwoPi * kAcoustics.omega_hz * (m == 0 ? 1.0 : kAcoustics.harmonic_ratio);
      const double c = m == 0 ? kAcoustics.N : kAcoustics.M;
      out[2 * m] = y[2 * m + 1];
      out[2 * m + 1] = c * HeatReleaseRate(t) - 2.0 * xi * w * y[2 * m + 1] - w * w * y[2 * m];
    }
    return out;
  };
  const auto along = [](const State& y, double h, const State& k) {
    State out = y;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += h * k[i];
    return out;
  };
  DiagnosisExperiment out{"exp", 0.5, {kSampling_hz, {}, {}}};
  State y{};
  for (int i = -kSettle; i < kSamples; ++i) {
    if (i >= 0) {
      out.record.pressure.push_back(y[0] + y[2]);
      out.record.heat_release.push_back(HeatRelease(i / kSampling_hz));
    }
    for (int j = 0; j < kSteps; ++j) {
      const double t = i / kSampling_hz + j * kStep_s;
      const State a = slope(t, y);
      const State b = slope(t + 0.5 * kStep_s, along(y, 0.5 * kStep_s, a));
      const State c = slope(t + 0.5 * kStep_s, along(y, 0.5 * kStep_s, b));
      const State d = slope(t + kStep_s, along(y, kStep_s, c));
      for (std::size_t k = 0; k < y.size(); ++k) {
        y[k] += kStep_s / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
      }
    }
  }
  return out;
}

double ResidualNorm(double made_with, double explained_with) {
  const std::vector<CutRecord> records = MakeCutRecords({Integrated(made_with)});
  const AcousticLocals locals(std::log(kAcoustics.omega_hz), std::log(kAcoustics.xi), kAcoustics.N,
                              kAcoustics.M);
  const std::array<double, 1> x = {explained_with};
  return AcousticResidual(records[0], Swing(), x, locals).norm();
}

TEST(AcousticModulation, DampingThatSwingsWithinTheModesMemory) {
  const double swing = 0.02;
  const double still = ResidualNorm(swing, 0.0);
  EXPECT_GT(still, 20.0 * ResidualNorm(0.0, 0.0));
  // Two passes leave the square of the relative swing.
  EXPECT_LT(ResidualNorm(swing, swing), 0.03 * still);
  EXPECT_GT(ResidualNorm(swing, -swing), 1.5 * still);
}

TEST(AcousticModulation, AmplitudeLagsBehindTheSignal) {
  const double beat_hz = 12.5;
  const double depth = 0.3;  // p = (1 + depth cos) cos
  DiagnosisExperiment one{"exp", 0.5, {kSampling_hz, {}, {}}};
  for (int i = 0; i < kSamples; ++i) {
    const double t = i / kSampling_hz;
    one.record.pressure.push_back(4.0 * (1.0 + depth * std::cos(kTwoPi * beat_hz * t)) *
                                  std::cos(kTwoPi * 200.0 * t));
    one.record.heat_release.push_back(HeatRelease(t));
  }
  const std::vector<CutRecord> records = MakeCutRecords({one});
  for (const int lags : {1, 2}) {
    const AmplitudeSense sense{0.03, lags, false};
    const Eigen::ArrayXd square = SquaredAmplitude(records[0], sense);
    // (1 + d c)^2 = 1 + d^2 / 2 + 2 d c + d^2 / 2 cos 2, each line through the lags.
    const auto lag = [&](double hz) {
      return std::pow(1.0 / std::complex<double>(1.0, kTwoPi * hz * sense.memory_s / lags), lags);
    };
    const double mean = 1.0 + 0.5 * depth * depth;
    for (int i = 0; i < kSamples; i += 97) {
      const double t = i / kSampling_hz;
      const double first =
          (2.0 * depth * lag(beat_hz) * std::polar(1.0, kTwoPi * beat_hz * t)).real();
      const double second =
          (0.5 * depth * depth * lag(2.0 * beat_hz) * std::polar(1.0, 2.0 * kTwoPi * beat_hz * t))
              .real();
      // Around twice the carrier lines of amplitude (1 + d)^2 in all are left, none below 375 Hz.
      EXPECT_NEAR(square[i], (mean + first + second) / mean,
                  std::pow(1.0 + depth, 2) / mean * std::abs(lag(375.0)));
    }
  }
}

}  // namespace
}  // namespace howl::acoustic_modulation_test
