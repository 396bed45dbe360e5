#include "estimation/family/members/sample_chart.h"

#include <cmath>

#include "estimation/family/problem/transfer_limit.h"

namespace howl {
namespace {

constexpr int kRootCells = 24;

}  // namespace

SampleChart::SampleChart(const FamilyProblem& problem)
    : problem_(problem), chart_(problem), chain_(targets_, problem.test.xi_increasing) {
  has_lines_ = two_modes_ && problem.test.second_crossing_tolerance_deg < 180.0 &&
               std::any_of(problem.experiments.begin(), problem.experiments.end(),
                           [](const Experiment& e) { return !e.lines.empty(); });
  for (const Experiment& experiment : problem.experiments) {
    // Members keep the limit on the deviation as it is stated, whatever rounds on the way.
    transfer_limits_.push_back((1.0 - 1e-12) * TransferLimit(experiment, problem.test, two_modes_));
  }
  for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
    std::array<Range, kNumParameterKinds>& own = ranges_.emplace_back();
    for (const ParameterKind kind : kParameterKinds) {
      own[static_cast<std::size_t>(kind)] = problem.RangeOf(kind, i);
    }
  }
  factor_ = 1.0 + problem.test.omega_spread_max * (1.0 - 1e-12);
  const Range N = Narrowest(ParameterKind::kN);
  free_gain_ =
      !two_modes_ && !shared_N_ && N.lo <= 0.0 && !std::isfinite(N.hi) && !problem_.HasTransfer();
  const Range tau = Narrowest(ParameterKind::kTau);
  free_loop_phase_ = !has_lines_ && !shared_tau_ && tau.lo <= 0.0 && !std::isfinite(tau.hi);
}

bool SampleChart::FromMember(const Member& member, SampleState& state) const {
  state.places.resize(member.size());
  state.second = relative_ ? member[0].M / member[0].N : member[0].M;
  state.N = member[0].N;
  state.tau_s = member[0].tau_s;
  state.omega_hz = member[0].omega_hz;
  state.xi = member[0].xi;
  for (std::size_t i = 0; i < member.size(); ++i) {
    const LoopModel& model = member[i];
    const Experiment& experiment = problem_.experiments[i];
    const ExperimentErrors errors = ComputeErrors(experiment, model);
    SamplePlace& place = state.places[i];
    place.xi = model.xi;
    place.phase = (WrapDeg(experiment.phase_deg) + errors.phase_error_deg) * kRadPerDeg;
    place.gain = experiment.gain * (1.0 + errors.gain_error);
    place.loop_phase = errors.loop_phase_error_deg * kRadPerDeg;
    place.omega_hz = model.omega_hz;
    if (NeedsRoot()) {
      std::array<double, kMaxRoots> roots{};
      const int count = Roots(i, place, state, roots);
      double nearest = 1e-6 * model.omega_hz;
      int branch = -1;
      for (int k = 0; k < count; ++k) {
        const double distance = std::abs(roots[static_cast<std::size_t>(k)] - model.omega_hz);
        if (distance < nearest) nearest = distance, branch = count - 1 - k;
      }
      if (branch < 0) return false;
      place.branch = branch;
    }
    if (!Build(i, state, place)) return false;
  }
  return Couples(state);
}

void SampleChart::ToMember(const SampleState& state, UnitRandom& random, Member& member) const {
  member.resize(state.places.size());
  for (std::size_t i = 0; i < member.size(); ++i) {
    const SamplePlace& place = state.places[i];
    double gain_factor = 1.0;
    if (FreeGain()) gain_factor = random.Uniform(targets_[i].gain) / place.gain;
    const double loop_phase =
        FreeLoopPhase() ? random.Uniform(targets_[i].loop_phase_error_rad) : place.loop_phase;
    member[i] = {place.omega_hz,
                 place.xi,
                 place.N * gain_factor,
                 place.M,
                 shared_tau_ ? state.tau_s : chart_.Tau(targets_[i], place.phase, loop_phase),
                 ratio_};
  }
}

Range SampleChart::Narrowest(ParameterKind kind) const {
  Range range;
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    range.lo = std::max(range.lo, RangeOf(kind, i).lo);
    range.hi = std::min(range.hi, RangeOf(kind, i).hi);
  }
  return range;
}

