// The profile of the evidence over the value of an instrument's parameter, which all operating
// points share, all else of each point fitted anew at each value.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_INSTRUMENT_PROFILE_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_INSTRUMENT_PROFILE_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/trials/loop_trial.h"
#include "estimation/record_fit/point_fit.h"

namespace howl {

// The search's coordinate u is the parameter's logarithm where its scale is logarithmic, else the
// parameter itself.
double ToSearch(const EffectParameter& parameter, double value);
double FromSearch(const EffectParameter& parameter, double u);
double SearchSpan(const EffectParameter& parameter);

// What of a record is fitted: the whole, or what is enough to compare starts (middle_part.h).
enum class RecordExtent : std::uint8_t { kWhole, kMiddle };

// What a value is worth, and each point's fit there.
struct InstrumentPoint {
  double u = 0.0;
  double log_posterior = -std::numeric_limits<double>::infinity();
  double log_evidence = -std::numeric_limits<double>::infinity();
  std::vector<PointFit> fits;
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
  InstrumentPoint At(double u, const std::vector<Eigen::VectorXd>& starts,
                     const PointFitOptions& options = {},
                     RecordExtent extent = RecordExtent::kWhole);
  // The best of the values that a search begins with, the null among them: outwards from it, each
  // from where its neighbour's fits came to, by the records' middles; at its maximum.
  InstrumentPoint Begin(const std::vector<Eigen::VectorXd>& at_null);
  // The maximum of the log posterior next to `best`, by Newton's steps, or as far as their top has
  // the evidence `least`.
  ProfileMaximum From(InstrumentPoint best,
                      double least = -std::numeric_limits<double>::infinity());

 private:
  // Of a point's log posterior v by u, all else, x, moving along `by` to stay most likely:
  //
  //   d/du = v_u,   d^2/du^2 = v_uu + v_ux H^-1 v_xu,   dx/du = H^-1 v_xu,   H = -v_xx
  struct Slopes {
    double slope = 0.0;
    double curvature = 0.0;
    Eigen::VectorXd by;
  };
  std::vector<Slopes> SlopesAt(const InstrumentPoint& point) const;
  Slopes SlopesOfPoint(const InstrumentPoint& point, std::size_t e) const;

  const LoopRecords& records_;
  const LoopFit& from_;
  const EffectParameter& parameter_;
  LoopForm form_;
  std::string key_;
  std::size_t evaluations_ = 0;  // each is a unit of its own, the same value from another start too
  const LoopBudgetOptions& options_;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_INSTRUMENT_PROFILE_H_
