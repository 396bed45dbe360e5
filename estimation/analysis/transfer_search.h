// Where the search for a transfer's damping ends. A fit that stands there determines none.
#ifndef HOWL_ESTIMATION_ANALYSIS_TRANSFER_SEARCH_H_
#define HOWL_ESTIMATION_ANALYSIS_TRANSFER_SEARCH_H_

namespace howl {

inline constexpr double kTransferXiMin = 1e-4;
inline constexpr double kTransferXiMax = 10.0;

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_TRANSFER_SEARCH_H_
