#include "estimation/family/bounds/inside.h"

#include <algorithm>

#include "estimation/family/bounds/contract/contract.h"
#include "estimation/family/bounds/contract/interval.h"
#include "estimation/family/bounds/contract/second_mode_bound.h"
#include "model/loop/loop.h"

namespace howl {

namespace {

// For the rounding of the test itself, which is evaluated in doubles.
constexpr double kSlack = 1e-13;

// The verdict of the conditions on a box.
struct Verdict {
  bool all = true;    // every point passes
  bool none = false;  // no point passes
  void At(const Interval& value, double lo, double hi) {
    // Written so that a NaN proves nothing.
    if (!(value.lower() >= lo + kSlack && value.upper() <= hi - kSlack)) all = false;
    if (value.upper() < lo - kSlack || value.lower() > hi + kSlack) none = true;
  }
};

Interval Of(const Range& range) { return {range.lo, range.hi}; }

// |arg z| <= tolerance, by rotation: no angle of an interval is taken.
void TestAngle(const Complex<Interval>& z, double tolerance_deg, Verdict& verdict) {
  if (tolerance_deg >= 180.0) return;
  const double tolerance = tolerance_deg * kRadPerDeg;
  if (tolerance >= 1.5) {  // obtuse: proved only where both parts decide
    verdict.all &= z.re.lower() > 0.0;
    return;
  }
  const Interval slack = Interval(std::tan(tolerance)) * Interval(1.0 - 1e-13, 1.0 + 1e-13);
  verdict.At(z.re, 0.0, kUnbounded);
  if (z.re.lower() > 0.0) verdict.At(z.im / z.re, -slack.lower(), slack.lower());
  if (z.re.lower() <= 0.0) verdict.all = false;
}

// e^(-j 2 pi f tau), widened: the library's sine and cosine are good to an ulp or two.
Complex<Interval> Delayed(const Interval& tau, double frequency_hz) {
  const Interval angle =
      Interval(Below(kRadPerSPerHz), Above(kRadPerSPerHz)) * Interval(frequency_hz) * tau;
  if (!(Width(angle) < 1.0)) return {{-1.0, 1.0}, {-1.0, 1.0}};
  // Around the middle: |cos(a + d) - cos(a)| <= |d|, the same for the sine.
  const double middle = 0.5 * (angle.lower() + angle.upper());
  const double reach = Above(0.5 * Width(angle)) + 1e-14;
  const Interval spread(-reach, reach);
  return {Interval(std::cos(middle)) + spread, -(Interval(std::sin(middle)) + spread)};
}

void TestExperiment(const Experiment& experiment, const ModelBox& box, double harmonic_ratio,
                    const MembershipTest& test, Verdict& verdict) {
  const Interval two_pi(Below(kRadPerSPerHz), Above(kRadPerSPerHz));
  const auto response = [&](double frequency_hz) {
    const Acoustics<Interval> acoustics{Of(box.omega_hz), Of(box.xi), Of(box.N), Of(box.M),
                                        Interval(harmonic_ratio)};
    return AcousticResponse(acoustics, Interval(frequency_hz));
  };
  const Complex<Interval> z = response(experiment.frequency_hz);
  const Interval gain = sqrt(square(z.re) + square(z.im));
  verdict.At(gain / Interval(experiment.gain) - 1.0, -test.gain_tolerance, test.gain_tolerance);
  const double phase = experiment.phase_deg * kRadPerDeg;
  const Interval ulps(-1e-15, 1e-15);
  const Complex<Interval> back{Interval(std::cos(phase)) + ulps, -Interval(std::sin(phase)) + ulps};
  TestAngle(z * back, test.phase_tolerance_deg, verdict);
  const auto minus_loop = [&](const Complex<Interval>& response_at, double frequency_hz) {
    const Complex<Interval> l = response_at * Delayed(Of(box.tau_s), frequency_hz);
    return Complex<Interval>{l.im, -l.re};  // -j l, up to the positive 2 pi f
  };
  TestAngle(minus_loop(z, experiment.frequency_hz), test.loop_phase_tolerance_deg, verdict);
  if (experiment.reliable && experiment.flame_slope) {
    verdict.At(
        gain * two_pi * Interval(experiment.frequency_hz) * Interval(experiment.SteepestSlope()),
        test.loop_gain_min, kUnbounded);
  }
  if (box.M.hi > 0.0) {
    for (const ObservedLine& line : experiment.lines) {
      TestAngle(minus_loop(response(line.frequency_hz), line.frequency_hz),
                test.second_crossing_tolerance_deg, verdict);
      if (!TestsLineGain(experiment, test)) continue;
      const Complex<Interval> at_line = response(line.frequency_hz);
      verdict.At(sqrt(square(at_line.re) + square(at_line.im)) * two_pi *
                     Interval(line.frequency_hz) * Interval(experiment.SteepestSlope()),
                 test.second_crossing_gain_min, kUnbounded);
    }
    verdict.At(SecondModeShareOf(Of(box.omega_hz), Of(box.xi), Of(box.M) / Of(box.N),
                                 Interval(harmonic_ratio), Interval(experiment.frequency_hz)),
               -kUnbounded, test.second_mode_share_max);
  }
  verdict.At(Of(box.xi), 0.0, test.xi_max);
  if (experiment.transfer_ellipsoid && std::isfinite(test.transfer_distance_max)) {
    const bool second_mode = box.M.hi > 0.0;
    bool always = false;
    const TransferBound bound =
        MakeTransferBound(*experiment.transfer_ellipsoid, second_mode, test.transfer_distance_max);
    if (!TransferMayHold(bound, {Of(box.omega_hz), Of(box.xi), Of(box.N), Of(box.M)}, &always)) {
      verdict.none = true;
    }
    verdict.all &= always;
  }
}

}  // namespace

BoxVerdict TestBox(const FamilyProblem& problem, const std::vector<ModelBox>& box) {
  const RoundingGuard guard;
  Verdict verdict;
  Range omega_lo{kUnbounded, kUnbounded};  // of the smallest omega
  Range omega_hi{0.0, 0.0};                // of the largest
  for (std::size_t i = 0; i < box.size(); ++i) {
    TestExperiment(problem.experiments[i], box[i], problem.model.harmonic_ratio, problem.test,
                   verdict);
    omega_lo = {std::min(omega_lo.lo, box[i].omega_hz.lo),
                std::min(omega_lo.hi, box[i].omega_hz.hi)};
    omega_hi = {std::max(omega_hi.lo, box[i].omega_hz.lo),
                std::max(omega_hi.hi, box[i].omega_hz.hi)};
    for (std::size_t j = 0; problem.test.xi_increasing && j < box.size(); ++j) {
      if (!(problem.experiments[j].phi < problem.experiments[i].phi)) continue;
      if (box[j].xi.hi > box[i].xi.lo) verdict.all = false;
      if (box[j].xi.lo > box[i].xi.hi) verdict.none = true;
    }
  }
  verdict.At(Of(omega_hi) / Of(omega_lo) - 1.0, -kUnbounded, problem.test.omega_spread_max);
  if (verdict.none) return BoxVerdict::kOutside;
  return verdict.all ? BoxVerdict::kInside : BoxVerdict::kUnknown;
}

std::vector<ModelBox> GrowInside(const FamilyProblem& problem, const Member& member,
                                 double smallest) {
  const auto around = [&](double side) {
    std::vector<ModelBox> box;
    for (const LoopModel& model : member) {
      const auto range = [&](double value) {
        return Range{value * (1.0 - side), value * (1.0 + side)};
      };
      box.push_back({range(model.omega_hz), range(model.xi), range(model.N),
                     model.M > 0.0 ? range(model.M) : Range{0.0, 0.0}, range(model.tau_s)});
    }
    return box;
  };
  std::vector<ModelBox> best;
  for (double side = 0.1; side >= smallest; side *= 0.7) {
    std::vector<ModelBox> box = around(side);
    if (TestBox(problem, box) == BoxVerdict::kInside) return box;
  }
  return best;
}

}  // namespace howl
