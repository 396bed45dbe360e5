// How far a structure's predictions of p from q and of q from p fall short of what is possible.
//
//   e_p = P - E[P | Q] = u^H W E / (u^H W u),   u = (1, -F);    e_q = Q - E[Q | P], u = (-R, 1)
//   W = Sigma^-1, E = (E_A, E_B)                                        (joint_likelihood.h)
//
// What a free smooth transfer from the other signal takes off such an error could have been
// predicted. It is estimated in the neighbourhood of each bin, the bin itself left out, and what
// then remains is the ceiling: of several structures' the least counts for all.
//
//   gap^2 = mean over signals and bands of  sum |e|^2 / S  /  sum |e_ceiling|^2 / S  - 1
//
// S being the signal's own smoothed power. 0: indistinguishable.
#ifndef HOWL_DIAGNOSIS_BUDGET_PREDICTION_GAP_H_
#define HOWL_DIAGNOSIS_BUDGET_PREDICTION_GAP_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/likelihood/joint_likelihood.h"

namespace howl {

// In a band of a record and one signal: sums of |e|^2 / S.
struct BandErrors {
  double low_hz = 0.0;
  double high_hz = 0.0;
  double error = 0.0;
  double ceiling = 0.0;
};

// The bands of p, then those of q.
std::vector<BandErrors> PredictionErrors(const JointBand& band, const JointResiduals& residuals,
                                         const JointEvaluation& at);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_BUDGET_PREDICTION_GAP_H_
