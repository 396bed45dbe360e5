// How far a structure's predictions of p from q and of q from p fall short of what is possible.
//
//   e_p = P - E[P | Q] = u^H W E / (u^H W u),   u = (1, -F);    e_q = Q - E[Q | P], u = (-R, 1)
//   W = Sigma^-1, E = (E_A, E_B)                                        (joint_likelihood.h)
//
// The error that a free smooth transfer from the other signal would leave is the ceiling
// (band_errors.h):
//
//   gap^2 = mean over signals and bands of  sum |e|^2 / S  /  sum |e_ceiling|^2 / S  - 1
//
// S being the signal's own smoothed power. 0: indistinguishable.
#ifndef HOWL_DIAGNOSIS_BUDGET_PREDICTION_GAP_H_
#define HOWL_DIAGNOSIS_BUDGET_PREDICTION_GAP_H_

#include <vector>

#include "diagnosis/held_out/band_errors.h"
#include "diagnosis/likelihood/joint_likelihood.h"

namespace howl {

// The bands of p, then those of q.
std::vector<BandErrors> PredictionErrors(const JointBand& band, const JointResiduals& residuals,
                                         const JointEvaluation& at);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_BUDGET_PREDICTION_GAP_H_
