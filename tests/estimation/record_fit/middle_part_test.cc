// The middle of a record's spectra is what a record of those samples alone shows.
#include "estimation/record_fit/spectra/middle_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "estimation/record_fit/starts/path_starts.h"
#include "tests/estimation/record_fit/drawn_record.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::middle_part_test {
namespace {

constexpr Eigen::Index kBesideEnds = 20;  // bins, where the band alone was cut

Record Cut(const Record& record, std::size_t first, std::size_t count) {
  const auto of = [&](const std::vector<double>& x) {
    const auto begin = x.begin() + static_cast<std::ptrdiff_t>(first);
    return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  Record out = record;
  out.pressure = of(record.pressure);
  out.heat_release = of(record.heat_release);
  return out;
}

class MiddlePartTest : public testing::Test {
 protected:
  const ModalLoop loop_ = BroadDuct();
  const double cycle_hz_ = CycleFrequency(loop_, 150.0, 300.0);
  const FlamePath path_{DelaySpread::kNone, loop_.tau_s, 0.0, {}};

  RecordSpectra WholeOf(const Record& record) const {
    return MakeRecordSpectra(record, cycle_hz_, FlameInput::kPressureRate);
  }
};

// Of what a spectrum has there, but beside the band's ends.
double RelativeError(const Eigen::VectorXcd& part, const Eigen::VectorXcd& cut) {
  const Eigen::Index inside = part.size() - 2 * kBesideEnds;
  const Eigen::VectorXcd right = cut.segment(kBesideEnds, inside);
  return (part.segment(kBesideEnds, inside) - right).norm() / right.norm();
}

TEST_F(MiddlePartTest, IsTheRecordOfThoseSamples) {
  const Record samples = DrawnRecord(loop_, path_, 5.0, 3);
  const RecordSpectra whole = WholeOf(samples);
  const RecordSpectra* const part = whole.middle.get();
  ASSERT_TRUE(part);
  const auto count = static_cast<std::size_t>(part->Samples());
  EXPECT_NEAR(static_cast<double>(count),
              std::max(0.2 * static_cast<double>(samples.pressure.size()),
                       100.0 * samples.sampling_hz / cycle_hz_),
              1.0);
  const RecordSpectra cut =
      MakeRecordSpectra(Cut(samples, (samples.pressure.size() - count) / 2, count), whole);
  const double bin = part->s[1].imag() - part->s[0].imag();
  const auto first =
      static_cast<Eigen::Index>(std::lround((part->edge_s[0].imag() - cut.edge_s[0].imag()) / bin));
  ASSERT_GE(first, 0);
  ASSERT_GE(cut.bins(), first + part->bins());
  const Eigen::Index bins = part->bins();
  EXPECT_LT((part->s - cut.s.segment(first, bins)).cwiseAbs().maxCoeff(), 1e-9);
  const auto error = [&](const Eigen::VectorXcd& of_part, const Eigen::VectorXcd& of_cut) {
    return RelativeError(Tapered(of_part), Tapered(of_cut.segment(first, bins + 1)));
  };
  EXPECT_LT(error(part->pressure, cut.pressure), 0.01);
  EXPECT_LT(error(part->heat_release, cut.heat_release), 0.01);
  // What the flame makes of p, but for what the cut record's own filter leaves at its ends.
  const Eigen::VectorXd flame = PathStarts(whole).Flame(
      {DelaySpread::kNone, loop_.tau_s * whole.scale.AngularFrequency(), 0.0, {}});
  EXPECT_LT(error(part->flame * flame, cut.flame * flame), 0.02);
  // Spectra's shapes are over the whole band.
  EXPECT_GT(part->position[0], -1.0);
  EXPECT_LT(part->position[bins - 1], 1.0);
}

TEST_F(MiddlePartTest, OfAShortRecordIsNone) {
  const double seconds = 190.0 / cycle_hz_;
  EXPECT_EQ(WholeOf(DrawnRecord(loop_, path_, seconds, 3)).middle, nullptr);
}

// A fit of the middle comes to the loop, and the whole's begins near its own maximum there.
TEST_F(MiddlePartTest, LeadsToTheLoop) {
  const RecordSpectra whole = WholeOf(DrawnRecord(loop_, path_, 5.0, 5));
  PointStructure structure = FreeStructure(2);
  structure.noise = {{LoopNoise::kCombustion, 2}, {LoopNoise::kDuct, 2}};
  const PointPrior prior = PriorOf(structure, whole);
  const PointFit right = FitPoint(whole, structure, prior, StartsOf(whole, structure, prior, 6, 1));
  const RecordSpectra* const part = whole.middle.get();
  ASSERT_TRUE(part);
  const PointFit of_part =
      FitPoint(*part, structure, prior, BesideMiddle(whole, structure, right.parameters));
  // All but what modes held at the ends, in deviations of the part's own errors.
  const Eigen::VectorXd deviation = of_part.Covariance().diagonal().cwiseSqrt();
  for (Eigen::Index i = 0; i < right.parameters.size(); ++i) {
    if (i >= structure.Transfer() && i < structure.AcousticLine()) continue;
    EXPECT_NEAR(of_part.parameters[i], right.parameters[i], 4.0 * deviation[i]) << i;
  }
  const PointFit again =
      FitPoint(whole, structure, prior, BesideMiddle(whole, structure, of_part.parameters));
  EXPECT_NEAR(again.log_posterior, right.log_posterior, 0.1);
  EXPECT_LT(again.iterations, 15);
}

}  // namespace
}  // namespace howl::middle_part_test
