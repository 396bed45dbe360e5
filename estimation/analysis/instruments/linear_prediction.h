// A signal continued by its own linear prediction,
//
//   y_n = -sum_k a_k y_(n-k),   k = 1 ... order,
//
// with the a_k of Burg (J. P. Burg, Maximum Entropy Spectral Analysis, thesis, Stanford 1975),
// which minimise the forward and backward prediction errors over the signal's end, stage by stage;
// with them the continuation never grows without bound.
#ifndef HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_LINEAR_PREDICTION_H_
#define HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_LINEAR_PREDICTION_H_

#include <cstddef>
#include <span>
#include <vector>

namespace howl {

// a_1 ... a_order.
std::vector<double> BurgCoefficients(std::span<const double> signal, std::size_t order);

// The next `count` values of a signal without a mean, by the prediction that its last samples give.
std::vector<double> PredictOnward(std::span<const double> signal, std::size_t count);

}  // namespace howl

#endif  // HOWL_ESTIMATION_ANALYSIS_INSTRUMENTS_LINEAR_PREDICTION_H_
