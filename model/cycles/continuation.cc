#include "model/cycles/continuation.h"

#include <glog/logging.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "model/cycles/balance_equations.h"
#include "model/loop/crossings.h"
#include "model/numerics/dense_algebra.h"

namespace howl {
namespace {

using internal::BalanceState;

// Point and tangent in (u, lambda / range). u is relative to the rate scale of the model there.
struct ArcPoint {
  Eigen::VectorXd z;
  Eigen::VectorXd tangent;
};

class Follower {
 public:
  Follower(const ParameterPath& path, const ContinuationOptions& options)
      : path_(path), options_(options), range_(options.parameter_max - options.parameter_min) {
    CHECK_GT(range_, 0.0);
  }

  double Parameter(const Eigen::VectorXd& z) const { return z(z.size() - 1) * range_; }

  Eigen::VectorXd Pack(const LimitCycle& cycle, double parameter) const {
    const double scale = internal::RateScale(path_(parameter).flame);
    const Eigen::VectorXd u = internal::PackState({cycle.rate, cycle.frequency_hz}, scale);
    Eigen::VectorXd z(u.size() + 1);
    z << u, parameter / range_;
    return z;
  }

  BalanceState State(const Eigen::VectorXd& z) const {
    const double scale = internal::RateScale(path_(Parameter(z)).flame);
    return internal::UnpackState(z.head(z.size() - 1), scale);
  }

  // dr / d(u, lambda): harmonic balance's own Jacobian, and a central difference in the parameter.
  Eigen::VectorXd Linearise(const Eigen::VectorXd& z, Eigen::MatrixXd* jacobian) const {
    const Eigen::Index n = z.size() - 1;
    Eigen::MatrixXd in_u;
    Eigen::VectorXd r = internal::BalanceResiduals(path_(Parameter(z)), State(z), &in_u);
    jacobian->resize(n, n + 1);
    jacobian->leftCols(n) = in_u;
    constexpr double kDifference = 1e-6;
    Eigen::VectorXd up = z;
    Eigen::VectorXd down = z;
    up(n) += kDifference;
    down(n) -= kDifference;
    jacobian->col(n) = (internal::BalanceResiduals(path_(Parameter(up)), State(up), nullptr) -
                        internal::BalanceResiduals(path_(Parameter(down)), State(down), nullptr)) /
                       (2.0 * kDifference);
    return r;
  }

  Eigen::VectorXd Tangent(const Eigen::VectorXd& z, const Eigen::VectorXd& along) const {
    Eigen::MatrixXd jacobian;
    Linearise(z, &jacobian);
    const Eigen::Index n = z.size() - 1;
    Eigen::MatrixXd bordered(n + 1, n + 1);
    bordered << jacobian, along.transpose();
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 1);
    right(n) = 1.0;
    return SolveByLu(bordered, right).normalized();
  }

  // The point at arc length ds from `from`; nothing if Newton fails. *iterations tells the effort.
  std::optional<ArcPoint> Step(const ArcPoint& from, double ds, int* iterations) const {
    const Eigen::Index n = from.z.size() - 1;
    Eigen::VectorXd z = from.z + ds * from.tangent;
    Eigen::MatrixXd jacobian;
    Eigen::MatrixXd bordered(n + 1, n + 1);
    Eigen::VectorXd right(n + 1);
    for (int i = 1; i <= 12; ++i) {
      right.head(n) = Linearise(z, &jacobian);
      right(n) = from.tangent.dot(z - from.z) - ds;
      bordered << jacobian, from.tangent.transpose();
      const Eigen::VectorXd step = SolveByLu(bordered, right);
      if (!step.allFinite() || step.norm() > 1.0) return std::nullopt;
      z -= step;
      if (step.cwiseAbs().maxCoeff() < 1e-11) {
        *iterations = i;
        return ArcPoint{z, Tangent(z, from.tangent)};
      }
    }
    return std::nullopt;
  }

