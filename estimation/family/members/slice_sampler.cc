#include "estimation/family/members/slice_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace howl {

SliceSampler::SliceSampler(const SampleChart& chart, const std::vector<SampleState>& states)
    : chart_(chart) {
  for (double SampleState::*const member : {&SampleState::xi, &SampleState::second, &SampleState::N,
                                            &SampleState::tau_s, &SampleState::omega_hz}) {
    double lo = std::numeric_limits<double>::infinity();
    double hi = 0.0;
    for (const SampleState& state : states) {
      lo = std::min(lo, state.*member);
      hi = std::max(hi, state.*member);
    }
    widths_.*member = std::max(hi - lo, 1e-3 * hi);
  }
}

void SliceSampler::Sweep(UnitRandom& random, SampleState& state) const {
  const std::size_t n = state.places.size();
  // omega of the places before, which are new, and of those behind, which are not yet.
  thread_local std::vector<Range> behind;
  behind.assign(n + 1, SampleChart::Others().omega_hz);
  for (std::size_t i = n; i-- > 0;) {
    behind[i] = behind[i + 1];
    SampleChart::Widen(behind[i], state.places[i].omega_hz);
  }
  Range before = SampleChart::Others().omega_hz;
  for (std::size_t i = 0; i < n; ++i) {
    const SampleChart::Others others{
        {std::min(before.lo, behind[i + 1].lo), std::max(before.hi, behind[i + 1].hi)},
        chart_.BetweenLinks(state, i)};
    const ExperimentTarget& target = at_.targets[i];
    if (!at_.shared_xi) {
      SlicePlace(
          random, state, i, others, chart_.XiRange(others, i),
          [](SamplePlace& p, double v) { p.xi = v; }, state.places[i].xi);
    }
    if (!at_.shared_omega || (at_.two_modes && !at_.shared_second)) {
      SlicePlace(
          random, state, i, others, target.phase_rad, [](SamplePlace& p, double v) { p.phase = v; },
          state.places[i].phase);
    }
    if (!at_.shared_N && !chart_.FreeGain()) {
      SlicePlace(
          random, state, i, others, target.gain, [](SamplePlace& p, double v) { p.gain = v; },
          state.places[i].gain);
    }
    if (!at_.shared_tau && !chart_.FreeLoopPhase()) {
      SlicePlace(
          random, state, i, others, target.loop_phase_error_rad,
          [](SamplePlace& p, double v) { p.loop_phase = v; }, state.places[i].loop_phase);
    }
    if (at_.two_modes && !at_.shared_second && !at_.shared_omega) {
      SlicePlace(
          random, state, i, others, chart_.OmegaRange(state, i),
          [](SamplePlace& p, double v) { p.omega_hz = v; }, state.places[i].omega_hz);
    }
    if (chart_.NeedsRoot()) SwitchBranch(random, state, i, others);
    SampleChart::Widen(before, state.places[i].omega_hz);
  }
  if (at_.shared_xi) SliceGlobal(random, state, &SampleState::xi);
  if (at_.shared_second) SliceGlobal(random, state, &SampleState::second);
  if (at_.shared_N) SliceGlobal(random, state, &SampleState::N);
  if (at_.shared_tau) SliceGlobal(random, state, &SampleState::tau_s);
  if (at_.shared_omega) SliceGlobal(random, state, &SampleState::omega_hz);
}

template <typename Set>
void SliceSampler::SlicePlace(UnitRandom& random, SampleState& state, std::size_t i,
                              const SampleChart::Others& others, Range range, const Set& set,
                              double current) const {
  if (!(range.lo < range.hi)) return;
  const SamplePlace before = state.places[i];
  const double level = before.log_density - random.Exponential();
  for (int shrink = 0; shrink < 60; ++shrink) {
    const double value = random.Uniform(range);
    SamplePlace& place = state.places[i];
    place = before;
    set(place, value);
    if (chart_.Build(i, state, place) && place.log_density >= level &&
        chart_.Couples(place, others))
      return;
    (value < current ? range.lo : range.hi) = value;
  }
  state.places[i] = before;
}

void SliceSampler::SliceGlobal(UnitRandom& random, SampleState& state,
                               double SampleState::*member) const {
  thread_local SampleState before;
  before = state;
  const auto density = [](const SampleState& s) {
    double sum = 0.0;
    for (const SamplePlace& place : s.places) sum += place.log_density;
    return sum;
  };
  const double level = density(before) - random.Exponential();
  const double current = before.*member;
  Range open{current - random.Uniform() * widths_.*member, 0.0};
  open.hi = open.lo + widths_.*member;
  for (int shrink = 0; shrink < 60; ++shrink) {
    const double value = random.Uniform(open);
    state.*member = value;
    bool built = value > 0.0 && (member != &SampleState::xi || at_.xi.Contains(value));
    for (std::size_t i = 0; built && i < state.places.size(); ++i) {
      state.places[i] = before.places[i];
      built = chart_.Build(i, state, state.places[i]);
    }
    if (built && chart_.Couples(state) && density(state) >= level) return;
    (value < current ? open.lo : open.hi) = value;
  }
  state = before;
}

void SliceSampler::SwitchBranch(UnitRandom& random, SampleState& state, std::size_t i,
                                const SampleChart::Others& others) const {
  const SamplePlace before = state.places[i];
  const int branch = static_cast<int>(random.Index(SampleChart::kMaxRoots));
  if (branch == before.branch) return;
  SamplePlace& place = state.places[i];
  place.branch = branch;
  if (chart_.Build(i, state, place) && chart_.Couples(place, others) &&
      std::log(random.Uniform()) <= place.log_density - before.log_density) {
    return;
  }
  state.places[i] = before;
}

}  // namespace howl
