// One operating point of a joint fit: its likelihood and the priors of its own parameters, with
// gradient and Fisher information.
//
// The point's own parameters come first: ln omega, ln xi, N and M over the centre's N, ln of its
// delay over the shared one where delays are free, then the noise's coefficients. The shared ones
// follow: ln tau, the effects' parameters (in logarithms where these are searched), ln eps_A,
// ln eps_B.
#ifndef HOWL_DIAGNOSIS_STRUCTURE_POINT_SCORING_H_
#define HOWL_DIAGNOSIS_STRUCTURE_POINT_SCORING_H_

#include <Eigen/Core>

#include "diagnosis/likelihood/joint_likelihood.h"
#include "diagnosis/structure/structure.h"

namespace howl {

struct PointLayout {
  int modes = 2;
  bool own_delays = false;
  bool shared_fixed = false;
  Eigen::Index noise = 0;  // coefficients
  Eigen::Index effect_values = 0;

  Eigen::Index Acoustics() const { return modes > 1 ? 4 : 3; }
  Eigen::Index Loop() const { return Acoustics() + (own_delays ? 1 : 0); }
  Eigen::Index Own() const { return Loop() + noise; }
  Eigen::Index SharedLoopSize() const { return shared_fixed ? 0 : 1 + effect_values; }
  Eigen::Index Shared() const { return shared_fixed ? 0 : SharedLoopSize() + 2; }
};

struct PointScore {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;
};

// The logarithm of the priors' density.
double PointPrior(const PointLayout& layout, const PointLoop& point, const PointLoop& centre,
                  double delay_scatter);

PointScore ScorePoint(const PointLayout& layout, const JointBand& band, const Effect& effect,
                      const std::vector<NoiseTerm>& noise, const SharedLoop& shared,
                      const PointLoop& point, const PointLoop& centre);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_STRUCTURE_POINT_SCORING_H_
