// What `fit` says of records of rigs that are known exactly, over many draws of the noise: the
// errors (ln fitted - ln true) in standard deviations for every parameter of every experiment. The
// rigs are the paper's kind of loop (one mode and two, with a shared delay and with one of each
// experiment). bench/fit_study.cc prints it; a test asks for a part.
#ifndef HOWL_TESTS_ESTIMATION_FIT_ROWS_H_
#define HOWL_TESTS_ESTIMATION_FIT_ROWS_H_

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "estimation/analysis/analyse.h"
#include "estimation/analysis/spectra/simulated_record.h"
#include "estimation/family/problem/membership.h"
#include "estimation/fit/joint_fit.h"
#include "model/cycles/harmonic_balance.h"
#include "model/noise/random_stream.h"
#include "model/simulation/cycle_scale.h"
#include "model/simulation/simulate.h"

namespace howl::fixtures {

struct StudiedRig {
  const char* name;
  int modes;
  ParameterScope delay;
  std::vector<LoopModel> loops;
  std::vector<double> loop_gains;
};

inline std::vector<StudiedRig> StudiedRigs() {
  return {
      {"one mode, shared tau",
       1,
       ParameterScope::kShared,
       {{254.97, 0.0594, 525.2, 0.0, 2.8195e-3},
        {257.71, 0.0679, 550.7, 0.0, 2.8195e-3},
        {260.37, 0.0737, 491.3, 0.0, 2.8195e-3}},
       {1.286, 1.377, 1.263}},
      {"two modes, shared tau",
       2,
       ParameterScope::kShared,
       {{222.09, 0.0862, 256.9, 9.1, 3.3006e-3}, {227.71, 0.0988, 258.1, 9.1, 3.3006e-3}},
       {1.244, 1.423}},
      {"one mode, own tau",
       1,
       ParameterScope::kExperiment,
       {{139.38, 0.0553, 187.9, 0.0, 5.3989e-3}, {137.62, 0.0719, 239.0, 0.0, 5.4096e-3}},
       {1.457, 1.537}},
      {"two modes, own tau",
       2,
       ParameterScope::kExperiment,
       {{228.11, 0.0391, 1027.1, 78.0, 3.1639e-3}, {227.23, 0.0475, 889.8, 78.0, 3.2112e-3}},
       {1.236, 1.329}},
  };
}

struct FitScore {
  int count = 0;
  int covered = 0;
  double sum = 0.0, squares = 0.0, std = 0.0;

  void Add(double error, double error_std) {
    const double z = error / error_std;
    ++count;
    covered += std::abs(z) <= kNormal95 ? 1 : 0;
    sum += z;
    squares += z * z;
    std += error_std;
  }
};

inline double FittedValueOf(const LoopModel& loop, ParameterKind kind) {
  switch (kind) {
    case ParameterKind::kOmega:
      return loop.omega_hz;
    case ParameterKind::kXi:
      return loop.xi;
    case ParameterKind::kN:
      return loop.N;
    case ParameterKind::kM:
      return loop.M;
    case ParameterKind::kMOverN:
      return loop.M / loop.N;
    case ParameterKind::kTau:
      return loop.tau_s;
  }
  return 0.0;
}

// As `simulate` takes them where a config says nothing (io/config/simulation_spec.h); times of a
// cycle near 220 Hz.
inline constexpr double kSaturation = 1.0;
inline constexpr double kCombustionNoise = 0.01;  // rms over saturation
inline constexpr double kCombustionCornerHz = 500.0;
inline constexpr double kDurationS = 3.2;
inline constexpr double kSamplingHz = 5000.0;
inline constexpr double kSettleS = 1.0;

struct SimulatedRig {
  std::vector<SimulationCase> cases;
  SimulationOptions how;
};

// Sensor noise relative to the amplitude of the cycle, rms.
inline SimulatedRig MakeCases(const StudiedRig& rig, double noise_p, double noise_q) {
  SimulatedRig out;
  for (std::size_t i = 0; i < rig.loops.size(); ++i) {
    SimulationCase one;
    one.rig.model.loop = rig.loops[i].Loop();
    const double omega = rig.loops[i].omega_hz;
    // The loop's gain at rest is taken at the first mode: near enough to the cycle.
    const double response = Magnitude(LoopResponse(rig.loops[i].Loop(), omega));
    one.rig.model.flame = {FlameShape::kTanh, -rig.loop_gains[i] / response, kSaturation, 0.0};
    LimitCycle cycle;
    for (const LimitCycle& found : LimitCycles(one.rig.model, 2.0 * omega)) {
      if (cycle.rate.empty() ||
          std::abs(found.frequency_hz - omega) < std::abs(cycle.frequency_hz - omega)) {
        cycle = found;
      }
    }
    one.rig.past = PastOnCycle(cycle);
    one.rig.noise.pressure_sensor_std = noise_p * cycle.pressure_amplitude();
    one.rig.noise.heat_release_sensor_std = noise_q * cycle.heat_release_amplitude();
    out.cases.push_back(std::move(one));
  }
  const double scale = CycleScale(rig.loops.front().omega_hz);
  out.how = {.duration_s = kDurationS / scale,
             .sampling_hz = kSamplingHz * scale,
             .settle_s = kSettleS / scale,
             .threads = 1};
  const double combustion = kCombustionNoise * kSaturation;
  for (SimulationCase& one : out.cases) {
    one.rig.noise.combustion_corner_hz = kCombustionCornerHz * scale;
    one.rig.noise.combustion_density =
        2.0 * combustion * combustion / (std::numbers::pi * kCombustionCornerHz * scale);
  }
  return out;
}

struct FitStudy {
  std::map<std::string, FitScore> fit;       // by parameter
  std::map<std::string, FitScore> transfer;  // by experiment and parameter
  int not_converged = 0;
  // Of the truth in the transfers' ellipsoids: square over degrees of freedom, summed.
  double square_distance = 0.0;
  double chi_square_per_dof = 0.0;  // summed
  int ellipsoids = 0;
  int beyond_default = 0;  // of the family's test

