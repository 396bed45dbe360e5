// The joint likelihood of recorded p and q at one operating point, both cuts of the loop at once.
// With R what the acoustics and the instruments make of recorded q, and F what delay and flame make
// of recorded p about the cycle, at each bin f
//
//   E_A = P - R Q,    E_B = Q - leak P - H Phi(v)
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
#include <memory>
#include <vector>

#include "diagnosis/cuts/acoustic_cut.h"
#include "diagnosis/cuts/flame_cut.h"
#include "diagnosis/likelihood/joint_band.h"
#include "estimation/record_fit/noise_sources.h"

namespace howl {

// The parameters that all operating points share.
struct SharedLoop {
  double tau_s = 0.0;
  std::vector<double> values;  // of the effect
  double eps_a = 0.1;          // relative error of the model, standard deviation
  double eps_b = 0.1;
  double delay_scatter = 0.0;  // of log_delay; 0: one delay for all
};

struct PointLoop {
  AcousticLocals acoustics = AcousticLocals::Zero();
  // Where residues are complex: b of the base's modes (acoustic_cut.h) over residue_scale.
  Eigen::VectorXd base_b;
  // ln omega (Hz), ln xi, and a and b over residue_scale, of each further mode.
  std::vector<Eigen::Vector4d> modes;
  double residue_scale = 1.0;          // N of the start
  double log_delay = 0.0;              // of its delay over the shared one
  std::vector<Eigen::VectorXd> noise;  // coefficients of ln S_j, one vector a source
  Eigen::VectorXd flame;               // coefficients, of the last evaluation
};

std::vector<FurtherMode> FurtherModesOf(const BaseModel& model, const PointLoop& point);

// The model's residuals and responses for a record, which do not depend on the noise. Each of the
// two parts is kept where no moved parameter changes it.
struct AcousticPart {
  Eigen::VectorXcd r;         // on the band
  Eigen::VectorXcd residual;  // E_A
};
struct FlamePart {
  Eigen::VectorXcd target;   // Q - leak P
  Eigen::MatrixXcd columns;  // E_B = target - columns * coefficients
  Eigen::VectorXd slopes;    // of the columns in time, mean over the record
  Eigen::VectorXcd path;     // F = path * (slopes' sum over coefficients)
  double leak = 0.0;
};
struct JointResiduals {
  std::shared_ptr<const AcousticPart> acoustic;
  std::shared_ptr<const FlameColumns> input;  // of the flame, in time and spectrum
  std::shared_ptr<const FlamePart> flame;
};

// Which of the two parts a parameter moves.
struct Moves {
  bool acoustic = true;
  bool flame = true;
  bool flame_input = true;
};

JointResiduals MakeJointResiduals(const JointBand& band, const Effect& effect,
                                  const SharedLoop& shared, const PointLoop& point);
// The same, with the parts that do not move taken from `before`.
JointResiduals MoveJointResiduals(const JointBand& band, const Effect& effect,
                                  const SharedLoop& shared, const PointLoop& point,
                                  const Moves& moves, const JointResiduals& before);

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
