#include "estimation/family/local/local_barrier.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "estimation/family/local/quantity_gradient.h"

namespace howl {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Value of the barrier; infinite where a row or a box is not kept.
double Barrier(const LocalCoordinates& c, const BarrierTask& task, LocalState& state,
               std::vector<ConditionRow>& rows) {
  if (!ConditionRows(c, state, task.soft, &rows)) return kInfinite;
  double sum = 0.0;
  for (const ConditionRow& row : rows) {
    const double slack = row.Slack(state.s);
    if (!(slack > 0.0)) return kInfinite;
    sum -= std::log(slack);
  }
  for (std::size_t i = 0; i < c.targets.size(); ++i) {
    for (std::size_t k = 0; k < kLocals; ++k) {
      if (!c.IsOwn(i, k)) continue;
      const Range& box = c.scales[i].box[k];
      const double u = state.local[i][k];
      if (!(u > box.lo) || !(u < box.hi)) return kInfinite;
      sum -=
          std::log((u - box.lo) / (box.hi - box.lo)) + std::log((box.hi - u) / (box.hi - box.lo));
    }
  }
  return sum;
}

class Follower {
 public:
  Follower(const LocalCoordinates& c, const BarrierTask& task, LocalState& state)
      : c_(c),
        task_(task),
        state_(state),
        n_(c.size + (task.has_s ? 1 : 0)),
        hessian_(n_, n_),
        gradient_(n_),
        step_(n_) {}

  bool Run() {
    barrier_ = Barrier(c_, task_, state_, rows_);
    if (!std::isfinite(barrier_)) return false;
    // The tolerance of s, or of the quantity in units of its scale.
    const double gap = task_.has_s ? 5e-7 : 2e-5;
    const double conditions = static_cast<double>(rows_.size() + 2 * static_cast<std::size_t>(n_));
    // On the central path s exceeds its least value by conditions / t.
    for (t_ = task_.has_s ? 3.0 * conditions / std::max(state_.s, 0.1) : 10.0;; t_ *= 6.0) {
      const Outcome outcome = Centre();
      if (outcome == Outcome::kFailed) return false;
      if (outcome == Outcome::kEnough) return true;
      if (conditions / t_ < gap || (outcome == Outcome::kStuck && t_ > 1e7)) return true;
    }
  }

 private:
  enum class Outcome { kCentred, kStuck, kEnough, kFailed };

  Outcome Centre() {
    constexpr int kSteps = 80;
    for (int iteration = 0; iteration < kSteps; ++iteration) {
      hessian_.setZero();
      gradient_.setZero();
      AddRows();
      AddCurvatures();
      AddBoxes();
      if (!AddAim() || !NewtonStep()) return Outcome::kFailed;
      if (-descent_ < 1e-4 && std::abs(miss_) < 1e-10) return Outcome::kCentred;
      if (!Move()) return Outcome::kStuck;
      if (task_.has_s && !task_.pinned && state_.s < task_.enough) return Outcome::kEnough;
    }
    return Outcome::kCentred;
  }

  void AddRows() {
    for (const ConditionRow& row : rows_) {
      const double inverse = 1.0 / row.Slack(state_.s);
      std::array<int, kMostSlopes + 1> index{};
      std::array<double, kMostSlopes + 1> d{};
      auto count = static_cast<std::size_t>(row.count);
      for (std::size_t a = 0; a < count; ++a) {
        index[a] = row.index[a];
        d[a] = row.slope[a] * inverse;
      }
      if (task_.has_s && row.weight > 0.0) {
        index[count] = c_.size;
        d[count++] = row.weight * inverse;
      }
      for (std::size_t a = 0; a < count; ++a) {
        gradient_(index[a]) -= d[a];
        for (std::size_t b = 0; b < count; ++b) hessian_(index[a], index[b]) += d[a] * d[b];
      }
    }
  }

  void AddCurvatures() {
    for (const ConditionRow& row : rows_) {
      if (row.owner < 0) continue;
      const double inverse = 1.0 / row.Slack(state_.s);
      const auto& index = c_.index[static_cast<std::size_t>(row.owner)];
      for (int a = 0; a < kLocals; ++a) {
        for (int b = 0; b < kLocals; ++b) {
          const int ia = index[static_cast<std::size_t>(a)];
          const int ib = index[static_cast<std::size_t>(b)];
          if (ia >= 0 && ib >= 0) hessian_(ia, ib) += inverse * row.curvature(a, b);
        }
      }
    }
  }

