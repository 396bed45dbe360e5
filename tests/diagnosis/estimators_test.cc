// The parts of the diagnosis against closed forms and synthetic signals of known make.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/noise/noise_fit.h"
#include "diagnosis/numerics/real_fft.h"
#include "diagnosis/records/cut_record.h"
#include "estimation/record_fit/spectra/flame_basis.h"

namespace howl::estimators_test {
namespace {

Eigen::VectorXcd Noise(const Eigen::VectorXd& variance, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal(0.0, std::sqrt(0.5));
  Eigen::VectorXcd out(variance.size());
  for (Eigen::Index k = 0; k < out.size(); ++k) {
    out[k] = std::sqrt(variance[k]) * std::complex<double>(normal(generator), normal(generator));
  }
  return out;
}

TEST(RealFft, RoundTripAndALine) {
  const Eigen::Index n = 360;
  Eigen::VectorXd x(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    x[i] = std::cos(2.0 * M_PI * 7.0 * static_cast<double>(i) / static_cast<double>(n) + 0.4);
  }
  const Eigen::VectorXcd spectrum = ForwardFft(x);
  EXPECT_NEAR(std::abs(spectrum[7] - std::polar(180.0, 0.4)), 0.0, 1e-10);
  EXPECT_NEAR((InverseFft(spectrum, n) - x).norm(), 0.0, 1e-11);
}

TEST(CutRecord, WindowIsTheFourthPowerOfASine) {
  // Under the taps a constant spectrum is an impulse at the record's start, where the window is 0;
  // an alternating one is an impulse in the middle, where it is 1.
  const Eigen::VectorXcd constant = Eigen::VectorXcd::Ones(9);
  Eigen::VectorXcd alternating(9);
  for (Eigen::Index k = 0; k < 9; ++k) alternating[k] = k % 2 == 0 ? 1.0 : -1.0;
  EXPECT_NEAR(ApplyWindow(constant, 5).norm(), 0.0, 1e-15);
  EXPECT_NEAR(std::abs(ApplyWindow(alternating, 5)[0]), 1.0, 1e-15);
}

DiagnosisExperiment Sine(std::size_t samples, double sampling_hz, double frequency_hz) {
  DiagnosisExperiment out{"sine", 0.5, {}};
  out.record.sampling_hz = sampling_hz;
  for (std::size_t i = 0; i < samples; ++i) {
    const double angle =
        2.0 * std::numbers::pi * frequency_hz * static_cast<double>(i) / sampling_hz;
    out.record.pressure.push_back(std::sin(angle));
    out.record.heat_release.push_back(std::cos(angle));
  }
  return out;
}

TEST(CutRecord, WhatCannotBeCutIsToldWhy) {
  const auto obstacle = [](const std::vector<DiagnosisExperiment>& rig) {
    const auto found = FindCutObstacle(rig);
    return found ? std::to_string(found->experiment) + " " + found->what : std::string();
  };
  const DiagnosisExperiment good = Sine(5000, 5000.0, 200.0);
  EXPECT_EQ(obstacle({good, good}), "");
  EXPECT_EQ(obstacle({good, Sine(4000, 5000.0, 200.0)}),
            "1 has 4000 samples, expected at least 4096");
  EXPECT_EQ(obstacle({Sine(5000, 99.0, 30.0), good}),
            "0 is sampled at 99 Hz, expected at least 100 Hz");
  DiagnosisExperiment twice = good;
  twice.record.heat_release = twice.record.pressure;
  EXPECT_EQ(obstacle({twice}), "0 has the same samples as p and as q, expected two signals");
  EXPECT_EQ(obstacle({Sine(5000, 25000.0, 50.0)}),
            "0 has 10 cycles of the rig's strongest line, expected at least 20");
}

TEST(CutRecord, BinCorrelationIsThatOfTheTaps) {
  double taps[5] = {kWindowTaps[2], kWindowTaps[1], kWindowTaps[0], kWindowTaps[1], kWindowTaps[2]};
  double zero = 0.0;
  double sum = 0.0;
  for (int lag = -4; lag <= 4; ++lag) {
    double r = 0.0;
    for (int i = 0; i < 5; ++i) {
      if (i + lag >= 0 && i + lag < 5) r += taps[i] * taps[i + lag];
    }
    if (lag == 0) zero = r;
    sum += r * r;
  }
  EXPECT_NEAR(kBinCorrelation, sum / (zero * zero), 1e-12);
}

TEST(FlameBasis, ReproducesCubics) {
  const FlameBasis basis(2.0);
  const Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(400, -2.0, 2.0);
  Eigen::MatrixXd columns(v.size(), kFlameTerms + 1);
  columns << basis.Columns(v), Eigen::VectorXd::Ones(v.size());  // the constant that is left out
  const Eigen::VectorXd cubic = 0.3 * v.array().cube() - v.array().square() + 2.0 * v.array() + 1.0;
  const Eigen::VectorXd c = columns.colPivHouseholderQr().solve(cubic);
  EXPECT_NEAR((columns * c - cubic).cwiseAbs().maxCoeff(), 0.0, 1e-12);
  EXPECT_NEAR(
      (basis.Value(v, c.head(kFlameTerms)) - columns.leftCols(kFlameTerms) * c.head(kFlameTerms))
          .norm(),
      0.0, 1e-12);
  const double rise = (0.9 * v.array().square() - 2.0 * v.array() + 2.0).mean();
  EXPECT_NEAR(basis.MeanSlopes(v).dot(c.head(kFlameTerms)), rise, 1e-12);
}

TEST(FlameBasis, DoesNotRiseBeyondItsRange) {
  EXPECT_EQ(FlameBasis(2.0).MeanSlopes(Eigen::Vector2d(-2.1, 5.0)).norm(), 0.0);
}

// The mean over 60 draws lies within three standard errors of the truth, and so do single draws.
TEST(NoiseFit, SensorVariancesWithoutBias) {
  const Eigen::Index n = 4000;
  const Eigen::VectorXd gain_squared =
      (Eigen::ArrayXd::LinSpaced(n, -3.0, 3.0).square() * -1.0).exp() * 150.0;
  const Eigen::VectorXd truth = 0.5 + 0.01 * gain_squared.array();
  const std::vector<char> masked(static_cast<std::size_t>(n), 0);
  double mean_top = 0.0;
  double mean_end = 0.0;
  const int draws = 60;
  for (int i = 0; i < draws; ++i) {
    const Eigen::VectorXd fit =
        AcousticNoise(Noise(truth, static_cast<unsigned>(i)), gain_squared, masked);
    mean_top += fit[n / 2] / truth[n / 2] / draws;
    mean_end += fit[0] / truth[0] / draws;
  }
  EXPECT_NEAR(mean_top, 1.0, 0.02);
  EXPECT_NEAR(mean_end, 1.0, 0.01);
}

TEST(NoiseFit, ColourOfCombustionNoise) {
  const Eigen::Index n = 4000;
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(n, 0.0, 1.0);
  const Eigen::VectorXd truth = 2.0 / (1.0 + (x / 0.4).square());
  const Eigen::VectorXd fit =
      FlameNoise(Noise(truth, 3), std::vector<char>(static_cast<std::size_t>(n), 0));
  EXPECT_LT((fit.array() / truth.array() - 1.0).abs().mean(), 0.06);
}

TEST(NoiseFit, ALineDoesNotRaiseTheNoise) {
  const Eigen::VectorXd truth = Eigen::VectorXd::Constant(4000, 2.0);
  Eigen::VectorXcd residual = Noise(truth, 4);
  residual[1000] = 1e4;
  residual[1001] = 1e4;
  const Eigen::VectorXd fit = FlameNoise(residual, std::vector<char>(4000, 0));
  EXPECT_LT((fit.array() / 2.0 - 1.0).abs().maxCoeff(), 0.2);
}

}  // namespace
}  // namespace howl::estimators_test
