// Cut A fitted in time to the samples that saturation left, by least squares:
//
//   minimise  sum over experiments of  n log sum over t of w(t) (p(t) - p_model(t))^2
//
// with P_model = R Q, in omega, xi, N and M of each experiment and the effect's parameters, by the
// method of Levenberg and Marquardt. w falls to zero at the record's ends, where P_model lacks what
// came before, and is zero on the plateaus. Coherent lines, which q does not drive, are taken from
// the filled signal.
#ifndef HOWL_DIAGNOSIS_DECLIP_UNCLIPPED_SAMPLES_H_
#define HOWL_DIAGNOSIS_DECLIP_UNCLIPPED_SAMPLES_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/fit/effect_fit.h"
#include "diagnosis/samples/sample_limits.h"

namespace howl {

// The unclipped samples of one experiment's p.
class UnclippedSamples {
 public:
  // recorded must outlive this.
  explicit UnclippedSamples(const CutRecord& recorded);

  // Recorded less modelled p, less its mean over the unclipped samples. filled: the same experiment
  // with its plateaus filled in by an earlier fit, or as recorded.
  Eigen::ArrayXd Error(const CutRecord& filled, const Effect& effect, EffectValues x,
                       const AcousticLocals& locals) const;
  double WeightedSquares(const Eigen::ArrayXd& error) const {
    return (weight_ * error.square()).sum();
  }
  // p with its plateaus from the model, or as recorded where the model lies below their level; the
  // mean is removed.
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
  double cost = 0.0;                   // half the sum above; n is the number of unclipped samples
};

// filled: one record for each experiment. threads: 0 for as many as the machine has.
PlateauFit FitUnclippedSamples(const std::vector<UnclippedSamples>& experiments,
                               const std::vector<CutRecord>& filled, const Effect& effect,
                               PlateauFit start, int threads);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_DECLIP_UNCLIPPED_SAMPLES_H_
