// What the likelihood of several bins side by side gives, against Sigma of one bin after another.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>

#include "estimation/record_fit/whittle/whittle.h"
#include "estimation/record_fit/whittle/whittle_weights.h"

namespace howl::whittle_lanes_test {
namespace {

using C = std::complex<double>;

std::vector<NoiseTerm> AllSources() {
  std::vector<NoiseTerm> out;
  for (std::size_t j = 0; j < kMostNoiseTerms; ++j) out.push_back({static_cast<LoopNoise>(j), 1});
  return out;
}

// Numbers of every size between a tenth and ten, that need no generator.
double Number(Eigen::Index i) { return std::pow(10.0, std::sin(1.7 * static_cast<double>(i))); }

C ComplexNumber(Eigen::Index i) { return std::polar(Number(i), 0.9 * static_cast<double>(i)); }

LoopResiduals Residuals(Eigen::Index first, Eigen::Index bins) {
  LoopResiduals out;
  for (Eigen::VectorXcd* of : {&out.r, &out.f, &out.acoustic, &out.flame}) of->resize(bins);
  out.spectra.resize(bins, static_cast<Eigen::Index>(kMostNoiseTerms));
  out.background_ratio = 0.3;
  for (Eigen::Index i = 0; i < bins; ++i) {
    out.r[i] = ComplexNumber(4 * (first + i));
    out.f[i] = ComplexNumber(4 * (first + i) + 1);
    out.acoustic[i] = ComplexNumber(4 * (first + i) + 2);
    out.flame[i] = ComplexNumber(4 * (first + i) + 3);
    for (Eigen::Index j = 0; j < out.spectra.cols(); ++j) {
      out.spectra(i, j) = Number(100 + 9 * (first + i) + j);
    }
  }
  return out;
}

Eigen::VectorXd Shares(Eigen::Index first, Eigen::Index bins) {
  Eigen::VectorXd out(bins);
  for (Eigen::Index i = 0; i < bins; ++i) out[i] = 1.0 / static_cast<double>(2 + first + i);
  return out;
}

constexpr Eigen::Index kBins = 77;  // nine times eight lanes, and five that are left

TEST(WhittleLanes, ValueIsThatOfBinAfterBin) {
  const std::vector<NoiseTerm> noise = AllSources();
  const LoopResiduals at = Residuals(0, kBins);
  const Eigen::VectorXd share = Shares(0, kBins);
  double expected = 0.0;
  for (Eigen::Index i = 0; i < kBins; ++i) {
    const Eigen::Matrix2cd sigma = NoiseCovariance(noise, at, i);
    const Eigen::Vector2cd e(at.acoustic[i], at.flame[i]);
    const C square = e.dot(sigma.inverse() * e);
    expected -= share[i] * (std::log(sigma.determinant().real()) + square.real());
  }
  EXPECT_NEAR(WhittleLogLikelihood(noise, share, at), expected, 1e-10 * std::abs(expected));
}

TEST(WhittleLanes, ABinWeighsWhatItWeighsAlone) {
  const std::vector<NoiseTerm> noise = AllSources();
  WhittleWeights all;
  WeighBins(noise, Shares(0, kBins), Residuals(0, kBins), &all);
  double ratio = 0.0;
  for (Eigen::Index i = 0; i < kBins; ++i) {
    WhittleWeights alone;
    WeighBins(noise, Shares(i, 1), Residuals(i, 1), &alone);
    EXPECT_EQ(all.r[i], alone.r[0]) << i;
    EXPECT_EQ(all.f[i], alone.f[0]) << i;
    EXPECT_EQ(all.acoustic[i], alone.acoustic[0]) << i;
    EXPECT_EQ(all.flame[i], alone.flame[0]) << i;
    EXPECT_EQ(all.log_spectra.row(i), alone.log_spectra.row(0)) << i;
    ratio += alone.ratio;
  }
  EXPECT_NEAR(all.ratio, ratio, 1e-12 * std::abs(ratio));
}

}  // namespace
}  // namespace howl::whittle_lanes_test
