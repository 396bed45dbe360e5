#include "estimation/record_fit/other_maxima.h"

#include <utility>

#include "estimation/record_fit/delay_maxima.h"
#include "estimation/record_fit/mode_maxima.h"

namespace howl {

PointFit BestOfOtherMaxima(const RecordSpectra& record, const PointStructure& structure,
                           const PointPrior& prior, PointFit fit) {
  fit = BestByDelay(record, structure, prior, std::move(fit));
  return BestByModes(record, structure, prior, std::move(fit));
}

}  // namespace howl
