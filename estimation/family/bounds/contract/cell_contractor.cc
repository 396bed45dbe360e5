#include "estimation/family/bounds/contract/cell_contractor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "estimation/family/bounds/contract/carrying_mode_bound.h"
#include "estimation/family/bounds/contract/centred_bound.h"
#include "estimation/family/bounds/contract/second_mode_bound.h"
#include "estimation/family/problem/targets.h"
#include "model/numerics/constants.h"

namespace howl {
namespace {

constexpr int kPasses = 8;
constexpr double kProgress = 0.02;  // a pass that narrows less than this ends the contraction
constexpr int kSlices = 6;

// Widened by more than the rounding of the test, which is evaluated in doubles.
void AskOfSecondMode(const Experiment& experiment, const MembershipTest& test,
                     ContractTarget& target) {
  constexpr double kSlack = 1e-12;
  target.second_mode_share_max = test.second_mode_share_max * (1.0 + kSlack) + kSlack;
  if (!TestsLineGain(experiment, test)) return;
  for (const Interval& line : target.lines_hz) {
    const Interval w = target.w_rad_s / target.frequency_hz * line;
    target.line_response_min.push_back(Interval(test.second_crossing_gain_min * (1.0 - kSlack)) /
                                       (w * Interval(experiment.SteepestSlope())));
  }
}

}  // namespace

CellContractor::CellContractor(const FamilyProblem& problem) {
  const RoundingGuard guard;
  two_modes_ = problem.model.modes == 2;
  increasing_ = problem.test.xi_increasing;
  has_window_ = std::isfinite(problem.test.omega_spread_max);
  factor_ = 1.0 + Interval(problem.test.omega_spread_max);
  // Tolerances widened by more than the rounding of the constants made from them.
  const std::vector<ExperimentTarget> targets = MakeTargets(problem, -1e-13);
  const Interval pi = Widened(kPi);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto range_of = [&](ParameterKind kind) {
      const Range range = problem.RangeOf(kind, i);
      return Interval(range.lo, range.hi);
    };
    const Experiment& experiment = problem.experiments[i];
    ContractTarget target;
    target.frequency_hz = Interval(experiment.frequency_hz);
    target.w_rad_s = 2.0 * pi * target.frequency_hz;
    target.harmonic_ratio = Interval(problem.model.harmonic_ratio);
    target.turns = pi * 1.5 + pi * (2.0 * problem.domain.delay_periods);
    target.phi = experiment.phi;
    const double line_tolerance = problem.test.second_crossing_tolerance_deg;
    for (const ObservedLine& line : experiment.lines) {
      target.lines_hz.emplace_back(line.frequency_hz);
    }
    target.has_line_error = two_modes_ && line_tolerance < 180.0;
    if (target.has_line_error) {
      const double rad = Above(line_tolerance * kRadPerDeg);
      target.line_error_rad = Interval(-rad, rad);
    }
    if (two_modes_) AskOfSecondMode(experiment, problem.test, target);
    if (experiment.transfer_ellipsoid && std::isfinite(problem.test.transfer_distance_max)) {
      target.transfer = MakeTransferBound(*experiment.transfer_ellipsoid, two_modes_,
                                          problem.test.transfer_distance_max);
    }
    targets_.push_back(target);

    const ExperimentTarget& bounds = targets[i];
    ExperimentBox box;
    box[kCellOmega] = range_of(ParameterKind::kOmega);
    box[kCellXi] = range_of(ParameterKind::kXi);
    empty_ |= bounds.IsEmpty() || !NarrowUpper(box[kCellXi], problem.test.xi_max);
    if (empty_) return;
    box[kCellTangent] = Tangent(-Widened(bounds.phase_rad.lo, bounds.phase_rad.hi));
    box[kCellGain] = Widened(bounds.gain.lo, bounds.gain.hi);
    // The caps of MakeTargets stand for "no limit".
    if (bounds.gain.lo <= experiment.gain * 2e-4 || problem.test.gain_tolerance > 5e3) {
      box[kCellGain] =
          Interval(bounds.gain.lo <= experiment.gain * 2e-4 ? 0.0 : box[kCellGain].lower(),
                   problem.test.gain_tolerance > 5e3 ? kUnbounded : box[kCellGain].upper());
    }
    box[kCellN] = range_of(ParameterKind::kN);
    box[kCellM] = two_modes_ ? range_of(ParameterKind::kM) : Interval(0.0);
    box[kCellRelative] = two_modes_ ? range_of(ParameterKind::kMOverN) : Interval(0.0);
    box[kCellLoopPhase] = Widened(bounds.loop_phase_error_rad.lo, bounds.loop_phase_error_rad.hi);
    box[kCellTau] = range_of(ParameterKind::kTau);
    root_.push_back(box);
  }
  order_.resize(targets_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::ranges::stable_sort(order_, {}, [&](std::size_t i) { return targets_[i].phi; });
  const std::array<std::pair<ParameterKind, CellVariable>, 6> kinds = {
      {{ParameterKind::kOmega, kCellOmega},
       {ParameterKind::kXi, kCellXi},
       {ParameterKind::kN, kCellN},
       {ParameterKind::kM, kCellM},
       {ParameterKind::kMOverN, kCellRelative},
       {ParameterKind::kTau, kCellTau}}};
  for (const auto& [kind, variable] : kinds) {
    if (problem.IsShared(kind)) shared_.push_back(variable);
  }
}

Cell CellContractor::Root() const {
  Cell cell;
  cell.window_hz = Interval(0.0, kUnbounded);
  cell.boxes = root_;
  return cell;
}

bool CellContractor::ContractExperiment(std::size_t i, ExperimentBox& box) const {
  const ContractTarget& target = targets_[i];
  if (!ContractTransfer(target, box)) return false;
  if (two_modes_) {
    return ContractCarryingMode(target, box) && ContractTwoModes(target, box) &&
           ContractSecondModeShare(target, box) && ContractDelay(target, box) &&
           ContractLines(target, box) && ContractLineGain(target, box) &&
           ContractCentred(target, box);
  }
  return ContractPhase(target, box) && ContractGain(target, box) && ContractDelay(target, box);
}

bool CellContractor::ContractSliced(std::size_t i, ExperimentBox& box) const {
  const Interval xi = box[kCellXi];
  const double step = Width(xi) / kSlices;
  if (!std::isfinite(step) || step <= 1e-9) return ContractExperiment(i, box);
  ExperimentBox hull{};
  bool any = false;
  for (int slice = 0; slice < kSlices; ++slice) {
    ExperimentBox part = box;
    const double lo = slice == 0 ? xi.lower() : xi.lower() + slice * step;
    const double hi = slice + 1 == kSlices ? xi.upper() : xi.lower() + (slice + 1) * step;
    part[kCellXi] = Interval(std::min(lo, xi.upper()), std::min(std::max(lo, hi), xi.upper()));
    if (!ContractExperiment(i, part) || !ContractExperiment(i, part)) continue;
    for (std::size_t v = 0; v < kNumCellVariables; ++v) {
      hull[v] = any ? boost::numeric::hull(hull[v], part[v]) : part[v];
    }
    any = true;
  }
  if (any) box = hull;
  return any;
}

bool CellContractor::ContractWindow(Cell& cell) const {
  if (!has_window_) return true;
  for (ExperimentBox& box : cell.boxes) {
    Interval& omega = box[kCellOmega];
    if (!NarrowLower(omega, cell.window_hz.lower()) ||
        !NarrowUpper(omega, (Interval(cell.window_hz.upper()) * factor_).upper()) ||
        !NarrowUpper(cell.window_hz, omega.upper()) ||
        !NarrowLower(cell.window_hz, (Interval(omega.lower()) / factor_).lower())) {
      return false;
    }
  }
  return true;
}

bool CellContractor::ContractChain(Cell& cell) const {
  if (!increasing_) return true;
  // Up the chain with the largest of the low ends so far, and down with the smallest high end.
  const std::size_t n = order_.size();
  const auto box_of = [&](std::size_t k) -> Interval& { return cell.boxes[order_[k]][kCellXi]; };
  const auto same_link = [&](std::size_t a, std::size_t b) {
    return !(targets_[order_[a]].phi < targets_[order_[b]].phi);
  };
  double below = -kUnbounded, here = -kUnbounded;
  for (std::size_t k = 0; k < n; ++k) {
    if (k > 0 && !same_link(k - 1, k)) below = std::max(below, here);
    if (!NarrowLower(box_of(k), below)) return false;
    here = std::max(here, box_of(k).lower());
  }
  double above = kUnbounded;
  here = kUnbounded;
  for (std::size_t k = n; k-- > 0;) {
    if (k + 1 < n && !same_link(k, k + 1)) above = std::min(above, here);
    if (!NarrowUpper(box_of(k), above)) return false;
    here = std::min(here, box_of(k).upper());
  }
  return true;
}

bool CellContractor::ContractShared(Cell& cell) const {
  for (const CellVariable variable : shared_) {
    Interval common = cell.boxes[0][variable];
    for (const ExperimentBox& box : cell.boxes) {
      if (!Narrow(common, box[variable])) return false;
    }
    for (ExperimentBox& box : cell.boxes) box[variable] = common;
  }
  return true;
}

bool CellContractor::Contract(Cell& cell) const {
  if (empty_) return false;
  const RoundingGuard guard;
  const auto size = [&] {
    double sum = 0.0;
    for (const ExperimentBox& box : cell.boxes) {
      for (const CellVariable v : {kCellOmega, kCellXi, kCellTangent}) {
        const double root_width = Width(root_[0][v]);
        sum += Width(box[v]) / (std::isfinite(root_width) ? root_width : box[v].upper());
      }
    }
    return sum;
  };
  double before = size();
  for (int pass = 0; pass < kPasses; ++pass) {
    if (!ContractShared(cell) || !ContractWindow(cell) || !ContractChain(cell)) return false;
    for (std::size_t i = 0; i < cell.boxes.size(); ++i) {
      const bool left = two_modes_ && pass % 2 == 1 ? ContractSliced(i, cell.boxes[i])
                                                    : ContractExperiment(i, cell.boxes[i]);
      if (!left || !ContractSlabs(targets_[i], cell.boxes[i])) return false;
    }
    const double after = size();
    if (pass >= 1 && !(after < before * (1.0 - kProgress))) break;
    before = after;
  }
  return ContractShared(cell) && ContractWindow(cell) && ContractChain(cell);
}

}  // namespace howl
