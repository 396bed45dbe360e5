#include "diagnosis/gap/gap_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "diagnosis/cuts/make_cut_records.h"
#include "model/noise/random_stream.h"
#include "tests/diagnosis/simulated_rig.h"

namespace howl::gap_map_test {
namespace {

constexpr double kWindowSquare = 70.0 / 256.0;

// As a record's noise is: white, under the window, of mean square one.
Eigen::VectorXcd Noise(Eigen::Index count, RandomStream* random) {
  Eigen::VectorXcd white(count + 2 * kTapReach);
  for (std::complex<double>& x : white) {
    const double real = random->Normal();
    x = std::sqrt(0.5 / kWindowSquare) * std::complex<double>(real, random->Normal());
  }
  return ApplyWindow(white, count);
}

struct Residuals {
  std::vector<CutRecord> records;
  std::vector<ExperimentFit> fits;
  std::vector<Eigen::VectorXd> flame_noise;
};

Residuals NoiseAlone(std::uint64_t seed) {
  static const std::vector<CutRecord> records = MakeCutRecords(SimulatePoints(
      3, [](RigParameters*) {}, 8));
  Residuals out;
  out.records = records;
  RandomStream random(seed);
  for (CutRecord& record : out.records) {
    record.sensor_noise = Eigen::VectorXd::Ones(record.acoustic_count);
    ExperimentFit fit;
    fit.acoustics.setZero();
    fit.acoustic_residual = Noise(record.acoustic_count, &random);
    fit.flame_residual = Noise(record.flame_count, &random);
    out.fits.push_back(std::move(fit));
    out.flame_noise.emplace_back(Eigen::VectorXd::Ones(record.flame_count));
  }
  return out;
}

std::vector<GapCell> Map(const Residuals& at) {
  return GapMap(at.records, {&at.fits, false}, {}, at.flame_noise);
}

// With nothing to find, the rate is that of maps with any cell found.
TEST(GapMap, NoiseAloneIsFoundInOneMapOfTwentyAtMost) {
  int maps = 0;
  constexpr int kMaps = 200;
  for (int i = 0; i < kMaps; ++i) {
    const std::vector<GapCell> cells = Map(NoiseAlone(static_cast<std::uint64_t>(i) + 100));
    maps += std::ranges::any_of(cells, &GapCell::before_found) ? 1 : 0;
  }
  EXPECT_LE(maps, 20);  // ten are expected; 20 are three standard deviations more
}

TEST(GapMap, FindsTheBandAndTheExperimentThatAreWrong) {
  Residuals at = NoiseAlone(5);
  const CutRecord& record = at.records[1];
  for (Eigen::Index k = 0; k < record.flame_count; ++k) {
    if (record.frequency(k) > 400.0 && record.frequency(k) < 600.0) {
      at.fits[1].flame_residual[k] *= 2.0;
    }
  }
  int inside = 0;
  int outside = 0;
  for (const GapCell& cell : Map(at)) {
    const bool wrong = cell.signal == "q" && cell.experiment == record.name &&
                       cell.low_hz < 600.0 && cell.high_hz > 400.0;
    if (wrong && cell.low_hz > 400.0 && cell.high_hz < 600.0) {
      ++inside;
      EXPECT_TRUE(cell.before_found) << cell.low_hz;
      EXPECT_NEAR(cell.before, std::sqrt(3.0), 0.4);  // |2 E|^2 / V - 1
    }
    outside += !wrong && cell.before_found ? 1 : 0;
    EXPECT_TRUE(std::isnan(cell.after));
    EXPECT_FALSE(cell.after_found);
  }
  EXPECT_GE(inside, 1);
  EXPECT_LE(outside, 1);
}

}  // namespace
}  // namespace howl::gap_map_test
