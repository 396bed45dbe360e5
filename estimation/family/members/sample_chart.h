// The sampler's coordinates: phase, gain and loop phase error in the place of omega, N and tau, in
// which the test's conditions are bounds, and the density of the natural parameters in them
// (closed_form.h, two_mode_solve.h).
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_SAMPLE_CHART_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_SAMPLE_CHART_H_

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "estimation/family/members/drawer/chain.h"
#include "estimation/family/problem/member_chart.h"
#include "estimation/family/problem/problem.h"
#include "estimation/family/problem/random.h"

namespace howl {

// One experiment in the sampler's coordinates and in natural ones.
struct SamplePlace {
  double xi = 0.0;
  double phase = 0.0;
  double gain = 0.0;
  double loop_phase = 0.0;
  double omega_hz = 0.0;
  double N = 0.0;
  double M = 0.0;
  double log_density = 0.0;
  int branch = 0;  // which root of the two-mode equation, from the largest
};

struct SampleState {
  std::vector<SamplePlace> places;
  double second = 0.0;  // shared M or M / N
  double N = 0.0;       // shared N
  double tau_s = 0.0;   // shared tau
  double omega_hz = 0.0;
  double xi = 0.0;
};

class SampleChart {
 public:
  static constexpr int kMaxRoots = 4;  // of the two-mode equation

  explicit SampleChart(const FamilyProblem& problem);
  bool IsSupported() const { return !(two_modes_ && shared_N_ && !shared_second_); }
  bool TwoModes() const { return two_modes_; }
  bool FromMember(const Member& member, SampleState& state) const;
  void ToMember(const SampleState& state, UnitRandom& random, Member& member) const;

  // The ranges that the other experiments leave to one: the ends of omega over them, and the range
  // of xi between the next links of the chain, which keep to those beyond already.
  struct Others {
    Range omega_hz{std::numeric_limits<double>::infinity(), 0.0};
    Range xi{kNever, -kNever};
  };

  static void Widen(Range& ends, double value) {
    ends = {std::min(ends.lo, value), std::max(ends.hi, value)};
  }
  Range BetweenLinks(const SampleState& state, std::size_t i) const;
  Range XiRange(const Others& others, std::size_t i) const;
  Range OmegaRange(const SampleState& state, std::size_t i) const;
  // Natural parameters and density from the coordinates; false where there is no member.
  bool Build(std::size_t i, const SampleState& state, SamplePlace& place) const;
  // Window of omega and chain of xi, where one place alone is new.
  bool Couples(const SamplePlace& place, const Others& others) const;
  bool Couples(const SampleState& state) const;
  // Gain and loop phase error that nothing else depends on are drawn afresh for each member.
  bool FreeGain() const { return free_gain_; }
  bool FreeLoopPhase() const { return free_loop_phase_; }
  bool NeedsRoot() const { return two_modes_ && shared_second_ && !shared_omega_; }

  const MemberChart& chart() const { return chart_; }

 private:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();

  Range Narrowest(ParameterKind kind) const;
  const Range& RangeOf(ParameterKind kind, std::size_t i) const {
    return ranges_[i][static_cast<std::size_t>(kind)];
  }
  int Roots(std::size_t i, const SamplePlace& place, const SampleState& state,
            std::array<double, kMaxRoots>& roots) const;
  // ln |d (free natural parameters) / d (coordinates)|, up to a constant.
  double LogJacobian(const SamplePlace& place, const Complex<double>& first,
                     const Complex<double>& other, const Complex<double>& z, double omega,
                     double w) const;
  bool InDomain(std::size_t i, const SampleState& state, const SamplePlace& place) const;
  bool InWindow(const Range& omega_hz) const { return omega_hz.hi <= omega_hz.lo * factor_; }

  const FamilyProblem& problem_;
  std::vector<std::array<Range, kNumParameterKinds>> ranges_;  // of each experiment
  MemberChart chart_;
  const std::vector<ExperimentTarget>& targets_ = chart_.targets;
  const ParameterKind second_kind_ = chart_.second_kind;
  const bool two_modes_ = chart_.two_modes, relative_ = chart_.relative,
             shared_omega_ = chart_.shared_omega, shared_xi_ = chart_.shared_xi,
             shared_N_ = chart_.shared_N, shared_tau_ = chart_.shared_tau,
             shared_second_ = chart_.shared_second;
  const double ratio_ = chart_.ratio;
  const Range xi_ = chart_.xi;
  std::vector<double> transfer_limits_;
  XiChain chain_;
  bool has_lines_;
  bool free_gain_, free_loop_phase_;
  double factor_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_SAMPLE_CHART_H_
