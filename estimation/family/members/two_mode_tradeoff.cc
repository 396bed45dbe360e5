#include "estimation/family/members/two_mode_tradeoff.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "estimation/family/problem/member_chart.h"

namespace howl {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInside = 1e-9;     // of a tolerance: what is built at its edge passes
constexpr double kLargestXi = 20.0;  // where the search for a least xi gives up
constexpr double kFarOff = 4.0;      // of a frequency: where there is no solution to be off by

// Smallest x in [lo, hi] with function(x) <= 0, of a function that falls; function(lo) > 0.
template <typename Function>
double FallingRoot(const Function& function, double lo, double hi) {
  double f_lo = function(lo);
  double f_hi = function(hi);
  for (int k = 0; k < 60 && hi - lo > 1e-13 * hi; ++k) {
    double c = (lo * f_hi - hi * f_lo) / (f_hi - f_lo);
    if (!(c > lo && c < hi)) c = 0.5 * (lo + hi);
    const double fc = function(c);
    if (fc > 0.0) {
      lo = c;
      f_lo = fc;
      f_hi *= 0.5;
    } else {
      hi = c;
      f_hi = std::min(fc, -1e-300);
      f_lo *= 0.5;
    }
  }
  return hi;
}

class Greedy {
 public:
  explicit Greedy(const FamilyProblem& problem)
      : problem_(problem), chart_(problem, kInside), order_(targets_.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::stable_sort(
        order_, [&](std::size_t a, std::size_t b) { return targets_[a].phi < targets_[b].phi; });
    xi_ = problem.RangeOf(ParameterKind::kXi);
    xi_.lo = std::max(xi_.lo, 1e-6);
    xi_.hi = std::min({xi_.hi, problem.test.xi_max, kLargestXi});
    omega_ = problem.RangeOf(ParameterKind::kOmega);
    factor_ = 1.0 + problem.test.omega_spread_max * (1.0 - kInside);
  }

  // Largest xi with the shared value; infinite where none is found.
  double LargestXi(double second) const {
    double top = 0.0;
    for (const ExperimentTarget& target : targets_) {
      if (target.IsEmpty()) return kUnreached;
      top = std::max(top, 1.2 * target.frequency_hz);
    }
    double lo = std::max(omega_.lo, 0.2 * top);
    double hi = std::min(omega_.hi, top);
    // The window's low end: the highest that has a solution, first from a grid.
    constexpr int kGrid = 16;
    std::optional<double> best_at;
    const double ratio = std::pow(hi / lo, 1.0 / kGrid);
    std::vector<double> xi(targets_.size());
    for (int k = kGrid; k >= 0 && !best_at; --k) {
      const double v = lo * std::pow(ratio, k);
      if (Chain(second, v, xi)) best_at = v;
    }
    if (!best_at) return kUnreached;
    double good = *best_at;
    double bad = good * ratio;
    for (int k = 0; k < 40 && bad - good > 1e-12 * bad; ++k) {
      const double v = 0.5 * (good + bad);
      (Chain(second, v, xi) ? good : bad) = v;
    }
    // A hair below the edge, where rounding decides.
    Chain(second, good, xi);
    Member member;
    for (const double back : {0.0, 1e-9, 1e-7}) {
      const double v = good * (1.0 - back);
      if (Chain(second, v, xi) && Build(second, v, xi, member) && Holds(problem_, member)) {
        return *std::ranges::max_element(xi);
      }
    }
    return kUnreached;
  }

  // Appends members at the extremes for this shared value and window: every xi as low, and as
  // high, as window and chain allow, at each corner of phase and gain.
  void Extremes(double second, double v, std::vector<Member>& members) const {
    std::vector<double> low(targets_.size()), high(targets_.size());
    if (!Chain(second, v, low) || !ChainDown(second, v, low, high)) return;
    Member member;
    for (const std::vector<double>* const xi : {&low, &high}) {
      for (const bool late : {false, true}) {
        for (const bool loud : {false, true}) {
          if (Build(second, v, *xi, member, late, loud) && Holds(problem_, member)) {
            members.push_back(member);
          }
        }
      }
    }
  }

  Range Windows() const {
    Range range = omega_;
    double top = 0.0;
    for (const ExperimentTarget& target : targets_) top = std::max(top, target.frequency_hz);
    range.lo = std::max(range.lo, 0.2 * top);
    range.hi = std::min(range.hi, top);
    return range;
  }

  static constexpr double kUnreached = std::numeric_limits<double>::infinity();

