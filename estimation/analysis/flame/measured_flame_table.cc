#include "estimation/analysis/flame/measured_flame_table.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace howl {
namespace {

constexpr std::size_t kFewestBins = 8;

struct Pool {
  double mean = 0.0;
  double weight = 0.0;
  std::size_t count = 0;
};

}  // namespace

std::optional<FlameTable> MeasuredFlameTable(const FlameCurve& curve, double slope_at_rest) {
  if (!(slope_at_rest < 0.0)) return std::nullopt;
  std::vector<FlameCurveBin> bins;
  for (const FlameCurveBin& bin : curve.bins) {
    if (bin.q_std > 0.0 && std::isfinite(bin.q)) bins.push_back(bin);
  }
  if (bins.size() < kFewestBins) return std::nullopt;
  // x falls as u rises.
  std::ranges::sort(bins, std::greater<>(), &FlameCurveBin::x);
  std::vector<Pool> pools;
  for (const FlameCurveBin& bin : bins) {
    pools.push_back({bin.q, 1.0 / (bin.q_std * bin.q_std), 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean >= pools.back().mean) {
      const Pool last = pools.back();
      pools.pop_back();
      Pool& into = pools.back();
      into.mean = (into.mean * into.weight + last.mean * last.weight) / (into.weight + last.weight);
      into.weight += last.weight;
      into.count += last.count;
    }
  }
  std::vector<double> u, q;
  std::size_t next = 0;
  for (const Pool& pool : pools) {
    for (std::size_t i = 0; i < pool.count; ++i) {
      u.push_back(slope_at_rest * bins[next++].x);
      q.push_back(pool.mean);
    }
  }
  const double at_rest = FlameTable(u, q).Value(0.0);
  for (double& value : q) value -= at_rest;
  return FlameTable(std::move(u), std::move(q));
}

}  // namespace howl