Range SampleChart::BetweenLinks(const SampleState& state, std::size_t i) const {
  Range range{kNever, -kNever};
  if (!chain_.IsIncreasing()) return range;
  const std::size_t link = chain_.LinkOf(i);
  if (link > 0) {
    for (const std::size_t j : chain_.Experiments(link - 1)) {
      range.lo = std::max(range.lo, state.places[j].xi);
    }
  }
  if (link + 1 < chain_.Links()) {
    for (const std::size_t j : chain_.Experiments(link + 1)) {
      range.hi = std::min(range.hi, state.places[j].xi);
    }
  }
  return range;
}

Range SampleChart::XiRange(const Others& others, std::size_t i) const {
  const Range& own = RangeOf(ParameterKind::kXi, i);
  return {std::max({xi_.lo, own.lo, others.xi.lo}), std::min({xi_.hi, own.hi, others.xi.hi})};
}

Range SampleChart::OmegaRange(const SampleState& state, std::size_t i) const {
  const SamplePlace& place = state.places[i];
  const double top = MemberChart::TopOmega(targets_[i], place.xi, place.phase);
  return {top / ratio_, top};
}

int SampleChart::Roots(std::size_t i, const SamplePlace& place, const SampleState& state,
                       std::array<double, kMaxRoots>& roots) const {
  const TwoModeEquation equation =
      chart_.Equation(targets_[i], place.xi, place.phase, place.gain, state.second, state.N);
  const double top = MemberChart::TopOmega(targets_[i], place.xi, place.phase);
  return FindRoots<kMaxRoots>(equation, top / ratio_, top, kRootCells, roots);
}

bool SampleChart::Build(std::size_t i, const SampleState& state, SamplePlace& place) const {
  const ExperimentTarget& target = targets_[i];
  if (shared_xi_) place.xi = state.xi;
  if (shared_omega_) place.omega_hz = state.omega_hz;
  const double w = target.w_rad_s;
  if (!two_modes_ && !shared_omega_) {
    place.omega_hz = MemberChart::TopOmega(target, place.xi, place.phase);
  } else if (NeedsRoot()) {
    std::array<double, kMaxRoots> roots{};
    const int count = Roots(i, place, state, roots);
    if (place.branch >= count) return false;
    place.omega_hz = roots[static_cast<std::size_t>(count - 1 - place.branch)];
  }
  const double omega = kRadPerSPerHz * place.omega_hz;
  const Complex<double> first = UnitModeResponse(omega, place.xi, w);
  const Complex<double> other =
      two_modes_ ? UnitModeResponse(ratio_ * omega, place.xi, w) : Complex<double>{0.0, 0.0};
  place.M = 0.0;
  const auto coefficients = [&] {
    return chart_.Coefficients(target, place.omega_hz, place.xi, place.phase, place.gain);
  };
  if (two_modes_ && !shared_second_) {
    const ModeCoefficients c = coefficients();
    if (!(c.N > 0.0) || !(c.M > 0.0)) return false;
    place.N = c.N;
    place.M = c.M;
  } else if (shared_N_) {
    place.N = state.N;
  } else if (two_modes_ && !relative_ && !shared_omega_) {
    place.N = coefficients().N;
  } else {
    const std::optional<double> n = chart_.NOfGain(first, other, place.gain, state.second);
    if (!n) return false;
    place.N = *n;
  }
  if (!(place.N > 0.0)) return false;
  if (two_modes_ && shared_second_) place.M = chart_.MOf(state.second, place.N);
  const Complex<double> z = place.N * first + place.M * other;
  // What the coordinates do not fix is derived, and must lie within its tolerance.
  if (shared_omega_ && !(two_modes_ && !shared_second_)) {
    place.phase = Angle(z);
    if (!target.phase_rad.Contains(place.phase)) return false;
  }
  if (shared_N_) {
    place.gain = Magnitude(z);
    if (!target.gain.Contains(place.gain)) return false;
  }
  if (shared_tau_) {
    place.loop_phase = chart_.LoopPhaseError(target, place.phase, state.tau_s);
    if (!target.loop_phase_error_rad.Contains(place.loop_phase)) return false;
  }
  place.log_density = LogJacobian(place, first, other, z, omega, w);
  return std::isfinite(place.log_density) && InDomain(i, state, place);
}

