// The ends of the search for a transfer's damping. A fit at one of them determines no damping.
#ifndef HOWL_ESTIMATION_ANALYSIS_TRANSFER_TRANSFER_SEARCH_H_
#define HOWL_ESTIMATION_ANALYSIS_TRANSFER_TRANSFER_SEARCH_H_

namespace howl {

inline constexpr double kTransferXiMin = 1e-4;
inline constexpr double kTransferXiMax = 10.0;

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_TRANSFER_TRANSFER_SEARCH_H_
