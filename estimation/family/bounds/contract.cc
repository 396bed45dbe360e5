#include "estimation/family/bounds/contract.h"

#include <algorithm>
#include <numeric>

#include "estimation/family/bounds/carrying_mode_bound.h"
#include "estimation/family/bounds/centred_bound.h"
#include "estimation/family/bounds/second_mode_bound.h"
#include "estimation/family/problem/targets.h"
#include "model/numerics/complex.h"

namespace howl {

namespace {

constexpr int kPasses = 8;
constexpr double kProgress = 0.02;  // a pass that narrows less than this ends the contraction
constexpr int kSlices = 6;

Interval Widened(double lo, double hi) { return {Below(lo), Above(hi)}; }

// 1 / cos(theta) = sqrt(1 + t^2)
Interval Secant(const Interval& tangent) { return sqrt(1.0 + square(tangent)); }

// Both ends of y = a b with b >= 0.
bool NarrowProduct(Interval& product, Interval& a, Interval& b) {
  return Narrow(product, a * b) && Narrow(a, Quotient(product, b)) &&
         Narrow(b, Quotient(product, a));
}

// g = (4 z xi^2 + (1 - z)^2) / (1 + r z), z > 0: rises with xi, and is convex in z, as it is
// z / r + a + c / (1 + r z) with c = 1 + 2 b / r + 1 / r^2 > 0, b = 1 - 2 xi^2.
Interval ModeShape(const Interval& z, const Interval& xi, const Interval& r) {
  if (!std::isfinite(z.upper()) || !std::isfinite(xi.upper())) return {0.0, kUnbounded};
  const auto at = [&](double point, double damping) {
    const Interval x(point);
    return (4.0 * x * square(Interval(damping)) + square(1.0 - x)) / (1.0 + r * x);
  };
  const double hi = std::max(at(z.lower(), xi.upper()).upper(), at(z.upper(), xi.upper()).upper());
  const Interval b = 1.0 - 2.0 * square(Interval(xi.lower()));
  const Interval c = 1.0 + 2.0 * b / r + 1.0 / square(r);
  if (!(c.lower() > 0.0)) {  // strong damping: no use is made of convexity
    return Interval((4.0 * z * square(xi) + square(1.0 - z)) / (1.0 + r * z));
  }
  // Least near (1 + r z)^2 = r^2 c; the tangent there bounds a convex function from below.
  const double near = (std::sqrt(c.lower()) * r.lower() - 1.0) / r.lower();
  const double point = std::clamp(near, z.lower(), z.upper());
  const Interval slope = 1.0 / r - r * c / square(1.0 + r * Interval(point));
  const Interval tangent = at(point, xi.lower()) + slope * (z - Interval(point));
  return {std::max(tangent.lower(), 0.0), hi};
}

// F = (y / xi - t) g about the middle of the box (mean value form): its error falls with the square
// of the box, where the plain product's falls with the box alone. y' is negative; f is the
// frequency at which y vanishes, scale = z / (omega / f)^2.
Interval CentredProduct(const Interval& f, const Interval& scale, const Interval& ratio,
                        const ExperimentBox& box, const Interval& y, const Interval& g) {
  const Interval& omega = box[kCellOmega];
  const Interval& xi = box[kCellXi];
  const Interval& t = box[kCellTangent];
  if (!(xi.lower() > 0.0) || !std::isfinite(omega.upper())) return {-kUnbounded, kUnbounded};
  const auto middle = [](const Interval& x) { return Interval(0.5 * (x.lower() + x.upper())); };
  const Interval omega_m = middle(omega), xi_m = middle(xi), t_m = middle(t);
  const Interval z_m = scale * square(omega_m / f);
  const Interval g_m = (4.0 * z_m * square(xi_m) + square(1.0 - z_m)) / (1.0 + ratio * z_m);
  const Interval y_m = 0.5 * (f / omega_m - omega_m / f);
  const Interval z = scale * square(omega / f);
  const Interval h = y / xi - t;
  const Interval lift = 1.0 + ratio * z;
  const Interval b = 1.0 - 2.0 * square(xi);
  const Interval g_z =
      1.0 / ratio - ratio * (1.0 + 2.0 * b / ratio + 1.0 / square(ratio)) / square(lift);
  const Interval y_omega = -0.5 * (f / square(omega) + 1.0 / f);
  const Interval f_omega = y_omega / xi * g + h * g_z * (2.0 * scale * omega / square(f));
  const Interval f_xi = h * 8.0 * z * xi / lift - y / square(xi) * g;
  return (y_m / xi_m - t_m) * g_m + f_omega * (omega - omega_m) + f_xi * (xi - xi_m) -
         g * (t - t_m);
}

bool NarrowOmega(const ContractTarget& target, const Interval& detuning, ExperimentBox& box) {
  return Narrow(box[kCellOmega], OmegaOf(target.frequency_hz, detuning));
}

}  // namespace

bool ContractPhase(const ContractTarget& target, ExperimentBox& box) {
  Interval y = DetuningOf(target.frequency_hz, box[kCellOmega]);
  return NarrowProduct(y, box[kCellTangent], box[kCellXi]) && NarrowOmega(target, y, box);
}

bool ContractGain(const ContractTarget& target, ExperimentBox& box) {
  const Interval secant = Secant(box[kCellTangent]);
  // xi exp(-asinh(xi t)) rises with xi at every t.
  const auto shape = [&](double xi, const Interval& tangent) {
    const Interval x(xi);
    const Interval across = x * tangent;
    const auto at = [&](double v) {
      const Interval value(v);
      const Interval root = sqrt(1.0 + square(value));
      return v > 0.0 ? 1.0 / (root + value) : root - value;
    };
    return x * Interval(at(across.upper()).lower(), at(across.lower()).upper());
  };
  const Interval& xi = box[kCellXi];
  Interval product = box[kCellXi] * box[kCellOmega] * (target.w_rad_s / target.frequency_hz);
  if (std::isfinite(xi.upper())) {
    Narrow(product, target.w_rad_s * Interval(shape(xi.lower(), box[kCellTangent]).lower(),
                                              shape(xi.upper(), box[kCellTangent]).upper()));
  }
  Interval scale = 2.0 * product * secant;
  if (!NarrowProduct(box[kCellN], box[kCellGain], scale)) return false;
  // Backward to xi and omega, through N and the gain.
  const Interval rate = target.w_rad_s / target.frequency_hz;
  Interval mode = Quotient(Quotient(scale, 2.0 * secant), rate);
  return Narrow(box[kCellXi], Quotient(mode, box[kCellOmega])) &&
         Narrow(box[kCellOmega], Quotient(mode, box[kCellXi]));
}

bool ContractTwoModes(const ContractTarget& target, ExperimentBox& box) {
  const Interval& r = target.harmonic_ratio;
  Interval& omega = box[kCellOmega];
  Interval& xi = box[kCellXi];
  Interval& tangent = box[kCellTangent];
  Interval y = DetuningOf(target.frequency_hz, omega);
  Interval y_r = DetuningOf(target.frequency_hz / r, omega);
  // y_r <= xi t <= y, both modes' coefficients being positive.
  Interval across = xi * tangent;
  if (!NarrowLower(across, y_r.lower()) || !NarrowUpper(across, y.upper()) ||
      !NarrowLower(y, across.lower()) || !NarrowUpper(y_r, across.upper())) {
    return false;
  }
  // H_1 = t - y_r / xi >= 0,  H_r = y / xi - t >= 0
  Interval h_1 = tangent - Quotient(y_r, xi);
  Interval h_r = Quotient(y, xi) - tangent;
  if (!NarrowLower(h_1, 0.0) || !NarrowLower(h_r, 0.0)) return false;
  const Interval z = square(omega / target.frequency_hz);
  const Interval g_1 = ModeShape(z, xi, r);
  const Interval g_r = ModeShape(square(r) * z, xi, 1.0 / r);
  // N = r K H_1 g_1,  M = K H_r g_r,  K = w |G| cos(theta) / (r - 1)
  const Interval rate = target.w_rad_s / (Secant(tangent) * (r - 1.0));
  const Interval k = rate * box[kCellGain];
  Interval& n = box[kCellN];
  Interval& m = box[kCellM];
  Interval& relative = box[kCellRelative];
  Interval product_1 = h_1 * g_1;
  Interval product_r = h_r * g_r;
  const Interval f_r = target.frequency_hz / r;
  if (!Narrow(product_1, -CentredProduct(f_r, 1.0 / square(r), r, box, y_r, g_1)) ||
      !Narrow(product_r, CentredProduct(target.frequency_hz, square(r), 1.0 / r, box, y, g_r))) {
    return false;
  }
  if (!Narrow(n, r * k * product_1) || !Narrow(m, k * product_r) ||
      !Narrow(relative, Quotient(product_r, r * product_1)) || !Narrow(relative, Quotient(m, n)) ||
      !Narrow(m, relative * n) || !Narrow(n, Quotient(m, relative))) {
    return false;
  }
  if (!Narrow(h_1, Quotient(n, r * k * g_1)) || !Narrow(h_r, Quotient(m, k * g_r)) ||
      !Narrow(h_r, relative * r * h_1 * g_1 / g_r) ||
      !Narrow(h_1, Quotient(h_r * g_r, relative * r * g_1)) ||
      !Narrow(box[kCellGain], Quotient(n, r * rate * h_1 * g_1)) ||
      !Narrow(box[kCellGain], Quotient(m, rate * h_r * g_r))) {
    return false;
  }
  if (!Narrow(y, xi * (h_r + tangent)) || !Narrow(y_r, xi * (tangent - h_1)) ||
      !Narrow(tangent, Quotient(y, xi) - h_r) || !Narrow(tangent, Quotient(y_r, xi) + h_1) ||
      !Narrow(xi, Quotient(y, h_r + tangent)) || !Narrow(xi, Quotient(y_r, tangent - h_1))) {
    return false;
  }
  return Narrow(omega, OmegaOf(target.frequency_hz, y)) &&
         Narrow(omega, OmegaOf(target.frequency_hz / r, y_r));
}

bool ContractDelay(const ContractTarget& target, ExperimentBox& box) {
  Interval phase = -Arctangent(box[kCellTangent]);
  Interval turned = target.w_rad_s * box[kCellTau];
  if (!Narrow(turned, target.turns + phase - box[kCellLoopPhase]) ||
      !Narrow(box[kCellTau], turned / target.w_rad_s) ||
      !Narrow(phase, turned - target.turns + box[kCellLoopPhase]) ||
      !Narrow(box[kCellLoopPhase], target.turns + phase - turned)) {
    return false;
  }
  return Narrow(box[kCellTangent], Tangent(-phase));
}

bool ContractLines(const ContractTarget& target, ExperimentBox& box) {
  if (!target.has_line_error) return true;
  for (const Interval& line : target.lines_hz) {
    const Interval w = target.w_rad_s / target.frequency_hz * line;
    const Interval rate = target.w_rad_s / target.frequency_hz;
    // The direction of G at the line, of U_1 + (M / N) U_r; a positive factor changes nothing.
    const auto mode = [&](const Interval& omega_hz) {
      const Interval omega = rate * omega_hz;
      const Complex<Interval> d{2.0 * omega * box[kCellXi], w - square(omega) / w};
      const Interval size = square(d.re) + square(d.im);
      return Complex<Interval>{Quotient(d.re, size), -Quotient(d.im, size)};
    };
    const Complex<Interval> first = mode(box[kCellOmega]);
    const Complex<Interval> other = mode(target.harmonic_ratio * box[kCellOmega]);
    const Interval& m = box[kCellRelative];
    Interval re = first.re;
    Interval im = first.im;
    if (m.upper() < kUnbounded) {
      re = first.re + m * other.re;
      im = first.im + m * other.im;
    } else {
      continue;
    }
    // Both modes are dissipative: re > 0.
    if (!NarrowLower(re, 0.0)) return false;
    if (!(re.lower() > 0.0) || !std::isfinite(re.upper())) continue;
    const Interval angle = Arctangent(Quotient(im, re));
    // w tau = angle - pi / 2 - error + 2 pi k
    constexpr double kPi = 3.14159265358979323846;
    const Interval turned = angle - Widened(kPi / 2, kPi / 2) - target.line_error_rad;
    const Interval full_turn = Widened(2 * kPi, 2 * kPi);
    const Interval k_range = (w * box[kCellTau] - turned) / full_turn;
    if (Width(k_range) > 8.0 || !std::isfinite(k_range.upper())) continue;
    double lo = kUnbounded;
    double hi = -kUnbounded;
    for (double k = std::ceil(k_range.lower()); k <= k_range.upper(); k += 1.0) {
      Interval tau = box[kCellTau];
      if (!Narrow(tau, (turned + full_turn * k) / w)) continue;
      lo = std::min(lo, tau.lower());
      hi = std::max(hi, tau.upper());
    }
    if (!(lo <= hi) || !Narrow(box[kCellTau], Interval(lo, hi))) return false;
  }
  return true;
}

namespace {

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
  constexpr double kPi = 3.14159265358979323846;
  const Interval pi = Widened(kPi, kPi);
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
