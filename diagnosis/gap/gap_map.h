// The held-out gap (gap.h) by signal, band and experiment: in each band the root of the mean of
// |E|^2 / V less one, or zero where that is negative.
//
// "p": cut A, pressure from measured heat release; "q": cut B, heat release from measured pressure.
// Bands are in Hz, evenly spaced in the logarithm. With noise alone the sum of |E|^2 / V over n
// independent bins is gamma-distributed with shape n; the procedure of Benjamini and Hochberg
// (1995) decides for the whole map which cells exceed that.
#ifndef HOWL_DIAGNOSIS_GAP_GAP_MAP_H_
#define HOWL_DIAGNOSIS_GAP_GAP_MAP_H_

#include <string>
#include <vector>

#include "diagnosis/fit/effect_fit.h"

namespace howl {

struct GapCell {
  std::string signal;
  std::string experiment;
  double low_hz = 0.0;
  double high_hz = 0.0;
  double before = 0.0;
  double after = 0.0;  // NaN where nothing was tried
  // True where the cell holds more than noise, at a false discovery rate of 5 % over the map.
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

#endif  // HOWL_DIAGNOSIS_GAP_GAP_MAP_H_