double SampleChart::LogJacobian(const SamplePlace& place, const Complex<double>& first,
                                const Complex<double>& other, const Complex<double>& z,
                                double omega, double w) const {
  if (two_modes_ && !shared_second_) {
    double log = std::log(place.gain / std::abs(first.re * other.im - first.im * other.re));
    if (relative_) log -= std::log(place.N);  // d(M / N) = dM / N at fixed N
    return log;
  }
  // d ln z / d omega and d ln z / d N; the real part is d ln |z|, the imaginary part d theta.
  const Complex<double> slope_1{2.0 * place.xi, -2.0 * omega / w};
  Complex<double> change = place.N * (first * first * slope_1);
  if (two_modes_) {
    const Complex<double> slope_r{2.0 * place.xi * ratio_, -2.0 * ratio_ * ratio_ * omega / w};
    change = change + place.M * (other * other * slope_r);
  }
  const Complex<double> a = change / z;
  const Complex<double> b =
      two_modes_ && !relative_ ? first / z : Complex<double>{1.0 / place.N, 0.0};
  if (shared_omega_) return shared_N_ ? 0.0 : -std::log(place.gain * std::abs(b.re));
  if (shared_N_) return -std::log(std::abs(a.im));
  return -std::log(place.gain * std::abs(a.re * b.im - a.im * b.re));
}

bool SampleChart::InDomain(std::size_t i, const SampleState& state,
                           const SamplePlace& place) const {
  if (!RangeOf(ParameterKind::kOmega, i).Contains(place.omega_hz)) return false;
  if (!RangeOf(ParameterKind::kN, i).Contains(place.N)) return false;
  if (two_modes_ && !RangeOf(second_kind_, i).Contains(relative_ ? place.M / place.N : place.M)) {
    return false;
  }
  const Experiment& experiment = problem_.experiments[i];
  if (std::isfinite(transfer_limits_[i])) {
    const LoopModel model{place.omega_hz, place.xi, place.N, place.M, 0.0, ratio_};
    if (!(MahalanobisDistance(*experiment.transfer_ellipsoid, model) <= transfer_limits_[i])) {
      return false;
    }
  }
  if (two_modes_) {
    const LoopModel model{place.omega_hz, place.xi, place.N, place.M, 0.0, ratio_};
    if (!KeepsSecondMode(experiment, model, problem_.test)) return false;
  }
  if (!has_lines_ && FreeLoopPhase()) return true;
  const double tau = shared_tau_ ? state.tau_s
                                 : TauFromPhase(targets_[i].frequency_hz, place.phase,
                                                place.loop_phase, problem_.domain.delay_periods);
  if (!RangeOf(ParameterKind::kTau, i).Contains(tau)) return false;
  if (!has_lines_) return true;
  const LoopModel model{place.omega_hz, place.xi, place.N, place.M, tau, ratio_};
  for (const ObservedLine& line : problem_.experiments[i].lines) {
    if (!(std::abs(LoopPhaseError(model.Loop(), line.frequency_hz)) * kDegPerRad <=
          problem_.test.second_crossing_tolerance_deg)) {
      return false;
    }
  }
  return true;
}

bool SampleChart::Couples(const SamplePlace& place, const Others& others) const {
  Range ends = others.omega_hz;
  Widen(ends, place.omega_hz);
  return InWindow(ends) && !(place.xi < others.xi.lo) && !(place.xi > others.xi.hi);
}

bool SampleChart::Couples(const SampleState& state) const {
  Range ends = Others().omega_hz;
  for (const SamplePlace& place : state.places) Widen(ends, place.omega_hz);
  double largest = kNever;  // xi of the links below
  for (std::size_t link = 0; chain_.IsIncreasing() && link < chain_.Links(); ++link) {
    double here = largest;
    for (const std::size_t i : chain_.Experiments(link)) {
      if (state.places[i].xi < largest) return false;
      here = std::max(here, state.places[i].xi);
    }
    largest = here;
  }
  return InWindow(ends);
}

}  // namespace howl
