// The gap by signal, band and experiment, where it is held out as the whole gap is (gap.h): in each
// band the root of the mean of |E|^2 / V less one, or zero where that is negative.
//
// "p": cut A, pressure from measured heat release; "q": cut B, heat release from measured pressure.
// Bands in Hz, evenly spaced in the logarithm. Of noise alone n |E|^2 / V, summed over n
// independent bins, is gamma-distributed with shape n; which cells are more than that is decided
// for the whole map by Benjamini and Hochberg (1995).
#ifndef HOWL_DIAGNOSIS_GAP_MAP_H_
#define HOWL_DIAGNOSIS_GAP_MAP_H_

#include <string>
#include <vector>

#include "diagnosis/effect_fit.h"

namespace howl {

struct GapCell {
  std::string signal;
  std::string experiment;
  double low_hz = 0.0;
  double high_hz = 0.0;
  double before = 0.0;
  double after = 0.0;  // NaN where nothing was tried
  // More than noise, among all cells of the map, at a false discovery rate of 5 %.
  bool before_found = false;
  bool after_found = false;
};

struct GapSide {
  const std::vector<ExperimentFit>* residuals = nullptr;  // null where nothing was tried
  bool without_masked = false;                            // lines are accounted for
};

std::vector<GapCell> GapMap(const std::vector<CutRecord>& records, const GapSide& before,
                            const GapSide& after, const std::vector<Eigen::VectorXd>& flame_noise);

}  // namespace howl

#endif  // HOWL_DIAGNOSIS_GAP_MAP_H_