 private:
  // On the branch where the first mode carries the fundamental: at or below the one-mode solution.
  double Omega(const ExperimentTarget& target, double xi, double phase, double gain,
               double second) const {
    const double r = chart_.ratio;
    const TwoModeEquation equation = chart_.Equation(target, xi, phase, gain, second, kNaN);
    const double one_mode = MemberChart::TopOmega(target, xi, phase);
    double x0 = one_mode;
    double f0 = equation(x0);
    if (second == 0.0) return x0;
    double x1 = one_mode * (1.0 - 1e-4);
    double f1 = equation(x1);
    for (int k = 0; k < 40; ++k) {
      if (f1 == f0) break;
      const double x2 = x1 - f1 * (x1 - x0) / (f1 - f0);
      if (!(x2 > one_mode / r && x2 < 1.001 * one_mode)) return kNaN;
      x0 = x1;
      f0 = f1;
      x1 = x2;
      f1 = equation(x1);
      if (std::abs(x1 - x0) < 1e-14 * x1) return x1;
    }
    return std::abs(x1 - x0) < 1e-11 * x1 ? x1 : kNaN;
  }

  // Lowest and highest omega over the corners of phase and gain.
  Range Reach(const ExperimentTarget& target, double xi, double second) const {
    Range reach{std::numeric_limits<double>::infinity(), 0.0};
    for (const double phase : {target.phase_rad.lo, target.phase_rad.hi}) {
      for (const double gain : {target.gain.lo, target.gain.hi}) {
        const double omega = Omega(target, xi, phase, gain, second);
        if (!std::isfinite(omega)) continue;
        reach.lo = std::min(reach.lo, omega);
        reach.hi = std::max(reach.hi, omega);
      }
    }
    return reach;
  }

  bool Chain(double second, double v, std::vector<double>& xi) const {
    const double top = std::min(v * factor_, omega_.hi);
    double least = xi_.lo;
    for (const std::size_t i : order_) {
      const auto above = [&](double value) {
        const double lo = Reach(targets_[i], value, second).lo;
        return std::isfinite(lo) ? lo - top : kFarOff * targets_[i].frequency_hz;
      };
      if (above(least) > 0.0) {
        if (!(above(xi_.hi) <= 0.0)) return false;
        least = FallingRoot(above, least, xi_.hi);
      }
      if (!(Reach(targets_[i], least, second).hi >= v)) return false;
      xi[i] = least;
    }
    return true;
  }

  // The largest xi that fit, down from the highest phi; `low` is from Chain.
  bool ChainDown(double second, double v, const std::vector<double>& low,
                 std::vector<double>& high) const {
    double most = xi_.hi;
    for (auto at = order_.rbegin(); at != order_.rend(); ++at) {
      const std::size_t i = *at;
      // Falls with falling xi, so that it is a falling function of -xi.
      const auto below = [&](double negative) {
        const double hi = Reach(targets_[i], -negative, second).hi;
        return hi > 0.0 ? v - hi : kFarOff * targets_[i].frequency_hz;
      };
      if (below(-most) > 0.0) {
        double lo = low[i];
        double hi = most;
        for (int k = 0; k < 45; ++k) {
          const double middle = 0.5 * (lo + hi);
          (below(-middle) > 0.0 ? hi : lo) = middle;
        }
        most = lo;
      }
      high[i] = most;
    }
    return true;
  }

  // Phase, gain and loop phase within their tolerances that put omega into the window.
  bool Build(double second, double v, const std::vector<double>& xi, Member& member,
             bool late = false, bool loud = false) const {
    member.assign(targets_.size(), {});
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      if (!BuildOne(i, second, {v, v * factor_}, xi[i], late, loud, member[i])) return false;
    }
    return true;
  }

  bool BuildOne(std::size_t i, double second, const Range& window, double xi, bool late, bool loud,
                LoopModel& model) const {
    constexpr int kPhases = 8;
    constexpr int kLoopPhases = 4;
    const ExperimentTarget& target = targets_[i];
    const auto share = [](const Range& range, int k, int n) {
      return k == n ? range.hi : range.lo + (range.hi - range.lo) * k / n;
    };
    for (int p = 0; p <= kPhases; ++p) {
      const double phase = share(target.phase_rad, late ? kPhases - p : p, kPhases);
      for (int g = 0; g <= 2; ++g) {
        const double gain = share(target.gain, loud ? 2 - g : g, 2);
        const double omega = Omega(target, xi, phase, gain, second);
        if (!(omega >= window.lo && omega <= window.hi * (1.0 + 1e-11))) continue;
        const double N = chart_.Coefficients(target, omega, xi, phase, gain).N;
        model = {omega, xi, N, chart_.MOf(second, N), 0.0, chart_.ratio};
        for (int l = 0; l <= kLoopPhases; ++l) {
          model.tau_s =
              chart_.Tau(target, phase, share(target.loop_phase_error_rad, l, kLoopPhases));
          if (IsMember(std::span(&problem_.experiments[i], 1), std::span(&model, 1),
                       problem_.test)) {
            return true;
          }
        }
      }
    }
    return false;
  }

