// The autocovariance of a signal of which some samples are missing, over the pairs that are
// present, under a window over the lags and without negative powers (Blackman and Tukey 1958).
#ifndef HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_PRESENT_AUTOCOVARIANCE_H_
#define HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_PRESENT_AUTOCOVARIANCE_H_

#include <cstddef>
#include <span>
#include <vector>

namespace howl {

// x is without a mean. Of lags 0 ... lags - 1; the window is zero from `lags` on.
std::vector<double> PresentAutocovariance(std::span<const double> x,
                                          const std::vector<bool>& present, std::size_t lags);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_PRESENT_AUTOCOVARIANCE_H_
