// Cut A in the samples that saturation left: least squares over what stands beside p's plateaus,
//
//   minimise  sum over experiments of  n log sum over t of w(t) (p(t) - p_model(t))^2
//
// with P_model = R Q, in omega, xi, N and M of each experiment and the effect's parameters;
// Levenberg and Marquardt. w falls to zero at the record's ends, which do not know what came
// before, and is zero on the plateaus. Coherent lines, which q does not drive, are carried on as
// the filled signal has them.
#ifndef HOWL_DIAGNOSIS_DECLIP_BESIDE_PLATEAUS_H_
#define HOWL_DIAGNOSIS_DECLIP_BESIDE_PLATEAUS_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/effect_fit.h"
#include "diagnosis/sample_limits.h"

namespace howl {

// One experiment's p beside its plateaus.
class BesidePlateaus {
 public:
  // recorded: outlives this.
  explicit BesidePlateaus(const CutRecord& recorded);

  // Recorded less modelled p, without its mean beside the plateaus. filled: the same experiment
  // with its plateaus filled in before, or as recorded too.
  Eigen::ArrayXd Error(const CutRecord& filled, const Effect& effect, EffectValues x,
                       const AcousticLocals& locals) const;
  double WeightedSquares(const Eigen::ArrayXd& error) const {
    return (weight_ * error.square()).sum();
  }
  // The plateaus from the model, or as recorded where it does not reach them; without mean.
  Eigen::VectorXd Fill(const Eigen::ArrayXd& error) const;

  const Eigen::ArrayXd& weight() const { return weight_; }

 private:
  const CutRecord& recorded_;
  Plateaus plateaus_;
  Eigen::ArrayXd weight_;
};

struct PlateauFit {
  std::vector<double> values;
  std::vector<AcousticLocals> locals;  // one an experiment
  double cost = 0.0;                   // half the sum above, n in samples beside the plateaus
};

// filled: of each experiment. threads: 0 for as many as there are.
PlateauFit FitBesidePlateaus(const std::vector<BesidePlateaus>& experiments,
                             const std::vector<CutRecord>& filled, const Effect& effect,
                             PlateauFit start, int threads);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_DECLIP_BESIDE_PLATEAUS_H_
