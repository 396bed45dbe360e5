// One operating point of a joint fit: its likelihood and the priors of its own parameters, with
// gradient and Fisher information.
//
// The point's own parameters come first: ln omega, ln xi, N and M over the start's N; b of the
// base's modes where residues are complex; ln omega, ln xi, a and b of each further mode; ln of its
// delay over the shared one where delays are free; then the noise's coefficients. The shared ones
// follow: ln tau, the effects' parameters (in logarithms where these are searched), ln eps_A,
// ln eps_B.
#ifndef HOWL_DIAGNOSIS_STRUCTURE_POINT_SCORING_H_
#define HOWL_DIAGNOSIS_STRUCTURE_POINT_SCORING_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/likelihood/joint_likelihood.h"
#include "diagnosis/structure/structure.h"

namespace howl {

struct PointLayout {
  int modes = 2;  // of the base
  bool complex_residues = false;
  int further_modes = 0;
  bool own_delays = false;
  bool shared_fixed = false;
  Eigen::Index noise = 0;  // coefficients
  Eigen::Index effect_values = 0;
  std::vector<Moves> effect_moves;  // of each of them

  Eigen::Index Base() const { return modes > 1 ? 4 : 3; }
  Eigen::Index BaseB() const { return complex_residues ? modes : 0; }
  Eigen::Index FurtherModes() const { return 4 * Eigen::Index{further_modes}; }
  Eigen::Index Acoustics() const { return Base() + BaseB() + FurtherModes(); }
  Eigen::Index Loop() const { return Acoustics() + (own_delays ? 1 : 0); }
  Eigen::Index Own() const { return Loop() + noise; }
  Eigen::Index SharedLoopSize() const { return shared_fixed ? 0 : 1 + effect_values; }
  Eigen::Index Shared() const { return shared_fixed ? 0 : SharedLoopSize() + 2; }
};

PointLayout LayoutOf(const LoopStructure& structure, const BaseModel& model);

// Moves the point's own parameter of this number.
void MoveOwn(const PointLayout& layout, Eigen::Index parameter, double step, PointLoop* point);

struct PointScore {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;
};

// The logarithm of the priors' density. `centre` is where the priors of the base's parameters and
// of the noise's levels have their mean.
double PointPrior(const PointLayout& layout, const JointBand& band, const PointLoop& point,
                  const PointLoop& centre, double delay_scatter);

// `now`: the residuals at these parameters.
PointScore ScorePoint(const PointLayout& layout, const JointBand& band, const Effect& effect,
                      const std::vector<NoiseTerm>& noise, const SharedLoop& shared,
                      const PointLoop& point, const PointLoop& centre, const JointResiduals& now);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_STRUCTURE_POINT_SCORING_H_
