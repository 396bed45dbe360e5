// The changes of all experiments together: gains in log-likelihood once the delay, which the
// experiments share or scatter about one (delay_scatter.h), has taken what it can.
//
//   gain(i)       = sum over experiments |d_i|^2 - what tau and own delays undo
//   product(i, j)   the same of pairs, from which follows what is left of effect i once effect j
//                   explains what it can of it
#ifndef HOWL_DIAGNOSIS_PLAN_PLAN_GAINS_H_
#define HOWL_DIAGNOSIS_PLAN_PLAN_GAINS_H_

#include <Eigen/Core>
#include <vector>

#include "diagnosis/fit/delay_scatter.h"
#include "diagnosis/plan/effect_line.h"
#include "diagnosis/plan/plan_point.h"

namespace howl {

// A line of `lines` at one size.
struct PlanEntry {
  std::size_t line = 0;
  double size = 0.0;
};

// One experiment's products between changes, and with the delay's.
struct PointProducts {
  Eigen::MatrixXd changes;  // entries x entries
  Eigen::VectorXd with_delay;
  double delay = 0.0;
};

PointProducts ProductsOf(const PlanPoint& point, const std::vector<EffectLine>& lines,
                         const std::vector<PlanEntry>& entries, double scale);
// The squares alone; products of two entries are left at zero.
PointProducts SquaresOf(const PlanPoint& point, const std::vector<EffectLine>& lines,
                        const std::vector<PlanEntry>& entries, double scale);

class PlanGains {
 public:
  // log_delays: the experiments' own delays over the shared one, where the model has own delays;
  // else empty.
  PlanGains(std::vector<PointProducts> points, std::vector<double> log_delays);

  // The gain of entry i; `parameters`: as many as the effect has.
  double Gain(std::size_t i, std::size_t parameters) const;
  // The product of entries i and j, once delays that scatter by so much have taken what they can.
  double Product(std::size_t i, std::size_t j, double scatter) const;
  // The scatter of the delays that the base would be fitted with, if entry i were in the rig.
  double ScatterOf(std::size_t i) const;

  std::size_t size() const { return static_cast<std::size_t>(points_[0].with_delay.size()); }

 private:
  // The delays that each experiment alone would have with entry i, times `factor`, in the rig.
  std::vector<OwnDelay> Delays(std::size_t i, double factor) const;

  std::vector<PointProducts> points_;
  std::vector<double> log_delays_;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_PLAN_PLAN_GAINS_H_