  BranchPoint Describe(const Eigen::VectorXd& z) const {
    BranchPoint point;
    point.parameter = Parameter(z);
    const ClosedLoop model = path_(point.parameter);
    point.cycle = internal::MakeLimitCycle(model, State(z));
    if (options_.stability) {
      const FloquetMultipliers floquet = CycleStability(model, point.cycle, options_.floquet);
      point.stable = floquet.stable;
      if (!floquet.multipliers.empty()) point.leading_multiplier = floquet.multipliers.front();
    }
    return point;
  }

  // In the direction of from.tangent; appends points and bifurcations.
  void Follow(ArcPoint from, BranchPoint last, Branch* branch) const {
    double ds = options_.first_step;
    for (int i = 0; i < options_.max_points; ++i) {
      int iterations = 0;
      std::optional<ArcPoint> next;
      for (;;) {
        next = Step(from, ds, &iterations);
        if (next && next->tangent.dot(from.tangent) > 0.9) break;
        ds *= 0.5;
        if (ds < options_.min_step) return;
      }
      if (next->z(0) < options_.min_amplitude) {
        AddHopf(from, ds, branch);
        return;
      }
      const double parameter = Parameter(next->z);
      if (parameter < options_.parameter_min || parameter > options_.parameter_max) {
        EndAtLimit(from, ds, branch);
        return;
      }
      if (next->tangent(Last(next->tangent)) * from.tangent(Last(from.tangent)) < 0.0) {
        const double at =
            Bisect(from, ds, [](const ArcPoint& p) { return p.tangent(Last(p.tangent)); });
        Add(BifurcationKind::kFold, from, at, branch);
      }
      BranchPoint point = Describe(next->z);
      if (options_.stability && point.stable != last.stable) {
        LocateStabilityChange(from, ds, branch);
      }
      branch->points.push_back(point);
      last = std::move(point);
      from = Grown(*next);
      if (iterations <= 4) ds = std::min(1.4 * ds, options_.max_step);
    }
  }

 private:
  static Eigen::Index Last(const Eigen::VectorXd& v) { return v.size() - 1; }

  // More harmonics once the last ones matter.
  ArcPoint Grown(const ArcPoint& point) const {
    BalanceState state = State(point.z);
    if (internal::Tail(state.rate) <= 100.0 * options_.balance.tolerance) return point;
    const std::size_t harmonics = 2 * (state.rate.size() - 1);
    if (static_cast<int>(harmonics) > options_.balance.max_harmonics) return point;
    const Eigen::Index old = point.z.size() - 1;
    const auto n = static_cast<Eigen::Index>(2 * harmonics);
    ArcPoint grown{Eigen::VectorXd::Zero(n + 1), Eigen::VectorXd::Zero(n + 1)};
    grown.z.head(old) = point.z.head(old);
    grown.z(n) = point.z(old);
    grown.tangent.head(old) = point.tangent.head(old);
    grown.tangent(n) = point.tangent(old);
    return grown;
  }

  template <typename F>
  double Bisect(const ArcPoint& from, double ds, F&& value) const {
    double lo = 0.0;
    double hi = ds;
    const bool positive = value(from) > 0.0;
    int unused = 0;
    for (int i = 0; i < 40 && hi - lo > 1e-9; ++i) {
      const double middle = 0.5 * (lo + hi);
      const std::optional<ArcPoint> point = Step(from, middle, &unused);
      if (!point) break;
      ((value(*point) > 0.0) == positive ? lo : hi) = middle;
    }
    return 0.5 * (lo + hi);
  }

  void Add(BifurcationKind kind, const ArcPoint& from, double ds, Branch* branch) const {
    int unused = 0;
    const std::optional<ArcPoint> point = Step(from, ds, &unused);
    if (!point) return;
    const BalanceState state = State(point->z);
    branch->bifurcations.push_back(
        {kind, Parameter(point->z), state.frequency_hz, std::abs(state.rate[1])});
  }

