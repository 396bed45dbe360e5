// What a free transfer error could still remove from a cut, band by band: E is projected on the
// predicted signal X with one complex coefficient a band, the same for all experiments,
//
//   gain = |sum conj(X) E / V|^2 / sum |X|^2 / V
//
// in units of a log-likelihood; 1 a band is expected of noise alone. In cut B the loop is closed by
// the acoustics: combustion noise reaches p, and a filter that may look ahead would find it there.
// So the slack of cut B is a filter on the past of p alone,
//
//   E_B ~ sum over j of c_j e^(-delta_j s) X,    tau + delta_j > 0
//
// Slack fits anything and explains nothing. It serves as a ceiling for effects, and tells the place
// of what no effect explains.
#ifndef HOWL_DIAGNOSIS_GAP_SLACK_H_
#define HOWL_DIAGNOSIS_GAP_SLACK_H_

#include <complex>
#include <vector>

#include "diagnosis/fit/effect_fit.h"

namespace howl {

struct SlackBand {
  double low_hz = 0.0;
  double high_hz = 0.0;
  double gain = 0.0;
  std::complex<double> error;         // relative transfer error
  std::vector<double> by_experiment;  // the gain with a coefficient for each experiment
};

struct Slack {
  std::vector<SlackBand> acoustic;
  std::vector<double> flame_by_experiment;  // cut B: the gain in each experiment
  // The gains less what noise alone gives, but not below zero.
  double acoustic_excess = 0.0;
  double flame_excess = 0.0;
};

Slack ComputeSlack(const std::vector<CutRecord>& records, const EffectFit& fit);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_GAP_SLACK_H_
