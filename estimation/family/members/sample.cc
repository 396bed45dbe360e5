#include "estimation/family/members/sample.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "estimation/family/members/chain.h"
#include "estimation/family/members/convergence.h"
#include "estimation/family/members/enumerate.h"
#include "estimation/family/members/transfer_starts.h"
#include "estimation/family/problem/member_chart.h"
#include "estimation/family/problem/transfer_limit.h"
#include "estimation/parallel.h"

namespace howl {

namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();
constexpr int kMaxRoots = 4;
constexpr int kRootCells = 24;

// One experiment in the sampler's coordinates and in natural ones.
struct Place {
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

struct State {
  std::vector<Place> places;
  double second = 0.0;  // shared M or M / N
  double N = 0.0;       // shared N
  double tau_s = 0.0;   // shared tau
  double omega_hz = 0.0;
  double xi = 0.0;
};

class Chart {
 public:
  explicit Chart(const FamilyProblem& problem)
      : problem_(problem), chart_(problem), chain_(targets_, problem.test.xi_increasing) {
    has_lines_ = two_modes_ && problem.test.second_crossing_tolerance_deg < 180.0 &&
                 std::any_of(problem.experiments.begin(), problem.experiments.end(),
                             [](const Experiment& e) { return !e.lines.empty(); });
    for (const Experiment& experiment : problem.experiments) {
      // Members keep the limit on the deviation as it is stated, whatever rounds on the way.
      transfer_limits_.push_back((1.0 - 1e-12) *
                                 TransferLimit(experiment, problem.test, two_modes_));
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

  bool IsSupported() const { return !(two_modes_ && shared_N_ && !shared_second_); }
  bool TwoModes() const { return two_modes_; }

  bool FromMember(const Member& member, State& state) const {
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
      Place& place = state.places[i];
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

  void ToMember(const State& state, UnitRandom& random, Member& member) const {
    member.resize(state.places.size());
    for (std::size_t i = 0; i < member.size(); ++i) {
      const Place& place = state.places[i];
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

  void Sweep(UnitRandom& random, State& state) const {
    const std::size_t n = state.places.size();
    // omega of the places before, which are new, and of those behind, which are not yet.
    thread_local std::vector<Range> behind;
    behind.assign(n + 1, Others().omega_hz);
    for (std::size_t i = n; i-- > 0;) {
      behind[i] = behind[i + 1];
      Widen(behind[i], state.places[i].omega_hz);
    }
    Range before = Others().omega_hz;
    for (std::size_t i = 0; i < n; ++i) {
      const Others others{
          {std::min(before.lo, behind[i + 1].lo), std::max(before.hi, behind[i + 1].hi)},
          BetweenLinks(state, i)};
      const ExperimentTarget& target = targets_[i];
      if (!shared_xi_) {
        SlicePlace(
            random, state, i, others, XiRange(others, i), [](Place& p, double v) { p.xi = v; },
            state.places[i].xi);
      }
      if (!shared_omega_ || (two_modes_ && !shared_second_)) {
        SlicePlace(
            random, state, i, others, target.phase_rad, [](Place& p, double v) { p.phase = v; },
            state.places[i].phase);
      }
      if (!shared_N_ && !FreeGain()) {
        SlicePlace(
            random, state, i, others, target.gain, [](Place& p, double v) { p.gain = v; },
            state.places[i].gain);
      }
      if (!shared_tau_ && !FreeLoopPhase()) {
        SlicePlace(
            random, state, i, others, target.loop_phase_error_rad,
            [](Place& p, double v) { p.loop_phase = v; }, state.places[i].loop_phase);
      }
      if (two_modes_ && !shared_second_ && !shared_omega_) {
        SlicePlace(
            random, state, i, others, OmegaRange(state, i),
            [](Place& p, double v) { p.omega_hz = v; }, state.places[i].omega_hz);
      }
      if (NeedsRoot()) SwitchBranch(random, state, i, others);
      Widen(before, state.places[i].omega_hz);
    }
    if (shared_xi_) SliceGlobal(random, state, &State::xi);
    if (shared_second_) SliceGlobal(random, state, &State::second);
    if (shared_N_) SliceGlobal(random, state, &State::N);
    if (shared_tau_) SliceGlobal(random, state, &State::tau_s);
    if (shared_omega_) SliceGlobal(random, state, &State::omega_hz);
  }

  // The first bracket of each shared parameter's slice: its range over some members.
  void SetWidths(const std::vector<State>& states) {
    for (double State::*const member :
         {&State::xi, &State::second, &State::N, &State::tau_s, &State::omega_hz}) {
      double lo = std::numeric_limits<double>::infinity();
      double hi = 0.0;
      for (const State& state : states) {
        lo = std::min(lo, state.*member);
        hi = std::max(hi, state.*member);
      }
      widths_.*member = std::max(hi - lo, 1e-3 * hi);
    }
  }

 private:
  Range Narrowest(ParameterKind kind) const {
    Range range;
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
      range.lo = std::max(range.lo, RangeOf(kind, i).lo);
      range.hi = std::min(range.hi, RangeOf(kind, i).hi);
    }
    return range;
  }
  // Gain and loop phase error that nothing else depends on are drawn afresh for each member.
  bool FreeGain() const { return free_gain_; }
  bool FreeLoopPhase() const { return free_loop_phase_; }
  bool NeedsRoot() const { return two_modes_ && shared_second_ && !shared_omega_; }

  const Range& RangeOf(ParameterKind kind, std::size_t i) const {
    return ranges_[i][static_cast<std::size_t>(kind)];
  }

  // The ranges that the other experiments leave to one: the ends of omega over them, and the range
  // of xi between the next links of the chain, which keep to those beyond already.
  struct Others {
    Range omega_hz{std::numeric_limits<double>::infinity(), 0.0};
    Range xi{kNever, -kNever};
  };

  static void Widen(Range& ends, double value) {
    ends = {std::min(ends.lo, value), std::max(ends.hi, value)};
  }

  Range BetweenLinks(const State& state, std::size_t i) const {
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

  Range XiRange(const Others& others, std::size_t i) const {
    const Range& own = RangeOf(ParameterKind::kXi, i);
    return {std::max({xi_.lo, own.lo, others.xi.lo}), std::min({xi_.hi, own.hi, others.xi.hi})};
  }

  Range OmegaRange(const State& state, std::size_t i) const {
    const Place& place = state.places[i];
    const double top = MemberChart::TopOmega(targets_[i], place.xi, place.phase);
    return {top / ratio_, top};
  }

  int Roots(std::size_t i, const Place& place, const State& state,
            std::array<double, kMaxRoots>& roots) const {
    const TwoModeEquation equation =
        chart_.Equation(targets_[i], place.xi, place.phase, place.gain, state.second, state.N);
    const double top = MemberChart::TopOmega(targets_[i], place.xi, place.phase);
    return FindRoots<kMaxRoots>(equation, top / ratio_, top, kRootCells, roots);
  }

  // Natural parameters and density from the coordinates; false where there is no member.
  bool Build(std::size_t i, const State& state, Place& place) const {
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

  // ln |d (free natural parameters) / d (coordinates)|, up to a constant.
  double LogJacobian(const Place& place, const Complex<double>& first, const Complex<double>& other,
                     const Complex<double>& z, double omega, double w) const {
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

  bool InDomain(std::size_t i, const State& state, const Place& place) const {
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

  bool InWindow(const Range& omega_hz) const { return omega_hz.hi <= omega_hz.lo * factor_; }

  // Window of omega and chain of xi, where one place alone is new.
  bool Couples(const Place& place, const Others& others) const {
    Range ends = others.omega_hz;
    Widen(ends, place.omega_hz);
    return InWindow(ends) && !(place.xi < others.xi.lo) && !(place.xi > others.xi.hi);
  }

  bool Couples(const State& state) const {
    Range ends = Others().omega_hz;
    for (const Place& place : state.places) Widen(ends, place.omega_hz);
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

  template <typename Set>
  void SlicePlace(UnitRandom& random, State& state, std::size_t i, const Others& others,
                  Range range, const Set& set, double current) const {
    if (!(range.lo < range.hi)) return;
    const Place before = state.places[i];
    const double level = before.log_density - random.Exponential();
    for (int shrink = 0; shrink < 60; ++shrink) {
      const double value = random.Uniform(range);
      Place& place = state.places[i];
      place = before;
      set(place, value);
      if (Build(i, state, place) && place.log_density >= level && Couples(place, others)) return;
      (value < current ? range.lo : range.hi) = value;
    }
    state.places[i] = before;
  }

  // The bracket has a fixed width and a random place around the current value, which keeps the step
  // reversible.
  void SliceGlobal(UnitRandom& random, State& state, double State::*member) const {
    thread_local State before;
    before = state;
    const auto density = [](const State& s) {
      double sum = 0.0;
      for (const Place& place : s.places) sum += place.log_density;
      return sum;
    };
    const double level = density(before) - random.Exponential();
    const double current = before.*member;
    Range open{current - random.Uniform() * widths_.*member, 0.0};
    open.hi = open.lo + widths_.*member;
    for (int shrink = 0; shrink < 60; ++shrink) {
      const double value = random.Uniform(open);
      state.*member = value;
      bool built = value > 0.0 && (member != &State::xi || xi_.Contains(value));
      for (std::size_t i = 0; built && i < state.places.size(); ++i) {
        state.places[i] = before.places[i];
        built = Build(i, state, state.places[i]);
      }
      if (built && Couples(state) && density(state) >= level) return;
      (value < current ? open.lo : open.hi) = value;
    }
    state = before;
  }

  void SwitchBranch(UnitRandom& random, State& state, std::size_t i, const Others& others) const {
    const Place before = state.places[i];
    const int branch = static_cast<int>(random.Index(kMaxRoots));
    if (branch == before.branch) return;
    Place& place = state.places[i];
    place.branch = branch;
    if (Build(i, state, place) && Couples(place, others) &&
        std::log(random.Uniform()) <= place.log_density - before.log_density) {
      return;
    }
    state.places[i] = before;
  }

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
  State widths_;
};

constexpr std::size_t kModelParameters = 5;

double Parameter(const LoopModel& model, std::size_t k) {
  const double values[kModelParameters] = {model.omega_hz, model.xi, model.N, model.M, model.tau_s};
  return values[k];
}

// Every parameter of every experiment in units of its range over `members`; constants are left out.
std::vector<std::vector<double>> Scaled(const std::vector<Member>& members, std::size_t& columns) {
  std::vector<std::vector<double>> rows(members.size());
  columns = 0;
  for (std::size_t i = 0; !members.empty() && i < members[0].size(); ++i) {
    for (std::size_t k = 0; k < kModelParameters; ++k) {
      double lo = std::numeric_limits<double>::infinity();
      double hi = -lo;
      for (const Member& member : members) {
        lo = std::min(lo, Parameter(member[i], k));
        hi = std::max(hi, Parameter(member[i], k));
      }
      if (!(hi > lo)) continue;
      ++columns;
      for (std::size_t row = 0; row < members.size(); ++row) {
        rows[row].push_back((Parameter(members[row][i], k) - lo) / (hi - lo));
      }
    }
  }
  return rows;
}

double SquaredDistance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

double LargestHole(const std::vector<Member>& drawn, const std::vector<Member>& probes) {
  constexpr std::size_t kMostDrawn = 4000;
  std::vector<Member> all(probes);
  const std::size_t step = std::max<std::size_t>(1, drawn.size() / kMostDrawn);
  for (std::size_t k = 0; k < drawn.size(); k += step) all.push_back(drawn[k]);
  std::size_t columns = 0;
  const std::vector<std::vector<double>> rows = Scaled(all, columns);
  double largest = 0.0;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = probes.size(); k < rows.size(); ++k) {
      nearest = std::min(nearest, SquaredDistance(rows[p], rows[k]));
    }
    largest = std::max(largest, nearest);
  }
  return columns == 0 ? 0.0 : std::sqrt(largest / static_cast<double>(columns));
}

}  // namespace

MemberSample SampleMembers(const FamilyProblem& problem, const SampleOptions& options) {
  constexpr std::size_t kProbes = 128;
  MemberSample sample;
  Chart chart(problem);
  if (!chart.IsSupported() || options.count == 0) return sample;
  const std::size_t chains = std::max<std::size_t>(1, options.chains);
  Enumeration starts;
  if (!options.starts.empty()) {
    starts.members = options.starts;
  } else if (NeedsTransferStarts(problem)) {
    starts.members = TransferStarts(problem, 4 * chains, options.seed + 1, options.threads);
  } else {
    starts =
        EnumerateMembers(problem, std::max(kProbes, chains), options.seed + 1, options.threads);
  }
  if (starts.members.empty()) return sample;
  std::vector<State> states(1);
  for (const Member& member : starts.members) {
    if (chart.FromMember(member, states.back())) states.emplace_back();
  }
  states.pop_back();
  if (states.empty()) return sample;
  chart.SetWidths(states);
  // Starts that are far from each other.
  const std::vector<std::size_t> spread = SpreadMembers(starts.members, chains);
  const std::size_t thin = options.thin > 0 ? options.thin
                                            : (problem.HasTransfer() ? 12
                                               : chart.TwoModes()    ? 4
                                                                     : 8);
  const std::size_t length = (options.count + chains - 1) / chains;
  std::vector<std::vector<Member>> drawn(chains);
  std::vector<std::size_t> rejected(chains, 0);
  RunUnits(chains, options.threads, [&](std::size_t chain) {
    UnitRandom random(options.seed, 0x200000 + chain);
    State state;
    bool started = chart.FromMember(starts.members[spread[chain % spread.size()]], state);
    for (std::size_t k = 0; !started && k < starts.members.size(); ++k) {
      started = chart.FromMember(starts.members[k], state);
    }
    if (!started) return;
    for (std::size_t sweep = 0; sweep < options.burn_in; ++sweep) chart.Sweep(random, state);
    drawn[chain].resize(length);
    for (Member& member : drawn[chain]) {
      for (int tries = 0; tries < 8; ++tries) {
        for (std::size_t sweep = 0; sweep < thin; ++sweep) chart.Sweep(random, state);
        chart.ToMember(state, random, member);
        if (Holds(problem, member)) break;
        ++rejected[chain];
      }
    }
  });
  drawn.erase(std::remove_if(drawn.begin(), drawn.end(), [](const auto& d) { return d.empty(); }),
              drawn.end());
  if (drawn.empty()) return sample;
  SampleDiagnostics& diagnostics = sample.diagnostics;
  for (const std::size_t count : rejected) diagnostics.rejected += count;
  diagnostics.effective_sample_size = static_cast<double>(length * drawn.size());
  if (length >= 4) {
    std::vector<std::vector<double>> series(drawn.size(), std::vector<double>(length));
    for (std::size_t i = 0; i < problem.experiments.size(); ++i) {
      for (std::size_t k = 0; k < kModelParameters; ++k) {
        for (std::size_t chain = 0; chain < drawn.size(); ++chain) {
          for (std::size_t row = 0; row < length; ++row) {
            series[chain][row] = Parameter(drawn[chain][row][i], k);
          }
        }
        const Convergence convergence = AssessConvergence(series);
        diagnostics.effective_sample_size =
            std::min(diagnostics.effective_sample_size, convergence.effective_sample_size);
        diagnostics.split_r_hat = std::max(diagnostics.split_r_hat, convergence.split_r_hat);
      }
    }
  }
  for (std::vector<Member>& chain : drawn) {
    std::move(chain.begin(), chain.end(), std::back_inserter(sample.members));
  }
  sample.members.resize(std::min(sample.members.size(), options.count));
  std::vector<Member> probes(starts.members.begin(),
                             starts.members.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                          kProbes, starts.members.size())));
  diagnostics.largest_hole = LargestHole(sample.members, probes);
  return sample;
}

std::vector<std::size_t> SpreadMembers(const std::vector<Member>& members, std::size_t count) {
  std::vector<std::size_t> taken;
  if (members.empty() || count == 0) return taken;
  std::size_t columns = 0;
  const std::vector<std::vector<double>> rows = Scaled(members, columns);
  std::vector<double> mean(columns, 0.0);
  for (const std::vector<double>& row : rows) {
    for (std::size_t k = 0; k < columns; ++k) {
      mean[k] += row[k] / static_cast<double>(rows.size());
    }
  }
  std::vector<double> distance(rows.size());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    distance[row] = SquaredDistance(rows[row], mean);
  }
  while (taken.size() < std::min(count, members.size())) {
    const std::size_t farthest = static_cast<std::size_t>(
        std::max_element(distance.begin(), distance.end()) - distance.begin());
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const double to_taken = SquaredDistance(rows[row], rows[farthest]);
      distance[row] = taken.empty() ? to_taken : std::min(distance[row], to_taken);
    }
    distance[farthest] = -1.0;
    taken.push_back(farthest);
  }
  return taken;
}

}  // namespace howl
