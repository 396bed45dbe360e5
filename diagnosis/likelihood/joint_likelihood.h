// The joint likelihood of recorded p and q at one operating point, both cuts of the loop at once.
// With R what the acoustics and the instruments make of recorded q, and F what delay and flame make
// of recorded p about the cycle, at each bin f
//
//   E_A = P - R Q,    E_B = Q - leak P - H Phi(v)                    joint_residuals.h
//   Sigma = sum_j S_j u_j u_j^H                                      noise_sources.h
//   ln L = w sum_f [ 2 ln |1 - R (F + leak)| - ln det Sigma - E^H Sigma^-1 E ]
//
// The flame Phi is static and acts in time, so that the lines of the cycle count as much as the
// noise between them; F, its mean slope over the record, stands in Sigma and in the determinant
// alone. The determinant is the Jacobian of the change from (P, Q) to (E_A, E_B): without it a fit
// of both cuts of a closed loop is biased. w is the weight of a bin under the taper.
//
// The model has errors in proportion to what it predicts, eps_A |R Q| and eps_B |H Phi|, both of
// the base (joint_band.h). Sigma contains them as two further sources.
//
// The flame's coefficients take their most likely values.
#ifndef HOWL_DIAGNOSIS_LIKELIHOOD_JOINT_LIKELIHOOD_H_
#define HOWL_DIAGNOSIS_LIKELIHOOD_JOINT_LIKELIHOOD_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/likelihood/joint_band.h"
#include "diagnosis/likelihood/joint_residuals.h"
#include "estimation/record_fit/whittle/noise_sources.h"

namespace howl {

struct JointEvaluation {
  double log_likelihood = 0.0;
  Eigen::VectorXd flame;                  // coefficients
  Eigen::VectorXcd f;                     // F + leak on the band
  std::vector<Eigen::Matrix2cd> inverse;  // Sigma^-1 of each bin
  Eigen::MatrixXd flame_curvature;        // of -ln L / 2 in the coefficients
};

JointEvaluation Evaluate(const JointBand& band, const std::vector<NoiseTerm>& noise,
                         const SharedLoop& shared, const PointLoop& point,
                         const JointResiduals& residuals);

// The same once the point has the flame that an evaluation finds: the sources' directions follow
// from it.
JointEvaluation EvaluateWithItsFlame(const JointBand& band, const std::vector<NoiseTerm>& noise,
                                     const SharedLoop& shared, const JointResiduals& residuals,
                                     PointLoop* point);

// d ln L of a bin is the real part of: r * dR + f * dF + acoustic * dE_A + flame * dE_B.
struct JointAdjoint {
  Eigen::VectorXcd r;
  Eigen::VectorXcd f;
  Eigen::VectorXcd acoustic;
  Eigen::VectorXcd flame;
};
JointAdjoint AdjointOf(const JointBand& band, const std::vector<NoiseTerm>& noise,
                       const PointLoop& point, const JointResiduals& residuals,
                       const JointEvaluation& at);

// The score and the Fisher information of the noise's coefficients, source after source, then of
// ln eps_A and ln eps_B.
struct NoiseScore {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;
};
NoiseScore ScoreNoise(const JointBand& band, const std::vector<NoiseTerm>& noise,
                      const SharedLoop& shared, const PointLoop& point,
                      const JointResiduals& residuals, const JointEvaluation& at);

// The Fisher information of parameters that move the residuals by these columns (acoustic bins,
// then flame bins), with the flame's coefficients free: 2 Re J^H (W - ...) J.
Eigen::MatrixXd MeanInformation(const JointBand& band, const JointResiduals& residuals,
                                const JointEvaluation& at, const Eigen::MatrixXcd& columns);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LIKELIHOOD_JOINT_LIKELIHOOD_H_
