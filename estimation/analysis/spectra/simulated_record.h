// What a rig's instruments record in a simulation, as a record that was measured.
#ifndef HOWL_ESTIMATION_ANALYSIS_SPECTRA_SIMULATED_RECORD_H_
#define HOWL_ESTIMATION_ANALYSIS_SPECTRA_SIMULATED_RECORD_H_

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "estimation/analysis/spectra/record.h"
#include "model/simulation/simulate.h"

namespace howl {

inline Record ToRecord(SimulatedRecord simulated) {
  return {simulated.sampling_hz, std::move(simulated.pressure), std::move(simulated.heat_release)};
}

// Point is a named record or an experiment of a diagnosis: its first members are name, phi and
// record. The points are called exp1, exp2, ...; phi_of(i) is the operating parameter of point i,
// from 0.
template <typename Point, typename Phi>
std::vector<Point> RecordedPoints(std::span<const SimulationCase> cases,
                                  const SimulationOptions& options, const Phi& phi_of) {
  std::vector<Point> points;
  for (SimulatedRecord& simulated : SimulateBatch(cases, options)) {
    const std::size_t i = points.size();
    points.push_back({"exp" + std::to_string(i + 1), phi_of(i), ToRecord(std::move(simulated))});
  }
  return points;
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_SPECTRA_SIMULATED_RECORD_H_