  const FamilyProblem& problem_;
  MemberChart chart_;
  const std::vector<ExperimentTarget>& targets_ = chart_.targets;
  std::vector<std::size_t> order_;  // by phi
  Range xi_;
  Range omega_;
  double factor_;
};

}  // namespace

bool HasGreedyTradeoff(const FamilyProblem& problem) {
  if (problem.model.modes != 2 || !problem.model.own.empty() || !problem.test.xi_increasing ||
      problem.HasTransfer()) {
    return false;
  }
  if (std::ranges::any_of(problem.experiments, [&](const Experiment& experiment) {
        return TestsLineGain(experiment, problem.test);
      })) {
    return false;
  }
  const bool shares_m = problem.IsShared(ParameterKind::kM);
  if (!shares_m && !problem.IsShared(ParameterKind::kMOverN)) return false;
  for (const ParameterKind kind :
       {ParameterKind::kOmega, ParameterKind::kXi, ParameterKind::kN, ParameterKind::kTau}) {
    if (problem.IsShared(kind)) return false;
  }
  return std::isfinite(problem.RangeOf(shares_m ? ParameterKind::kM : ParameterKind::kMOverN).hi) &&
         std::isfinite(problem.test.omega_spread_max);
}

std::vector<Member> ExtremeMembers(const FamilyProblem& problem) {
  constexpr int kSeconds = 10;
  constexpr int kWindows = 50;
  constexpr int kHalvings = 16;
  const Greedy greedy(problem);
  const Range range = problem.RangeOf(problem.IsShared(ParameterKind::kM) ? ParameterKind::kM
                                                                          : ParameterKind::kMOverN);
  const Range windows = greedy.Windows();
  std::vector<Member> members;
  for (int m = 0; m <= kSeconds; ++m) {
    const double u = static_cast<double>(m) / kSeconds;
    const double second = m == kSeconds
                              ? range.hi
                              : std::max(range.lo + (range.hi - range.lo) * u * u, 1e-6 * range.hi);
    const auto reaches = [&](double v) {
      const std::size_t before = members.size();
      greedy.Extremes(second, v, members);
      return members.size() > before;
    };
    const double step = (windows.hi - windows.lo) / kWindows;
    bool before = false;
    for (int k = 0; k <= kWindows; ++k) {
      const double v = windows.lo + step * k;
      const bool here = reaches(v);
      if (k > 0 && here != before) {
        // The edge of the windows that have members, where parameters reach farthest.
        double good = here ? v : v - step;
        double bad = here ? v - step : v;
        for (int halving = 0; halving < kHalvings; ++halving) {
          const double middle = 0.5 * (good + bad);
          (reaches(middle) ? good : bad) = middle;
        }
      }
      before = here;
    }
  }
  return members;
}

std::optional<double> GreedySmallestXi(const FamilyProblem& problem) {
  const Greedy greedy(problem);
  const Range range = problem.RangeOf(problem.IsShared(ParameterKind::kM) ? ParameterKind::kM
                                                                          : ParameterKind::kMOverN);
  // Even in the root: towards zero the second mode fades out. Zero itself is not a second mode.
  constexpr int kGrid = 12;
  const double u_lo = std::sqrt(std::max(range.lo, 1e-6 * range.hi));
  const double u_hi = std::sqrt(range.hi);
  const auto at = [&](double u) { return greedy.LargestXi(std::min(u * u, range.hi)); };
  double best_u = u_lo;
  double best = Greedy::kUnreached;
  double step = (u_hi - u_lo) / kGrid;
  for (int k = 0; k <= kGrid; ++k) {
    const double u = u_lo + step * k;
    const double xi = at(u);
    if (xi < best) {
      best = xi;
      best_u = u;
    }
  }
  if (!std::isfinite(best)) return std::nullopt;
  for (int round = 0; round < 16 && step > 0.0; ++round) {
    step *= 0.5;
    for (const double u : {std::max(u_lo, best_u - step), std::min(u_hi, best_u + step)}) {
      const double xi = at(u);
      if (xi < best) {
        best = xi;
        best_u = u;
      }
    }
  }
  return best;
}

}  // namespace howl
