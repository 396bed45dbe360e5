// A simulated record's loop as a fit finds it, parameter by parameter beside the truth.
#ifndef HOWL_TESTS_ESTIMATION_RECORD_FIT_IDENTIFIED_H_
#define HOWL_TESTS_ESTIMATION_RECORD_FIT_IDENTIFIED_H_

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "estimation/record_fit/delay_maxima.h"
#include "estimation/record_fit/mode_maxima.h"
#include "estimation/record_fit/point_fit.h"
#include "estimation/record_fit/starts/point_starts.h"
#include "tests/estimation/record_fit/modal_loop.h"

namespace howl {

struct IdentifiedParameter {
  std::string name;
  double truth = 0.0;  // without unit, as in loop_point.h
  double value = 0.0;
  double std = 0.0;

  double Z() const { return (value - truth) / std; }
};

struct IdentifiedLoop {
  PointFit fit;
  PointFit from_truth;  // begun at the true loop
  std::vector<IdentifiedParameter> parameters;
};

inline PointStructure FreeStructure(int modes) {
  PointStructure out;
  out.modes = modes;
  out.noise = {{LoopNoise::kCombustion, 6},
               {LoopNoise::kPressureSensor, 1},
               {LoopNoise::kHeatReleaseSensor, 1}};
  return out;
}

// `point` with the modes and the delay of `loop`, in the units of its record.
inline LoopPoint WithTruthOf(const ModalLoop& loop, const RecordScale& scale, LoopPoint point) {
  const double turn = scale.AngularFrequency();
  const double residue = scale.pressure / scale.heat_release * turn;
  for (std::size_t k = 0; k < loop.modes.size(); ++k) {
    const ModalLoop::Mode& mode = loop.modes[k];
    point.modes[k] = {mode.omega_hz / scale.cycle_hz, mode.xi, mode.a / residue, mode.b / residue};
  }
  point.path.tau = loop.tau_s * turn;
  return point;
}

inline IdentifiedLoop Identify(const ModalLoop& loop, const Record& record, std::size_t starts) {
  const double cycle_hz = CycleFrequency(loop, 150.0, 300.0);
  const PointStructure structure = FreeStructure(static_cast<int>(loop.modes.size()));
  const RecordSpectra spectra = MakeRecordSpectra(record, cycle_hz, FlameInput::kPressureRate);
  const PointPrior prior = PriorOf(structure, spectra);
  IdentifiedLoop out;
  // As one point by itself is fitted (records_fit.h): from starts, then at its most likely delay
  // and places of modes.
  out.fit = FitPoint(spectra, structure, prior, StartsOf(spectra, structure, prior, starts, 1));
  out.fit = BestByDelay(spectra, structure, prior, std::move(out.fit));
  out.fit = BestByModes(spectra, structure, prior, std::move(out.fit));
  out.fit = FitPoint(spectra, structure, prior, out.fit.parameters);
  const LoopPoint found = ToPoint(structure, spectra.flame.cols(), out.fit.parameters);
  const Eigen::VectorXd true_parameters =
      ToParameters(structure, WithTruthOf(loop, spectra.scale, found));
  out.from_truth = FitPoint(spectra, structure, prior, true_parameters);
  // The modes of a fit stand in any order.
  std::vector<Eigen::Index> order(loop.modes.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {},
                    [&](Eigen::Index k) { return found.modes[static_cast<std::size_t>(k)].omega; });
  const Eigen::MatrixXd covariance = out.fit.Covariance();
  const auto add = [&](const std::string& name, Eigen::Index true_index, Eigen::Index index) {
    out.parameters.push_back({name, true_parameters[true_index], out.fit.parameters[index],
                              std::sqrt(covariance(index, index))});
  };
  const auto modes = static_cast<Eigen::Index>(order.size());
  const std::array<std::string, 4> kinds = {"ln omega", "ln xi", "a", "b"};
  for (Eigen::Index kind = 0; kind < 4; ++kind) {
    for (Eigen::Index k = 0; k < modes; ++k) {
      add(kinds[static_cast<std::size_t>(kind)] + " " + std::to_string(k + 1), kind * modes + k,
          kind * modes + order[static_cast<std::size_t>(k)]);
    }
  }
  add("ln tau", structure.Delay(), structure.Delay());
  return out;
}

}  // namespace howl

#endif  // HOWL_TESTS_ESTIMATION_RECORD_FIT_IDENTIFIED_H_