  void EndAtLimit(const ArcPoint& from, double ds, Branch* branch) const {
    int unused = 0;
    const double limit =
        from.tangent(Last(from.tangent)) > 0.0 ? options_.parameter_max : options_.parameter_min;
    const double at = Bisect(from, ds, [&](const ArcPoint& p) { return Parameter(p.z) - limit; });
    const std::optional<ArcPoint> point = Step(from, at, &unused);
    if (point) branch->points.push_back(Describe(point->z));
  }

  // Where the amplitude would vanish: there the crossing's gain is one.
  void AddHopf(const ArcPoint& from, double ds, Branch* branch) const {
    int unused = 0;
    const double at =
        Bisect(from, ds, [&](const ArcPoint& p) { return p.z(0) - options_.min_amplitude; });
    const std::optional<ArcPoint> point = Step(from, at, &unused);
    if (!point) return;
    const double near_hz = State(point->z).frequency_hz;
    const auto crossing = [&](double parameter) {
      const ClosedLoop model = path_(parameter);
      PhaseCrossing nearest;
      for (const PhaseCrossing& c :
           PhaseCrossings(model.loop, FlameSlope(model.flame, 0.0), 2.0 * near_hz)) {
        if (std::abs(c.frequency_hz - near_hz) < std::abs(nearest.frequency_hz - near_hz)) {
          nearest = c;
        }
      }
      return nearest;
    };
    double a = Parameter(point->z);
    double b = a + 1e-4 * range_;
    double gain_a = std::log(crossing(a).gain);
    for (int i = 0; i < 20 && std::abs(b - a) > 1e-14 * range_; ++i) {
      const double gain_b = std::log(crossing(b).gain);
      if (gain_b == gain_a) break;
      const double next = b - gain_b * (b - a) / (gain_b - gain_a);
      a = b;
      gain_a = gain_b;
      b = next;
    }
    branch->bifurcations.push_back({BifurcationKind::kHopf, b, crossing(b).frequency_hz, 0.0});
  }

  void LocateStabilityChange(const ArcPoint& from, double ds, Branch* branch) const {
    const double at = Bisect(from, ds, [&](const ArcPoint& p) {
      return std::abs(Describe(p.z).leading_multiplier) - 1.0;
    });
    int unused = 0;
    const std::optional<ArcPoint> point = Step(from, at, &unused);
    if (!point) return;
    const std::complex<double> multiplier = Describe(point->z).leading_multiplier;
    BifurcationKind kind = BifurcationKind::kTorus;
    if (std::abs(multiplier.imag()) < 1e-3) {
      if (multiplier.real() < 0.0) {
        kind = BifurcationKind::kPeriodDoubling;
      } else {
        const bool fold =
            !branch->bifurcations.empty() &&
            branch->bifurcations.back().kind == BifurcationKind::kFold &&
            std::abs(branch->bifurcations.back().parameter - Parameter(point->z)) < 1e-3 * range_;
        if (fold) return;  // the same point, already listed
        kind = BifurcationKind::kBranchPoint;
      }
    }
    Add(kind, from, at, branch);
  }

  const ParameterPath& path_;
  const ContinuationOptions& options_;
  double range_;
};

}  // namespace

Branch ContinueCycle(const ParameterPath& path, double parameter, const LimitCycle& cycle,
                     const ContinuationOptions& options) {
  const Follower follower(path, options);
  ArcPoint start;
  start.z = follower.Pack(cycle, parameter);
  Eigen::VectorXd along = Eigen::VectorXd::Zero(start.z.size());
  along(along.size() - 1) = 1.0;
  start.tangent = follower.Tangent(start.z, along);
  const BranchPoint first = follower.Describe(start.z);

  Branch branch;
  ArcPoint reversed = start;
  reversed.tangent = -reversed.tangent;
  follower.Follow(reversed, first, &branch);
  std::reverse(branch.points.begin(), branch.points.end());
  std::reverse(branch.bifurcations.begin(), branch.bifurcations.end());
  branch.points.push_back(first);
  follower.Follow(start, first, &branch);
  return branch;
}

}  // namespace howl
