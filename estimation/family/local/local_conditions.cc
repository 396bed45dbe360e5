#include "estimation/family/local/local_conditions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "estimation/family/local/local_point.h"
#include "model/numerics/units.h"

namespace howl {

namespace {

// The offset N / N_0 - 1, from ln N / N_0. Below what the ellipsoid holds it goes on as a straight
// line in ln N: as N vanishes the offset itself hardly changes, and a search would not come back.
LocalJet ShareOffset(const LocalJet& ln_share, double reach) {
  const double edge = std::max(1.0 - reach, 0.05);
  if (ln_share.a >= std::log(edge)) return exp(ln_share) - 1.0;
  return edge * (ln_share - std::log(edge)) + (edge - 1.0);
}

class RowMaker {
 public:
  RowMaker(const LocalCoordinates& c, const LocalState& state,
           const std::vector<LocalPoint<LocalJet>>& points, const SoftConditions& soft,
           std::vector<ConditionRow>* rows)
      : c_(c), state_(state), points_(points), soft_(soft), rows_(rows) {}

  void AddTolerances(std::size_t i) {
    const LocalScale& scale = c_.scales[i];
    if (scale.has_phase) AddBoth(Coordinate(i, kLocalPhase), i, Condition::kPhase);
    if (scale.has_gain) AddBoth(Coordinate(i, kLocalGain), i, Condition::kGain);
    if (scale.has_loop_phase) {
      AddBoth(points_[i].loop_phase_rad / scale.loop_phase, i, Condition::kLoopPhase);
    }
    const double xi_max = c_.problem.test.xi_max;
    if (std::isfinite(xi_max)) {
      Add(1.0 + (points_[i].ln_xi - std::log(xi_max * (1 - kLocalMargin))), i,
          IsSoft(Condition::kXiMax));
    }
  }

  void AddSecondMode(std::size_t i) {
    const LocalPoint<LocalJet>& p = points_[i];
    const double tolerance =
        c_.problem.test.second_crossing_tolerance_deg * kRadPerDeg * (1.0 - kLocalMargin);
    for (const LocalJet& error : p.line_rad) {
      AddBoth(error / tolerance, i, Condition::kSecondCrossing);
    }
    const MembershipTest& test = c_.problem.test;
    for (const LocalJet& ln_gain : p.ln_line_gain) {
      const double least = std::log(test.second_crossing_gain_min * (1.0 + kLocalMargin));
      Add(1.0 + (least - ln_gain), i, IsSoft(Condition::kSecondCrossingGain));
    }
    if (std::isfinite(test.second_mode_share_max)) {
      Add(p.second_mode_share / (test.second_mode_share_max * (1.0 - kLocalMargin)), i,
          IsSoft(Condition::kSecondModeShare));
    }
    if (!c_.shared_second) {
      Add(1.0 - p.above, i, false);
      Add(1.0 - p.below, i, false);
    }
  }

  void AddDomain(std::size_t i) {
    const LocalPoint<LocalJet>& p = points_[i];
    AddRange(i, ParameterKind::kOmega, p.ln_omega);
    AddRange(i, ParameterKind::kN, p.ln_N);
    if (c_.two_modes && !c_.shared_second) {
      AddRange(i, c_.SecondKind(), c_.relative ? p.ln_M - p.ln_N : p.ln_M);
    }
    const Range tau = c_.problem.RangeOf(ParameterKind::kTau, i);
    if (tau.lo > 0.0) Add(1.0 + (1.0 - p.tau_s / tau.lo), i, soft_.domain);
    if (std::isfinite(tau.hi)) Add(1.0 + (p.tau_s / tau.hi - 1.0), i, soft_.domain);
  }

  void AddTransfer(std::size_t i) {
    const double limit = c_.scales[i].transfer_limit;
    if (!std::isfinite(limit)) return;
    const auto& ellipsoid = c_.problem.experiments[i].transfer_ellipsoid;
    const LocalPoint<LocalJet>& p = points_[i];
    const TransferMatrix& factor = ellipsoid->Factor(c_.two_modes);
    const TransferVector ln_centre = ellipsoid->Centre().array().log();
    LocalJet v[kNumTransferParameters] = {p.ln_omega - ln_centre(0), p.ln_xi - ln_centre(1),
                                          p.ln_N - ln_centre(2), p.ln_M - ln_centre(3)};
    const LocalJet ln_N = v[2], ln_M = v[3];
    for (int k = 0; k < kNumTransferParameters; ++k) {
      if (!IsLogOffset(k)) {
        v[k] = ShareOffset(v[k], limit * std::sqrt(ellipsoid->Covariance()(k, k)));
      }
    }
    LocalJet sum(1e-8);
    Eigen::Matrix<double, kLocals, kLocals> form;
    form.setZero();
    TransferVector pull = TransferVector::Zero();  // of half the form by the offsets
    for (int r = 0; r < kNumTransferParameters; ++r) {
      LocalJet part(0.0);
      for (int k = r; k < kNumTransferParameters; ++k) {
        if (factor(r, k) != 0.0) part += factor(r, k) * v[k];
      }
      sum += part * part;
      form += part.v * part.v.transpose();
      pull += part.a * factor.row(r).transpose();
    }
    // An offset bends with its logarithm: d^2 (N / N_0) = (N / N_0) (d ln N)^2. The form stays
    // definite as long as less than 1 / C_kk is taken from one of its offsets, or from each of two
    // less than half of that: more than 0.45 is never taken.
    for (const auto& [k, ln] : {std::pair{2, &ln_N}, {3, &ln_M}}) {
      if (factor(k, k) == 0.0) continue;
      const double share = v[k].a + 1.0;
      const double least = -0.45 * share * share / ellipsoid->Covariance()(k, k);
      form += std::max(pull(k) * share, least) * ln->v * ln->v.transpose();
    }
    const LocalJet distance = sqrt(sum);
    Add(distance / limit, i, IsSoft(Condition::kTransfer));
    rows_->back().owner = static_cast<int>(i);
    rows_->back().curvature = (form - distance.v * distance.v.transpose()) / (distance.a * limit);
  }

