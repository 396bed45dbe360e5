// G is the measured q-to-p transfer wherever p and q are coherent, (5a), within the band that the
// model claims to describe. The residual of each point is estimation/analysis/
// transfer_point_residual.h; std_relative is the standard deviation of the model itself, on top of
// each point's own variance.
//
// The level of q's noise is one unknown of a record. If each point had such an error of its own,
// fifty of them would leave a seventh of it, but it does not average out.
#include "estimation/analysis/transfer/transfer.h"

#include <utility>
#include <vector>

#include "estimation/analysis/transfer/transfer_point_residual.h"
#include "estimation/residuals/residual_adder.h"

namespace howl {
namespace {

constexpr double kMostQNoise = 100.0;  // standard deviations: a guard rail

int AddQNoise(ResidualAdder& problem, int i) {
  ParameterBlock block;
  block.name = problem.ExperimentAt(i).name + ".q_noise";
  block.experiment = i;
  block.is_q_noise = true;
  block.min_log = -kMostQNoise;
  block.max_log = kMostQNoise;
  return problem.AddParameter(block);
}

void AddPoint(ResidualAdder& problem, int i, int q_noise, TransferPoint point) {
  const bool full = problem.HasTwoModes();
  const double model_std = problem.Spec().std;
  const double model_variance = model_std * model_std * (point.re * point.re + point.im * point.im);
  point.variance_re += model_variance;
  point.variance_im += model_variance;
  std::vector<int> parameters = problem.AcousticBlocks(i, full);
  parameters.insert(parameters.begin(), q_noise);
  problem.Add(i,
              full ? TransferPointResidual::CreateFull(point, problem.SecondModeOfModel())
                   : TransferPointResidual::CreateReduced(point),
              std::move(parameters), FrequencySuffix(point.frequency_hz));
}

// Across the experiments, so that these parameters come after those of all models.
void AddTransfer(ResidualAdder& problem, const std::vector<int>& experiments) {
  for (const int i : experiments) {
    const Experiment& experiment = problem.ExperimentAt(i);
    if (experiment.transfer.empty()) continue;
    const int q_noise = AddQNoise(problem, i);
    const TransferBand band = TransferBandOf(problem.Model(), experiment.frequency_hz);
    for (const TransferPoint& point : experiment.transfer) {
      if (band.Contains(point.frequency_hz)) AddPoint(problem, i, q_noise, point);
    }
    problem.Add(i, QNoiseLevelPrior::Create(), {q_noise}, " q noise").loss = LossKind::kNone;
  }
}

}  // namespace

ResidualDefinition TransferDefinition() {
  return {.text = "G is the record's q-to-p transfer wherever p and q are coherent",
          .equation = "(5a)",
          .std = {"std_relative", 0.02,
                  "relative standard deviation of the model, on top of the data's"},
          .add_across = &AddTransfer};
}

}  // namespace howl
