// The profile of the evidence over the values of a shared effect's parameters (shared_effect.h),
// all else of each operating point fitted anew at each.
#ifndef HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_EFFECT_PROFILE_H_
#define HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_EFFECT_PROFILE_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "diagnosis/loop_budget/trials/effect_ranges.h"
#include "diagnosis/loop_budget/trials/loop_trial.h"
#include "estimation/record_fit/point_fit.h"

namespace howl {

// What of a record is fitted: the whole, or what is enough to compare starts (middle_part.h).
enum class RecordExtent : std::uint8_t { kWhole, kMiddle };

// What values are worth, and each point's fit there.
struct EffectPoint {
  Eigen::VectorXd u;
  double log_posterior = -std::numeric_limits<double>::infinity();
  double log_evidence = -std::numeric_limits<double>::infinity();
  std::vector<PointFit> fits;
  std::vector<double> log_jacobian;  // of each fit's record

  // Posterior and evidence, from the fits.
  void SumUp();
};

struct ProfileMaximum {
  EffectPoint at;
  Eigen::MatrixXd information;  // of u; zero where it is not known

  // Of each u; infinite where the profile has no maximum.
  Eigen::VectorXd Deviations() const;
  // ln of the share of the parameters' ranges that the evidence comes from, by Laplace; where a
  // direction tells nothing, all of it.
  double LogShare(const Eigen::VectorXd& spans) const;
};

// To a thousandth of a nat, or as a trial needs to know what it gains over `from` (odds.h).
enum class MaximumKnown : std::uint8_t { kClosely, kRoughly };

class EffectProfile {
 public:
  // With the item in the form that stands in it, whatever `from` has. Units are kept under `key`.
  EffectProfile(const LoopRecords& records, const LoopFit& from, const LoopItem& item,
                MaximumKnown known, std::string key, const LoopBudgetOptions& options);

  const Effect& effect() const { return *form_.effects.back().effect; }
  // Of u, their ranges'.
  const Eigen::VectorXd& low() const { return low_; }
  const Eigen::VectorXd& high() const { return high_; }
  const Eigen::VectorXd& spans() const { return span_; }
  // The null, or where it is infinite the end of the range next to it.
  Eigen::VectorXd NullEnd() const;
  LoopForm FormAt(const Eigen::VectorXd& u) const;
  EffectPoint At(const Eigen::VectorXd& u, const std::vector<Eigen::VectorXd>& starts);
  EffectPoint At(const Eigen::VectorXd& u, const std::vector<Eigen::VectorXd>& starts,
                 const PointFitOptions& options, RecordExtent extent);
  // The best two of the values that a search begins with, or the null where none is better: of the
  // first parameter outwards from its null, each from where its neighbour's fits came to and from
  // where the loop stands, by the records' middles; at their maxima. Where there are two
  // parameters, and the first has a finite null, where the second has no effect: Newton's steps of
  // the first from there, with the values of the second from which they gain more than from those
  // beside them, or the null where none gains.
  std::vector<EffectPoint> Begin(const std::vector<Eigen::VectorXd>& at_null);
  // Where the second of two parameters tells nothing at the first's null, which is finite.
  bool HasFarFromNull() const;
  // What lies outside that which Newton's steps from the null know of. A path turns the cycle's
  // phase, of which a loop knows its delay but for half periods, and so may have another delay than
  // the likeliest without it. From the delay at the null and from those half a period beside it, by
  // the records' middles: a row of the second parameter's values a quarter of the first's range
  // from the null, and from its tops further from it, as long as that gains. The likeliest two. Of
  // 48 rigs with a second path (bench/second_path_study) the likeliest maximum is missed on 4, by
  // up to 770 nats where its share is 0.45; with Newton's steps alone on 19.
  std::vector<EffectPoint> BeginFarFromNull(const std::vector<Eigen::VectorXd>& at_null);
  // Each operating point where it is likelier at another of its delay's maxima. An effect that
  // turns the cycle's phase far moves the best delay to another: a low-pass of q at 0.34 of the
  // cycle's frequency gained 12 000 nats from where the loop stood without it, and 81 000 with the
  // delay that cut B tells beside it.
  void AtOtherDelays(EffectPoint* point);
  // The maximum of the log posterior next to `best`, by Newton's steps, or as far as their top has
  // the evidence `least`.
  ProfileMaximum From(EffectPoint best, double least = -std::numeric_limits<double>::infinity());

 private:
  // Of point e without the item: its log posterior for the record as it was recorded.
  double PosteriorWithout(std::size_t e) const;
  // Nats in which a maximum next to one of so many is known.
  double Known(double log_posterior) const;
  // Of a point's log posterior v by u, all else, x, moving along `by` to stay most likely:
  //
  //   d/du = v_u + v_x dx/du,   d^2/du^2 = v_uu + v_ux H^-1 v_xu,   dx/du = H^-1 v_xu,   H = -v_xx
  //
  // A fit ends a little below its maximum, where v_x is not zero yet, and x may move much with u:
  // without the second term the slope would be off by more than the profile's own.
  struct Slopes {
    Eigen::VectorXd slope;
    Eigen::MatrixXd curvature;
    Eigen::MatrixXd by;  // a column a u
  };
  // By the first parameters, `count` of them.
  std::vector<Slopes> SlopesAt(const EffectPoint& point, Eigen::Index count) const;
  // How many of the best places are gone on from: to first order, or roughly fitted, they may be
  // out of order. A resonance of p, of which the better of two starts was told by the last digits,
  // ended with 250 nats from the one, with 2700 from the other.
  static constexpr std::size_t kMostFollowed = 2;
  static void KeepBest(std::vector<EffectPoint>* points);
  // What fits of the records' middles came to, fitted to the whole.
  std::vector<EffectPoint> OnWholeRecords(const std::vector<EffectPoint>& of_middles);
  // The first parameter so much of its range from its null; the second at a place of a row of them.
  Eigen::VectorXd Far(double first, std::size_t second) const;
  std::vector<EffectPoint> BeginFromNull(const EffectPoint& null);
  EffectPoint Higher(EffectPoint top, std::size_t second);
  // The same cycle with the flame's slope of the other sign, for half a period.
  std::vector<Eigen::VectorXd> Later(double radians, std::vector<Eigen::VectorXd> starts) const;
  // A record which the effect makes less likely than none does may be at a lesser maximum: it
  // begins again from where it stands without.
  void AgainFromNull(const std::vector<Eigen::VectorXd>& at_null, EffectPoint* point);
  // Newton's step within the range, at most so long in it; where the profile is not convex up the
  // slope, as far as a curvature of the other sign had it (Dauphin et al. 2014).
  Eigen::VectorXd StepFrom(const Eigen::VectorXd& u, const Eigen::VectorXd& slope,
                           const Eigen::MatrixXd& information, double longest_step) const;
  Slopes SlopesOfPoint(const EffectPoint& point, std::size_t e, Eigen::Index count) const;

  const LoopRecords& records_;
  const LoopFit& from_;
  LoopForm form_;
  MaximumKnown known_;
  Eigen::VectorXd low_, high_, span_;  // of u
  std::string key_;
  std::size_t evaluations_ = 0;  // each is a unit of its own, the same value from another start too
  const LoopBudgetOptions& options_;
};

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_LOOP_BUDGET_TRIALS_EFFECT_PROFILE_H_