  void AddBetween(std::size_t i, std::size_t j) {
    if (std::isfinite(c_.ln_spread)) {
      AddPair(points_[i].ln_omega, i, points_[j].ln_omega, j, c_.ln_spread, 0.0,
              IsSoft(Condition::kOmegaSpread));
    }
    if (c_.problem.test.xi_increasing && c_.targets[j].phi < c_.targets[i].phi) {
      AddPair(points_[j].ln_xi, j, points_[i].ln_xi, i, 1.0, 1.0 + kLocalMargin,
              IsSoft(Condition::kXiIncreasing));
    }
  }

 private:
  bool IsSoft(Condition condition) const { return soft_.conditions.Contains(condition); }

  void Add(const LocalJet& violation, std::size_t i, bool is_soft) {
    ConditionRow& row = rows_->emplace_back();
    row.weight = is_soft ? 1.0 : 0.0;
    row.value = (is_soft ? 0.0 : 1.0) - violation.a;
    for (int k = 0; k < kLocals; ++k) {
      const int at = c_.index[i][static_cast<std::size_t>(k)];
      if (at < 0 || violation.v[k] == 0.0) continue;
      row.index[static_cast<std::size_t>(row.count)] = at;
      row.slope[static_cast<std::size_t>(row.count++)] = -violation.v[k];
    }
  }

  // The violation offset + (a - b) / scale, of two experiments.
  void AddPair(const LocalJet& a, std::size_t i, const LocalJet& b, std::size_t j, double scale,
               double offset, bool is_soft) {
    Add(offset + a / scale, i, is_soft);
    ConditionRow& row = rows_->back();
    row.value += b.a / scale;
    for (int k = 0; k < kLocals; ++k) {
      const int at = c_.index[j][static_cast<std::size_t>(k)];
      if (at < 0 || b.v[k] == 0.0) continue;
      row.index[static_cast<std::size_t>(row.count)] = at;
      row.slope[static_cast<std::size_t>(row.count++)] = b.v[k] / scale;
    }
  }

  LocalJet Coordinate(std::size_t i, int k) const {
    return LocalJet(state_.local[i][static_cast<std::size_t>(k)], k);
  }

  // |error| at most one.
  void AddBoth(const LocalJet& error, std::size_t i, Condition condition) {
    Add(error, i, IsSoft(condition));
    Add(-error, i, IsSoft(condition));
  }

  void AddRange(std::size_t i, ParameterKind kind, const LocalJet& ln) {
    const Range range = c_.problem.RangeOf(kind, i);
    if (range.lo > 0.0) Add(1.0 + (std::log(range.lo) - ln), i, soft_.domain);
    if (std::isfinite(range.hi)) Add(1.0 + (ln - std::log(range.hi)), i, soft_.domain);
  }

  const LocalCoordinates& c_;
  const LocalState& state_;
  const std::vector<LocalPoint<LocalJet>>& points_;
  const SoftConditions& soft_;
  std::vector<ConditionRow>* rows_;
};

}  // namespace

bool ConditionRows(const LocalCoordinates& c, LocalState& state, const SoftConditions& soft,
                   std::vector<ConditionRow>* rows) {
  const std::size_t n = c.targets.size();
  static thread_local std::vector<LocalPoint<LocalJet>> points;
  points.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!BuildLocalPoint(c, i, state.local[i], state.omega_hz[i], points[i])) return false;
  }
  rows->clear();
  RowMaker maker(c, state, points, soft, rows);
  for (std::size_t i = 0; i < n; ++i) {
    maker.AddTolerances(i);
    if (c.two_modes) maker.AddSecondMode(i);
    maker.AddDomain(i);
    maker.AddTransfer(i);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (i != j) maker.AddBetween(i, j);
    }
  }
  return true;
}

double LargestViolation(const LocalCoordinates& c, LocalState& state, const SoftConditions& soft) {
  std::vector<ConditionRow> rows;
  if (!ConditionRows(c, state, soft, &rows)) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (const ConditionRow& row : rows) {
    if (row.weight > 0.0) largest = std::max(largest, -row.value);
  }
  return largest;
}

}  // namespace howl