  void AddBoxes() {
    for (std::size_t i = 0; i < c_.targets.size(); ++i) {
      for (std::size_t k = 0; k < kLocals; ++k) {
        if (!c_.IsOwn(i, k)) continue;
        const int at = c_.index[i][k];
        const double lo = 1.0 / (state_.local[i][k] - c_.scales[i].box[k].lo);
        const double hi = 1.0 / (c_.scales[i].box[k].hi - state_.local[i][k]);
        gradient_(at) += hi - lo;
        hessian_(at, at) += lo * lo + hi * hi;
      }
    }
  }

  // Of s and the quantity; false where the quantity has no gradient.
  bool AddAim() {
    if (task_.has_s) gradient_(c_.size) += t_;
    value_ = 0.0;
    if (task_.quantity == nullptr) return true;
    if (!QuantityGradient(c_, state_, *task_.quantity, value_, slope_)) return false;
    if (!task_.pinned) gradient_.head(c_.size) -= t_ * task_.sign / task_.scale * slope_;
    return true;
  }

  // The step, and what Merit falls by along it; with a pinned quantity the step that removes its
  // miss to first order, and the penalty under which that is a descent.
  bool NewtonStep() {
    for (int a = 0; a < n_; ++a) hessian_(a, a) *= 1.0 + 1e-12;
    const Eigen::LDLT<Eigen::MatrixXd> factor(hessian_);
    if (factor.info() != Eigen::Success) return false;
    step_ = -factor.solve(gradient_);
    descent_ = gradient_.dot(step_);
    miss_ = 0.0;
    penalty_ = 0.0;
    if (task_.pinned) {
      Eigen::VectorXd a = Eigen::VectorXd::Zero(n_);
      a.head(c_.size) = slope_ / task_.scale;
      miss_ = (value_ - task_.at) / task_.scale;
      const Eigen::VectorXd solved = factor.solve(a);
      const double multiplier = (miss_ + a.dot(step_)) / a.dot(solved);
      step_ -= multiplier * solved;
      penalty_ = 2.0 * std::abs(multiplier) + 1.0;
      descent_ = gradient_.dot(step_) - penalty_ * std::abs(miss_);
    }
    return step_.allFinite();
  }

  double Merit(const LocalState& state, double barrier) const {
    double merit = barrier;
    if (task_.has_s) merit += t_ * state.s;
    if (task_.quantity != nullptr) {
      LocalState copy = state;
      Member member;
      if (!MemberOf(c_, copy, member)) return kInfinite;
      const double value = task_.quantity->value(member);
      merit += task_.pinned ? penalty_ * std::abs(value - task_.at) / task_.scale
                            : -t_ * task_.sign * value / task_.scale;
    }
    if (!std::isfinite(merit)) return kInfinite;
    return merit;
  }

  // The longest of the halved steps that lowers Merit enough; false where none does.
  bool Move() {
    const double before = Merit(state_, barrier_);
    double length = 1.0;
    for (int halving = 0; halving < 40; ++halving, length *= 0.5) {
      LocalState next = Moved(c_, state_, step_, length, task_.has_s);
      const double barrier = Barrier(c_, task_, next, trial_);
      if (!std::isfinite(barrier)) continue;
      const double after = Merit(next, barrier);
      if (!(after <= before + 1e-3 * length * descent_)) continue;
      state_ = std::move(next);
      barrier_ = barrier;
      rows_.swap(trial_);
      return true;
    }
    return false;
  }

  const LocalCoordinates& c_;
  const BarrierTask& task_;
  LocalState& state_;
  const int n_;
  double t_ = 0.0;
  std::vector<ConditionRow> rows_, trial_;  // of the state, and of the one that is tried
  double barrier_ = 0.0;
  Eigen::MatrixXd hessian_;
  Eigen::VectorXd gradient_, step_;
  double value_ = 0.0;     // of the quantity
  Eigen::VectorXd slope_;  // of the quantity
  double descent_ = 0.0, miss_ = 0.0, penalty_ = 0.0;
};

}  // namespace

bool FollowCentralPath(const LocalCoordinates& coordinates, const BarrierTask& task,
                       LocalState& state) {
  return Follower(coordinates, task, state).Run();
}

}  // namespace howl
