// The diagnosis' joint likelihood of p and q at one operating point (joint_likelihood.h), with the
// residuals given; and the residuals of the acoustic and of the flame's part, moved by a parameter.
#include <memory>

#include "bench/limits/measured.h"
#include "bench/simulated_rig.h"
#include "diagnosis/cuts/make_cut_records.h"
#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/structure/structure_fit.h"

namespace howl::limits {
namespace {

struct State {
  JointBand band;
  StructureFit fit;
  EffectPointer effect;
  JointResiduals residuals;
};

std::shared_ptr<const State> MakeState() {
  const std::vector<CutRecord> records = MakeCutRecords(SimulatedPoints(2));
  std::vector<JointBand> bands;
  for (const CutRecord& record : records) bands.push_back(MakeJointBand(record));
  auto state = std::make_shared<State>();
  state->fit = StartOf(&bands, FitBase(records), BaseNoise());
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
