// The diagnosis' joint likelihood of p and q at one operating point (joint_likelihood.h), with the
// residuals given; and the residuals of the acoustic and of the flame's part, moved by a parameter.
#include <memory>

#include "bench/limits/measured.h"
#include "diagnosis/effect_fit.h"
#include "diagnosis/structure/structure_fit.h"
#include "model/simulate.h"

namespace howl::limits {
namespace {

struct State {
  JointBand band;
  StructureFit fit;
  EffectPointer effect;
  JointResiduals residuals;
};

std::shared_ptr<const State> MakeState() {
  std::vector<SimulationCase> cases;
  for (int k = 0; k < 2; ++k) {
    SimulationCase one;
    one.rig.model = {{{206.0 - 2.0 * k, 0.17 - 0.01 * k, 6400.0 - 200.0 * k, 1700.0, 3.0}, 0.00352},
                     {FlameShape::kTanh, -0.72e-4, 0.45, 0.0}};
    one.rig.noise = {4e-7, 1200.0, 0.02, 0.002};
    one.rig.past = {{0.1, 205.0, 0.0, 0.0}};
    one.seed = static_cast<std::uint64_t>(k);
    cases.push_back(std::move(one));
  }
  SimulationOptions options;
  options.duration_s = 3.2;
  options.settle_s = 0.5;
  options.threads = 1;
  std::vector<DiagnosisExperiment> rig;
  for (const SimulatedRecord& record : SimulateBatch(cases, options)) {
    rig.push_back({"exp" + std::to_string(rig.size() + 1),
                   0.56 - 0.02 * static_cast<double>(rig.size()),
                   {record.sampling_hz, record.pressure, record.heat_release}});
  }
  const std::vector<CutRecord> records = MakeCutRecords(rig);
  std::vector<JointBand> bands;
  for (const CutRecord& record : records) bands.push_back(MakeJointBand(record));
  auto state = std::make_shared<State>();
  state->fit = StartOf(bands, FitBase(records), BaseNoise());
  state->band = std::move(bands[0]);
  state->effect = state->fit.structure.Joined();
  state->residuals =
      MakeJointResiduals(state->band, *state->effect, state->fit.shared, state->fit.points[0]);
  return state;
}

std::shared_ptr<const State> TheState() {
  static const std::shared_ptr<const State> state = MakeState();
  return state;
}

std::function<double()> Likelihood() {
  return [state = TheState()] {
    constexpr int kTimes = 20;
    double sum = 0.0;
    for (int n = 0; n < kTimes; ++n) {
      sum += Evaluate(state->band, state->fit.structure.noise, state->fit.shared,
                      state->fit.points[0], state->residuals)
                 .log_likelihood;
    }
    return sum == sum ? static_cast<double>(kTimes * state->band.count) : 0.0;
  };
}

std::function<double()> Residuals(const Moves& moves) {
  return [state = TheState(), moves] {
    constexpr int kTimes = 20;
    for (int n = 0; n < kTimes; ++n) {
      MoveJointResiduals(state->band, *state->effect, state->fit.shared, state->fit.points[0],
                         moves, state->residuals);
    }
    return static_cast<double>(kTimes * state->band.count);
  };
}

}  // namespace

std::vector<Measured> LikelihoodLoads() {
  return {{"likelihood", "bin", Likelihood},
          {"likelihood, acoustic residuals", "bin",
           [] { return Residuals({.acoustic = true, .flame = false, .flame_input = false}); }},
          {"likelihood, flame residuals", "bin",
           [] { return Residuals({.acoustic = false, .flame = true, .flame_input = false}); }}};
}

}  // namespace howl::limits
