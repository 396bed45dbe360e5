#include "diagnosis/budget/item_trials.h"

#include <glog/logging.h>

#include <algorithm>
#include <utility>

#include "diagnosis/budget/items/item_starts.h"

namespace howl {
namespace {

constexpr int kScreenIterations = 4;
constexpr int kTrialIterations = 12;
constexpr std::size_t kLeastToThin = 4;  // operating points
// Noise gives half a nat for each parameter; an item that pays gains more on a quarter of the data.
constexpr double kLeastScreenGain = 0.5;
constexpr double kErrorToDoubt = 0.05;
constexpr double kLittleError = 0.02;

StructureOptions Iterations(int count) {
  StructureOptions out;
  out.iterations = count;
  return out;
}

}  // namespace

StructureFit Converged(const std::vector<JointBand>& bands, StructureFit from) {
  StructureFit fit = FitStructure(bands, std::move(from));
  if (std::max(fit.shared.eps_a, fit.shared.eps_b) < kErrorToDoubt) return fit;
  StructureFit anew = fit;
  anew.shared.eps_a = std::min(anew.shared.eps_a, kLittleError);
  anew.shared.eps_b = std::min(anew.shared.eps_b, kLittleError);
  for (std::size_t e = 0; e < anew.points.size(); ++e) {
    for (std::size_t j = 0; j < anew.points[e].noise.size(); ++j) {
      anew.points[e].noise[j] = anew.centres[e].noise[j];
    }
  }
  anew = FitStructure(bands, std::move(anew));
  return anew.log_posterior > fit.log_posterior ? anew : fit;
}

Screen MakeScreen(const BudgetRecords& records, const StructureFit& from) {
  Screen out;
  const std::size_t step = records.whole.size() < kLeastToThin ? 1 : 2;
  for (std::size_t e = 0; e < records.whole.size(); e += step) {
    out.points.push_back(e);
    out.bands.push_back(records.halves[0][e]);
  }
  out.log_posterior =
      FitStructure(out.bands, OfPoints(from, out.points), Iterations(kTrialIterations))
          .log_posterior;
  return out;
}

std::optional<ItemTrial> TryItem(const BudgetRecords& records, const Screen& screen,
                                 const StructureFit& from, const BudgetItem& item) {
  const auto screened = [&](const StructureFit& start) {
    return FitStructure(screen.bands, start, Iterations(kScreenIterations)).log_posterior;
  };
  double highest = screen.log_posterior + kLeastScreenGain;
  std::optional<StructureFit> best;
  if (item.kind == ItemKind::kEffect) {
    const StructureFit thinned = OfPoints(from, screen.points);
    std::optional<EffectStart> start;
    for (const EffectStart& each : EffectStarts(from.structure, item)) {
      const double value = screened(StartWith(screen.bands, thinned, each));
      if (value <= highest) continue;
      highest = value;
      start = each;
    }
    if (start) best = StartWith(records.whole, from, *start);
  } else {
    std::vector<StructureFit> starts = StartsWith(records.whole, from, item);
    if (starts.size() == 1) {
      best = std::move(starts[0]);
    } else {
      for (StructureFit& start : starts) {
        const double value = screened(OfPoints(start, screen.points));
        if (value <= highest) continue;
        highest = value;
        best = std::move(start);
      }
    }
  }
  if (!best) return std::nullopt;
  ItemTrial out{item, FitStructure(records.whole, std::move(*best), Iterations(kTrialIterations))};
  if (item.kind == ItemKind::kEffect) {
    out.item.forms = {out.fit.structure.effects.back()};
    const std::vector<double>& values = out.fit.shared.values;
    const std::size_t count = out.item.forms[0]->parameters().size();
    out.item.fitted.assign(values.end() - static_cast<std::ptrdiff_t>(count), values.end());
  }
  return out;
}

}  // namespace howl