  static FitScore All(const std::map<std::string, FitScore>& scores) {
    FitScore all;
    for (const auto& [name, score] : scores) {
      all.count += score.count;
      all.covered += score.covered;
      all.sum += score.sum;
      all.squares += score.squares;
    }
    return all;
  }
};

inline FitStudy StudyFits(const StudiedRig& rig, int draws, std::uint64_t seed, double noise_p,
                          double noise_q) {
  ModelSpec model = DefaultModelSpec();
  model.modes = rig.modes;
  model[ParameterKind::kTau].scope = rig.delay;
  AnalysisOptions options;
  options.model = model;
  options.threads = 1;
  SimulatedRig simulated = MakeCases(rig, noise_p, noise_q);
  FitStudy study;
  for (int draw = 0; draw < draws; ++draw) {
    for (std::size_t i = 0; i < simulated.cases.size(); ++i) {
      simulated.cases[i].seed = DeriveSeed(DeriveSeed(seed, static_cast<std::uint64_t>(draw)), i);
    }
    const std::vector<NamedRecord> records = RecordedPoints<NamedRecord>(
        simulated.cases, simulated.how,
        [](std::size_t i) { return 0.5 + 0.02 * static_cast<double>(i); });
    const AnalysisSet set = AnalyseRecords(records, options);
    std::vector<Experiment> experiments;
    for (std::size_t i = 0; i < records.size(); ++i) {
      std::optional<Experiment> experiment = ToExperiment(set.analyses[i]);
      if (!experiment) continue;
      experiment->delay_periods = set.delay.branch;
      experiments.push_back(*std::move(experiment));
      if (!set.analyses[i].transfer_fit) continue;
      const TransferFit& fit = *set.analyses[i].transfer_fit;
      const auto add = [&](const char* name, const Estimate& e, double truth) {
        study.transfer[records[i].name + "." + name].Add(std::log(e.value / truth),
                                                         e.std / e.value);
      };
      add("omega", fit.omega_hz, rig.loops[i].omega_hz);
      add("xi", fit.xi, rig.loops[i].xi);
      add("N", fit.N, rig.loops[i].N);
      if (rig.modes == 2) add("M", fit.M, rig.loops[i].M);
      study.chi_square_per_dof += fit.chi_square_per_dof;
      if (const auto& ellipsoid = experiments.back().transfer_ellipsoid) {
        const double d = MahalanobisDistance(*ellipsoid, rig.loops[i]);
        study.square_distance += d * d / ellipsoid->Count(rig.modes == 2);
        ++study.ellipsoids;
        study.beyond_default +=
            TransferDistance(*ellipsoid, rig.loops[i]) > MembershipTest{}.transfer_distance_max ? 1
                                                                                                : 0;
      }
    }
    if (experiments.size() < records.size()) continue;
    const JointProblem problem(std::move(experiments), model, DefaultResidualSet());
    const JointFit fit = SolveJoint(problem, {.starts = 2}, 0, 1);
    if (!fit.converged) ++study.not_converged;
    for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
      const ParameterBlock& block = problem.parameters()[k];
      if (block.is_mean || block.fixed || !fit.converged) continue;
      const auto owner = static_cast<std::size_t>(std::max(block.experiment, 0));
      study.fit[fit.parameters[k].name].Add(
          std::log(fit.parameters[k].value / FittedValueOf(rig.loops[owner], block.kind)),
          fit.parameters[k].std_relative);
    }
  }
  return study;
}

}  // namespace howl::fixtures

#endif  // HOWL_TESTS_ESTIMATION_FIT_ROWS_H_
