// How much of p's errors a free transfer from q foretells: all of what a transfer made of q,
// nothing of noise.
#include <gtest/gtest.h>

#include <complex>

#include "diagnosis/held_out/band_errors.h"
#include "model/noise/random_stream.h"

namespace howl::foretold_power_test {
namespace {

using C = std::complex<double>;

constexpr Eigen::Index kBins = 4000;
constexpr Eigen::Index kDraws = 16;

Eigen::VectorXcd Noise(RandomStream* random) {
  Eigen::VectorXcd out(kBins);
  for (C& value : out) {
    const double real = random->Normal();
    value = C(real, random->Normal());
  }
  return out;
}

PredictedSignals SignalsWith(const Eigen::VectorXcd& heat_release) {
  PredictedSignals out;
  out.cycle_hz = 200.0;
  out.bin_hz = 0.5;
  out.share = Eigen::VectorXd::Ones(kBins);
  out.heat_release = heat_release;
  out.heat_release_power = Eigen::VectorXd::Constant(kBins, 2.0);
  return out;
}

TEST(ForetoldPower, IsAllOfWhatATransferMade) {
  RandomStream random(1);
  const PredictedSignals signals = SignalsWith(Noise(&random));
  Eigen::MatrixXcd errors(kBins, kDraws);
  double power = 0.0;
  for (Eigen::Index draw = 0; draw < kDraws; ++draw) {
    errors.col(draw) = C(0.1, 0.02 * static_cast<double>(draw)) * signals.heat_release;
    power += errors.col(draw).squaredNorm() / kDraws;
  }
  EXPECT_NEAR(ForetoldPower(errors, signals).sum(), power, 1e-9 * power);
}

// Each bin's is zero but for chance: of 40 neighbours and 16 draws, a few hundredths of the power.
TEST(ForetoldPower, IsLittleOfNoise) {
  RandomStream random(2);
  const PredictedSignals signals = SignalsWith(Noise(&random));
  Eigen::MatrixXcd errors(kBins, kDraws);
  for (Eigen::Index draw = 0; draw < kDraws; ++draw) errors.col(draw) = Noise(&random);
  const double power = errors.squaredNorm() / kDraws;
  EXPECT_LT(ForetoldPower(errors, signals).sum(), 0.05 * power);
}

}  // namespace
}  // namespace howl::foretold_power_test
