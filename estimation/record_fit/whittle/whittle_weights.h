// What each bin's R, F, residuals and ln S_j weigh in the slope of the likelihood (whittle.h):
//
//   d ln L = sum over bins of Re(r dR + f dF + acoustic dE_A + flame dE_B) + log_spectra d ln S_j
//            + ratio d beta
//
// With G = Sigma^-1 E E^H Sigma^-1 - Sigma^-1 the slope by Sigma is w tr(G dSigma): all sources'
// parts in dR and dF add to one vector before G meets it.
#ifndef HOWL_ESTIMATION_RECORD_FIT_WHITTLE_WHITTLE_WEIGHTS_H_
#define HOWL_ESTIMATION_RECORD_FIT_WHITTLE_WHITTLE_WEIGHTS_H_

#include <Eigen/Core>
#include <vector>

#include "estimation/record_fit/whittle/whittle.h"

namespace howl {

struct WhittleWeights {
  Eigen::VectorXcd r, f, acoustic, flame;
  Eigen::VectorXcd line_factors, slow;
  Eigen::MatrixXd log_spectra;
  double ratio = 0.0;
};

void WeighBins(const std::vector<NoiseTerm>& noise, const Eigen::VectorXd& share,
               const LoopResiduals& at, WhittleWeights* out);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_WHITTLE_WHITTLE_WEIGHTS_H_
