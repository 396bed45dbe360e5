#include "diagnosis/loop_budget/trials/effect_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimation/analysis/spectra/half_width.h"

namespace howl {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
// Nats of the interval's ends below the top.
constexpr double kBelowTop = 0.5 * HalfWidth95(1.0) * HalfWidth95(1.0);
// An end is known where the profile there is so near to it, in nats: to a tenth of its distance.
constexpr double kAtEnd = 0.4;
// Where a parabola through the null tells how wide the interval is.
constexpr double kLeastBelow = 0.5;
constexpr double kMostBelow = 8.0;
constexpr int kMostTried = 12;
// Of the range's strength, where an end is looked for first.
constexpr double kFirst = 1e-3;
constexpr double kLongest = 8.0;  // next strength over the last, or the last over the next

// A distance from the profile's top at which it is so far below, looked for.
struct Bracket {
  double at = 0.0;
  double within = 0.0;
  double beyond = kUnbounded;

  // `below`: what it is where it was looked for last.
  void Next(double below) {
    (below < kBelowTop ? within : beyond) = at;
    // Near the top the profile falls with the distance's square.
    at *= std::clamp(std::sqrt(kBelowTop / std::max(below, 1e-3)), 1.0 / kLongest, kLongest);
    if (within > 0.0 && std::isfinite(beyond)) at = 0.5 * (within + beyond);
  }
};

// The interval of one effect's value, by its strength: zero at the null, and one at the farther end
// of the range, or minus one. Where the null is infinite the strength is the range's least value
// over the value.
class IntervalSearch {
 public:
  IntervalSearch(const std::vector<Eigen::VectorXd>& at_null, EffectProfile* profile)
      : profile_(*profile),
        parameter_(profile_.effect().parameters()[0]),
        low_(FromSearch(parameter_, profile_.low()[0])),
        high_(FromSearch(parameter_, profile_.high()[0])),
        null_(profile_.At(At(0.0), at_null, kToCompare, RecordExtent::kWhole)),
        last_(null_),
        top_(null_.log_posterior) {}

  EffectInterval Ends() {
    const bool has_low = low_ < parameter_.null_value;
    const bool has_high = high_ > parameter_.null_value;
    const double side = std::isfinite(parameter_.null_value) && has_high ? 1.0 : -1.0;
    const Parabola near_null = NearNull(side, has_low && has_high);
    return {has_low ? ValueOrInfinity(End(-1.0, near_null)) : -kUnbounded,
            has_high ? ValueOrInfinity(End(1.0, near_null)) : kUnbounded};
  }

 private:
  // top - curvature (strength - at)^2 / 2; without a curvature where nothing is told.
  struct Parabola {
    double at = 0.0;
    double curvature = 0.0;
  };

  double Value(double strength) const {
    const double null = parameter_.null_value;
    if (!std::isfinite(null)) return low_ / std::abs(strength);
    return null + strength * Farther();
  }
  // From a finite null to the range's farther end.
  double Farther() const {
    return std::max(high_ - parameter_.null_value, parameter_.null_value - low_);
  }
  // How strong it may be on one side.
  double RangeOn(double side) const {
    const double null = parameter_.null_value;
    if (!std::isfinite(null)) return 1.0;
    return (side > 0.0 ? high_ - null : null - low_) / Farther();
  }
  double ValueOrInfinity(double strength) const {
    return std::isfinite(strength) ? Value(strength) : strength;
  }
  Eigen::VectorXd At(double strength) const {
    const double value = strength == 0.0 ? parameter_.null_value : Value(strength);
    return Eigen::VectorXd::Constant(1, ToSearch(parameter_, value));
  }

  // The profile below its top so far.
  double Below(double strength) {
    std::vector<Eigen::VectorXd> starts = ParametersOf(last_.fits);
    // All else moves with the strength.
    for (std::size_t e = 0; e < starts.size() && last_strength_ != 0.0; ++e) {
      const Eigen::VectorXd& null = null_.fits[e].parameters;
      starts[e] = null + strength / last_strength_ * (starts[e] - null);
    }
    last_ = profile_.At(At(strength), starts, kToCompare, RecordExtent::kWhole);
    last_strength_ = strength;
    top_ = std::max(top_, last_.log_posterior);
    return top_ - last_.log_posterior;
  }

  // Through the null and two strengths of which the farther is about where the interval ends.
  Parabola NearNull(double side, bool both_sides) {
    Bracket distance{kFirst};
    for (int i = 0; i < kMostTried; ++i) {
      const double below = Below(side * distance.at);
      if (kLeastBelow < below && below < kMostBelow) break;
      if (below < kLeastBelow && distance.at == 1.0) return {};
      distance.Next(below);
      distance.at = std::min(distance.at, 1.0);
    }
    const double far = side * distance.at;
    const double at_far = last_.log_posterior - null_.log_posterior;
    const double beside = both_sides ? -far : 0.5 * far;
    Below(beside);
    const double at_beside = last_.log_posterior - null_.log_posterior;
    // at_far = slope far - curvature far^2 / 2, and so beside.
    const double curvature = 2.0 * (at_beside / beside - at_far / far) / (far - beside);
    const double slope = at_far / far + 0.5 * curvature * far;
    if (!(curvature > 0.0)) return {0.0, 2.0 * kBelowTop / (far * far)};
    Parabola out{slope / curvature, curvature};
    if (!both_sides && out.at * side < 0.0) out.at = 0.0;
    // Elsewhere the top is no more than an eighth of a nat higher than the null.
    if (out.at * out.at * curvature > 0.25) Below(out.at);
    return out;
  }

  // Strength of the end on one side; infinite where the range ends before.
  double End(double side, const Parabola& near_null) {
    if (!(near_null.curvature > 0.0)) return side * kUnbounded;
    const double most = RangeOn(side) - side * near_null.at;
    Bracket distance{std::sqrt(2.0 * kBelowTop / near_null.curvature)};
    for (int i = 0; i < kMostTried; ++i) {
      distance.at = std::min(distance.at, most);
      const double below = Below(near_null.at + side * distance.at);
      if (std::abs(below - kBelowTop) < kAtEnd) break;
      if (below < kBelowTop && distance.at == most) return side * kUnbounded;
      distance.Next(below);
    }
    return near_null.at + side * distance.at;
  }

  EffectProfile& profile_;
  const EffectParameter& parameter_;
  double low_;
  double high_;
  EffectPoint null_;
  EffectPoint last_;
  double last_strength_ = 0.0;
  double top_;
};

}  // namespace

EffectInterval IntervalOf(const std::vector<Eigen::VectorXd>& at_null, EffectProfile* profile) {
  return IntervalSearch(at_null, profile).Ends();
}

}  // namespace howl
