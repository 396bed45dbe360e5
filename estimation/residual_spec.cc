#include "estimation/residual_spec.h"

namespace howl {

ResidualSet DefaultResidualSet() {
  ResidualSet set;
  set[ResidualKind::kGainEquality].std = 0.01;
  set[ResidualKind::kPhaseEquality].std = 0.5;
  set[ResidualKind::kLimitCyclePhase].std = 1.0;
  set[ResidualKind::kLimitCycleGain].std = 0.05;
  set[ResidualKind::kSecondCrossing].std = 5.0;
  set[ResidualKind::kTransfer].std = 0.02;
  set[ResidualKind::kOmegaPrior].std = 0.05;
  set[ResidualKind::kXiIncreasing].std = 0.02;
  set[ResidualKind::kDampingPrior].std = 1.0;
  set[ResidualKind::kDampingPrior].center = 0.1;
  set[ResidualKind::kTauPrior].std = 0.03;
  set[ResidualKind::kSecondModeMinor].std = 0.01;
  set[ResidualKind::kSecondModeMinor].center = kSecondModeShareMax;
  set[ResidualKind::kSecondCrossingGain].std = 0.05;
  return set;
}

}  // namespace howl
