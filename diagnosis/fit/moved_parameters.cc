#include "diagnosis/fit/moved_parameters.h"

#include <algorithm>
#include <cmath>

namespace howl {
namespace {

double Distance(const MovedParameter& p) {
  return std::abs(p.with - p.without) / std::max(std::abs(p.with), std::abs(p.without));
}

}  // namespace

std::vector<MovedParameter> MovedParameters(const std::vector<CutRecord>& records,
                                            const EffectFit& without, const EffectFit& with) {
  std::vector<MovedParameter> out = {{"tau_s", without.tau_s, with.tau_s}};
  for (std::size_t e = 0; e < records.size(); ++e) {
    const Acoustics<double> was = ToAcoustics(records[e].model, without.experiments[e].acoustics);
    const Acoustics<double> is = ToAcoustics(records[e].model, with.experiments[e].acoustics);
    const std::string& name = records[e].name;
    out.push_back({name + ".omega_hz", was.omega_hz, is.omega_hz});
    out.push_back({name + ".xi", was.xi, is.xi});
    out.push_back({name + ".N", was.N, is.N});
    if (without.delay_scatter > 0.0 || with.delay_scatter > 0.0) {
      out.push_back({name + ".tau_s", without.DelayOf(e), with.DelayOf(e)});
    }
    if (records[e].model.modes > 1) out.push_back({name + ".M", was.M, is.M});
  }
  return out;
}

std::vector<MovedParameter> FarthestMoved(std::vector<MovedParameter> moved, std::size_t most,
                                          double least) {
  const auto near = [&](const MovedParameter& p) { return !(Distance(p) >= least); };
  moved.erase(std::remove_if(moved.begin(), moved.end(), near), moved.end());
  std::stable_sort(moved.begin(), moved.end(),
                   [](const auto& a, const auto& b) { return Distance(a) > Distance(b); });
  if (moved.size() > most) moved.resize(most);
  return moved;
}

}  // namespace howl
