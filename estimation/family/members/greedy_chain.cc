#include "estimation/family/members/greedy_chain.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "model/numerics/constants.h"

namespace howl {
namespace {

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

}  // namespace

GreedyChain::GreedyChain(const FamilyProblem& problem)
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

double GreedyChain::LargestXi(double second) const {
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

void GreedyChain::Extremes(double second, double v, std::vector<Member>& members) const {
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

Range GreedyChain::Windows() const {
  Range range = omega_;
  double top = 0.0;
  for (const ExperimentTarget& target : targets_) top = std::max(top, target.frequency_hz);
  range.lo = std::max(range.lo, 0.2 * top);
  range.hi = std::min(range.hi, top);
  return range;
}

double GreedyChain::Omega(const ExperimentTarget& target, double xi, double phase, double gain,
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

Range GreedyChain::Reach(const ExperimentTarget& target, double xi, double second) const {
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

bool GreedyChain::Chain(double second, double v, std::vector<double>& xi) const {
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

bool GreedyChain::ChainDown(double second, double v, const std::vector<double>& low,
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

bool GreedyChain::Build(double second, double v, const std::vector<double>& xi, Member& member,
                        bool late, bool loud) const {
  member.assign(targets_.size(), {});
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (!BuildOne(i, second, {v, v * factor_}, xi[i], late, loud, member[i])) return false;
  }
  return true;
}

bool GreedyChain::BuildOne(std::size_t i, double second, const Range& window, double xi, bool late,
                           bool loud, LoopModel& model) const {
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
        model.tau_s = chart_.Tau(target, phase, share(target.loop_phase_error_rad, l, kLoopPhases));
        if (IsMember(std::span(&problem_.experiments[i], 1), std::span(&model, 1), problem_.test)) {
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace howl
