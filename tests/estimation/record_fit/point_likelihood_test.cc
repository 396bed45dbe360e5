// What is kept from one evaluation to the next is what an evaluation by itself has, whichever
// parameters have moved between them.
#include "estimation/record_fit/loop/point_likelihood.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "estimation/record_fit/loop/loop_residuals.h"
#include "estimation/record_fit/loop/return_difference.h"
#include "estimation/record_fit/slow/slow_signals.h"
#include "model/noise/random_stream.h"
#include "tests/estimation/record_fit/identified.h"

namespace howl::point_likelihood_test {
namespace {

double ByItself(const RecordSpectra& record, const PointStructure& structure,
                const Eigen::VectorXd& parameters) {
  const LoopPoint point = ToPoint(structure, record.flame.cols(), parameters);
  return WhittleLogLikelihood(structure.noise, record.share,
                              ResidualsOf(record, structure, point)) +
         LogDeterminant(record, point);
}

class KeptParts : public testing::TestWithParam<std::tuple<DelaySpread, bool>> {};

TEST_P(KeptParts, AreThoseOfAnEvaluationByItself) {
  const ModalLoop loop = DuctOfModes(2);
  RecordSpectra record =
      MakeRecordSpectra(SimulateModalLoop(loop, 0.5, 1), 203.0, FlameInput::kPressureRate);
  for (const int further : {-1, 0, 1}) {
    const bool tied = further >= 0;
    PointStructure structure = FreeStructure(tied ? 2 + further : 2);
    structure.further_modes = std::max(further, 0);
    std::tie(structure.delay_spread, structure.second_path) = GetParam();
    structure.acoustic_lines = tied ? 0 : 3;
    structure.flame_lines = 4;
    if (tied) structure.ratio = 2.2;
    structure.own_damping = !tied;
    structure.complex_residues = !tied;
    structure.damping_follows_amplitude = further != 0;
    structure.frequency_drifts = structure.delay_follows_amplitude = further != 1;
    structure.gain_follows_amplitude = further != -1;
    structure.noise.push_back({LoopNoise::kDuct, 2});
    structure.noise.push_back({LoopNoise::kBackground, 2});
    SetSlowSignals(structure, nullptr, {}, &record);
    const PointPrior prior = PriorOf(structure, record);
    Eigen::VectorXd parameters = StartsOf(record, structure, prior, 4, 1).back();
    const Eigen::Index errors = structure.AcousticLines();
    parameters.segment(structure.AcousticLine(), errors).setConstant(0.2);
    parameters.segment(structure.FlameLine(record.flame.cols()), structure.FlameLines())
        .setConstant(-0.1);
    PointLikelihood kept(record, structure);
    RandomStream random(1);
    // Each parameter alone, and now and then one that has moved already.
    for (Eigen::Index i = 0; i < parameters.size(); ++i) {
      for (const Eigen::Index moved : {i, i / 2}) {
        parameters[moved] += 0.01 * random.Normal();
        const double by_itself = ByItself(record, structure, parameters);
        ASSERT_TRUE(std::isfinite(by_itself));
        const Eigen::VectorXd gradient = kept.Gradient(parameters);
        EXPECT_NEAR(kept.Value(parameters), by_itself, 1e-11 * std::abs(by_itself));
        const Eigen::VectorXd anew = PointLikelihood(record, structure).Gradient(parameters);
        EXPECT_LT((gradient - anew).norm(), 1e-11 * gradient.norm())
            << "parameter " << moved << " of " << parameters.size();
        const Eigen::Index left = parameters.size() - moved;
        EXPECT_EQ(kept.Gradient(parameters, moved).tail(left), gradient.tail(left))
            << "from parameter " << moved << " on, of " << parameters.size();
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllPaths, KeptParts,
                         testing::Combine(testing::Values(DelaySpread::kNone, DelaySpread::kNormal,
                                                          DelaySpread::kGamma),
                                          testing::Bool()));

}  // namespace
}  // namespace howl::point_likelihood_test
