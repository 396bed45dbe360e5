// Where fits of a flame's path begin.
#include "estimation/record_fit/starts/path_starts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/noise/random_stream.h"

namespace howl::path_starts_test {
namespace {

// q is what a linear flame makes of broad p by the path, and a twentieth of noise.
RecordSpectra Answered(const FlamePath& path, std::uint64_t seed) {
  constexpr double kCycle_hz = 200.0;
  RandomStream random(seed);
  Record record;
  record.sampling_hz = 5000.0;
  double p = 0.0;
  for (int i = 0; i < 5000; ++i) {
    p += 0.5 * (random.Normal() - p);
    record.pressure.push_back(p);
    record.heat_release.push_back(random.Normal());
  }
  RecordSpectra out = MakeRecordSpectra(record, kCycle_hz, FlameInput::kPressure);
  // The functions' sum that is nearest to p itself.
  const Eigen::VectorXd line =
      (out.flame.adjoint() * out.pressure)
          .real()
          .cwiseQuotient(out.flame.cwiseAbs2().colwise().sum().transpose());
  const Eigen::VectorXcd answer = path.At(out.edge_s).cwiseProduct(out.flame * line);
  const double size = std::sqrt(answer.squaredNorm() / static_cast<double>(answer.size()));
  for (Eigen::Index i = 0; i < answer.size(); ++i) {
    out.heat_release[i] =
        answer[i] + 0.05 * size * std::complex<double>(random.Normal(), random.Normal());
  }
  return out;
}

TEST(PathStarts, DelayIsAmongThem) {
  for (const double tau : {1.1, 3.3, 6.0, 22.0}) {
    const RecordSpectra record = Answered({DelaySpread::kNone, tau}, 3);
    const std::vector<double> found = PathStarts(record).Delays(3);
    ASSERT_FALSE(found.empty());
    EXPECT_NEAR(found[0], tau, 0.1);
  }
}

TEST(PathStarts, SecondPathIsAmongThem) {
  for (const double share : {0.3, -0.4}) {
    for (const double lambda : {1.5, 2.0, 4.0}) {
      FlamePath path{DelaySpread::kNone, 2.0};
      const FlamePath first = path;
      path.second = SecondPath{share, lambda};
      const RecordSpectra record = Answered(path, 5);
      const std::vector<SecondPath> found = PathStarts(record).SecondPaths(first, 3);
      ASSERT_FALSE(found.empty());
      EXPECT_NEAR(found[0].lambda, lambda, 0.15 * lambda) << share;
      // A start: of the right sign, and of the right size within a factor of two.
      EXPECT_GT(found[0].share / share, 0.5) << lambda;
      EXPECT_LT(found[0].share / share, 2.0) << lambda;
    }
  }
}

}  // namespace
}  // namespace howl::path_starts_test
