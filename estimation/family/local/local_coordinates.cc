#include "estimation/family/local/local_coordinates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "estimation/analysis/loop/closed_form.h"
#include "estimation/family/problem/transfer_limit.h"
#include "model/numerics/constants.h"
#include "model/numerics/units.h"

namespace howl {

namespace {

bool IsSupported(const LocalCoordinates& c) {
  const FamilyProblem& p = c.problem;
  for (const ParameterKind kind :
       {ParameterKind::kOmega, ParameterKind::kXi, ParameterKind::kN, ParameterKind::kTau}) {
    if (kind != ParameterKind::kTau && p.IsShared(kind) && p.experiments.size() > 1) return false;
    for (std::size_t i = 0; i < p.experiments.size(); ++i) {
      const Range range = p.RangeOf(kind, i);
      if (!(range.lo < range.hi)) return false;
    }
  }
  if (!(c.ln_spread > 0.0)) return false;
  if (c.two_modes) {
    const Range range = p.RangeOf(c.SecondKind());
    if (!(range.lo < range.hi) && !c.shared_second) return false;
  }
  return std::none_of(c.targets.begin(), c.targets.end(),
                      [](const ExperimentTarget& target) { return target.IsEmpty(); });
}

// The range of ln M or ln (M / N). Without bounds of the user's it goes beyond anything that the
// gain allows, in units of 2 pi f |G| for M, which is the order of N.
Range SecondBox(const LocalCoordinates& c) {
  double unit = 1.0;
  if (!c.relative) unit = c.targets[0].w_rad_s * c.problem.experiments[0].gain;
  Range second{std::log(1e-16 * unit), std::log(1e11 * unit)};
  if (c.two_modes) {
    const Range range = c.problem.RangeOf(c.SecondKind());
    if (range.lo > 0.0) second.lo = std::log(range.lo);
    if (std::isfinite(range.hi)) second.hi = std::log(range.hi);
  }
  return second;
}

LocalScale MakeScale(const LocalCoordinates& c, std::size_t i, const Range& second) {
  const MembershipTest& test = c.problem.test;
  const Range xi = c.problem.RangeOf(ParameterKind::kXi, i);
  const Experiment& e = c.problem.experiments[i];
  const ExperimentTarget& target = c.targets[i];
  LocalScale scale{};
  scale.phase_0 = WrapDeg(e.phase_deg) * kRadPerDeg;
  scale.has_phase = test.phase_tolerance_deg < 180.0;
  scale.phase = scale.has_phase ? test.phase_tolerance_deg * kRadPerDeg * (1 - kLocalMargin) : 1.0;
  scale.gain_0 = e.gain;
  scale.has_gain = test.gain_tolerance < 5e3;
  scale.gain = e.gain * (scale.has_gain ? test.gain_tolerance * (1 - kLocalMargin) : 1.0);
  scale.has_loop_phase = test.loop_phase_tolerance_deg < 180.0;
  scale.loop_phase =
      scale.has_loop_phase ? test.loop_phase_tolerance_deg * kRadPerDeg * (1 - kLocalMargin) : 1.0;
  scale.transfer_limit = TransferLimit(e, test, c.two_modes) * (1 - kLocalMargin);
  constexpr double kQuarter = std::numbers::pi / 2 * (1 - 1e-9);
  scale.box[kLocalXi] = {std::log(std::max(xi.lo, kLocalLeastXi)),
                         std::log(std::min(xi.hi, kLocalLargestXi))};
  scale.box[kLocalPhase] = {(-kQuarter - scale.phase_0) / scale.phase,
                            (kQuarter - scale.phase_0) / scale.phase};
  scale.box[kLocalGain] = {(1e-4 * e.gain - e.gain) / scale.gain, 1e4 * e.gain / scale.gain};
  if (target.gain.lo > e.gain * (1.0 - test.gain_tolerance)) {  // by the least loop gain
    scale.box[kLocalGain].lo = (target.gain.lo * (1 + kLocalMargin) - e.gain) / scale.gain;
  }
  scale.box[kLocalDelay] = {-std::numbers::pi / scale.loop_phase,
                            std::numbers::pi / scale.loop_phase};
  scale.box[kLocalSecond] =
      c.shared_second ? second
                      : Range{std::log(0.02 * e.frequency_hz), std::log(50 * e.frequency_hz)};
  return scale;
}

// A tolerance of zero, or a fixed xi, leaves a coordinate no room.
bool HasRoom(const LocalScale& scale) {
  return scale.box[kLocalXi].lo < scale.box[kLocalXi].hi && scale.phase > 0.0 && scale.gain > 0.0 &&
         scale.loop_phase > 0.0 && scale.box[kLocalDelay].lo < scale.box[kLocalDelay].hi;
}

// One coordinate for all experiments: from where the first of their loop phase errors is half a
// turn to where the last is. Its unit moves the loop phase by about its tolerance.
void ShareTheDelay(LocalCoordinates& c) {
  const double n = static_cast<double>(c.targets.size());
  Range tau_s{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < c.targets.size(); ++i) {
    const double w = c.targets[i].w_rad_s;
    const double middle = TauFromPhase(c.targets[i].frequency_hz, c.scales[i].phase_0, 0.0,
                                       c.problem.domain.delay_periods);
    tau_s = {std::max(tau_s.lo, middle - kPi / w), std::min(tau_s.hi, middle + kPi / w)};
    c.tau_0_s += middle / n;
    c.tau_scale_s += c.scales[i].loop_phase / w / n;
  }
  for (LocalScale& scale : c.scales) {
    scale.box[kLocalDelay] = {(tau_s.lo - c.tau_0_s) / c.tau_scale_s,
                              (tau_s.hi - c.tau_0_s) / c.tau_scale_s};
  }
}

}  // namespace

LocalCoordinates MakeLocalCoordinates(const FamilyProblem& problem) {
  LocalCoordinates c;
  c.problem = problem;
  c.targets = MakeTargets(problem, 0.0);
  c.two_modes = problem.model.modes == 2;
  c.relative = problem.model.second_mode_relative;
  c.shared_second = c.two_modes && problem.IsShared(c.SecondKind());
  c.ratio = problem.model.harmonic_ratio;
  c.ln_spread = std::log1p(problem.test.omega_spread_max * (1.0 - kLocalMargin));
  c.supported = IsSupported(c);
  if (!c.supported) return c;
  c.shared_tau = c.targets.size() > 1 && problem.IsShared(ParameterKind::kTau);
  const Range second = SecondBox(c);
  const int shared = c.shared_second && second.lo < second.hi ? c.size++ : -1;
  const int delay = c.shared_tau ? c.size++ : -1;
  for (std::size_t i = 0; i < c.targets.size(); ++i) c.scales.push_back(MakeScale(c, i, second));
  if (c.shared_tau) ShareTheDelay(c);
  for (std::size_t i = 0; i < c.targets.size(); ++i) {
    if (!HasRoom(c.scales[i])) c.supported = false;
    std::array<int, kLocals> index{};
    for (std::size_t k = kLocalXi; k < kLocalDelay; ++k) index[k] = c.size++;
    index[kLocalDelay] = c.shared_tau ? delay : c.size++;
    index[kLocalSecond] = c.shared_second ? shared : (c.two_modes ? c.size++ : -1);
    c.index.push_back(index);
  }
  return c;
}

}  // namespace howl
