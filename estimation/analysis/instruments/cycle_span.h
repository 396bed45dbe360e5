// How far a response between p and q reaches, in samples.
#ifndef HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_CYCLE_SPAN_H_
#define HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_CYCLE_SPAN_H_

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "estimation/analysis/instruments/response_by_least_squares.h"

namespace howl {

struct CycleSpan {
  ResponseSpan response;
  std::size_t beside = 0;  // what stands so near tells something of a sample
};

// Memory of the acoustics, in periods of the cycle: of a resonance with a damping of 0.02 a twelfth
// is left after twenty, which what stands beside a sample tells. Instruments may delay q by some.
inline CycleSpan SpanOfCycle(std::size_t samples, double period_samples) {
  constexpr double kPeriodsAhead = 3.0;
  constexpr double kPeriodsBack = 20.0;
  constexpr double kPeriodsBeside = 3.0;
  constexpr std::size_t kSharePerEnd = 16;
  // Systems of more unknowns take longer than all else does.
  constexpr std::size_t kMostBack = 1000;
  constexpr std::size_t kMostElse = 200;
  const auto of = [&](double periods, std::size_t most) {
    const auto asked = static_cast<std::size_t>(std::ceil(periods * period_samples));
    return std::min({asked, samples / kSharePerEnd, most});
  };
  return {{of(kPeriodsAhead, kMostElse), of(kPeriodsBack, kMostBack)},
          std::max<std::size_t>(of(kPeriodsBeside, kMostElse), 2)};
}

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_CYCLE_SPAN_H_
