// The likelihood of recorded p and q of a closed loop, bin by bin (Whittle), its gradient and its
// information.
//
// R is the transfer from recorded q to recorded p, F the one from small p to q about the cycle:
//
//   E_A = P - R Q,   E_B = Q - what the flame makes of recorded p
//   A = [1, -R; -F, 1],   Sigma = sum_j S_j u_j u_j^H                      noise_sources.h
//   ln L = ln |det| + w sum_f [ - ln det Sigma - E^H Sigma^-1 E ]
//
// det is the Jacobian from (P, Q) to (E_A, E_B), which return_difference.h has: value and gradient
// are here without it. w is what a bin counts for under the taper.
//
// Were the flame linear, (P, Q) would be Gaussian with covariance C = A^-1 Sigma A^-H, and two
// parameters would have the information
//
//   I_ab = w sum_f tr(C^-1 dC_a C^-1 dC_b) = w sum_f tr(Sigma^-1 M_a Sigma^-1 M_b),
//   M = dSigma - B Sigma - Sigma B^H,   B = dA A^-1
//
// What the residuals' means tell is the share 2 Re tr(Sigma^-1 B_a Sigma B_b^H) of it. A record of
// a cycle tells more by its lines than noise of that covariance would: the share is replaced by the
// record's own, 2 Re dE_a^H Sigma^-1 dE_b.
#ifndef HOWL_ESTIMATION_RECORD_FIT_WHITTLE_WHITTLE_H_
#define HOWL_ESTIMATION_RECORD_FIT_WHITTLE_WHITTLE_H_

#include <Eigen/Core>
#include <vector>

#include "estimation/record_fit/whittle/noise_sources.h"

namespace howl {

// What a model says of one record: one row a bin.
struct LoopResiduals {
  Eigen::VectorXcd r;         // R
  Eigen::VectorXcd f;         // F
  Eigen::VectorXcd acoustic;  // E_A
  Eigen::VectorXcd flame;     // E_B
  Eigen::MatrixXd spectra;    // S_j, one column a source
  double background_ratio = 0.0;
  // By how much R F is larger where the cuts err at the cycle's lines; empty: by nothing. The
  // Jacobian's alone (return_difference.h).
  Eigen::VectorXcd line_factors;
  // How much slow changes take off F there (slow_changes.h); empty: nothing. The same one's alone.
  Eigen::VectorXcd slow;
};

// Derivatives by the parameters, one column each. The acoustics' parameters move R and E_A; those
// of delay and flame move F and E_B; a source's coefficients move ln S_j by its basis.
struct LoopDerivatives {
  Eigen::MatrixXcd r;
  Eigen::MatrixXcd acoustic;  // of E_A, as many columns as r
  Eigen::MatrixXcd f;
  Eigen::MatrixXcd flame;  // of E_B, as many columns as f
  std::vector<Eigen::MatrixXd> log_spectra;
};

Eigen::Index WhittleParameters(const std::vector<NoiseTerm>& noise,
                               const LoopDerivatives& derivatives);

// Sigma at one bin.
Eigen::Matrix2cd NoiseCovariance(const std::vector<NoiseTerm>& noise, const LoopResiduals& at,
                                 Eigen::Index bin);

// Without the determinant. share: what each bin counts for. -infinity where Sigma is singular.
double WhittleLogLikelihood(const std::vector<NoiseTerm>& noise, const Eigen::VectorXd& share,
                            const LoopResiduals& at);

// By the parameters in the order acoustics, delay and flame, source after source, and where there
// is a background the ratio at which p and q show it.
Eigen::VectorXd WhittleGradient(const std::vector<NoiseTerm>& noise, const Eigen::VectorXd& share,
                                const LoopResiduals& at, const LoopDerivatives& derivatives);
Eigen::MatrixXd WhittleInformation(const std::vector<NoiseTerm>& noise,
                                   const Eigen::VectorXd& share, const LoopResiduals& at,
                                   const LoopDerivatives& derivatives);

}  // namespace howl

#endif  // HOWL_ESTIMATION_RECORD_FIT_WHITTLE_WHITTLE_H_
