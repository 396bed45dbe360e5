// What a loop at one operating point leaves of recorded p and q, in the two cuts of
// joint_likelihood.h:
//
//   E_A = P - R Q,    E_B = Q - leak P - H Phi(v)
//
// and the responses R of acoustics and instruments and F of delay and flame, on the band's bins.
#ifndef HOWL_DIAGNOSIS_LIKELIHOOD_JOINT_RESIDUALS_H_
#define HOWL_DIAGNOSIS_LIKELIHOOD_JOINT_RESIDUALS_H_

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "diagnosis/cuts/acoustic_cut.h"
#include "diagnosis/cuts/flame_cut.h"
#include "diagnosis/likelihood/joint_band.h"

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

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LIKELIHOOD_JOINT_RESIDUALS_H_
