// The profile of the evidence over the value of an instrument's parameter, which all operating
// points share, all else of each point fitted anew at each value.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_INSTRUMENT_PROFILE_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_INSTRUMENT_PROFILE_H_

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/loop_trial.h"

namespace howl {

// The search's coordinate u is the parameter's logarithm where its scale is logarithmic, else the
// parameter itself.
double ToSearch(const EffectParameter& parameter, double value);
double FromSearch(const EffectParameter& parameter, double u);
double SearchSpan(const EffectParameter& parameter);

// What a value is worth, and each point's parameters there.
struct InstrumentPoint {
  double u = 0.0;
  double nats = -std::numeric_limits<double>::infinity();
  std::vector<Eigen::VectorXd> parameters;
};

struct ProfileMaximum {
  InstrumentPoint at;
  double std = 0.0;  // of u; infinite where the profile has no maximum
};

class InstrumentProfile {
 public:
  // With the item in the form that stands in it, whatever `from` has. Units are kept under `key`.
  InstrumentProfile(const LoopRecords& records, const LoopFit& from, const LoopItem& item,
                    std::string key, const LoopBudgetOptions& options);

  const EffectParameter& parameter() const { return parameter_; }
  LoopForm FormAt(double u) const;
  InstrumentPoint At(double u, const std::vector<Eigen::VectorXd>& starts);
  // The maximum next to `best`: up by ever longer steps and then by parabolas through three values
  // each, until they stand closer than the profile's own width, or until a parabola's top is not
  // worth `least`.
  ProfileMaximum From(InstrumentPoint best,
                      double least = -std::numeric_limits<double>::infinity());

 private:
  // From `near`, or from where the line through it and the last value known near it leads.
  InstrumentPoint At(double u, const InstrumentPoint& near);

  const LoopRecords& records_;
  const LoopFit& from_;
  const EffectParameter& parameter_;
  LoopForm form_;
  std::string key_;
  std::vector<InstrumentPoint> known_;
  std::size_t evaluations_ = 0;  // each is a unit of its own, the same value from another start too
  const LoopBudgetOptions& options_;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_INSTRUMENT_PROFILE_H_
