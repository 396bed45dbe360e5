// Duct and delay as filters over the grid, whose taps move with what is slow.
#ifndef HOWL_RIG_MOVING_LINES_H_
#define HOWL_RIG_MOVING_LINES_H_

#include <algorithm>
#include <cmath>
#include <vector>

#include "rig/delay_line.h"
#include "rig/march.h"

namespace rig {

inline constexpr int kSpreadReach = 6;  // readings on each side, half a standard deviation apart
inline constexpr std::size_t kDampingNodes = 17;
inline constexpr double kLargestAmplitude = 2.0;  // over the mean, for the damping's nodes

// The duct on the grid; its taps move with what is slow.
class DuctOnGrid {
 public:
  DuctOnGrid(const Plan& plan, const Point& point, const Grid& grid) : behaviour_(plan.behaviour) {
    const double spacing_s = grid.step_s;
    if (behaviour_.damping_at_cycle == 0.0) {
      ducts_.push_back(DesignDuct(point.modes, spacing_s));
    } else {
      for (std::size_t i = 0; i < kDampingNodes; ++i) {
        Modes modes = point.modes;
        modes.xi = std::clamp(modes.xi + behaviour_.damping_at_cycle * Square(i), 0.002, 0.6);
        ducts_.push_back(DesignDuct(modes, spacing_s));
      }
    }
    Set(1.0, 0.0);
  }

  bool moves() const { return behaviour_.drift_span != 0.0 || ducts_.size() > 1; }

  // frequency_factor: on all frequencies; amplitude: over the mean one.
  void Set(double frequency_factor, double amplitude) {
    const double place = static_cast<double>(kDampingNodes - 1) *
                         std::clamp(amplitude * amplitude / Square(kDampingNodes - 1), 0.0, 1.0);
    const auto lower = std::min(static_cast<std::size_t>(place), ducts_.size() - 1);
    const std::size_t upper = std::min(lower + 1, ducts_.size() - 1);
    const double part = ducts_.size() > 1 ? place - static_cast<double>(lower) : 0.0;
    Fill(&Duct::reflection, lower, upper, part, frequency_factor, 1.0, reflection);
    // With all delays over a factor, N and M would be multiplied by it.
    Fill(&Duct::distribution, lower, upper, part, frequency_factor, 1.0 / frequency_factor,
         distribution);
  }

  Filter reflection;
  Filter distribution;

 private:
  // The squared amplitude at a node.
  static double Square(std::size_t node) {
    return kLargestAmplitude * kLargestAmplitude * static_cast<double>(node) /
           static_cast<double>(kDampingNodes - 1);
  }
  void Fill(std::vector<double> Duct::*taps, std::size_t lower, std::size_t upper, double part,
            double frequency_factor, double scale, Filter& filter) const {
    filter.Clear();
    const std::vector<double>& a = ducts_[lower].*taps;
    const std::vector<double>& b = ducts_[upper].*taps;
    for (std::size_t k = 0; k < std::max(a.size(), b.size()); ++k) {
      const double x = k < a.size() ? a[k] : 0.0;
      const double y = k < b.size() ? b[k] : 0.0;
      const double tap = scale * (x + part * (y - x));
      if (tap == 0.0) continue;
      if (frequency_factor == 1.0) {
        filter.AddTap(k, tap);
      } else {
        filter.Add(ValueAt(static_cast<double>(k) / frequency_factor), tap);
      }
    }
    filter.Finish();
  }

  const Behaviour& behaviour_;
  std::vector<Duct> ducts_;
};

// v = p'(t - tau), with what effects make of the delay.
class DelayOnGrid {
 public:
  DelayOnGrid(const Behaviour& behaviour, double tau_s, double step_s)
      : behaviour_(behaviour), tau_s_(tau_s), step_s_(step_s) {
    Set(1.0);
  }
  bool moves() const {
    return behaviour_.delay_at_cycle != 0.0 || behaviour_.delay_wander != 0.0 ||
           behaviour_.point_wander != 0.0;
  }
  void Set(double factor) {
    const double tau_s = tau_s_ * factor;
    filter.Clear();
    AddPath(tau_s, 1.0 - behaviour_.second_path_share);
    if (behaviour_.second_path_share != 0.0) {
      AddPath(tau_s + behaviour_.second_path_extra_s, behaviour_.second_path_share);
    }
    filter.Finish();
  }

  Filter filter;

 private:
  void AddPath(double tau_s, double share) {
    if (behaviour_.delay_spread_s == 0.0) {
      AddReading(tau_s, share);
      return;
    }
    // A normal spread by equal steps: exact to all orders that matter at half a deviation.
    double total = 0.0;
    for (int i = -kSpreadReach; i <= kSpreadReach; ++i) total += std::exp(-0.125 * i * i);
    for (int i = -kSpreadReach; i <= kSpreadReach; ++i) {
      AddReading(tau_s + 0.5 * i * behaviour_.delay_spread_s,
                 share * std::exp(-0.125 * i * i) / total);
    }
  }
  void AddReading(double delay_s, double share) {
    filter.Add(SlopeAt(std::max(3.0, delay_s / step_s_)), share / step_s_);
  }

  const Behaviour& behaviour_;
  double tau_s_;
  double step_s_;
};

}  // namespace rig

#endif  // HOWL_RIG_MOVING_LINES_H_
