// Delay from the q-to-p phase at the limit cycle (the paper, section 3.1). Condition (1a) reads
// Delta + 90 - 360 f tau = 180 - 360 (k + 1) degrees, hence
//
//   tau_k = (270 + Delta + 360 k) / (360 f)                                      (3), for k = 0
//
// in seconds; f in hertz, Delta in (-180, 180] degrees. One record cannot tell the branch k, the
// number of whole periods that the delay exceeds. Several can: the delay differs little between
// experiments, tau_e = tau (1 + d_e), while the frequency moves, and a wrong k adds (k' - k) / f_e
// to each. With d_e normal of unknown width sigma (prior 1 / sigma), and S_k the standard deviation
// of the n tau_k over their mean, the branches have probabilities
//
//   P(k) = S_k^-(n - 1) / sum over branches j of S_j^-(n - 1).
//
// A branch is taken for known where P is 0.95 or more. Below that the records cannot tell, and the
// paper's k = 0 stands. A config may also name the branch.
#ifndef HOWL_ESTIMATION_ANALYSIS_LOOP_DELAY_H_
#define HOWL_ESTIMATION_ANALYSIS_LOOP_DELAY_H_

#include <optional>
#include <span>
#include <vector>

#include "estimation/analysis/spectra/statistics.h"

namespace howl {

struct DelayInput {
  Estimate frequency_hz;
  Estimate phase_deg;
};

// phase_deg is taken as it is, not wrapped. The errors of phase and frequency count as independent
// (an unknown one, NaN, as zero). Were tau to stay while the frequency wanders, the phase would
// wander with it by 360 tau and the frequency's error would cancel; on measured records it does
// not: between halves of a record tau moves with the frequency.
Estimate DelayOnBranch(const DelayInput& input, int branch);

struct DelayBranch {
  int branch = 0;
  double mean_tau_s = 0.0;
  double spread = 0.0;  // standard deviation over mean, over the experiments
  double probability = 0.0;
};

struct DelayChoice {
  int branch = 0;
  bool given = false;                 // by the config
  bool by_consistency = false;        // else given, or k = 0
  std::vector<DelayBranch> branches;  // all that were compared, most probable first
  std::vector<Estimate> tau_s;        // one an experiment, on the chosen branch
};

// Branches 0 .. max_branch, and -1 where every tau stays positive, compete when there are three
// experiments or more.
DelayChoice EstimateDelays(std::span<const DelayInput> inputs, std::optional<int> branch = {},
                           int max_branch = 5);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_LOOP_DELAY_H_
