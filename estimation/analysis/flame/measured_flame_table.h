// The measured flame curve (flame_curve.h) as a table (model/loop/flame_table.h). The flame's
// falling curve, q against x, is a rising one against u = Phi'(0) x; of the bins' means, weighted
// by their errors, the nearest that never falls is taken (isotonic regression by pooling adjacent
// violators: R. E. Barlow et al., Statistical Inference under Order Restrictions, 1972), less its
// value at rest.
#ifndef HOWL_ESTIMATION_ANALYSIS_FLAME_MEASURED_FLAME_TABLE_H_
#define HOWL_ESTIMATION_ANALYSIS_FLAME_MEASURED_FLAME_TABLE_H_

#include <optional>

#include "estimation/analysis/flame/flame_curve.h"
#include "model/loop/flame_table.h"

namespace howl {

// No value where the curve has fewer than eight bins with an error, or the slope is not negative.
// slope_at_rest: Phi'(0) in (units of q) / (units of p / s).
std::optional<FlameTable> MeasuredFlameTable(const FlameCurve& curve, double slope_at_rest);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_FLAME_MEASURED_FLAME_TABLE_H_
