// Where a search of a family with transfers begins: at the transfers' centres, but that experiments
// which share the second mode cannot each have their own. The shared M (or M / N) is the mean of
// the transfers' own weighed by their precision, and omega and xi of each experiment move with it
// as the ellipsoid's covariance C has them, to first order:
//
//   m = M / M_0 - 1,   E[ln omega / omega_0 | m] = C_omega,M / C_MM m,   and so for ln xi
#ifndef HOWL_ESTIMATION_FAMILY_LOCAL_TRANSFER_CENTRE_H_
#define HOWL_ESTIMATION_FAMILY_LOCAL_TRANSFER_CENTRE_H_

#include <vector>

#include "estimation/analysis/loop/experiment.h"

namespace howl {

struct TransferCentre {
  double omega_hz = 0.0;
  double xi = 0.0;
  double second = 0.0;  // M, or M / N where `relative`
};

// One for each experiment; empty where one of them has no transfer.
std::vector<TransferCentre> TransferCentres(const std::vector<Experiment>& experiments,
                                            bool shared_second, bool relative);

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_LOCAL_TRANSFER_CENTRE_H_
