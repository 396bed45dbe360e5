#include "app/family/family_questions.h"

#include <cmath>
#include <optional>

#include "model/loop/crossings.h"
#include "model/loop/poles.h"

namespace howl {
namespace {

constexpr double kMarginsUpTo = 10.0;           // of the cycle's frequency
constexpr double kGrowthRateStd = 1.0 / 220.0;  // a period: 1 1/s of the paper's 220 Hz
constexpr std::size_t kAdvisedMembers = 200;

MemberPredictor GrowthRate(std::size_t i, double slope) {
  return [i, slope](std::span<const LoopModel> models) -> std::optional<double> {
    const std::optional<Pole> pole = RightmostPole(models[i].Loop(), slope);
    return pole ? std::optional(pole->growth_rate) : std::nullopt;
  };
}

std::optional<double> Finite(double value) {
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

}  // namespace

std::vector<Member> Thinned(std::span<const Member> members, std::size_t most) {
  if (members.size() <= most) return {members.begin(), members.end()};
  std::vector<Member> kept;
  kept.reserve(most);
  for (std::size_t k = 0; k < most; ++k) kept.push_back(members[k * members.size() / most]);
  return kept;
}

std::vector<ExperimentPrediction> PredictLoops(const FamilyProblem& problem,
                                               const SimulationSpec& simulation,
                                               std::span<const Member> members, int threads) {
  std::vector<ExperimentPrediction> predictions;
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    const Experiment& experiment = problem.experiments[i];
    const auto add = [&](const char* name, const MemberPredictor& predictor) {
      predictions.push_back({experiment.name, PredictSampled(name, members, predictor, threads)});
    };
    const bool two_modes = problem.model.modes == 2;
    const Range band_hz = LineBand(experiment.frequency_hz, problem.model.harmonic_ratio);
    if (two_modes) {
      add("line_hz",
          [i, band_hz](std::span<const LoopModel> m) { return CrossingNear(m[i], band_hz); });
    }
    if (!experiment.flame_slope) continue;
    const double slope = *experiment.flame_slope;
    add("growth_rate", GrowthRate(i, slope));
    const double up_to_hz = kMarginsUpTo * experiment.frequency_hz;
    add("gain_margin_db", [i, slope, up_to_hz](std::span<const LoopModel> m) {
      return Finite(Margins(m[i].Loop(), slope, up_to_hz).gain_margin_db);
    });
    if (simulation.flame_is_given) {
      const Flame<double> flame{simulation.flame_shape, slope, simulation.saturation, 0.0};
      add("p_amplitude", [i, flame, f = experiment.frequency_hz](std::span<const LoopModel> m) {
        return PressureAmplitude(m[i], flame, f);
      });
    }
    if (two_modes) {
      add("line_gain", [i, slope, band_hz](std::span<const LoopModel> m) {
        return LineGain(m[i], band_hz, slope);
      });
    }
  }
  return predictions;
}

std::vector<Advice> AdviseMeasurements(const FamilyProblem& problem,
                                       std::span<const Member> members) {
  std::vector<Measurement> measurements =
      DefaultMeasurements(problem.experiments, problem.model.harmonic_ratio);
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    const Experiment& experiment = problem.experiments[i];
    if (!experiment.flame_slope) continue;
    measurements.push_back({"growth rate of " + experiment.name, "1/s",
                            kGrowthRateStd * experiment.frequency_hz,
                            GrowthRate(i, *experiment.flame_slope)});
  }
  return Advise(Thinned(members, kAdvisedMembers), measurements);
}

}  // namespace howl
