#include "app/simulate/flame_table_rig.h"

#include <utility>

#include "estimation/analysis/flame/measured_flame_table.h"
#include "io/user_error.h"

namespace howl {

void UseFlameTable(const Config& config, const ProblemInput& input, const Experiment& experiment,
                   SimulatedRig* rig) {
  std::optional<FlameTable> table;
  if (input.analysis && experiment.flame_slope) {
    for (const Analysis& analysis : input.analysis->analyses) {
      if (analysis.name != experiment.name || !analysis.flame_curve) continue;
      table = MeasuredFlameTable(*analysis.flame_curve, *experiment.flame_slope);
    }
  }
  if (!table) {
    const LocatedMember* const simulate = config.tree.Find("simulate");
    const LocatedMember* const key = simulate ? simulate->value.Find("flame_table") : nullptr;
    throw UserError(config.source.string(), key ? key->key_line : 0, "simulate.flame_table",
                    "no flame curve was measured at " + experiment.name +
                        ", expected records of p and q in a limit cycle");
  }
  rig->parameters.model.flame = {FlameShape::kLinear, rig->flame_slope, 1.0, 0.0};
  rig->parameters.effects.push_back(MakeTableEffect(*std::move(table)));
  rig->has_flame_table = true;
}

}  // namespace howl
