// Three operating points of a rig, simulated, with instruments on request.
#ifndef HOWL_TESTS_DIAGNOSIS_SIMULATED_RIG_H_
#define HOWL_TESTS_DIAGNOSIS_SIMULATED_RIG_H_

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "estimation/analysis/spectra/simulated_record.h"
#include "model/effects/catalogue.h"
#include "model/simulation/simulate.h"

namespace howl {

inline RigParameters TestRig(int point) {
  const double k = static_cast<double>(point);
  RigParameters rig;
  rig.model = {
      {{206.0 - 2.0 * k, 0.17 - 0.02 * k, 6400.0 - 300.0 * k, 1700.0 - 80.0 * k, 3.0}, 0.00352},
      {FlameShape::kTanh, -0.72e-4, 0.45, 0.0}};
  rig.noise.combustion_density = 4e-7;
  rig.noise.combustion_corner_hz = 1200.0;
  rig.noise.pressure_sensor_std = 0.02;
  rig.noise.heat_release_sensor_std = 0.002;
  return rig;
}

// ratio: to the first mode's frequency; share: of its coefficient.
inline void AddMode(double ratio, double xi, double share, RigParameters* rig) {
  const auto& acoustics = rig->model.loop.acoustics;
  rig->extra_modes = {{ratio * acoustics.omega_hz, xi, share * acoustics.N}};
}

// The catalogue's effects but these: to withhold.
inline std::vector<std::string> AllBut(const std::vector<std::string>& kept) {
  std::vector<std::string> withheld;
  for (const EffectPointer& effect : Catalogue()) {
    const std::string id(effect->id());
    if (std::find(kept.begin(), kept.end(), id) == kept.end()) withheld.push_back(id);
  }
  return withheld;
}

// With these of the catalogue alone, to be quick.
inline Diagnosis DiagnoseAmong(const std::vector<std::string>& kept,
                               const std::vector<DiagnosisExperiment>& rig) {
  DiagnosisOptions options;
  options.withheld = AllBut(kept);
  return Diagnose(rig, options);
}

// change: of each point's rig, before it is simulated.
inline std::vector<DiagnosisExperiment> SimulatePoints(
    int points, const std::function<void(RigParameters*)>& change, std::uint64_t seed) {
  std::vector<SimulationCase> cases;
  for (int point = 0; point < points; ++point) {
    SimulationCase one;
    one.rig = TestRig(point);
    change(&one.rig);
    one.rig.past = {{0.1, 205.0, 0.0, 0.0}};
    one.seed = seed + static_cast<std::uint64_t>(point);
    cases.push_back(std::move(one));
  }
  SimulationOptions options;
  options.duration_s = 3.2;
  options.settle_s = 0.5;
  return RecordedPoints<DiagnosisExperiment>(
      cases, options, [](std::size_t i) { return 0.55 - 0.03 * static_cast<double>(i); });
}

// At the quantile and the one as far from the other end.
inline void CutOff(double quantile, std::vector<double> Record::*channel,
                   std::vector<DiagnosisExperiment>* rig) {
  for (DiagnosisExperiment& experiment : *rig) {
    std::vector<double>& signal = experiment.record.*channel;
    std::vector<double> sorted = signal;
    std::sort(sorted.begin(), sorted.end());
    const auto last = static_cast<double>(sorted.size() - 1);
    const double high = sorted[static_cast<std::size_t>(quantile * last)];
    const double low = sorted[static_cast<std::size_t>((1.0 - quantile) * last)];
    for (double& x : signal) x = std::clamp(x, low, high);
  }
}

inline std::vector<DiagnosisExperiment> SimulateRig(
    std::vector<std::shared_ptr<const Instrument>> instruments = {}, std::uint64_t seed = 7) {
  return SimulatePoints(
      3, [&](RigParameters* rig) { rig->instruments = instruments; }, seed);
}

}  // namespace howl

#endif  // HOWL_TESTS_DIAGNOSIS_SIMULATED_RIG_H_
