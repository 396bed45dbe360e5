#include "diagnosis/loop_budget/account/change_values.h"

#include <cmath>

#include "estimation/record_fit/slow/modal_parts.h"

namespace howl {
namespace {

double HalfResidue(const LoopMode& mode) { return 0.5 * std::hypot(mode.a, mode.b); }

}  // namespace

PointValue ValueOfChange(const LoopItem& item) {
  if (item.change == &PointStructure::damping_follows_amplitude) {
    return {"xi_add_at_cycle", [](const RecordSpectra&, const LoopPoint& point) {
              const LoopMode& of_cycle = ModeOfCycle(point.modes);
              return HalfResidue(of_cycle) * point.Change(SlowChange::kDamping).sum() /
                     of_cycle.omega;
            }};
  }
  if (item.change == &PointStructure::frequency_drifts) {
    return {"rel_span", [](const RecordSpectra&, const LoopPoint& point) {
              const LoopMode& of_cycle = ModeOfCycle(point.modes);
              return HalfResidue(of_cycle) * point.Change(SlowChange::kFrequency).sum() /
                     std::pow(of_cycle.omega, 2);
            }};
  }
  if (item.change == &PointStructure::gain_follows_amplitude) {
    return {"slope", [](const RecordSpectra&, const LoopPoint& point) {
              return point.Change(SlowChange::kGain).sum();
            }};
  }
  return {"rel_at_cycle", [](const RecordSpectra&, const LoopPoint& point) {
            const double at_cycle = point.Change(SlowChange::kDelay).sum();
            return at_cycle / (point.path.tau - at_cycle);
          }};
}

}  // namespace howl
