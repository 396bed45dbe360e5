// solution.json, schema howl.solution/1, of a loop that was fitted to records: the modes, delay,
// small-signal loop and noise of each experiment, and the law by which they vary.
#ifndef HOWL_IO_RESULTS_RECORD_SOLUTION_JSON_H_
#define HOWL_IO_RESULTS_RECORD_SOLUTION_JSON_H_

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "estimation/joint_records/choose_loop.h"
#include "estimation/joint_records/fitted_loop.h"
#include "estimation/joint_records/half_fits.h"
#include "estimation/joint_records/interval_scale.h"
#include "estimation/joint_records/onset.h"

namespace howl {

struct RecordSolution {
  std::vector<std::string> names;  // of the experiments
  ChosenLoop loop;
  // Errors widened by `scales`, and so those of all that is taken from them.
  std::vector<FittedLoop> fitted;
  std::vector<HalfLoops> halves;  // as the likelihood has them
  std::vector<IntervalScale> scales;
  std::vector<std::vector<OtherDelay>> other_delays;  // of each experiment
  Onset onset;
  // Of the samples of p and of q, in which the signal stands still (stuck_samples.h).
  std::vector<std::array<double, 2>> stuck;
  // Of those of p, which are clipped (clipped_samples.h).
  std::vector<double> clipped;
  // Of the fundamental of p; zero where the record shows no cycle.
  std::vector<double> cycle_amplitude;

  bool Converged() const;
};

nlohmann::ordered_json RecordSolutionJson(const RecordSolution& solution);

}  // namespace howl

#endif  // HOWL_IO_RESULTS_RECORD_SOLUTION_JSON_H_
